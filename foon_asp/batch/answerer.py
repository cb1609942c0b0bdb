"""What answers the queries of a batch: the data, opened once; one query makes one row."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from foon_asp.batch.query_file import Line
from foon_asp.batch.rows import Id, Row, Rows, answer_row, error_row
from foon_asp.errors import FoonError, InternalError
from foon_asp.io.folder import Dataset, Sources
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.kitchen_change import AS_IT_IS, supplied
from foon_asp.query.query import Query
from foon_asp.query.wire import parse_line, query_id, read_query
from foon_asp.retrieval.retrieve import retrieve

_WORLDS = 4
"""How many kitchens a worker keeps beside that of the data; each holds what can be made from it."""

_SOON = 0.2
"""Seconds after which answers are passed on, though their chunk is not done."""


@dataclass(frozen=True, slots=True)
class Settings:
    """What holds for every query of a run: limits where it has none, and whether rows have seconds."""

    time_limit: float | None = None
    memory_limit: float | None = None
    timings: bool = False


class Answerer:
    """The data, opened once, and the answers to queries over it. Threads may share it."""

    def __init__(self, sources: Sources, settings: Settings, dataset: Dataset | None = None) -> None:
        """Open the data, if they are not open yet."""
        self.dataset = sources.load() if dataset is None else dataset
        self._settings = settings
        self._world = self.dataset.world(strict=sources.strict, level=sources.level)
        self._worlds: OrderedDict[frozenset[ObjectNode], World] = OrderedDict()
        self._lock = threading.Lock()

    def answer(self, chunk: Iterable[Line]) -> Rows:
        """Answer each query of a chunk; what is wrong with one is said in its row."""
        return [self._row(number, line) for number, line in chunk]

    def stream(self, chunk: Iterable[Line]) -> Iterator[Rows]:
        """Answer each query of a chunk, and keep no answer back for long while others take their time."""
        rows: Rows = []
        told = time.monotonic()
        for line in chunk:
            rows += self.answer([line])
            if time.monotonic() - told > _SOON:
                yield rows
                rows, told = [], time.monotonic()
        if rows:
            yield rows

    def _row(self, number: int, line: bytes) -> Row:
        name: Id = None
        try:
            value = parse_line(line)
            name = query_id(value)
            query = read_query(value)
            answer = retrieve(self._seen_by(query), self._limited(query))
            return answer_row(number, name, answer, timings=self._settings.timings)
        except FoonError as error:
            problem = str(error)
        except InternalError as error:
            problem = f"internal error, please report it: {error}"
        except Exception as error:  # Whatever it is, it must not end the other queries.
            problem = f"internal error, please report it: {type(error).__name__}: {error}"
        return error_row(number, name, problem)

    def _limited(self, query: Query) -> Query:
        """Return a query about the kitchen as it is seen, with the limits of the run where it has none."""
        settings = self._settings
        wanted = {
            "kitchen": AS_IT_IS,
            "time_limit": settings.time_limit if query.time_limit is None else query.time_limit,
            "memory_limit": settings.memory_limit if query.memory_limit is None else query.memory_limit,
        }
        same = all(getattr(query, name) == value for name, value in wanted.items())
        # To make a query takes as long as to answer many a one.
        return query if same else query.replace(**wanted)

    def _seen_by(self, query: Query) -> World:
        """Return the FOON seen from the kitchen of a query, one of the last few if it was among them."""
        if not query.kitchen:
            return self._world
        objects = query.kitchen.nodes(self._world)
        with self._lock:
            world = self._worlds.get(objects)
            if world is None:
                world = self._worlds[objects] = supplied(self._world, objects)
            self._worlds.move_to_end(objects)
            if len(self._worlds) > _WORLDS:
                self._worlds.popitem(last=False)
            return world
