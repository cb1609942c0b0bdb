"""All that reads what others wrote, each with files of its kind to start from."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from random import Random

import msgspec

from drill.mutate import mutated
from drill.sealed_stores import SealedStore
from foon_asp.asp.heads import PURPOSES
from foon_asp.asp.rules import check_rules
from foon_asp.batch.answerer import Answerer, Settings
from foon_asp.errors import FoonError
from foon_asp.io.files import read_string
from foon_asp.io.folder import Sources
from foon_asp.io.kitchen import KitchenFiles, read_goals, read_labels
from foon_asp.io.motions import read_rates
from foon_asp.io.object_wire import object_to_json
from foon_asp.io.text import object_lines, write_text
from foon_asp.model.world import World
from foon_asp.planning.pddl.names import read_names
from foon_asp.planning.pddl.plan_file import read_plan
from foon_asp.planning.pddl.write import written_names
from foon_asp.query.goals import find_goal, find_object
from foon_asp.query.wire import parse_line, query_id, read_query
from support.foon_texts import DIALECTS, EXAMPLES
from support.paths import ROOT
from support.pddl_exports import exported, soup
from support.reading_checks import check, check_reading


@dataclass(frozen=True, slots=True)
class Reader:
    """What reads bytes, and how many of them are tried in a turn; `read` raises `FoonError` or nothing.

    If `filed`, the bytes lie in a file, too. `seconds`: how long it may take beside a second a megabyte.
    """

    draw: Callable[[Random], bytes]
    read: Callable[[bytes, Path], object]
    turn: int
    seconds: float = 0.5
    filed: bool = True


def readers(folder: Path) -> dict[str, Reader]:
    """Return all readers; they keep what they need in a folder."""
    return {**_foons(), **_beside(), **_questions(folder), **_plans(folder), **_stores(folder)}


def _changes(files: Iterable[str | bytes]) -> Callable[[Random], bytes]:
    seeds = tuple(text.encode() if isinstance(text, str) else text for text in files)
    return lambda random: mutated(random.choice(seeds), seeds, random)


def _foons() -> dict[str, Reader]:
    texts = {name: text for name, text in DIALECTS.items() if not name.startswith("J")}
    jsons = [text for name, text in DIALECTS.items() if name.startswith("J")]
    odd = [text if isinstance(text, bytes) else text.encode() for text in EXAMPLES.values()]
    odd_jsons = [data for data in odd if data[:1] in (b"[", b"{")]
    odd_texts = [data for data in odd if data not in odd_jsons]
    text, json_text = _changes([*texts.values(), *odd_texts]), _changes([*jsons, *odd_jsons])
    return {
        "FOON text": Reader(text, lambda data, _: check_reading(data), 200, filed=False),
        "FOON JSON": Reader(json_text, lambda data, _: check_reading(data), 200, filed=False),
        "FOON there and back": Reader(
            lambda random: (text if random.random() < 0.6 else json_text)(random),
            lambda data, _: check(data),
            6,
            2.0,
        ),
    }


def _start(name: str, size: int = 600) -> str:
    return (ROOT / "data" / name).read_text(encoding="utf-8")[:size].rpartition("\n")[0] + "\n"


def _beside() -> dict[str, Reader]:
    nodes = [msgspec.to_builtins(object_to_json(node)) for node in soup().foon.objects]
    text = "\n".join(row for node in soup().foon.objects for row in object_lines(node))
    labels = "\n".join(map(str, soup().foon.objects))
    counted = json.dumps([{**node, "quantity": 2} for node in nodes[:4]], indent=1)
    kitchens = [json.dumps(nodes), counted, text, labels]
    where = soup()

    def goals(_: bytes, path: Path) -> None:
        for node in read_goals(str(path), where.foon)[0]:
            find_object(where, node)

    def kitchen(_: bytes, path: Path) -> None:
        World.of(where.foon, KitchenFiles(str(path)).read(where.foon)[0])

    return {
        "kitchens": Reader(_changes(kitchens), kitchen, 100),
        "goal files": Reader(_changes(kitchens), goals, 100),
        "rates": Reader(
            _changes([_start("motion.txt"), "chop\t0.5\n"]), lambda _, path: read_rates(path), 100
        ),
        "labels": Reader(
            _changes([_start("utensils.txt", 200), "# diet\nmilk\n"]), lambda _, path: read_labels(path), 100
        ),
    }


_QUERIES = (
    '{"goal": "onion [chopped]", "by": "units,success", "id": 7}',
    '{"goal": ["soup", {"label": "onion", "states": ["chopped"]}], "method": "greedy", "remove": []}',
    '{"goal": "soup [ready]", "constraints": {"max_units": 5, "avoid_motions": ["wash"], "human_steps": 1}, '
    '"time_limit": 0.5, "kitchen": ["onion [whole]", "knife", "bowl [empty]", "water"]}',
    '{"goal": "bowl [empty]", "constraints": {"without_tools": ["knife"], "max_depth": 9}, "add": ["soup"]}',
)
_RULES = (
    ':- use(U), motion(U,"shake").\n% a comment\nviolated("dear",U) :- use(U), U > 3.\n',
    "mine(X,Y) :- output(X,Y), not kitchen(Y).\n#show mine/2.\n#show name(O) : kitchen(O).\n",
    'penalty("water",U,2) :- use(U), input(U,O), label(O,"water").\nfactor("water",3).\n',
    'criterion("own",1). #const n = 3. { took(X) : X = 1..n } 1 :- not q. q :- #sum { X : took(X) } > 2.\n',
    '#minimize { 1@2,U : use(U) }.\n-p(1;2). p(f("a",g(1..3))) :- q, &a { x }.\n:~ q. [1@3,x]\n',
)


def _questions(folder: Path) -> dict[str, Reader]:
    where = soup()
    (folder / "FOON.txt").write_text(write_text(where.foon, where.foon.units), encoding="utf-8")
    kitchen = [msgspec.to_builtins(object_to_json(node)) for node in where.kitchen.objects]
    (folder / "kitchen.json").write_text(json.dumps(kitchen), encoding="utf-8")
    rates = "".join(f"{motion}\t{rate}\n" for motion, rate in where.kitchen.rates.items())
    (folder / "motion.txt").write_text(rates, encoding="utf-8")
    answerer = Answerer(Sources.of(folder), Settings(time_limit=1))
    goals = [str(node) for node in where.foon.objects]

    def goal(data: bytes, _: Path) -> None:
        find_goal(where, data.decode("utf-8", "surrogateescape"))

    def question(data: bytes, _: Path) -> None:
        value = parse_line(data)
        query_id(value)
        query = read_query(value)
        query.checked(query.seen_in(where))

    def rules(_: bytes, path: Path) -> None:
        text = read_string(path)
        for purpose in PURPOSES:
            try:
                check_rules(text, purpose)
            except FoonError:
                continue

    def answer(data: bytes, _: Path) -> None:
        for row in answerer.answer([(1, data)]):
            assert b"internal error" not in row.json, row.json

    return {
        "goal texts": Reader(_changes(goals), goal, 100, filed=False),
        "queries": Reader(_changes(_QUERIES), question, 100, filed=False),
        "rules": Reader(_changes(_RULES), rules, 20),
        "answers": Reader(_changes(_QUERIES), answer, 3, 30),
    }


def _plans(folder: Path) -> dict[str, Reader]:
    where = soup()
    text = written_names(exported(where, where.foon.objects[-2:-1], criterion="units"))
    (folder / "names.json").write_text(text, encoding="utf-8")
    names = read_names(folder / "names.json", where)
    steps = [" ".join((action, *(names.arguments_of(action) or ()))) for action in names.units]
    plain = "".join(f"({step})\n" for step in steps) + "; cost = 4\n"
    timed = "".join(f"{place}.5: ({step}) [1.0]\n" for place, step in enumerate(steps))
    return {
        "plans": Reader(_changes([plain, timed]), lambda _, path: read_plan(path, names), 100),
        "names of plans": Reader(_changes([text]), lambda _, path: read_names(path, where), 20),
    }


def _stores(folder: Path) -> dict[str, Reader]:
    store = SealedStore(folder)
    return {
        "sealed tables": Reader(store.draw_table, store.read, 2, 2.0),
        "sealed bytes": Reader(store.draw_bytes, store.read, 2, 2.0),
        "sealed manifests": Reader(store.draw_manifest, store.read, 4, 2.0),
    }
