"""`foon-asp stats`: what is in a FOON, counted."""

from __future__ import annotations

import argparse
from pathlib import Path

from foon_asp.audit.stats import centralities, statistics
from foon_asp.audit.wire import statistics_json
from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_foon
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.io.folder import foon_files
from foon_asp.model.levels import at_level
from foon_asp.render.stats import statistics_text
from foon_asp.resources import built_in_data


def configure(parser: Parser) -> None:
    """Add the options."""
    add.reading(parser, level=True)
    parser.add_argument("files", nargs="*", metavar="FILE", help="FOON files (default: the built-in FOON)")
    add.data_folder(parser)
    parser.add_argument(
        "--centrality", action="store_true", help="add centralities in the one-mode projection"
    )
    add.output(parser, "text", "json")


def run(options: argparse.Namespace) -> Reply:
    """Count."""
    folder = built_in_data() if options.data is None else Path(options.data)
    paths = [Path(name) for name in options.files] or foon_files(folder)
    files = open_foon(options, paths or [folder])
    counts = statistics(files.foon, files.units_read, files.findings, options.level)
    central = centralities(at_level(files.foon, options.level)) if options.centrality else None
    return Reply(lambda: statistics_text(counts, central), lambda: statistics_json(counts, central))
