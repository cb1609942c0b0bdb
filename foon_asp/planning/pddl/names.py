"""Names that PDDL takes for objects and units, whatever labels hold; and the file that maps them back."""

from __future__ import annotations

import json
import math
import re
import unicodedata
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from foon_asp.errors import InputError
from foon_asp.io.files import parse_json, read_string
from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World
from foon_asp.planning.pddl.origin import foon_hash, kitchen_hash
from foon_asp.words import short_source

VERSION = 1
"""The layout of names.json; it goes up when a reader of the old one would misread the new one."""

_FORMAT = "foon-asp pddl names"
_LONGEST = 60
_NO_NAME_CHARACTER = re.compile(r"[^a-z0-9]+")
_SUPPORTED = re.compile(r"[a-z][a-z0-9-]*")

_WORDS = (
    "action action-costs adl all always always-within and assign at at-end at-most-once at-start axiom "
    "condition conditional-effects constants constraints contingent continuous-effects decrease define "
    "derived derived-predicates disjunctive-preconditions domain duration durative-action durative- "
    "actions effect either end equality event exists existential-preconditions false fluents forall "
    "functions goal hold-after hold-during imply increase init is-violated maximize method metric "
    "minimize negative-preconditions not number numeric-fluents object objects oneof or over parameters "
    "precondition predicates preference preferences probabilistic problem process quantified- "
    "preconditions requirements reward scale-down scale-up sometime sometime-after sometime-before "
    "start strips task time timed-initial-effects timed-initial-literals total-cost total-time true "
    "types typing undefined unknown universal-preconditions when within "
)

RESERVED = frozenset(_WORDS.split())
"""Words that some reader of PDDL gives a meaning of its own."""


def plain(text: str, otherwise: str = "thing") -> str:
    """Return a text as a PDDL name: lower case, accents dropped, `-` for all that no name may hold.

    Long texts are cut between words. Not one-to-one: `Namer` sees to that.
    """
    folded = unicodedata.normalize("NFKD", text).encode("ascii", "ignore").decode().lower()
    name = _NO_NAME_CHARACTER.sub("-", folded).strip("-")
    if len(name) > _LONGEST:
        name = name[: _LONGEST + 1].rpartition("-")[0] or name[:_LONGEST]
    if not name:
        return otherwise
    return name if name[0].isalpha() else f"{otherwise}-{name}"


class Namer:
    """Gives out names, each once, for objects, units and all else: some readers have one name space."""

    def __init__(self) -> None:
        self._taken = set(RESERVED)
        self._next: dict[str, int] = {}

    def name(self, text: str, otherwise: str = "thing") -> str:
        """Return a new name that reads like the text; the second one like it ends in `-2`."""
        base = name = plain(text, otherwise)
        while name in self._taken:
            count = self._next.get(base, 2)
            self._next[base] = count + 1
            name = f"{base}-{count}"
        self._taken.add(name)
        return name

    def copy(self) -> Namer:
        """Return a namer that goes on from here, and leaves this one as it is."""
        other = Namer()
        other._taken, other._next = set(self._taken), dict(self._next)
        return other

    def free(self, *texts: str) -> str:
        """Return the first of some texts that is still free as a name, or a name that reads like the last."""
        for text in texts:
            if (name := plain(text)) not in self._taken:
                self._taken.add(name)
                return name
        return self.name(texts[-1])


@dataclass(frozen=True, slots=True)
class Names:
    """What the names of an export stand for.

    `objects`: name to object id. `units`: action to unit id; several actions may stand for one unit.
    `helpers`: actions that stand for no unit, as taking a bowl out, to what they do in words. `goals` are the
    objects that were wanted, and `semantics` says what is used up. `arguments`: the names of the objects that
    an action takes, for those that take any; None if that is not known, as in files of before.
    """

    objects: Mapping[str, ObjectId]
    units: Mapping[str, UnitId]
    helpers: Mapping[str, str] = field(default_factory=dict)
    goals: tuple[ObjectId, ...] = ()
    semantics: str = "add"
    arguments: Mapping[str, tuple[str, ...]] | None = None

    def unit_of(self, action: str) -> UnitId | None:
        """Return the unit that an action stands for, None for a helper; raise `KeyError` if unknown."""
        return None if action in self.helpers else self.units[action]

    def arguments_of(self, action: str) -> tuple[str, ...] | None:
        """Return the names of the objects that an action takes; None if that is not known."""
        return None if self.arguments is None else self.arguments.get(action, ())


