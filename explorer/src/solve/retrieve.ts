/**
 * From a question to checked task trees. Every rule is in the encodings; here are the loops around them, which mirror
 * `retrieval/`, and the replay that every tree passes before it is returned.
 */

import { backward, leading } from "../foon/graph";
import { treeOf, type Criterion, type Tree } from "../foon/tree";
import type { World } from "../foon/world";
import type { Encodings } from "./encodings";
import { facts, finerFacts } from "./facts";
import { Problem, named, type NamedConstraint } from "./problem";
import type { Answer, Query, Reason } from "./query";
import { Stopped, column, texts, type Model, type Solver } from "./solver";
import { boundOf, tariffOf, type Tariff } from "./tariff";
import { Lack, circles } from "./lack";

const OPTIMISE = "--opt-strategy=usc,oll,stratify";
const MOST_POINTS = 200;

/** How far a search is: the best tree so far, and what is proven of the first criterion. */
export interface Progress {
  readonly better: Tree | null;
  readonly bound: number | null;
}

export type OnProgress = (progress: Progress) => void;

export class Retriever {
  constructor(
    private readonly solver: Solver,
    private readonly encodings: Encodings,
    private readonly diets: Readonly<Record<string, readonly string[]>>,
  ) {}

  /** Retrieve task trees; if it is stopped, the best so far. */
  async retrieve(world: World, query: Query, onProgress?: OnProgress): Promise<Answer> {
    const started = performance.now();
    const problem = this.pose(world, query);
    const found: Tree[] = [];
    const ended = (status: Answer["status"], reason: Reason | null, complete: boolean): Answer => ({
      query,
      status,
      trees: found,
      reason,
      complete,
      bound: status === "limit" ? so.bound : null,
      time: performance.now() - started,
    });
    let so: Progress = { better: null, bound: null };
    try {
      const reason = await this.unreachable(problem);
      if (reason !== null) return ended("unreachable", reason, true);
      if (query.method !== "optimal") {
        const tree = await this.byMethod(problem, query);
        if (tree !== null) found.push(tree);
      } else {
        const tell = ({ better, bound }: Progress): void => {
          so = { better: better ?? so.better, bound: bound ?? so.bound };
          onProgress?.(so);
        };
        tell({ better: easiest(problem), bound: null });
        for await (const tree of this.best(problem, query, tell)) found.push(tree);
      }
      if (found.length === 0) return ended("unreachable", { kind: "constraints", names: await this.conflict(problem) }, true);
      return ended(query.method === "optimal" ? "optimal" : "found", null, found.length < query.count);
    } catch (error) {
      if (!(error instanceof Stopped)) throw error;
      if (found.length === 0 && so.better !== null) found.push(so.better);
      return ended("limit", null, false);
    }
  }

  /** One tree for each trade-off between the criteria that no other tree improves on. */
  async *pareto(world: World, query: Query): AsyncGenerator<Tree> {
    const problem = this.pose(world, query);
    if ((await this.unreachable(problem)) !== null) return;
    const every = complete(query.by);
    const points: string[] = [];
    for (let number = 0; number < MOST_POINTS; number += 1) {
      const model = await this.optimum(problem, every, ["retrieval/pareto.lp"], points.join(""));
      if (model.atoms === null) return;
      yield this.decode(problem, model);
      query.by.forEach((_, place) => points.push(`point(${number},${every.length - place},${model.costs[place]}).\n`));
    }
  }

  /** The smallest set of objects with which the kitchen could make a goal; null if none helps. */
  async missing(world: World, goal: number): Promise<number[] | null> {
    if (!world.readings.makers.has(goal)) return null;
    const supplied = world.withStock([...world.stock, ...world.closure.available.keys()]);
    const problem = new Problem(supplied, [goal], false);
    const names = ["retrieval/missing.lp"];
    const text = facts(problem, { details: this.encodings.lookCloser(names) });
    const model = await this.solver.run(`${this.encodings.text(names)}\n${text}`, `${OPTIMISE} ${constants({ strict: strictness(world) })} 0`);
    return model.atoms === null ? null : column(model, "missing");
  }

  private pose(world: World, query: Query): Problem {
    return new Problem(world, [...new Set(query.goals.map((goal) => world.readings.readAs[goal]!))], query.founded, named(query.constraints, this.diets));
  }

