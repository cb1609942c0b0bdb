/** Plain graph passes: what a kitchen can make, and which units can matter. Mirrors `model/reachability.py`. */

import type { Readings } from "./world";

/** What can be reached, with the round (1, 2, …) in which it first can be; what is at hand has round 0. */
export interface Closure {
  readonly available: ReadonlyMap<number, number>;
  readonly executable: ReadonlyMap<number, number>;
}

/** The least fixpoint from the kitchen, over all units. */
export function forward(readings: Readings, stock: ReadonlySet<number>): Closure {
  return within(readings, stock, readings.needs.keys());
}

/** The least fixpoint from the kitchen, over some units. */
export function within(readings: Readings, stock: ReadonlySet<number>, some: Iterable<number>): Closure {
  const available = new Map<number, number>([...stock].map((number) => [number, 0]));
  const executable = new Map<number, number>();
  const users = new Map<number, number[]>();
  const missing = new Map<number, number>();
  let ready: number[] = [];
  for (const unit of some) {
    const lacking = readings.needs[unit]!.filter((need) => !stock.has(need));
    missing.set(unit, lacking.length);
    for (const need of lacking) (users.get(need) ?? put(users, need, [])).push(unit);
    if (lacking.length === 0) ready.push(unit);
  }
  for (let round = 1; ready.length > 0; round += 1) {
    for (const unit of ready) executable.set(unit, round);
    const fresh = new Set(ready.flatMap((unit) => readings.makes[unit]!.filter((made) => !available.has(made))));
    ready = [];
    for (const made of fresh) {
      available.set(made, round);
      for (const user of users.get(made) ?? []) {
        const left = missing.get(user)! - 1;
        missing.set(user, left);
        if (left === 0) ready.push(user);
      }
    }
  }
  return { available, executable };
}

interface Has {
  has(number: number): boolean;
}

/** The units that can matter for the goals, sorted, among all or the given ones. */
export function backward(readings: Readings, goals: Iterable<number>, stock: Has, among?: Has): number[] {
  const found = new Set<number>();
  const wanted = new Set([...goals].filter((goal) => !stock.has(goal)));
  for (const number of wanted) {
    for (const unit of readings.makers.get(number) ?? []) {
      if (found.has(unit) || (among !== undefined && !among.has(unit))) continue;
      found.add(unit);
      // What is added to a set while it is gone through is visited, too.
      for (const need of readings.needs[unit]!) if (!stock.has(need)) wanted.add(need);
    }
  }
  return ascending(found);
}

export const ascending = (numbers: Iterable<number>): number[] => [...numbers].sort((one, other) => one - other);

/** What executing units in order from the kitchen lacks: at a unit, or of the goals in the end. */
export interface Replay {
  readonly executable: boolean;
  readonly failedAt: number | null;
  readonly missing: readonly number[];
}

export function replay(readings: Readings, stock: Has, goals: readonly number[], units: readonly number[]): Replay {
  const atHand = new Set<number>();
  const there = (number: number): boolean => atHand.has(number) || stock.has(number);
  for (const [place, unit] of units.entries()) {
    const lacking = readings.needs[unit]!.filter((need) => !there(need));
    if (lacking.length > 0) return { executable: false, failedAt: place, missing: lacking };
    for (const made of readings.makes[unit]!) atHand.add(made);
  }
  const lacking = goals.filter((goal) => !there(goal));
  return { executable: lacking.length === 0, failedAt: null, missing: lacking };
}

/** For each object the unit that makes it first, given the rounds in which units are executed. */
function firstMakers(readings: Readings, executable: ReadonlyMap<number, number>): { order: number[]; maker: Map<number, number> } {
  const order = [...executable.keys()].sort((one, other) => executable.get(one)! - executable.get(other)! || one - other);
  const maker = new Map<number, number>();
  for (const unit of order) for (const made of readings.makes[unit]!) if (!maker.has(made)) maker.set(made, unit);
  return { order, maker };
}

/** Those of some units by which the goals are made first: a tree, if not a best one. Mirrors `retrieval/prune.py`. */
export function leading(readings: Readings, stock: ReadonlySet<number>, goals: readonly number[], units: readonly number[]): Set<number> {
  const { maker } = firstMakers(readings, within(readings, stock, units).executable);
  const kept = new Set<number>();
  const wanted = [...goals];
  for (let object = wanted.pop(); object !== undefined; object = wanted.pop()) {
    const unit = maker.get(object);
    if (stock.has(object) || unit === undefined || kept.has(unit)) continue;
    kept.add(unit);
    wanted.push(...readings.needs[unit]!);
  }
  return kept;
}

/** Units in the order of execution; steps that lead to the same object stand together. Mirrors `retrieval/tree.py`. */
export function inOrder(readings: Readings, stock: Has, goals: readonly number[], executable: ReadonlyMap<number, number>): number[] {
  const { order: rest, maker } = firstMakers(readings, executable);
  const first = goals.filter((goal) => maker.has(goal)).map((goal) => maker.get(goal)!);
  const stack = [...rest.slice().reverse(), ...first.reverse()];
  const placed = new Set<number>();
  const order: number[] = [];
  while (stack.length > 0) {
    const unit = stack.at(-1)!;
    const before = readings.needs[unit]!.filter((need) => !stock.has(need) && !placed.has(maker.get(need)!)).map((need) => maker.get(need)!);
    if (before.length > 0 && !placed.has(unit)) {
      stack.push(...before.reverse());
      continue;
    }
    stack.pop();
    if (!placed.has(unit)) {
      placed.add(unit);
      order.push(unit);
    }
  }
  return order;
}

function put<K, V>(map: Map<K, V>, key: K, value: V): V {
  map.set(key, value);
  return value;
}
