/** The main part: how it ended, and one view of it. */

import type { Tree } from "../foon/tree";
import { VIEWS, type View } from "../state";
import type { App } from "./app";
import { compareView } from "./compare";
import { showObject } from "./detail";
import { button, h } from "./dom";
import { kitchenView } from "./kitchen";
import { pictureView } from "./picture";
import { startView } from "./start";
import { stepsView } from "./steps";
import { takeView } from "./take";
import { tradeOffsView } from "./tradeoffs";
import { whyNot } from "./why";
import { costName, costText, worthSaying } from "./words";
import { writeStates } from "../foon/node";

const TABS: Readonly<Record<View, string>> = {
  steps: "Steps",
  picture: "Picture",
  compare: "Compare",
  "trade-offs": "Trade-offs",
  "take-along": "Take along",
  kitchen: "Kitchen",
};

export function mainView(app: App): (Node | false)[] {
  const notice = app.notice !== "" && h("p", { class: "notice" }, h("span", { class: "grow" }, app.notice), button("×", () => ((app.notice = ""), app.render()), { class: "remove", "aria-label": "Close this message" }));
  if (app.state.view === "kitchen") return [notice, kitchenView(app)];
  if (app.state.goals.length === 0) return [notice, startView(app)];
  if (app.goals.length === 0) return [notice, h("p", { class: "card trouble" }, app.trouble), startView(app)];
  return [notice, ...answered(app)];
}

function answered(app: App): Node[] {
  const { answer, running } = app;
  const head = h("div", { class: "headline" }, app.goals.map((goal) => headlineOf(app, goal)));
  if (app.trouble !== "") return [head, h("p", { class: "card trouble" }, app.trouble)];
  if (answer === undefined) return [head, running === undefined ? h("p", {}) : searching(app)];
  if (answer.status === "unreachable") return [head, ...whyNot(app, answer)];
  const tree = shownTree(app);
  if (tree === undefined) return [head, h("p", { class: "card" }, "It was stopped before there was a tree. ", button("Ask again", () => app.again()))];
  return [head, badge(app, tree), ...treeChoice(app), tabs(app), panel(app, tree)];
}

function headlineOf(app: App, goal: number): Node[] {
  const node = app.world.node(goal);
  return [
    h("h2", {}, h("span", { class: "label" }, node.label), " ", h("span", { class: "states" }, writeStates(node))),
    h("button", { type: "button", class: "plain about-it", "data-key": `about-${goal}`, click: () => showObject(app, goal) }, "Who makes it, and who needs it"),
  ];
}

/** The tree that is looked at. */
export const shownTree = (app: App): Tree | undefined => app.answer?.trees[app.state.tree] ?? app.answer?.trees[0];

function searching(app: App): HTMLElement {
  if (app.running === undefined || performance.now() - app.running.since < 250) return h("p", { class: "searching" });
  return h(
    "div",
    { class: "card searching" },
    h("progress", { "aria-label": "Searching" }),
    h("p", { id: "progress" }, progressText(app)),
    button("Stop", () => app.solver.stop(), { class: "primary" }),
  );
}

function progressText(app: App): string {
  const { running } = app;
  const seconds = running === undefined ? 0 : (performance.now() - running.since) / 1000;
  const [first = "units"] = app.state.by;
  const better = running?.progress.better;
  const said = better ? `The best tree so far: ${costText(first, better.costs[first])} ${costName(first, better.costs[first])}.` : "No tree so far.";
  return [`Searching for ${seconds.toFixed(1)} s.`, said, boundText(app, running?.progress.bound ?? null)].join(" ").trim();
}

/** What is proven of every tree by the first criterion. */
function boundText(app: App, bound: number | null): string {
  const [first = "units"] = app.state.by;
  if (bound === null || (first !== "success" && bound === 0)) return "";
  return `Proven: ${first === "success" ? "at most" : "at least"} ${costText(first, bound)} ${costName(first, bound)}.`;
}