  /** The best trees, the best first: each beside those that are known. */
  private async *best(problem: Problem, query: Query, onProgress: OnProgress): AsyncGenerator<Tree> {
    const known: string[] = [];
    const every = complete(query.by);
    for (let number = 0; number < query.count; number += 1) {
      const more = number === 0 ? [] : ["retrieval/alternatives.lp"];
      // What is proven of a further tree says nothing of the first.
      const [first] = number === 0 ? [tariffOf(problem, every[0]!)] : [];
      const model = await this.optimum(problem, every, more, known.join(""), (each) =>
        onProgress({
          better: each.atoms === null ? null : this.decode(problem, each),
          bound: first === undefined || each.lower[0] === undefined ? null : boundOf(first, each.lower[0]),
        }),
      );
      if (model.atoms === null) return;
      const tree = this.decode(problem, model);
      yield tree;
      if (tree.units.length === 0) return;
      known.push(...tree.units.map((unit) => `known(${number},${unit}).\n`));
    }
  }

  /** The best model by some criteria. Mirrors `optimisers` in `asp/program.py`. */
  private async optimum(
    problem: Problem,
    every: readonly Criterion[],
    more: readonly string[],
    extra: string,
    onModel?: (model: Model) => void,
  ): Promise<Model> {
    const { world, units } = problem;
    const names = ["retrieval/task_tree.lp", ...more, ...every.map((name) => `criteria/${name}.lp`)];
    const tariffs = every.map((name) => tariffOf(problem, name));
    const lines = every.flatMap((name, place) => [`criterion("${name}",${every.length - place}).`, `penalty("${name}","base",1).`]);
    const deepest = every.includes("depth") ? units.length : 1;
    const rounds = problem.goals.map((goal) => world.closure.available.get(goal) ?? 1);
    for (let horizon = Math.max(1, ...rounds); ; horizon *= 2) {
      const program = this.program(problem, names, { founded: problem.founded ? 1 : 0, horizon: Math.min(horizon, deepest) }, tariffs);
      const model = await this.solver.run(`${program.text}\n${lines.join("\n")}\n${extra}`, `${OPTIMISE} ${program.options} 0`, onModel);
      if (horizon >= deepest || column(model, "too_deep").length === 0) return model;
    }
  }

  /** Encodings, facts and constants of a question under its constraints. Mirrors `solver` in `asp/program.py`. */
  private program(
    problem: Problem,
    encodings: readonly string[],
    values: Readonly<Record<string, number | string>>,
    tariffs: readonly Tariff[],
  ): { text: string; options: string } {
    const names = [...encodings];
    const given: Record<string, number | string> = { ...values, strict: strictness(problem.world) };
    const rounds = problem.constraints.find((each) => each.key === "max_depth");
    if (problem.constraints.length > 0) names.push("constraints/constraints.lp");
    if (rounds !== undefined) {
      names.push("criteria/rounds.lp");
      given.horizon = Math.max(Number(given.horizon ?? 1), Math.min(Number(rounds.value), problem.units.length));
    }
    const said = {
      details: this.encodings.lookCloser(names),
      chances: tariffs.find((each) => each.criterion === "success"),
      grain: tariffs.find((each) => each.criterion === "cost")?.grain,
    };
    return { text: `${this.encodings.text(names)}\n${facts(problem, said)}`, options: constants(given) };
  }

  /** The tree of a method that is not proven. */
  private async byMethod(problem: Problem, query: Query): Promise<Tree | null> {
    if (query.method === "ids") return this.ids(problem);
    return this.greedy(problem, query.method === "first" ? "first" : query.by[0] === "inputs" ? "inputs" : "success");
  }

  /** The tree that gives each object its best unit, from the goal downwards. Mirrors `retrieval/methods/greedy.py`. */
  private async greedy(problem: Problem, by: "first" | "success" | "inputs"): Promise<Tree | null> {
    const { world } = problem;
    const chances = by === "success" ? tariffOf(problem, "success") : undefined;
    if (!problem.founded && problem.constraints.length === 0) return treeOf(world, problem.goals, unfounded(problem, by));
    const rounds = problem.goals.map((goal) => world.closure.available.get(goal) ?? 8);
    for (let horizon = 4 + Math.max(...rounds); ; horizon *= 2) {
      const values = { founded: problem.founded ? 1 : 0, by, horizon };
      const program = this.program(problem, ["retrieval/greedy.lp"], values, chances === undefined ? [] : [chances]);
      const finer = by === "success" ? finerFacts(problem) : "";
      const model = await this.solver.run(`${program.text}\n${finer}`, `${OPTIMISE} ${program.options} 0`);
      if (model.atoms === null) return null;
      if (column(model, "beyond").length === 0) return this.decode(problem, model);
    }
  }

