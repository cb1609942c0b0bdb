"""`foon-asp compile`: a store that opens quickly."""

from __future__ import annotations

import argparse
from pathlib import Path

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_foon
from foon_asp.cli.output import Reply, check_targets, folder_to_write
from foon_asp.cli.parser import Parser
from foon_asp.io.store import check_target, write_store
from foon_asp.words import counted


def configure(parser: Parser) -> None:
    """Add the options."""
    add.reading(parser)
    parser.add_argument(
        "files", nargs="+", metavar="FILE", help="FOON files of any format; several are merged"
    )
    add.files(parser, "KB.foon", "the folder of the store")


def run(options: argparse.Namespace) -> Reply:
    """Compile."""
    sources = [Path(name) for name in options.files]
    target = folder_to_write(options)
    check_target(target, sources)
    check_targets(options, target)
    files = open_foon(options, sources)
    manifest = write_store(files, target, sources)
    size = sum(table["bytes"] for table in manifest["tables"].values())
    units, objects = counted(len(files.foon.units), "unit"), counted(len(files.foon.objects), "object")
    return Reply(summary=f"{target}: {units}, {objects}, {size / 1e6:.1f} MB")
