"""Reading what stands beside a FOON: kitchen, goals, success rates, utensils. One clear error each.

And what all readers of FOONs share: what they return, and how a compiled store is told from other folders.
"""

from __future__ import annotations

import json
import os
import shutil
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from foon_asp.errors import InputError
from foon_asp.findings import Finding
from foon_asp.graph import Foon, ObjectNode, State, contains, inside
from foon_asp.state_syntax import Report, clean, parse_state, quiet, read_contents, read_relatum

MANIFEST = "manifest.json"
"""The file of a compiled store that describes the others."""


@dataclass(frozen=True, slots=True)
class FoonFiles:
    """What some files hold: the FOON, what is odd in them, and how many units became of it.

    `units_read` counts duplicates, too; `units_reported` are left out of the FOON, each with a finding.
    Both together are all the units in the files.
    """

    foon: Foon
    findings: tuple[Finding, ...]
    units_read: int
    units_reported: int


STORE_FORMAT = "foon-asp store"


def is_store(path: Path) -> bool:
    """Tell whether a path is meant as a compiled store: a folder that is named or filled like one."""
    # Path.is_dir raises for names that are too long.
    return os.path.isdir(path) and (  # noqa: PTH112
        path.suffix == ".foon" or has_store_manifest(path) or (path / "units.parquet").exists()
    )


def has_store_manifest(folder: Path) -> bool:
    """Tell whether the manifest of a folder says that it is a store; other programs have manifests, too."""
    try:
        return f'"format": "{STORE_FORMAT}"'.encode() in (folder / MANIFEST).read_bytes()[:200]
    except OSError:
        return False


def read_bytes(path: Path) -> bytes:
    """Return the bytes of a file; every way this can fail is an `InputError`."""
    try:
        return path.read_bytes()
    except FileNotFoundError:
        raise InputError(path, None, "no such file", "check the path") from None
    except IsADirectoryError:
        raise InputError(path, None, "this is a folder", "name a file in it") from None
    except OSError as error:
        raise InputError(path, None, f"cannot be read ({error.strerror})") from None
    except ValueError:
        # A NUL in the name, which no file can have.
        raise InputError(repr(str(path)), None, "this is no file name", "check the path") from None


def read_string(path: Path) -> str:
    """Return the text of a UTF-8 file."""
    data = read_bytes(path)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        byte = data[error.start]
        raise InputError(path, line, f"byte 0x{byte:02x} is not UTF-8", "save the file as UTF-8") from None


def read_objects(path: Path) -> list[ObjectNode]:
    """Read a JSON list of objects `{label, states, ingredients, container}`, e.g. goals."""
    return [node for node, _ in _read_items(path)]


def read_stock(path: Path) -> dict[ObjectNode, int | None]:
    """Read a kitchen: a list of objects, each with how many there are (`quantity`), or None for plenty.

    The quantities of an object that is listed twice add up; of an object with the quantity 0 there is none.
    """
    stock: dict[ObjectNode, int | None] = {}
    for node, quantity in _read_items(path):
        before = stock.get(node, 0)
        stock[node] = None if before is None or quantity is None else before + quantity
    return {node: quantity for node, quantity in stock.items() if quantity != 0}


_MOST = 1_000_000
"""The largest quantity: more is as good as plenty."""


def _read_items(path: Path) -> list[tuple[ObjectNode, int | None]]:
    text = read_string(path)
    data = parse_json(text, path)
    if not isinstance(data, list):
        raise InputError(path, 1, "expected a JSON list of objects", 'write [{"label": "…"}, …]')
    found = []
    for place, item in enumerate(data):
        try:
            found.append((object_from_json(item), _quantity(item)))
        except ValueError as error:
            line = _line_of_item(text, place)
            advice = 'write {"label": "…", "states": [], "ingredients": [], "container": null}'
            raise InputError(path, line, f"object {place + 1}: {error}", advice) from None
    return found


def _quantity(item: dict[str, Any]) -> int | None:
    quantity = item.get("quantity")
    if quantity is not None and (type(quantity) is not int or not 0 <= quantity <= _MOST):
        raise ValueError(f"'quantity' is no whole number from 0 to {_MOST}")
    return quantity


def parse_json(text: str, path: Path) -> Any:
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise InputError(path, error.lineno, f"not JSON: {error.msg}") from None
    except ValueError as error:
        raise InputError(path, None, f"not JSON that can be read: {error}") from None
    except RecursionError:
        raise InputError(path, 1, "not JSON that can be read: nested too deeply") from None


