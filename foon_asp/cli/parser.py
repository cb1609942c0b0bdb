"""A parser whose errors are one line, and whose commands are imported when they run."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any, NoReturn

from foon_asp.cli import output
from foon_asp.resources import program_version
from foon_asp.values import said
from foon_asp.words import cut, did_you_mean

if TYPE_CHECKING:
    from _typeshed import SupportsWrite

BAD_USAGE = 2
"""The exit status of bad input and bad usage."""

_LONGEST = 400
"""How many characters of a message are shown."""


@dataclass(frozen=True, slots=True)
class Command:
    """Where a command is, and what it does in one line; `description` where its own help says more.

    The module has `configure(parser)`, and `run(options)`, which returns a `Reply`; without `run` it has
    commands of its own.
    """

    module: str
    summary: str
    description: str = ""


class Parser(argparse.ArgumentParser):
    """A parser with errors of one line. That of a command asks its module for options when it is used.

    Options are written in full, none of them with an empty value. One with a single value is given once.
    """

    def __init__(self, *args: Any, module: str = "", **options: Any) -> None:
        super().__init__(*args, **{**options, "allow_abbrev": False})
        self._module = module
        for name, action in ((None, Once), ("store", Once), ("append", Append), ("extend", Extend)):
            self.register("action", name, action)

    def add_commands(self, commands: Mapping[str, Command], dest: str) -> None:
        """Add commands by their names and summaries."""
        actions = self.add_subparsers(dest=dest, metavar=dest.upper(), required=True)
        for name, command in commands.items():
            usual = command.summary[0].upper() + command.summary[1:] + "."
            description = command.description or usual
            actions.add_parser(name, help=command.summary, description=description, module=command.module)

    def parse_known_args(  # type: ignore[override]
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse; a command is imported now that it is known to be the one."""
        if self._module:
            command = import_module(self._module)
            self._module = ""
            if hasattr(command, "run"):
                self.set_defaults(run=command.run, renamed=[], format="text", output="-")
            command.configure(self)
        words = sys.argv[1:] if args is None else list(args)
        self._check_options(words)
        found, rest = super().parse_known_args(words, namespace)
        if rest:
            self._refuse(rest, getattr(found, "goal", None))
        return found, rest

    def _check_options(self, words: Sequence[str]) -> None:
        """Refuse an option that there is not; what stands behind the name of a command is the command's."""
        for word in words:
            name, _, _ = word.partition("=")
            if word == "--" or (self._subparsers is not None and not word.startswith("-")):
                return
            if word.startswith("--") and " " not in name and name not in self._option_string_actions:
                self._refuse([name])

    def _refuse(self, words: Sequence[str], goal: object = None) -> NoReturn:
        """End because of words that mean nothing here."""
        unknown = [word for word in words if word.startswith("-")]
        if unknown:
            options = list(self._option_string_actions)
            self.error(f"unknown option {said(unknown[0])}{did_you_mean(unknown[0], options)}")
        hint = ""
        if isinstance(goal, str):
            hint = f"; put a goal of several words into quotes: {cut(repr(' '.join((goal, *words))))}"
        self.error(f"{said(' '.join(words))} is one argument too many{hint}")

    def _check_value(self, action: argparse.Action, value: Any) -> None:
        """Refuse a value that is none of the choices, and say which is meant."""
        if action.choices is not None and value not in action.choices:
            known = list(map(str, action.choices))
            hint = did_you_mean(str(value), known) or f"; there are {', '.join(known)}"
            raise argparse.ArgumentError(action, f"invalid choice: {said(value)}{hint}")

    def print_help(self, file: SupportsWrite[str] | None = None) -> None:
        """Write the help; argparse itself passes over what cannot be written."""
        if file is None:
            output.write(output.STDOUT, [self.format_help()])
        else:
            super().print_help(file)

    def error(self, message: str) -> NoReturn:
        """End with the exit status of bad usage."""
        said = cut(" ".join(message.split()), _LONGEST)
        self.exit(BAD_USAGE, f"{self.prog}: error: {said} (see {self.prog} --help)\n")


def _refuse_empty(action: argparse.Action, values: Any) -> None:
    if action.option_strings and (values == "" or (isinstance(values, list) and "" in values)):
        raise argparse.ArgumentError(action, "the value is empty; leave the option out, or name one")


class Once(argparse.Action):
    """An option with one value, which may be given once; or, with `combine`, several times.

    `combine` makes one value of the one before and the next.
    """

    def __init__(self, *args: Any, combine: Callable[[Any, Any], Any] | None = None, **options: Any) -> None:
        super().__init__(*args, **options)
        self._combine = combine

    def __call__(
        self,
        parser: argparse.ArgumentParser,  # noqa: ARG002 - every action is given its parser
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Store the value."""
        _refuse_empty(self, values)
        before: frozenset[str] = getattr(namespace, "given", frozenset())
        if option_string is not None and self.dest in before:
            if self._combine is None:
                raise argparse.ArgumentError(self, "given twice, and only one value can hold")
            values = self._combine(getattr(namespace, self.dest), values)
        namespace.given = before | {self.dest}
        setattr(namespace, self.dest, values)


class _NotEmpty(argparse.Action):
    """An option that never has an empty value."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Store what is not empty."""
        _refuse_empty(self, values)
        super().__call__(parser, namespace, values, option_string)


class Append(_NotEmpty, argparse._AppendAction):
    """An option that may be given several times, never with an empty value."""


class Extend(_NotEmpty, argparse._ExtendAction):
    """An option with several values that may be given several times, never with an empty value."""


class Version(argparse.Action):
    """Print the version, which is looked up only then."""

    def __init__(self, option_strings: Sequence[str], dest: str, **options: Any) -> None:
        super().__init__(option_strings, dest, nargs=0, **options)

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> NoReturn:
        """Print the version and end."""
        output.write(output.STDOUT, [f"foon-asp {program_version()}\n"])
        parser.exit()


class Renamed(argparse.Action):
    """An old spelling of an option, valid for one version more; a warning says the new one."""

    def __init__(self, option_strings: Sequence[str], dest: str, new: str, **options: Any) -> None:
        super().__init__(option_strings, dest, help=argparse.SUPPRESS, **options)
        self._new = new

    def __call__(
        self,
        parser: argparse.ArgumentParser,  # noqa: ARG002 - every action is given its parser
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Store what the new option would."""
        setattr(namespace, self.dest, True if self.nargs == 0 else values)
        said = f"{option_string} is now {self._new}; the old name goes with the next version"
        namespace.renamed = [*namespace.renamed, said]
