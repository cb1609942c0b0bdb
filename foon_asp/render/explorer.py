"""The explorer: one page with a FOON, a kitchen, the encodings and the solver, which needs nothing else.

Its program is in `explorer/`, and built in `foon_asp/explorer/`. Here it is given its data, as JSON that
nothing can break out of.
"""

from __future__ import annotations

import base64
import gzip
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import NamedTuple

import msgspec

from foon_asp import resources
from foon_asp.asp.encodings import encoding_files, encoding_path
from foon_asp.errors import QueryError
from foon_asp.io.kitchen import read_labels
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, UnitId
from foon_asp.model.reachability import backward
from foon_asp.model.world import World
from foon_asp.words import counted

MOST = 10_000
"""How many units a page has at most."""

_ROOTS = (
    "retrieval/task_tree.lp",
    "retrieval/greedy.lp",
    "retrieval/ids.lp",
    "retrieval/alternatives.lp",
    "retrieval/pareto.lp",
    "retrieval/missing.lp",
    "constraints/constraints.lp",
    "constraints/conflict.lp",
    "criteria/rounds.lp",
    *(
        f"criteria/{name}.lp"
        for name in ("units", "success", "inputs", "depth", "tools", "dirty", "motions", "time", "cost")
    ),
)
"""The encodings that the page asks for by name; what they include comes along."""

_MARK = re.compile(r"@(DATA|LICENCES|CLINGO_WORKER|CLINGO_WASM|GRAPHVIZ_WORKER)@")
_LEVEL = 9


class Page(NamedTuple):
    """A page, how many units it has, and a sentence about what it leaves out, if anything."""

    text: str
    units: int
    left_out: str


def explorer_page(
    world: World, *, title: str, options: Sequence[str] = (), goals: Iterable[ObjectNode] = ()
) -> Page:
    """Return the page of a world; with `goals`, of the units that can matter for them.

    `title` says which data these are. `options` are those of a command line that names the same data, without
    goals. Raises `QueryError` if there are more units than a page can hold.
    """
    named = tuple(goals)
    units, left_out = _sliced(world, named)
    data = {
        "version": resources.program_version(),
        "options": list(options),
        "world": world_rows(world, units, named, title=title, left_out=left_out),
        "encodings": {name: _encoding(name) for name in sorted(encoding_files(_ROOTS))},
        "diets": {name: sorted(read_labels(path)) for name, path in resources.diets().items()},
    }
    folder = resources.folder("explorer")

    def part(mark: re.Match[str]) -> str:
        if mark[1] == "DATA":
            return inert(data)
        if mark[1] == "CLINGO_WASM":
            packed = gzip.compress((folder / "clingo.wasm").read_bytes(), _LEVEL, mtime=0)
            return base64.b64encode(packed).decode("ascii")
        name = {"LICENCES": "LICENSES.txt"}.get(mark[1], mark[1].lower().replace("_", "-") + ".js")
        return (folder / name).read_text(encoding="utf-8")

    text = _MARK.sub(part, (folder / "page.html").read_text(encoding="utf-8"))
    return Page(text, len(units), left_out)


def world_rows(
    world: World,
    units: Sequence[UnitId] | None = None,
    named: Sequence[ObjectNode] = (),
    *,
    title: str,
    left_out: str = "",
) -> dict[str, object]:
    """Return a world as the page reads it, for JSON: all its units or some, and goals that come first."""
    chosen = list(world.foon.units.ids) if units is None else units
    return {"title": title, "slice": left_out, **_Rows(world, chosen, named).value()}


def inert(value: object) -> str:
    """Return JSON that is no markup wherever it stands: no character of it begins a tag, or an entity."""
    text = msgspec.json.encode(value).decode("utf-8")
    for sign in "<>&\u2028\u2029":
        text = text.replace(sign, f"\\u{ord(sign):04x}")
    return text


def _encoding(name: str) -> str:
    return encoding_path(name).read_text(encoding="utf-8")


