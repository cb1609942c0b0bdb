/** Trade-offs between two criteria: each point is a tree that no other one improves on. */

import { CRITERIA, type Criterion, type Tree } from "../foon/tree";
import { Stopped } from "../solve/solver";
import type { App } from "./app";
import { available } from "./ask";
import { button, counted, h, svg } from "./dom";
import { stepList } from "./steps";
import { COST_NAMES, CRITERION_NAMES, costName, costText } from "./words";

interface Front {
  readonly by: readonly [Criterion, Criterion];
  trees: Tree[];
  done: boolean;
  trouble: string;
}

export function tradeOffsView(app: App): HTMLElement {
  const front = (app.kept.get("front") as Front | undefined) ?? begin(app, usual(app));
  const chosen = Math.min((app.kept.get("point") as number | undefined) ?? 0, Math.max(0, front.trees.length - 1));
  const tree = front.trees[chosen];
  const choose = (place: number): void => {
    app.kept.set("point", place);
    app.renderMain();
  };
  return h(
    "div",
    {},
    h("div", { class: "row" }, criterion(app, front, 0), criterion(app, front, 1)),
    front.trouble !== "" && h("p", { class: "trouble" }, front.trouble),
    front.done
      ? h("p", { class: "hint" }, `${counted(front.trees.length, "trade-off")}; no tree is better by one of the two without being worse by the other. Proven.`)
      : h("p", { class: "hint" }, `${counted(front.trees.length, "trade-off")} so far… `, button("Stop", () => app.solver.stop(), { class: "plain" })),
    front.trees.length > 0 && plot(front, chosen, choose),
    tree !== undefined && h("section", {}, h("h3", {}, front.by.map((each) => `${costText(each, tree.costs[each])} ${costName(each, tree.costs[each])}`).join(", ")), stepList(app, tree)),
  );
}

function usual(app: App): [Criterion, Criterion] {
  const [first = "units", second] = app.state.by;
  if (second !== undefined) return [first, second];
  if (first !== "units") return ["units", first];
  return ["units", app.world.hasRates ? "success" : "inputs"];
}

function criterion(app: App, front: Front, place: 0 | 1): HTMLElement {
  const other = front.by[1 - place];
  const usable = CRITERIA.filter((each) => each !== other && available(app, each));
  const id = `axis-${place}`;
  const select = h(
    "select",
    {
      id,
      "data-key": id,
      change: () => {
        const by: [Criterion, Criterion] = [...front.by];
        by[place] = select.value as Criterion;
        if (!front.done) app.solver.stop();
        begin(app, by);
        app.renderMain();
      },
    },
    usable.map((each) => h("option", { value: each, selected: each === front.by[place] }, CRITERION_NAMES[each])),
  );
  return h("div", {}, h("label", { class: "field", for: id }, place === 0 ? "Between" : "and"), select);
}

function begin(app: App, by: [Criterion, Criterion]): Front {
  const front: Front = { by, trees: [], done: false, trouble: "" };
  app.kept.set("front", front);
  app.kept.delete("point");
  void fill(app, front);
  return front;
}

async function fill(app: App, front: Front): Promise<void> {
  try {
    for await (const tree of app.retriever.pareto(app.world, app.query({ by: front.by, method: "optimal", count: 1 }))) {
      if (app.kept.get("front") !== front) return;
      front.trees.push(tree);
      app.renderMain();
    }
  } catch (error) {
    front.trouble = error instanceof Stopped ? "Stopped: there may be more." : (error as Error).message;
  }
  front.done = front.trouble === "";
  if (app.kept.get("front") === front) app.renderMain();
}

function plot({ by, trees }: Front, chosen: number, choose: (place: number) => void): Element {
  // On a phone the plot is drawn smaller, not shrunk: its figures stay readable.
  const [width, height, left, bottom] = [Math.min(600, Math.max(300, window.innerWidth - 36)), 300, 96, 46];
  const values = (which: 0 | 1): number[] => trees.map((tree) => tree.costs[by[which]] ?? 0);
  const axis = (numbers: readonly number[], from: number, to: number): ((value: number) => number) => {
    const [least, most] = [Math.min(...numbers), Math.max(...numbers)];
    return (value) => (most === least ? (from + to) / 2 : from + ((value - least) / (most - least)) * (to - from));
  };
  const [xs, ys] = [values(0), values(1)];
  const x = axis(xs, left + 24, width - 40);
  const y = axis(ys, height - bottom - 18, 34);
  const tick = (value: number, which: 0 | 1): string => costText(by[which], value);
  const ends = (numbers: readonly number[]): number[] => [...new Set([Math.min(...numbers), Math.max(...numbers)])];
  return h(
    "div",
    { class: "scroll" },
    svg(
      "svg",
      { class: "plot", viewBox: `0 0 ${width} ${height}`, role: "group", "aria-label": `Trade-offs between ${COST_NAMES[by[0]]} and ${COST_NAMES[by[1]]}` },
      svg("path", { class: "axis", d: `M${left},12V${height - bottom}H${width - 12}`, fill: "none" }),
      ends(xs).map((value) => svg("text", { x: x(value), y: height - bottom + 18, "text-anchor": "middle" }, tick(value, 0))),
      ends(ys).map((value) => svg("text", { x: left - 8, y: y(value), "text-anchor": "end", "dominant-baseline": "central" }, tick(value, 1))),
      svg("text", { x: (left + width) / 2, y: height - 6, "text-anchor": "middle", class: "axis-name" }, COST_NAMES[by[0]]),
      svg("text", { x: 14, y: (height - bottom) / 2, "text-anchor": "middle", class: "axis-name", transform: `rotate(-90 14 ${(height - bottom) / 2})` }, COST_NAMES[by[1]]),
      trees.map((tree, place) => {
        const said = by.map((each) => `${costText(each, tree.costs[each])} ${costName(each, tree.costs[each])}`).join(", ");
        return svg(
          "g",
          {
            class: place === chosen ? "point chosen" : "point",
            role: "button",
            tabindex: 0,
            "aria-pressed": place === chosen ? "true" : "false",
            "data-key": `point-${place}`,
            click: () => choose(place),
            keydown: (event) => ["Enter", " "].includes((event as KeyboardEvent).key) && (event.preventDefault(), choose(place)),
          },
          svg("title", {}, said),
          svg("circle", { cx: x(xs[place]!), cy: y(ys[place]!), r: 16, class: "reach" }),
          svg("circle", { cx: x(xs[place]!), cy: y(ys[place]!), r: place === chosen ? 8 : 6 }),
          svg("text", { x: x(xs[place]!) + 12, y: y(ys[place]!) - 10 }, place + 1),
        );
      }),
    ),
  );
}
