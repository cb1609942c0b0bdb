"""JSON texts read item by item, each with its line: `json.loads` does not say where values stand."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foon_asp.errors import InputError
from foon_asp.io.files import read_whole
from foon_asp.io.mend import ANY_ID

_SPACE = re.compile(r"[ \t\r\n]*")
_VALUE = re.compile(r"[\[{](?=\s*[\[{\"])")
"""Where a value begins that may hold items, in a text that is not all JSON."""
_TEXTS = re.compile(r"[\[\s]*\"")
"""A list, or lists in lists, that begin with a text."""
_JSON = re.compile(r"[\s\x00-\x1f\x7f-\x9f\ufeff]*[\[{]")
_OF_TEXT = re.compile(rf"(?:\A|[\r\n])[^\w\r\n]*(?:[OM]{ANY_ID}(?:[\t \r\n]|\Z)|[om]{ANY_ID}\t)")
"""A line of FOON text that is an object or a motion."""
JSON_ADVICE = 'write [{"input_nodes": […], "motion_node": "…", "output_nodes": […]}, …]'
OBJECTS_ADVICE = 'write [{"label": "…", "states": [], "ingredients": [], "container": null}, …]'


@dataclass(frozen=True, slots=True)
class Kind:
    """What a document lists, and how an item is told from what wraps items.

    An item is an object of JSON that has one of the `keys`; with `texts` texts in lists are items, too, where
    nothing else is. `part` matches a list that may hold items in a list of them. The list under the key
    `alone` counts alone. What has one of the `others` is an item of another kind.
    """

    keys: tuple[str, ...]
    part: re.Pattern[str]
    texts: bool = False
    alone: str = ""
    others: tuple[str, ...] = ()


_UNITS = Kind(
    ("input_nodes", "motion_node", "output_nodes"),
    re.compile(r"\[\s*[\[{]"),
    alone="functional_units",
)
_OBJECTS = Kind(
    ("label", "object_label", "states", "object_states", "container"),
    re.compile(r"\[\s*[\[{\"]"),
    texts=True,
    others=_UNITS.keys,
)


def is_json(text: str) -> bool:
    """Tell whether a text is meant as JSON: no line of FOON text begins with a bracket.

    Prose may stand before the JSON, as language models write it, but no object or motion of FOON text.
    """
    if _JSON.match(text) is not None:
        return True
    return _OF_TEXT.search(text) is None and _VALUE.search(text) is not None


@dataclass(frozen=True, slots=True)
class Item:
    """What should be a unit or an object node, or a text; the line where it begins, and its repeated keys.

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
        self._kind = _UNITS
        self._text = text.replace("\r\n", "\n").replace("\r", "\n")
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
        self._read(self._read_values)
        if not self.items:
            self.oddities.append((1, "no-units", "no unit is in this"))

    def read_objects(self) -> None:
        """Read object nodes: a list of them, of labels, or of such lists; so wrapped as units may be.

        Raises `InputError`.
        """
        self._kind = _OBJECTS
        self._read(self._read_values)

    def read_table(self) -> list[tuple[int, Any, Any]]:
        """Read an object whose values are no objects, or that wraps one; return line, key and value of each.

        Raises `InputError`.
        """
        rows: list[tuple[int, Any, Any]] = []
        self._read(lambda: rows.extend(self._read_rows()))
        return rows

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

    def _read_values(self) -> None:
        """Read one value after the other: each is a list of items, or an object."""
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
        begin = _VALUE.search(self._text, self._position)
        end = begin.start() if begin else len(self._text)
        if between := self._text[self._position : end].strip():
            message = f"{between[:60]!r} beside the JSON is left out"
            self.oddities.append((self._line_here(), "text-around-json", message))
        self._position = end
        return begin is not None

    def _read_object(self) -> None:
        """Read an item, or an object that wraps items: by the key that counts alone, or by any."""
        start, alone = self._position, False
        wrapped: list[_Wrapped] = []
        empty = True
        for key in self._keys():
            empty = False
            if key in self._kind.keys:
                self._position = start
                self._read_item()
                return
            if key in self._kind.others:
                problem = "a unit: this is a FOON, and no list of objects"
                raise InputError(self._path, self._line_here(), problem, "name it with --foon")
            if key == self._kind.alone and self._peek() == "[":
                alone = True
                self._read_items()
            elif key == "source":
                self.source = self._value()
            else:
                self._pass(wrapped)
        if not alone and not wrapped and not (empty and self._kind is _UNITS):
            raise InputError(self._path, 1, *_NOTHING[self._kind is _UNITS])
        if not alone:
            self._read_wrapped(wrapped)

    def _keys(self) -> Iterator[str]:
        """Yield the keys of an object; whoever asks for the next one has read the value."""
        self._take("{")
        while self._peek() != "}":
            key = self._value()
            if not isinstance(key, str):
                self._fail("Expecting property name enclosed in double quotes")
            self._take(":")
            yield key
            if self._peek() != "}":
                self._take(",")
                if self._peek() == "}":
                    self._fail("Expecting property name enclosed in double quotes")
        self._take("}")

    def _read_rows(self) -> Iterator[tuple[int, Any, Any]]:
        """Read one object after the other; what wraps them has no row."""
        if not self._begins():
            self._value()
        while True:
            yield from self._rows_of_object()
            if not self._begins():
                return

    def _rows_of_object(self) -> Iterator[tuple[int, Any, Any]]:
        for key in self._keys():
            if self._peek() == "{":
                yield from self._rows_of_object()
            else:
                line = self._line_here()
                yield line, key, self._value()

    def _pass(self, wrapped: list[_Wrapped]) -> None:
        """Pass over a value, and remember where it begins if it holds items; so if it is cut off."""
        place = self._position
        try:
            value = self._value()
        except json.JSONDecodeError:
            cut = _Wrapped(place, texts=self._kind.texts and bool(_TEXTS.match(self._text, place)))
            self._read_wrapped([*wrapped, cut])
            raise
        if held := self._held(value):
            wrapped.append(_Wrapped(place, texts=held == "texts"))

    def _held(self, value: object) -> str:
        """Tell whether a value is, wraps or lists `items`, or only `texts`, by what stands first in lists."""
        inside = False
        while isinstance(value, list) and value:
            value, inside = value[0], True
        if isinstance(value, str):
            return "texts" if inside and self._kind.texts else ""
        if not isinstance(value, dict):
            return ""
        if any(key in value for key in (*self._kind.keys, *self._kind.others)):
            return "items"
        held = {self._held(each) for each in value.values()}
        return "items" if "items" in held else "texts" if "texts" in held else ""

    def _read_wrapped(self, wrapped: Sequence[_Wrapped]) -> None:
        """Read the items of some values that were passed over; texts only if there is nothing else."""
        end = self._position
        for each in wrapped:
            if each.texts and not all(other.texts for other in wrapped):
                continue
            self._position = each.place
            if self._peek() == "[":
                self._read_items()
            else:
                self._read_object()
        self._position = end

    def _read_items(self) -> None:
        """Read a list; a list in it, or an object that wraps items, is a part of its own."""
        self._take("[")
        self._part += 1
        while self._peek() != "]":
            if self._kind.part.match(self._text, self._position):
                self._read_items()
            else:
                self._read_place()
            if self._peek() != "]":
                self._take(",")
                if self._peek() == "]":
                    self._fail("Expecting value")
        self._take("]")

    def _read_place(self) -> None:
        """Read what stands at one place of a list: an item, or an object that wraps some."""
        start = self._position
        try:
            value = self._read_item()
        except json.JSONDecodeError:
            if self._text.startswith("{", start):
                # What it wraps may be whole, though it is cut off.
                self._position = start
                self._read_object()
            raise
        if isinstance(value, dict) and not any(key in value for key in self._kind.keys) and self._held(value):
            self.items.pop()
            self._position = start
            self._read_object()

    def _read_item(self) -> object:
        line = self._line_here()
        self._repeated.clear()
        value = self._value()
        self.items.append(Item(value, line, tuple(self._repeated), self._part))
        return value

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
        self._line -= self._text.count("\n", self._position, self._counted)
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


@dataclass(frozen=True, slots=True)
class _Wrapped:
    """Where a value begins that holds items, and whether these are texts alone."""

    place: int
    texts: bool


_NOTHING = {
    True: ("not a FOON file: no list 'functional_units'", JSON_ADVICE),
    False: ("expected a JSON list of objects", OBJECTS_ADVICE),
}
"""What is wrong with an object that wraps nothing, of units or of object nodes, and what to write."""
