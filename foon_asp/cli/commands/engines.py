"""`foon-asp engines`: which planning engines there are."""

from __future__ import annotations

import argparse

from foon_asp.cli import options as add
from foon_asp.cli.output import Reply
from foon_asp.cli.parser import Parser
from foon_asp.planning.engines import ENGINES
from foon_asp.planning.wire import engines_json
from foon_asp.render.engines import engines_text


def configure(parser: Parser) -> None:
    """Add the options."""
    add.output(parser, "text", "json")


def run(options: argparse.Namespace) -> Reply:  # noqa: ARG001 - every command is given its options
    """List planning engines."""
    return Reply(lambda: engines_text(ENGINES), lambda: engines_json(ENGINES))
