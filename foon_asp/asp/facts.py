"""From a problem to clingo facts: the only place where input predicates are spelled."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from functools import lru_cache
from pathlib import PurePath
from typing import NamedTuple

from foon_asp import limits
from foon_asp.asp.terms import quote
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.numbers import MOST
from foon_asp.query.problem import Problem
from foon_asp.query.tariff import PLAIN, Tariff, grain_of, plain_tariff

Name = int | str
"""What stands for a unit or an object: its number, or a constant in a piece."""


def facts(problem: Problem, tariff: Tariff | None = None) -> str:
    """Return the facts of a problem, one statement a line, in the order of the FOON file.

    With a tariff, which says what chances cost, every unit must have a success rate, else `QueryError`. On
    level 1 the facts set the constant `labels_only` of `units.lp`, and `loose` where relations match so: no
    caller can forget it.
    """
    lines = [*_details(problem), *_rates(problem, tariff), *_costs(problem)]
    lines += _query(problem, problem.objects, tariff)
    return "\n".join(lines) + "\n"


def read_facts(
    problem: Problem, tariff: Tariff | None = None, *, rates: bool = False, costs: bool = False
) -> str:
    """Return fewer facts: the `needs/2` and `makes/2` that `units.lp` would derive of the others.

    Nothing is said of labels and states, and of what the kitchen has anyway. Success rates and costs are
    there if they are asked for.
    """
    lines = _readings(problem)
    if rates or tariff is not None:
        lines += _rates(problem, tariff)
    if costs:
        lines += _costs(problem)
    return "\n".join([*lines, *_query(problem, problem.goals, tariff)]) + "\n"


class Piece(NamedTuple):
    """What is said of a unit, or of a goal, whatever numbers it has.

    In `text`, `u0` stands for the unit and `o0`, `o1`, … for objects; the digits are places in `ids`. `COST`
    stands for `cost`, what it costs that the unit may fail.
    """

    text: str
    ids: tuple[int, ...]
    cost: int = 0


_KEPT = 1 << 16
"""How many pieces a world keeps."""

COST = MOST
"""Stands for a number in pieces; nothing that is paid is as large."""


def pieces(problem: Problem, tariff: Tariff | None = None, details: Collection[str] = ()) -> Iterator[Piece]:
    """Yield the facts of a problem unit by unit, then goal by goal: those of `read_facts`, and some details.

    `details` are predicates of which facts are wanted, too. With a tariff every unit must have a success rate
    above 0.
    """
    world = problem.world
    kept, wanted = world.pieces, frozenset(details)
    for number in problem.units:
        limits.check()
        piece = kept.get((number, wanted))
        if piece is None:
            if len(kept) >= _KEPT:
                kept.clear()
            piece = _detailed(world, number, wanted) if wanted else _read(world, number)
            kept[number, wanted] = piece
        if tariff is not None:
            cost = tariff.failure(world.kitchen.rate(world.foon.units[number]))
            piece = Piece(f"{piece.text} fails(u0,{COST}).", piece.ids, cost) if cost else piece
        yield piece
    for goal in problem.goals:
        yield Piece("goal(o0). kitchen(o0)." if goal in world.stock else "goal(o0).", (goal,))


def _read(world: World, unit: UnitId) -> Piece:
    """Return what a unit needs and makes besides the kitchen."""
    stock = world.stock
    needs = [number for number in world.units.needs[unit] if number not in stock]
    makes = [number for number in world.units.makes[unit] if number not in stock]
    places = {number: place for place, number in enumerate(dict.fromkeys([*needs, *makes]), 1)}
    text = _read_text(tuple(map(places.__getitem__, needs)), tuple(map(places.__getitem__, makes)))
    return Piece(text, (unit, *places))


@lru_cache(maxsize=1 << 12)
def _read_text(needs: tuple[int, ...], makes: tuple[int, ...]) -> str:
    return _reading("u0", [f"o{place}" for place in needs], [f"o{place}" for place in makes])


def _detailed(world: World, number: UnitId, details: Collection[str]) -> Piece:
    """Return what a unit needs and makes besides the kitchen, and some details of what it lists.

    The fewer details, the more units are alike. What it lists beside that is at hand, or as good as that: a
    bare tool, or what only shows again what another input shows. It has a name of its own here, so that the
    encodings read it as at hand. Labels that are no utensil's are left out, and so is what a vessel contains.
    """
    unit = world.foon.units[number]
    read = _read(world, number)
    names = {each: f"o{place}" for place, each in enumerate(read.ids[1:], 1)}
    sides = (("input", unit.inputs, world.units.needed), ("output", unit.outputs, world.units.made))
    parts = [read.text]
    own: dict[ObjectId, None] = {}
    beside: dict[ObjectId, list[str]] = {}
    for predicate, objects, reading in sides:
        for each in objects if predicate in details else ():
            if each in names and each in reading[number]:
                own[each] = None
                parts.append(f"{predicate}(u0,{names[each]}).")
            else:
                beside.setdefault(each, []).append(predicate)
    about = _about_vessels if "utensil" in details else _about_nothing
    parts += [fact for each in own for fact in about(world, each, names[each])]
    # In an order of their own, so that units are alike that list the same in another one.
    order = sorted(beside, key=lambda each: (beside[each], about(world, each, "")))
    for place, each in enumerate(order, len(read.ids)):
        parts += [f"kitchen(o{place}).", *(f"{predicate}(u0,o{place})." for predicate in beside[each])]
        parts += about(world, each, f"o{place}")
    if "motion" in details:
        parts.append(f"motion(u0,{quote(unit.motion)}).")
    if "duration" in details:
        parts += _duration("u0", unit)
    return Piece(" ".join(parts), (*read.ids, *order))


def _about_nothing(world: World, number: ObjectId, name: str) -> list[str]:  # noqa: ARG001
    return []


def _about_vessels(world: World, number: ObjectId, name: str) -> list[str]:
    """Return what an object has to do with utensils: it is one, and holds something, or is at one."""
    utensils = world.kitchen.utensils
    node = world.node(number)
    facts = []
    if node.label in utensils:
        facts.append(f"label({name},{quote(node.label)}). utensil({quote(node.label)}).")
        if node.contents:
            facts.append(f'content({name},"contains","").')
    for state in node.states:
        if state.relatum in utensils:
            relatum = quote(state.relatum)
            facts.append(f"relation({name},{quote(state.name)},{relatum}). utensil({relatum}).")
    return facts


def finer_facts(problem: Problem) -> str:
    """Return how many rates are higher than that of each unit and are the same in parts per thousand."""
    world = problem.world
    rates = {unit: world.kitchen.rate(world.foon.units[unit]) for unit in problem.units}
    alike: dict[int, list[float]] = {}
    for rate in sorted(set(rates.values()), reverse=True):
        alike.setdefault(_per_thousand(rate), []).append(rate)
    places = {unit: alike[_per_thousand(rate)].index(rate) for unit, rate in rates.items()}
    return "".join(f"finer({unit},{place}).\n" for unit, place in places.items() if place)


def names(problem: Problem) -> str:
    """Return two facts more, for queries: objects as people write them, and where each unit was read.

    A file is named without its folders; a unit that was read in several places has a fact for each.
    """
    world = problem.world
    lines = [f"name({number},{quote(str(world.node(number)))})." for number in problem.objects]
    for number in problem.units:
        for source in world.foon.units[number].annotation.sources:
            lines.append(f"source({number},{quote(PurePath(source.file).name)},{source.line}).")
    return "\n".join(lines) + "\n"


def price_facts(
    per_unit: Mapping[UnitId, int],
    fees: Mapping[str, int],
    once: Mapping[UnitId, Iterable[str]],
    ruin: str = "",
) -> str:
    """Return what units cost in a plan: prices paid each time, and fees that are paid once for a key.

    The fee for the key `ruin` is paid instead of all else.
    """
    lines = [f"price({number},{cost})." for number, cost in per_unit.items()]
    lines += [f"{'ruin' if key == ruin else 'fee'}({quote(key)},{cost})." for key, cost in fees.items()]
    lines += [f"once({number},{quote(key)})." for number, keys in once.items() for key in keys]
    return "\n".join(lines) + "\n"


def schedule_facts(
    able: Iterable[tuple[UnitId, str, int, int]],
    at: Iterable[tuple[UnitId, str]],
    counts: Mapping[str, Iterable[tuple[str, int]]],
    bounds: Mapping[str, Mapping[UnitId, int]],
    windows: Iterable[tuple[int, int]] = (),
    open_ended: Iterable[UnitId] = (),
) -> str:
    """Return who can do which unit, with how many hands, in which time; and which stations units take.

    `counts`: for `worker`, `station` and `vessel` names with how many there are. `bounds`: numbers of units,
    by the names of the predicates that say them. `windows`: from when, and until how long before the end.
    `open_ended`: units that may be done more often than is said.
    """
    lines = [f"able({unit},{quote(name)},{hands},{seconds})." for unit, name, hands, seconds in able]
    lines += [f"at({unit},{quote(name)})." for unit, name in at]
    lines += [f"{kind}({quote(name)},{count})." for kind, each in counts.items() for name, count in each]
    lines += [f"{name}({unit},{value})." for name, values in bounds.items() for unit, value in values.items()]
    lines += [f"window({start},{rest})." for start, rest in windows]
    lines += [f"open_ended({unit})." for unit in open_ended]
    return "\n".join(lines) + "\n"


def gap_facts(gaps: Iterable[tuple[ObjectId, Iterable[ObjectId]]]) -> str:
    """Return what is missing in each gap of a task tree, and some of what is at hand there."""
    lines = []
    for gap, (missing, there) in enumerate(gaps):
        lines += [f"gap({gap},{missing}).", *(f"there({gap},{object_id})." for object_id in there)]
    return "\n".join(lines) + "\n"


def times_facts(times: Mapping[UnitId, int]) -> str:
    """Return how often each unit of a task tree is done."""
    return "".join(f"times({unit},{count}).\n" for unit, count in sorted(times.items()))


def mend_facts(
    steps: Mapping[int, tuple[Iterable[ObjectId], Iterable[ObjectId]]],
    variants: Iterable[tuple[ObjectId, ObjectId, int]],
) -> str:
    """Return what each step of a task tree lists on both sides, and what that may become, at which cost."""
    lines = []
    for step, sides in steps.items():
        lines.append(f"step({step}).")
        for side, objects in zip(("input", "output"), sides, strict=True):
            lines += [f'listed({step},"{side}",{object_id}).' for object_id in objects]
    lines += [f"variant({one},{other},{cost})." for one, other, cost in variants]
    return "\n".join(lines) + "\n"


_IMPOSSIBLE = 1_000_000_000
"""What a rate of 0 costs in the table of costs for rules of the user's own, which need some number."""


