"""What each command of the command line does: open the data, ask, write the answer, say how it ended.

Modules that only one command needs are imported there: a first answer should not wait for them.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from foon_asp.constraints import Constraints
from foon_asp.convert import FORMATS, choose_format
from foon_asp.dataset import Dataset, foon_files, load, read_foon
from foon_asp.errors import InputError, QueryError, closest, counted
from foon_asp.files import read_objects, read_utensils, write_atomically
from foon_asp.findings import Finding, Severity
from foon_asp.goals import find_goal
from foon_asp.graph import ObjectNode
from foon_asp.levels import FULL
from foon_asp.problem import Domain, Problem
from foon_asp.render.json import dumps
from foon_asp.resources import built_in_data, diets

if TYPE_CHECKING:
    from foon_asp.retrieve import Retrieval

FOUND, UNREACHABLE, BAD_INPUT, LIMIT = 0, 1, 2, 3
"""Exit statuses; an audit that is told to fail uses 1, too."""

_SHOWN = 3
"""How many warnings of one kind are written out."""


def warn(message: str) -> None:
    """Write a warning to standard error."""
    sys.stderr.write(f"foon-asp: warning: {message}\n")


def _load(options: argparse.Namespace) -> Dataset:
    """Load what the options name."""
    return load(
        options.data,
        foon=options.foon,
        kitchen=options.kitchen,
        rates=options.rates,
        utensils=options.utensils,
        default_rate=options.default_rate,
        strict_format=options.strict_format,
    )


def _open(options: argparse.Namespace) -> tuple[Dataset, Domain]:
    """Load the data as a domain, and warn of what cannot be meant."""
    dataset = _load(options)
    _warn_of_losses(dataset.findings)
    domain = dataset.domain(strict=options.strict, level=options.level)
    for node in domain.strangers[:_SHOWN]:
        warn(f"the kitchen has {node}, which the FOON does not know{_nearest(domain, node)}")
    if len(domain.strangers) > _SHOWN:
        warn(f"and {len(domain.strangers) - _SHOWN} more objects that the FOON does not know")
    if not dataset.kitchen.objects:
        warn("the kitchen is empty, nothing is at hand; name one with --kitchen")
    return dataset, domain


def _warn_of_losses(findings: Sequence[Finding]) -> None:
    for finding in findings:
        if finding.severity is Severity.ERROR:
            warn(f"{finding.file}:{finding.line}: {finding.message}")


def _nearest(domain: Domain, node: ObjectNode) -> str:
    """Return the closest node, looking for the label first: that is quick and what people mistype."""
    same_label = [str(other) for other in domain.foon.objects if other.label == node.label]
    if same_label:
        return closest(str(node), same_label, 1) or f"; there is {same_label[0]}"
    return closest(node.label, domain.foon.labels, 1)


def _find_goals(
    options: argparse.Namespace, dataset: Dataset, domain: Domain, named: Sequence[str]
) -> list[ObjectNode]:
    """Return the goals that were named one by one and in a file, seen on the level of the domain."""
    goals = [_find_goal(options, dataset, domain, text) for text in named]
    if options.goals is not None:
        listed = read_objects(Path(options.goals))
        if not listed:
            raise QueryError(f"{options.goals}: the list of goals is empty")
        for node in listed:
            domain.id_of(node)
        goals += [domain.project(node) for node in listed]
    return goals


def _find_goal(options: argparse.Namespace, dataset: Dataset, domain: Domain, text: str) -> ObjectNode:
    """Return the goal that a text names on the level of the domain, or else on the full level."""
    try:
        return find_goal(domain, text, [domain.project(goal) for goal in dataset.goals])
    except QueryError:
        if domain.level == FULL:
            raise
        return domain.project(find_goal(dataset.domain(strict=options.strict), text, dataset.goals))


def _constraints(options: argparse.Namespace) -> Constraints:
    """Return the constraints that the flags name."""
    return Constraints(
        without=tuple(label.strip().lower() for label in options.without),
        without_tools=tuple(label.strip().lower() for label in options.without_tool),
        avoid_motions=tuple(motion.strip().lower() for motion in options.avoid_motion),
        only_motions=None if options.only_motions is None else _labels(Path(options.only_motions)),
        use_units=tuple(options.use_unit),
        max_units=options.max_units,
        max_depth=options.max_depth,
        min_success=options.min_success,
        diets=tuple(_diet(name) for name in options.diet),
        rules=_rules(options),
    )


def _labels(path: Path) -> tuple[str, ...]:
    return tuple(sorted(read_utensils(path)))


def _diet(name: str) -> tuple[str, tuple[str, ...]]:
    """Return a diet that comes with the program, or that a file lists."""
    known = diets()
    if name in known:
        return name, _labels(known[name])
    path = Path(name)
    if not path.exists():
        raise QueryError(f"no diet {name!r}; there are {', '.join(known)}, or name a file of labels")
    return path.stem, _labels(path)


def _rules(options: argparse.Namespace) -> tuple[str, ...]:
    if not (options.constraint or options.objective):
        return ()
    from foon_asp.rules import read_rules

    paths = [*options.constraint, *options.objective]
    return tuple(read_rules(Path(path), allow_script=options.allow_script) for path in paths)


def run_retrieve(options: argparse.Namespace) -> int:
    """Retrieve task trees."""
    from foon_asp.render.json import retrieval_value
    from foon_asp.render.text import retrieval_text
    from foon_asp.retrieve import check_method, retrieve

    if (options.goal is None) == (options.goals is None):
        raise QueryError("name one GOAL, or a file of them with --goals")
    check_method(options.method, options.by, not options.reference)
    constraints = _constraints(options)
    dataset, domain = _open(options)
    goals = _find_goals(options, dataset, domain, [] if options.goal is None else [options.goal])
    results = []
    for place, goal in enumerate(goals):
        result = retrieve(
            domain,
            goal,
            options.method,
            options.by,
            founded=not options.reference,
            time_limit=options.time_limit,
            constraints=constraints,
        )
        results.append(result)
        if options.format == "text":
            sys.stdout.write(("\n" if place else "") + retrieval_text(result))
        elif options.format == "foon":
            _write_tree(result)
    if options.format == "json":
        values = [retrieval_value(result) for result in results]
        sys.stdout.write(dumps(values[0] if options.goals is None else values))
    statuses = {result.status for result in results}
    if "limit" in statuses:
        return LIMIT
    return UNREACHABLE if "unreachable" in statuses else FOUND


def _write_tree(result: Retrieval) -> None:
    from foon_asp.text import write_text

    if result.tree is None:
        reason = f"no task tree: {result.reason}" if result.reason else "no task tree in time"
        sys.stderr.write(f"foon-asp: {result.goal}: {reason}\n")
        return
    comments = [f"Goal:\t{result.goal}", f"Method:\t{result.method} {','.join(result.by)}".rstrip()]
    if not result.tree.executable:
        comments.append("NOT EXECUTABLE")
    sys.stdout.write(write_text(result.tree.domain.foon, result.tree.steps, comments))


def run_reach(options: argparse.Namespace) -> int:
    """Say what the kitchen can make."""
    from foon_asp.render.json import reach_value
    from foon_asp.render.text import reach_text
    from foon_asp.retrieve import reach

    _, domain = _open(options)
    available, executable = reach(domain)
    if options.format == "json":
        sys.stdout.write(dumps(reach_value(domain, available, executable)))
    else:
        sys.stdout.write(reach_text(domain, available, executable, listing=options.list))
    return FOUND


def run_compare(options: argparse.Namespace) -> int:
    """Compare all methods."""
    from foon_asp.compare import compare
    from foon_asp.render.json import comparison_value
    from foon_asp.render.text import comparison_text

    dataset, domain = _open(options)
    goals = _find_goals(options, dataset, domain, options.goal)
    goals = goals or list(dict.fromkeys(map(domain.project, dataset.goals)))
    if not goals:
        raise QueryError("no goals: name some, or a file of them with --goals")
    rows = compare(domain, goals, time_limit=options.time_limit)
    if options.format == "json":
        sys.stdout.write(dumps(comparison_value(rows)))
    else:
        sys.stdout.write(comparison_text(rows))
    return LIMIT if any(row.cells["optimal"].proven is False for row in rows) else FOUND


def run_facts(options: argparse.Namespace) -> int:
    """Print the facts that clingo is given."""
    from foon_asp.facts import facts

    dataset, domain = _open(options)
    named = [_find_goal(options, dataset, domain, text) for text in options.goal]
    goals = tuple(domain.id_of(goal) for goal in named)
    whole = options.whole or not goals
    sys.stdout.write(facts(Problem(domain, goals, founded=not options.reference, whole=whole)))
    return FOUND


def run_goals(options: argparse.Namespace) -> int:
    """List the goals of the data folder."""
    from foon_asp.state_syntax import object_to_json

    dataset, domain = _open(options)
    goals = list(dict.fromkeys(map(domain.project, dataset.goals)))
    if options.format == "json":
        sys.stdout.write(dumps([object_to_json(goal) for goal in goals]))
        return FOUND
    for goal in goals:
        reachable = domain.foon.id_of(goal) in domain.closure.available
        sys.stdout.write(f"{goal}{'' if reachable else '  (this kitchen cannot make it)'}\n")
    return FOUND


def run_audit(options: argparse.Namespace) -> int:
    """Find what is wrong in FOON files."""
    from foon_asp.audit import audit
    from foon_asp.render.audit import audit_text, audit_value
    from foon_asp.render.sarif import sarif_value

    if (options.fix or options.fix_dir) and not options.files:
        raise QueryError("name the files to repair: foon-asp audit --fix FILE…")
    if options.files:
        # What lies beside the first file belongs to it.
        options.data = options.data or str(Path(options.files[0]).parent)
        options.foon = options.files
    dataset = _load(options)
    if options.goals is not None:
        dataset = replace(dataset, goals=tuple(read_objects(Path(options.goals))))
    for goal in dataset.goals:
        if dataset.foon.id_of(goal) is None:
            warn(f"the goal {goal} is no object of this FOON")
    report = audit(dataset.foon, dataset.kitchen, dataset.goals, dataset.findings)
    if options.format == "json":
        sys.stdout.write(dumps(audit_value(report)))
    elif options.format == "sarif":
        sys.stdout.write(dumps(sarif_value(report.findings, version("foon-asp"))))
    else:
        sys.stdout.write(audit_text(report, Severity[options.severity.upper()]))
    if options.fix or options.fix_dir:
        _fix_all([Path(name) for name in options.files], options.fix_dir)
    worst = max((finding.severity for finding in report.findings), default=None)
    if options.fail_on and worst is not None and worst >= Severity[options.fail_on.upper()]:
        return UNREACHABLE
    return FOUND


def _fix_all(paths: Sequence[Path], folder: str | None) -> None:
    """Write a repaired copy of each file, beside it or in a folder."""
    if folder is None:
        targets = [path.with_name(f"{path.stem}.fixed{path.suffix}") for path in paths]
    else:
        targets = [Path(folder) / path.name for path in paths]
    _refuse_overwriting(targets, paths)
    for path, target in zip(paths, targets, strict=True):
        _fix(path, target)


def _fix(path: Path, target: Path) -> None:
    """Write a copy of a text file with the certain mends, and list them on standard error."""
    from foon_asp.files import read_bytes
    from foon_asp.mend import mend_text
    from foon_asp.open_foon import FoonReader, decode, is_json

    data = read_bytes(path)
    text, encoding = decode(data, str(path))
    if is_json(text):
        warn(f"{path}: only text files can be repaired")
        return
    reader = FoonReader()
    reader.read_data(data, path)
    mended, mends = mend_text(text, reader.finish().findings)
    rows = [f"{finding.file}:{finding.line}: {finding.code}: {finding.mend}" for finding in mends]
    rows += [f"{finding.file}:{finding.line}: {finding.code}: saved as UTF-8" for finding in encoding]
    rows = list(dict.fromkeys(rows))
    if not rows:
        sys.stderr.write(f"foon-asp: {path}: nothing to mend\n")
        return
    write_atomically(target, mended)
    sys.stderr.write("".join(f"{row}\n" for row in rows))
    sys.stderr.write(f"foon-asp: {target}: {counted(len(rows), 'mend')}\n")


def _refuse_overwriting(targets: Sequence[Path], sources: Sequence[Path]) -> None:
    """Raise `InputError` if writing the targets would replace a source, or one target another."""
    inputs = {source.resolve() for source in sources}
    seen: set[Path] = set()
    for target in targets:
        place = target.resolve()
        if place in inputs:
            raise InputError(target, None, "this would replace an input", "name another output")
        if place in seen:
            raise InputError(target, None, "two inputs would be written here", "convert them one by one")
        seen.add(place)


def run_stats(options: argparse.Namespace) -> int:
    """Count what is in a FOON."""
    from foon_asp.levels import at_level
    from foon_asp.render.stats import statistics_text, statistics_value
    from foon_asp.stats import centralities, statistics

    folder = built_in_data() if options.data is None else Path(options.data)
    paths = [Path(name) for name in options.files] or foon_files(folder)
    files = read_foon(paths or [folder], strict=options.strict_format)
    counts = statistics(files.foon, files.units_read, files.findings, options.level)
    central = centralities(at_level(files.foon, options.level)) if options.centrality else None
    if options.format == "json":
        sys.stdout.write(dumps(statistics_value(counts, central)))
    else:
        sys.stdout.write(statistics_text(counts, central))
    return FOUND


def run_convert(options: argparse.Namespace) -> int:
    """Write FOON files in another format."""
    sources = [Path(name) for name in options.files]
    out = Path(options.output)
    if os.path.isdir(out) or options.output.endswith("/"):  # noqa: PTH112 - Path.is_dir raises on long names
        if options.to is None:
            raise QueryError("name the format with --to where the output is a folder")
        targets = [out / (source.stem + FORMATS[options.to].suffix) for source in sources]
        _refuse_overwriting(targets, sources)
        for source, target in zip(sources, targets, strict=True):
            _convert([source], target, options)
    else:
        _refuse_overwriting([out], sources)
        _convert(sources, out, options)
    return FOUND


def _convert(sources: Sequence[Path], target: Path, options: argparse.Namespace) -> None:
    """Write some files as one, and say what the format cannot say of them."""
    files = read_foon(sources, strict=options.strict_format)
    _warn_of_losses(files.findings)
    form = choose_format(files.foon, target, options.to)
    write_atomically(target, form.write(files.foon))
    poorer = sum(form.loses(unit) for unit in files.foon.units)
    if poorer:
        what = "goal marks" if form.name == "api-json" else "flags, marks, times, agents and rates"
        warn(f"{target}: the format {form.name!r} has no {what}; lost of {counted(poorer, 'unit')}")
    sys.stderr.write(f"foon-asp: {target}: {counted(len(files.foon.units), 'unit')} ({form.name})\n")


def run_merge(options: argparse.Namespace) -> int:
    """Merge FOON files into a universal FOON."""
    from foon_asp.levels import at_level
    from foon_asp.text import write_text

    sources = [Path(name) for name in options.files]
    if options.output is not None:
        if options.output.lower().endswith(".json"):
            raise QueryError("a merged FOON is text; convert it to JSON afterwards: foon-asp convert")
        _refuse_overwriting([Path(options.output)], sources)
    files = read_foon(sources, strict=options.strict_format)
    _warn_of_losses(files.findings)
    foon = at_level(files.foon, options.level)
    text = write_text(foon, foon.units, dialect="A", provenance=True)
    summary = (
        f"{counted(len(sources), 'file')}, {files.units_read} units read, {files.units_reported} left out,"
        f" {foon.duplicates} duplicates removed: {len(foon.units)} units, {len(foon.objects)} objects\n"
    )
    if options.output is None:
        sys.stdout.write(text)
        sys.stderr.write(f"foon-asp: {summary}")
    else:
        write_atomically(Path(options.output), text)
        sys.stdout.write(f"{options.output}: {summary}")
    return FOUND
