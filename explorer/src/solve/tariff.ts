/** What a criterion costs in clingo's integers, as finely as 32 bits allow. Mirrors `query/tariff.py`. */

import type { Criterion } from "../foon/tree";
import type { Problem } from "./problem";

const MOST = 2 ** 31 - 1;
const FINEST = 1e8;
const LOST = 1e-5;

/** What can be said to a person: the question does not fit the data. */
export class QueryError extends Error {}

export interface Tariff {
  readonly criterion: Criterion;
  /** How many payments make one unit of the natural logarithm of a chance. */
  readonly nat: number;
  /** What is paid instead of all else where the chance is 0; 0 if that cannot happen. */
  readonly ruin: number;
  /** Of how much each cost of a motion is a whole multiple: this many parts make one. */
  readonly grain: number;
}

export function tariffOf(problem: Problem, criterion: Criterion): Tariff {
  const plain: Tariff = { criterion, nat: 0, ruin: 0, grain: 1 };
  if (criterion === "success") return { ...plain, ...chances(problem) };
  if (criterion === "cost") return { ...plain, grain: grainOf(problem) };
  return plain;
}

function chances(problem: Problem): { nat: number; ruin: number } {
  const { world } = problem;
  let total = 0;
  let zero = false;
  for (const unit of problem.units) {
    const rate = world.rate(unit);
    if (rate === null) throw new QueryError(`The motion “${world.unit(unit).motion}” has no success rate.`);
    if (rate === 0) zero = true;
    else total -= Math.log(rate);
  }
  const room = Math.floor(MOST / (zero ? 2 : 1)) - 3;
  return { nat: total > 0 ? Math.min(FINEST, room / total) : Math.min(FINEST, room), ruin: zero ? room + 2 : 0 };
}

/** What a chance above 0 costs: the negative logarithm, rounded down. */
export const failure = (tariff: Tariff, rate: number): number => Math.max(0, Math.floor(-Math.log(rate) * tariff.nat - LOST));

function grainOf(problem: Problem): number {
  const { world } = problem;
  let digits = 0;
  for (const unit of problem.units) {
    const cost = world.cost(unit);
    if (cost === null) throw new QueryError(`Nothing says what the motion “${world.unit(unit).motion}” costs.`);
    digits = Math.max(digits, decimals(cost));
  }
  const parts = 10 ** digits;
  const total = problem.units.reduce((sum, unit) => sum + world.cost(unit)! * parts, 0);
  if (total >= MOST - 3) throw new QueryError("The costs of the motions have too many digits to be added up.");
  return parts;
}

function decimals(value: number): number {
  for (let digits = 0; digits < 15; digits += 1) if (Number.isInteger(Number((value * 10 ** digits).toPrecision(15)))) return digits;
  return 15;
}

/** What a sum of payments proves of every tree: a chance that none exceeds, else a cost that all have. */
export function boundOf(tariff: Tariff, paid: number): number {
  // Every tree pays a base of one, so that clingo has a place for its costs.
  const least = Math.max(0, paid - 1);
  if (tariff.criterion === "success") return tariff.ruin > 0 && paid >= tariff.ruin ? 0 : Math.exp(-least / tariff.nat);
  return least / tariff.grain;
}
