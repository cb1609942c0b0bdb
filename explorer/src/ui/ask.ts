/** The question: what to make, how, what to do without, and the kitchen in short. */

import { writeStates } from "../foon/node";
import { CRITERIA, type Criterion } from "../foon/tree";
import { findTexts } from "../search";
import { METHODS } from "../solve/query";
import { MOST_TREES } from "../state";
import type { App } from "./app";
import { combobox, type Suggestion } from "./combobox";
import { objectLine } from "./detail";
import { button, counted, h } from "./dom";
import { CRITERION_NAMES, METHOD_NAMES, METHOD_NOTES } from "./words";
import type { Constraints } from "../solve/problem";

export function askPanel(app: App): Node[] {
  // At first the question stands in the middle of the page.
  const first = app.state.goals.length === 0 && app.state.view !== "kitchen";
  return [...(first ? [] : [goalPart(app)]), howPart(app), withoutPart(app), kitchenPart(app)];
}

export function objectSuggestions(app: App, text: string, most = 12): Suggestion[] {
  const goals = new Set(app.world.row.goals);
  const { closure, readings } = app.world;
  const prefer = (number: number): number => (goals.has(number) ? 0.3 : 0) + (readings.makers.has(number) ? 0.1 : 0) + (closure.available.has(number) ? 0.05 : 0);
  return app.index.find(text, most, prefer).map(({ number }) => ({ value: app.world.text(number), show: () => objectLine(app, number) }));
}

function goalPart(app: App): HTMLElement {
  const several = app.state.goals.length > 0;
  return h(
    "section",
    { class: "card" },
    h("h2", {}, "Make"),
    several &&
      h(
        "ul",
        { class: "chips" },
        app.state.goals.map((text) =>
          h("li", { class: "chip goal" }, goalText(app, text), remover(`Do not make ${text}`, () => app.set({ goals: app.state.goals.filter((each) => each !== text), tree: 0 }))),
        ),
      ),
    combobox({
      id: "goal",
      label: several ? "Another dish, on the same menu" : "What shall be made?",
      placeholder: several ? "Add a dish" : "Type a dish or an object",
      suggest: (text) => objectSuggestions(app, text),
      choose: (text) => app.make(text, true),
      nothing: "No object of this FOON is called like that.",
    }),
  );
}

/** A part that can be folded; on narrow screens it is at first. */
function folding(app: App, title: string, brief: string, ...content: Parameters<typeof h>[2][]): HTMLElement {
  const open = app.folds.get(title) ?? window.matchMedia("(min-width: 1001px)").matches;
  const part = h(
    "details",
    { class: "card", open, toggle: () => app.folds.set(title, part.open) },
    h("summary", { "data-key": `fold-${title}` }, h("h2", {}, title), h("span", { class: "brief" }, brief)),
    h("div", { class: "folded" }, content),
  );
  return part;
}

function goalText(app: App, text: string): HTMLElement {
  const number = app.world.named(text);
  if (number === undefined) return h("span", {}, text);
  const node = app.world.node(number);
  return h("span", { title: text }, h("span", { class: "label" }, node.label), " ", h("span", { class: "states" }, writeStates(node)));
}

function howPart(app: App): HTMLElement {
  const { method, by, founded, count } = app.state;
  const ordered = method === "optimal";
  const select = h(
    "select",
    {
      id: "method",
      "data-key": "method",
      change: () => {
        const chosen = select.value as typeof method;
        app.set({ method: chosen, by: chosen === "greedy" ? (app.world.hasRates ? ["success"] : ["inputs"]) : ["units"], count: 1, tree: 0 });
      },
    },
    METHODS.filter((each) => each === "optimal" || app.state.goals.length < 2).map((each) => h("option", { value: each, selected: each === method }, METHOD_NAMES[each])),
  );
  return folding(
    app,
    "How",
    `${METHOD_NAMES[method]}${ordered ? `: ${by.map((each) => CRITERION_NAMES[each]).join(", ")}` : ""}`,
    h("div", {}, h("label", { class: "field", for: "method" }, "Method"), select),
    h("p", { class: "hint" }, METHOD_NOTES[method]),
    ordered && criteria(app),
    method === "greedy" && heuristic(app),
    ordered &&
      h(
        "div",
        { class: "row" },
        h("label", { class: "field", for: "count" }, "How many trees"),
        number("count", count, 1, MOST_TREES, (value) => app.set({ count: value ?? 1, tree: 0 })),
      ),
    (method === "greedy" || method === "first") &&
      h(
        "label",
        { class: "check" },
        h("input", { type: "checkbox", "data-key": "reference", checked: !founded, change: () => app.set({ founded: !founded, tree: 0 }) }),
        "As the published programs: may go in circles",
      ),
    by.includes("success") && !app.world.hasRates && h("p", { class: "hint" }, "These data have no success rates."),
  );
}

