"""Why a goal cannot be made, by plain graph search: said in one sentence, before any solver is asked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from foon_asp.errors import shortened
from foon_asp.problem import Domain, Problem

_SHOWN = 3
"""How many things a sentence names."""


@dataclass(frozen=True, slots=True)
class Lack:
    """What stands in the way of a goal that units make, but none that can be executed.

    `units` can matter for the goal. `raw` is what they need, is not available and could simply be bought;
    `available` is what they could do with all of that, and with what the kitchen can make as it is.
    """

    goal: int
    units: list[int]
    raw: list[int]
    available: Mapping[int, int]
    executable: Mapping[int, int]

    @classmethod
    def of(cls, domain: Domain, goal: int) -> Lack:
        reading = domain.reading
        available = domain.closure.available
        units = reading.backward([goal], available)
        needed = {thing for unit in units for thing in reading.needs[unit]}
        raw = sorted(thing for thing in needed if thing not in available and is_raw(domain, thing))
        closure = reading.execute({*needed & available.keys(), *raw}, units)
        return cls(goal, units, raw, closure.available, closure.executable)

    @property
    def circular(self) -> bool:
        """Whether even all raw things together are not enough."""
        return self.goal not in self.available


@dataclass(frozen=True, slots=True)
class Circle:
    """A shortest ring of units that hold each other up, in a group of things that nothing else makes.

    Each unit makes the thing at the same place, and needs the thing at the next place; the last one needs
    the first. `others` are further units that make any of the things: they need something of the group, too.
    """

    things: tuple[int, ...]
    units: tuple[int, ...]
    others: tuple[int, ...]


def is_raw(domain: Domain, thing: int) -> bool:
    """Whether nothing has been done to an object: no unit makes it, or it is a utensil with nothing in it."""
    node = domain.node(thing)
    return thing not in domain.reading.makers or (
        node.label in domain.kitchen.utensils
        and not any(state.relatum or state.contents or state.name == "contains" for state in node.states)
    )


def unreachable_reason(problem: Problem) -> str:
    """Say in one sentence why no task tree can exist, or return nothing if one can."""
    domain = problem.domain
    makers = domain.reading.makers
    for goal in problem.goals:
        if goal in domain.stock:
            continue
        node = domain.node(goal)
        if goal not in makers:
            return f"no unit makes {node}" + (
                "; it is bare (has no states), so only the kitchen can have it"
                if node.bare and not domain.labels_only
                else ""
            )
        if problem.founded and goal not in domain.closure.available:
            return _locked(domain, Lack.of(domain, goal))
    return ""


def _locked(domain: Domain, lack: Lack) -> str:
    if lack.circular:
        circle = circles(domain, lack)[0]
        places = ", ".join(str(domain.foon.units[unit].source) or f"unit {unit}" for unit in circle.units)
        return f"locked in a circle: {domain.node(circle.things[0])} is needed to make itself ({places})"
    needed = essential(domain, lack)
    if not needed:
        example = min(lack.raw, key=lambda thing: _telling(domain, thing))
        return f"whichever way it is made, the kitchen lacks something, like {domain.node(example)}"
    needed.sort(key=lambda thing: _telling(domain, thing))
    text = "the kitchen lacks " + _listed([domain.node(thing) for thing in needed])
    if any(thing in domain.reading.makers for thing in needed):
        return text
    return f"{text}, and no unit makes {'it' if len(needed) == 1 else 'them'}"


def _listed(names: Sequence[object]) -> str:
    """Return `a, b and c`, or `a, b, c and 4 more`."""
    if 1 < len(names) <= _SHOWN:
        return f"{shortened(names[:-1])} and {names[-1]}"
    return shortened(names, _SHOWN)


def _telling(domain: Domain, thing: int) -> tuple[bool, int]:
    """Sort key: food before utensils, then as the files have it."""
    node = domain.node(thing)
    return node.bare or node.label in domain.kitchen.utensils, thing


def essential(domain: Domain, lack: Lack) -> list[int]:
    """Return the raw things that every way of making the goal needs.

    A set of things is a bit mask. What an object takes for certain is what all of its makers do, or the
    object itself where it can be bought; passes go on until no mask loses a bit.
    """
    reading = domain.reading
    masks = {thing: 1 << place for place, thing in enumerate(lack.raw)}
    everything = (1 << len(lack.raw)) - 1
    there = domain.closure.available
    order = sorted(lack.executable, key=lack.executable.__getitem__)
    changed = True
    while changed:
        changed = False
        for unit in order:
            mask = 0
            for thing in reading.needs[unit]:
                mask |= masks.get(thing, 0)
            for thing in reading.makes[unit]:
                if thing in there:
                    continue
                old = masks.get(thing, everything)
                masks[thing] = old & mask
                changed |= masks[thing] != old
    found = masks[lack.goal]
    return [thing for place, thing in enumerate(lack.raw) if found >> place & 1]


def circles(domain: Domain, lack: Lack) -> list[Circle]:
    """Return what locks a goal for which even all raw things are not enough, the nearest to it first.

    Of the things that cannot be had, some need only each other: no thing of such a group can be made
    without having one of them before. There is one circle for each group.
    """
    reading = domain.reading
    there = domain.closure.available
    makers: dict[int, list[int]] = {}
    needs: dict[int, list[int]] = {}
    for unit in lack.units:
        if unit in lack.executable:
            continue
        needs[unit] = [
            thing for thing in reading.needs[unit] if thing not in lack.available and thing not in there
        ]
        for thing in reading.makes[unit]:
            makers.setdefault(thing, []).append(unit)
    steps = {
        thing: _distinct(need for unit in units for need in needs[unit]) for thing, units in makers.items()
    }
    found = []
    for group in _closed_groups(lack.goal, steps):
        things, units = _ring(group, makers, needs)
        others = {unit for thing in things for unit in makers[thing]} - set(units)
        found.append(Circle(things, units, tuple(sorted(others))))
    return found


def _distinct(items: Iterable[int]) -> list[int]:
    return list(dict.fromkeys(items))


def _closed_groups(start: int, steps: dict[int, list[int]]) -> list[list[int]]:
    """Return the strongly connected groups that nothing leads out of, the nearest to the start first.

    The first of each group is the nearest. The ends of a depth-first search against the steps begin, from
    the last one on, a group each (Kosaraju's algorithm).
    """
    reached = [start]
    back: dict[int, list[int]] = {start: []}
    for thing in reached:
        for other in steps[thing]:
            if other not in back:
                back[other] = []
                reached.append(other)
            back[other].append(thing)
    ends: list[int] = []
    seen: set[int] = set()
    for root in reached:
        stack = [(root, iter(back[root]))] if root not in seen else []
        seen.add(root)
        while stack:
            thing, rest = stack[-1]
            following = next((other for other in rest if other not in seen), None)
            if following is None:
                ends.append(stack.pop()[0])
            else:
                seen.add(following)
                stack.append((following, iter(back[following])))
    group_of: dict[int, int] = {}
    groups: list[list[int]] = []
    for root in reversed(ends):
        if root in group_of:
            continue
        group = [root]
        group_of[root] = len(groups)
        for thing in group:
            for other in steps[thing]:
                if other not in group_of:
                    group_of[other] = len(groups)
                    group.append(other)
        groups.append(group)
    place = {thing: place for place, thing in enumerate(reached)}
    closed = [
        sorted(group, key=place.__getitem__)
        for number, group in enumerate(groups)
        if all(group_of[other] == number for thing in group for other in steps[thing])
    ]
    return sorted(closed, key=lambda group: place[group[0]])


def _ring(
    group: Sequence[int], makers: dict[int, list[int]], needs: dict[int, list[int]]
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """Return the things and units of a shortest ring through the first thing of a group."""
    start = group[0]
    came: dict[int, tuple[int, int]] = {}
    queue = [start]
    for thing in queue:
        for unit in makers[thing]:
            for need in needs[unit]:
                if need not in came:
                    came[need] = (thing, unit)
                    queue.append(need)
        if start in came:
            break
    things: list[int] = []
    units: list[int] = []
    thing = start
    while not things or thing != start:
        thing, unit = came[thing]
        things.append(thing)
        units.append(unit)
    return tuple(reversed(things)), tuple(reversed(units))