@dataclass(frozen=True, slots=True)
class DomainNames:
    """Names of all objects and units of a domain; the same for every goal, style and semantics.

    An action is named by its motion and the id of its unit, an object by how people write it. Names that
    an export needs beside these come from `namer`, last, so that they change none of the others.
    """

    namer: Namer
    objects: Sequence[str]
    units: Sequence[str]

    @classmethod
    def of(cls, world: World) -> DomainNames:
        """Return the names of a domain, with a namer of their own."""
        names = _named(world)
        return cls(names.namer.copy(), names.objects, names.units)


@lru_cache(maxsize=1)
def _named(world: World) -> DomainNames:
    """Name a domain once, for it takes longer than to export a goal."""
    namer = Namer()
    objects = [
        namer.name(str(world.node(object_id)).replace("*", " star "), "thing") for object_id in world.ids
    ]
    units = [
        namer.name(f"{plain(unit.motion, 'do')[: _LONGEST - 8]}-{unit.id}", "do") for unit in world.foon.units
    ]
    return DomainNames(namer, objects, units)


def names_text(names: Names, world: World, about: Mapping[str, str | bool]) -> str:
    """Write names.json: what each name stands for, by id and in words, sorted as they were given."""
    data = {
        "format": _FORMAT,
        "version": VERSION,
        **about,
        **_origin(names, world),
        "semantics": names.semantics,
        "goals": [{"id": goal, "text": str(world.node(goal))} for goal in names.goals],
        "objects": {
            name: {"id": object_id, "text": str(world.node(object_id))}
            for name, object_id in names.objects.items()
        },
        "actions": {name: _action(world, unit) for name, unit in names.units.items()},
        "helpers": dict(names.helpers),
        "arguments": {name: list(taken) for name, taken in (names.arguments or {}).items() if taken},
    }
    return json.dumps(data, indent=1, ensure_ascii=False) + "\n"


def _origin(names: Names, world: World) -> dict[str, str]:
    """Return what the names are about, as hashes of the FOON and of the kitchen."""
    effects = Effects(world, names.semantics)
    return {"foon": foon_hash(world, names.units), "kitchen": kitchen_hash(effects, names.objects)}


def _action(world: World, number: UnitId) -> dict[str, Any]:
    unit = world.foon.units[number]
    source = short_source(unit.source.file, unit.source.line)
    return {"unit": number, "motion": unit.motion, "source": source}


class OtherFoonError(InputError):
    """The names are those of another FOON than the one at hand."""


def read_names(path: Path, world: World) -> Names:
    """Read names.json; raise `InputError` if it is none, or was written for another FOON or kitchen.

    It is an `OtherFoonError` if the FOON is another one, and perhaps the kitchen, too.
    """
    data = _read(path)
    try:
        names = _names(data, world)
    except _OtherDataError as error:
        raise OtherFoonError(path, None, _other("FOON or kitchen", f": {error}"), _NAME_IT) from None
    except (KeyError, TypeError, ValueError) as error:
        raise _unreadable(path, error) from None
    for kind, here in _origin(names, world).items():
        # Files of before have no hash.
        if data.get(kind, here) != here:
            if kind == "foon":
                raise OtherFoonError(path, None, _other("FOON"), _NAME_IT)
            raise InputError(path, None, _other(kind), _NAME_IT)
    return names


@dataclass(frozen=True, slots=True)
class ListedUnit:
    """What names.json says of a unit: its motion, and its place in a file."""

    motion: str
    source: str


