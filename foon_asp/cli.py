"""The command line: `foon-asp COMMAND`. Reads files, writes standard output, messages to stderr.

Exit status: 0 found, 1 no task tree exists, 2 bad input or usage, 3 a limit was hit.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import NoReturn

from foon_asp.dataset import Dataset, load
from foon_asp.errors import FoonError, InternalError, QueryError, closest
from foon_asp.files import read_objects
from foon_asp.findings import Severity
from foon_asp.goals import find_goal
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain, Problem

_SHOWN = 3
"""How many warnings of one kind are written out."""

FOUND, UNREACHABLE, BAD_INPUT, LIMIT = 0, 1, 2, 3


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(BAD_INPUT, f"{self.prog}: error: {message} (see {self.prog} --help)\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status."""
    options = _parser().parse_args(arguments)
    try:
        status = int(options.run(options))
        sys.stdout.flush()
        return status
    except FoonError as error:
        print(f"foon-asp: error: {error}", file=sys.stderr)
        return BAD_INPUT
    except InternalError as error:
        print(f"foon-asp: internal error, please report it: {error}", file=sys.stderr)
        return 70
    except BrokenPipeError:
        # The reader (a pager, `head`) has seen enough; keep the interpreter from complaining at exit.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return FOUND
    except KeyboardInterrupt:
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="foon-asp",
        description="Task trees from functional object-oriented networks: proven, checked, explained.",
        epilog="exit status: 0 found, 1 no task tree exists, 2 bad input or usage, 3 a limit was hit",
    )
    parser.add_argument("--version", action="version", version=f"foon-asp {version('foon-asp')}")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)

    retrieve = _command(commands, "retrieve", _retrieve, "retrieve a task tree for a goal")
    retrieve.add_argument("goal", nargs="?", metavar="GOAL", help=_GOAL_HELP)
    retrieve.add_argument("--goals", metavar="FILE", help="retrieve every goal of a JSON list")
    _method_options(retrieve)
    retrieve.add_argument("--time-limit", type=_seconds, metavar="S", help="seconds for each goal")
    _format_option(retrieve, "text", "json", "foon")

    reach = _command(commands, "reach", _reach, "say what the kitchen can make")
    reach.add_argument("--list", action="store_true", help="name everything that can be made")
    _format_option(reach, "text", "json")

    compare = _command(
        commands, "compare", _compare, "compare all methods, reference and founded, with the proven optimum"
    )
    compare.add_argument("goal", nargs="*", metavar="GOAL", help=_GOAL_HELP)
    compare.add_argument("--goals", metavar="FILE", help="goals as a JSON list")
    compare.add_argument("--time-limit", type=_seconds, metavar="S", help="seconds for each tree")
    _format_option(compare, "text", "json")

    facts = _command(commands, "facts", _facts, "print the facts that clingo is given")
    facts.add_argument(
        "goal", nargs="*", metavar="GOAL", help=_GOAL_HELP + "; without one, the facts of the whole FOON"
    )
    facts.add_argument("--whole", action="store_true", help="do not slice the FOON to the goals")
    facts.add_argument("--reference", action="store_true", help="the slice of the reference reading")

    goals = _command(commands, "goals", _goals, "list the goals of the data folder")
    _format_option(goals, "text", "json")
    return parser


_GOAL_HELP = "LABEL [state, state] {content, content} in CONTAINER; all but the label may be left out"


def _command(
    commands: argparse._SubParsersAction[_Parser],
    name: str,
    run: object,
    summary: str,
) -> _Parser:
    command = commands.add_parser(name, help=summary, description=summary[0].upper() + summary[1:] + ".")
    command.set_defaults(run=run)
    data = command.add_argument_group("data (default: the built-in kitchen)")
    data.add_argument("--data", metavar="DIR", help="folder with FOON.txt (or subgraphs), kitchen.json, …")
    data.add_argument("--foon", nargs="+", default=[], metavar="FILE", help="FOON text files to merge")
    data.add_argument("--kitchen", metavar="FILE", help="objects at hand, a JSON list")
    data.add_argument("--rates", metavar="FILE", help="success rates, lines of motion<tab>rate")
    data.add_argument("--utensils", metavar="FILE", help="utensil labels, one a line")
    data.add_argument("--default-rate", type=_chance, metavar="P", help="rate of motions without one")
    data.add_argument("--strict", action="store_true", help="need every input, implied views too")
    return command


def _method_options(command: _Parser) -> None:
    command.add_argument(
        "--method",
        choices=("optimal", "greedy", "ids", "first"),
        default="optimal",
        help="how units are chosen (default: optimal)",
    )
    command.add_argument(
        "--by",
        default=(),
        metavar="C1,C2,…",
        help="criteria: units, success, inputs, depth; for greedy success or inputs",
    )
    command.add_argument(
        "--reference",
        action="store_true",
        help="drop foundedness, as the published programs do: the tree may go in circles",
    )


def _format_option(command: _Parser, *formats: str) -> None:
    command.add_argument("--format", choices=formats, default=formats[0], help=f"default: {formats[0]}")


def _seconds(text: str) -> float:
    value = float(text)
    if not 0 <= value < float("inf"):
        raise ValueError
    return value


def _chance(text: str) -> float:
    value = float(text)
    if not 0 <= value <= 1:
        raise ValueError
    return value


_seconds.__name__ = "number of seconds"
_chance.__name__ = "chance between 0 and 1"


