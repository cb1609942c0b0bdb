/** The worker that lays out pictures: Graphviz, one graph after the other. It is given DOT without any text of a FOON. */

import { Graphviz } from "@hpcc-js/wasm-graphviz";

const loaded = Graphviz.load();

self.onmessage = async (event: MessageEvent<{ number: number; dot: string }>): Promise<void> => {
  const { number, dot } = event.data;
  try {
    self.postMessage({ number, json: (await loaded).layout(dot, "json", "dot") });
  } catch (error) {
    self.postMessage({ number, error: String(error) });
  }
};