def read_names_alone(path: Path) -> tuple[Names, dict[UnitId, ListedUnit]]:
    """Read names.json without the FOON that it is about, and what it says of the units.

    Raises `InputError` if it is none. Nothing can be replayed with such names.
    """
    data = _read(path)
    try:
        names = _names(data, None)
        units = {
            _number(item["unit"]): ListedUnit(_text(item["motion"]), _text(item.get("source", "")))
            for _, item in _items(data, "actions")
        }
    except (KeyError, TypeError, ValueError, AttributeError) as error:
        raise _unreadable(path, error) from None
    return names, {UnitId(number): unit for number, unit in units.items()}


def _read(path: Path) -> dict[str, Any]:
    data = parse_json(read_string(path), path)
    if not isinstance(data, dict) or data.get("format") != _FORMAT:
        raise InputError(path, None, "these are no names of a PDDL export", "name the names.json of one")
    if data.get("version") != VERSION:
        problem = f"version {data.get('version')!r}, but this program reads version {VERSION}"
        raise InputError(path, None, problem, "export again")
    return data


def _unreadable(path: Path, error: Exception) -> InputError:
    return InputError(path, None, f"not readable as names: {error}", "export again")


class _OtherDataError(ValueError):
    """What a name stands for is another thing here."""


_NAME_IT = "name that one, or export again"


def _other(kind: str, which: str = "") -> str:
    return f"the {kind} is not that of this export{which}"


def _names(data: dict[str, Any], world: World | None) -> Names:
    """Read the tables of names.json; raise `KeyError`, `TypeError` or `ValueError` with what is wrong.

    Without a world it is not known what the ids stand for.
    """
    objects = {name: _object_id(item, world) for name, item in _items(data, "objects")}
    units = {name: _unit_id(item, world) for name, item in _items(data, "actions")}
    helpers = {name: _text(words) for name, words in _items(data, "helpers")}
    goals = tuple(_object_id(item, world) for item in data["goals"])
    semantics = _text(data["semantics"])
    if semantics not in SEMANTICS:
        raise ValueError(f"the semantics {semantics!r} is unknown")
    return Names(objects, units, helpers, goals, semantics, _arguments(data, objects))


def _arguments(data: dict[str, Any], objects: Mapping[str, ObjectId]) -> dict[str, tuple[str, ...]] | None:
    if "arguments" not in data:
        return {} if data.get("style") == "objects" else None
    arguments = {name: tuple(map(_text, taken)) for name, taken in _items(data, "arguments")}
    for name, taken in arguments.items():
        if unknown := [each for each in taken if each not in objects]:
            raise ValueError(f"{name!r} takes {unknown[0]!r}, which is no object")
    return arguments


def _items(data: dict[str, Any], key: str) -> list[tuple[str, Any]]:
    table = data[key]
    if not isinstance(table, dict):
        raise TypeError(f"{key!r} is no object")
    for name in table:
        if not _SUPPORTED.fullmatch(name):
            raise ValueError(f"{name!r} is no name that an export has")
    return list(table.items())


def _text(value: object) -> str:
    if not isinstance(value, str):
        raise TypeError(f"{value!r} is no text")
    return value


def _number(value: object, below: float = math.inf) -> int:
    if type(value) is not int or not 0 <= value < below:
        raise _OtherDataError(f"the id {value!r} is not of this FOON")
    return value


def _object_id(item: Any, world: World | None) -> ObjectId:
    if world is None:
        return ObjectId(_number(item["id"]))
    object_id = ObjectId(_number(item["id"], len(world.ids)))
    if item["text"] != str(world.node(object_id)):
        raise _OtherDataError(
            f"object {object_id} is {str(world.node(object_id))!r} here, not {item['text']!r}"
        )
    return object_id


def _unit_id(item: Any, world: World | None) -> UnitId:
    if world is None:
        return UnitId(_number(item["unit"]))
    unit = UnitId(_number(item["unit"], len(world.foon.units)))
    if item["motion"] != world.foon.units[unit].motion:
        raise _OtherDataError(
            f"unit {unit} is {world.foon.units[unit].motion!r} here, not {item['motion']!r}"
        )
    return unit
