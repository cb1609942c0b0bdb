/** The steps of a tree, one after the other. */

import type { Step, Tree } from "../foon/tree";
import { dishesOf } from "../solve/retrieve";
import type { App } from "./app";
import { objectLink, unitLink, videoLink } from "./detail";
import { button, counted, h } from "./dom";
import { duration } from "./words";

const SHOWN = 300;

export function stepsView(app: App, tree: Tree): HTMLElement {
  if (tree.units.length === 0) return h("p", { class: "card" }, "Nothing need be done: it is at hand.");
  const dishes = tree.goals.length > 1 ? dishesOf(app.world, tree) : undefined;
  return h("div", {}, dishes && menu(app, tree), stepList(app, tree, dishes));
}

/** The steps; of very many the first, and the rest when they are asked for. */
export function stepList(app: App, tree: Tree, dishes?: ReadonlyMap<number, readonly number[]>): HTMLElement {
  const item = (step: Step): HTMLElement => stepItem(app, tree, step, dishes?.get(step.unit));
  const list = h("ol", { class: "steps" }, tree.steps.slice(0, SHOWN).map(item));
  if (tree.steps.length <= SHOWN) return list;
  const rest = button(`Show all ${counted(tree.steps.length, "step")}`, () => {
    list.append(...tree.steps.slice(SHOWN).map(item));
    rest.remove();
  });
  return h("div", {}, list, rest);
}

function stepItem(app: App, tree: Tree, step: Step, dishes?: readonly number[]): HTMLElement {
  const { world } = app;
  const unit = world.unit(step.unit);
  const tools = step.takes.filter((port, place) => world.isTool(port) && step.origins[place] === null);
  const takes = step.takes.map((port, place) => [port, step.origins[place]] as const).filter(([port]) => !tools.includes(port));
  const video = world.videos(step.unit)[0];
  const last = step.place === tree.steps.length;
  return h(
    "li",
    { class: last ? "step last" : "step", id: `step-${step.place}` },
    h("span", { class: "place", "aria-hidden": "true" }, step.place),
    h(
      "div",
      { class: "what" },
      h("p", { class: "do" }, unitLink(app, step.unit), tools.length > 0 && h("span", { class: "with" }, " with ", separated(tools.map((tool) => objectLink(app, tool)))), step.round === 0 && h("span", { class: "badge bad" }, "cannot be done")),
      takes.length > 0 &&
        h(
          "p",
          { class: "ports" },
          h("span", { class: "side" }, "take"),
          separated(
            takes.map(([port, origin]) => [
              objectLink(app, port, origin === null ? { class: "object from-kitchen" } : {}),
              origin === null ? "" : h("a", { class: "from", href: `#step-${origin}`, click: (event) => jump(event, origin ?? 0), "aria-label": `from step ${origin}` }, `← ${origin}`),
            ]),
          ),
        ),
      h("p", { class: "ports" }, h("span", { class: "side" }, "get"), separated(step.makes.map((port) => objectLink(app, port, tree.goals.includes(port) ? { class: "object is-goal" } : {})))),
      dishes !== undefined && dishes.length > 0 && h("p", { class: "for" }, `for ${dishes.map((goal) => world.node(goal).label).join(" and ")}`),
    ),
    h(
      "div",
      { class: "aside" },
      unit.start !== undefined && h("span", {}, video === undefined ? duration(unit.start) : videoLink(video, unit.start)),
      unit.start === undefined && video !== undefined && h("span", { class: "video", title: video }, videoLink(video)),
    ),
  );
}

function jump(event: Event, place: number): void {
  event.preventDefault();
  const item = document.getElementById(`step-${place}`);
  item?.scrollIntoView({ block: "center", behavior: "smooth" });
  item?.querySelector<HTMLElement>("button")?.focus({ preventScroll: true });
}

/** What sharing steps saves: each dish apart is asked for once the menu is there. */
function menu(app: App, tree: Tree): HTMLElement {
  const apart = app.kept.get("apart") as readonly (number | null)[] | undefined;
  const dishes = counted(tree.goals.length, "dish", "dishes");
  if (apart === undefined) {
    return h("p", { class: "card" }, `${dishes} with one tree of ${counted(tree.units.length, "step")}. `, button("What does sharing save?", () => void measure(app, tree)));
  }
  const total = apart.reduce<number>((sum, count) => sum + (count ?? 0), 0);
  const saved = total - tree.units.length;
  return h(
    "p",
    { class: "card" },
    `${dishes} with one tree of ${counted(tree.units.length, "step")}; each by itself takes ${apart.map((count, place) => `${count ?? "–"} (${app.world.node(tree.goals[place]!).label})`).join(" and ")}, so sharing saves ${counted(saved, "step")}.`,
  );
}

async function measure(app: App, tree: Tree): Promise<void> {
  const { kept } = app;
  const counts: (number | null)[] = [];
  for (const goal of tree.goals) {
    const answer = await app.retriever.retrieve(app.world, app.query({ goals: [goal], count: 1 }));
    counts.push(answer.trees[0]?.units.length ?? null);
  }
  kept.set("apart", counts);
  app.render();
}

/** Things in a row, with commas between them. */
function separated(items: readonly (Node | readonly (Node | string)[])[]): (Node | string)[] {
  return items.flatMap((item, place) => [place > 0 ? ", " : "", ...(Array.isArray(item) ? (item as readonly (Node | string)[]) : [item as Node])]);
}
