"""Write benchmarks/RESULTS.md and its plots from what the other scripts have measured.

    python benchmarks/report.py [--results DIR] [--output FILE.md]

Reads peers.json, configurations.json, growth.json, throughput.json and commands.json; what is not there is
left out, and said to be missing.
"""

from __future__ import annotations

import argparse
import math
import re
import statistics
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib as mpl
from configurations import Configurations
from growth import HUGE, LARGE, Asked, Growth, Size
from machine import RESULTS
from peer_results import MENU, REDUCED, Peers, base
from retrieval import COMPARE, IMPORTS, ONE, Commands
from retrieval import table as commands_table
from throughput import PUBLIC, Throughput

mpl.use("Agg")
from matplotlib import pyplot as plt

# Okabe and Ito's colours, which people who see fewer colours can tell apart, each with a mark of its own.
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
_MARKS = ("o", "s", "^", "D", "v", "P", "x")
_FAMILIES = ("random", "chain", "dense", "public")
_STAGES = ("parse", "compile", "open", "domain", "closure")
_NOTHING = "not measured"


def main() -> None:
    parser = argparse.ArgumentParser(description="Write benchmarks/RESULTS.md and its plots.")
    parser.add_argument("--results", type=Path, default=RESULTS, metavar="DIR")
    parser.add_argument("--output", type=Path, default=RESULTS.parent / "RESULTS.md", metavar="FILE.md")
    options = parser.parse_args()
    write(options.results, options.output)


def write(results: Path, output: Path) -> None:
    """Write the report and, into the folder `plots` beside it, its plots."""
    plots = output.parent / "plots"
    plots.mkdir(parents=True, exist_ok=True)
    _style()
    growth = _read(Growth.read, results / "growth.json")
    peers = _read(Peers.read, results / "peers.json")
    more_peers = [_read(Peers.read, results / f"peers-{which}.json") for which in ("all", "sample")]
    configurations = _read(Configurations.read, results / "configurations.json")
    throughput = _read(Throughput.read, results / "throughput.json")
    commands = _read(Commands.read, results / "commands.json")
    lines = [
        "# Results",
        "",
        "Written by `python benchmarks/report.py` from what the other scripts measured; "
        "[README.md](README.md) says how. Each table names its command, machine and number of runs.",
        "",
        *_what_must_hold(growth, peers, more_peers[0], throughput, commands),
        *(_growth(growth, plots) if growth else _missing("Growth", "growth.py")),
        *(_commands(commands) if commands else _missing("Whole commands", "retrieval.py")),
        *(_throughput(throughput) if throughput else _missing("Many queries", "throughput.py")),
        *(_peers(peers, plots) if peers else _missing("Peers", "peers.py")),
        *(line for each in more_peers if each for line in _more_peers(each)),
        *(
            _configurations(configurations)
            if configurations
            else _missing("Solver configurations", "configurations.py")
        ),
    ]
    output.write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


def _read(read: Callable[[Path], Any], path: Path) -> Any:
    return read(path) if path.exists() else None


def _missing(title: str, script: str) -> Iterator[str]:
    yield from (f"## {title}", "", f"Not measured: run `python benchmarks/{script}`.", "")


def _table(head: Sequence[str], rows: Iterable[Sequence[object]]) -> Iterator[str]:
    """Yield a table, its first column to the left and the others to the right."""
    yield "| " + " | ".join(head) + " |"
    yield "|" + "|".join(["---", *("---:" for _ in head[1:])]) + "|"
    for row in rows:
        yield "| " + " | ".join(map(str, row)) + " |"
    yield ""


def seconds(value: float) -> str:
    """Write a time with three digits and its unit."""
    if value == math.inf:
        return "none"
    for unit, factor in (("s", 1.0), ("ms", 1e3), ("µs", 1e6)):
        if value * factor >= 1 or unit == "µs":
            return f"{_digits(value * factor)} {unit}"
    raise AssertionError


def _digits(value: float) -> str:
    """Write a number with three digits, all of them before the point if need be."""
    if value <= 0:
        return "0"
    return f"{value:,.{max(0, 2 - math.floor(math.log10(value)))}f}"


