/** What the solver is asked: goals over a world, with only the units that can matter. Mirrors `query/problem.py`. */

import { ascending, backward } from "../foon/graph";
import type { World } from "../foon/world";

/** What a tree must not do, by the keys that Python and JSON have for it. */
export interface Constraints {
  readonly without: readonly string[];
  readonly diets: readonly string[];
  readonly without_tools: readonly string[];
  readonly avoid_motions: readonly string[];
  /** Ids of the whole FOON, as commands take them. */
  readonly use_units: readonly number[];
  readonly avoid_units: readonly number[];
  readonly max_units: number | null;
  readonly max_depth: number | null;
}

export const FREE: Constraints = {
  without: [],
  diets: [],
  without_tools: [],
  avoid_motions: [],
  use_units: [],
  avoid_units: [],
  max_units: null,
  max_depth: null,
};

/** A constraint by the atom that `constraints.lp` has for it, and by its name. */
export interface NamedConstraint {
  readonly key: keyof Constraints;
  readonly atom: string;
  readonly name: string;
  readonly value: string | number;
  readonly values: readonly (string | number)[];
}

/** All constraints, each by its name. Mirrors the table of kinds in `query/constraints.py`. */
export function named(constraints: Constraints, diets: Readonly<Record<string, readonly string[]>>): NamedConstraint[] {
  const each = (key: keyof Constraints, atom: string, wording: (value: string | number) => string): NamedConstraint[] =>
    [constraints[key] ?? []].flat().map((value) => ({
      key,
      atom,
      name: wording(value as string | number),
      value: value as string | number,
      values: key === "diets" ? (diets[value as string] ?? []) : [value as string | number],
    }));
  const counted = (what: string) => (count: string | number): string => `at most ${count} ${what}${count === 1 ? "" : "s"}`;
  return [
    ...each("without", "without", (label) => `without ${label}`),
    ...each("diets", "without", (diet) => `diet ${diet}`),
    ...each("without_tools", "without_tool", (label) => `without tool ${label}`),
    ...each("avoid_motions", "avoid_motion", (motion) => `avoid motion ${motion}`),
    ...each("use_units", "use_unit", (unit) => `use unit ${unit}`),
    ...each("avoid_units", "avoid_unit", (unit) => `avoid unit ${unit}`),
    ...each("max_units", "max_units", counted("unit")),
    ...each("max_depth", "max_depth", counted("round")),
  ];
}

export class Problem {
  private known: readonly number[] | undefined;

  constructor(
    readonly world: World,
    readonly goals: readonly number[],
    readonly founded: boolean = true,
    readonly constraints: readonly NamedConstraint[] = [],
  ) {}

  /** Numbers of the units of a kind of constraint; ids that the page does not have are left out. */
  demanded(key: "use_units" | "avoid_units"): number[] {
    const ids = new Set(this.constraints.filter((each) => each.key === key).map((each) => each.value));
    return [...this.world.units.keys()].filter((unit) => ids.has(this.world.unit(unit).id));
  }

  /** The units given to the solver, in file order. */
  get units(): readonly number[] {
    this.known ??= this.slice();
    return this.known;
  }

  private slice(): number[] {
    const { readings, stock, closure } = this.world;
    const allowed = this.founded ? closure.executable : undefined;
    const required = this.demanded("use_units").filter((unit) => allowed === undefined || allowed.has(unit));
    const wanted = [...this.goals, ...required.flatMap((unit) => readings.needs[unit]!)];
    return ascending(new Set([...required, ...backward(readings, wanted, stock, allowed)]));
  }

  /** The objects given to the solver. */
  get objects(): number[] {
    const { readings } = this.world;
    const seen = new Set(this.goals);
    for (const unit of this.units) {
      for (const number of this.world.listed(unit)) seen.add(number).add(readings.readAs[number]!);
    }
    return ascending(seen);
  }
}
