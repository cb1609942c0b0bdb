/** How things are worded, once. */

import type { Costs, Criterion } from "../foon/tree";
import type { Method } from "../solve/query";

export const METHOD_NAMES: Readonly<Record<Method, string>> = {
  optimal: "Best, proven",
  greedy: "Best unit first",
  ids: "Shallowest first",
  first: "First in the file",
};

export const METHOD_NOTES: Readonly<Record<Method, string>> = {
  optimal: "No tree is better; clingo proves it.",
  greedy: "The published heuristic: from the goal down, each object gets its best unit.",
  ids: "Iterative deepening: the least depth, then the first unit that fits.",
  first: "From the goal down, the first unit that makes each object.",
};

export const CRITERION_NAMES: Readonly<Record<Criterion, string>> = {
  units: "fewest steps",
  success: "likeliest to succeed",
  inputs: "fewest inputs",
  depth: "fewest rounds",
  tools: "fewest tools",
  dirty: "least to wash up",
  motions: "fewest motions",
  time: "shortest video time",
  cost: "cheapest motions",
};

export const COST_NAMES: Readonly<Record<Criterion, string>> = {
  units: "steps",
  success: "success",
  inputs: "inputs",
  depth: "rounds",
  tools: "tools",
  dirty: "to wash up",
  motions: "motions",
  time: "video time",
  cost: "cost",
};

/** What a cost is called beside its value. */
export const costName = (criterion: Criterion, value: number | null): string =>
  value === 1 && ["units", "inputs", "depth", "tools", "motions"].includes(criterion) ? COST_NAMES[criterion].replace(/s$/, "") : COST_NAMES[criterion];

export function costText(criterion: Criterion, value: number | null): string {
  if (value === null) return "–";
  if (criterion === "success") return percent(value);
  if (criterion === "time") return duration(value);
  return value.toLocaleString("en", { maximumFractionDigits: 3 });
}

/** A chance: in per cent, or by its power of ten where that is easier to read. */
function percent(value: number): string {
  if (value === 0 || value >= 1e-3) return `${Number((100 * value).toPrecision(value >= 0.1 ? 3 : 2))} %`;
  const [digits = "", power = ""] = value.toExponential(1).split("e");
  return `${digits}·10${[...power].map((sign) => RAISED[sign] ?? "").join("")}`;
}

const RAISED: Readonly<Record<string, string>> = Object.fromEntries([..."-0123456789"].map((sign, place) => [sign, [..."⁻⁰¹²³⁴⁵⁶⁷⁸⁹"][place]!]));

export function duration(seconds: number): string {
  const minutes = Math.floor(seconds / 60);
  return `${minutes}:${String(Math.floor(seconds % 60)).padStart(2, "0")}`;
}

/** The costs that say something of a tree: nothing of time and costs where nobody noted any. */
export const worthSaying = (costs: Costs): Criterion[] =>
  (Object.keys(costs) as Criterion[]).filter((each) => costs[each] !== null && !(each === "time" && costs.time === 0));
