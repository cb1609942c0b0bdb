/** Object nodes as values: written the way that people write goals, and told apart. Mirrors `model/notation.py`. */

import type { NodeRow, StateRow } from "./data";

const PLACES = new Set(["in", "on", "under", "with", "inside", "attached to", "around", "between"]);
const PLACE = /(?:^|\s)(attached to|around|between|in|inside|on|under|with)(?=\s+\S)/g;
const PLACE_AT_END = /\s(attached to|around|between|in|inside|on|under|with|contains)$/;

export interface State {
  readonly name: string;
  readonly relatum: string | null;
  readonly contents: readonly string[] | null;
}

export interface ObjectNode {
  readonly label: string;
  readonly states: readonly State[];
}

/** Compare texts by code points, as Python does. */
export function compareText(one: string, other: string): number {
  const [left, right] = [Array.from(one), Array.from(other)];
  for (let place = 0; place < Math.min(left.length, right.length); place += 1) {
    const difference = (left[place] as string).codePointAt(0)! - (right[place] as string).codePointAt(0)!;
    if (difference !== 0) return difference;
  }
  return left.length - right.length;
}

export function stateOf(name: string, relatum: string | null = null, contents: readonly string[] | null = null): State {
  return { name, relatum, contents: contents === null ? null : [...contents].sort(compareText) };
}

const isPlain = (state: State): boolean => state.relatum === null && state.contents === null;
const inBraces = (state: State): boolean => state.name === "contains" && state.relatum === null && state.contents !== null;

function compareStates(one: State, other: State): number {
  const kind = (state: State): number => (isPlain(state) ? 0 : state.contents === null ? 1 : 2);
  return (
    kind(one) - kind(other) ||
    compareText(one.name, other.name) ||
    compareText(one.relatum ?? "", other.relatum ?? "") ||
    compareLists(one.contents ?? [], other.contents ?? [])
  );
}

function compareLists(one: readonly string[], other: readonly string[]): number {
  for (let place = 0; place < Math.min(one.length, other.length); place += 1) {
    const difference = compareText(one[place]!, other[place]!);
    if (difference !== 0) return difference;
  }
  return one.length - other.length;
}

/** Make a node with its states in their canonical order, each once. */
export function nodeOf(label: string, states: readonly State[]): ObjectNode {
  const sorted = [...states].sort(compareStates);
  return { label, states: sorted.filter((state, place) => place === 0 || compareStates(state, sorted[place - 1]!) !== 0) };
}

export const nodeFromRow = ([label, states]: NodeRow): ObjectNode => ({
  label,
  states: states.map(([name, relatum, contents]) => ({ name, relatum, contents })),
});

export const nodeToRow = (node: ObjectNode): NodeRow => [
  node.label,
  node.states.map((state): StateRow => [state.name, state.relatum, state.contents === null ? null : [...state.contents]]),
];

/** A text that two nodes share only if they are equal. */
export const keyOf = (node: ObjectNode): string => JSON.stringify(nodeToRow(node));

/** The contents of `contains`, sorted. */
export const contentsOf = (node: ObjectNode): string[] =>
  node.states.flatMap((state) => (state.name === "contains" ? [...(state.contents ?? [])] : [])).sort(compareText);

/** Every label that the node names: its own, those of relata and of contents. */
export const namedLabels = (node: ObjectNode): string[] => [
  node.label,
  ...node.states.flatMap((state) => [...(state.relatum === null ? [] : [state.relatum]), ...(state.contents ?? [])]),
];

/** The labels that take part where the node is listed: its own, and those of relata. */
export const handledLabels = (node: ObjectNode): string[] => [
  node.label,
  ...node.states.flatMap((state) => (state.relatum === null ? [] : [state.relatum])),
];

/** The node with all its relations called `in`. */
export function loosened(node: ObjectNode): ObjectNode {
  return nodeOf(
    node.label,
    node.states.map((state) => (state.relatum !== null && state.contents === null ? stateOf("in", state.relatum) : state)),
  );
}

/** Write the node the way a goal is written: `label [state, state] {content} in [container]`. */
export function writeNode(node: ObjectNode): string {
  const plain = node.states.filter(isPlain).map((state) => state.name);
  const braces = node.states.filter(inBraces);
  const others = node.states.filter((state) => !isPlain(state) && !inBraces(state));
  const parts: string[] = [];
  if (plain.length > 0) parts.push(`[${listed(plain)}]`);
  parts.push(...braces.map((state) => `{${listed(state.contents ?? [])}}`));
  const unclear = parts.length === 0 && others.length > 0 && !PLACES.has(others[0]!.name);
  parts.push(...others.map(writeState));
  const label = unclear || unclearLabel(node.label, parts.length === 0) ? inQuotes(node.label) : node.label;
  return [label, ...parts].join(" ");
}

/** Write what a node says beside its label. */
export const writeStates = (node: ObjectNode): string => writeNode({ label: "x", states: node.states }).replace(/^"?x"? ?/, "");

function writeState(state: State): string {
  let text = word(state.name, /[[\]{}]/);
  if (state.relatum !== null) {
    text += ` [${word(state.relatum, /[[\]{}]/)}]`;
    return state.contents === null ? text : `${text}{${listed(state.contents)}}`;
  }
  return state.contents === null ? text : `${text} {${listed(state.contents)}}`;
}

const listed = (items: readonly string[]): string => items.map((item) => word(item, /[[\]{},]/)).join(", ");
const tidy = (text: string): string => text.toLowerCase().split(/\s+/).filter(Boolean).join(" ");
const inQuotes = (text: string): string => `"${text.replaceAll('"', '""')}"`;

function word(text: string, signs: RegExp): string {
  const bare = text !== "" && !text.startsWith('"') && !signs.test(text) && text === tidy(text);
  return bare ? text : inQuotes(text);
}

function unclearLabel(label: string, alone: boolean): boolean {
  if (word(label, /[[\]{}]/) !== label || PLACE_AT_END.test(label)) return true;
  return alone && [...label.matchAll(PLACE)].some((match) => match.index > 0);
}
