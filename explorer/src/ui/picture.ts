/** Pictures as the field draws them: green object nodes, red motion nodes; also told apart by their shapes. */

import { contentsOf, type ObjectNode } from "../foon/node";
import type { Tree } from "../foon/tree";
import type { App } from "./app";
import { showObject, showUnit } from "./detail";
import { button, h, save, svg } from "./dom";
import { layout, type Box, type Laid, type Point } from "./layout";

/** To which of two compared trees something belongs. */
export type Side = "both" | "one" | "other";

export interface PictureNode {
  readonly key: string;
  readonly kind: "object" | "kitchen" | "motion";
  readonly object?: number;
  readonly unit?: number;
  /** The whole label. */
  readonly title: string;
  readonly place?: number;
  readonly tools?: readonly string[];
  readonly goal?: boolean;
  readonly side?: Side;
}

export interface Graph {
  readonly nodes: PictureNode[];
  readonly edges: { readonly from: string; readonly to: string; readonly side?: Side }[];
}

/** Steps, what they make for later ones, and what they take of the kitchen: once for each use, so that lines stay short. */
export function treeGraph(app: App, tree: Tree, sides?: ReadonlyMap<number, Side>): Graph {
  const { world } = app;
  const graph: Graph = { nodes: [], edges: [] };
  const read = world.readings.readAs;
  const wanted = new Set(tree.goals);
  for (const step of tree.steps) step.takes.forEach((port, place) => step.origins[place] !== null && wanted.add(read[port]!));
  const shown = new Map<number, Side | undefined>();
  for (const step of tree.steps) {
    const side = sides?.get(step.unit);
    const tools = step.takes.filter((port, place) => world.isTool(port) && step.origins[place] === null);
    const key = `u${step.unit}`;
    graph.nodes.push({ key, kind: "motion", unit: step.unit, title: motionTitle(app, step.unit), place: step.place, tools: tools.map((tool) => world.node(tool).label), ...(side && { side }) });
    step.takes.forEach((port, place) => {
      if (tools.includes(port)) return;
      const object = read[port]!;
      const from = step.origins[place] === null ? `k${step.unit}-${object}` : `o${object}`;
      if (step.origins[place] === null) graph.nodes.push({ key: from, kind: "kitchen", object, title: world.text(object), ...(side && { side }) });
      graph.edges.push({ from, to: key, ...(side && { side }) });
    });
    for (const made of step.makes) {
      if (!wanted.has(made)) continue;
      graph.edges.push({ from: key, to: `o${made}`, ...(side && { side }) });
      shown.set(made, shown.has(made) && shown.get(made) !== side ? "both" : side);
    }
  }
  for (const [object, side] of shown) graph.nodes.push({ key: `o${object}`, kind: "object", object, title: world.text(object), goal: tree.goals.includes(object), ...(side && { side }) });
  const known = new Set(graph.nodes.map((node) => node.key));
  return { nodes: graph.nodes, edges: graph.edges.filter((edge) => known.has(edge.from) && known.has(edge.to)) };
}

const motionTitle = (app: App, unit: number): string => {
  const { inputs, outputs, motion } = app.world.unit(unit);
  const all = (ports: readonly number[]): string => ports.map((port) => app.world.text(port)).join("; ");
  return `${motion}: ${all(inputs)} → ${all(outputs)}`;
};

export function pictureView(app: App, tree: Tree): HTMLElement {
  if (tree.units.length === 0) return h("p", { class: "card" }, "There is nothing to draw: it is at hand.");
  return h(
    "div",
    {},
    h(
      "ul",
      { class: "legend", "aria-label": "Legend" },
      h("li", {}, h("span", { class: "key motion" }), "motion, with the number of its step"),
      h("li", {}, h("span", { class: "key object" }), "object that is made"),
      h("li", {}, h("span", { class: "key kitchen" }), "object of the kitchen"),
      h("li", {}, h("span", { class: "key is-goal" }), "goal"),
    ),
    graphPicture(app, treeGraph(app, tree), "The task tree"),
  );
}

