/** Where nodes and edges of a picture lie: Graphviz tells, in a worker. It is told sizes, and no text of a FOON. */

import { startWorker } from "../page";

export interface Box {
  readonly width: number;
  readonly height: number;
}

export interface Point {
  readonly x: number;
  readonly y: number;
}

export interface Laid {
  readonly width: number;
  readonly height: number;
  /** The middle of each node. */
  readonly nodes: readonly Point[];
  /** For each edge its Bézier points, and the point of its arrow. */
  readonly edges: readonly { readonly points: readonly Point[]; readonly end: Point }[];
}

interface GraphvizJson {
  readonly bb: string;
  readonly objects?: readonly { readonly name: string; readonly pos: string }[];
  readonly edges?: readonly { readonly pos: string; readonly number: string }[];
}

/** Points of Graphviz in a pixel of the page, and inches in a point. */
const INCH = 72;

let worker: Worker | undefined;
let asked = 0;
const waiting = new Map<number, (answer: { json?: string; error?: string }) => void>();

export async function layout(boxes: readonly Box[], edges: readonly (readonly [number, number])[]): Promise<Laid> {
  const size = (box: Box): string => `width=${(box.width / INCH).toFixed(4)} height=${(box.height / INCH).toFixed(4)}`;
  const dot = [
    "digraph {",
    'graph [rankdir=TB nodesep=0.22 ranksep=0.34 splines=true] node [shape=box fixedsize=true label=""] edge [arrowsize=0.6]',
    ...boxes.map((box, place) => `n${place} [${size(box)}]`),
    ...edges.map(([from, to], place) => `n${from} -> n${to} [number="${place}"]`),
    "}",
  ].join("\n");
  const found = JSON.parse(await run(dot)) as GraphvizJson;
  const [, , width = 0, height = 0] = found.bb.split(",").map(Number);
  // Graphviz counts upwards.
  const point = (text: string): Point => {
    const [x = 0, y = 0] = text.split(",").map(Number);
    return { x, y: height - y };
  };
  const nodes: Point[] = boxes.map(() => ({ x: 0, y: 0 }));
  for (const each of found.objects ?? []) nodes[Number(each.name.slice(1))] = point(each.pos);
  const drawn = edges.map(() => ({ points: [] as Point[], end: { x: 0, y: 0 } }));
  for (const each of found.edges ?? []) {
    const parts = each.pos.split(" ");
    const end = parts.find((part) => part.startsWith("e,"));
    const points = parts.filter((part) => !/^[es],/.test(part)).map(point);
    drawn[Number(each.number)] = { points, end: end === undefined ? points.at(-1)! : point(end.slice(2)) };
  }
  return { width, height, nodes, edges: drawn };
}

function run(dot: string): Promise<string> {
  if (worker === undefined) {
    worker = startWorker("graphviz-worker");
    worker.onmessage = ({ data }: MessageEvent<{ number: number; json?: string; error?: string }>): void => {
      waiting.get(data.number)?.(data);
      waiting.delete(data.number);
    };
  }
  const number = (asked += 1);
  const active = worker;
  return new Promise((resolve, reject) => {
    waiting.set(number, ({ json, error }) => (json === undefined ? reject(new Error(error)) : resolve(json)));
    active.postMessage({ number, dot });
  });
}