# What must hold.


class Limit(NamedTuple):
    """What must hold: what it is, the limit, what was measured if it was, how to write both, and the day.

    A limit is what must not be passed, or what must be reached (`least`).
    """

    what: str
    limit: float
    measured: float | None
    write: Callable[[float], str]
    date: str = ""
    least: bool = False

    @property
    def met(self) -> bool:
        assert self.measured is not None
        return self.measured >= self.limit if self.least else self.measured <= self.limit

    def row(self) -> tuple[str, str, str, str, str]:
        limit = f"at {'least' if self.least else 'most'} {self.write(self.limit)}"
        if self.measured is None:
            return self.what, limit, _NOTHING, "", ""
        verdict = "met" if self.met else "**not met**"
        return self.what, limit, self.write(self.measured), verdict, self.date


def _what_must_hold(
    growth: Growth | None,
    peers: Peers | None,
    all_peers: Peers | None,
    throughput: Throughput | None,
    commands: Commands | None,
) -> Iterator[str]:
    yield from ("## What must hold", "")
    yield (
        "Each figure is from one of the sections below, which names its machine and command, and from the "
        "day that is named here: what was not measured since may be better by now, or worse."
    )
    yield ""
    rows = [
        *limits_of_commands(commands),
        *limits_of_throughput(throughput),
        *(limits_of_peers(peers) if peers else ()),
        *(limits_of_all_peers(all_peers) if all_peers else ()),
        *limits(growth or Growth(())),
        *limits_of_dense(growth or Growth(())),
    ]
    yield from _table(("what", "limit", "measured", "", "on"), (row.row() for row in rows))
    notes = RESULTS.parent / "findings.md"
    yield from (notes.read_text(encoding="utf-8").splitlines() if notes.exists() else ())
    yield ""


def _times(value: float) -> str:
    return f"{value:.2f}×"


def _count(value: float) -> str:
    return f"{value:.0f}"


def _rate(value: float) -> str:
    return f"{value:.1f}"


def _date(machine: object) -> str:
    """Return the day of a measurement, which the text about a machine has."""
    found = re.search(r"\d{4}-\d\d-\d\d", str(machine))
    return found[0] if found else ""


def limits_of_commands(commands: Commands | None) -> Iterator[Limit]:
    """Yield what must hold of whole commands."""
    date = _date(commands.machine) if commands else ""
    compare, one, imports = (commands.median(name) if commands else None for name in (COMPARE, ONE, IMPORTS))
    yield Limit("`compare` of the 25 public goals, whole process, median", 1.5, compare, seconds, date)
    of = f", {seconds(imports)} of it start and imports" if imports else ""
    what = f"one cold `retrieve` on the public FOON, whole process, median{of}"
    yield Limit(what, 0.6, one, seconds, date)


def limits_of_throughput(throughput: Throughput | None) -> Iterator[Limit]:
    """Yield what must hold of many queries."""
    rates = [rate for rate in throughput.rates if rate.data == PUBLIC] if throughput else []
    slowest = min((rate.each_job for rate in rates), default=None)
    jobs = " and ".join(str(rate.jobs) for rate in rates)
    with_ = f", the slower of {jobs} processes" if rates else ""
    what = f"`batch`, queries a second and process, public FOON{with_}"
    yield Limit(what, 400, slowest, _rate, _date(throughput.machine) if throughput else "", least=True)


def limits_of_peers(peers: Peers) -> Iterator[Limit]:
    """Yield what must hold on the universal FOON."""
    date = _date(peers.machine)
    took = {each.way: each.seconds for each in peers.everything}
    ways = [took[way] for way in ("plain", "suggest") if way in took]
    objects = max((each.asked for each in peers.everything), default=0)
    what = f"all {objects:,} objects, an optimum each, one process"
    yield Limit(what, 15.0, min(ways, default=None), seconds, date)
    what = "one menu of all public goals that can be made"
    yield Limit(what, 1.0, took.get(MENU), seconds, date)
    ours, *others = peers.methods
    for each in others:
        if each.method == base(each.method) != ours.method:
            what = f"time of {each.method} in times of clingo's, geometric mean over the goals"
            ratio = each.geometric_mean / ours.geometric_mean
            yield Limit(what, 10.0, ratio, _times, date, least=True)


