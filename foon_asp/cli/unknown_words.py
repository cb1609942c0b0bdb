"""Warnings of words that the FOON does not know, in files that the command line names; `audit` tells all."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

from foon_asp.cli.messages import shown, warn
from foon_asp.io.folder import Dataset
from foon_asp.io.kitchen import read_labels
from foon_asp.io.unknown_words import Words, known_labels, motions, utensils
from foon_asp.model.world import World
from foon_asp.resources import diets
from foon_asp.words import shortened


def warn_of_unknown_words(options: argparse.Namespace, dataset: Dataset, world: World) -> None:
    """Warn of motions and labels that the FOON does not know, a line for each file that has some."""
    for words in _named(options, dataset, world):
        if misspelt := [f"{word} (closest: {near})" for word, near in words.misspelt()]:
            few = shortened(misspelt, shown(options, len(misspelt)))
            warn(options, f"{words.name}: {words.what} that the FOON does not know: {few}")


def _named(options: argparse.Namespace, dataset: Dataset, world: World) -> Iterator[Words]:
    """Yield the words of the files that are named; labels of the FOON are only looked up for some."""
    if options.rates:
        yield motions(dataset, world, "rates")
    if options.costs:
        yield motions(dataset, world, "costs")
    for only in getattr(options, "only_motions", None) or ():
        yield Words(only, "motions", read_labels(Path(only)), world.foon.motions)
    if options.utensils:
        yield utensils(dataset, world)
    listed = {name for name in getattr(options, "diets", ()) if name not in diets() and Path(name).exists()}
    for name in sorted(listed):
        yield Words(name, "labels", read_labels(Path(name)), known_labels(world))
