"""`foon-asp pddl`: two commands of its own."""

from __future__ import annotations

from foon_asp.cli.commands import PDDL_COMMANDS
from foon_asp.cli.parser import Parser


def configure(parser: Parser) -> None:
    """Add the commands."""
    parser.add_commands(PDDL_COMMANDS, "action")