function criteria(app: App): HTMLElement {
  const { by } = app.state;
  const offered = CRITERIA.filter((each) => !by.includes(each) && available(app, each));
  const move = (place: number, to: number): void => {
    const next = [...by];
    next.splice(to, 0, ...next.splice(place, 1));
    app.set({ by: next, tree: 0 });
  };
  const add = h(
    "select",
    { id: "add-criterion", "data-key": "add-criterion", change: () => app.set({ by: [...by, add.value as Criterion], tree: 0 }) },
    h("option", { value: "" }, by.length === 0 ? "Choose…" : "then by…"),
    offered.map((each) => h("option", { value: each }, CRITERION_NAMES[each])),
  );
  return h(
    "fieldset",
    { class: "criteria" },
    h("legend", { class: "field" }, "Best is, the most important first"),
    h(
      "ol",
      {},
      by.map((each, place) =>
        h(
          "li",
          {},
          h("span", { class: "grow" }, CRITERION_NAMES[each]),
          by.length > 1 && button("↑", () => move(place, place - 1), { class: "icon", "aria-label": `${CRITERION_NAMES[each]}: more important`, disabled: place === 0, "data-key": `up-${each}` }),
          by.length > 1 && remover(`Not by ${CRITERION_NAMES[each]}`, () => app.set({ by: by.filter((other) => other !== each), tree: 0 })),
        ),
      ),
    ),
    offered.length > 0 && h("label", { class: "unseen", for: "add-criterion" }, "A further criterion"),
    offered.length > 0 && add,
  );
}

export const available = (app: App, criterion: Criterion): boolean =>
  (criterion !== "success" || app.world.hasRates) &&
  (criterion !== "cost" || app.world.hasCosts) &&
  (!["tools", "dirty"].includes(criterion) || app.world.utensils.size > 0) &&
  (criterion !== "time" || app.world.units.some((unit) => unit.start !== undefined));

function heuristic(app: App): HTMLElement {
  const select = h(
    "select",
    { id: "heuristic", "data-key": "heuristic", change: () => app.set({ by: [select.value as Criterion], tree: 0 }) },
    (["success", "inputs"] as const).filter((each) => available(app, each)).map((each) => h("option", { value: each, selected: app.state.by[0] === each }, CRITERION_NAMES[each])),
  );
  return h("div", { class: "row" }, h("label", { class: "field", for: "heuristic" }, "Best unit is"), select);
}

function number(id: string, value: number | null, least: number, most: number, change: (value: number | null) => void): HTMLInputElement {
  const input = h("input", {
    id,
    type: "number",
    min: least,
    max: most,
    inputmode: "numeric",
    value: value ?? "",
    "data-key": id,
    change: () => {
      const given = Number.parseInt(input.value, 10);
      change(Number.isNaN(given) ? null : Math.min(most, Math.max(least, given)));
    },
  });
  return input;
}

type Kind = "without" | "without_tools" | "avoid_motions" | "diets" | "avoid_units" | "use_units";

/** What each kind of constraint is called where it stands. */
export const KIND_WORDS: Readonly<Record<Kind, string>> = {
  without: "without",
  without_tools: "without the tool",
  avoid_motions: "never",
  diets: "diet:",
  avoid_units: "without step",
  use_units: "with step",
};

