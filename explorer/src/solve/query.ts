/** What is asked and what is answered, as values that can be written as JSON. */

import type { NodeRow } from "../foon/data";
import type { Criterion, Tree } from "../foon/tree";
import type { Constraints } from "./problem";

export const METHODS = ["optimal", "greedy", "ids", "first"] as const;
export type Method = (typeof METHODS)[number];

export interface Query {
  /** Numbers of objects. */
  readonly goals: readonly number[];
  readonly method: Method;
  /** Criteria, the most important first. */
  readonly by: readonly Criterion[];
  readonly founded: boolean;
  readonly constraints: Constraints;
  /** How many trees, the best first. */
  readonly count: number;
}

export type Status = "optimal" | "found" | "unreachable" | "limit";

/** Why there is no tree. */
export type Reason =
  | { readonly kind: "no maker"; readonly goal: number }
  | {
      readonly kind: "lacking";
      readonly goal: number;
      /** The smallest set of objects with which the goal can be made; null if that is not known. */
      readonly add: readonly number[] | null;
      /** Circles of units that hold each other up: objects, and the units that make them. */
      readonly circles: readonly { readonly objects: readonly number[]; readonly units: readonly number[] }[];
    }
  | { readonly kind: "constraints"; readonly names: readonly string[] };

export interface Answer {
  readonly query: Query;
  readonly status: Status;
  readonly trees: readonly Tree[];
  readonly reason: Reason | null;
  /** Whether there are known to be no more trees. */
  readonly complete: boolean;
  /** What is proven of the first criterion where a search was stopped; null if nothing is. */
  readonly bound: number | null;
  /** Milliseconds. */
  readonly time: number;
}

/** A question as tests and other programs ask it: objects as rows. */
export interface Asked extends Omit<Query, "goals"> {
  readonly goals: readonly NodeRow[];
}