  /** The tree of iterative deepening: one bound after the other. Mirrors `retrieval/methods/ids.py`. */
  private async ids(problem: Problem): Promise<Tree | null> {
    const { world, units } = problem;
    const shallowest = Math.max(0, ...problem.goals.map((goal) => world.closure.available.get(goal) ?? 0));
    for (let bound = shallowest; bound <= units.length; bound += 1) {
      const steps = Array.from({ length: bound }, (_, index) => index + 1);
      const text = this.encodings.unrolled("retrieval/ids.lp", { step: steps, check: [bound], choose: [bound] });
      const names = problem.constraints.length > 0 ? ["constraints/constraints.lp"] : [];
      const program = this.program(problem, names, {}, []);
      const model = await this.solver.run(`${text}\n${program.text}\nbound(${bound}).\n`, `${program.options} 1`);
      if (model.atoms !== null) return this.decode(problem, model);
    }
    return null;
  }

  /** The constraints that must give way for a tree to exist, the fewest. */
  private async conflict(problem: Problem): Promise<string[]> {
    const names = ["retrieval/task_tree.lp", "constraints/conflict.lp"];
    const program = this.program(problem, names, { founded: problem.founded ? 1 : 0 }, []);
    return texts(await this.solver.run(program.text, `${OPTIMISE} ${program.options} 0`), "waived");
  }

  /** Why no tree can exist, by plain graph search; null if one can. */
  private async unreachable({ world, goals, founded }: Problem): Promise<Reason | null> {
    for (const goal of goals) {
      if (world.stock.has(goal)) continue;
      if (!world.readings.makers.has(goal)) return { kind: "no maker", goal };
      if (founded && !world.closure.available.has(goal)) {
        const lack = Lack.of(world, goal);
        return { kind: "lacking", goal, add: await this.missing(world, goal), circles: lack.circular ? circles(world, lack) : [] };
      }
    }
    return null;
  }

  private decode(problem: Problem, model: Model): Tree {
    const tree = treeOf(problem.world, problem.goals, column(model, "use"));
    if (problem.founded && !tree.replay.executable) throw new Error("a founded task tree fails its replay");
    return tree;
  }
}

/** Some tree at once, so that there is one however long a best one is looked for; none where there are limits. */
function easiest({ world, goals, units, founded, constraints }: Problem): Tree | null {
  if (!founded || constraints.length > 0) return null;
  return treeOf(world, goals, leading(world.readings, world.stock, goals, units));
}

/** Which goals each unit of a tree is for. */
export function dishesOf(world: World, tree: Tree): Map<number, number[]> {
  const found = new Map<number, number[]>(tree.units.map((unit) => [unit, []]));
  const among = new Set(tree.units);
  for (const goal of tree.goals) for (const unit of backward(world.readings, [goal], world.stock, among)) found.get(unit)!.push(goal);
  return found;
}

/** Last of all the fewest units, so that no tree has a superfluous one. */
export const complete = (by: readonly Criterion[]): readonly Criterion[] => (by.includes("units") ? by : [...by, "units"]);

const strictness = (world: World): number => (world.row.strict ? 1 : 0);

const constants = (values: Readonly<Record<string, number | string>>): string =>
  Object.entries(values)
    .map(([name, value]) => `-c ${name}=${value}`)
    .join(" ");

/** The selection of the published programs, where nothing stands in the way of any choice: each object its best unit. */
function unfounded({ world, goals }: Problem, by: "first" | "success" | "inputs"): Set<number> {
  const demerit = (unit: number): number => (by === "success" ? -world.rate(unit)! : by === "inputs" ? world.unit(unit).inputs.length : 0);
  const units = new Set<number>();
  const wanted = new Set(goals.filter((goal) => !world.stock.has(goal)));
  for (const object of wanted) {
    const makers = world.readings.makers.get(object) ?? [];
    if (makers.length === 0) continue;
    const best = makers.reduce((one, other) => (demerit(other) < demerit(one) ? other : one));
    units.add(best);
    for (const need of world.readings.needs[best]!) if (!world.stock.has(need)) wanted.add(need);
  }
  return units;
}

export type { NamedConstraint };
