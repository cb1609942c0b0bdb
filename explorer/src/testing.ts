/** What tests, and other programs that drive the page, may call: `foonExplorer` of the window. */

import type { NodeRow, WorldRow } from "./foon/data";
import { World } from "./foon/world";
import { treeOf, type Tree } from "./foon/tree";
import type { Answer, Asked, Query } from "./solve/query";
import type { Retriever } from "./solve/retrieve";
import type { Solver } from "./solve/solver";

interface TreeValue {
  readonly units: readonly number[];
  readonly executable: boolean;
  readonly costs: Tree["costs"];
  readonly rounds: readonly number[];
}

export interface Api {
  /** What the kitchen can make: ids of units by round, and objects by round. */
  reach(row: WorldRow): { needs: number[][]; makes: number[][]; available: [number, number][]; executable: [number, number][] };
  ask(row: WorldRow | null, asked: Asked): Promise<{ status: string; trees: TreeValue[]; reason: Answer["reason"] }>;
  pareto(row: WorldRow | null, asked: Asked): Promise<TreeValue[]>;
  /** End whatever is being solved. */
  stop(): void;
  replay(row: WorldRow | null, goals: readonly NodeRow[], ids: readonly number[]): TreeValue;
}

export function testing(retriever: Retriever, solver: Solver, current: () => World): Api {
  const worldOf = (row: WorldRow | null): World => (row === null ? current() : World.of(row));
  const numbers = (world: World, goals: readonly NodeRow[]): number[] =>
    goals.map((goal) => {
      const number = world.numberOfRow(goal);
      if (number === undefined) throw new Error(`unknown object ${JSON.stringify(goal)}`);
      return number;
    });
  const query = (world: World, asked: Asked): Query => ({ ...asked, goals: numbers(world, asked.goals) });
  const value = (world: World, tree: Tree): TreeValue => ({
    units: tree.units.map((unit) => world.unit(unit).id),
    executable: tree.replay.executable,
    costs: tree.costs,
    rounds: tree.steps.map((step) => step.round),
  });
  return {
    reach(row) {
      const world = World.of(row);
      const { needs, makes } = world.readings;
      return {
        needs: needs.map((each) => [...each]),
        makes: makes.map((each) => [...each]),
        available: [...world.closure.available],
        executable: [...world.closure.executable],
      };
    },
    async ask(row, asked) {
      const world = worldOf(row);
      const answer = await retriever.retrieve(world, query(world, asked));
      return { status: answer.status, trees: answer.trees.map((tree) => value(world, tree)), reason: answer.reason };
    },
    async pareto(row, asked) {
      const world = worldOf(row);
      const trees: TreeValue[] = [];
      for await (const tree of retriever.pareto(world, query(world, asked))) trees.push(value(world, tree));
      return trees;
    },
    stop() {
      solver.stop();
    },
    replay(row, goals, ids) {
      const world = worldOf(row);
      const byId = new Map(world.units.map((unit, number) => [unit.id, number]));
      return value(world, treeOf(world, numbers(world, goals), ids.map((id) => byId.get(id)!)));
    },
  };
}
