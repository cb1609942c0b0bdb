"""The audit: what is doubtful in a FOON, what locks the units that never run, and what would free them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

from foon_asp import resources
from foon_asp.asp.facts import facts
from foon_asp.asp.model import Value
from foon_asp.asp.solver import open_solver
from foon_asp.audit.locks import Lock, find_locks
from foon_asp.io.findings import Finding, Severity
from foon_asp.limits import Limit, LimitReachedError, check, limited, reached
from foon_asp.model.foon import Foon
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, UnitId
from foon_asp.model.spelling import misspellings
from foon_asp.model.world import World
from foon_asp.query.problem import Problem
from foon_asp.query.status import Status
from foon_asp.retrieval.missing import missing_sets
from foon_asp.words import closest, counted, shortened


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
    """All findings, sorted by place; the locks, the one that opens most first; the locked goals.

    At a `limit` they are those that were found before, and what locked goals miss need not be the least.
    """

    findings: tuple[Finding, ...]
    locks: tuple[Lock, ...]
    locked_goals: tuple[LockedGoal, ...]
    limit: Limit | None = None

    @property
    def status(self) -> Status:
        """How the audit ended: with all that there is to find, or at a limit."""
        return Status.LIMIT if self.limit else Status.FOUND


def audit(
    foon: Foon,
    kitchen: Kitchen | None = None,
    goals: Iterable[ObjectNode] = (),
    findings: Iterable[Finding] = (),
    *,
    time_limit: float | None = None,
    memory_limit: float | None = None,
) -> Audit:
    """Find what is doubtful in a FOON, beside the `findings` of reading it.

    Without a kitchen everything that no unit makes is taken to be at hand; with an empty one, nothing is.
    The limits (seconds, megabytes) are for all of it.
    """
    with limited(time_limit, memory_limit):
        search = _Search(foon, kitchen or Kitchen((), stated=False), tuple(goals), list(findings))
        return search.run()


class _Search:
    """One audit: what has been found so far."""

    def __init__(
        self, foon: Foon, kitchen: Kitchen, goals: tuple[ObjectNode, ...], findings: list[Finding]
    ) -> None:
        self._world = World.of(foon, kitchen)
        self._goals = [goal for goal in goals if foon.id_of(goal) is not None]
        self._findings = findings
        self._locks: list[Lock] = []
        self._locked: list[LockedGoal] = []

    def run(self) -> Audit:
        """Look for one kind of findings after the other, those that take least first."""
        limit = None
        foon, kitchen = self._world.foon, self._world.kitchen
        kinds: tuple[Callable[[], Iterator[Finding]], ...] = (
            lambda: _time_findings(foon),
            lambda: _rate_findings(foon, kitchen),
            lambda: _spelling_findings(foon),
            lambda: _graph_findings(self._world, kitchen.stated),
            self._find_locks,
            self._find_locked_goals,
        )
        try:
            for kind in kinds:
                check()
                for finding in kind():
                    self._findings.append(finding)
        except LimitReachedError as error:
            limit = error.limit
        found = sorted(self._findings, key=lambda each: (each.file, each.line, each.code, each.message))
        return Audit(tuple(found), tuple(self._locks), tuple(self._locked), limit)

    def _find_locks(self) -> Iterator[Finding]:
        for lock in find_locks(self._world, self._goals):
            self._locks.append(lock)
            yield _lock_finding(lock)

    def _find_locked_goals(self) -> Iterator[Finding]:
        for goal in self._goals:
            if self._world.id_of(goal) not in self._world.closure.available:
                if limit := reached():
                    raise LimitReachedError(limit)
                self._locked.append(_locked_goal(self._world, goal))
                yield _goal_finding(self._world, self._locked[-1])


def _finding(code: str, severity: Severity, unit: FunctionalUnit, message: str, mend: str = "") -> Finding:
    return Finding(code, severity, unit.source.file, unit.source.line, message, mend)


def _first_units(foon: Foon) -> dict[ObjectId, FunctionalUnit]:
    """Return for each object the first unit that lists it."""
    first: dict[ObjectId, FunctionalUnit] = {}
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


class _Hints:
    """What may be meant by the first hundred of unknown words: each is compared with all that are known."""

    def __init__(self) -> None:
        self._left = 100

    def closest(self, word: str, known: Iterable[str]) -> str:
        """Return what `words.closest` does, or nothing."""
        self._left -= 1
        return closest(word, known, 1) if self._left >= 0 else ""


def _rate_findings(foon: Foon, kitchen: Kitchen) -> Iterator[Finding]:
    if not kitchen.rates:
        return
    seen: set[str] = set()
    hints = _Hints()
    for unit in foon.units:
        if unit.motion not in seen and kitchen.known_rate(unit) is None:
            seen.add(unit.motion)
            yield _finding(
                "motion-without-rate",
                Severity.WARNING,
                unit,
                f"the motion {unit.motion!r} has no success rate{hints.closest(unit.motion, kitchen.rates)}",
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


def _graph_findings(world: World, named_kitchen: bool) -> Iterator[Finding]:
    """Run `audit.lp` over the whole FOON and say each warning in a sentence."""
    solver = open_solver(["audit/audit.lp"], facts(Problem(world, (), whole=True)))
    first = _first_units(world.foon)
    hints = _Hints()
    for code, place in solver.best().rows("warning"):
        assert isinstance(place, tuple)
        if code == "nowhere-from" and not named_kitchen:
            continue
        finding = _say(world, str(code), place, first, hints)
        if finding is None:
            continue
        if code == "never-runs" and not named_kitchen:
            finding = replace(finding, severity=Severity.NOTE)
        yield finding


def _say(
    world: World,
    code: str,
    place: tuple[Value, ...],
    first: Mapping[ObjectId, FunctionalUnit],
    hints: _Hints,
) -> Finding | None:
    foon = world.foon
    numbers = [value for value in place if isinstance(value, int)]
    texts = [value for value in place if isinstance(value, str)]
    of_unit = code in _OF_UNIT
    severity, sentence = (_OF_UNIT if of_unit else _OF_OBJECT)[code]
    nodes = [world.node(ObjectId(number)) for number in (numbers[1:] if of_unit else numbers)]
    unit = foon.units[UnitId(numbers[0])] if of_unit else first.get(ObjectId(numbers[0]))
    if unit is None:
        return None
    message = sentence.format(*nodes, *texts, motion=unit.motion)
    if code == "unknown-label":
        message += hints.closest(texts[0], (label for label in foon.labels if label[:1] == texts[0][:1]))
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


def _locked_goal(world: World, goal: ObjectNode) -> LockedGoal:
    sets = missing_sets(world, world.id_of(goal)).sets
    return LockedGoal(goal, tuple(map(world.node, sets[0])) if sets else None)


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


def _goal_finding(world: World, locked: LockedGoal) -> Finding:
    makers = world.units.makers.of(world.id_of(locked.goal))
    message = f"the goal {locked.goal} can never be made"
    mend = ""
    if locked.missing is not None:
        missing = "; ".join(map(str, locked.missing))
        mend = f"it could be if the kitchen had {missing}"
    if not makers:
        return Finding("goal-locked", Severity.ERROR, "", 0, message, mend)
    return _finding("goal-locked", Severity.ERROR, world.foon.units[makers[0]], message, mend)