def _sliced(world: World, goals: Sequence[ObjectNode]) -> tuple[Sequence[UnitId], str]:
    """Return which units the page has, and a sentence about what it leaves out, if anything."""
    every = world.foon.units.ids
    if not goals:
        if len(every) > MOST:
            raise QueryError(
                f"the FOON has {counted(len(every), 'unit')}, and a page at most {MOST:,}; name the dishes"
                " that matter, with --goal"
            )
        return list(every), ""
    ids = [world.id_of(goal) for goal in goals]
    units, kitchen = backward(world.units, ids, ()), ""
    if len(units) > MOST:
        # What is at hand need not be made, unless the kitchen is changed.
        units, kitchen = backward(world.units, ids, world.stock), ", given the kitchen as it is"
    if len(units) > MOST:
        raise QueryError(
            f"{counted(len(units), 'unit')} can matter for these goals, and a page has at most {MOST:,}; name"
            " fewer goals"
        )
    named = "; ".join(map(str, goals))
    return units, (
        f"This page has {len(units):,} of the {counted(len(every), 'unit')}:"
        f" those that can matter for {named}{kitchen}."
    )


@dataclass(frozen=True, slots=True)
class _Rows:
    """A world as the page reads it (`explorer/src/foon/data.ts`), with some of its units."""

    world: World
    units: Sequence[UnitId]
    named: Sequence[ObjectNode]

    def value(self) -> dict[str, object]:
        """Return the value for JSON."""
        world, kitchen = self.world, self.world.kitchen
        chosen = [world.foon.units[number] for number in self.units]
        goals = list(dict.fromkeys(map(world.id_of, [*self.named, *filter(self._is_known, world.goals)])))
        listed = {number for unit in chosen for number in (*unit.inputs, *unit.outputs)}
        whole = len(chosen) == len(world.foon.units)
        kept = list(world.ids) if whole else sorted(listed | set(map(world.id_of, self.named)))
        place = {number: index for index, number in enumerate(kept)}
        files, videos = _Numbered(), _Numbered()
        nodes = [world.node(number) for number in kept]
        named = {label for node in nodes for label in node.named_labels}
        motions = {unit.motion.rstrip("*").rstrip() for unit in chosen}
        return {
            "objects": [_node(node) for node in nodes],
            "units": [_unit(unit, place, files, videos) for unit in chosen],
            "files": files.texts,
            "videos": videos.texts,
            "goals": [place[goal] for goal in goals if goal in place],
            "kitchen": {
                "objects": [place[number] for number in world.stock if number in place],
                "utensils": sorted(kitchen.utensils & named),
                "rates": {
                    motion: rate for motion, rate in sorted(kitchen.rates.items()) if motion in motions
                },
                "default_rate": kitchen.default_rate,
                "costs": {
                    motion: cost for motion, cost in sorted(kitchen.costs.items()) if motion in motions
                },
                "default_cost": kitchen.default_cost,
            },
            "level": world.level,
            "strict": world.strict,
            "loose": world.units.loose,
        }

    def _is_known(self, goal: ObjectNode) -> bool:
        return self.world.foon.id_of(goal) is not None or goal in self.world.strangers


def _node(node: ObjectNode) -> list[object]:
    return [node.label, [[state.name, state.relatum, state.contents] for state in node.states]]


class _Numbered:
    """Texts, each once, by their places."""

    def __init__(self) -> None:
        self._places: dict[str, int] = {}

    @property
    def texts(self) -> list[str]:
        """The texts in the order of their places."""
        return list(self._places)

    def place(self, text: str) -> int:
        """Return the place of a text, -1 for none."""
        return self._places.setdefault(text, len(self._places)) if text else -1


def _unit(
    unit: FunctionalUnit, place: dict[ObjectId, int], files: _Numbered, videos: _Numbered
) -> dict[str, object]:
    note = unit.annotation
    value: dict[str, object] = {
        "id": unit.id,
        "motion": unit.motion,
        "inputs": [place[number] for number in unit.inputs],
        "outputs": [place[number] for number in unit.outputs],
        "sources": [
            [files.place(PurePath(source.file).name), source.line, videos.place(source.video)]
            for source in note.sources
        ],
    }
    known = {
        "composite": note.composite or None,
        "start": note.start,
        "end": note.end,
        "duration": unit.duration,
        "rate": note.rate,
        "agent": note.agent or None,
    }
    return {**value, **{name: each for name, each in known.items() if each is not None}}
