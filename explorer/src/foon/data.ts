/** What the page is given: a FOON, a kitchen, the encodings. Written by `foon_asp/render/explorer.py`. */

/** A state: name, what it relates to, contents. */
export type StateRow = [string, string | null, string[] | null];
/** An object node: label and states in their canonical order. */
export type NodeRow = [string, StateRow[]];
/** Where a unit was read: places in `files` and `videos` (-1: none), and the line. */
export type SourceRow = [number, number, number];

export interface UnitRow {
  /** The number that the unit has in the whole FOON, which is the one that commands take. */
  id: number;
  motion: string;
  composite?: boolean;
  inputs: number[];
  outputs: number[];
  /** When the video shows it first and last, in seconds. */
  start?: number;
  end?: number;
  /** How many seconds it took, all goes together, where that is known and above 0. */
  duration?: number;
  rate?: number;
  agent?: string;
  sources: SourceRow[];
}

export interface KitchenRow {
  /** Numbers of objects. */
  objects: number[];
  utensils: string[];
  rates: Record<string, number>;
  default_rate: number | null;
  costs: Record<string, number>;
  default_cost: number | null;
}

export interface WorldRow {
  title: string;
  objects: NodeRow[];
  units: UnitRow[];
  files: string[];
  videos: string[];
  goals: number[];
  kitchen: KitchenRow;
  level: number;
  strict: boolean;
  loose: boolean;
  /** What is left out, in a sentence, where this is a slice. */
  slice: string;
}

export interface PageData {
  version: string;
  /** The options of the command line that name these data. */
  options: string[];
  world: WorldRow;
  encodings: Record<string, string>;
  diets: Record<string, string[]>;
}
