"""Write benchmarks/RESULTS.md and its plots from what the other scripts have measured.

    python benchmarks/report.py [--results DIR] [--output FILE.md]

Reads peers.json, configurations.json, growth.json and throughput.json; what is not there is left out, and
said to be missing.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
from configurations import Configurations
from growth import Growth, Size, Spread, spread
from machine import RESULTS
from peer_results import MENU, Peers
from throughput import Throughput

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
    lines = [
        "# Results",
        "",
        "Written by `python benchmarks/report.py` from what the other scripts measured; "
        "[README.md](README.md) says how. Each table names its command, machine and number of runs.",
        "",
        *_what_must_hold(growth, peers),
        *(_growth(growth, plots) if growth else _missing("Growth", "growth.py")),
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
        return "not asked"
    for unit, factor in (("s", 1.0), ("ms", 1e3), ("µs", 1e6)):
        if value * factor >= 1 or unit == "µs":
            return f"{_digits(value * factor)} {unit}"
    raise AssertionError


def _digits(value: float) -> str:
    """Write a number with three digits, all of them before the point if need be."""
    if value <= 0:
        return "0"
    return f"{value:,.{max(0, 2 - math.floor(math.log10(value)))}f}"


# What must hold, of a FOON with a million units.


def _what_must_hold(growth: Growth | None, peers: Peers | None) -> Iterator[str]:
    yield from ("## What must hold", "")
    if growth is None and peers is None:
        yield from ("Not measured: run `python benchmarks/run.py`.", "")
        return
    if peers:
        yield f"On the universal FOON: {peers.machine}. Command: `{peers.command}`."
    if growth:
        yield f"At 10⁶ functional units: {growth.machine}. Command: `{growth.command}`."
    yield ""
    rows = [*(limits_of_peers(peers) if peers else ()), *(limits(growth) if growth else ())]
    yield from _table(("what", "limit", "measured", ""), map(_verdict, rows))
    notes = RESULTS.parent / "findings.md"
    yield from (notes.read_text(encoding="utf-8").splitlines() if notes.exists() else ())
    yield ""


def _verdict(row: Limit) -> tuple[str, str, str, str]:
    what, limit, measured, write_ = row
    if measured is None:
        return what, write_(limit), _NOTHING, ""
    # What is a factor must be reached, what is an effort must not be passed.
    met = measured >= limit if write_ is _at_least else measured <= limit
    least = "at least" if write_ is _at_least else "at most"
    return what, f"{least} {write_(limit)}", write_(measured), "met" if met else "**not met**"


def _at_least(value: float) -> str:
    return f"{value:.2f}×"


def limits_of_peers(peers: Peers) -> Iterator[Limit]:
    """Yield what must hold on the universal FOON."""
    took = {each.way: each.seconds for each in peers.everything}
    ways = [took[way] for way in ("plain", "suggest") if way in took]
    objects = max((each.asked for each in peers.everything), default=0)
    what = f"all {objects:,} objects, an optimum each, one process"
    yield what, 15.0, min(ways, default=None), seconds
    yield "one menu of all public goals that can be made", 1.0, took.get(MENU), seconds
    ours, *others = peers.methods
    for each in others:
        what = f"time of {each.method} in times of clingo's, geometric mean over the goals"
        yield what, 10.0, each.geometric_mean / ours.geometric_mean, _at_least


Limit = tuple[str, float, float | None, Callable[[float], str]]


def limits(growth: Growth) -> Iterator[Limit]:
    """Yield what must hold: what it is, the limit, what was measured if it was, and how to write both."""
    small, large = _find(growth, "random", 10_000), _find(growth, "random", 1_000_000)
    chain = _find(growth, "chain", 1_000_000)
    yield "parse the text, time", 60.0, _stage(large, "parse"), seconds
    yield "parse the text, peak memory", 6 * 1024.0, _stage(large, "parse", "peak"), _memory
    yield "open from the compiled store", 3.0, _stage(large, "open"), seconds
    yield "forward closure, `random`", 3.0, _stage(large, "closure"), seconds
    yield "forward closure, `chain`, 10⁵ deep", 3.0, _stage(chain, "closure"), seconds
    at_small, at_large = _median_query(small), _median_query(large)
    yield "one `optimal` query, store open, median of the goals, `random`", 0.1, at_large, seconds
    ratio = at_large / at_small if at_small and at_large else None
    yield "growth of that median from 10⁴ to 10⁶ units", 3.0, ratio, lambda value: f"{value:.2f}×"


def _memory(mebibytes: float) -> str:
    return f"{mebibytes / 1024:.2f} GiB" if mebibytes >= 1024 else f"{mebibytes:.0f} MiB"


def _find(growth: Growth, family: str, units: int) -> Size | None:
    return next((each for each in growth.sizes if (each.family, each.units) == (family, units)), None)


def _stage(size: Size | None, name: str, what: str = "seconds") -> float | None:
    found = (getattr(stage, what) for stage in size.stages if stage.name == name) if size else ()
    return next(iter(found), None)


def _median_query(size: Size | None) -> float | None:
    return _whole_query(size).median if size and size.queries.asked else None


# Growth.


def _growth(growth: Growth, plots: Path) -> Iterator[str]:
    yield from ("## Growth", "")
    yield (
        "`random`, `dense` and `chain` are generated ([generate.py](generate.py) says what of them is "
        "measured and what is extrapolated); `public` is the universal FOON. Time and peak memory of each "
        f"stage, in a process of its own. {growth.machine}. Command: `{growth.command}`."
    )
    yield ""
    head: Sequence[str] = (
        "family",
        "units",
        "lines",
        "runs",
        *_STAGES,
        "parse, peak",
        "query, peak",
        "store",
    )
    yield from _table(head, map(_stages_row, growth.sizes))
    yield "![Time of each stage by size](plots/growth.png)"
    yield ""
    yield (
        "One `optimal` query by units, store and domain open. The slice is what can matter for a goal. "
        "Goals whose slice is too large were not asked; in the last three columns they count as slower than "
        "any. Nor were any asked, in a shuffled order, once the time for all was over."
    )
    yield ""
    head = ("family", "units", "asked", "proven", "slice: median", "90%", "max", "slice", "facts", "ground")
    yield from _table(
        (*head, "solve", "decode", "query: median", "90%", "max"), map(_query_row, growth.sizes)
    )
    yield "![Time of a query by size](plots/queries.png)"
    yield ""
    yield "![Time of a query by the size of its slice](plots/slices.png)"
    yield ""
    _plot_stages(growth, plots / "growth.png")
    _plot_queries(growth, plots / "queries.png")
    _plot_slices(growth, plots / "slices.png")


def _stages_row(size: Size) -> list[str]:
    stages = {stage.name: stage for stage in size.stages}
    return [
        size.family,
        f"{size.units:,}",
        f"{size.lines:,}",
        str(size.stages[0].runs),
        *(seconds(stages[name].seconds) for name in _STAGES),
        _memory(stages["parse"].peak),
        _memory(size.queries.peak),
        f"{size.store_megabytes:,.1f} MB",
    ]


def _query_row(size: Size) -> list[str]:
    queries = size.queries
    slices = queries.all_slices
    cells = [size.family, f"{size.units:,}", f"{queries.asked} of {queries.goals}", str(queries.proven)]
    cells += [f"{slices[place]:,}" for place in (len(slices) // 2, (len(slices) * 9 - 1) // 10, -1)]
    if not queries.asked:
        return cells + [_NOTHING] + [""] * 7
    cells += [seconds(queries.steps[name].median) for name in ("slice", "facts", "ground", "solve", "decode")]
    whole = _whole_query(size)
    return [*cells, seconds(whole.median), seconds(whole.p90), seconds(whole.maximum)]


def _whole_query(size: Size) -> Spread:
    """Return the times over all goals; those that are too large to be asked count as slower than any."""
    return spread([*size.queries.retrieve, *[math.inf] * size.queries.too_large])


def _families(growth: Growth) -> Iterator[tuple[str, list[Size]]]:
    for family in dict.fromkeys(each.family for each in growth.sizes):
        if family != "public":
            yield family, sorted((s for s in growth.sizes if s.family == family), key=lambda s: s.units)


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
    families = list(_families(growth))
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


def _plot_queries(growth: Growth, path: Path) -> None:
    figure, every = plt.subplots(1, 2, figsize=(11, 4.4), layout="constrained")
    for family, sizes in _families(growth):
        place = _FAMILIES.index(family)
        style = {"color": _COLOURS[place], "marker": _MARKS[place], "markersize": 5}
        whole = {size.units: _whole_query(size) for size in sizes if size.queries.asked}
        for name, of, line in (("median", "median", "-"), ("90%", "p90", "--")):
            values = {units: getattr(each, of) * 1000 for units, each in whole.items()}
            finite = {units: value for units, value in values.items() if value < math.inf}
            every[0].plot(
                list(finite), list(finite.values()), label=f"{family}, {name}", linestyle=line, **style
            )
        slices = [size.queries.all_slices for size in sizes]
        units = [size.units for size in sizes]
        every[1].plot(units, [row[len(row) // 2] for row in slices], label=f"{family}, median", **style)
        every[1].plot(
            units,
            [row[(len(row) * 9 - 1) // 10] for row in slices],
            label=f"{family}, 90%",
            linestyle="--",
            **style,
        )
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


def _plot_slices(growth: Growth, path: Path) -> None:
    figure, axes = plt.subplots(figsize=(7, 4.4), layout="constrained")
    for place, family in enumerate(_FAMILIES):
        points = [
            (units, took * 1000)
            for size in growth.sizes
            if size.family == family
            for units, took in zip(size.queries.slices, size.queries.retrieve, strict=True)
        ]
        if not points:
            continue
        xs, ys = zip(*points, strict=True)
        axes.scatter(xs, ys, s=14, alpha=0.6, color=_COLOURS[place], marker=_MARKS[place], label=family)
    axes.set(xscale="log", yscale="log", xlabel="units in the slice of the goal", ylabel="query (ms)")
    axes.legend(fontsize=9)
    _save(figure, path)


# Peers.


def _peers(peers: Peers, plots: Path) -> Iterator[str]:
    yield from ("## Peers", "")
    yield (
        f"Exact methods on the same goals in one run: {peers.asked} goals of the universal FOON, "
        f"{peers.runs} runs, {peers.limit:g} s each. Times go from the loaded problem to the proven and "
        f"replayed tree; `× clingo` is a geometric mean. {peers.machine}. Command: `{peers.command}`."
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
        f"{peers.runs} run. {peers.machine}. Command: `{peers.command}`."
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
    for place, method in enumerate(each.method for each in peers.methods):
        points = [
            (number, row.seconds[method] * 1000)
            for number, row in enumerate(rows, 1)
            if row.statuses.get(method) == "optimal"
        ]
        xs, ys = zip(*points, strict=True) if points else ((), ())
        axes.plot(
            xs, ys, "-", color=_COLOURS[place], marker=_MARKS[place], markersize=4, linewidth=1, label=method
        )
    axes.set(yscale="log", xlabel=f"goals, by the time of {ours}", ylabel="time to the proven tree (ms)")
    axes.legend(fontsize=9)
    _save(figure, path)


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
