/** What is known of one object, or of one step: a drawer at the side. */

import type { App } from "./app";
import { KIND_WORDS } from "./ask";
import { button, counted, h, refill } from "./dom";
import { writeStates } from "../foon/node";
import { START, writeState } from "../state";
import { duration } from "./words";

const SHOWN = 12;

/** An object as it stands in a line: its label, its states, and whether it is at hand. */
export function objectLine(app: App, number: number): (Node | string)[] {
  const node = app.world.node(number);
  const mark = app.world.stock.has(number) ? "at hand" : app.world.closure.available.has(number) ? "" : "not possible";
  return [
    h("span", { class: "label" }, node.label),
    node.states.length > 0 ? h("span", { class: "states" }, ` ${writeStates(node)}`) : "",
    mark === "" ? "" : h("span", { class: `mark-${mark.replace(" ", "-")}` }, ` ${mark}`),
  ];
}

/** An object that leads to what is known of it; in a tab of its own it is what is made. */
export function objectLink(app: App, number: number, properties: Record<string, string> = {}): HTMLAnchorElement {
  const node = app.world.node(number);
  const open = (event: Event): void => {
    const { ctrlKey, metaKey, shiftKey } = event as MouseEvent;
    if (ctrlKey || metaKey || shiftKey) return;
    event.preventDefault();
    showObject(app, number);
  };
  return h(
    "a",
    { href: `#${writeState({ ...app.state, goals: [app.world.text(number)], view: START.view, tree: 0 })}`, class: "object", click: open, ...properties },
    h("span", { class: "label" }, node.label),
    node.states.length > 0 && h("span", { class: "states" }, ` ${writeStates(node)}`),
  );
}

/** A unit that can be pressed to learn more of it. */
export function unitLink(app: App, unit: number, text = app.world.unit(unit).motion): HTMLButtonElement {
  return h("button", { type: "button", class: "motion", click: () => showUnit(app, unit) }, text);
}

let drawer: HTMLDialogElement | undefined;

export function closeDetail(): void {
  drawer?.close();
}

function show(title: string, ...content: Parameters<typeof refill>[1][]): void {
  if (drawer === undefined) {
    const made = h("dialog", { class: "drawer", "aria-labelledby": "drawer-title", click: (event) => event.target === made && made.close() });
    drawer = made;
    document.body.append(made);
  }
  refill(drawer, h("div", { class: "inside" }, h("div", { class: "head" }, h("h2", { id: "drawer-title" }, title), button("Close", closeDetail, { class: "plain" })), content));
  if (!drawer.open) drawer.showModal();
  drawer.scrollTop = 0;
}

export function showObject(app: App, number: number): void {
  const { world } = app;
  const node = world.node(number);
  const makers = world.readings.makers.get(number) ?? [];
  const users = world.readings.users.get(number) ?? [];
  const others = world.nodes.map((_, other) => other).filter((other) => other !== number && world.node(other).label === node.label);
  const holding = world.nodes.map((_, other) => other).filter((other) => world.node(other).states.some((state) => state.contents?.includes(node.label) === true));
  const videos = [...new Set([...makers, ...users].flatMap((unit) => world.videos(unit)))];
  const there = world.stock.has(number);
  const status = there
    ? "It is at hand."
    : world.closure.available.has(number)
      ? `It can be made, in round ${world.closure.available.get(number)} at the earliest.`
      : makers.length > 0
        ? "It cannot be made with this kitchen."
        : "No unit makes it.";
  const redo = (act: () => void): (() => void) => () => {
    act();
    showObject(app, number);
  };
  show(
    node.label,
    node.states.length > 0 && h("p", { class: "states" }, writeStates(node)),
    h("p", {}, status),
    h(
      "div",
      { class: "row" },
      button(app.state.goals.length > 0 ? "Make this instead" : "Make this", () => app.make(world.text(number)), { class: "primary" }),
      app.state.goals.length > 0 && button("Make this, too", () => app.make(world.text(number), true)),
      button(there ? "Take out of the kitchen" : "Put into the kitchen", redo(() => app.stock(number, !there))),
      !app.state.constraints.without.includes(node.label) &&
        button(`Do without ${node.label}`, () => {
          closeDetail();
          const kind = world.utensils.has(node.label) ? "without_tools" : "without";
          app.constrain({ [kind]: [...app.state.constraints[kind], node.label] });
        }),
    ),
    unitList(app, "Who makes it", makers),
    unitList(app, "Who needs it", users),
    objectList(app, `Other states of ${node.label}`, others),
    objectList(app, `Where ${node.label} is inside`, holding),
    videoList(videos),
  );
}