/** Graphviz takes seconds for a thousand nodes, and minutes for more. */
export const MOST_NODES = 1500;

/** A graph in a frame of its own, which can be moved and zoomed; it is drawn as soon as it is laid out. */
export function graphPicture(app: App, graph: Graph, name: string): HTMLElement {
  if (graph.nodes.length > MOST_NODES) return h("p", { class: "card" }, `With ${graph.nodes.length.toLocaleString("en")} nodes this is too large to be drawn.`);
  const key = `picture ${JSON.stringify(graph.nodes)}`;
  const frame = h("div", { class: "frame", tabindex: 0, role: "region", "aria-label": name, "data-key": name });
  const bar = h("div", { class: "row tools" });
  const put = (drawn: SVGSVGElement): void => {
    let scale = Number(drawn.dataset.scale ?? 0);
    const width = Number(drawn.getAttribute("width"));
    const zoom = (to: number): void => {
      scale = Math.min(3, Math.max(0.15, to));
      drawn.dataset.scale = String(scale);
      drawn.style.width = `${width * scale}px`;
      drawn.style.height = `${Number(drawn.getAttribute("height")) * scale}px`;
    };
    const fit = (): void => zoom(Math.min(1, (frame.clientWidth - 24) / width));
    frame.replaceChildren(drawn);
    bar.replaceChildren(
      button("−", () => zoom(scale / 1.25), { class: "icon", "aria-label": "Smaller", "data-key": "smaller" }),
      button("+", () => zoom(scale * 1.25), { class: "icon", "aria-label": "Larger", "data-key": "larger" }),
      button("Whole picture", fit, { class: "plain" }),
      button("Save as SVG", () => save("tree.svg", standalone(drawn), "image/svg+xml"), { class: "plain" }),
    );
    // What is too small to read is scrolled instead.
    requestAnimationFrame(() => {
      zoom(scale > 0 ? scale : Math.max(0.62, Math.min(1, (frame.clientWidth - 24) / width)));
      frame.scrollLeft = Number(drawn.dataset.left) * scale - frame.clientWidth / 2;
      frame.scrollTop = Number(drawn.dataset.top) * scale - frame.clientHeight / 2;
    });
  };
  const known = app.kept.get(key) as SVGSVGElement | undefined;
  if (known !== undefined) put(known);
  else {
    frame.append(h("p", { class: "hint" }, "Drawing…"));
    void draw(app, graph, name).then((drawn) => {
      app.kept.set(key, drawn);
      put(drawn);
    });
  }
  return h("div", { class: "picture" }, bar, frame);
}

/** Fill, outline and letters of pictures that are saved, as `foon-asp draw` has them; the style sheet has those of the page. */
const INK = { object: ["#2e7d32", "#1b5e20", "#ffffff"], kitchen: ["#e3f3e3", "#4c9a50", "#1c4a1f"], motion: ["#b71c1c", "#7f1010", "#ffffff"] } as const;
/** What two compared trees share is pale. */
const SHARED = { object: ["#f0f3f0", "#8a978a", "#3f4a3f"], kitchen: ["#f0f3f0", "#8a978a", "#3f4a3f"], motion: ["#f5efef", "#9c8a8a", "#4f4242"] } as const;
const FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif";
const LARGE = 13;
const SMALL = 11;
const LINE = 15;

interface Text {
  readonly text: string;
  readonly size: number;
  readonly bold: boolean;
}

export async function draw(app: App, graph: Graph, name: string): Promise<SVGSVGElement> {
  const texts = graph.nodes.map((node) => linesOf(app, node));
  const boxes = graph.nodes.map((node, place) => boxOf(node, texts[place]!));
  const places = new Map(graph.nodes.map((node, place) => [node.key, place]));
  const laid = await layout(boxes, graph.edges.map((edge) => [places.get(edge.from)!, places.get(edge.to)!]));
  return drawn(app, graph, name, { texts, boxes, laid });
}