/** Bring the progress that is shown up to date; false if none is shown. */
export function tellProgress(app: App): boolean {
  const line = document.getElementById("progress");
  if (line !== null) line.textContent = progressText(app);
  return line !== null;
}

function badge(app: App, tree: Tree): HTMLElement {
  const { answer } = app;
  const proof =
    answer?.status === "optimal"
      ? h("span", { class: "badge good" }, "✓ proven optimal")
      : answer?.status === "limit"
        ? h("span", { class: "badge" }, `stopped. ${boundText(app, answer.bound) || "Nothing is proven."}`)
        : h("span", { class: "badge" }, "found, not proven");
  return h(
    "div",
    { class: "summary" },
    h("dl", { class: "costs" }, worthSaying(tree.costs).map((each) => h("div", { class: app.state.by[0] === each ? "first" : "" }, h("dt", {}, costName(each, tree.costs[each])), h("dd", {}, costText(each, tree.costs[each]))))),
    h(
      "p",
      { class: "proof" },
      proof,
      tree.replay.executable
        ? h("span", { class: "badge good" }, "✓ replayed")
        : h("span", { class: "badge bad" }, `cannot be executed${tree.replay.missing.length > 0 ? `: ${tree.replay.missing.slice(0, 2).map((each) => app.world.text(each)).join("; ")} is missing` : ""}`),
      h("span", { class: "states" }, ` ${Math.max(1, Math.round(answer?.time ?? 0)).toLocaleString("en")} ms`),
    ),
  );
}

function treeChoice(app: App): Node[] {
  const trees = app.answer?.trees ?? [];
  if (app.state.count === 1) return [];
  const said = app.answer?.complete === true && trees.length < app.state.count ? h("p", { class: "hint" }, `There ${trees.length === 1 ? "is no other tree" : "are no others"}.`) : "";
  return [
    h(
      "div",
      { class: "trees", role: "group", "aria-label": "Trees, the best first" },
      trees.map((tree, place) =>
        h(
          "button",
          { type: "button", "aria-pressed": place === Math.min(app.state.tree, trees.length - 1) ? "true" : "false", "data-key": `tree-${place}`, click: () => app.set({ tree: place }) },
          h("b", {}, place + 1),
          ` ${app.state.by.map((each) => `${costText(each, tree.costs[each])} ${costName(each, tree.costs[each])}`).join(", ")}`,
        ),
      ),
      said,
    ),
  ];
}

function tabs(app: App): HTMLElement {
  const shown = VIEWS.filter((view) => view !== "kitchen" && (view !== "trade-offs" || app.state.method === "optimal"));
  const go = (view: View): void => {
    app.set({ view });
    document.getElementById(`tab-${view}`)?.focus();
  };
  return h(
    "div",
    { class: "tabs", role: "tablist", "aria-label": "Views" },
    shown.map((view, place) =>
      h(
        "button",
        {
          type: "button",
          role: "tab",
          id: `tab-${view}`,
          "aria-selected": view === app.state.view ? "true" : "false",
          "aria-controls": "panel",
          tabindex: view === app.state.view ? 0 : -1,
          "data-key": `tab-${view}`,
          click: () => go(view),
          keydown: (event) => {
            const step = { ArrowRight: 1, ArrowLeft: -1 }[(event as KeyboardEvent).key];
            if (step !== undefined) go(shown[(place + step + shown.length) % shown.length]!);
          },
        },
        TABS[view],
      ),
    ),
  );
}

const PANELS: Readonly<Record<Exclude<View, "kitchen">, (app: App, tree: Tree) => HTMLElement>> = {
  steps: stepsView,
  picture: pictureView,
  compare: compareView,
  "trade-offs": tradeOffsView,
  "take-along": takeView,
};

function panel(app: App, tree: Tree): HTMLElement {
  const view = app.state.view === "kitchen" ? "steps" : app.state.view;
  return h("div", { role: "tabpanel", id: "panel", "aria-labelledby": `tab-${view}`, tabindex: 0 }, PANELS[view](app, tree));
}
