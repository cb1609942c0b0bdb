/** What stands in the way of a goal that units make, but none that can be executed. Mirrors `query/unreachable.py`. */

import { backward, within } from "../foon/graph";
import type { World } from "../foon/world";

export interface Circle {
  /** Each unit makes the object at the same place, and needs the object at the next place; the last one needs the first. */
  readonly objects: readonly number[];
  readonly units: readonly number[];
}

export class Lack {
  private constructor(
    readonly goal: number,
    readonly units: readonly number[],
    /** What can be had if all that is raw is bought. */
    readonly available: ReadonlyMap<number, number>,
    readonly executable: ReadonlyMap<number, number>,
  ) {}

  static of(world: World, goal: number): Lack {
    const { readings } = world;
    const there = world.closure.available;
    const units = backward(readings, [goal], there);
    const needed = new Set(units.flatMap((unit) => readings.needs[unit]!));
    const stock = new Set([...needed].filter((each) => there.has(each) || (each !== goal && world.isRaw(each))));
    const closure = within(readings, stock, units);
    return new Lack(goal, units, closure.available, closure.executable);
  }

  /** Whether even all raw objects together are not enough. */
  get circular(): boolean {
    return !this.available.has(this.goal);
  }
}

/** What locks a goal for which even all raw objects are not enough, the nearest to it first: a ring for each closed group. */
export function circles(world: World, lack: Lack): Circle[] {
  const { readings, closure } = world;
  const makers = new Map<number, number[]>();
  const needs = new Map<number, number[]>();
  for (const unit of lack.units.filter((each) => !lack.executable.has(each))) {
    needs.set(unit, readings.needs[unit]!.filter((need) => !lack.available.has(need) && !closure.available.has(need)));
    for (const made of readings.makes[unit]!) makers.set(made, [...(makers.get(made) ?? []), unit]);
  }
  const next = (object: number): number[] => [...new Set((makers.get(object) ?? []).flatMap((unit) => needs.get(unit)!))];
  const before = new Map<number, number[]>();
  const near = reached(lack.goal, next);
  for (const object of near) for (const other of next(object)) before.set(other, [...(before.get(other) ?? []), object]);
  const found: Circle[] = [];
  const seen = new Set<number>();
  for (const object of near) {
    if (seen.has(object)) continue;
    // Nothing leads out of a closed group: whatever an object of it reaches leads back to it.
    const group = reached(object, next);
    const back = new Set(reached(object, (each) => before.get(each) ?? []));
    if (!group.every((each) => back.has(each))) continue;
    for (const each of group) seen.add(each);
    const circle = ring(object, makers, needs);
    if (circle !== null) found.push(circle);
  }
  return found;
}

function reached(start: number, next: (object: number) => number[]): number[] {
  const found = new Set([start]);
  for (const object of found) for (const each of next(object)) found.add(each);
  return [...found];
}

function ring(start: number, makers: ReadonlyMap<number, readonly number[]>, needs: ReadonlyMap<number, readonly number[]>): Circle | null {
  const came = new Map<number, readonly [number, number]>();
  const queue = [start];
  for (const object of queue) {
    for (const unit of makers.get(object) ?? []) {
      for (const need of needs.get(unit)!) {
        if (!came.has(need)) {
          came.set(need, [object, unit]);
          queue.push(need);
        }
      }
    }
    if (came.has(start)) break;
  }
  if (!came.has(start)) return null;
  const objects: number[] = [];
  const units: number[] = [];
  let object = start;
  do {
    const [before, unit] = came.get(object)!;
    objects.push(before);
    units.push(unit);
    object = before;
  } while (object !== start);
  return { objects: objects.reverse(), units: units.reverse() };
}
