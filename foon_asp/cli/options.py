"""The options of the command line, each described once: the same flag means the same in every command."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import Any

from foon_asp.cli.parser import Parser
from foon_asp.io.vocabulary import VOCABULARIES
from foon_asp.model.consumption import SEMANTICS
from foon_asp.model.relations import MATCHINGS, Matching
from foon_asp.numbers import (
    COST,
    COUNT,
    FACTOR,
    LEAST_LIKENESS,
    LEAST_SUCCESS,
    LIKENESS,
    MEGABYTES,
    RATE,
    SECONDS,
    SOME,
    Number,
)
from foon_asp.query.constraints import KINDS, Form
from foon_asp.query.method import Method
from foon_asp.query.objective import CRITERIA
from foon_asp.values import said

_GOAL = "LABEL [state, state] {content, content} in CONTAINER; all but the label may be left out"
_SUM = f"sums like 2*units+inputs: {', '.join(CRITERIA)}"


def _reader(kind: Number) -> Callable[[str], Any]:
    """Return what reads a number of a kind, or says what is expected."""

    def read(text: str) -> int | float:
        try:
            return kind.read(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"expected {kind.words}, not {said(text)}") from None

    return read


seconds = _reader(SECONDS)
megabytes = _reader(MEGABYTES)
chance = _reader(RATE)
cost = _reader(COST)
number = _reader(COUNT)
positive = _reader(SOME)
factor = _reader(FACTOR)
likeness = _reader(LIKENESS)


def names(text: str) -> str:
    """Read names that are separated by commas, as they are."""
    labels(text)
    return text


def labels(text: str) -> list[str]:
    """Read labels that are separated by commas."""
    found = [label for label in text.split(",") if label.strip()]
    if not found:
        raise argparse.ArgumentTypeError("the value is empty; leave the option out, or name one")
    return found


def counted_label(text: str) -> tuple[str, int]:
    """Read a label with how many there are, `bowl=3`."""
    label, mark, count = text.rpartition("=")
    if not mark or not label.strip():
        raise argparse.ArgumentTypeError(f"expected LABEL=N, as in bowl=3, not {said(text)}")
    return label.strip().lower(), positive(count)


def world(parser: Parser, match_relations: Matching = "strict") -> None:
    """Add which FOON and which kitchen, and how they are read; relations match as said, by default."""
    group = parser.add_argument_group("data (default: the built-in kitchen)")
    data_folder(group)
    group.add_argument(
        "--foon", nargs="+", action="extend", default=[], metavar="FILE", help="FOON files or stores to merge"
    )
    kitchen(group)
    costs(group)
    group.add_argument("--strict", action="store_true", help="need every input, implied views too")
    group.add_argument(
        "--match-relations",
        choices=MATCHINGS,
        default=match_relations,
        help=f"strict: on is not in; loose: what is on, under, … counts as in (default: {match_relations})",
    )
    as_read(group)
    _level(group)


def kitchen(group: argparse._ActionsContainer, note: str = "") -> None:
    """Add what is at hand, what of it are utensils, and how likely motions succeed."""
    group.add_argument("--kitchen", metavar="FILE", help=f"objects at hand: JSON, FOON text, or labels{note}")
    group.add_argument(
        "--rates", metavar="FILE", help="success rates, a JSON object, or lines of motion<tab>rate"
    )
    group.add_argument("--utensils", metavar="FILE", help="utensil labels, one a line or a JSON list")
    group.add_argument("--default-rate", type=chance, metavar="P", help="rate of motions without one")


def costs(group: argparse._ActionsContainer) -> None:
    """Add what motions cost."""
    group.add_argument("--costs", metavar="FILE", help="what motions cost, a JSON object, or motion<tab>cost")
    group.add_argument("--default-cost", type=cost, metavar="C", help="cost of motions without one")


def reading(parser: Parser, *, level: bool = False) -> None:
    """Add how FOON files are read, for commands that know of no kitchen."""
    group = parser.add_argument_group("reading")
    as_read(group)
    if level:
        _level(group)


def data_folder(parser: argparse._ActionsContainer) -> None:
    """Add the folder of the data."""
    parser.add_argument("--data", metavar="DIR", help="folder with FOON.txt (or subgraphs), kitchen.json, …")


def as_read(group: argparse._ActionsContainer) -> None:
    """Add how FOON files are read."""
    vocabulary(group)
    group.add_argument(
        "--strict-format", action="store_true", help="take anything odd in a FOON file as an error"
    )


def vocabulary(group: argparse._ActionsContainer) -> None:
    """Add how words of older FOON files are read."""
    group.add_argument(
        "--vocabulary",
        choices=VOCABULARIES,
        default=VOCABULARIES[0],
        help="words of older FOON text, like 'ingredients inside': read as the current ones (default), or"
        " left as they are written",
    )


def _level(group: argparse._ActionsContainer) -> None:
    group.add_argument(
        "--level",
        type=int,
        choices=(1, 2, 3),
        default=3,
        help="detail: 1 labels, 2 labels and states, 3 everything (default)",
    )


OR_MARKED = "; without one, what the FOON marks as its goal"
"""What to say of a goal that may be left out."""


def goal(parser: Parser, nargs: str | None = None, note: str = "") -> None:
    """Add one goal, or as many as `nargs` says."""
    parser.add_argument("goal", nargs=nargs, metavar="GOAL", help=_GOAL + note)


def named_goal(parser: Parser, what: str) -> None:
    """Add a goal as an option, for commands whose arguments are something else; `what` it is there for."""
    parser.add_argument("--goal", action="append", default=[], metavar="GOAL", help=f"a goal; {what}")


def goals_file(parser: Parser) -> None:
    """Add a file of goals."""
    parser.add_argument("--goals", metavar="FILE", help="goals: JSON, FOON text, or labels")


def method(parser: Parser) -> None:
    """Add how units are chosen."""
    parser.add_argument(
        "--method",
        choices=[str(each) for each in Method],
        default=str(Method.OPTIMAL),
        help="how units are chosen (default: optimal)",
    )


def criteria(parser: Parser, more: str = "") -> None:
    """Add what a tree is best by, and `more` to say of it."""
    parser.add_argument(
        "--by",
        type=names,
        default=(),
        metavar="C1,C2,…",
        help=f"criteria, the most important first, or {_SUM}{more}",
    )


def criterion(parser: Parser, default: str | None = None) -> None:
    """Add what a plan is cheap by."""
    parser.add_argument(
        "--by",
        type=names,
        default=default,
        metavar="C",
        help=f"criteria, here only one, or {_SUM}" + (f" (default: {default})" if default else ""),
    )


def reference(parser: Parser) -> None:
    """Add the reading of the published programs."""
    parser.add_argument(
        "--reference",
        action="store_true",
        help="drop foundedness, as the published programs do: the tree may go in circles",
    )


def semantics(parser: Parser, default: str = "consume") -> None:
    """Add what is used up."""
    parser.add_argument(
        "--semantics",
        choices=SEMANTICS,
        default=default,
        help="what is used up: add: nothing; transform: what becomes or goes into an output; consume: every"
        f" input that is not an output again (default: {default})",
    )


def actions(parser: Parser, styles: Sequence[str], where: str = "") -> None:
    """Add how actions are written in PDDL; `where` says in which of the answers there are any."""
    parser.add_argument(
        "--style",
        choices=styles,
        help="how actions are written: one for each unit, with a fluent for each object (objects), or typed"
        f" and readable (lifted){where} (default: objects)",
    )
    parser.add_argument(
        "--durative",
        action="store_true",
        help=f"durative actions of PDDL 2.1, with annotated times{where}",
    )


def whole(parser: Parser) -> None:
    """Add that the FOON is taken entirely."""
    parser.add_argument("--whole", action="store_true", help="the entire FOON, not sliced to the goals")


def how_many(parser: argparse._ActionsContainer, default: str = "") -> None:
    """Add how many answers; `default` says how many there are without it."""
    text = "so many, the best first" + (f" (default: {default})" if default else "")
    parser.add_argument("-n", type=positive, metavar="N", help=text)


def limits(parser: Parser, limited: str = "") -> None:
    """Add limits of time and memory; `limited` says for what each the time is."""
    parser.add_argument(
        "--time-limit", type=seconds, metavar="S", help="limit in seconds" + (limited and f", {limited}")
    )
    parser.add_argument(
        "--memory-limit",
        type=megabytes,
        metavar="MB",
        help="limit in megabytes, for a process that solves",
    )


_VALUES: dict[Form, dict[str, Any]] = {
    Form.LABELS: {"action": "append", "default": []},
    Form.ONLY: {"action": "append"},
    Form.UNITS: {"action": "append", "default": [], "type": int},
    Form.DIETS: {"action": "append", "default": []},
    # Each is a constraint, and all of them hold.
    Form.COUNT: {"type": number, "combine": min},
    Form.CHANCE: {"type": _reader(LEAST_SUCCESS), "combine": max},
}


def constraint(parser: argparse._ActionsContainer, name: str) -> None:
    """Add the flag of one kind of constraints."""
    [kind] = [kind for kind in KINDS if kind.name == name]
    options: Any = _VALUES[kind.form]
    parser.add_argument(kind.flag, dest=kind.name, metavar=kind.value, help=kind.meaning, **options)


def constraints(parser: Parser) -> None:
    """Add the flags of all kinds of constraints, and rules of the user's own."""
    group = parser.add_argument_group("constraints (each may be given several times)")
    for kind in KINDS:
        constraint(group, kind.name)
    for flag, text in (
        ("--constraint", "rules that derive violated(Name,Key)"),
        ("--objective", "rules that derive criterion(Name,Priority) and penalty(Name,Key,Value)"),
    ):
        group.add_argument(flag, action="append", default=[], metavar="FILE", help=text)


