"""Ground programs that are joined of pieces, against what clingo makes of the whole question at once."""

from __future__ import annotations

import random
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import clingo
import pytest
from hypothesis import event, given
from hypothesis import strategies as st

from foon_asp.asp.control import Program
from foon_asp.asp.encodings import encoding_files, encoding_text, looked_at
from foon_asp.asp.facts import facts, pieces, read_facts
from foon_asp.asp.joined import joined
from foon_asp.asp.pieces import Kept, Kind, blocks
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.query import Query
from foon_asp.query.tariff import success_tariff
from foon_asp.retrieval.retrieve import retrieve
from support.examples import many
from support.small_foons import domains, queries, world

CRITERIA = ("units", "success", "inputs", "motions", "tools", "dirty", "time")
Models = set[tuple[frozenset[str], tuple[int, ...]]]


def models(program: Program) -> Models:
    """Return what each model of a program shows, and what it pays."""
    constants = [f"-c{name}={value}" for name, value in program.constants.items()]
    control = clingo.Control(["0", "--opt-mode=ignore", *constants])
    for text in program.texts:
        control.add("base", [], text)
    if not program.ground:
        control.ground([("base", [])])
    found: Models = set()
    with control.solve(yield_=True) as handle:
        for model in handle:
            shown = frozenset(map(str, model.symbols(shown=True)))
            found.add((shown, tuple(model.cost)))
    return found


def said(names: list[str]) -> str:
    """Return the facts about criteria, the first one with the highest priority."""
    lines = []
    for priority, name in zip(range(len(names), 0, -1), names, strict=True):
        lines.append(f'criterion("{name}",{priority}). penalty("{name}","base",1).')
        if name != "success":
            lines.append(f'factor("{name}",{priority + 1}).')
    return " ".join(lines)


@pytest.mark.parametrize("details", [False, True])
@many(150)
@given(
    query=queries(),
    more=st.data(),
    names=st.lists(st.sampled_from(CRITERIA), min_size=1, max_size=3, unique=True),
)
def test_a_joined_program_has_the_models_that_clingo_grounds_at_once(
    details: bool, query: tuple[World, ObjectNode], more: Any, names: list[str]
) -> None:
    where, goal = query
    goals = [goal, *more.draw(st.lists(st.sampled_from(list(where.foon.objects)), max_size=1))]
    names = names if details else [name for name in names if name == "success"] or ["units"]
    problem = Problem.of(where, goals)
    encodings = ["retrieval/task_tree.lp", *(f"criteria/{name}.lp" for name in names)]
    constants: dict[str, str | int] = {"founded": 1, "strict": int(where.strict)}
    tariff = success_tariff(problem) if "success" in names else None
    text = facts(problem, tariff) if details else read_facts(problem, tariff)
    at_once = Program((*map(encoding_text, encoding_files(encodings)), text, said(names)), constants)
    looked = frozenset().union(*map(looked_at, encodings)) if details else ()
    text = joined(problem, encodings, constants, said(names), tariff, looked)
    in_pieces = Program((text,), {}, ground=True)
    expected = models(at_once)
    event(f"{min(len(expected), 9)} models")
    assert models(in_pieces) == expected


@many(60)
@given(domains(), st.randoms(use_true_random=False))
def test_a_piece_is_the_same_whatever_is_grounded_beside_it(where: World, mixer: random.Random) -> None:
    problem = Problem(where, (), whole=True)
    for details, name in ((False, "units"), (True, "tools")):
        kind = Kind(
            ("retrieval/task_tree.lp", f"criteria/{name}.lp"),
            (("founded", 1), ("strict", int(where.strict))),
            said([name]),
        )
        texts = [
            "",
            *dict.fromkeys(
                piece.text
                for piece in pieces(problem, details=looked_at(f"criteria/{name}.lp") if details else ())
            ),
        ]
        together = blocks(kind, texts, Kept(1000))
        mixer.shuffle(texts)
        kept = Kept(3)
        few = [texts[start : start + 2] for start in range(0, len(texts), 2)]
        assert {text: block for part in few for text, block in blocks(kind, part, kept).items()} == together
        assert len(kept) <= 3
        assert blocks(kind, texts, kept) == together


def test_threads_that_share_a_world_get_the_answers_of_one() -> None:
    """Each thread asks all questions, in an order of its own, and meets pieces that others ground."""
    where = world(
        [f"a{n} + b{n // 2} -mix-> a{n + 1} + c{n}" for n in range(12)]
        + [f"a{n} -cut-> b{n + 1}" for n in range(12)]
        + ["a3 + c1 -fry-> a9"],
        "a0 + b0",
    )
    goals = [thing for thing in where.foon.objects if where.id_of(thing) not in where.stock]
    asked = [Query(goal, by=by) for goal in goals for by in ("units", "inputs,units", "motions+2*units")]

    def answers(seed: int) -> list[str]:
        order = random.Random(seed).sample(range(len(asked)), len(asked))
        found = {place: str(retrieve(where, asked[place])) for place in order}
        return [found[place] for place in range(len(asked))]

    with ThreadPoolExecutor(4) as threads:
        together = list(threads.map(answers, range(4)))
    assert together == [answers(4)] * 4
