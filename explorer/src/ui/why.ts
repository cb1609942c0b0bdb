/** Why there is no tree: what is missing, the circle, the constraint that must give way. */

import type { Answer, Reason } from "../solve/query";
import { named, type Constraints, type NamedConstraint } from "../solve/problem";
import { KIND_WORDS, unitText } from "./ask";
import type { App } from "./app";
import { objectLine, objectLink, unitLink } from "./detail";
import { button, counted, h } from "./dom";
import { graphPicture, type Graph } from "./picture";

export function whyNot(app: App, answer: Answer): Node[] {
  const { reason } = answer;
  const title = h("p", { class: "verdict" }, h("span", { class: "badge bad" }, "no task tree"), " ", sentence(app, reason));
  if (reason === null) return [title];
  if (reason.kind === "constraints") return [title, conflict(app, reason.names)];
  if (reason.kind === "no maker") return [title, h("section", { class: "card" }, h("p", {}, "It can only be there if it is at hand."), button("Put it into the kitchen", () => app.stock(reason.goal, true), { class: "primary" }))];
  return [title, ...lacking(app, reason)];
}

function sentence(app: App, reason: Reason | null): string {
  if (reason === null) return "No task tree exists.";
  if (reason.kind === "no maker") return `No unit makes ${app.world.text(reason.goal)}.`;
  if (reason.kind === "constraints") return "The limits leave none; without them there is one.";
  if (reason.circles.length > 0) return "It is locked in a circle: something is needed to make itself.";
  return "The kitchen lacks something for every way to make it.";
}

function conflict(app: App, names: readonly string[]): HTMLElement {
  const waived = named(app.state.constraints, app.data.diets).filter((each) => names.includes(each.name));
  const give = (): void => {
    const change: Record<string, unknown> = {};
    for (const { key, value } of waived) {
      const now = (change[key] ?? app.state.constraints[key]) as readonly (string | number)[] | number | null;
      change[key] = Array.isArray(now) ? now.filter((each) => each !== value) : null;
    }
    app.constrain(change as Partial<Constraints>);
  };
  return h(
    "section",
    { class: "card" },
    h("h3", {}, "What must give way"),
    h("p", {}, "The fewest limits that can be given up, so that there is a tree:"),
    h("ul", { class: "chips" }, waived.map((each) => h("li", { class: "chip" }, h("span", {}, limitText(app, each))))),
    waived.length > 0 && button(waived.length === 1 ? "Give it up" : "Give them up", give, { class: "primary" }),
  );
}

/** A limit as it stands in the question. */
function limitText(app: App, { key, value, name }: NamedConstraint): string {
  if (key === "max_units" || key === "max_depth") return name;
  return `${KIND_WORDS[key]} ${typeof value === "number" ? unitText(app, value) : value}`;
}

function lacking(app: App, reason: Extract<Reason, { kind: "lacking" }>): Node[] {
  const { add } = reason;
  const parts: Node[] = [];
  if (add !== null && add.length > 0) {
    parts.push(
      h(
        "section",
        { class: "card" },
        h("h3", {}, add.length === 1 ? "One object more would do" : `${counted(add.length, "object")} more would do`),
        h("p", { class: "hint" }, "The least that must be added to the kitchen, raw before prepared; proven."),
        h("ul", { class: "lines" }, add.map((number) => h("li", {}, objectLink(app, number)))),
        button(add.length === 1 ? "Put it into the kitchen" : "Put them into the kitchen", () => app.stockAll(add, true), { class: "primary" }),
      ),
    );
  } else parts.push(h("section", { class: "card" }, h("h3", {}, "Nothing helps"), h("p", {}, "No objects that could be added would make it possible, but for the dish itself.")));
  const [circle] = reason.circles;
  if (circle !== undefined) {
    parts.push(
      h(
        "section",
        { class: "card" },
        h("h3", {}, "The circle"),
        h("p", { class: "hint" }, "Each of these needs the next one, and the last one needs the first; nothing else makes them."),
        h(
          "ol",
          { class: "circle" },
          circle.objects.map((number, place) => h("li", {}, objectLink(app, number), " is made by ", unitLink(app, circle.units[place]!), ", which needs ", objectLink(app, circle.objects[(place + 1) % circle.objects.length]!))),
        ),
        graphPicture(app, circleGraph(app, circle), "The circle"),
      ),
    );
  }
  const units = app.world.readings.makers.get(reason.goal) ?? [];
  parts.push(
    h(
      "section",
      { class: "card" },
      h("h3", {}, "The ways to make it"),
      h(
        "ul",
        { class: "lines" },
        units.map((unit) => {
          const lacks = app.world.readings.needs[unit]!.filter((need) => !app.world.closure.available.has(need));
          return h("li", {}, unitLink(app, unit), " lacks ", lacks.map((need, place) => [place > 0 ? "; " : "", objectLine(app, need).slice(0, 2)]));
        }),
      ),
    ),
  );
  return parts;
}

function circleGraph(app: App, circle: { readonly objects: readonly number[]; readonly units: readonly number[] }): Graph {
  const graph: Graph = { nodes: [], edges: [] };
  circle.objects.forEach((object, place) => {
    const next = circle.objects[(place + 1) % circle.objects.length]!;
    graph.nodes.push({ key: `o${object}`, kind: "object", object, title: app.world.text(object) });
    graph.nodes.push({ key: `u${place}`, kind: "motion", unit: circle.units[place]!, title: app.world.unit(circle.units[place]!).motion });
    graph.edges.push({ from: `u${place}`, to: `o${object}` }, { from: `o${next}`, to: `u${place}` });
  });
  return graph;
}
