/** The state of the page, which is also its address: the same words as the options of the command line. */

import { CRITERIA, type Criterion } from "./foon/tree";
import { FREE, type Constraints } from "./solve/problem";
import { METHODS, type Method } from "./solve/query";

export const VIEWS = ["steps", "picture", "compare", "trade-offs", "take-along", "kitchen"] as const;
export type View = (typeof VIEWS)[number];

/** How the kitchen differs from that of the data: texts of objects. */
export interface KitchenChange {
  readonly empty: boolean;
  readonly add: readonly string[];
  readonly remove: readonly string[];
}

export interface State {
  /** Texts of objects. */
  readonly goals: readonly string[];
  readonly method: Method;
  readonly by: readonly Criterion[];
  readonly founded: boolean;
  readonly count: number;
  readonly constraints: Constraints;
  readonly kitchen: KitchenChange;
  readonly view: View;
  /** Which of several trees is shown, from 0. */
  readonly tree: number;
}

export const AS_IT_IS: KitchenChange = { empty: false, add: [], remove: [] };

export const START: State = {
  goals: [],
  method: "optimal",
  by: ["units"],
  founded: true,
  count: 1,
  constraints: FREE,
  kitchen: AS_IT_IS,
  view: "steps",
  tree: 0,
};

export const MOST_TREES = 20;

const TEXTS = { without: "without", diet: "diets", "without-tool": "without_tools", "avoid-motion": "avoid_motions" } as const;
const IDS = { "use-unit": "use_units", "avoid-unit": "avoid_units" } as const;
const COUNTS = { "max-units": "max_units", "max-depth": "max_depth" } as const;

export function writeState(state: State): string {
  const words = new URLSearchParams();
  for (const goal of state.goals) words.append("make", goal);
  if (state.method !== START.method) words.set("method", state.method);
  if (state.by.join() !== START.by.join()) words.set("by", state.by.join());
  if (!state.founded) words.set("reference", "yes");
  if (state.count !== 1) words.set("n", String(state.count));
  for (const [word, key] of Object.entries(TEXTS)) for (const value of state.constraints[key]) words.append(word, value);
  for (const [word, key] of Object.entries(IDS)) for (const value of state.constraints[key]) words.append(word, String(value));
  for (const [word, key] of Object.entries(COUNTS)) if (state.constraints[key] !== null) words.set(word, String(state.constraints[key]));
  if (state.kitchen.empty) words.set("kitchen", "empty");
  for (const object of state.kitchen.add) words.append("add", object);
  for (const object of state.kitchen.remove) words.append("remove", object);
  if (state.view !== START.view) words.set("view", state.view);
  if (state.tree !== 0) words.set("tree", String(state.tree + 1));
  return words.toString();
}

/** Read an address; whatever is no word of it is passed over. */
export function readState(text: string): State {
  const words = new URLSearchParams(text);
  const texts = (word: string): string[] => [...new Set(words.getAll(word).filter((each) => each !== ""))];
  const numbers = (word: string): number[] => texts(word).filter((each) => /^\d{1,9}$/.test(each)).map(Number);
  const by = (words.get("by") ?? "").split(",").filter((each): each is Criterion => (CRITERIA as readonly string[]).includes(each));
  const oneOf = <T extends string>(values: readonly T[], word: string, otherwise: T): T => values.find((each) => each === words.get(word)) ?? otherwise;
  const constraints: Constraints = {
    without: texts("without"),
    diets: texts("diet"),
    without_tools: texts("without-tool"),
    avoid_motions: texts("avoid-motion"),
    use_units: numbers("use-unit"),
    avoid_units: numbers("avoid-unit"),
    max_units: numbers("max-units")[0] ?? null,
    max_depth: numbers("max-depth")[0] ?? null,
  };
  // Several goals are a menu, and that is only there proven.
  const menu = texts("make").length > 1;
  return {
    goals: texts("make"),
    method: menu ? START.method : oneOf(METHODS, "method", START.method),
    by: by.length > 0 ? [...new Set(by)] : START.by,
    founded: menu || words.get("reference") !== "yes",
    count: Math.min(MOST_TREES, Math.max(1, numbers("n")[0] ?? 1)),
    constraints,
    kitchen: { empty: words.get("kitchen") === "empty", add: texts("add"), remove: texts("remove") },
    view: oneOf(VIEWS, "view", START.view),
    tree: Math.max(0, (numbers("tree")[0] ?? 1) - 1),
  };
}

/** The `foon-asp` command line that gives the same; `options` name the data. */
export function commandLine(state: State, options: readonly string[], changedKitchen: boolean): string {
  const words = ["foon-asp", state.goals.length > 1 ? "menu" : "retrieve", ...state.goals, ...options];
  if (state.goals.length <= 1 && state.method !== "optimal") words.push("--method", state.method);
  if (state.method === "optimal" ? state.by.join() !== "units" : state.method === "greedy") words.push("--by", state.by.join());
  if (!state.founded) words.push("--reference");
  if (state.count > 1 && state.goals.length <= 1) words.push("-n", String(state.count));
  for (const [word, key] of Object.entries(TEXTS)) for (const value of state.constraints[key]) words.push(`--${word}`, value);
  for (const [word, key] of Object.entries(IDS)) for (const value of state.constraints[key]) words.push(`--${word}`, String(value));
  for (const [word, key] of Object.entries(COUNTS)) if (state.constraints[key] !== null) words.push(`--${word}`, String(state.constraints[key]));
  if (changedKitchen) words.push("--kitchen", "kitchen.json");
  return words.map(inShell).join(" ");
}

const inShell = (word: string): string => (/^[\w@%+=:,./-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`);
