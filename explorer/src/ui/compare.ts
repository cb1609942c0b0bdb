/** All methods side by side (the paper's table for one dish), and two trees over each other. */

import type { Tree } from "../foon/tree";
import { FREE } from "../solve/problem";
import type { Query } from "../solve/query";
import { Stopped } from "../solve/solver";
import type { App } from "./app";
import { unitLink } from "./detail";
import { button, counted, h } from "./dom";
import { graphPicture, treeGraph, type Side } from "./picture";
import { COST_NAMES, costText } from "./words";
import { treeOf } from "../foon/tree";

interface Row {
  readonly name: string;
  readonly tree: Tree | null;
  readonly proven: boolean;
}

/** What is asked of each method, as `foon-asp compare` asks it. */
const METHODS: readonly { readonly name: string; readonly ask: Partial<Query>; readonly rates?: true }[] = [
  { name: "Optimal, fewest steps", ask: { method: "optimal", by: ["units"] } },
  { name: "Optimal, likeliest", ask: { method: "optimal", by: ["success"] }, rates: true },
  { name: "Greedy by success", ask: { method: "greedy", by: ["success"] }, rates: true },
  { name: "Greedy by inputs", ask: { method: "greedy", by: ["inputs"] } },
  { name: "Iterative deepening", ask: { method: "ids", by: ["units"] } },
  { name: "First in the file", ask: { method: "first", by: ["units"] } },
  { name: "First, as published", ask: { method: "first", by: ["units"], founded: false } },
  { name: "Greedy by success, as published", ask: { method: "greedy", by: ["success"], founded: false }, rates: true },
  { name: "Greedy by inputs, as published", ask: { method: "greedy", by: ["inputs"], founded: false } },
];

interface Compared {
  rows: Row[];
  done: boolean;
}

export function compareView(app: App, tree: Tree): HTMLElement {
  const found = (app.kept.get("compared") as Compared | undefined) ?? begin(app);
  const rows: Row[] = [{ name: app.state.count > 1 ? `Shown: tree ${app.state.tree + 1}` : "Shown", tree, proven: app.answer?.status === "optimal" }, ...found.rows];
  const chosen = (app.kept.get("chosen") as [number, number] | undefined) ?? [0, Math.max(0, rows.findIndex((row) => row.tree !== null && row.tree.units.join() !== tree.units.join()))];
  const choose = (side: 0 | 1, row: number): void => {
    app.kept.set("chosen", side === 0 ? [row, chosen[1]] : [chosen[0], row]);
    app.renderMain();
  };
  const best = Math.min(...rows.filter((row) => row.tree?.replay.executable === true).map((row) => row.tree!.units.length));
  const columns = (["units", "depth", "success", "inputs", "tools", "dirty"] as const).filter((each) => each !== "success" || app.world.hasRates);
  const radio = (side: 0 | 1, place: number, row: Row): HTMLElement =>
    h(
      "td",
      { class: "pick" },
      row.tree !== null &&
        h("input", { type: "radio", name: side === 0 ? "tree-a" : "tree-b", checked: chosen[side] === place, "aria-label": `${side === 0 ? "A" : "B"}: ${row.name}`, "data-key": `pick-${side}-${place}`, change: () => choose(side, place) }),
    );
  return h(
    "div",
    {},
    h(
      "div",
      { class: "scroll", tabindex: 0, role: "region", "aria-label": "Methods side by side" },
      h(
        "table",
        { class: "methods" },
        h("thead", {}, h("tr", {}, h("th", { scope: "col" }, "Method"), columns.map((each) => h("th", { scope: "col", class: "number" }, COST_NAMES[each])), h("th", { scope: "col" }, "Can be executed"), h("th", { scope: "col", class: "pick" }, "A"), h("th", { scope: "col", class: "pick" }, "B"))),
        h(
          "tbody",
          {},
          rows.map((row, place) =>
            h(
              "tr",
              {},
              h("th", { scope: "row" }, row.name),
              row.tree === null
                ? h("td", { colspan: columns.length + 1 }, "no tree")
                : [
                    columns.map((each) => h("td", { class: each === "units" && row.tree?.units.length === best ? "number best" : "number" }, costText(each, row.tree!.costs[each]))),
                    h("td", {}, row.tree.replay.executable ? (row.proven ? "✓ yes, proven optimal" : "✓ yes") : "✗ no, it goes in circles or lacks something"),
                  ],
              radio(0, place, row),
              radio(1, place, row),
            ),
          ),
        ),
      ),
    ),
    found.done ? null : h("p", { class: "hint" }, "Asking the other methods… ", button("Stop", () => app.solver.stop(), { class: "plain" })),
    h("p", { class: "hint" }, "The limits of the question hold for all methods, but for those “as published”: these are read as the published programs do, which may go in circles."),
    difference(app, rows[chosen[0]]?.tree ?? null, rows[chosen[1]]?.tree ?? null, [rows[chosen[0]]?.name ?? "", rows[chosen[1]]?.name ?? ""]),
  );
}

function begin(app: App): Compared {
  const found: Compared = { rows: [], done: false };
  app.kept.set("compared", found);
  void fill(app, found);
  return found;
}

async function fill(app: App, found: Compared): Promise<void> {
  const current = (): boolean => app.kept.get("compared") === found;
  try {
    for (const { name, ask, rates } of METHODS) {
      if (rates && !app.world.hasRates) continue;
      const free = ask.founded === false ? { constraints: FREE } : {};
      const answer = await app.retriever.retrieve(app.world, app.query({ count: 1, founded: true, ...ask, ...free }));
      if (!current()) return;
      if (answer.status === "limit") break;
      found.rows.push({ name, tree: answer.trees[0] ?? null, proven: answer.status === "optimal" });
      app.renderMain();
    }
  } catch (error) {
    if (!(error instanceof Stopped)) app.trouble = (error as Error).message;
  }
  found.done = true;
  if (current()) app.renderMain();
}

/** What two trees share, and what only one of them has: as lists, and drawn over each other. */
function difference(app: App, one: Tree | null, other: Tree | null, names: readonly [string, string]): HTMLElement {
  if (one === null || other === null) return h("p", {}, "");
  const sides = new Map<number, Side>(one.units.map((unit) => [unit, other.units.includes(unit) ? "both" : "one"]));
  for (const unit of other.units) if (!sides.has(unit)) sides.set(unit, "other");
  const only = (side: Side): number[] => [...sides].filter(([, each]) => each === side).map(([unit]) => unit);
  const list = (title: string, units: readonly number[]): HTMLElement =>
    h("div", {}, h("h4", {}, title, " ", h("span", { class: "count" }, units.length)), units.length === 0 ? h("p", { class: "hint" }, "nothing") : h("ul", { class: "lines" }, units.map((unit) => h("li", {}, unitLink(app, unit), h("span", { class: "states" }, ` ${app.world.readings.makes[unit]!.map((made) => app.world.node(made).label).join(", ")}`)))));
  const union = treeOf(app.world, one.goals, sides.keys());
  const same = only("one").length + only("other").length === 0;
  return h(
    "section",
    { class: "difference" },
    h("h3", {}, "Two trees over each other"),
    h("p", {}, h("b", {}, "A"), ` ${names[0]} · `, h("b", {}, "B"), ` ${names[1]}: `, same ? "they have the same steps." : `${counted(only("both").length, "step")} shared.`),
    !same && h("div", { class: "two" }, list("Only in A", only("one")), list("Only in B", only("other"))),
    !same && graphPicture(app, treeGraph(app, union, sides), "Two trees over each other"),
  );
}