def object_from_json(item: object, report: Report = quiet) -> ObjectNode:
    """Read one object; `ingredients` are the contents of `contains`, `container` the relatum of `in`.

    The FOON API's keys `object_label` and `object_states` are read, too. Raises `ValueError` with what
    is wrong.
    """
    if not isinstance(item, dict):
        raise ValueError(f"expected an object, found {kind_of(item)}")
    label = item.get("label", item.get("object_label"))
    if not isinstance(label, str) or not clean(label):
        raise ValueError("'label' is missing or no text")
    ingredients = read_contents(_texts(item, "ingredients"), report)

    def report_state(code: str, message: str) -> None:
        if not (ingredients and code == "contains-without-braces"):
            report(code, message)

    states = [_state_from_json(state, report_state) for state in _states(item)]
    if ingredients:
        # The FOON API names the state beside its contents.
        states = [state for state in states if state != State("contains")]
        states.append(contains(*ingredients))
    container = item.get("container")
    if container is not None and not isinstance(container, str):
        raise ValueError("'container' is neither text nor null")
    relatum = read_relatum(container or "", report)
    if relatum is not None:
        states.append(inside(relatum))
    return ObjectNode.of(clean(label, report), states)


def _states(item: dict[str, object]) -> list[object]:
    key = "object_states" if "object_states" in item else "states"
    value = item.get(key)
    if value is None:
        return []
    if not isinstance(value, list) or not all(isinstance(state, str | dict) for state in value):
        raise ValueError(f"{key!r} is not a list of texts")
    return value


def _state_from_json(value: object, report: Report) -> State:
    """Read a state: a text, or `{state_label, relative_object}`."""
    related = None
    if isinstance(value, dict):
        related = value.get("relative_object")
        value = value.get("state_label", value.get("label"))
    if not isinstance(value, str) or not isinstance(related, str | None):
        raise ValueError("a state is no text")
    text = clean(value, report)
    relatum = read_relatum(related or "", report)
    state = parse_state(text if relatum is None else f"{text} [{relatum}]", report)
    if state is None:
        raise ValueError(f"the state {value[:60]!r} cannot be read")
    return state


def kind_of(value: object) -> str:
    """Return what a JSON value is, in a word or two."""
    kinds = {dict: "an object", list: "a list", str: "a text", bool: "true or false", type(None): "null"}
    return kinds.get(type(value), "a number")


def _texts(item: dict[str, object], key: str) -> list[str]:
    value = item.get(key)
    if value is None:
        return []
    if not isinstance(value, list) or not all(isinstance(text, str) for text in value):
        raise ValueError(f"{key!r} is not a list of texts")
    return value


def _line_of_item(text: str, place: int) -> int:
    """Return the line on which the item at `place` of a JSON list begins."""
    decoder = json.JSONDecoder()
    position = text.index("[") + 1
    for _ in range(place + 1):
        while text[position] in " \t\r\n,":
            position += 1
        start = position
        _, position = decoder.raw_decode(text, position)
    return text.count("\n", 0, start) + 1


def read_rates(path: Path) -> dict[str, float]:
    """Read `motion<tab>rate` lines; a rate is a chance in [0, 1]."""
    rates: dict[str, float] = {}
    for line, row in _rows(path):
        label, tab, text = row.rpartition("\t")
        try:
            rate = float(text)
        except ValueError:
            rate = -1.0
        if not tab or not label.strip() or not 0 <= rate <= 1:
            advice = "write motion<tab>rate, the rate between 0 and 1"
            raise InputError(path, line, f"cannot read {row!r}", advice)
        rates[label.strip().lower().rstrip("*").rstrip()] = rate
    return rates


def read_utensils(path: Path) -> frozenset[str]:
    """Read utensil labels, one a line."""
    return frozenset(row.strip().lower() for _, row in _rows(path))


def _rows(path: Path) -> Iterator[tuple[int, str]]:
    for line, row in enumerate(read_string(path).splitlines(), 1):
        if row.strip() and not row.startswith("#"):
            yield line, row


def write_atomically(path: Path, text: str) -> None:
    """Write a UTF-8 file so that it is there whole or, whatever happens, as it was before.

    Links are followed, and an existing file keeps its mode. What is no regular file (a device, a pipe) is
    written to as it is. Raises `InputError` if it cannot be written.
    """
    data = text.encode("utf-8")
    try:
        target = path.resolve()
        if target.exists() and not target.is_file():
            target.write_bytes(data)
            return
        target.parent.mkdir(parents=True, exist_ok=True)
        unfinished = target.with_name(f".{target.name}.part")
        try:
            unfinished.write_bytes(data)
            if target.exists():
                shutil.copymode(target, unfinished)
            unfinished.replace(target)
        except OSError:
            with suppress(OSError):
                unfinished.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise InputError(path, None, f"cannot be written ({error.strerror})") from None
