/** What stands in the page beside the program: data, the scripts of the workers, the compiled solver. */

import type { PageData } from "./foon/data";
import { Solver } from "./solve/solver";

const block = (id: string): string => document.getElementById(id)?.textContent ?? "";

export const readData = (): PageData => JSON.parse(block("data")) as PageData;

export const readLicences = (): string => block("licences");

/** Start a worker whose script is a block of the page. */
export function startWorker(id: string): Worker {
  const url = URL.createObjectURL(new Blob([block(id)], { type: "text/javascript" }));
  const worker = new Worker(url);
  // The script is read when the worker starts; the address is not needed any more then.
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
  return worker;
}

export const startSolver = (): Solver => new Solver(() => startWorker("clingo-worker"), compiledSolver());

async function compiledSolver(): Promise<WebAssembly.Module> {
  const packed = Uint8Array.from(atob(block("clingo-wasm")), (character) => character.charCodeAt(0));
  const unpacked = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return WebAssembly.compile(await new Response(unpacked).arrayBuffer());
}