function withoutPart(app: App): HTMLElement {
  const { constraints } = app.state;
  const chips = (Object.keys(KIND_WORDS) as Kind[]).flatMap((kind) =>
    (constraints[kind] as readonly (string | number)[]).map((value) => {
      const said = typeof value === "number" ? unitText(app, value) : value;
      const remove = (): void => app.constrain({ [kind]: (constraints[kind] as readonly (string | number)[]).filter((each) => each !== value) } as Partial<Constraints>);
      return h("li", { class: "chip" }, h("span", {}, h("b", {}, KIND_WORDS[kind]), ` ${said}`), remover(`Take back: ${KIND_WORDS[kind]} ${said}`, remove));
    }),
  );
  const diets = Object.keys(app.data.diets).filter((diet) => !constraints.diets.includes(diet));
  const limited = chips.length + (constraints.max_units === null ? 0 : 1) + (constraints.max_depth === null ? 0 : 1);
  return folding(
    app,
    "Within limits",
    limited === 0 ? "none" : counted(limited, "limit"),
    chips.length > 0 && h("ul", { class: "chips" }, chips),
    combobox({
      id: "constraint",
      label: "Do without",
      placeholder: "A food, a tool, a motion, a diet",
      suggest: (text) => limits(app, text, diets),
      choose: (value) => {
        const [kind, label] = JSON.parse(value) as [Kind, string];
        app.constrain({ [kind]: [...(constraints[kind] as readonly string[]), label] } as Partial<Constraints>);
      },
      nothing: "This FOON has no such food, tool or motion.",
    }),
    h(
      "div",
      { class: "row two" },
      h("div", {}, h("label", { class: "field", for: "max-units" }, "At most steps"), number("max-units", constraints.max_units, 0, 9999, (value) => app.constrain({ max_units: value }))),
      h("div", {}, h("label", { class: "field", for: "max-depth" }, "At most rounds"), number("max-depth", constraints.max_depth, 0, 9999, (value) => app.constrain({ max_depth: value }))),
    ),
  );
}

function limits(app: App, text: string, diets: readonly string[]): Suggestion[] {
  const { world } = app;
  const kept = app.kept.get("labels") as { foods: string[]; motions: string[] } | undefined;
  const known = kept ?? {
    foods: [...new Set(world.nodes.map((node) => node.label))],
    motions: [...new Set(world.units.map((unit) => unit.motion))],
  };
  app.kept.set("labels", known);
  const suggestion = (kind: Kind, label: string): Suggestion => ({ value: JSON.stringify([kind, label]), show: () => [h("b", {}, KIND_WORDS[kind]), ` ${label}`] });
  return [
    ...findTexts(diets, text, 3).map((each) => suggestion("diets", each)),
    ...findTexts(known.foods, text, 6).map((each) => suggestion(world.utensils.has(each) ? "without_tools" : "without", each)),
    ...findTexts(known.motions, text, 3).map((each) => suggestion("avoid_motions", each)),
  ];
}

/** A step in short: its motion and its number. */
export function unitText(app: App, id: number): string {
  const unit = app.world.units.find((each) => each.id === id);
  return unit === undefined ? `${id} (not in this FOON)` : `${unit.motion} (${id})`;
}

function kitchenPart(app: App): HTMLElement {
  const { closure, stock } = app.world;
  const makeable = [...closure.available.keys()].filter((number) => !stock.has(number)).length;
  return folding(
    app,
    "Kitchen",
    `${counted(stock.size, "object")} at hand`,
    h("p", {}, `${counted(stock.size, "object")} at hand; ${counted(makeable, "more can be made", "more can be made")}.`),
    h(
      "div",
      { class: "row" },
      button("Look and change", () => app.set({ view: "kitchen" }), { "aria-pressed": app.state.view === "kitchen" ? "true" : "false" }),
      app.kitchenChanged && button("As in the data", () => app.setKitchen({ empty: false, add: [], remove: [] }), { class: "plain" }),
    ),
  );
}

function remover(label: string, click: () => void): HTMLButtonElement {
  return h("button", { type: "button", class: "remove", "aria-label": label, title: label, click, "data-key": label }, "×");
}
