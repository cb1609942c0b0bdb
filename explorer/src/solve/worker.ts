/** The worker that solves: clingo, one program after the other. It is given the compiled wasm first. */

import type { ClingoModule, ModuleParams } from "../../node_modules/clingo-wasm/dist/clingo.js";
import clingoModule from "../../node_modules/clingo-wasm/dist/clingo.js";
import { WitnessParser } from "../../node_modules/clingo-wasm/dist/witnesses.js";

export interface Ask {
  readonly program: string;
  readonly options: string;
}

export type Heard =
  | { readonly kind: "model"; readonly atoms: readonly string[]; readonly costs: readonly number[] }
  | { readonly kind: "bound"; readonly lower: readonly number[] }
  | { readonly kind: "done"; readonly result: string; readonly seconds: number }
  | { readonly kind: "error"; readonly message: string };

/** What the module takes beside what its package declares. */
interface Parameters extends ModuleParams {
  instantiateWasm(imports: WebAssembly.Imports, done: (instance: WebAssembly.Instance, module?: WebAssembly.Module) => void): object;
}

const createClingo: (parameters: Parameters) => Promise<ClingoModule> = clingoModule;

/** A model or, where clingo has proven a bound, that alone. */
interface Found {
  readonly Value?: string[];
  readonly Costs?: number[];
  readonly Lower?: number[];
}

let compiled: WebAssembly.Module | undefined;

self.onmessage = async (event: MessageEvent<WebAssembly.Module | Ask>): Promise<void> => {
  if (event.data instanceof WebAssembly.Module) {
    compiled = event.data;
    return;
  }
  try {
    await solve(event.data);
  } catch (error) {
    say({ kind: "error", message: String(error) });
  }
};

const say = (heard: Heard): void => self.postMessage(heard);

async function solve({ program, options }: Ask): Promise<void> {
  const output: string[] = [];
  const errors: string[] = [];
  const parser = new WitnessParser((found: Found) => {
    if (found.Value !== undefined) say({ kind: "model", atoms: found.Value, costs: found.Costs ?? [] });
    else if (found.Lower !== undefined) say({ kind: "bound", lower: found.Lower });
  });
  // A fresh instance for each program: what one run leaves behind must not reach the next.
  const clingo = await createClingo({
    print: (line) => {
      output.push(line);
      parser.feed(line);
    },
    printErr: (line) => errors.push(line),
    locateFile: (path) => path,
    instantiateWasm: (imports, done) => {
      void WebAssembly.instantiate(compiled as WebAssembly.Module, imports).then((instance) => done(instance, compiled));
      return {};
    },
  });
  const status = clingo.ccall("run", "number", ["string", "string"], [program, `--outf=2 ${options}`]);
  if ([33, 65, 128].includes(status)) throw new Error(errors.join("\n") || `clingo ended with status ${status}`);
  const found = JSON.parse(output.join("")) as { Result: string; Time: { Total: number } };
  say({ kind: "done", result: found.Result, seconds: found.Time.Total });
}
