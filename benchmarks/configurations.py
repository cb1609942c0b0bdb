"""Compare configurations of clingo on the questions that foon_asp asks it.

    python benchmarks/configurations.py [--sample N] [--limit S] [--generated DIR] [--output FILE]

The goals are the 23 of the public universal FOON that can be made, N of the objects that can be made, evenly
spread over the FOON (default: 12), and the first N goals of a generated FOON of 100,000 units. The questions:

- `units`: fewest units, for each goal;
- `success`: likeliest to succeed and then fewest units, for each of the 23 goals;
- `human`: the same with three steps done by a human, who never fails, for each of the 23 goals;
- `menu`: one tree of fewest units for all 23 goals.

Every goal is asked of all configurations before the next, in an order that rotates, in one process. Timed is
solving alone, from the grounded program to the proof: grounding is the same for all. A configuration that
has no proof after S seconds (default: 1; for the menu 5 times as many) counts with S. All proven optima of a
question must be the same. Writes benchmarks/results/configurations.json.
"""

from __future__ import annotations

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

from machine import DATA, RESULTS, Machine

from foon_asp.asp.facts import facts
from foon_asp.asp.program import OPTIMISE
from foon_asp.asp.solver import Solver, open_solver
from foon_asp.io.folder import load
from foon_asp.limits import limited
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.constraints import FREE, Constraints
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.query.tariff import success_tariff

GENERATED = 100_000

_BB = "--opt-strategy=bb"
CONFIGURATIONS: dict[str, tuple[str, ...]] = {
    "bb": ("--opt-strategy=bb,lin",),
    "bb,hier": ("--opt-strategy=bb,hier",),
    "bb,inc": ("--opt-strategy=bb,inc",),
    "bb,dec": ("--opt-strategy=bb,dec",),
    "bb, sign and model": (_BB, "--opt-heuristic=sign,model"),
    "bb, domain heuristic": (_BB, "--heuristic=World", "--dom-mod=false,opt"),
    "usc,oll": ("--opt-strategy=usc,oll",),
    "usc,one": ("--opt-strategy=usc,one",),
    "usc,k": ("--opt-strategy=usc,k",),
    "usc,pmres": ("--opt-strategy=usc,pmres",),
    "usc,oll,stratify": OPTIMISE,
    "usc,oll,disjoint": ("--opt-strategy=usc,oll,disjoint",),
    "usc,oll,stratify,disjoint,succinct": ("--opt-strategy=usc,oll,stratify,disjoint,succinct",),
    "usc,one,stratify": ("--opt-strategy=usc,one,stratify",),
    "usc,k,stratify": ("--opt-strategy=usc,k,stratify",),
    **{
        f"usc,oll,stratify, {name}": (*OPTIMISE, f"--configuration={name}")
        for name in ("tweety", "trendy", "handy", "crafty")
    },
    "usc,oll,stratify, 2 threads compete": (*OPTIMISE, "--parallel-mode=2,compete"),
    "usc,oll,stratify, 2 threads split": (*OPTIMISE, "--parallel-mode=2,split"),
    "bb, 2 threads compete": (_BB, "--parallel-mode=2,compete"),
}


@dataclass(frozen=True, slots=True)
class Question:
    """What is asked: goals over a domain, under constraints, by criteria, and for how long at most."""

    name: str
    world: World
    goals: tuple[ObjectNode, ...]
    by: str
    constraints: Constraints
    limit: float


@dataclass(frozen=True, slots=True)
class Outcome:
    """How a configuration did on a kind of question; seconds, with the limit where nothing was proven."""

    question: str
    configuration: str
    options: tuple[str, ...]
    asked: int
    proven: int
    median: float
    geometric_mean: float
    maximum: float
    total: float


@dataclass(frozen=True, slots=True)
class Configurations:
    """The outcome of a run, for the report. `limits` are seconds by question."""

    machine: Machine
    command: str
    limits: dict[str, float]
    present: dict[str, str]
    outcomes: tuple[Outcome, ...]

    @classmethod
    def read(cls, path: Path) -> Configurations:
        data = json.loads(path.read_text(encoding="utf-8"))
        outcomes = tuple(Outcome(**row | {"options": tuple(row["options"])}) for row in data.pop("outcomes"))
        return cls(**data | {"machine": Machine.of(data["machine"]), "outcomes": outcomes})

    def write(self, path: Path) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(asdict(self), indent=1) + "\n", encoding="utf-8")


PRESENT = {"human": "bb, sign and model"}
"""The configuration that foon_asp uses, where it is not `usc,oll,stratify`."""


def solver(question: Question, options: Sequence[str]) -> Solver:
    """Return the solver of a question as `foon_asp.program` builds it, with options of our own."""
    ids = tuple(map(question.world.id_of, question.goals))
    problem = Problem(question.world, ids, constraints=question.constraints)
    objective = Objective.parse(question.by).complete
    names = [name for criterion in objective for name in criterion.names]
    encodings = ["retrieval/task_tree.lp", *(f"criteria/{name}.lp" for name in names)]
    if question.constraints != FREE:
        encodings.append("constraints/constraints.lp")
    text = facts(problem, success_tariff(problem) if "success" in names else None)
    for place, name in enumerate(names):
        text += f'criterion("{name}",{len(names) - place}).\npenalty("{name}","base",1).\n'
    rounds = question.world.closure.available
    horizon = max(rounds.get(goal, 1) for goal in ids)
    constants: dict[str, str | int] = {"founded": 1, "strict": 0, "horizon": horizon}
    return open_solver(encodings, text, constants, options)