function drawn(app: App, graph: Graph, name: string, { texts, boxes, laid }: { texts: Text[][]; boxes: Box[]; laid: Laid }): SVGSVGElement {
  const margin = 12;
  const [width, height] = [Math.ceil(laid.width) + 2 * margin, Math.ceil(laid.height) + 2 * margin];
  // What is seen first: where two trees differ, else the top.
  const differs = graph.nodes.findIndex((node) => node.side === "one" || node.side === "other");
  const first = laid.nodes[differs] ?? laid.nodes.reduce((one, other) => (other.y < one.y ? other : one));
  const edges = graph.edges.map((edge, place) => {
    const { points, end } = laid.edges[place]!;
    const apart = edge.side === "one" || edge.side === "other";
    const line = { "stroke-width": apart ? 2.2 : 1.2, "stroke-dasharray": edge.side === "other" ? "6 3" : null };
    return svg("g", { class: "edge", "aria-hidden": "true" }, svg("path", { d: curve(points), fill: "none", stroke: "#7a857c", ...line }), svg("polygon", { points: arrow(points.at(-1)!, end), fill: "#7a857c" }));
  });
  const nodes = graph.nodes.map((node, place) => nodeElement(app, node, texts[place]!, boxes[place]!, laid.nodes[place]!));
  return svg(
    "svg",
    { xmlns: "http://www.w3.org/2000/svg", viewBox: `${-margin} ${-margin} ${width} ${height}`, width, height, role: "group", "aria-label": name, "font-family": FONT, "data-left": first.x, "data-top": first.y },
    edges,
    nodes,
  );
}

function nodeElement(app: App, node: PictureNode, texts: readonly Text[], box: Box, at: Point): SVGGElement {
  const [fill, stroke, ink] = (node.side === "both" ? SHARED : INK)[node.kind];
  // What comes from the kitchen is not marked: the step that takes it is.
  const apart = node.kind !== "kitchen" && (node.side === "one" || node.side === "other");
  const [x, y] = [at.x - box.width / 2, at.y - box.height / 2];
  const open = (): void => (node.object === undefined ? showUnit(app, node.unit!) : showObject(app, node.object));
  const radius = node.kind === "motion" ? 3 : Math.min(15, box.height / 2);
  const said = node.kind === "kitchen" ? `${node.title} (of the kitchen)` : node.goal === true ? `goal: ${node.title}` : node.title;
  const side = node.side === undefined ? "" : ` side-${node.side}`;
  const first = at.y - ((texts.length - 1) * LINE) / 2;
  const shape = { x, y, width: box.width, height: box.height, rx: radius, fill, stroke, "stroke-width": node.goal === true || apart ? 2.5 : 1.2, "stroke-dasharray": node.kind === "kitchen" ? "3 2" : node.side === "other" ? "7 3" : null };
  return svg(
    "g",
    {
      class: `node ${node.kind}${node.goal === true ? " is-goal" : ""}${side}`,
      tabindex: 0,
      role: "button",
      "data-key": `node-${node.key}`,
      click: open,
      keydown: (event) => ["Enter", " "].includes((event as KeyboardEvent).key) && (event.preventDefault(), open()),
    },
    svg("title", {}, said),
    node.goal === true && svg("rect", { x: x - 4, y: y - 4, width: box.width + 8, height: box.height + 8, rx: radius + 4, fill: "none", stroke, "stroke-width": 1.2 }),
    svg("rect", shape),
    texts.map((line, place) =>
      svg("text", { x: at.x, y: first + place * LINE, fill: ink, "font-size": line.size, "font-weight": line.bold ? 600 : 400, "text-anchor": "middle", "dominant-baseline": "central" }, line.text),
    ),
    apart && svg("circle", { cx: x + 2, cy: y + 2, r: 8, fill: "#ffffff", stroke, "stroke-width": 1.2, class: "sign" }),
    apart && svg("text", { x: x + 2, y: y + 2, "font-size": SMALL, "font-weight": 700, "text-anchor": "middle", "dominant-baseline": "central", class: "sign", fill: "#1b211c" }, node.side === "one" ? "A" : "B"),
  );
}

