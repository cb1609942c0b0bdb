"""What the options name to be read: data, a kitchen, goals; and warnings of what cannot be meant."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Sequence
from pathlib import Path

from foon_asp.cli.messages import note, shown, warn
from foon_asp.cli.unknown_words import warn_of_unknown_words
from foon_asp.errors import QueryError
from foon_asp.io.findings import CUT_OFF, OF_WHOLE_FILES, Finding, Severity
from foon_asp.io.folder import Dataset, Sources, foon_files, read_foon
from foon_asp.io.listed import read_listed
from foon_asp.io.open import FoonFiles
from foon_asp.io.trees import STDIN, TreeBuilder, Trees, trees_beside
from foon_asp.io.unknown_words import labels_alone, nearest
from foon_asp.model.foon import Foon
from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.query.goals import Named, find_object
from foon_asp.query.substitution import SOURCES
from foon_asp.resources import diets
from foon_asp.values import said
from foon_asp.words import counted, cut

_FILES = (
    *(
        "foon",
        "files",
        "kitchen",
        "rates",
        "costs",
        "utensils",
        "goals",
        "only_motions",
        "constraint",
        "objective",
    ),
    *("file", "plan", "names", "queries", "trees", "states", "locations", "motions"),
    *("resources", "durations"),
)
"""The options that name files to read."""


def paths_to_read(options: argparse.Namespace) -> list[Path]:
    """Return all that the options name to be read: files, stores, and what is read of a data folder."""
    found: list[Path] = []
    for name in _FILES:
        value = getattr(options, name, None)
        found += (
            Path(each) for each in ([value] if isinstance(value, str) else value or ()) if each != STDIN
        )
    found += (Path(name) for name in getattr(options, "diets", ()) if name not in diets())
    alike = (name for each in ("substitute", "similar") for name in getattr(options, each, ()))
    found += (Path(name) for name in alike if name not in SOURCES)
    if hasattr(options, "foon"):
        found += sources(options).paths
    elif getattr(options, "data", None) is not None:
        found += foon_files(Path(options.data))
    return found


def sources(options: argparse.Namespace) -> Sources:
    """Return the files that the options name; what lies beside the first file of a command belongs to it."""
    files: Sequence[str] = getattr(options, "files", ())
    return Sources.of(
        str(Path(files[0]).parent) if files and options.data is None else options.data,
        foon=files or options.foon,
        kitchen=options.kitchen,
        rates=options.rates,
        costs=options.costs,
        utensils=options.utensils,
        default_rate=options.default_rate,
        default_cost=options.default_cost,
        strict_format=options.strict_format,
        strict=options.strict,
        match_relations=options.match_relations,
        level=options.level,
        vocabulary=options.vocabulary,
    )


def open_foon(options: argparse.Namespace, paths: Sequence[Path], *, repeats: bool = False) -> FoonFiles:
    """Read FOON files as the options say, and warn of what of them is lost.

    With `repeats` a unit is kept as often as it stands there.
    """
    files = read_foon(paths, options.strict_format, options.vocabulary, repeats=repeats)
    warn_of_findings(options, files.findings)
    return files


def open_trees(options: argparse.Namespace, known: Foon) -> Trees:
    """Read the files of trees beside a FOON that is known, and warn of what of them is lost."""
    files = [TreeBuilder(options.vocabulary).read_file(Path(name)) for name in options.trees]
    warn_of_findings(options, [finding for file in files for finding in file.findings])
    return trees_beside(known, files)


def open_world(options: argparse.Namespace) -> World:
    """Open the data as a world, and warn of what cannot be meant."""
    return open_data(options)[1]


def load_data(options: argparse.Namespace) -> Dataset:
    """Read the data, and warn of what of them is lost."""
    dataset = sources(options).load()
    warn_of_findings(options, dataset.findings, dataset.sources.beside.values())
    return dataset


def open_data(options: argparse.Namespace) -> tuple[Dataset, World]:
    """Open the data and the world that they are, and warn of what cannot be meant."""
    dataset = load_data(options)
    world = dataset.world()
    count = shown(options, len(world.strangers))
    for node in world.strangers[:count]:
        warn(options, f"the kitchen has {node}, which the FOON does not know{nearest(world, node)}")
    if len(world.strangers) > count:
        warn(options, f"and {len(world.strangers) - count} more objects that the FOON does not know")
    warn_of_unknown_words(options, dataset, world.full)
    tell_labels(options, dataset, world.full)
    if not dataset.kitchen.stated:
        note_kitchen(options, world.full)
    elif not world.kitchen.objects:
        warn(options, "the kitchen is empty, nothing is at hand; name one with --kitchen")
    _check_quotes(world, getattr(options, "goal", None))
    return dataset, world


def note_kitchen(options: argparse.Namespace, world: World | None = None) -> None:
    """Say what is at hand where no kitchen is named, and how much, if that is known."""
    objects = "" if world is None else f", {counted(len(world.kitchen.objects), 'object')}"
    note(options, f"no kitchen is named: at hand is what no unit makes{objects}; name one with --kitchen")


def _check_quotes(world: World, goals: object) -> None:
    """Raise `QueryError` if several goals are the words of one."""
    if not isinstance(goals, list) or len(goals) < 2:
        return
    unknown = next((goal for goal in goals if not _is_known(world, goal)), None)
    whole = " ".join(goals)
    if unknown is not None and _is_known(world, whole):
        raise QueryError(
            f"{said(unknown)} is no goal; put a goal of several words into quotes: {cut(repr(whole))}"
        )


def _is_known(world: World, goal: str) -> bool:
    try:
        find_object(world, goal)
    except QueryError:
        return False
    return True


def tell_labels(options: argparse.Namespace, dataset: Dataset, world: World) -> None:
    """Say which objects are at hand by their label alone; warn where that may be meant otherwise."""
    found = list(labels_alone(dataset, world))
    for finding in found[: shown(options, len(found))]:
        tell_it = warn if finding.severity is Severity.WARNING else note
        tell_it(options, f"{finding.file}: {finding.message}")
    if len(found) > shown(options, len(found)):
        note(options, f"and {len(found) - shown(options, len(found))} more labels; --verbose shows all")


def warn_of_findings(
    options: argparse.Namespace, findings: Iterable[Finding], beside: Iterable[str] = ()
) -> None:
    """Warn of whatever in a file could not be read, and of what stands around it.

    Of the files `beside` a FOON all is told that is odd. Where a file is cut off, the exit status says so.
    """
    odd: dict[str, list[Finding]] = {}
    beside = frozenset(beside)
    for finding in findings:
        if finding.code == CUT_OFF:
            options.cut_off = True
        if finding.severity is Severity.ERROR or finding.code in OF_WHOLE_FILES:
            warn(options, f"{finding.file}:{finding.line}: {finding.message}")
        elif finding.file in beside:
            odd.setdefault(finding.file, []).append(finding)
    for file, found in odd.items():
        count = shown(options, len(found))
        for finding in found[:count]:
            warn(options, f"{file}:{finding.line}: {finding.message}")
        if len(found) > count:
            warn(options, f"{file}: and {len(found) - count} more that are odd")


def named_goals(options: argparse.Namespace) -> list[Named]:
    """Return the goals that were named one by one and in a file."""
    one_by_one = [options.goal] if isinstance(options.goal, str) else options.goal or []
    return [*one_by_one, *listed_goals(options)]


def listed_goals(options: argparse.Namespace) -> list[Named]:
    """Return the goals of the file of goals; none without one."""
    if getattr(options, "goals", None) is None:
        return []
    file = read_listed(Path(options.goals), options.vocabulary)
    warn_of_findings(options, file.findings, [options.goals])
    if not file.objects:
        raise QueryError(f"{options.goals}: the list of goals is empty")
    return [each.named for each in file.objects]


def find_goals(options: argparse.Namespace, world: World) -> list[ObjectNode]:
    """Return the goals that were named, as nodes of a world."""
    return [find_object(world, goal) for goal in named_goals(options)]
