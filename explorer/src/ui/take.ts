/** Taking a tree along: as a FOON, as JSON, as PDDL, as a picture, and as the command line that gives the same. */

import type { Tree } from "../foon/tree";
import { foonJson, foonText, kitchenJson, pddl } from "../foon/write";
import { Problem, named } from "../solve/problem";
import { commandLine, writeState } from "../state";
import type { App } from "./app";
import { button, h, save } from "./dom";
import { MOST_NODES, draw, standalone, treeGraph } from "./picture";

export function takeView(app: App, tree: Tree): HTMLElement {
  const { world } = app;
  const name = (world.node(tree.goals[0]!).label.match(/[a-z0-9]+/g) ?? ["tree"]).join("-");
  const changed = app.kitchenChanged;
  const command = app.opened ? commandLine(app.state, ["--foon", world.row.title, ...app.data.options], changed) : commandLine(app.state, app.data.options, changed);
  const sliced = new Problem(world, tree.goals, true, named(app.state.constraints, app.data.diets)).units;
  const goals = tree.goals.map((goal) => world.text(goal)).join("; ");
  const graph = treeGraph(app, tree);
  const item = (title: string, text: string, ...buttons: HTMLElement[]): HTMLElement => h("li", { class: "card" }, h("h3", {}, title), h("p", { class: "hint" }, text), h("div", { class: "row" }, buttons));
  const problem = pddl(world, sliced, tree);
  return h(
    "div",
    {},
    h(
      "section",
      { class: "card" },
      h("h3", {}, "The same on the command line"),
      h("pre", { class: "command", tabindex: 0, role: "region", "aria-label": "Command line" }, command),
      h(
        "div",
        { class: "row" },
        button("Copy", () => void copy(app, command)),
        changed && button("Save kitchen.json", () => save("kitchen.json", kitchenJson(world), "application/json"), { class: "plain" }),
      ),
      changed && h("p", { class: "hint" }, "The kitchen was changed here: the command takes it from kitchen.json."),
      tree.goals.length > 1 && app.state.count > 1 && h("p", { class: "hint" }, "The command prints only the best tree of a menu."),
      app.state.tree > 0 && tree.goals.length === 1 && h("p", { class: "hint" }, "It prints all trees that were asked for; where several are equally good, their order may differ."),
    ),
    h(
      "ul",
      { class: "take" },
      item("FOON", "The steps as a FOON file of their own, which foon-asp and the programs of the field read.", button("Save as text", () => save(`${name}.txt`, foonText(world, tree.units, [`A task tree for ${goals}`])), { "data-key": "save-text" })),
      item("JSON", "The same as a list of functional units.", button("Save as JSON", () => save(`${name}.json`, foonJson(world, tree.units), "application/json"), { "data-key": "save-json" })),
      graph.nodes.length <= MOST_NODES && item("Picture", "The tree as it is drawn here, to be enlarged without loss.", button("Save as SVG", () => void draw(app, graph, goals).then((picture) => save(`${name}.svg`, standalone(picture), "image/svg+xml")), { "data-key": "save-svg" })),
      item(
        "PDDL",
        `Domain and problem for planners, of the ${sliced.length} units that can matter. Nothing is used up in it; “foon-asp pddl export” has more styles.`,
        button("Save domain", () => save("domain.pddl", problem.domain), { "data-key": "save-domain" }),
        button("Save problem", () => save("problem.pddl", problem.problem), { "data-key": "save-problem" }),
      ),
      item("Link", "The address of this page holds the whole question. Whoever has this file sees the same.", button("Copy link", () => void copy(app, `${location.href.split("#")[0]}#${writeState(app.state)}`), { "data-key": "copy-link" })),
    ),
  );
}

async function copy(app: App, text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    app.notice = "Copied.";
  } catch {
    app.notice = "This browser does not let a page copy; the text can be selected.";
  }
  app.say(app.notice);
  app.render();
}
