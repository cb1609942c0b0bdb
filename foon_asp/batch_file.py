"""The query file of a batch: JSON lines, read in chunks; what one query line may say."""

from __future__ import annotations

import hashlib
import json
import math
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from foon_asp.constraints import FREE, Constraints
from foon_asp.errors import InputError, QueryError, closest
from foon_asp.files import kind_of, object_from_json, read_utensils
from foon_asp.graph import ObjectNode
from foon_asp.resources import diets

T = TypeVar("T")
Named = ObjectNode | str
"""An object, or a text that names one as on the command line."""
Line = tuple[int, bytes]
"""The number of a line, from 1, and what it says."""
Chunk = tuple[Line, ...]

_BYTE_ORDER_MARK = b"\xef\xbb\xbf"


@dataclass(frozen=True, slots=True)
class QueryFile:
    """A file with one query a line; blank lines do not count.

    `lines` is the number of its last line, `queries` how many lines say something, `digest` the SHA-256 of
    its bytes.
    """

    path: Path
    lines: int
    queries: int
    digest: str

    @classmethod
    def scan(cls, path: Path) -> QueryFile:
        """Read a file from end to end; raise `InputError` if it cannot be read twice, or asks nothing."""
        if os.path.exists(path) and not os.path.isfile(path):  # noqa: PTH110, PTH113 - Path's raise on long names
            raise InputError(path, None, "this is no regular file", "save the queries in one")
        digest = hashlib.sha256()
        lines = queries = 0
        for line in _raw_lines(path):
            digest.update(line)
            lines += 1
            queries += bool(_said(lines, line))
        if not queries:
            advice = 'write one query a line, like {"goal": "whipped cream"}'
            raise InputError(path, None, "there is no query in this file", advice)
        return cls(path, lines, queries, digest.hexdigest())

    def chunks(self, size: int, done: Callable[[int], bool]) -> Iterator[Chunk]:
        """Yield the queries that are not done, in order, at most `size` at a time.

        Raises `InputError` if the file is not what it was when it was scanned.
        """
        digest = hashlib.sha256()
        chunk: list[Line] = []
        number = 0
        for number, line in enumerate(_raw_lines(self.path), 1):
            if number > self.lines:
                break
            digest.update(line)
            text = _said(number, line)
            if text and not done(number):
                chunk.append((number, text))
                if len(chunk) == size:
                    yield tuple(chunk)
                    chunk = []
        if number != self.lines or digest.hexdigest() != self.digest:
            advice = "remove the journal of the run, and run the command again"
            raise InputError(self.path, None, "the query file was changed during the run", advice)
        if chunk:
            yield tuple(chunk)


def _raw_lines(path: Path) -> Iterator[bytes]:
    """Yield the lines of a file as they are, with their ends."""
    try:
        with path.open("rb") as file:
            yield from file
    except FileNotFoundError:
        raise InputError(path, None, "no such file", "check the path") from None
    except OSError as error:
        raise InputError(path, None, f"cannot be read ({error.strerror})") from None


def _said(number: int, line: bytes) -> bytes:
    return (line.removeprefix(_BYTE_ORDER_MARK) if number == 1 else line).strip()


@dataclass(frozen=True, slots=True)
class Query:
    """What a query line asks. `kitchen` replaces the objects of the data; `add` and `remove` change them."""

    goals: tuple[Named, ...]
    kitchen: tuple[Named, ...] | None = None
    add: tuple[Named, ...] = ()
    remove: tuple[Named, ...] = ()
    method: str = "optimal"
    by: tuple[str, ...] = ()
    reference: bool = False
    time_limit: float | None = None
    constraints: Constraints = FREE


def read_line(line: bytes) -> dict[str, Any]:
    """Return the JSON object of a query line; raise `QueryError`."""
    try:
        value = json.loads(line.decode("utf-8"), parse_constant=_refuse_constant)
    except UnicodeDecodeError as error:
        raise QueryError(f"byte 0x{line[error.start]:02x} is not UTF-8; save the file as UTF-8") from None
    except json.JSONDecodeError as error:
        raise QueryError(f"not JSON: {error.msg} at column {error.colno}") from None
    except ValueError as error:
        raise QueryError(f"not JSON that can be read: {error}") from None
    except RecursionError:
        raise QueryError("not JSON that can be read: nested too deeply") from None
    if not isinstance(value, dict):
        raise QueryError(f'a query is an object like {{"goal": "whipped cream"}}, not {kind_of(value)}')
    return value


def _refuse_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no JSON number")


def query_id(value: dict[str, Any]) -> str | int | float | None:
    """Return the id of a query; raise `QueryError` if it is neither text nor number."""
    given = value.get("id")
    if isinstance(given, float) and not math.isfinite(given):
        raise QueryError("'id' is a number that is too large")
    if given is None or (isinstance(given, str | int | float) and not isinstance(given, bool)):
        return given
    raise QueryError(f"'id' is a text or a number, not {kind_of(given)}")