def _rates(problem: Problem, tariff: Tariff | None) -> Iterator[str]:
    """Yield the success rates of units and what they cost; in parts per thousand for the user's own rules."""
    kitchen = problem.world.kitchen
    tariff, rate_of = (
        (plain_tariff(problem), kitchen.known_rate) if tariff is None else (tariff, kitchen.rate)
    )
    rates: set[int] = set()
    costs: dict[float, int] = {}
    zero = False
    for number in problem.units:
        rate = rate_of(problem.world.foon.units[number])
        if rate is None:
            continue
        thousandths = _per_thousand(rate)
        rates.add(thousandths)
        yield f"success_rate({number},{thousandths})."
        if rate == 0:
            zero = True
            yield f"never_succeeds({number})."
        else:
            # Many units have the same rate.
            if rate not in costs:
                costs[rate] = tariff.failure(rate)
            if costs[rate]:
                yield f"fails({number},{costs[rate]})."
    for thousandths in sorted(rates):
        yield f"failure_cost({thousandths},{_failure_cost(thousandths)})."
    if zero:
        yield f"ruin({tariff.ruin})."


def _costs(problem: Problem) -> Iterator[str]:
    """Yield what units cost that have a cost, as whole multiples of the largest part that divides all."""
    units, kitchen = problem.world.foon.units, problem.world.kitchen
    known = {number: kitchen.known_cost(units[number]) for number in problem.units}
    costs = {number: cost for number, cost in known.items() if cost is not None}
    grain = grain_of(costs.values())
    for number, cost in costs.items():
        yield f"costs({number},{cost / grain})."


