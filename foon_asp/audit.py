"""The audit: what is doubtful in a FOON, what locks the units that never run, and what would free them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from foon_asp import resources
from foon_asp.builder import FoonBuilder
from foon_asp.decode import column, rows
from foon_asp.errors import closest, counted, shortened
from foon_asp.explain import missing_sets
from foon_asp.facts import facts
from foon_asp.findings import Finding, Severity
from foon_asp.graph import Foon, FunctionalUnit, ObjectNode, State
from foon_asp.kitchen import Kitchen
from foon_asp.problem import Domain, Problem
from foon_asp.solve import Solver, Value
from foon_asp.spelling import misspellings


@dataclass(frozen=True, slots=True)
class Lock:
    """A need that keeps units from ever running, and the edit that opens most of them.

    The edit: in `unit`, the input `need` is replaced by `replacement` (None: nothing that can be had
    resembles it, so only taking it away is proposed). `circle` are the units that keep the need from
    being made, `unit` among them; empty if nothing makes it. `opens` are the units that can run after the
    edit and the edits of the locks before; `unlocks` the goals among what they make, or else the end
    products.
    """

    unit: FunctionalUnit
    need: ObjectNode
    replacement: ObjectNode | None
    circle: tuple[FunctionalUnit, ...]
    opens: tuple[FunctionalUnit, ...]
    unlocks: tuple[ObjectNode, ...]


@dataclass(frozen=True, slots=True)
class LockedGoal:
    """A goal that the kitchen cannot make, and the smallest set of objects that would change this.

    `missing` holds the dish itself in another state or vessel only if nothing else helps; it is None if no
    set helps.
    """

    goal: ObjectNode
    missing: tuple[ObjectNode, ...] | None


@dataclass(frozen=True, slots=True)
class Audit:
    """All findings, sorted by place; the locks, the one that opens most first; the locked goals."""

    findings: tuple[Finding, ...]
    locks: tuple[Lock, ...]
    locked_goals: tuple[LockedGoal, ...]


def audit(
    foon: Foon,
    kitchen: Kitchen | None = None,
    goals: Iterable[ObjectNode] = (),
    findings: Iterable[Finding] = (),
) -> Audit:
    """Find what is doubtful in a FOON, beside the `findings` of reading it.

    Without a kitchen, or with an empty one, everything that no unit makes is taken to be at hand.
    """
    kitchen = kitchen or Kitchen(())
    named_kitchen = bool(kitchen.objects)
    if not named_kitchen:
        raw = {number for unit in foon.units for number in unit.inputs}
        made = {number for unit in foon.units for number in unit.outputs if not foon.objects[number].bare}
        objects = tuple(foon.objects[number] for number in sorted(raw - made))
        kitchen = replace(kitchen, objects=objects)
    domain = Domain(foon, kitchen)
    known_goals = [goal for goal in goals if foon.id_of(goal) is not None]
    locks = list(find_locks(domain, known_goals))
    locked = [
        _locked_goal(domain, goal)
        for goal in known_goals
        if domain.id_of(goal) not in domain.closure.available
    ]
    found = [
        *findings,
        *_spelling_findings(foon),
        *_rate_findings(foon, kitchen),
        *_time_findings(foon),
        *_graph_findings(domain, named_kitchen),
        *(_lock_finding(lock) for lock in locks),
        *(_goal_finding(domain, each) for each in locked),
    ]
    found.sort(key=lambda finding: (finding.file, finding.line, finding.code, finding.message))
    return Audit(tuple(found), tuple(locks), tuple(locked))


def _finding(code: str, severity: Severity, unit: FunctionalUnit, message: str, mend: str = "") -> Finding:
    return Finding(code, severity, unit.source.file, unit.source.line, message, mend)


def _first_units(foon: Foon) -> dict[int, FunctionalUnit]:
    """Return for each object the first unit that lists it."""
    first: dict[int, FunctionalUnit] = {}
    for unit in foon.units:
        for number in (*unit.inputs, *unit.outputs):
            first.setdefault(number, unit)
    return first


def _spelling_findings(foon: Foon) -> Iterator[Finding]:
    counts: Counter[str] = Counter()
    first: dict[str, FunctionalUnit] = {}
    for unit in foon.units:
        for number in (*unit.inputs, *unit.outputs):
            for label in foon.objects[number].named_labels:
                counts[label] += 1
                first.setdefault(label, unit)
    for label, better in misspellings(counts, resources.lexicon()):
        count = counted(counts[label], "time")
        yield _finding(
            "spelling",
            Severity.WARNING,
            first[label],
            f"{label!r} ({count}) looks like a misspelling",
            f"write {better!r}",
        )


def _rate_findings(foon: Foon, kitchen: Kitchen) -> Iterator[Finding]:
    if not kitchen.rates:
        return
    seen: set[str] = set()
    for unit in foon.units:
        if unit.motion not in seen and kitchen.known_rate(unit) is None:
            seen.add(unit.motion)
            yield _finding(
                "motion-without-rate",
                Severity.WARNING,
                unit,
                f"the motion {unit.motion!r} has no success rate{closest(unit.motion, kitchen.rates, 1)}",
            )


def _time_findings(foon: Foon) -> Iterator[Finding]:
    """Compare each unit with the one before it in the same file."""
    before: FunctionalUnit | None = None
    for unit in foon.units:
        start, end = unit.annotation.start, before.annotation.end if before else None
        if before and before.source.file == unit.source.file and start is not None and end is not None:
            begun = before.annotation.start
            if begun is not None and start < begun:
                message = f"begins at {_clock(start)}, before the unit above ({_clock(begun)})"
                yield _finding("times-out-of-order", Severity.NOTE, unit, message)
            elif start < end:
                message = f"begins at {_clock(start)}, while the unit above goes on until {_clock(end)}"
                yield _finding("times-overlap", Severity.NOTE, unit, message)
        before = unit


def _clock(seconds: float) -> str:
    return f"{int(seconds) // 60}:{int(seconds) % 60:02}"


def _graph_findings(domain: Domain, named_kitchen: bool) -> Iterator[Finding]:
    """Run `audit.lp` over the whole FOON and say each warning in a sentence."""
    solver = Solver(["audit.lp"], facts(Problem(domain, (), whole=True)))
    first = _first_units(domain.foon)
    for code, place in rows(solver.best(), "warning"):
        assert isinstance(place, tuple)
        if code == "nowhere-from" and not named_kitchen:
            continue
        finding = _say(domain, str(code), place, first)
        if finding is None:
            continue
        if code == "never-runs" and not named_kitchen:
            finding = replace(finding, severity=Severity.NOTE)
        yield finding


def _say(
    domain: Domain, code: str, place: tuple[Value, ...], first: dict[int, FunctionalUnit]
) -> Finding | None:
    foon = domain.foon
    numbers = [value for value in place if isinstance(value, int)]
    texts = [value for value in place if isinstance(value, str)]
    of_unit = code in _OF_UNIT
    severity, sentence = (_OF_UNIT if of_unit else _OF_OBJECT)[code]
    nodes = [domain.node(number) for number in (numbers[1:] if of_unit else numbers)]
    unit = foon.units[numbers[0]] if of_unit else first.get(numbers[0])
    if unit is None:
        return None
    message = sentence.format(*nodes, *texts, motion=unit.motion)
    if code == "unknown-label":
        message += closest(texts[0], (label for label in foon.labels if label[:1] == texts[0][:1]), 1)
    return _finding(code, severity, unit, message)


_OF_UNIT = {
    "does-nothing": (Severity.WARNING, "every output of this unit ({motion}) is one of its inputs"),
    "output-is-input": (Severity.NOTE, "{} is both input and output"),
    "content-appears": (Severity.WARNING, "{} contains {}, which no input of the unit names"),
    "content-vanishes": (Severity.NOTE, "{} contains {}, which no output of the unit names"),
    "not-in-container": (Severity.WARNING, "{}, but on the {} side the {} does not contain it"),
    "never-runs": (Severity.WARNING, "this unit ({motion}) can never run"),
}
_OF_OBJECT = {
    "empty-but-contains": (Severity.WARNING, "{} is empty and contains something"),
    "holds-itself": (Severity.WARNING, "{} holds itself"),
    "unknown-label": (Severity.WARNING, "{} names {!r}, which is no object of this FOON"),
    "nowhere-from": (Severity.WARNING, "no unit makes {}, and the kitchen does not have it"),
}
"""Severity and sentence of each code of `audit.lp`; its place begins with a unit, or with an object."""


def find_locks(domain: Domain, goals: Sequence[ObjectNode] = ()) -> Iterator[Lock]:
    """Yield the edits that open units that never run, each time the one that opens most of what is left."""
    foon = domain.foon
    available = dict.fromkeys(domain.closure.available)
    closed = [unit for unit in foon.units if unit.id not in domain.closure.executable]
    while closed:
        rest = _rest(domain, closed, available)
        problem = Problem(rest, (), whole=True)
        answer = Solver(["unlock.lp"], facts(problem)).best()
        opened = [closed[number] for number in column(answer, "opened")]
        if not opened:
            return
        [(place, thing)] = rows(answer, "edit")
        assert isinstance(place, int)
        assert isinstance(thing, int)
        fresh = {
            thing for unit in opened for thing in domain.reading.makes[unit.id] if thing not in available
        }
        need = rest.node(thing)
        yield Lock(
            unit=closed[place],
            need=need,
            replacement=_resembling(domain, closed[place], need, available),
            circle=tuple(closed[number] for number in column(answer, "circle")),
            opens=tuple(opened),
            unlocks=_products(domain, fresh, goals),
        )
        available.update(dict.fromkeys(sorted(fresh)))
        opened_ids = {unit.id for unit in opened}
        closed = [unit for unit in closed if unit.id not in opened_ids]


def _rest(domain: Domain, closed: Sequence[FunctionalUnit], available: Iterable[int]) -> Domain:
    """Return the closed units, in order, as a domain of its own; all that is available is its kitchen."""
    foon = domain.foon
    builder = FoonBuilder()
    for unit in closed:
        builder.unit(
            unit.motion,
            [builder.object(foon.objects[number]) for number in unit.inputs],
            [builder.object(foon.objects[number]) for number in unit.outputs],
            unit.annotation,
        )
    part = builder.build()
    there = set(available)
    stock = tuple(node for node in part.objects if foon.id_of(node) in there)
    return Domain(part, replace(domain.kitchen, objects=stock), strict=domain.strict)


def _resembling(
    domain: Domain, unit: FunctionalUnit, need: ObjectNode, available: Iterable[int]
) -> ObjectNode | None:
    """Return what was probably meant instead of a need: it can be had, and differs in one respect.

    The label is the same. Either it lacks just what the other inputs of the unit bring, as if the output
    had been written among the inputs, or the contents are the same and one state differs.
    """
    inputs = [domain.foon.objects[number] for number in unit.inputs]
    beside = [node for node in inputs if node != need and need.label not in node.containers]
    brought = {label for node in beside for label in (node.label, *node.contents)}
    contents, others = _contents_and_rest(need)
    candidates = []
    for node in map(domain.node, available):
        if node.label != need.label or node.bare:
            continue
        its_contents, its_others = _contents_and_rest(node)
        gain = contents - its_contents
        if others == its_others and its_contents < contents and gain <= brought:
            candidates.append((len(gain), node.sort_key, node))
        elif contents == its_contents and others & its_others and len(others ^ its_others) <= 2:
            candidates.append((len(others ^ its_others), node.sort_key, node))
    return min(candidates)[2] if candidates else None


def _contents_and_rest(node: ObjectNode) -> tuple[set[str], set[State]]:
    return set(node.contents), {state for state in node.states if state.name != "contains"}


def _products(domain: Domain, fresh: set[int], goals: Sequence[ObjectNode]) -> tuple[ObjectNode, ...]:
    """Return the goals among objects, or else those that no unit needs."""
    reached = [goal for goal in goals if domain.id_of(goal) in fresh]
    ends = [domain.node(thing) for thing in sorted(fresh) if thing not in domain.reading.users]
    return tuple(reached or ends)


def _locked_goal(domain: Domain, goal: ObjectNode) -> LockedGoal:
    sets = missing_sets(domain, domain.id_of(goal)).sets
    return LockedGoal(goal, tuple(map(domain.node, sets[0])) if sets else None)


def _lock_finding(lock: Lock) -> Finding:
    units = f"{counted(len(lock.opens), 'unit')} can never run"
    made = shortened(lock.unlocks)
    if len(lock.circle) == 1:
        cause = f"this unit needs {lock.need}, which it makes itself and nothing else can"
    elif lock.circle:
        places = ", ".join(str(unit.source) for unit in lock.circle)
        cause = f"{lock.need} is needed to make itself, in a circle of the units at {places}"
    else:
        cause = f"nothing makes {lock.need}, which this unit needs"
    mend = (
        f"probably {lock.replacement} was meant as input instead"
        if lock.replacement
        else "take this input away, or add a unit that makes it"
    )
    message = f"{units}: {cause}; mended, it opens " + (made or "no end product")
    return _finding("locked", Severity.ERROR, lock.unit, message, mend)


def _goal_finding(domain: Domain, locked: LockedGoal) -> Finding:
    makers = domain.reading.makers.of(domain.id_of(locked.goal))
    message = f"the goal {locked.goal} can never be made"
    mend = ""
    if locked.missing is not None:
        things = "; ".join(map(str, locked.missing))
        mend = f"it could be if the kitchen had {things}"
    if not makers:
        return Finding("goal-locked", Severity.ERROR, "", 0, message, mend)
    return _finding("goal-locked", Severity.ERROR, domain.foon.units[makers[0]], message, mend)