function unitList(app: App, title: string, units: readonly number[]): Node[] {
  if (units.length === 0) return [];
  return [
    h("h3", {}, `${title} `, h("span", { class: "count" }, units.length)),
    more(units, (unit) => {
      const able = app.world.closure.executable.has(unit);
      return h(
        "li",
        { class: able ? "" : "off" },
        unitLink(app, unit),
        h("span", { class: "states" }, ` ${app.world.readings.makes[unit]!.map((made) => app.world.text(made)).join("; ")}`),
        !able && h("span", { class: "mark-not-possible" }, " not possible"),
      );
    }),
  ];
}

function objectList(app: App, title: string, objects: readonly number[]): Node[] {
  if (objects.length === 0) return [];
  return [h("h3", {}, `${title} `, h("span", { class: "count" }, objects.length)), more(objects, (number) => h("li", {}, h("button", { type: "button", class: "object", click: () => showObject(app, number) }, objectLine(app, number))))];
}

function videoList(videos: readonly string[]): Node[] {
  return videos.length === 0 ? [] : [h("h3", {}, "Videos"), h("ul", { class: "lines" }, videos.map((video) => h("li", {}, videoLink(video))))];
}

/** A list that shows its beginning, and the rest when it is asked for. */
export function more(items: readonly number[], item: (each: number) => HTMLElement, shown = SHOWN): HTMLElement {
  const list = h("ul", { class: "lines" }, items.slice(0, shown).map(item));
  if (items.length <= shown) return list;
  const rest = button(`Show all ${items.length.toLocaleString("en")}`, () => {
    list.append(...items.slice(shown).map(item));
    rest.remove();
  }, { class: "plain" });
  return h("div", {}, list, rest);
}

/** A video: a link if it is an address of the web, to the second if that is known; else its name. */
export function videoLink(video: string, start?: number): Node {
  const text = start === undefined ? video : `${video} at ${duration(start)}`;
  let address: URL;
  try {
    address = new URL(/^(www\.|youtu)/.test(video) ? `https://${video}` : video);
  } catch {
    return h("span", {}, text);
  }
  if (!["http:", "https:"].includes(address.protocol)) return h("span", {}, text);
  if (start !== undefined && /(^|\.)youtu(\.be|be\.com)$/.test(address.hostname)) address.searchParams.set("t", String(Math.floor(start)));
  return h("a", { href: address.href, target: "_blank", rel: "noopener noreferrer" }, text);
}

export function showUnit(app: App, number: number): void {
  const { world } = app;
  const unit = world.unit(number);
  const { constraints } = app.state;
  const limit = (kind: "avoid_units" | "use_units" | "avoid_motions", value: string | number): void => {
    closeDetail();
    app.constrain({ [kind]: [...constraints[kind], value] });
  };
  const video = world.videos(number)[0];
  const rate = world.rate(number);
  const ports = (objects: readonly number[]): HTMLElement => h("ul", { class: "lines" }, objects.map((port) => h("li", {}, objectLink(app, port))));
  show(
    `${unit.motion}, step ${unit.id}`,
    h(
      "p",
      {},
      world.closure.executable.has(number) ? "This kitchen can do it." : "This kitchen cannot do it.",
      rate !== null && ` It succeeds with ${Math.round(1000 * rate) / 10} %.`,
      unit.agent !== undefined && ` Noted as done by ${unit.agent}.`,
    ),
    h(
      "div",
      { class: "row" },
      !constraints.avoid_units.includes(unit.id) && button("Do without this step", () => limit("avoid_units", unit.id)),
      !constraints.use_units.includes(unit.id) && button("Use this step", () => limit("use_units", unit.id)),
      !constraints.avoid_motions.includes(unit.motion) && button(`${KIND_WORDS.avoid_motions} ${unit.motion}`.replace(/^n/, "N"), () => limit("avoid_motions", unit.motion)),
    ),
    h("h3", {}, "Takes"),
    ports(unit.inputs),
    h("h3", {}, "Gives"),
    ports(unit.outputs),
    h("h3", {}, "Where it was read"),
    h("p", { class: "states" }, unit.sources.length > 1 ? `${world.source(number)} and ${counted(unit.sources.length - 1, "other place")}` : world.source(number) || "Nobody noted it."),
    video !== undefined && h("p", {}, videoLink(video, unit.start)),
  );
}
