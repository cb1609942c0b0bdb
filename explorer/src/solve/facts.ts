/** From a problem to clingo facts. Mirrors `asp/facts.py`; the predicates are those of `encodings/vocabulary.lp`. */

import { round, type World } from "../foon/world";
import { namedLabels, type ObjectNode } from "../foon/node";
import { compareText } from "../foon/node";
import { failure, type Tariff } from "./tariff";
import type { Problem } from "./problem";

export interface Said {
  /** What chances cost; without one nothing is said of chances. */
  readonly chances?: Tariff | undefined;
  /** Of how many parts of one costs are whole multiples; without it nothing is said of costs. */
  readonly grain?: number | undefined;
  /** Whether labels, states and the like are looked at; else only what units need and make is said. */
  readonly details: boolean;
}

export const quote = (text: string): string => `"${text.replaceAll("\\", "\\\\").replaceAll("\n", "\\n").replaceAll('"', '\\"')}"`;

export function facts(problem: Problem, said: Said): string {
  const { world } = problem;
  const lines = said.details ? details(problem) : readings(problem);
  if (said.chances !== undefined) lines.push(...rates(problem, said.chances));
  if (said.grain !== undefined) {
    for (const unit of problem.units) {
      const cost = world.cost(unit);
      if (cost !== null) lines.push(`costs(${unit},${Math.round(cost * said.grain)}).`);
    }
  }
  for (const number of said.details ? problem.objects : problem.goals) if (world.stock.has(number)) lines.push(`kitchen(${number}).`);
  for (const goal of problem.goals) lines.push(`goal(${goal}).`);
  lines.push(...constraints(problem));
  return `${lines.join("\n")}\n`;
}

function constraints(problem: Problem): string[] {
  const { world } = problem;
  const numbers = new Map(world.units.map((unit, number) => [unit.id, number]));
  return problem.constraints.flatMap(({ key, atom, name, values }) => {
    if (values.length === 0) return [`${atom}(${quote(name)},"").`];
    return values.map((value) => {
      if (typeof value === "string") return `${atom}(${quote(name)},${quote(value)}).`;
      // A unit that is not here is named by a number that no unit has; more than all units is as good as no limit.
      const number = key.endsWith("units") && key !== "max_units" ? (numbers.get(value) ?? -1) : Math.min(value, problem.units.length);
      return `${atom}(${quote(name)},${number}).`;
    });
  });
}

function readings(problem: Problem): string[] {
  const { readings: reading, stock } = problem.world;
  return problem.units.map((unit) =>
    [
      `unit(${unit}).`,
      ...reading.needs[unit]!.filter((need) => !stock.has(need)).map((need) => `needs(${unit},${need}).`),
      ...reading.makes[unit]!.filter((made) => !stock.has(made)).map((made) => `makes(${unit},${made}).`),
    ].join(" "),
  );
}

function details(problem: Problem): string[] {
  const { world } = problem;
  const lines: string[] = [];
  if (world.labelsOnly) lines.push("#const labels_only = 1. [override]");
  if (world.row.loose) lines.push("#const loose = 1. [override]");
  const labels = new Set<string>();
  for (const number of problem.objects) {
    const node = world.node(number);
    for (const label of namedLabels(node)) labels.add(label);
    lines.push(objectFacts(number, node));
    const other = world.readings.readAs[number]!;
    if (other !== number) lines.push(`counts_as(${number},${other}).`);
  }
  for (const unit of problem.units) lines.push(unitFacts(world, unit));
  for (const label of [...world.utensils].filter((each) => labels.has(each)).sort(compareText)) lines.push(`utensil(${quote(label)}).`);
  return lines;
}

function objectFacts(number: number, node: ObjectNode): string {
  const parts = [`object(${number}). label(${number},${quote(node.label)}).`];
  for (const { name, relatum, contents } of node.states) {
    if (relatum !== null) parts.push(`relation(${number},${quote(name)},${quote(relatum)}).`);
    for (const content of new Set(contents ?? [])) parts.push(`content(${number},${quote(name)},${quote(content)}).`);
    if (relatum === null && (contents?.length ?? 0) === 0) parts.push(`state(${number},${quote(name)}).`);
  }
  return parts.join(" ");
}

function unitFacts(world: World, number: number): string {
  const unit = world.unit(number);
  const parts = [`unit(${number}). motion(${number},${quote(unit.motion)}).`];
  parts.push(...unit.inputs.map((port) => `input(${number},${port}).`), ...unit.outputs.map((port) => `output(${number},${port}).`));
  if (unit.start !== undefined) parts.push(`start(${number},${round(unit.start)}).`);
  if (unit.end !== undefined) parts.push(`end(${number},${round(unit.end)}).`);
  if (unit.duration !== undefined) parts.push(`duration(${number},${unit.duration}).`);
  return parts.join(" ");
}

function* rates(problem: Problem, tariff: Tariff): Generator<string> {
  const { world } = problem;
  let zero = false;
  for (const unit of problem.units) {
    const rate = world.rate(unit)!;
    yield `success_rate(${unit},${perThousand(rate)}).`;
    if (rate === 0) {
      zero = true;
      yield `never_succeeds(${unit}).`;
    } else if (failure(tariff, rate) > 0) yield `fails(${unit},${failure(tariff, rate)}).`;
  }
  if (zero) yield `ruin(${tariff.ruin}).`;
}

/** How many rates are higher than that of each unit and are the same in parts per thousand. */
export function finerFacts(problem: Problem): string {
  const { world } = problem;
  const alike = new Map<number, number[]>();
  const known = new Set(problem.units.map((unit) => world.rate(unit)!));
  for (const rate of [...known].sort((one, other) => other - one)) alike.set(perThousand(rate), [...(alike.get(perThousand(rate)) ?? []), rate]);
  return problem.units
    .map((unit) => [unit, alike.get(perThousand(world.rate(unit)!))!.indexOf(world.rate(unit)!)] as const)
    .filter(([, place]) => place > 0)
    .map(([unit, place]) => `finer(${unit},${place}).\n`)
    .join("");
}

const perThousand = (rate: number): number => (rate > 0 ? Math.max(1, round(rate * 1000)) : 0);
