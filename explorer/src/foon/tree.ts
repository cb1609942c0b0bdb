/** Task trees: order, costs, and the replay that every tree must pass. Mirrors `retrieval/tree.py`. */

import { ascending, inOrder, replay, within, type Replay } from "./graph";
import type { World } from "./world";

export const CRITERIA = ["units", "success", "inputs", "depth", "tools", "dirty", "motions", "time", "cost"] as const;
export type Criterion = (typeof CRITERIA)[number];
export type Costs = Readonly<Record<Criterion, number | null>>;

export interface Step {
  readonly place: number;
  readonly round: number;
  readonly unit: number;
  readonly takes: readonly number[];
  /** For each object that is taken the place of the step that makes it, null if it is from the kitchen. */
  readonly origins: readonly (number | null)[];
  readonly makes: readonly number[];
}

export interface Tree {
  readonly goals: readonly number[];
  /** Units in the order of execution. */
  readonly units: readonly number[];
  readonly steps: readonly Step[];
  readonly replay: Replay;
  readonly costs: Costs;
}

/** Bring units into an order that can be executed, if there is one, and replay it. */
export function treeOf(world: World, goals: readonly number[], units: Iterable<number>): Tree {
  const { readings, stock } = world;
  const chosen = ascending(units);
  const { executable } = within(readings, stock, chosen);
  const order = inOrder(readings, stock, goals, executable);
  order.push(...chosen.filter((unit) => !executable.has(unit)));
  const ended = replay(readings, stock, goals, order);
  const steps = stepsOf(world, order, executable);
  return { goals, units: order, steps, replay: ended, costs: costsOf(world, order, ended.executable, executable) };
}

function stepsOf(world: World, order: readonly number[], rounds: ReadonlyMap<number, number>): Step[] {
  const { readings, stock } = world;
  const made = new Map<number, number>();
  order.forEach((unit, index) => {
    for (const number of readings.makes[unit]!) if (!stock.has(number) && !made.has(number)) made.set(number, index + 1);
  });
  return order.map((unit, index) => {
    const takes = world.unit(unit).inputs;
    const origins = takes.map((port) => {
      const place = made.get(readings.readAs[port]!);
      return place !== undefined && place <= index ? place : null;
    });
    return { place: index + 1, round: rounds.get(unit) ?? 0, unit, takes, origins, makes: readings.makes[unit]! };
  });
}

function costsOf(world: World, units: readonly number[], executable: boolean, rounds: ReadonlyMap<number, number>): Costs {
  const rates = units.map((unit) => world.rate(unit));
  const costs = units.map((unit) => world.cost(unit));
  return {
    units: units.length,
    success: rates.includes(null) ? null : rates.reduce<number>((product, rate) => product * rate!, 1),
    inputs: units.reduce((sum, unit) => sum + world.unit(unit).inputs.length, 0),
    depth: executable ? Math.max(0, ...units.map((unit) => rounds.get(unit) ?? 0)) : null,
    tools: world.handled(units).size,
    dirty: world.filled(units).size,
    motions: new Set(units.map((unit) => world.unit(unit).motion)).size,
    time: units.reduce((sum, unit) => sum + (world.unit(unit).duration ?? 0), 0),
    cost: !world.hasCosts || costs.includes(null) ? null : tidied(costs.reduce<number>((sum, cost) => sum + cost!, 0)),
  };
}

/** A sum of decimals without what floating-point numbers add to it. */
export const tidied = (value: number): number => Number(value.toPrecision(12));