function linesOf(app: App, node: PictureNode): Text[] {
  if (node.object === undefined) {
    const unit = app.world.unit(node.unit!);
    const head = node.place === undefined ? unit.motion : `${node.place}  ${unit.motion}`;
    const tools = node.tools ?? [];
    const with_ = tools.length === 0 ? [] : wrapped(`with ${tools.slice(0, 3).join(", ")}${tools.length > 3 ? ` +${tools.length - 3}` : ""}`, 26);
    return [...wrapped(head, 26).map((text) => ({ text, size: LARGE, bold: true })), ...with_.map((text) => ({ text, size: SMALL, bold: false }))];
  }
  const object = app.world.node(node.object);
  return [...wrapped(object.label, 24).map((text) => ({ text, size: LARGE, bold: true })), ...statesOf(object).flatMap((text) => wrapped(text, 28)).map((text) => ({ text, size: SMALL, bold: false }))];
}

/** The states in short: many contents are folded. */
function statesOf(node: ObjectNode): string[] {
  const plain = node.states.filter((state) => state.relatum === null && state.contents === null).map((state) => state.name);
  const contents = contentsOf(node);
  const places = node.states.filter((state) => state.relatum !== null).map((state) => `${state.name} ${state.relatum}`);
  const folded = contents.length > 3 ? `{${contents.slice(0, 2).join(", ")} +${contents.length - 2}}` : `{${contents.join(", ")}}`;
  return [...(plain.length > 0 ? [plain.join(", ")] : []), ...(contents.length > 0 ? [folded] : []), ...(places.length > 0 ? [places.join(", ")] : [])];
}

function wrapped(text: string, most: number): string[] {
  const lines: string[] = [];
  for (const word of text.split(" ")) {
    const last = lines.at(-1);
    const piece = word.length > most ? `${word.slice(0, most - 1)}…` : word;
    if (last !== undefined && last.length + 1 + piece.length <= most) lines[lines.length - 1] = `${last} ${piece}`;
    else lines.push(piece);
  }
  return lines.length > 3 ? [...lines.slice(0, 2), `${lines[2]}…`] : lines;
}

const canvas = document.createElement("canvas").getContext("2d");

function boxOf(node: PictureNode, texts: readonly Text[]): Box {
  const widths = texts.map(({ text, size, bold }) => {
    if (canvas === null) return text.length * size * 0.56;
    canvas.font = `${bold ? 600 : 400} ${size}px ${FONT}`;
    return canvas.measureText(text).width;
  });
  return { width: Math.max(44, ...widths) + (node.kind === "motion" ? 20 : 26), height: texts.length * LINE + 10 };
}

const at = ({ x, y }: Point): string => `${x.toFixed(1)},${y.toFixed(1)}`;

function curve([first, ...rest]: readonly Point[]): string {
  return first === undefined ? "" : `M${at(first)}C${rest.map(at).join(" ")}`;
}

function arrow(from: Point, to: Point): string {
  const length = Math.hypot(to.x - from.x, to.y - from.y) || 1;
  const [x, y] = [(to.x - from.x) / length, (to.y - from.y) / length];
  return [to, { x: from.x - 3.2 * y, y: from.y + 3.2 * x }, { x: from.x + 3.2 * y, y: from.y - 3.2 * x }].map(at).join(" ");
}

/** A picture that stands by itself, without what only the page needs. */
export function standalone(picture: SVGSVGElement): string {
  const copy = picture.cloneNode(true) as SVGSVGElement;
  copy.removeAttribute("style");
  for (const name of ["data-scale", "data-left", "data-top"]) copy.removeAttribute(name);
  for (const node of copy.querySelectorAll("[tabindex], [data-key]")) for (const name of ["tabindex", "data-key", "role"]) node.removeAttribute(name);
  return new XMLSerializer().serializeToString(copy);
}
