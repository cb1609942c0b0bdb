/** Asks the worker that solves, one program after the other; a stop ends the worker and starts another one. */

import type { Ask, Heard } from "./worker";

/** The best model, or none; `proven` says that no better one exists, or none at all. */
export interface Model {
  readonly atoms: readonly string[] | null;
  readonly costs: readonly number[];
  /** What is proven of the costs so far, from the highest priority down. */
  readonly lower: readonly number[];
  readonly proven: boolean;
  readonly seconds: number;
}

/** The search was stopped by hand. */
export class Stopped extends Error {
  constructor() {
    super("stopped");
  }
}

const PROVEN = new Set(["OPTIMUM FOUND", "UNSATISFIABLE"]);

export class Solver {
  private worker: Worker | undefined;
  private queue: Promise<unknown> = Promise.resolve();
  private abort: ((error: Error) => void) | undefined;
  /** Grows with each stop: what was asked before it is not asked any more. */
  private stops = 0;

  /** `start` makes a worker, `wasm` is the compiled solver. */
  constructor(
    private readonly start: () => Worker,
    private readonly wasm: Promise<WebAssembly.Module>,
  ) {}

  /** Solve a program; `onModel` hears of each model that is better than those before, and of each better bound. */
  run(program: string, options: string, onModel?: (model: Model) => void): Promise<Model> {
    const stops = this.stops;
    const ended = this.queue.then(async () => {
      if (stops !== this.stops) throw new Stopped();
      return this.ask({ program, options }, stops, onModel);
    });
    this.queue = ended.catch(() => undefined);
    return ended;
  }

  /** End whatever is being solved. */
  stop(): void {
    this.stops += 1;
    this.abort?.(new Stopped());
  }

  private async ask(ask: Ask, stops: number, onModel?: (model: Model) => void): Promise<Model> {
    const wasm = await this.wasm;
    if (stops !== this.stops) throw new Stopped();
    if (this.worker === undefined) {
      this.worker = this.start();
      this.worker.postMessage(wasm);
    }
    const worker = this.worker;
    let best: Model = { atoms: null, costs: [], lower: [], proven: false, seconds: 0 };
    try {
      return await new Promise<Model>((resolve, reject) => {
        this.abort = reject;
        worker.onerror = (event): void => reject(new Error(event.message));
        worker.onmessage = ({ data }: MessageEvent<Heard>): void => {
          if (data.kind === "model") {
            best = { ...best, atoms: data.atoms, costs: data.costs };
            onModel?.(best);
          } else if (data.kind === "bound") {
            best = { ...best, lower: data.lower };
            onModel?.(best);
          } else if (data.kind === "error") reject(new Error(data.message));
          else resolve({ ...best, proven: PROVEN.has(data.result) || (data.result === "SATISFIABLE" && best.costs.length === 0), seconds: data.seconds });
        };
        worker.postMessage(ask);
      });
    } catch (error) {
      worker.terminate();
      this.worker = undefined;
      throw error;
    } finally {
      this.abort = undefined;
    }
  }
}

/** The first arguments of the atoms of a predicate that are numbers, sorted, each once. */
export function column(model: Model, predicate: string): number[] {
  const start = `${predicate}(`;
  const numbers = (model.atoms ?? []).filter((atom) => atom.startsWith(start)).map((atom) => Number.parseInt(atom.slice(start.length), 10));
  return [...new Set(numbers)].sort((one, other) => one - other);
}

/** The single arguments of the atoms of a predicate that are texts. */
export function texts(model: Model, predicate: string): string[] {
  const start = `${predicate}(`;
  return (model.atoms ?? [])
    .filter((atom) => atom.startsWith(start))
    .map((atom) => JSON.parse(atom.slice(start.length, -1)) as string)
    .sort();
}
