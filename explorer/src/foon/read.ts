/** Reads a FOON in JSON, both forms (a list of units; the FOON API's `functional_units`). Mirrors `io/json.py`. */

import type { UnitRow, WorldRow } from "./data";
import { round } from "./world";
import { keyOf, nodeOf, nodeToRow, stateOf, type ObjectNode, type State } from "./node";

/** What can be said to a person: the file is no FOON. */
export class FileError extends Error {}

const GLUED = /^(contains|in|on|under|with|inside|attached to|around|between) +(.+)$/s;

/** Return the same world with the FOON of a JSON text instead; kitchen, utensils and rates stay. */
export function withFoon(world: WorldRow, text: string, name: string): { world: WorldRow; left: number } {
  let value: unknown;
  try {
    value = JSON.parse(text);
  } catch (error) {
    throw new FileError(`${name} is not JSON: ${(error as Error).message}`);
  }
  const items = unitsIn(value);
  if (items.length === 0) throw new FileError(`${name} has no functional units: expected a list of {input_nodes, motion_node, output_nodes}.`);
  const objects: ObjectNode[] = [];
  const numbers = new Map<string, number>();
  const number = (node: ObjectNode): number => {
    const key = keyOf(node);
    if (!numbers.has(key)) numbers.set(key, objects.push(node) - 1);
    return numbers.get(key)!;
  };
  const units = new Map<string, UnitRow>();
  const videos = [""];
  let left = 0;
  for (const item of items) {
    try {
      const { motion, inputs, outputs, start, end, duration, rate, video } = unitFrom(item);
      if (inputs.length === 0) throw new FileError("nothing is made from nothing");
      const row = { motion, inputs: unique(inputs.map(number)), outputs: unique(outputs.map(number)) };
      const key = JSON.stringify([row.motion, [...row.inputs].sort(), [...row.outputs].sort()]);
      if (units.has(key)) continue;
      if (video !== "" && !videos.includes(video)) videos.push(video);
      const more = { ...(start === undefined ? {} : { start }), ...(end === undefined ? {} : { end }), ...(duration > 0 ? { duration } : {}), ...(rate === undefined ? {} : { rate }) };
      units.set(key, { id: units.size, ...row, ...more, sources: [[0, 0, videos.indexOf(video)]] });
    } catch (error) {
      if (!(error instanceof FileError)) throw error;
      left += 1;
    }
  }
  if (units.size === 0) throw new FileError(`No unit of ${name} can be read.`);
  const stock = world.kitchen.objects.map((each) => world.objects[each]!);
  const known = new Set(objects.map((node) => keyOf(node)));
  const strangers = stock.filter((row) => !known.has(JSON.stringify(row)));
  const rows = [...objects.map(nodeToRow), ...strangers];
  const place = new Map(rows.map((row, index) => [JSON.stringify(row), index]));
  return {
    world: {
      ...world,
      title: name,
      objects: rows,
      units: [...units.values()],
      files: [name],
      videos,
      goals: [],
      kitchen: { ...world.kitchen, objects: stock.map((row) => place.get(JSON.stringify(row))!) },
      level: 3,
      slice: "",
    },
    left,
  };
}

const unique = (numbers: readonly number[]): number[] => [...new Set(numbers)];

type Value = Record<string, unknown>;
const isObject = (value: unknown): value is Value => typeof value === "object" && value !== null && !Array.isArray(value);
const isUnit = (value: unknown): value is Value => isObject(value) && ("input_nodes" in value || "motion_node" in value || "output_nodes" in value);

/** The units of lists, of lists of lists, and of objects that have such lists. */
function unitsIn(value: unknown, source?: unknown): Value[] {
  if (isUnit(value)) return [source === undefined || "source" in value ? value : { ...value, source }];
  if (Array.isArray(value)) return value.flatMap((each) => unitsIn(each, source));
  if (!isObject(value)) return [];
  const inner = "functional_units" in value ? [value.functional_units] : Object.values(value).filter((each) => typeof each === "object");
  return inner.flatMap((each) => unitsIn(each, value.source ?? source));
}