def _per_thousand(rate: float) -> int:
    """Round a chance in [0, 1] to parts per thousand; what can succeed stays above zero."""
    return max(1, round(rate * 1000)) if rate > 0 else 0


def _failure_cost(rate: int) -> int:
    """Return -ln(rate/1000), scaled and rounded, for a rate in parts per thousand."""
    return round(-math.log(rate / 1000) * PLAIN) if rate > 0 else _IMPOSSIBLE


def _query(problem: Problem, objects: Iterable[ObjectId], tariff: Tariff | None) -> Iterator[str]:
    """Yield which of some objects are at hand, what is to be made, and under which constraints."""
    world = problem.world
    for number in objects:
        if number in world.stock:
            yield f"kitchen({number})."
            if number in world.quantities:
                yield f"quantity({number},{world.quantities[number]})."
    for number in problem.goals:
        yield f"#external goal({number})." if problem.switched else f"goal({number})."
    for kind, name, values in problem.constraints.named():
        for value in values:
            if isinstance(value, str):
                value = quote(value)
            elif kind == "max_failure":
                value = (tariff or plain_tariff(problem)).most_failure(value)
            elif kind in _COUNTS:
                # More than all units is as good as no limit, and must not cost more.
                value = min(int(value), len(problem.units))
            yield f"{kind}({quote(name)},{value})."
        if not values:
            yield f'{kind}({quote(name)},"").'


