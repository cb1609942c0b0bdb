/**
 * A FOON seen from a kitchen, on one numbering. It never changes: another kitchen is another world.
 *
 * What units need and make mirrors `model/units.py` and `encodings/units.lp`; a test holds them equal.
 */

import type { NodeRow, UnitRow, WorldRow } from "./data";
import { contentsOf, handledLabels, keyOf, loosened, namedLabels, nodeFromRow, nodeToRow, writeNode, type ObjectNode } from "./node";
import { forward, type Closure } from "./graph";

/** What units need, make and are made by; it does not depend on what is at hand. */
export interface Readings {
  readonly needs: readonly (readonly number[])[];
  readonly makes: readonly (readonly number[])[];
  readonly takes: readonly (readonly number[])[];
  readonly makers: ReadonlyMap<number, readonly number[]>;
  readonly users: ReadonlyMap<number, readonly number[]>;
  /** The object as which each one is read. */
  readonly readAs: readonly number[];
}

interface Fixed {
  readonly row: WorldRow;
  readonly nodes: readonly ObjectNode[];
  readonly texts: readonly string[];
  readonly byKey: ReadonlyMap<string, number>;
  readonly utensils: ReadonlySet<string>;
  readonly readings: Readings;
  readonly rates: readonly (number | null)[];
}

export class World {
  private knownClosure: Closure | undefined;

  private constructor(
    private readonly fixed: Fixed,
    /** Numbers of the objects at hand. */
    readonly stock: ReadonlySet<number>,
  ) {}

  static of(row: WorldRow): World {
    const nodes = row.objects.map(nodeFromRow);
    const utensils = new Set(row.kitchen.utensils);
    const readings = readingsOf(row, nodes, utensils);
    const fixed: Fixed = {
      row,
      nodes,
      texts: nodes.map(writeNode),
      byKey: new Map(nodes.map((node, number) => [keyOf(node), number])),
      utensils,
      readings,
      rates: row.units.map((unit) => unit.rate ?? rateOf(row, unit.motion)),
    };
    return new World(fixed, new Set(row.kitchen.objects));
  }

  /** See the same FOON from a kitchen with other objects at hand. */
  withStock(stock: Iterable<number>): World {
    return new World(this.fixed, new Set(stock));
  }

  get row(): WorldRow {
    return this.fixed.row;
  }

  get units(): readonly UnitRow[] {
    return this.fixed.row.units;
  }

  get nodes(): readonly ObjectNode[] {
    return this.fixed.nodes;
  }

  get utensils(): ReadonlySet<string> {
    return this.fixed.utensils;
  }

  get readings(): Readings {
    return this.fixed.readings;
  }

  get labelsOnly(): boolean {
    return this.row.level === 1;
  }

  /** All that the kitchen can make, and all units that it can execute. */
  get closure(): Closure {
    this.knownClosure ??= forward(this.readings, this.stock);
    return this.knownClosure;
  }

  unit(number: number): UnitRow {
    return this.units[number] as UnitRow;
  }

  node(number: number): ObjectNode {
    return this.fixed.nodes[number] as ObjectNode;
  }

  /** The object as people write it. */
  text(number: number): string {
    return this.fixed.texts[number] as string;
  }

  /** The number of an object that is written exactly so; undefined if there is none. */
  named(text: string): number | undefined {
    const number = this.fixed.texts.indexOf(text);
    return number < 0 ? undefined : number;
  }

  numberOf(node: ObjectNode): number | undefined {
    return this.fixed.byKey.get(keyOf(node));
  }

  numberOfRow(row: NodeRow): number | undefined {
    return this.fixed.byKey.get(JSON.stringify(row));
  }

  /** The chance that a unit succeeds, null where nothing says it. */
  rate(unit: number): number | null {
    return this.fixed.rates[unit] ?? null;
  }

  /** What the motion of a unit costs, null where nothing says it. */
  cost(unit: number): number | null {
    return this.row.kitchen.costs[simple(this.unit(unit).motion)] ?? this.row.kitchen.default_cost;
  }

  get hasCosts(): boolean {
    return Object.keys(this.row.kitchen.costs).length > 0 || this.row.kitchen.default_cost !== null;
  }

  get hasRates(): boolean {
    return this.fixed.rates.some((rate) => rate !== null);
  }

  listed(unit: number): number[] {
    return [...this.unit(unit).inputs, ...this.unit(unit).outputs];
  }

  /** The utensils that some units handle. */
  handled(units: Iterable<number>): Set<string> {
    return this.utensilsOf(units, (node) => handledLabels(node));
  }

  /** The utensils that hold something in some units. */
  filled(units: Iterable<number>): Set<string> {
    return this.utensilsOf(units, (node) => [
      ...(contentsOf(node).length > 0 ? [node.label] : []),
      ...node.states.flatMap((state) => (state.name === "in" && state.relatum !== null ? [state.relatum] : [])),
    ]);
  }

