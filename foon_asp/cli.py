"""The command line: `foon-asp COMMAND`. Reads files, writes standard output, messages to stderr.

Exit status: 0 found, 1 no task tree exists, 2 bad input or usage, 3 a limit was hit.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from importlib.metadata import version
from io import TextIOWrapper
from typing import NoReturn

from foon_asp import commands
from foon_asp.commands import BAD_INPUT, FOUND
from foon_asp.convert import FORMATS
from foon_asp.criteria import CRITERIA
from foon_asp.effects import SEMANTICS
from foon_asp.errors import FoonError, InternalError
from foon_asp.findings import Severity


class _Parser(argparse.ArgumentParser):
    """A parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        self.exit(BAD_INPUT, f"{self.prog}: error: {message} (see {self.prog} --help)\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program and return its exit status."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            # A terminal that cannot show a character of a label is no reason to stop.
            stream.reconfigure(errors="backslashreplace")
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
    subparsers = parser.add_subparsers(dest="command", metavar="COMMAND", required=True)

    retrieve = _command(subparsers, "retrieve", commands.run_retrieve, "retrieve a task tree for a goal")
    retrieve.add_argument("goal", nargs="?", metavar="GOAL", help=_GOAL_HELP)
    retrieve.add_argument("--goals", metavar="FILE", help="retrieve every goal of a JSON list")
    _method_options(retrieve)
    retrieve.add_argument(
        "--trace", action="store_true", help="with --method ids: what is explored at each limit of depth"
    )
    _alternative_options(retrieve)
    _constraint_options(retrieve)
    retrieve.add_argument("--time-limit", type=_seconds, metavar="S", help="seconds for each goal")
    _format_option(retrieve, "text", "json", "foon")

    explain = _command(
        subparsers,
        "explain",
        commands.run_explain,
        "say why there is no task tree, or what its steps are for",
    )
    explain.add_argument("goal", metavar="GOAL", help=_GOAL_HELP)
    explain.add_argument("--by", default="", metavar="C1,C2,…", help=_BY_HELP)
    explain.add_argument("--all", action="store_true", help="all smallest sets of missing things")
    explain.add_argument("--step", type=int, metavar="ID", help="only what this unit of the tree is for")
    explain.add_argument("--instead", action="store_true", help="with --step, the best tree without it")
    _constraint_options(explain)
    explain.add_argument("--time-limit", type=_seconds, metavar="S", help="seconds for each solve")
    _format_option(explain, "text", "json")

    suggest = _command(
        subparsers, "suggest", commands.run_suggest, "say what can be cooked, the best dishes first"
    )
    suggest.add_argument(
        "--using", default="", metavar="L1,L2,…", help="only dishes that are made with these"
    )
    suggest.add_argument("--by", default="", metavar="C1,C2,…", help=_BY_HELP)
    suggest.add_argument("--all", action="store_true", help="everything that can be made, not just dishes")
    suggest.add_argument("-n", type=_positive, default=20, metavar="N", help="show so many (default: 20)")
    _constraint_options(suggest)
    suggest.add_argument("--time-limit", type=_seconds, metavar="S", help="seconds for all dishes")
    _format_option(suggest, "text", "json")

    menu = _command(subparsers, "menu", commands.run_menu, "make several dishes, and share their steps")
    menu.add_argument("goal", nargs="*", metavar="GOAL", help=_GOAL_HELP)
    menu.add_argument("--goals", metavar="FILE", help="goals as a JSON list")
    menu.add_argument("--by", default="", metavar="C1,C2,…", help=_BY_HELP)
    menu.add_argument("--leave-out", action="store_true", help="leave out goals that cannot be made")
    _constraint_options(menu)
    menu.add_argument("--time-limit", type=_seconds, metavar="S", help="seconds for all of it")
    _format_option(menu, "text", "json", "foon")

    reach = _command(subparsers, "reach", commands.run_reach, "say what the kitchen can make")
    reach.add_argument("--list", action="store_true", help="name everything that can be made")
    _format_option(reach, "text", "json")

    compare = _command(
        subparsers,
        "compare",
        commands.run_compare,
        "compare all methods, reference and founded, with the proven optimum",
    )
    compare.add_argument("goal", nargs="*", metavar="GOAL", help=_GOAL_HELP)
    compare.add_argument("--goals", metavar="FILE", help="goals as a JSON list")
    compare.add_argument(
        "--human",
        action="store_true",
        help="instead, the highest success with 0, 1, 2, … steps done by a human, who never fails",
    )
    compare.add_argument("--human-steps", type=_count, metavar="K", help="with --human, at most K")
    compare.add_argument("--time-limit", type=_seconds, metavar="S", help="seconds for each tree")
    _format_option(compare, "text", "json")

    query = _command(subparsers, "query", commands.run_query, "run rules of your own over the facts")
    query.add_argument("file", metavar="FILE", help="answer-set rules over the vocabulary")
    query.add_argument(
        "goal", nargs="*", metavar="GOAL", help=_GOAL_HELP + "; without one, the facts of the whole FOON"
    )
    query.add_argument("--goals", metavar="FILE", help="goals as a JSON list")
    query.add_argument("--time-limit", type=_seconds, metavar="S", help="seconds")
    query.add_argument("--allow-script", action="store_true", help="let the file run code in #script")
    _format_option(query, "text", "json")

    batch = _command(
        subparsers, "batch", commands.run_batch, "answer a file of queries, here or on a cluster"
    )
    batch.add_argument("--queries", required=True, metavar="FILE", help="JSON lines: one query a line")
    batch.add_argument("--out", required=True, metavar="FILE", help="results: .parquet, or else JSON lines")
    batch.add_argument(
        "--jobs", type=_positive, metavar="N", help="processes (default: one for each core); 1: in this one"
    )
    batch.add_argument("--scheduler", metavar="ADDRESS", help="run on a Dask cluster, tcp://host:8786")
    batch.add_argument("--ship", action="store_true", help="send the data to the workers of the cluster")
    batch.add_argument("--time-limit", type=_seconds, metavar="S", help="for queries that say none")
    batch.add_argument("--timings", action="store_true", help="say in each result how long it took")
    batch.add_argument("--overwrite", action="store_true", help="replace the results if they are there")
    batch.add_argument("--progress", action="store_true", help="show a bar even if nobody looks on")

    plan = _command(subparsers, "plan", commands.run_plan, "plan with things being used up, by any engine")
    plan.add_argument("goal", nargs="+", metavar="GOAL", help=_GOAL_HELP)
    plan.add_argument(
        "--engine", default="clingo", metavar="NAME", help="see foon-asp engines (default: clingo)"
    )
    _semantics_option(plan)
    plan.add_argument(
        "--by", default="units", metavar="C", help="what is cheap: a criterion or a sum like 2*units+tools"
    )
    plan.add_argument(
        "--max-steps", type=_count, metavar="N", help="parallel steps that clingo tries at most"
    )
    plan.add_argument("--time-limit", type=_seconds, metavar="S", help="seconds")
    _format_option(plan, "text", "json", "foon")

    engines = subparsers.add_parser(
        "engines", help="list planning engines", description="List planning engines and how to install them."
    )
    engines.set_defaults(run=commands.run_engines)
    _format_option(engines, "text", "json")

    pddl = subparsers.add_parser(
        "pddl",
        help="write PDDL, read plans",
        description="Write PDDL, and read plans that were made from it.",
    )
    actions = pddl.add_subparsers(dest="action", metavar="ACTION", required=True)
    export = _command(
        actions, "export", commands.run_pddl_export, "write a domain, a problem and a map of names"
    )
    export.add_argument("goal", nargs="+", metavar="GOAL", help=_GOAL_HELP)
    export.add_argument("-o", "--output", required=True, metavar="DIR", help="folder for the three files")
    export.add_argument(
        "--style",
        choices=("objects", "lifted"),
        default="objects",
        help="objects (default): a fluent for each object, an action for each unit; lifted: typed, readable",
    )
    _semantics_option(export)
    export.add_argument("--by", metavar="C", help="action costs: a criterion or a sum like 2*units+tools")
    export.add_argument(
        "--durative", action="store_true", help="durative actions of PDDL 2.1, with annotated times"
    )
    export.add_argument("--whole", action="store_true", help="the entire FOON, not sliced to the goals")

    decode = _command(actions, "decode", commands.run_pddl_decode, "read a plan that another planner made")
    decode.add_argument("plan", metavar="PLAN", help="plan file in the IPC format")
    decode.add_argument("--names", required=True, metavar="FILE", help="names.json of the export")
    _format_option(decode, "text", "json", "foon")

    facts = _command(subparsers, "facts", commands.run_facts, "print the facts that clingo is given")
    facts.add_argument(
        "goal", nargs="*", metavar="GOAL", help=_GOAL_HELP + "; without one, the facts of the whole FOON"
    )
    facts.add_argument("--whole", action="store_true", help="do not slice the FOON to the goals")
    facts.add_argument("--reference", action="store_true", help="the slice of the reference reading")

    audit = _command(
        subparsers, "audit", commands.run_audit, "find what is wrong in FOON files, and the mends"
    )
    audit.add_argument("files", nargs="*", metavar="FILE", help=_FILES_HELP)
    audit.add_argument("--goals", metavar="FILE", help="goals that should be reachable, a JSON list")
    audit.add_argument(
        "--severity",
        choices=[severity.word for severity in Severity],
        default=Severity.NOTE.word,
        help="the least severity that the table shows (default: note)",
    )
    audit.add_argument(
        "--fail-on",
        choices=[severity.word for severity in Severity],
        help="exit with 1 if there is a finding of this severity or a higher one",
    )
    audit.add_argument(
        "--fix", action="store_true", help="write NAME.fixed beside each file with certain mends"
    )
    audit.add_argument("--fix-dir", metavar="DIR", help="write repaired copies into this folder instead")
    _format_option(audit, "text", "json", "sarif")

    stats = _command(
        subparsers, "stats", commands.run_stats, "count what is in a FOON", kitchen=False, planning=False
    )
    stats.add_argument("files", nargs="*", metavar="FILE", help="FOON files (default: the built-in FOON)")
    stats.add_argument("--data", metavar="DIR", help="folder with FOON.txt, or subgraphs")
    stats.add_argument(
        "--centrality", action="store_true", help="add centralities in the one-mode projection"
    )
    _format_option(stats, "text", "json")

    convert = _command(
        subparsers,
        "convert",
        commands.run_convert,
        "write FOON files in another format",
        kitchen=False,
        planning=False,
        level=False,
    )
    convert.add_argument("files", nargs="+", metavar="IN", help="FOON files; several are merged")
    convert.add_argument("-o", "--output", required=True, metavar="OUT", help="file, or folder for one each")
    convert.add_argument(
        "--to", choices=list(FORMATS), help="format (default: the fuller one with the suffix of OUT)"
    )

    merge = _command(
        subparsers,
        "merge",
        commands.run_merge,
        "merge FOON files into a universal FOON",
        kitchen=False,
        planning=False,
    )
    merge.add_argument("files", nargs="+", metavar="FILE", help="FOON files of any format")
    merge.add_argument("-o", "--output", metavar="OUT", help="text file (default: standard output)")

    compile_ = _command(
        subparsers,
        "compile",
        commands.run_compile,
        "compile FOON files into a store that opens quickly, however large",
        kitchen=False,
        planning=False,
        level=False,
    )
    compile_.add_argument(
        "files", nargs="+", metavar="FILE", help="FOON files of any format; several are merged"
    )
    compile_.add_argument(
        "-o",
        "--output",
        required=True,
        metavar="KB.foon",
        help="folder of the store; one that is there is replaced",
    )

    goals = _command(subparsers, "goals", commands.run_goals, "list the goals of the data folder")
    _format_option(goals, "text", "json")
    return parser


_GOAL_HELP = "LABEL [state, state] {content, content} in CONTAINER; all but the label may be left out"


_BY_HELP = f"criteria, the most important first, or sums like 2*units+inputs: {', '.join(CRITERIA)}"


_FILES_HELP = "FOON files; kitchen.json etc. beside the first are used"


def _command(
    subparsers: argparse._SubParsersAction[_Parser],
    name: str,
    run: object,
    summary: str,
    *,
    kitchen: bool = True,
    planning: bool = True,
    level: bool = True,
) -> _Parser:
    """Add a command, with the options of all those that need a kitchen, plan, or know levels."""
    command = subparsers.add_parser(name, help=summary, description=summary[0].upper() + summary[1:] + ".")
    command.set_defaults(run=run)
    data = command.add_argument_group("data (default: the built-in kitchen)" if kitchen else "reading")
    if kitchen:
        data.add_argument(
            "--data", metavar="DIR", help="folder with FOON.txt (or subgraphs), kitchen.json, …"
        )
        data.add_argument(
            "--foon", nargs="+", default=[], metavar="FILE", help="FOON files or stores to merge"
        )
        data.add_argument("--kitchen", metavar="FILE", help="objects at hand, a JSON list")
        data.add_argument("--rates", metavar="FILE", help="success rates, lines of motion<tab>rate")
        data.add_argument("--utensils", metavar="FILE", help="utensil labels, one a line")
        data.add_argument("--default-rate", type=_chance, metavar="P", help="rate of motions without one")
    if planning:
        data.add_argument("--strict", action="store_true", help="need every input, implied views too")
    data.add_argument(
        "--strict-format", action="store_true", help="take anything odd in a FOON file as an error"
    )
    if level:
        data.add_argument(
            "--level",
            type=int,
            choices=(1, 2, 3),
            default=3,
            help="detail: 1 labels, 2 labels and states, 3 everything (default)",
        )
    return command


def _semantics_option(command: _Parser) -> None:
    command.add_argument(
        "--semantics",
        choices=SEMANTICS,
        default="consume",
        help="what is used up: add: nothing; transform: what becomes or goes into an output;"
        " consume: every input that is not an output again (default)",
    )


def _method_options(command: _Parser) -> None:
    command.add_argument(
        "--method",
        choices=("optimal", "greedy", "ids", "first"),
        default="optimal",
        help="how units are chosen (default: optimal)",
    )
    command.add_argument(
        "--by",
        default="",
        metavar="C1,C2,…",
        help=_BY_HELP + "; for greedy success or inputs",
    )
    command.add_argument(
        "--reference",
        action="store_true",
        help="drop foundedness, as the published programs do: the tree may go in circles",
    )


def _alternative_options(command: _Parser) -> None:
    group = command.add_argument_group(
        "several task trees (with the method optimal)"
    ).add_mutually_exclusive_group()
    group.add_argument("-k", type=_positive, metavar="N", help="the N best, in order")
    group.add_argument("--all-optimal", action="store_true", help="all that are best, and their number")
    group.add_argument(
        "--diverse", type=_positive, metavar="N", help="N that are as different as possible, within --factor"
    )
    group.add_argument("--pareto", metavar="C1,C2,…", help="one for each trade-off between some criteria")
    command.add_argument(
        "--factor",
        type=float,
        metavar="F",
        help="with --diverse: cost at most F times the best (default: 1.5)",
    )


def _constraint_options(command: _Parser) -> None:
    group = command.add_argument_group("constraints (each may be given several times)")
    for flag, metavar, text in (
        ("--without", "LABEL", "no unit touches it, by label, contents or place"),
        ("--without-tool", "LABEL", "no unit handles it"),
        ("--avoid-motion", "MOTION", "no unit has this motion"),
        ("--diet", "NAME", "a diet that comes with the program, or a file of forbidden labels"),
        ("--constraint", "FILE", "rules that derive violated(Name,Key)"),
        ("--objective", "FILE", "rules that derive criterion(Name,Priority) and penalty(Name,Key,Value)"),
    ):
        group.add_argument(flag, action="append", default=[], metavar=metavar, help=text)
    group.add_argument(
        "--use-unit", action="append", type=int, default=[], metavar="ID", help="this unit is in the tree"
    )
    group.add_argument(
        "--avoid-unit",
        action="append",
        type=int,
        default=[],
        metavar="ID",
        help="this unit is not in the tree",
    )
    group.add_argument("--only-motions", metavar="FILE", help="motions that are allowed, one a line")
    group.add_argument("--max-units", type=_count, metavar="N", help="at most N units")
    group.add_argument("--max-depth", type=_count, metavar="N", help="at most N rounds of parallel execution")
    group.add_argument("--min-success", type=_chance, metavar="P", help="the tree succeeds with this chance")
    group.add_argument(
        "--human-steps", type=_count, metavar="K", help="a human, who never fails, does at most K steps"
    )
    group.add_argument("--allow-script", action="store_true", help="let rule files run code in #script")


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


def _count(text: str) -> int:
    value = int(text)
    if value < 0:
        raise ValueError
    return value


def _positive(text: str) -> int:
    value = int(text)
    if value < 1:
        raise ValueError
    return value


_count.__name__ = "number"
_positive.__name__ = "number above 0"
_seconds.__name__ = "number of seconds"
_chance.__name__ = "chance between 0 and 1"
