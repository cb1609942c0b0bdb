"""JSON texts read item by item, each with its line: `json.loads` does not say where values stand."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foon_asp.errors import InputError
from foon_asp.io.files import read_whole

_SPACE = re.compile(r"[ \t\r\n]*")
VALUE = re.compile(r"[\[{](?=\s*[\[{\"])")
"""Where a value begins that may hold units, in a text that is not all JSON."""
_PART = re.compile(r"\[\s*[\[{]")
"""A list that has something which may be a unit."""
JSON_ADVICE = 'write [{"input_nodes": […], "motion_node": "…", "output_nodes": […]}, …]'
OBJECTS_ADVICE = 'write [{"label": "…", "states": [], "ingredients": [], "container": null}, …]'


_OF_A_UNIT = ("input_nodes", "motion_node", "output_nodes")
"""The keys by which a unit is told from what wraps units."""


@dataclass(frozen=True, slots=True)
class Item:
    """What should be a unit or an object node, the line where it begins, and its repeated keys.

    `part` is the place (0, 1, …) of the list that it stands in, among those with units.
    """

    value: Any
    line: int
    repeated: tuple[str, ...]
    part: int = 0


class Document:
    """Reads a JSON text item by item.

    What stands around the values, as language models write it (prose, a fence, a full stop), is passed over.
    `oddities` say so: line, code and message of each. `broken` is whether the text is no JSON from some
    place on, and what stands before it was read.
    """

    def __init__(self, text: str, path: Path) -> None:
        self._text = text
        self._path = path
        self._repeated: list[str] = []
        self._decoder = json.JSONDecoder(
            strict=False, parse_int=read_whole, object_pairs_hook=self._read_pairs
        )
        self._position = 0
        self._counted = 0
        self._line = 1
        self._part = -1
        self.items: list[Item] = []
        self.source: object = None
        self.oddities: list[tuple[int, str, str]] = []
        self.broken = False

    def read(self) -> None:
        """Read a FOON: a list of units or of lists of them, an object that has one, or several such values.

        Raises `InputError`.
        """
        self._read(self._read_units)
        if not self.items:
            self.oddities.append((1, "no-units", "no unit is in this"))

    def read_list(self) -> list[Item]:
        """Read a list of object nodes, with nothing beside it. Raises `InputError`."""
        self._read(self._read_objects)
        for line, _, message in self.oddities:
            raise InputError(self._path, line, message, OBJECTS_ADVICE)
        return self.items

    def _read(self, read_values: Callable[[], None]) -> None:
        try:
            self._skip()
            read_values()
        except json.JSONDecodeError as error:
            problem = f"not JSON: {error.msg}"
            if not self.items:
                raise InputError(self._path, error.lineno, problem) from None
            self.broken = True
            self.oddities.append((error.lineno, "broken-json", f"{problem}; the rest is left out"))
        except RecursionError:
            raise InputError(self._path, self._line, "not JSON that can be read: nested too deeply") from None

    def _read_objects(self) -> None:
        if self._peek() != "[":
            self._value()
            raise InputError(self._path, 1, "expected a JSON list of objects", OBJECTS_ADVICE)
        self._read_items(nested=False)
        if self._position < len(self._text):
            self._fail("Extra data")

    def _read_units(self) -> None:
        """Read one value after the other: each is a list of units, or an object."""
        if not self._begins():
            self._value()
        while True:
            if self._peek() == "[":
                self._read_items()
            else:
                self._read_object()
            if not self._begins():
                return

    def _begins(self) -> bool:
        """Go to where the next value begins, and tell whether there is one."""
        if self._peek() in ("[", "{"):
            return True
        begin = VALUE.search(self._text, self._position)
        end = begin.start() if begin else len(self._text)
        if between := self._text[self._position : end].strip():
            message = f"{between[:60]!r} beside the JSON is left out"
            self.oddities.append((self._line_here(), "text-around-json", message))
        self._position = end
        return begin is not None

    def _read_object(self) -> None:
        """Read a unit, or an object that wraps units: by `functional_units`, as the FOON API, or else."""
        start, wraps = self._position, False
        wrapped: list[int] = []
        self._take("{")
        empty = self._peek() == "}"
        while self._peek() != "}":
            key = self._value()
            if not isinstance(key, str):
                self._fail("Expecting property name enclosed in double quotes")
            self._take(":")
            if key in _OF_A_UNIT:
                self._position = start
                self._read_item()
                return
            if key == "functional_units" and self._peek() == "[":
                wraps = True
                self._read_items()
            elif key == "source":
                self.source = self._value()
            else:
                self._pass(wrapped)
            if self._peek() != "}":
                self._take(",")
                if self._peek() == "}":
                    self._fail("Expecting property name enclosed in double quotes")
        self._take("}")
        if not wraps and not wrapped and not empty:
            problem = "not a FOON file: no list 'functional_units'"
            raise InputError(self._path, 1, problem, JSON_ADVICE)
        if not wraps:
            self._read_wrapped(wrapped)

    def _pass(self, wrapped: list[int]) -> None:
        """Pass over a value, and remember where it begins if it holds units; so if it is cut off."""
        place = self._position
        try:
            value = self._value()
        except json.JSONDecodeError:
            self._read_wrapped([*wrapped, place])
            raise
        if _holds_units(value):
            wrapped.append(place)

    def _read_wrapped(self, places: list[int]) -> None:
        """Read the units of some values that were passed over."""
        end = self._position
        for place in places:
            self._position = place
            if self._peek() == "[":
                self._read_items()
            else:
                self._read_object()
        self._position = end

    def _read_items(self, *, nested: bool = True) -> None:
        """Read a list; a list in it is a part of its own if it may be nested."""
        self._take("[")
        self._part += 1
        while self._peek() != "]":
            if nested and _PART.match(self._text, self._position):
                self._read_items()
            else:
                self._read_item()
            if self._peek() != "]":
                self._take(",")
                if self._peek() == "]":
                    self._fail("Expecting value")
        self._take("]")

    def _read_item(self) -> None:
        line = self._line_here()
        self._repeated.clear()
        value = self._value()
        self.items.append(Item(value, line, tuple(self._repeated), self._part))

    def _value(self) -> Any:
        value, self._position = self._decoder.raw_decode(self._text, self._position)
        self._skip()
        return value

    def _take(self, character: str) -> None:
        if self._peek() != character:
            self._fail(f"Expecting {character!r} delimiter")
        self._position += 1
        self._skip()

    def _peek(self) -> str:
        return self._text[self._position : self._position + 1]

    def _skip(self) -> None:
        match = _SPACE.match(self._text, self._position)
        assert match is not None
        self._position = match.end()

    def _line_here(self) -> int:
        self._line += self._text.count("\n", self._counted, self._position)
        self._counted = self._position
        return self._line

    def _fail(self, problem: str) -> None:
        raise json.JSONDecodeError(problem, self._text, self._position)

    def _read_pairs(self, pairs: list[tuple[str, Any]]) -> dict[str, Any]:
        value = dict(pairs)
        if len(value) != len(pairs):
            counts = Counter(key for key, _ in pairs)
            self._repeated += [key for key, count in counts.items() if count > 1]
        return value


def _holds_units(value: object) -> bool:
    """Tell whether a value is, wraps or lists units, by what stands first in its lists."""
    while isinstance(value, list) and value:
        value = value[0]
    if not isinstance(value, dict):
        return False
    return any(key in value for key in _OF_A_UNIT) or any(map(_holds_units, value.values()))
