"""`foon-asp merge`: FOON files made into a universal FOON."""

from __future__ import annotations

import argparse
from pathlib import Path

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_foon
from foon_asp.cli.output import STDOUT, Reply
from foon_asp.cli.parser import Parser
from foon_asp.errors import QueryError
from foon_asp.io.text import write_text
from foon_asp.model.levels import at_level
from foon_asp.words import counted


def configure(parser: Parser) -> None:
    """Add the options."""
    add.reading(parser, level=True)
    parser.add_argument("files", nargs="+", metavar="FILE", help="FOON files of any format")
    add.output(parser)


def run(options: argparse.Namespace) -> Reply:
    """Merge."""
    if options.output.lower().endswith(".json"):
        raise QueryError("a merged FOON is text; convert it to JSON afterwards: foon-asp convert")
    files = open_foon(options, [Path(name) for name in options.files])
    foon = at_level(files.foon, options.level)
    place = "" if options.output == STDOUT else f"{options.output}: "
    summary = (
        f"{place}{counted(len(options.files), 'file')}, {files.units_read} units read,"
        f" {files.units_reported} left out, {foon.duplicates} duplicates removed:"
        f" {len(foon.units)} units, {len(foon.objects)} objects"
    )
    return Reply(lambda: write_text(foon, foon.units, dialect="A", provenance=True), summary=summary)
