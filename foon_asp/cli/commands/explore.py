"""`foon-asp explore`: a page in which a browser searches, plans and draws, offline."""

from __future__ import annotations

import argparse
import webbrowser
from pathlib import Path

from foon_asp.cli import options as add
from foon_asp.cli.inputs import open_world
from foon_asp.cli.output import STDOUT, Reply, check_targets, file_to_write, write
from foon_asp.cli.parser import Parser
from foon_asp.errors import QueryError
from foon_asp.query.goals import find_object
from foon_asp.render.explorer import explorer_page
from foon_asp.words import counted

_DEFAULT = "explorer.html"


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    add.named_goal(
        parser, "several leave only the units that can matter for any, where a FOON is too large for a page"
    )
    parser.add_argument("--open", action="store_true", help="open the page in the browser")
    add.files(parser, "PAGE", f"a file of HTML; - is standard output (default: {_DEFAULT})", default=_DEFAULT)


def run(options: argparse.Namespace) -> Reply:
    """Write the page."""
    if options.open and options.target == STDOUT:
        raise QueryError("--open opens a file; name one with -o, or leave -o out")
    if options.target != STDOUT:
        check_targets(options, file_to_write(options.target))
    world = open_world(options)
    goals = [find_object(world, text) for text in options.goal]
    page = explorer_page(world, title=_title(options), options=_data_options(options), goals=goals)
    write(options.target, [page.text])
    if options.open and not webbrowser.open(Path(options.target).resolve().as_uri()):
        raise QueryError(f"{options.target} is written, but no browser was found to open it")
    size = f"{len(page.text.encode()) / 1e6:.1f} MB"
    summary = f"{options.target}: {counted(page.units, 'unit')}, {size}"
    return Reply(summary=f"{summary}. {page.left_out}" if page.left_out else summary)


def _title(options: argparse.Namespace) -> str:
    """Return what the data are called in the page."""
    if options.foon:
        return " + ".join(Path(name).name for name in options.foon)
    return "built-in kitchen" if options.data is None else Path(options.data).resolve().name


def _data_options(options: argparse.Namespace) -> list[str]:
    """Return the options that name the data, for the command lines that the page shows."""
    named: list[str] = []
    for name in ("data", "kitchen", "rates", "utensils", "default_rate", "costs", "default_cost"):
        value = getattr(options, name)
        if value is not None:
            named += [f"--{name.replace('_', '-')}", f"{value}"]
    if options.foon:
        named += ["--foon", *options.foon]
    if options.strict:
        named.append("--strict")
    if options.match_relations != "strict":
        named += ["--match-relations", options.match_relations]
    if options.level != 3:
        named += ["--level", str(options.level)]
    return named