def substitute(parser: Parser, more: str = "") -> None:
    """Add what may be replaced, and `more` to say of it."""
    parser.add_argument(
        "--substitute",
        action="append",
        nargs="?",
        const="foon",
        default=[],
        metavar="FILE",
        help="replace what is missing or forbidden by what is alike: as a table says, lines of"
        " label<tab>replaced by<tab>likeness<tab>note; by its uses in the FOON (foon; so without a value); by"
        f" vectors of ingredients (vectors, with foon-asp[similar]){more}",
    )


def similar(group: argparse._ActionsContainer) -> None:
    """Add which labels mean the same."""
    group.add_argument(
        "--similar",
        action="append",
        default=[],
        metavar="FILE",
        help="labels that mean the same: as a table says, lines of label<tab>other<tab>likeness<tab>note; by"
        " vectors of ingredients (vectors, with foon-asp[similar])",
    )
    group.add_argument(
        "--least-likeness",
        type=likeness,
        default=LEAST_LIKENESS,
        metavar="L",
        help=f"how alike they are at least (default: {LEAST_LIKENESS:g})",
    )


def output(parser: Parser, *formats: str) -> None:
    """Add where an answer goes, in which of some formats, and how much is said beside it."""
    group = parser.add_argument_group("output")
    group.add_argument(
        "-o", "--output", default="-", metavar="OUT", help="output, a file (default: -, standard output)"
    )
    if formats:
        group.add_argument(
            "--format", choices=formats, default=formats[0], help=f"format (default: {formats[0]})"
        )
    overwrite(group)
    messages(group)


def files(parser: Parser, name: str, text: str, default: str | None = None) -> None:
    """Add which files a command writes itself; `text` says what they are. Without a default one is named."""
    group = parser.add_argument_group("output")
    group.add_argument(
        "-o",
        "--output",
        dest="target",
        required=default is None,
        default=default,
        metavar=name,
        help=f"output, {text}",
    )
    overwrite(group)
    messages(group)


def overwrite(parser: argparse._ActionsContainer) -> None:
    """Add the permission to replace what is there."""
    parser.add_argument(
        "--overwrite", action="store_true", help="replace the output if it is there (default: refuse)"
    )


def messages(parser: argparse._ActionsContainer) -> None:
    """Add how much is said on standard error."""
    group = parser.add_mutually_exclusive_group()
    group.add_argument(
        "--quiet", action="store_true", help="no warnings, summaries or progress; errors are shown"
    )
    group.add_argument("--verbose", action="store_true", help="all warnings, and how long it took")