  private utensilsOf(units: Iterable<number>, labels: (node: ObjectNode) => string[]): Set<string> {
    const found = new Set<string>();
    for (const unit of units) {
      for (const number of this.listed(unit)) {
        for (const label of labels(this.node(number))) if (this.utensils.has(label)) found.add(label);
      }
    }
    return found;
  }

  /** Whether nothing has been done to an object: no unit makes it, or it is a utensil with nothing in it. */
  isRaw(number: number): boolean {
    const node = this.node(number);
    return (
      !this.readings.makers.has(number) ||
      (this.utensils.has(node.label) &&
        !node.states.some((state) => state.relatum !== null || (state.contents?.length ?? 0) > 0 || state.name === "contains"))
    );
  }

  isTool(number: number): boolean {
    const node = this.node(number);
    return node.states.length === 0 || (this.utensils.has(node.label) && contentsOf(node).length === 0);
  }

  /** Where a unit was read first, as `file:line`. */
  source(unit: number): string {
    const first = this.unit(unit).sources[0];
    if (first === undefined || first[0] < 0) return "";
    const file = this.row.files[first[0]] ?? "";
    return first[1] > 0 ? `${file}:${first[1]}` : file;
  }

  /** The videos that a unit was seen in. */
  videos(unit: number): string[] {
    return [...new Set(this.unit(unit).sources.map((source) => this.row.videos[source[2]] ?? "").filter(Boolean))];
  }

  /** A row like the one it was made of, with the objects that are at hand now. */
  toRow(): WorldRow {
    return { ...this.row, objects: this.nodes.map(nodeToRow), kitchen: { ...this.row.kitchen, objects: [...this.stock] } };
  }
}

/** Round as Python does: half to even. */
export function round(value: number): number {
  const floor = Math.floor(value);
  if (value - floor !== 0.5) return Math.round(value);
  return floor % 2 === 0 ? floor : floor + 1;
}

const simple = (motion: string): string => motion.replace(/\*+$/, "").trimEnd();

function rateOf(row: WorldRow, motion: string): number | null {
  return row.kitchen.rates[simple(motion)] ?? row.kitchen.default_rate;
}

function readingsOf(row: WorldRow, nodes: readonly ObjectNode[], utensils: ReadonlySet<string>): Readings {
  const readAs = standIns(row, nodes);
  const read = (ports: readonly number[]): number[] => [...new Set(ports.map((port) => readAs[port] as number))];
  const takes = row.units.map((unit) => read(unit.inputs));
  const labelsOnly = row.level === 1;
  const needs = takes.map((ports) => (row.strict ? ports : ports.filter((port) => !isImplied(port, ports, nodes, utensils, row.loose))));
  const makes = row.units.map((unit, number) => read(unit.outputs).filter((port) => labelsOnly || !isListedAgain(nodes[port]!, takes[number]!, nodes, utensils)));
  return { needs, makes, takes, makers: inverse(makes), users: inverse(needs), readAs };
}

/** For each object the first that differs from it only in the names of relations; itself unless matched loosely. */
function standIns(row: WorldRow, nodes: readonly ObjectNode[]): number[] {
  if (!row.loose) return nodes.map((_, number) => number);
  const first = new Map<string, number>();
  return nodes.map((node, number) => {
    const key = keyOf(loosened(node));
    if (!first.has(key)) first.set(key, number);
    return first.get(key) as number;
  });
}

/** Whether an output is bare, and a utensil or of the label of an input of the same unit: the unit does not make it. */
function isListedAgain(node: ObjectNode, takes: readonly number[], nodes: readonly ObjectNode[], utensils: ReadonlySet<string>): boolean {
  return node.states.length === 0 && (utensils.has(node.label) || takes.some((port) => nodes[port]!.label === node.label));
}

/** Whether an input only shows again, from the vessel's side, what another input shows. */
function isImplied(port: number, ports: readonly number[], nodes: readonly ObjectNode[], utensils: ReadonlySet<string>, loose: boolean): boolean {
  const vessel = nodes[port]!;
  const contents = new Set(contentsOf(vessel));
  if (!utensils.has(vessel.label) || contents.size !== 1) return false;
  const [content] = contents;
  return ports.some((other) => {
    const node = nodes[other]!;
    return node.label === content && node.states.some((state) => state.relatum === vessel.label && (loose || state.name === "in"));
  });
}

function inverse(rows: readonly (readonly number[])[]): Map<number, number[]> {
  const found = new Map<number, number[]>();
  rows.forEach((row, number) => {
    for (const each of row) {
      const there = found.get(each);
      if (there === undefined) found.set(each, [number]);
      else there.push(number);
    }
  });
  return found;
}

export const labelsOf = namedLabels;