def limits_of_all_peers(peers: Peers) -> Iterator[Limit]:
    """Yield what must hold of all objects that can be made, beside CP-SAT."""
    ours, given = (
        peers.methods[0],
        {"cp-sat": "the same slices", f"cp-sat{REDUCED}": "what the reductions leave"},
    )
    for each in peers.methods[1:]:
        if each.method in given:
            what = (
                f"{peers.asked:,} public objects, warm, geometric mean: time of clingo in times of CP-SAT's"
            )
            ratio = ours.geometric_mean / each.geometric_mean
            yield Limit(f"{what} on {given[each.method]}", 0.5, ratio, _times, _date(peers.machine))


def limits(growth: Growth) -> Iterator[Limit]:
    """Yield what must hold of a FOON with a million units."""
    small, large = _find(growth, "random", 10_000), _find(growth, "random", 1_000_000)
    chain = _find(growth, "chain", 1_000_000)
    date = _date(large.machine) if large else ""
    yield Limit("read 10⁶ units of text, time", 15.0, _stage(large, "parse"), seconds, date)
    what = "read 10⁶ units of text, peak memory"
    yield Limit(what, 3 * 1024.0, _stage(large, "parse", "peak"), _memory, date)
    yield Limit("open 10⁶ units from the compiled store", 3.0, _stage(large, "open"), seconds, date)
    yield Limit("forward closure, `random` 10⁶", 3.0, _stage(large, "closure"), seconds, date)
    on = _date(chain.machine) if chain else ""
    yield Limit("forward closure, `chain`, 10⁵ deep", 3.0, _stage(chain, "closure"), seconds, on)
    at_small, at_large = _median_query(small), _median_query(large)
    what = "one `optimal` query, store open, median of the goals, `random` 10⁶"
    yield Limit(what, 0.1, at_large, seconds, date)
    ratio = at_large / at_small if at_small and at_large else None
    yield Limit("growth of that median from 10⁴ to 10⁶ units", 3.0, ratio, _times, date)


NEAR = 1.1
"""What is near the best: so many times as many units."""


def limits_of_dense(growth: Growth) -> Iterator[Limit]:
    """Yield what must hold of large slices."""
    large, huge = _find(growth, "dense", LARGE), _find(growth, "dense", HUGE)
    asked, date = _asked(large), _date(large.machine) if large else ""
    count = len(asked) or 100
    near = [each.until(_near(each)) for each in asked]
    what = f"`dense` 10⁵, goals of {count} with a tree within {NEAR:g} × the best known after 2 s"
    soon = sum(value <= 2.0 for value in near) if asked else None
    yield Limit(what, count, soon, _count, date, least=True)
    what = f"the same, until such a tree, slowest of {count} goals"
    yield Limit(what, 2.0, max(near, default=None), seconds, date)
    what = f"`dense` 10⁵, goals of {count} that are proven within 10 s"
    proven = sum(each.proven and each.seconds <= 10.0 for each in asked) if asked else None
    yield Limit(what, math.ceil(0.95 * count), proven, _count, date, least=True)
    asked, date = _asked(huge), _date(huge.machine) if huge else ""
    count = len(asked) or 10
    what = f"`dense` 10⁶, a tree with its gap, store open, slowest of {count} goals"
    slowest = max((each.seconds if each.units else math.inf for each in asked), default=None)
    yield Limit(what, 20.0, slowest, seconds, date)
    peak = huge.queries.peak if huge and huge.queries else None
    yield Limit("the same, peak memory", 6e9 / 2**20, peak, _memory, date)


def _asked(size: Size | None) -> tuple[Asked, ...]:
    return size.queries.asked if size and size.queries else ()