def read_query(value: dict[str, Any]) -> Query:
    """Read what a query line says, but for its id; raise `QueryError` that names the key."""
    _check_keys(value, (*_READERS, "id"), "key")
    if "goal" not in value:
        raise QueryError("the query has no 'goal'")
    read = {_FIELDS.get(key, key): _READERS[key](key, value[key]) for key in value if key != "id"}
    query = Query(**read)
    if query.kitchen is not None and (query.add or query.remove):
        raise QueryError("'kitchen' names all objects; leave out 'add' and 'remove'")
    return query


def _check_keys(value: dict[str, Any], known: tuple[str, ...], word: str) -> None:
    for key in value:
        if key not in known:
            raise QueryError(f"unknown {word} {key!r}{closest(key, known, 1)}; there are {', '.join(known)}")


def _goals(key: str, value: object) -> tuple[Named, ...]:
    goals = _objects(key, value if isinstance(value, list) else [value])
    if not goals:
        raise QueryError("the list of goals is empty")
    return goals


def _objects(key: str, value: object) -> tuple[Named, ...]:
    if not isinstance(value, list):
        raise QueryError(f"{key!r} is a list of objects, not {kind_of(value)}")
    return tuple(_object(key, item) for item in value)


def _object(key: str, value: object) -> Named:
    if isinstance(value, str):
        return value
    try:
        return object_from_json(value)
    except ValueError as error:
        raise QueryError(f"{key!r}: {error}") from None


def _by(key: str, value: object) -> tuple[str, ...]:
    return tuple(value.split(",")) if isinstance(value, str) else _texts(key, value)


def _texts(key: str, value: object) -> tuple[str, ...]:
    if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
        raise QueryError(f"{key!r} is a list of texts")
    return tuple(dict.fromkeys(value))


def _labels(key: str, value: object) -> tuple[str, ...]:
    return tuple(dict.fromkeys(text.strip().lower() for text in _texts(key, value)))


def _units(key: str, value: object) -> tuple[int, ...]:
    if not isinstance(value, list):
        raise QueryError(f"{key!r} is a list of unit ids, not {kind_of(value)}")
    return tuple(dict.fromkeys(_count(key, item) for item in value))


def _text(key: str, value: object) -> str:
    if not isinstance(value, str):
        raise QueryError(f"{key!r} is a text, not {kind_of(value)}")
    return value


def _truth(key: str, value: object) -> bool:
    if not isinstance(value, bool):
        raise QueryError(f"{key!r} is true or false, not {kind_of(value)}")
    return value


def _count(key: str, value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value < 2**31:
        raise QueryError(f"{key!r} takes whole numbers from 0, not {_written(value)}")
    return value


def _number(key: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise QueryError(f"{key!r} is a number, not {kind_of(value)}")
    if not (0 <= value <= 1e9 and math.isfinite(value)):
        raise QueryError(f"{key!r} is a number from 0 to 1e9, not {_written(value)}")
    return float(value)


def _written(value: object) -> str:
    return str(value)[:40] if isinstance(value, int | float) else kind_of(value)


def _diets(key: str, value: object) -> tuple[tuple[str, tuple[str, ...]], ...]:
    known = diets()
    names = _texts(key, value)
    for name in names:
        if name not in known:
            raise QueryError(f"no diet {name!r}{closest(name, known, 1)}; there are {', '.join(known)}")
    return tuple((name, tuple(sorted(read_utensils(known[name])))) for name in names)


def _constraints(key: str, value: object) -> Constraints:
    if not isinstance(value, dict):
        raise QueryError(f"{key!r} is an object, not {kind_of(value)}")
    _check_keys(value, tuple(_CONSTRAINTS), "constraint")
    return Constraints(**{name: _CONSTRAINTS[name](name, item) for name, item in value.items()})


def _or_null(read: Callable[[str, object], T]) -> Callable[[str, object], T | None]:
    return lambda key, value: None if value is None else read(key, value)


_READERS: dict[str, Callable[[str, object], Any]] = {
    "goal": _goals,
    "kitchen": _or_null(_objects),
    "add": _objects,
    "remove": _objects,
    "method": _text,
    "by": _by,
    "reference": _truth,
    "time_limit": _or_null(_number),
    "constraints": _constraints,
}
_FIELDS = {"goal": "goals"}
"""Fields of `Query` that are not named like their keys."""

_CONSTRAINTS: dict[str, Callable[[str, object], Any]] = {
    "without": _labels,
    "without_tools": _labels,
    "avoid_motions": _labels,
    "only_motions": _or_null(_labels),
    "use_units": _units,
    "avoid_units": _units,
    "max_units": _or_null(_count),
    "max_depth": _or_null(_count),
    "min_success": _or_null(_number),
    "human_steps": _or_null(_count),
    "diets": _diets,
}