def questions(folder: Path, sample: int, limit: float, generated: Path) -> Iterator[Question]:
    """Yield what is asked."""
    data = load(folder)
    world = data.world()
    closure = world.closure.available
    goals = tuple(goal for goal in data.goals if world.id_of(goal) in closure)
    others = sorted(number for number in closure if number not in world.stock)
    spread = [others[len(others) * place // sample] for place in range(sample)]
    for goal in (*goals, *(world.node(number) for number in spread)):
        yield Question("units", world, (goal,), "units", FREE, limit)
    for goal in goals:
        yield Question("success", world, (goal,), "success", FREE, limit)
    for goal in goals:
        yield Question("human", world, (goal,), "success", Constraints(human_steps=3), limit)
    yield Question("menu", world, goals, "units", FREE, 5 * limit)
    large = load(generated)
    world = large.world()
    for goal in large.goals[:: max(1, len(large.goals) // sample)][:sample]:
        yield Question("units, generated", world, (goal,), "units", FREE, limit)


def measure(asked: Sequence[Question], names: Sequence[str]) -> Iterator[tuple[str, str, float, bool]]:
    """Yield question, configuration, seconds and whether it was proven, for everything that is asked."""
    for place, question in enumerate(asked):
        optima: dict[tuple[int, ...], str] = {}
        turn = place % len(names)
        for name in (*names[turn:], *names[:turn]):
            control = solver(question, CONFIGURATIONS[name])
            begun = time.perf_counter()
            with limited(question.limit):
                answer = control.best()
            seconds = min(time.perf_counter() - begun, question.limit)
            if answer.proven:
                optima.setdefault(answer.costs, name)
            yield question.name, name, seconds if answer.proven else question.limit, answer.proven
        if len(optima) > 1:
            raise SystemExit(f"{question.name}, {question.goals[0]}: optima differ: {optima}")


def summarise(rows: Sequence[tuple[str, str, float, bool]]) -> Iterator[Outcome]:
    """Yield an outcome for each question and configuration, in the order in which they first come."""
    for kind, name in dict.fromkeys((row[0], row[1]) for row in sorted(rows, key=_place)):
        mine = [row for row in rows if row[:2] == (kind, name)]
        seconds = [row[2] for row in mine]
        yield Outcome(
            kind,
            name,
            CONFIGURATIONS[name],
            len(mine),
            sum(row[3] for row in mine),
            statistics.median(seconds),
            statistics.geometric_mean(seconds),
            max(seconds),
            sum(seconds),
        )


def _place(row: tuple[str, str, float, bool]) -> tuple[int, int]:
    kinds = ["units", "units, generated", "success", "human", "menu"]
    return kinds.index(row[0]), list(CONFIGURATIONS).index(row[1])


def _generate(folder: Path) -> Path:
    generator = Path(__file__).with_name("generate.py")
    subprocess.run([sys.executable, str(generator), "--units", str(GENERATED), str(folder)], check=True)
    return folder


def main() -> None:
    parser = argparse.ArgumentParser(description="Compare configurations of clingo.")
    parser.add_argument("--sample", type=int, default=12, metavar="N")
    parser.add_argument("--limit", type=float, default=1.0, metavar="S", help="seconds for a question")
    parser.add_argument(
        "--generated", type=Path, metavar="DIR", help="a generated FOON that is there already"
    )
    parser.add_argument("--only", nargs="+", choices=CONFIGURATIONS, help="only these configurations")
    parser.add_argument("--output", type=Path, default=RESULTS / "configurations.json")
    options = parser.parse_args()
    if not (DATA / "FOON.txt").exists():
        print(f"nothing measured: no FOON.txt in {DATA}; set FOON_PUBLIC_DATA", file=sys.stderr)
        return
    with tempfile.TemporaryDirectory() as temporary:
        generated = options.generated or _generate(Path(temporary))
        asked = list(questions(DATA, options.sample, options.limit, generated))
    rows = list(measure(asked, options.only or list(CONFIGURATIONS)))
    outcomes = tuple(summarise(rows))
    limits = {question.name: question.limit for question in asked}
    present = {name: PRESENT.get(name, "usc,oll,stratify") for name in limits}
    command = f"python benchmarks/configurations.py --sample {options.sample} --limit {options.limit:g}"
    Configurations(Machine.here(), command, limits, present, outcomes).write(options.output)
    for each in outcomes:
        print(
            f"{each.question:17} {each.configuration:36} {each.proven:3}/{each.asked:<3} "
            f"median {each.median * 1000:8.2f} ms, geomean {each.geometric_mean * 1000:8.2f} ms, "
            f"max {each.maximum:6.3f} s"
        )


if __name__ == "__main__":
    main()