def _near(asked: Asked) -> float:
    """Return how many units a tree may have that is near the best one of the run."""
    return math.inf if asked.units is None else NEAR * asked.units


def _memory(mebibytes: float) -> str:
    return f"{mebibytes / 1024:.2f} GiB" if mebibytes >= 1024 else f"{mebibytes:.0f} MiB"


def _find(growth: Growth, family: str, units: int) -> Size | None:
    return next((each for each in growth.sizes if (each.family, each.units) == (family, units)), None)


def _stage(size: Size | None, name: str, what: str = "seconds") -> float | None:
    found = (getattr(stage, what) for stage in size.stages if stage.name == name) if size else ()
    return next(iter(found), None)


def _median_query(size: Size | None) -> float | None:
    return size.queries.whole.median if size and size.queries else None


# Growth.


def _growth(growth: Growth, plots: Path) -> Iterator[str]:
    yield from ("## Growth", "")
    yield (
        "`random`, `dense` and `chain` are generated ([generate.py](generate.py) says what of them is "
        "measured and what is extrapolated); `public` is the universal FOON. Time and peak memory of each "
        "stage, in a process of its own. Measured:"
    )
    yield ""
    runs = dict.fromkeys((str(size.machine), size.command) for size in growth.sizes)
    for machine, command in runs:
        yield f"- {machine}. Command: `{command}`."
    yield ""
    head: Sequence[str] = ("family", "units", "lines", "runs", *_STAGES)
    yield from _table((*head, "parse, peak", "query, peak", "store", "on"), map(_stages_row, growth.sizes))
    yield "![Time of each stage by size](plots/growth.png)"
    yield ""
    yield (
        "One `optimal` query by units, store and domain open, with a time limit. The slice is what can "
        "matter for a goal. Goals are asked however large it is; what was not proven counts with the limit. "
        "`first`: the first tree, and how many times as many units as the best one known it has. `near`: the "
        f"first tree that has at most {NEAR:g} times as many. `gap`: of the goals that were not proven, the "
        "largest share of the units that may be too many."
    )
    yield ""
    asked = [size for size in growth.sizes if size.queries]
    head = ("family", "units", "limit", "proven", "slice: median", "max", "query: median", "90%", "max")
    head = (*head, "first: median", "max", "its units: median", "max", "near: median", "max", "gap", "on")
    yield from _table(head, map(_query_row, asked))
    missing = [f"`{size.family}` {size.units:,}" for size in growth.sizes if not size.queries]
    if missing:
        yield f"Not asked since goals are asked however large their slice: {', '.join(missing)}."
        yield ""
    yield "![Time of a query by size](plots/queries.png)"
    yield ""
    yield "![Time of a query by the size of its slice](plots/slices.png)"
    yield ""
    _plot_stages(growth, plots / "growth.png")
    _plot_queries(asked, plots / "queries.png")
    _plot_slices(asked, plots / "slices.png")


def _stages_row(size: Size) -> list[str]:
    stages = {stage.name: stage for stage in size.stages}
    return [
        size.family,
        f"{size.units:,}",
        f"{size.lines:,}",
        str(size.stages[0].runs),
        *(seconds(stages[name].seconds) for name in _STAGES),
        _memory(stages["parse"].peak),
        _memory(size.queries.peak) if size.queries else _NOTHING,
        f"{size.store_megabytes:,.1f} MB",
        _date(size.machine),
    ]


