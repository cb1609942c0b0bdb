"""What the comparison with the peers measures, as rows, and what is made of them."""

from __future__ import annotations

import json
import statistics
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

OURS = "clingo"
REDUCED, UNREDUCED = "-reduced", "-unreduced"
"""What follows the name of a peer that is given what the reductions leave, and of clingo if it is not."""
EXACT = (
    OURS,
    OURS + UNREDUCED,
    "cp-sat",
    "cp-sat" + REDUCED,
    "fd-lmcut",
    "fd-lmcut" + REDUCED,
    "fd-operator-counting",
    "integer-program",
    "integer-program" + REDUCED,
)
GREEDY = ("greedy-success", "greedy-inputs", "greedy-first")
MENU = "menu"
WAYS = ("plain", "suggest", MENU)
LIMIT = 60.0
"""Seconds that a method has for a goal."""


@dataclass(frozen=True, slots=True)
class MethodSummary:
    """How an exact method did, in seconds and MiB; times are medians over the runs of each goal.

    `proven` counts the goals with a proven answer, `trees` those with a proven tree, and `agreeing` the
    proven ones that agree with all other methods. Times are over the goals with a proven tree; `ratio` is
    the geometric mean of how many times as long as clingo it took, over the goals that both have proven.
    `phases` are geometric means. `loaded` is the peak memory once the FOON is loaded, `peak` that at the
    end, of the largest process of the method. `whole` and `whole_peak` are of whole processes with one goal.
    """

    method: str
    asked: int
    proven: int
    trees: int
    agreeing: int
    median: float
    maximum: float
    geometric_mean: float
    ratio: float
    phases: Mapping[str, float]
    loaded: float
    peak: float
    whole: float | None
    whole_ratio: float | None
    whole_peak: float | None


@dataclass(frozen=True, slots=True)
class GreedySummary:
    """How a heuristic of the paper did over the goals that can be made.

    `excess` counts the units of its executable trees above the optimum, as a share of the optimum.
    `smaller` are trees with fewer units than any executable tree: they go in circles.
    """

    method: str
    asked: int
    executable: int
    optimal: int
    smaller: int
    mean_excess: float
    largest_excess: float
    median: float
    maximum: float
    geometric_mean: float
    peak: float


@dataclass(frozen=True, slots=True)
class GoalRow:
    """One goal: the optimum, None if there is no tree, and units, status and median seconds by method."""

    goal: str
    optimum: int | None
    units: Mapping[str, int | None]
    statuses: Mapping[str, str]
    executable: Mapping[str, bool | None]
    seconds: Mapping[str, float]
    whole: Mapping[str, float]


@dataclass(frozen=True, slots=True)
class Everything:
    """All objects that can be made, proven by clingo in one process, in one of two ways, or a menu.

    `plain` retrieves one by one on a warm domain, `suggest` grounds many together; `menu` is one tree for all
    public goals that can be made. `seconds` are without
    the loading; `whole` is the process from start to exit. Medians over the runs.
    """

    way: str
    asked: int
    proven: int
    units: int
    seconds: float
    whole: float
    peak: float


