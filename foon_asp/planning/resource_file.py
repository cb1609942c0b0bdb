"""Reading a file of resources: JSON, declared in `schedule_wire`."""

from __future__ import annotations

from pathlib import Path

import msgspec

from foon_asp.errors import InputError, QueryError
from foon_asp.io.files import parse_json, read_string
from foon_asp.io.wire import converted
from foon_asp.planning.resources import Resources, Station, Worker
from foon_asp.planning.schedule_wire import ResourcesJson, StationJson, WorkerJson

_ADVICE = (
    'write {"workers": [{"name": "cook", "hands": 2}], "utensils": {"bowl": 3}}; docs/scheduling.md has all'
)


def read_resources(path: Path) -> Resources:
    """Read who works, and what there is; raise `InputError`."""
    value = parse_json(read_string(path), path)
    try:
        given = converted(value, ResourcesJson)
        usual = Resources()
        return Resources(
            usual.workers if given.workers is None else tuple(map(_worker, given.workers)),
            tuple(map(_station, given.stations)),
            {label.lower(): count for label, count in given.utensils.items()},
            {motion.lower(): hands for motion, hands in given.hands.items()},
        )
    except (msgspec.ValidationError, QueryError) as error:
        raise InputError(path, None, str(error), _ADVICE) from None


def _worker(given: WorkerJson) -> Worker:
    motions = None if given.motions is None else _lower(given.motions)
    return Worker(given.name, given.hands, given.rate, motions, _lower(given.cannot))


def _station(given: StationJson) -> Station:
    return Station(given.name, given.count, _lower(given.motions), _lower(given.labels))


def _lower(words: list[str]) -> frozenset[str]:
    return frozenset(word.strip().lower() for word in words)