function unitFrom(item: Value): {
  motion: string;
  inputs: ObjectNode[];
  outputs: ObjectNode[];
  start: number | undefined;
  end: number | undefined;
  duration: number;
  rate: number | undefined;
  video: string;
} {
  const node = item.motion_node;
  const note: Value = isObject(node) ? node : {};
  const label = isObject(node) ? (node.motion_label ?? node.label) : node;
  const motion = clean(label).replace(/\*+$/, "").trim();
  if (motion === "") throw new FileError("a motion has no label");
  const times = (Array.isArray(note.times) ? note.times : [note]).filter(isObject).map((each) => [seconds(each.start_time), seconds(each.end_time)] as const);
  const rate = Number(note.weight_success ?? Number.NaN);
  return {
    motion,
    inputs: side(item.input_nodes),
    outputs: side(item.output_nodes),
    start: times[0]?.[0],
    end: times.at(-1)?.[1],
    duration: times.reduce((sum, [from, to]) => sum + (from === undefined || to === undefined ? 0 : Math.max(0, round(to) - round(from))), 0),
    rate: note.weight_success !== "" && rate >= 0 && rate <= 1 ? rate : undefined,
    video: typeof item.source === "string" ? item.source : "",
  };
}

function seconds(value: unknown): number | undefined {
  if (typeof value === "number") return value >= 0 ? value : undefined;
  if (typeof value !== "string" || !/^\d+(:\d{1,2}){1,2}(\.\d+)?$/.test(value.trim())) return undefined;
  return value.split(":").reduce((sum, part) => 60 * sum + Number(part), 0);
}

function side(value: unknown): ObjectNode[] {
  if (saysNone(value)) return [];
  if (!Array.isArray(value)) throw new FileError("nodes are no list");
  return value.map(objectFrom);
}

/** Read an object; `ingredients` are the contents of `contains`, `container` the relatum of `in`. */
export function objectFrom(item: unknown): ObjectNode {
  if (!isObject(item)) throw new FileError("an object is no object of JSON");
  const label = clean(item.label ?? item.object_label);
  if (label === "" || saysNone(label)) throw new FileError("an object has no label");
  const ingredients = listed(item.ingredients).map((each) => clean(each).replaceAll(/[[\]{}]/g, "")).filter(Boolean);
  let states = listed("object_states" in item ? item.object_states : item.states).map(stateFrom);
  if (ingredients.length > 0) {
    states = states.filter((state) => !(state.name === "contains" && state.relatum === null && state.contents === null));
    states.push(stateOf("contains", null, ingredients));
  }
  const container = saysNone(item.container) ? "" : clean(item.container).replaceAll(/[[\]{}]/g, "").trim();
  if (container !== "") states.push(stateOf("in", container));
  return nodeOf(label, states);
}

function stateFrom(value: unknown): State {
  const related = isObject(value) && !saysNone(value.relative_object) ? clean(value.relative_object) : "";
  const text = clean(isObject(value) ? (value.state_label ?? value.label) : value);
  if (text === "") throw new FileError("a state has no name");
  const [, name = "", detail = ""] = /^([^[\]{}]*)(.*)$/s.exec(related === "" ? text : `${text} [${related}]`)!;
  const contents = /\{([^[\]{}]*)/.exec(detail);
  const relatum = /\[([^[\]{}]*)/.exec(detail)?.[1]?.trim();
  const parted = (each: string): string[] => each.split(",").map((part) => part.trim()).filter(Boolean);
  const bare = name.trim();
  const glued = detail === "" ? GLUED.exec(bare) : null;
  if (glued) return glued[1] === "contains" ? stateOf("contains", null, parted(glued[2]!)) : stateOf(glued[1]!, glued[2]!);
  if (bare === "contains" && contents === null && relatum) return stateOf("contains", null, parted(relatum));
  return stateOf(bare, relatum === undefined || relatum === "" ? null : relatum, contents === null ? null : parted(contents[1]!));
}

const listed = (value: unknown): unknown[] => (Array.isArray(value) ? value.filter((each) => !saysNone(each)) : []);
const saysNone = (value: unknown): boolean => value === null || value === undefined || (typeof value === "string" && ["none", "null", "n/a", ""].includes(value.trim().toLowerCase()));
const clean = (value: unknown): string => (typeof value === "string" ? value.replaceAll(/[\p{Cc}\s]+/gu, " ").trim().toLowerCase() : "");