def _query_row(size: Size) -> list[str]:
    queries = size.queries
    assert queries is not None
    asked, whole, slices = queries.asked, queries.whole, _slices(size)
    found = [each for each in asked if each.units is not None]
    first = [each.better[0][0] for each in found] + [math.inf] * (len(asked) - len(found))
    excess = [each.better[0][1] / each.units for each in found if each.units] or [math.inf]
    near = [each.until(_near(each)) for each in asked]
    gaps = [1 - (each.bound or 0) / each.units for each in found if each.units and not each.proven]
    return [
        size.family,
        f"{size.units:,}",
        seconds(queries.limit),
        f"{queries.proven} of {len(asked)}",
        *(f"{slices[place]:,}" for place in (len(slices) // 2, -1)),
        *(seconds(value) for value in (whole.median, whole.p90, whole.maximum)),
        *(seconds(value) for value in (statistics.median(first), max(first))),
        *(_times(value) for value in (statistics.median(excess), max(excess))),
        *(seconds(value) for value in (statistics.median(near), max(near))),
        f"{max(gaps):.0%}" if gaps else "",
        _date(size.machine),
    ]


def _slices(size: Size) -> list[int]:
    return sorted(each.slice for each in _asked(size))


def _families(sizes: Iterable[Size]) -> Iterator[tuple[str, list[Size]]]:
    there = list(sizes)
    for family in dict.fromkeys(each.family for each in there):
        if family != "public":
            yield family, sorted((s for s in there if s.family == family), key=lambda s: s.units)


def _style() -> None:
    mpl.rcParams.update(
        {
            "figure.dpi": 110,
            "font.size": 10,
            "axes.grid": True,
            "grid.color": "#dddddd",
            "axes.spines.top": False,
            "axes.spines.right": False,
            "legend.frameon": False,
            "svg.hashsalt": "foon-asp",
        }
    )


def _save(figure: Any, path: Path) -> None:
    figure.savefig(path, metadata={"Software": None}, bbox_inches="tight")
    plt.close(figure)


def _plot_stages(growth: Growth, path: Path) -> None:
    families = list(_families(growth.sizes))
    figure, every = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    for place, (_, sizes) in enumerate(families):
        for number, name in enumerate(_STAGES):
            units = [size.units for size in sizes]
            values = [_stage(size, name) for size in sizes]
            style = ("-", "--", ":")[place % 3]
            every[0].plot(units, values, style, color=_COLOURS[number], marker=_MARKS[number], markersize=5)
    for number, name in enumerate(_STAGES):
        every[0].plot([], [], color=_COLOURS[number], marker=_MARKS[number], label=name)
    for place, (family, sizes) in enumerate(families):
        style = ("-", "--", ":")[place % 3]
        every[0].plot([], [], style, color="#555555", label=family)
        for number, name in enumerate(_STAGES[:3]):
            every[1].plot(
                [size.units for size in sizes],
                [_stage(size, name, "peak") for size in sizes],
                style,
                color=_COLOURS[number],
                marker=_MARKS[number],
                markersize=5,
            )
    for axes, label in zip(every, ("time (s)", "peak memory (MiB)"), strict=True):
        axes.set(xscale="log", yscale="log", xlabel="functional units", ylabel=label)
    figure.legend(*every[0].get_legend_handles_labels(), loc="outside lower center", ncols=8, fontsize=9)
    _save(figure, path)


def _plot_queries(sizes: Sequence[Size], path: Path) -> None:
    figure, every = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    for family, mine in _families(sizes):
        place = _FAMILIES.index(family)
        style = {"color": _COLOURS[place], "marker": _MARKS[place], "markersize": 5}
        units = [size.units for size in mine]
        wholes = [size.queries.whole for size in mine if size.queries]
        slices = [_slices(size) for size in mine]
        for name, of, at, line in (("median", "median", 0.5, "-"), ("90%", "p90", 0.9, "--")):
            values = [getattr(whole, of) * 1000 for whole in wholes]
            every[0].plot(units, values, label=f"{family}, {name}", linestyle=line, **style)
            of_slices = [row[int((len(row) - 1) * at)] for row in slices]
            every[1].plot(units, of_slices, linestyle=line, **style)
    every[0].axhline(100, color="#555555", linewidth=1)
    every[0].text(
        0.99,
        100,
        "limit of the median",
        transform=every[0].get_yaxis_transform(),
        ha="right",
        fontsize=8,
        va="bottom",
    )
    every[0].set_ylabel("query, store open (ms)")
    every[1].set_ylabel("units in the slice of a goal")
    for axes in every:
        axes.set(xscale="log", yscale="log", xlabel="functional units in the FOON")
    figure.legend(*every[0].get_legend_handles_labels(), loc="outside lower center", ncols=6, fontsize=9)
    _save(figure, path)


def _plot_slices(sizes: Sequence[Size], path: Path) -> None:
    figure, axes = plt.subplots(figsize=(7, 4.4), layout="constrained")
    for place, family in enumerate(_FAMILIES):
        points = [
            (each.slice, each.counted(size.queries.limit) * 1000)
            for size in sizes
            if size.family == family and size.queries
            for each in size.queries.asked
        ]
        if not points:
            continue
        xs, ys = zip(*points, strict=True)
        axes.scatter(xs, ys, s=14, alpha=0.6, color=_COLOURS[place], marker=_MARKS[place], label=family)
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="units in the slice of the goal",
        ylabel="query (ms), at most its limit",
    )
    axes.legend(fontsize=9)
    _save(figure, path)


# Peers.


def _given(peers: Peers) -> str:
    """Say what each method was given, where that differs."""
    return _GIVEN if any(each.method != base(each.method) for each in peers.methods) else ""


_GIVEN = (
    "`clingo` is foon_asp as it is, with its reductions, and `clingo-unreduced` is given the whole slice, as "
    "the peers are; a peer that is `-reduced` is given what the same reductions leave, whose time counts. "
)


def _peers(peers: Peers, plots: Path) -> Iterator[str]:
    yield from ("## Peers", "")
    yield (
        f"Exact methods on the same goals in one run: {peers.asked} goals of the universal FOON, "
        f"{peers.runs} runs, {peers.limit:g} s each. Times go from the loaded problem to the proven and "
        f"replayed tree; `× clingo` is a geometric mean. {_given(peers)}{peers.machine}. "
        f"Command: `{peers.command}`."
    )
    yield ""
    yield from _table(_METHODS, (_method_row(each) for each in peers.methods))
    yield "![Time by goal](plots/peers.png)"
    yield ""
    if peers.disagreements:
        yield from (f"- Disagreement: {each}" for each in peers.disagreements)
        yield ""
    if peers.greedy:
        yield "The heuristics of the paper, on the goals that can be made:"
        yield ""
        yield from _table(_GREEDY, (_greedy_row(each) for each in peers.greedy))
    if peers.everything:
        yield "Every object that can be made, proven by clingo in one process:"
        yield ""
        rows = (
            (
                each.way,
                f"{each.proven:,} of {each.asked:,}",
                seconds(each.seconds),
                seconds(each.whole),
                _memory(each.peak),
            )
            for each in peers.everything
        )
        yield from _table(("way", "proven", "time", "whole process", "peak"), rows)
    for note in peers.notes:
        yield f"- {note}"
    yield ""
    _plot_peers(peers, plots / "peers.png")


def _more_peers(peers: Peers) -> Iterator[str]:
    """Yield the same of all objects that can be made, or of some evenly spread among them."""
    every = "all" if peers.asked == peers.makeable else "every 30th of the"
    yield from (f"## Peers on {peers.asked:,} objects", "")
    yield (
        f"The same for {every} {peers.makeable:,} objects that the kitchen can make and does not have, "
        f"{peers.runs} run. {_given(peers)}{peers.machine}. Command: `{peers.command}`."
    )
    yield ""
    yield from _table(_METHODS, (_method_row(each) for each in peers.methods))
    if peers.greedy:
        yield from _table(_GREEDY, (_greedy_row(each) for each in peers.greedy))
    if peers.disagreements:
        yield from (f"- Disagreement: {each}" for each in peers.disagreements)
        yield ""


_METHODS = (
    "method",
    "proven",
    "agree",
    "median",
    "geometric mean",
    "max",
    "× clingo",
    "whole process",
    "peak",
)


_GREEDY = ("heuristic", "executable", "optimal", "too small", "mean excess", "largest", "median", "max")


def _method_row(each: Any) -> list[str]:
    whole = _NOTHING if each.whole is None else seconds(each.whole)
    return [
        each.method,
        f"{each.proven} of {each.asked}",
        str(each.agreeing),
        seconds(each.median),
        seconds(each.geometric_mean),
        seconds(each.maximum),
        _digits(each.ratio),
        whole,
        _memory(each.peak),
    ]


def _greedy_row(each: Any) -> list[str]:
    return [
        each.method,
        f"{each.executable} of {each.asked}",
        str(each.optimal),
        str(each.smaller),
        f"{each.mean_excess:.1%}",
        f"{each.largest_excess:.1%}",
        seconds(each.median),
        seconds(each.maximum),
    ]


def _plot_peers(peers: Peers, path: Path) -> None:
    figure, axes = plt.subplots(figsize=(8, 4.4), layout="constrained")
    ours = peers.methods[0].method
    rows = [row for row in peers.rows if row.optimum]
    rows.sort(key=lambda row: row.seconds.get(ours, math.inf))
    bases = list(dict.fromkeys(base(each.method) for each in peers.methods))
    for method in (each.method for each in peers.methods):
        place = bases.index(base(method))
        points = [
            (number, row.seconds[method] * 1000)
            for number, row in enumerate(rows, 1)
            if row.statuses.get(method) == "optimal"
        ]
        xs, ys = zip(*points, strict=True) if points else ((), ())
        style: dict[str, Any] = {"color": _COLOURS[place], "marker": _MARKS[place]}
        style |= {"markersize": 4, "linewidth": 1}
        axes.plot(xs, ys, "-" if method == base(method) else ":", label=method, **style)
    axes.set(yscale="log", xlabel=f"goals, by the time of {ours}", ylabel="time to the proven tree (ms)")
    axes.legend(fontsize=9)
    _save(figure, path)


# Whole commands.


def _commands(found: Commands) -> Iterator[str]:
    yield from ("## Whole commands", "")
    yield (
        "On the public universal FOON and the subgraphs; a process from its start to its exit, cold. "
        f"{found.machine}. Command: `{found.command}`."
    )
    yield ""
    yield from (*commands_table(found.rows), "")


# Many queries.


def _throughput(found: Throughput) -> Iterator[str]:
    yield from ("## Many queries", "")
    yield (
        "`foon-asp batch`, whole processes, one run each. The start, with opening the data in each process, "
        f"is taken off the rate. {found.machine}. Command: `{found.command}`."
    )
    yield ""
    rows = (
        (
            each.data,
            f"{each.units:,}",
            f"{each.queries:,}",
            each.jobs,
            seconds(each.start),
            seconds(each.seconds),
            f"{each.each_job:.1f}",
            _memory(each.peak),
        )
        for each in found.rates
    )
    head = ("FOON", "units", "queries", "processes", "start", "whole run", "queries/s and process", "peak")
    yield from _table(head, rows)


# Solver configurations.


def _configurations(found: Configurations) -> Iterator[str]:
    yield from ("## Solver configurations", "")
    yield (
        "Solving alone, from the grounded program to the proof, every configuration side by side in one run, "
        "each question once. What was not proven counts with the limit. **Bold**: what foon_asp uses; the "
        f"smallest of each column is marked with *. {found.machine}. Command: `{found.command}`."
    )
    yield ""
    for kind in dict.fromkeys(each.question for each in found.outcomes):
        mine = [each for each in found.outcomes if each.question == kind]
        yield f"`{kind}`: {mine[0].asked} questions, {found.limits[kind]:g} s each."
        yield ""
        best = [min(each.median for each in mine), min(each.geometric_mean for each in mine)]
        best += [min(each.maximum for each in mine), min(each.total for each in mine)]
        rows = []
        for each in mine:
            name = (
                f"**{each.configuration}**"
                if each.configuration == found.present[kind]
                else each.configuration
            )
            values = (each.median, each.geometric_mean, each.maximum, each.total)
            cells = [
                seconds(value) + "\\*" * (value == least) for value, least in zip(values, best, strict=True)
            ]
            rows.append((name, f"{each.proven}", *cells))
        yield from _table(("configuration", "proven", "median", "geometric mean", "max", "total"), rows)


if __name__ == "__main__":
    main()