def _open(options: argparse.Namespace) -> tuple[Dataset, Domain]:
    """Load the data and warn of what was lost in reading it or cannot be meant."""
    dataset = load(
        options.data,
        foon=options.foon,
        kitchen=options.kitchen,
        rates=options.rates,
        utensils=options.utensils,
        default_rate=options.default_rate,
    )
    for finding in dataset.findings:
        if finding.severity is Severity.ERROR:
            _warn(f"{finding.file}:{finding.line}: {finding.message}")
    domain = dataset.domain(strict=options.strict)
    for node in domain.strangers[:_SHOWN]:
        _warn(f"the kitchen has {node}, which the FOON does not know{_nearest(domain, node)}")
    if len(domain.strangers) > _SHOWN:
        _warn(f"and {len(domain.strangers) - _SHOWN} more objects that the FOON does not know")
    if not dataset.kitchen.objects:
        _warn("the kitchen is empty, nothing is at hand; name one with --kitchen")
    return dataset, domain


def _nearest(domain: Domain, node: ObjectNode) -> str:
    """Return the closest node, looking for the label first: that is quick and what people mistype."""
    same_label = [str(other) for other in domain.foon.objects if other.label == node.label]
    if same_label:
        return closest(str(node), same_label, 1) or f"; there is {same_label[0]}"
    return closest(node.label, domain.foon.labels, 1)


def _warn(message: str) -> None:
    print(f"foon-asp: warning: {message}", file=sys.stderr)


def _find_goals(
    options: argparse.Namespace, dataset: Dataset, domain: Domain, named: Sequence[str]
) -> list[ObjectNode]:
    """Return the goals that were named one by one and in a file."""
    goals = [find_goal(domain, text, dataset.goals) for text in named]
    if options.goals is not None:
        listed = read_objects(Path(options.goals))
        if not listed:
            raise QueryError(f"{options.goals}: the list of goals is empty")
        for node in listed:
            domain.id_of(node)
        goals += listed
    return goals


def _retrieve(options: argparse.Namespace) -> int:
    from foon_asp.render import json as render_json
    from foon_asp.render.text import retrieval_text
    from foon_asp.retrieve import check_method, retrieve

    if (options.goal is None) == (options.goals is None):
        raise QueryError("name one GOAL, or a file of them with --goals")
    check_method(options.method, options.by, not options.reference)
    dataset, domain = _open(options)
    goals = _find_goals(options, dataset, domain, [] if options.goal is None else [options.goal])
    results = []
    for place, goal in enumerate(goals):
        result = retrieve(
            domain,
            goal,
            options.method,
            options.by,
            founded=not options.reference,
            time_limit=options.time_limit,
        )
        results.append(result)
        if options.format == "text":
            sys.stdout.write(("\n" if place else "") + retrieval_text(result))
        elif options.format == "foon":
            _write_foon(result)
    if options.format == "json":
        values = [render_json.retrieval_value(result) for result in results]
        sys.stdout.write(render_json.dumps(values[0] if options.goals is None else values))
    statuses = {result.status for result in results}
    if "limit" in statuses:
        return LIMIT
    return UNREACHABLE if "unreachable" in statuses else FOUND


def _write_foon(result: object) -> None:
    from foon_asp.retrieve import Retrieval
    from foon_asp.text import write_text

    assert isinstance(result, Retrieval)
    if result.tree is None:
        print(f"foon-asp: {result.goal}: no task tree: {result.reason}", file=sys.stderr)
        return
    comments = [f"Goal:\t{result.goal}", f"Method:\t{result.method} {','.join(result.by)}".rstrip()]
    if not result.tree.executable:
        comments.append("NOT EXECUTABLE")
    sys.stdout.write(write_text(result.tree.domain.foon, result.tree.steps, comments))


def _reach(options: argparse.Namespace) -> int:
    from foon_asp.render import json as render_json
    from foon_asp.render.text import reach_text
    from foon_asp.retrieve import reach

    _, domain = _open(options)
    available, executable = reach(domain)
    if options.format == "json":
        value = render_json.reach_value(domain, available, executable)
        sys.stdout.write(render_json.dumps(value))
    else:
        sys.stdout.write(reach_text(domain, available, executable, listing=options.list))
    return FOUND


def _compare(options: argparse.Namespace) -> int:
    from foon_asp.compare import compare
    from foon_asp.render import json as render_json
    from foon_asp.render.text import comparison_text

    dataset, domain = _open(options)
    goals = _find_goals(options, dataset, domain, options.goal) or list(dataset.goals)
    if not goals:
        raise QueryError("no goals: name some, or a file of them with --goals")
    rows = compare(domain, goals, time_limit=options.time_limit)
    if options.format == "json":
        sys.stdout.write(render_json.dumps(render_json.comparison_value(rows)))
    else:
        sys.stdout.write(comparison_text(rows))
    return LIMIT if any(row.cells["optimal"].proven is False for row in rows) else FOUND


def _facts(options: argparse.Namespace) -> int:
    from foon_asp.facts import facts

    dataset, domain = _open(options)
    goals = [domain.id_of(find_goal(domain, text, dataset.goals)) for text in options.goal]
    problem = Problem(
        domain,
        tuple(goals),
        founded=not options.reference,
        whole=options.whole or not goals,
    )
    sys.stdout.write(facts(problem))
    return FOUND


def _goals(options: argparse.Namespace) -> int:
    from foon_asp.render import json as render_json
    from foon_asp.state_syntax import object_to_json

    dataset, domain = _open(options)
    if options.format == "json":
        sys.stdout.write(render_json.dumps([object_to_json(goal) for goal in dataset.goals]))
    else:
        for goal in dataset.goals:
            reachable = domain.foon.id_of(goal) in domain.closure.available
            sys.stdout.write(f"{goal}{'' if reachable else '  (this kitchen cannot make it)'}\n")
    return FOUND
