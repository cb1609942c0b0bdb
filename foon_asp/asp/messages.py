"""How a process that solves is told what to do, and what it answers: MessagePack in frames with their length.

A request is `[method, arguments, seconds left]`, without a limit the seconds are null. A reply is
`["better", model]`, of which there can be several, and last `["done", value]` or `["error", words]`.
"""

from __future__ import annotations

import struct
from typing import Any, BinaryIO

import msgspec

from foon_asp.asp.control import Look, Program, Shown
from foon_asp.asp.model import Model, Models
from foon_asp.asp.terms import Function, Row
from foon_asp.limits import Limit

_LENGTH = struct.Struct("!Q")


def send(stream: BinaryIO, message: list[Any]) -> None:
    """Write a message."""
    data = msgspec.msgpack.encode(message)
    stream.write(_LENGTH.pack(len(data)) + data)
    stream.flush()


def receive(stream: BinaryIO) -> list[Any]:
    """Read a message; raise `EOFError` if there is no whole one."""
    (length,) = _LENGTH.unpack(_read(stream, _LENGTH.size))
    message: list[Any] = msgspec.msgpack.decode(_read(stream, length))
    return message


def _read(stream: BinaryIO, size: int) -> bytes:
    data = stream.read(size)
    if len(data) < size:
        raise EOFError
    return data


def packed_program(program: Program) -> list[Any]:
    """Return a program as a message has it."""
    texts, options = list(program.texts), list(program.options)
    return [texts, dict(program.constants), options, program.ground, program.timed]


def program(value: list[Any]) -> Program:
    """Return the program of a message."""
    texts, constants, options, ground, timed = value
    return Program(tuple(texts), constants, tuple(options), ground, timed)


def packed(value: Model | Models | Look | tuple[Any, ...] | None) -> Any:
    """Return an answer as a message has it."""
    if isinstance(value, Model):
        return [value.atoms, value.proven, value.bounds, value.costs, value.priorities, value.limit]
    if isinstance(value, Models):
        return [list(map(packed, value.found)), value.complete, value.limit]
    if isinstance(value, Look):
        shown = None if value.shown is None else _packed_term((value.shown.tables, value.shown.terms))
        return [shown, value.costs, value.best, value.others, value.exhausted, value.limit]
    return None if value is None else _packed_term(value)


def model(value: list[Any]) -> Model:
    """Return the model of a message."""
    atoms, proven, bounds, costs, priorities, limit = value
    return Model(_tuples(atoms), proven, tuple(bounds), tuple(costs), tuple(priorities), _limit(limit))


def models(value: list[Any]) -> Models:
    """Return the models of a message."""
    found, complete, limit = value
    return Models(tuple(map(model, found)), complete, _limit(limit))


def look(value: list[Any]) -> Look:
    """Return what the models of a message show."""
    shown, costs, best, others, exhausted, limit = value
    seen = None if shown is None else Shown(*_term(shown))
    return Look(seen, tuple(costs), best, others, exhausted, _limit(limit))


def tables(value: list[Any]) -> tuple[tuple[Row, ...], ...]:
    """Return the rows of predicates in a message."""
    found: tuple[tuple[Row, ...], ...] = _term(value)
    return found


def _limit(word: str | None) -> Limit | None:
    return None if word is None else Limit(word)


def _tuples(value: Any) -> Any:
    return tuple(map(_tuples, value)) if isinstance(value, list) else value


def _packed_term(term: Any) -> Any:
    """Return a term, or a tuple of them; a function is a map, which nothing else is."""
    if isinstance(term, Function):
        return {"name": term.name, "arguments": _packed_term(term.arguments)}
    return list(map(_packed_term, term)) if isinstance(term, tuple) else term


def _term(value: Any) -> Any:
    if isinstance(value, dict):
        return Function(value["name"], _term(value["arguments"]))
    return tuple(map(_term, value)) if isinstance(value, list) else value
