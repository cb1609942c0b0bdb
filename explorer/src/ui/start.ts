/** The first view: what can be made. */

import type { App } from "./app";
import { objectSuggestions } from "./ask";
import { combobox } from "./combobox";
import { counted, h } from "./dom";
import { more, objectLine } from "./detail";
import { writeStates } from "../foon/node";

export function startView(app: App): HTMLElement {
  const { world } = app;
  const { closure, stock } = world;
  const goals = world.row.goals;
  const possible = (number: number): boolean => closure.available.has(number);
  const makeable = [...closure.available.keys()].filter((number) => !stock.has(number));
  const ends = makeable.filter((number) => !world.readings.users.has(number) && !world.isTool(number)).sort((one, other) => (world.text(one) < world.text(other) ? -1 : 1));
  return h(
    "div",
    { class: "start" },
    h("h2", { class: "question" }, "What shall be made?"),
    combobox({
      id: "first-goal",
      label: "A dish, or any object",
      hiddenLabel: true,
      large: true,
      placeholder: "Type a dish or an object",
      suggest: (text) => objectSuggestions(app, text),
      choose: (text) => app.make(text),
      nothing: "No object of this FOON is called like that.",
    }),
    world.row.slice !== "" && h("p", { class: "notice" }, world.row.slice),
    goals.length > 0 &&
      h(
        "section",
        {},
        h("h3", {}, `Dishes of these data `, h("span", { class: "count" }, `${goals.filter(possible).length} of ${goals.length} possible`)),
        h(
          "ul",
          { class: "dishes" },
          goals.map((goal) =>
            h(
              "li",
              {},
              h(
                "button",
                { type: "button", class: possible(goal) ? "dish" : "dish off", click: () => app.make(world.text(goal)) },
                h("span", { class: "label" }, world.node(goal).label),
                h("span", { class: "states" }, writeStates(world.node(goal))),
                !possible(goal) && h("span", { class: "mark-not-possible" }, "not possible"),
              ),
            ),
          ),
        ),
      ),
    h(
      "section",
      {},
      h("h3", {}, goals.length > 0 ? "Everything else that ends a recipe " : "What ends a recipe ", h("span", { class: "count" }, ends.length)),
      h("p", { class: "hint" }, `With ${counted(stock.size, "object")} at hand, ${counted(closure.executable.size, "unit")} of ${world.units.length.toLocaleString("en")} can be done and ${counted(makeable.length, "object")} made. These are those that no unit needs any more.`),
      more(ends, (number) => h("li", {}, h("button", { type: "button", class: "object", click: () => app.make(world.text(number)) }, objectLine(app, number))), 24),
    ),
  );
}