@dataclass(frozen=True, slots=True)
class Peers:
    """The outcome of one run, for the report."""

    machine: str
    command: str
    goals: str
    asked: int
    makeable: int
    runs: int
    limit: float
    methods: tuple[MethodSummary, ...]
    greedy: tuple[GreedySummary, ...]
    rows: tuple[GoalRow, ...]
    everything: tuple[Everything, ...]
    disagreements: tuple[str, ...]
    notes: tuple[str, ...]

    @classmethod
    def read(cls, path: Path) -> Peers:
        """Read what a run has written."""
        data = json.loads(path.read_text(encoding="utf-8"))
        data["methods"] = tuple(MethodSummary(**each) for each in data["methods"])
        data["greedy"] = tuple(GreedySummary(**each) for each in data["greedy"])
        data["rows"] = tuple(GoalRow(**each) for each in data["rows"])
        data["everything"] = tuple(Everything(**each) for each in data["everything"])
        data["disagreements"], data["notes"] = tuple(data["disagreements"]), tuple(data["notes"])
        return cls(**data)

    def write(self, path: Path) -> None:
        """Write it where `read` finds it."""
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(json.dumps(asdict(self), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


@dataclass(frozen=True, slots=True)
class Row:
    """One measurement: a goal by a method (`kind` is `warm` or `whole`), or everything in one of the ways."""

    kind: str
    method: str
    goal: int
    run: int
    seconds: float
    status: str = ""
    units: int | None = None
    executable: bool | None = None
    phases: Mapping[str, float] = field(default_factory=dict)
    loaded: float = 0.0
    peak: float = 0.0
    message: str = ""

    @property
    def key(self) -> tuple[str, str, int, int]:
        return self.kind, self.method, self.goal, self.run

    @property
    def answer(self) -> tuple[str, int | None]:
        """What all exact methods must agree on."""
        return self.status, self.units

    @property
    def proven(self) -> bool:
        return self.status in ("optimal", "unreachable")

    def __str__(self) -> str:
        return f"{self.method} says {self.status}" + (
            "" if self.units is None else f" with {self.units} units"
        )


class Rows:
    """The rows so far, in a file that only grows."""

    def __init__(self, path: Path, *, fresh: bool) -> None:
        path.parent.mkdir(parents=True, exist_ok=True)
        self._file = path.open("w" if fresh else "a+", encoding="utf-8")
        self._file.seek(0)
        lines = [] if fresh else self._file.readlines()
        self.found = {row.key: row for row in (Row(**json.loads(line)) for line in lines)}

    def add(self, row: Row) -> None:
        self.found[row.key] = row
        self._file.write(json.dumps(asdict(row)) + "\n")
        self._file.flush()

    def close(self) -> None:
        self._file.close()

    def missing(self, *key: Any) -> bool:
        return key not in self.found

    def __iter__(self) -> Iterator[Row]:
        return iter(self.found.values())


@dataclass(frozen=True, slots=True)
class Tally:
    """The rows of a run by goal and method: one answer for each, and the median of the times."""

    answers: Mapping[tuple[int, str], Row]
    seconds: Mapping[tuple[int, str], float]
    whole: Mapping[tuple[int, str], float]
    disagreements: tuple[str, ...]

    @classmethod
    def of(cls, rows: Iterable[Row], there: Mapping[int, str]) -> Tally:
        """Tally rows up; whatever is not the same in all runs and all exact methods is a disagreement."""
        answers: dict[tuple[int, str], Row] = {}
        times: dict[str, dict[tuple[int, str], list[float]]] = {"warm": {}, "whole": {}}
        quarrels: list[str] = []
        for row in rows:
            if row.goal not in there or row.kind not in times:
                continue
            key = row.goal, row.method
            times[row.kind].setdefault(key, []).append(row.seconds)
            first = answers.setdefault(key, row)
            quarrels += [f"{there[row.goal]}: {problem}" for problem in _doubts(row, first)]
            if row.status == "limit":
                answers[key] = row
        for goal, text in there.items():
            proven = _proven(answers, goal)
            if len({row.answer for row in proven}) > 1:
                quarrels.append(f"{text}: {', '.join(map(str, proven))}")
        warm, whole = (
            {key: statistics.median(each) for key, each in found.items()} for found in times.values()
        )
        return cls(answers, warm, whole, tuple(dict.fromkeys(quarrels)))

    def proven(self, goal: int) -> list[Row]:
        """Return the proven answers of the exact methods for a goal."""
        return _proven(self.answers, goal)

    def optimum(self, goal: int) -> int | None:
        """Return the proven least number of units, None if there is no tree."""
        return next((row.units for row in self.proven(goal) if row.status == "optimal"), None)

    def times(self, method: str, goals: Iterable[int]) -> dict[int, float]:
        """Return the median seconds of the goals with a proven tree."""
        return {
            goal: self.seconds[goal, method]
            for goal in goals
            if (goal, method) in self.seconds and self.answers[goal, method].status == "optimal"
        }


def _proven(answers: Mapping[tuple[int, str], Row], goal: int) -> list[Row]:
    rows = (answers.get((goal, method)) for method in EXACT)
    return [row for row in rows if row is not None and row.proven]


def _doubts(row: Row, first: Row) -> Iterator[str]:
    """Yield what is wrong with a row by itself, or beside the first row of its method for its goal."""
    if row.status == "failed":
        yield f"{row.method} failed: {row.message}"
    if row.method in EXACT and row.executable is False:
        yield f"the tree of {row.method} fails its replay"
    if "limit" not in (row.status, first.status) and row.answer != first.answer:
        yield f"{row}, but before that {first}"


def base(method: str) -> str:
    """Return the name of a method, whatever it was given."""
    return method.removesuffix(REDUCED).removesuffix(UNREDUCED)


def _mean(values: Iterable[float]) -> float:
    """Return the geometric mean; it is 0 if there is nothing."""
    found = [max(value, 1e-9) for value in values]
    return statistics.geometric_mean(found) if found else 0.0


def summarise(method: str, rows: Sequence[Row], tally: Tally, goals: Sequence[int]) -> MethodSummary:
    """Sum an exact method up."""
    answers = [row for goal in goals if (row := tally.answers.get((goal, method)))]
    proven = [row for row in answers if row.proven]
    agreeing = [row for row in proven if {row.answer} == {each.answer for each in tally.proven(row.goal)}]
    mine, ours = tally.times(method, goals), tally.times(OURS, goals)
    wholes = {goal: tally.whole[goal, method] for goal in mine if (goal, method) in tally.whole}
    warm = [row for row in rows if row.method == method and row.kind == "warm"]
    names = dict.fromkeys(name for row in warm for name in row.phases)
    return MethodSummary(
        method,
        len(answers),
        len(proven),
        len(mine),
        len(agreeing),
        statistics.median(mine.values()) if mine else 0.0,
        max(mine.values(), default=0.0),
        _mean(mine.values()),
        _mean(mine[goal] / ours[goal] for goal in mine if goal in ours),
        {
            name: _mean(row.phases[name] for row in warm if row.goal in mine and name in row.phases)
            for name in names
        },
        min((row.loaded for row in warm if row.loaded), default=0.0),
        max((row.peak for row in warm), default=0.0),
        statistics.median(wholes.values()) if wholes else None,
        _mean(each / tally.whole[goal, OURS] for goal, each in wholes.items()) if wholes else None,
        max(row.peak for row in rows if row.kind == "whole" and row.method == method) if wholes else None,
    )


def summarise_greedy(method: str, rows: Sequence[Row], tally: Tally, goals: Sequence[int]) -> GreedySummary:
    """Sum a heuristic up, over the goals whose optimum is known."""
    known = {goal: best for goal in goals if (best := tally.optimum(goal)) is not None}
    found = {goal: row for goal in known if (row := tally.answers.get((goal, method)))}
    above = [row.units / known[goal] - 1 for goal, row in found.items() if row.executable and row.units]
    times = [tally.seconds[goal, method] for goal in found]
    return GreedySummary(
        method,
        len(found),
        sum(row.executable is True for row in found.values()),
        sum(each == 0 for each in above),
        sum((row.units or 0) < known[goal] for goal, row in found.items()),
        statistics.fmean(above) if above else 0.0,
        max(above, default=0.0),
        statistics.median(times) if times else 0.0,
        max(times, default=0.0),
        _mean(times),
        max((row.peak for row in rows if row.method == method), default=0.0),
    )


def goal_row(goal: int, text: str, methods: Sequence[str], tally: Tally) -> GoalRow:
    """Put together what all methods say of a goal."""
    rows = {method: row for method in methods if (row := tally.answers.get((goal, method)))}
    return GoalRow(
        text,
        tally.optimum(goal),
        {method: row.units for method, row in rows.items()},
        {method: row.status for method, row in rows.items()},
        {method: row.executable for method, row in rows.items()},
        {method: tally.seconds[goal, method] for method in rows},
        {method: tally.whole[goal, method] for method in rows if (goal, method) in tally.whole},
    )


def in_short(result: Peers) -> Iterator[str]:
    """Yield the summary as markdown."""
    yield f"{result.asked} goals, {result.makeable} can be made; {result.runs} runs; {result.machine}\n"
    yield (
        "| method | proven | agree | median (ms) | max (ms) | geometric mean (ms) | x clingo | peak (MiB)"
        " | whole (s) |"
    )
    yield "|---|---:|---:|---:|---:|---:|---:|---:|---:|"
    for each in result.methods:
        whole = "" if each.whole is None else f"{each.whole:.2f}"
        yield (
            f"| {each.method} | {each.proven} of {each.asked} | {each.agreeing} | {1000 * each.median:.1f}"
            f" | {1000 * each.maximum:.1f} | {1000 * each.geometric_mean:.1f} | {each.ratio:.2f}"
            f" | {each.peak:.0f} | {whole} |"
        )
    yield "\n| heuristic | executable | optimal | smaller | mean excess | largest | geometric mean (ms) |"
    yield "|---|---:|---:|---:|---:|---:|---:|"
    for heuristic in result.greedy:
        yield (
            f"| {heuristic.method} | {heuristic.executable} of {heuristic.asked} | {heuristic.optimal}"
            f" | {heuristic.smaller} | {heuristic.mean_excess:.0%} | {heuristic.largest_excess:.0%}"
            f" | {1000 * heuristic.geometric_mean:.1f} |"
        )
    yield ""
    for way in result.everything:
        yield (
            f"everything, {way.way}: {way.proven} of {way.asked} proven in {way.seconds:.2f} s"
            f" (process {way.whole:.2f} s, {way.peak:.0f} MiB)"
        )
    yield from result.notes
