"""`foon-asp convert`: FOON files in another format."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_foon
from foon_asp.cli.messages import note, warn
from foon_asp.cli.output import STDOUT, Reply, check_targets, write
from foon_asp.cli.parser import Parser
from foon_asp.errors import QueryError
from foon_asp.io.files import is_folder
from foon_asp.io.formats import FORMATS, check_suffix, choose_format
from foon_asp.words import counted


def configure(parser: Parser) -> None:
    """Add the options."""
    add.reading(parser)
    parser.add_argument(
        "files", nargs="+", metavar="IN", help="FOON files; several are merged, one keeps what it repeats"
    )
    parser.add_argument(
        "--to", choices=list(FORMATS), help="format (default: the fuller one with the suffix of OUT)"
    )
    add.files(parser, "OUT", "a file, or a folder for one each; - is standard output")


def run(options: argparse.Namespace) -> Reply:
    """Convert."""
    sources = [Path(name) for name in options.files]
    out = Path(options.target)
    if is_folder(out) or options.target.endswith("/"):
        if options.to is None:
            raise QueryError("name the format with --to where the output is a folder")
        targets = [out / (source.stem + FORMATS[options.to].suffix) for source in sources]
        check_targets(options, *targets)
        for source, target in zip(sources, targets, strict=True):
            _convert(options, [source], str(target))
    else:
        if options.target != STDOUT:
            check_targets(options, out)
            if options.to is not None:
                check_suffix(out, options.to)
        _convert(options, sources, options.target)
    return Reply()


def _convert(options: argparse.Namespace, sources: Sequence[Path], target: str) -> None:
    """Write some files as one, and say what is lost of them.

    One file keeps its order and what it repeats, for it may be a task tree; several are merged.
    """
    files = open_foon(options, sources, repeats=len(sources) == 1)
    form = choose_format(files.foon, Path(target), options.to)
    write(target, [form.write(files.foon)])
    poorer = sum(form.loses(unit) for unit in files.foon.units)
    if poorer:
        what = "goal marks" if form.name == "api-json" else "flags, marks, times, agents and rates"
        lost = counted(poorer, "unit")
        warn(options, f"{target}: the format {form.name!r} has no {what}; lost of {lost}")
    again = f", {counted(files.foon.duplicates, 'duplicate')} removed" if files.foon.duplicates else ""
    note(options, f"{target}: {counted(len(files.foon.units), 'unit')} ({form.name}){again}")
