"""Why units never run: the single edit that would open most of them, and the circle it breaks. Plain search.

`encodings/audit/unlock.lp` says the same declaratively; the tests hold both equal. Here there may be
thousands of edits to compare, and hundreds are made one after the other.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass
from heapq import heappop, heappush

from foon_asp import limits
from foon_asp.audit.circles import Circles
from foon_asp.audit.closed_units import ClosedUnits
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.world import World


@dataclass(frozen=True, slots=True)
class Edit:
    """The need that is taken from a unit, and what this opens: all that can run then, the unit among it.

    `circle` are the fewest units, the edited one among them, of which each lacks something that one of them
    makes; there are none if nothing makes the need.
    """

    unit: UnitId
    need: ObjectId
    opened: tuple[UnitId, ...]
    circle: tuple[UnitId, ...]


def edits(world: World) -> Iterator[Edit]:
    """Yield the edits that open units that never run, each time the best for those that are left.

    An edit changes nothing for units that what it opens has nothing to do with.
    """
    closed = ClosedUnits(world.units, world.closure)
    circles = Circles(closed)
    waiting: list[tuple[int, int, UnitId, Edit, list[UnitId]]] = []
    groups = list(closed.groups(closed.lacks))
    while True:
        for group in groups:
            edit = _best(closed, circles, group)
            if edit is not None:
                heappush(waiting, (-len(edit.opened), len(edit.circle), edit.unit, edit, group))
        if not waiting:
            return
        *_, edit, group = heappop(waiting)
        yield edit
        closed.open(edit.opened)
        left = [unit for unit in group if unit in closed.lacks]
        # To look for groups in a group takes longer than to look for its best edit.
        groups = [group] if 2 * len(left) > len(group) else list(closed.groups(left))


def _best(closed: ClosedUnits, circles: Circles, units: Iterable[UnitId]) -> Edit | None:
    """Return the edit that opens most; of several that with the smallest circle, then that of the first unit.

    Only where a single need is lacking its edit opens any unit. If something makes this need, a circle must
    keep it from being made: else the cause is what its makers lack.
    """
    needs = {
        unit: need
        for unit in units
        if unit in closed.lacks and len(closed.lacks[unit]) == 1
        for need in closed.lacks[unit]
        if need not in closed.makers or unit in closed.circling
    }
    if not needs:
        return None
    opened = _most_opened(closed, needs)
    unmade = [unit for unit in opened if needs[unit] not in closed.makers]
    circle = [] if unmade else circles.smallest(opened)
    unit = min(unmade) if unmade else circle[0]
    return Edit(unit, needs[unit], tuple(sorted(opened[unit])), tuple(sorted(circle)))


_Needs = Mapping[UnitId, ObjectId]
"""The units that may be edited, with the only need that each lacks."""


def _most_opened(closed: ClosedUnits, needs: _Needs) -> dict[UnitId, Collection[UnitId]]:
    """Return the units whose edits open most, each with what its edit opens.

    A unit that the edit of another one opens would itself open nothing more. So what no other one opens comes
    first, and the rest is only looked at where it may open as much.
    """
    starts: list[UnitId] = []
    seen: set[UnitId] = set()
    for unit in needs:
        if unit not in seen:
            starts.append(unit)
            _add_opened_singly(closed, needs, unit, seen)
    most: dict[UnitId, Collection[UnitId]] = {}
    best = 0
    seen = set()
    # Behind a start stands none that it opens singly, but one that opens it may.
    for unit in reversed(starts):
        if unit in seen:
            continue
        opened = _opened(closed, unit)
        seen.update(opened)
        if len(opened) > best:
            best, most = len(opened), {}
        if len(opened) == best:
            most[unit] = opened
    for unit, opened in list(most.items()):
        most.update(dict.fromkeys(_as_good(closed, needs, unit, opened), opened))
    return most


def _opened(closed: ClosedUnits, edited: UnitId) -> Collection[UnitId]:
    """Return what can run once its only need is taken from a unit, in the order in which it opens."""
    limits.check()
    opened = {edited: None}
    lacking: dict[UnitId, int] = {}
    had: set[ObjectId] = set()
    queue = [edited]
    for unit in queue:
        for made in closed.makes[unit]:
            if made in had:
                continue
            had.add(made)
            for user in closed.users.get(made, ()):
                lacking[user] = lacking.get(user, len(closed.lacks[user])) - 1
                if not lacking[user] and user != edited:
                    opened[user] = None
                    queue.append(user)
    return opened.keys()


def _add_opened_singly(closed: ClosedUnits, needs: _Needs, start: UnitId, seen: set[UnitId]) -> None:
    """Add a unit to those that are seen, and what its edit opens in steps of which each takes one unit."""
    seen.add(start)
    queue = [start]
    for unit in queue:
        for user in (user for made in closed.makes[unit] for user in closed.users.get(made, ())):
            if user in needs and user not in seen:
                seen.add(user)
                queue.append(user)


def _as_good(closed: ClosedUnits, needs: _Needs, best: UnitId, opened: Collection[UnitId]) -> set[UnitId]:
    """Return the units whose edits open just what that of the best one does: it opens them, and they it."""
    found: set[UnitId] = set()
    _add_opening_singly(closed, needs, best, found)
    worse: set[UnitId] = set()
    for unit in opened:
        if unit in needs and unit not in found and unit not in worse:
            others = _opened(closed, unit)
            if len(others) == len(opened):
                _add_opening_singly(closed, needs, unit, found)
            else:
                worse.update(others)
    return found


def _add_opening_singly(closed: ClosedUnits, needs: _Needs, end: UnitId, found: set[UnitId]) -> None:
    """Add a unit to those that are found, and those whose edits open it in steps of one unit each."""
    found.add(end)
    queue = [end]
    for unit in queue:
        for maker in closed.makers.get(needs[unit], ()):
            if maker in needs and maker not in found:
                found.add(maker)
                queue.append(maker)
