/** The kitchen: what is at hand, to be changed, and what becomes possible by that. */

import { FileError, objectFrom } from "../foon/read";
import { wordsOf } from "../search";
import type { App } from "./app";
import { objectSuggestions } from "./ask";
import { combobox } from "./combobox";
import { more, objectLine, objectLink } from "./detail";
import { button, counted, h } from "./dom";

const SHOWN = 150;

export function kitchenView(app: App): HTMLElement {
  const { world, plain } = app;
  const filter = (app.kept.get("filter") as string | undefined) ?? "";
  return h(
    "div",
    { class: "kitchen" },
    h(
      "div",
      { class: "headline row" },
      h("h2", { class: "grow" }, "The kitchen"),
      app.goals.length > 0 && button("Back to the tree", () => app.set({ view: "steps" }), { class: "primary" }),
    ),
    h("p", {}, `${counted(world.stock.size, "object")} at hand. `, h("b", {}, `${counted(world.closure.executable.size, "unit")} of ${world.units.length.toLocaleString("en")}`), " can be done."),
    h(
      "div",
      { class: "columns-two" },
      h(
        "section",
        { class: "card" },
        h("h3", {}, "At hand"),
        h(
          "div",
          { class: "row" },
          button("Empty the kitchen", () => app.setKitchen({ empty: true, add: [], remove: [] })),
          app.kitchenChanged && button("As in the data", () => app.setKitchen({ empty: false, add: [], remove: [] })),
        ),
        combobox({
          id: "stock",
          label: "Put in",
          placeholder: "Type an object",
          suggest: (text) => objectSuggestions(app, text, 20).filter((each) => !world.stock.has(world.named(each.value)!)),
          choose: (text) => app.stock(world.named(text)!, true),
          nothing: "No object of this FOON is called like that.",
        }),
        paste(app),
        field(app, filter),
        boxes(app, filter),
      ),
      h("section", { class: "card" }, h("h3", {}, "What that makes possible"), changes(app), goals(app), plain.row.goals.length === 0 && !app.kitchenChanged && h("p", { class: "hint" }, "Change the kitchen, and what becomes possible is listed here.")),
    ),
  );
}

function field(app: App, filter: string): HTMLElement {
  const input = h("input", {
    id: "filter",
    type: "search",
    value: filter,
    "data-key": "filter",
    autocomplete: "off",
    input: () => {
      app.kept.set("filter", input.value);
      const list = document.getElementById("stock-boxes");
      list?.replaceWith(boxes(app, input.value));
    },
  });
  return h("div", {}, h("label", { class: "field", for: "filter" }, "Look through the list"), input);
}

/** What is at hand, and what was taken out, each with a box to tick. */
function boxes(app: App, filter: string): HTMLElement {
  const { world, plain } = app;
  const words = wordsOf(filter);
  const fits = (number: number): boolean => words.every((word) => world.text(number).toLowerCase().includes(word));
  const listed = [...new Set([...world.stock, ...plain.stock])].filter(fits).sort((one, other) => (world.text(one) < world.text(other) ? -1 : 1));
  const item = (number: number): HTMLElement =>
    h("li", {}, h("label", { class: "check" }, h("input", { type: "checkbox", checked: world.stock.has(number), "data-key": `stock-${number}`, change: () => app.stock(number, !world.stock.has(number)) }), h("span", {}, objectLine(app, number).slice(0, 2))));
  return h("div", { id: "stock-boxes" }, listed.length === 0 ? h("p", { class: "hint" }, filter === "" ? "Nothing is at hand." : "Nothing at hand is called like that.") : more(listed, item, SHOWN));
}

function paste(app: App): HTMLElement {
  const text = h("textarea", { id: "paste", rows: 4, "data-key": "paste", placeholder: "tomato [whole]\nonion [whole]\nknife" });
  const take = (): void => {
    const { found, unknown } = readList(app, text.value);
    app.notice = `${counted(found.length, "object")} put into the kitchen.${unknown.length > 0 ? ` This FOON has no ${unknown.slice(0, 5).join("; ")}${unknown.length > 5 ? " …" : ""}.` : ""}`;
    app.say(app.notice);
    app.stockAll(found, true);
    app.render();
  };
  return h("details", {}, h("summary", {}, "Paste a list"), h("label", { class: "field", for: "paste" }, "Objects, one a line, or the JSON of a kitchen"), text, h("div", { class: "row" }, button("Put all in", take)));
}

/** Objects of a list: as they are written in full, or by a label that is at home in the kitchen. */
function readList(app: App, text: string): { found: number[]; unknown: string[] } {
  const { world } = app;
  const found: number[] = [];
  const unknown: string[] = [];
  try {
    const value: unknown = JSON.parse(text);
    for (const item of Array.isArray(value) ? value : [value]) {
      const number = world.numberOf(objectFrom(item));
      if (number === undefined) unknown.push(JSON.stringify(item));
      else found.push(number);
    }
    return { found, unknown };
  } catch (error) {
    if (!(error instanceof SyntaxError) && !(error instanceof FileError)) throw error;
  }
  for (const line of text.split("\n").map((each) => each.trim()).filter(Boolean)) {
    const exact = world.named(line);
    const labelled = exact === undefined ? world.nodes.map((_, number) => number).filter((number) => world.node(number).label === line.toLowerCase() && world.isRaw(number)) : [exact];
    if (labelled.length === 0) unknown.push(line);
    found.push(...labelled);
  }
  return { found, unknown };
}

/** What can be made with this kitchen and not with that of the data, and the other way round. */
function changes(app: App): Node[] {
  if (!app.kitchenChanged) return [];
  const [now, before] = [app.world, app.plain];
  const able = (world: typeof now, number: number): boolean => world.closure.available.has(number);
  const made = (number: number): boolean => now.readings.makers.has(number);
  const all = now.nodes.map((_, number) => number).filter(made);
  const more_ = all.filter((number) => able(now, number) && !able(before, number));
  const less = all.filter((number) => !able(now, number) && able(before, number));
  const list = (title: string, numbers: readonly number[]): Node[] => [h("h4", {}, title, " ", h("span", { class: "count" }, numbers.length)), more(numbers, (number) => h("li", {}, objectLink(app, number)))];
  if (more_.length + less.length === 0) return [h("p", { class: "hint" }, "The change makes nothing possible, and nothing impossible.")];
  return [...(more_.length > 0 ? list("Possible now", more_) : []), ...(less.length > 0 ? list("No longer possible", less) : [])];
}

function goals(app: App): Node[] {
  const { row, closure } = app.world;
  if (row.goals.length === 0) return [];
  const possible = row.goals.filter((goal) => closure.available.has(goal));
  return [
    h("h4", {}, "Dishes of these data ", h("span", { class: "count" }, `${possible.length} of ${row.goals.length}`)),
    h("ul", { class: "lines ticks" }, row.goals.map((goal) => h("li", { class: closure.available.has(goal) ? "yes" : "no" }, h("span", { class: "tick", "aria-hidden": "true" }, closure.available.has(goal) ? "✓" : "✗"), h("span", { class: "unseen" }, closure.available.has(goal) ? "possible: " : "not possible: "), objectLink(app, goal)))),
  ];
}