def _readings(problem: Problem) -> list[str]:
    """Return what the units of a problem need and make besides the kitchen."""
    reading, stock = problem.world.units, problem.world.stock
    lines = []
    for unit in problem.units:
        limits.check()
        needs = [object_id for object_id in reading.needs[unit] if object_id not in stock]
        makes = [object_id for object_id in reading.makes[unit] if object_id not in stock]
        lines.append(_reading(unit, needs, makes))
    return lines


def _reading(unit: Name, needs: Iterable[Name], makes: Iterable[Name]) -> str:
    parts = [f"unit({unit}).", *(f"needs({unit},{each})." for each in needs)]
    return " ".join([*parts, *(f"makes({unit},{each})." for each in makes)])


def _details(problem: Problem) -> Iterator[str]:
    """Yield all that is known of the objects and units of a problem."""
    world = problem.world
    if world.labels_only:
        yield "#const labels_only = 1. [override]"
    if world.units.loose:
        yield "#const loose = 1. [override]"
    labels: set[str] = set()
    for number in problem.objects:
        limits.check()
        node = world.node(number)
        labels.update(node.named_labels)
        yield _object_facts(number, node)
        if number in world.lasting:
            yield f"lasting({number})."
        if (other := world.units.read(number)) != number:
            yield f"counts_as({number},{other})."
    for unit_id in problem.units:
        unit = world.foon.units[unit_id]
        yield _unit_facts(unit_id, unit, unit.inputs, unit.outputs)
    for label in sorted(world.kitchen.utensils & labels):
        yield f"utensil({quote(label)})."


@lru_cache(maxsize=1 << 16)
def _object_facts(number: Name, node: ObjectNode) -> str:
    parts = [f"object({number}). label({number},{quote(node.label)})."]
    for state in node.states:
        name = quote(state.name)
        if state.relatum is not None:
            parts.append(f"relation({number},{name},{quote(state.relatum)}).")
        for content in dict.fromkeys(state.contents or ()):
            parts.append(f"content({number},{name},{quote(content)}).")
        if state.relatum is None and not state.contents:
            parts.append(f"state({number},{name}).")
    return " ".join(parts)


_COUNTS = frozenset({"max_units", "max_depth", "human_steps"})
"""Constraints by a number of units, or of rounds, of which there are no more than units."""


def _unit_facts(number: Name, unit: FunctionalUnit, inputs: Iterable[Name], outputs: Iterable[Name]) -> str:
    parts = [f"unit({number}). motion({number},{quote(unit.motion)})."]
    parts += [f"input({number},{each})." for each in inputs]
    parts += [f"output({number},{each})." for each in outputs]
    return " ".join([*parts, *_times(number, unit), *_duration(number, unit)])


def _times(number: Name, unit: FunctionalUnit) -> Iterator[str]:
    """Yield when a unit starts and ends, as far as that is known."""
    times = {"start": unit.annotation.start, "end": unit.annotation.end}
    known = {name: round(seconds) for name, seconds in times.items() if seconds is not None}
    # A video of more than 68 years is moved to where clingo can count; it takes as long as before.
    beyond = max(0, *known.values(), MOST) - MOST
    for name, seconds in known.items():
        yield f"{name}({number},{max(0, seconds - beyond)})."


def _duration(number: Name, unit: FunctionalUnit) -> Iterator[str]:
    """Yield how long a unit takes, if that is known."""
    if unit.duration is not None:
        yield f"duration({number},{min(MOST, unit.duration)})."
