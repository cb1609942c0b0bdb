/** Writes trees and kitchens in the formats that `foon-asp` reads. Mirrors `io/text.py` and `io/json.py`. */

import { contentsOf, type ObjectNode, type State } from "./node";
import type { Tree } from "./tree";
import type { World } from "./world";

/** A FOON in text: labels only, one field a tab. */
export function foonText(world: World, units: readonly number[], comments: readonly string[] = []): string {
  const object = (number: number): string[] => {
    const node = world.node(number);
    return [`O\t${node.label}`, ...node.states.map((state) => `S\t${stateFields(state)}`)];
  };
  const lines = [...comments.map((comment) => `# ${comment.replaceAll(/\s+/g, " ")}`), "//"];
  for (const number of units) {
    const unit = world.unit(number);
    lines.push(...unit.inputs.flatMap(object), `M\t${motionLabel(world, number)}`, ...unit.outputs.flatMap(object), "//");
  }
  return `${lines.join("\n")}\n`;
}

/** A FOON as a list of units in JSON. */
export function foonJson(world: World, units: readonly number[]): string {
  const values = units.map((number) => ({
    input_nodes: world.unit(number).inputs.map((port) => objectJson(world.node(port))),
    motion_node: motionLabel(world, number),
    output_nodes: world.unit(number).outputs.map((port) => objectJson(world.node(port))),
  }));
  return `${JSON.stringify(values, null, 2)}\n`;
}

/** The objects at hand, as `--kitchen` takes them. */
export const kitchenJson = (world: World): string =>
  `${JSON.stringify([...world.stock].map((number) => objectJson(world.node(number))), null, 2)}\n`;

const motionLabel = (world: World, unit: number): string => world.unit(unit).motion + (world.unit(unit).composite === true ? "*" : "");

function stateFields({ name, relatum, contents }: State): string {
  return name + (relatum === null ? "" : `\t[${relatum}]`) + (contents === null ? "" : `\t{${contents.join(",")}}`);
}

interface ObjectJson {
  readonly label: string;
  readonly states: readonly string[];
  readonly ingredients: readonly string[];
  readonly container: string | null;
}

function objectJson(node: ObjectNode): ObjectJson {
  const places = node.states.filter((state) => state.name === "in" && state.relatum !== null && state.contents === null);
  const full = node.states.filter((state) => state.name === "contains" && state.relatum === null && (state.contents?.length ?? 0) > 0);
  const container = places.length === 1 ? places[0]! : undefined;
  const contains = full.length === 1 ? full[0]! : undefined;
  const others = node.states.filter((state) => state !== container && state !== contains);
  return { label: node.label, states: others.map(stateText), ingredients: contains === undefined ? [] : contentsOf(node), container: container?.relatum ?? null };
}

const stateText = ({ name, relatum, contents }: State): string =>
  name + (relatum === null ? "" : ` [${relatum}]`) + (contents === null ? "" : ` {${contents.join(", ")}}`);

/** Domain and problem of PDDL: a fluent for each object, an action for each unit, and nothing is used up. */
export function pddl(world: World, units: readonly number[], tree: Tree): { domain: string; problem: string } {
  const { readings, stock } = world;
  const objects = [...new Set([...units.flatMap((unit) => [...readings.needs[unit]!, ...readings.makes[unit]!]), ...tree.goals])].sort((a, b) => a - b);
  const fluents = names(objects, (number) => world.text(number));
  const actions = names(units, (unit) => `${world.unit(unit).motion} ${world.unit(unit).id}`);
  const all = (numbers: readonly number[]): string => `(and${numbers.map((number) => ` (${fluents.get(number)})`).join("")})`;
  const domain = [
    "; Functional units as actions; nothing is used up.",
    "(define (domain foon)",
    "  (:requirements :strips)",
    `  (:predicates${objects.map((number) => `\n    (${fluents.get(number)})`).join("")})`,
    ...units.map((unit) =>
      [
        `  ; ${comment(world.source(unit))} ${comment(world.unit(unit).motion)}`,
        `  (:action ${actions.get(unit)}`,
        "    :parameters ()",
        `    :precondition ${all(readings.needs[unit]!)}`,
        `    :effect ${all(readings.makes[unit]!)})`,
      ].join("\n"),
    ),
    ")",
  ];
  const problem = [
    `; Get ${tree.goals.map((goal) => comment(world.text(goal))).join("; ")}.`,
    "(define (problem get)",
    "  (:domain foon)",
    `  (:init${objects.filter((number) => stock.has(number)).map((number) => `\n    (${fluents.get(number)})`).join("")})`,
    `  (:goal ${all(tree.goals)}))`,
  ];
  return { domain: `${domain.join("\n")}\n`, problem: `${problem.join("\n")}\n` };
}

const comment = (text: string): string => text.replaceAll(/\s+/g, " ");

/** A name of PDDL for each number, no two the same. */
function names(numbers: readonly number[], text: (number: number) => string): Map<number, string> {
  const taken = new Set<string>();
  return new Map(
    numbers.map((number) => {
      const plain = text(number).toLowerCase().replaceAll(/[^a-z0-9]+/g, "-").replaceAll(/^-+|-+$/g, "").slice(0, 80);
      const base = /^[a-z]/.test(plain) ? plain : `x-${plain}`;
      let name = base;
      for (let count = 2; taken.has(name); count += 1) name = `${base}-${count}`;
      taken.add(name);
      return [number, name];
    }),
  );
}

