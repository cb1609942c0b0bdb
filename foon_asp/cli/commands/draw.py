"""`foon-asp draw`: pictures of task trees, plans, menus and FOONs, and of what is missing."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from foon_asp.cli import options as add
from foon_asp.cli.inputs import load_data, named_goals, open_trees, open_world
from foon_asp.cli.messages import tell
from foon_asp.cli.output import STDOUT, Reply
from foon_asp.cli.parser import Parser
from foon_asp.cli.question import question
from foon_asp.draw.checks import check_picture, side_by_side
from foon_asp.draw.comparing import Version, comparison_picture
from foon_asp.draw.foons import MOST_UNITS, around_picture, foon_picture, usual_utensils
from foon_asp.draw.formats import Drawing, Format, format_of
from foon_asp.draw.fronts import front_picture
from foon_asp.draw.menus import menu_picture
from foon_asp.draw.missing import missing_picture
from foon_asp.draw.picture import Picture
from foon_asp.draw.trees import plan_picture, tree_picture
from foon_asp.errors import QueryError
from foon_asp.io.files import is_store
from foon_asp.io.trees import STDIN
from foon_asp.limits import Limit, LimitReachedError, limited
from foon_asp.model.world import World
from foon_asp.planning.answer import PlanAnswer
from foon_asp.planning.planner import plan
from foon_asp.planning.query import PlanQuery
from foon_asp.query.goals import find_object
from foon_asp.query.method import Method
from foon_asp.query.query import Query
from foon_asp.query.status import Status
from foon_asp.retrieval.alternatives import Alternatives, pareto_trees
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.check import Check, CheckQuery, check_trees
from foon_asp.retrieval.explain import explain
from foon_asp.retrieval.menu import plan_menu
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.values import said

T = TypeVar("T")

_OF_GOALS = ("tree", "plan", "menu", "missing", "pareto")
_OF_FILES = ("tree", "foon")
_FILE_SUFFIXES = (".txt", ".json", ".foon")


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    parser.add_argument(
        "goal",
        nargs="*",
        action=_Named,
        metavar="WHAT",
        help="goals, or files of task trees or FOONs; without any, the FOON of the data",
    )
    add.goals_file(parser)
    parser.add_argument(
        "--show",
        choices=[*_OF_GOALS, "foon"],
        help=f"of goals: {', '.join(_OF_GOALS)} (default: tree, of several goals menu); of files: tree,"
        f" judged as check does, or foon, as it is (default: tree, from {MOST_UNITS + 1} units on foon)",
    )
    parser.add_argument("--around", metavar="OBJ", help="the units that make or need an object")
    parser.add_argument("--hops", type=add.positive, metavar="N", help="with --around: how far (default: 1)")
    parser.add_argument(
        "--compare",
        nargs=2,
        metavar=("A", "B"),
        help="two trees over each other: files, goals, or for one GOAL methods or criteria",
    )
    add.method(parser)
    add.criteria(parser, "; with --show pareto the axes (default: units,success)")
    add.reference(parser)
    add.semantics(parser)
    add.constraints(parser)
    add.substitute(parser)
    add.limits(parser, "for all of it")
    add.output(parser)
    parser.add_argument(
        "--format",
        choices=[str(each) for each in Format],
        help="format (default: by the suffix of OUT, svg on standard output)",
    )
    parser.add_argument(
        "--dark", action="store_true", help="on dark paper (default: an SVG follows its reader, others light)"
    )
    parser.set_defaults(trees=[], format=None)


class _Named(argparse.Action):
    """What is to be drawn: files that are there, or look like files, under `trees`; all else are goals."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,  # noqa: ARG002 - every action is given its parser
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,  # noqa: ARG002
    ) -> None:
        """Store the values, each where it belongs."""
        namespace.trees = [value for value in values if _is_file(value)]
        namespace.goal = [value for value in values if not _is_file(value)]


def _is_file(name: str) -> bool:
    path = Path(name)
    return name == STDIN or path.suffix.lower() in _FILE_SUFFIXES or path.is_file() or is_store(path)


def run(options: argparse.Namespace) -> Reply:
    """Draw."""
    form = _format(options)
    _check(options)
    drawn = _Drawn(options)
    with limited(options.time_limit, options.memory_limit):
        try:
            picture = drawn.picture()
        except _NothingError as nothing:
            # A file that is empty would look like a picture.
            tell(str(nothing))
            options.output = STDOUT
            return Reply(statuses=[nothing.status])
        written = Drawing(picture, True if options.dark else None).written(form)
    options.format = str(form)
    text, data = (None, written) if isinstance(written, bytes) else (written, None)
    return Reply(lambda: text or "", statuses=drawn.statuses, summary=picture.summary, data=data)


def _format(options: argparse.Namespace) -> Format:
    if options.output == STDOUT:
        return Format(options.format or Format.SVG)
    if options.format is None:
        return format_of(Path(options.output))
    return Format(options.format)


def _check(options: argparse.Namespace) -> None:
    """Raise `QueryError` for options that do not go together."""
    goals = bool(options.goal or options.goals)
    if options.hops and options.around is None:
        raise QueryError("--hops says how far to look around an object; name it with --around")
    kinds = [options.show is not None, options.around is not None, options.compare is not None]
    if sum(kinds) > 1:
        raise QueryError("--show, --around and --compare are three pictures; ask for one of them")
    if options.trees and goals:
        raise QueryError("name goals or files, not both; FOON files are named with --foon")
    if options.trees and options.compare:
        raise QueryError("--compare names both trees itself; leave out the files before it")
    if options.around is not None and goals:
        raise QueryError("--around names an object itself; leave out the goals")
    known = _OF_FILES if options.trees else _OF_GOALS if goals else ("foon",)
    if options.show is not None and options.show not in known:
        raise QueryError(f"--show {options.show} is not for what is named here; there is {', '.join(known)}")


class _NothingError(Exception):
    """There is nothing to draw; how the question ended says why."""

    def __init__(self, why: str, status: Status) -> None:
        super().__init__(why)
        self.status = status


@dataclass
class _Drawn:
    """What is drawn, and how the questions for it ended."""

    options: argparse.Namespace

    def __post_init__(self) -> None:
        self.statuses: list[Status] = []

    def picture(self) -> Picture:
        """Return the picture that the options ask for."""
        options = self.options
        if options.compare is not None:
            return self._comparison()
        if options.around is not None:
            world = self._foon_world()
            return around_picture(world, find_object(world, options.around), options.hops or 1)
        if options.trees and options.show != "foon":
            checks = [] if any(is_store(Path(name)) for name in options.trees) else _checks(options)
            if len(checks):
                return side_by_side([check_picture(each) for each in checks])
        if options.trees or not (options.goal or options.goals):
            return foon_picture(self._foon_world())
        return self._of_goals()

    def _foon_world(self) -> World:
        """Return the world of the files that are named, or of the data."""
        options = self.options
        if not options.trees:
            return open_world(options)
        options.files = options.trees
        dataset = load_data(options)
        if not dataset.kitchen.utensils:
            dataset = replace(dataset, kitchen=replace(dataset.kitchen, utensils=usual_utensils()))
        return dataset.world()

    def _of_goals(self) -> Picture:
        options, goals = self.options, named_goals(self.options)
        show = options.show or ("tree" if len(goals) == 1 else "menu")
        if show == "plan":
            return self._plan(open_world(options))
        if show == "pareto" and not options.by:
            options.by = "units,success"
        query = question(options, *goals)
        world = open_world(options)
        if show == "menu":
            menu = plan_menu(world, query)
            self._found(menu.together.tree, "task tree for all of them together", menu.together)
            return menu_picture(menu)
        if show == "pareto":
            front = pareto_trees(world, query)
            self._found(front.trees or None, "task tree", front)
            return front_picture(front)
        if show == "tree":
            answer = retrieve(world, query)
            if answer.status is not Status.UNREACHABLE or options.substitute:
                return tree_picture(self._found(answer.tree, "task tree", answer))
        found = explain(world, query)
        if found.status is Status.LIMIT and (found.answer is None or found.answer.tree is None):
            raise LimitReachedError(found.limit or Limit.TIME)
        self.statuses.append(Status.UNREACHABLE if found.status is Status.CONSTRAINED else found.status)
        return missing_picture(found)

    def _found(self, found: T | None, what: str, answer: Answer | Alternatives | PlanAnswer) -> T:
        """Return what was found; raise `LimitReachedError` or `_NothingError` if nothing was."""
        if found is None and answer.status is Status.LIMIT:
            raise LimitReachedError(answer.limit or Limit.TIME)
        if found is None:
            raise _NothingError(f"no {what}: {answer.reason or answer.status}", answer.status)
        self.statuses.append(answer.status)
        return found

    def _plan(self, world: World) -> Picture:
        options = self.options
        query = Query(
            *named_goals(options),
            by=options.by,
            time_limit=options.time_limit,
            memory_limit=options.memory_limit,
        )
        answer = plan(world, PlanQuery(query, semantics=options.semantics))
        return plan_picture(self._found(answer.plan, "plan", answer), answer.effects)

    def _comparison(self) -> Picture:
        goals = named_goals(self.options)
        if len(goals) > 1:
            raise QueryError("trees of one goal are compared; name one GOAL")
        return comparison_picture(*(self._version(goals, text) for text in self.options.compare))

    def _version(self, goals: Sequence[Any], text: str) -> Version:
        """Return a tree to compare: of a file, of another goal, or of the goal by a method or criteria."""
        options = self.options
        if not goals and _is_file(text):
            options.trees = [text]
            checks = _checks(options, as_trees=True)
            if len(checks) != 1:
                raise QueryError(f"{text}: there are {len(checks)} trees in it; compare files of one tree")
            return Version.of_check(checks[0])
        query = question(options, *(goals or [text]))
        if goals and text in [str(method) for method in Method]:
            query = query.replace(method=Method(text), by=query.by or _usual(text))
        elif goals:
            query = query.replace(by=text)
        answer = retrieve(open_world(options), query)
        return Version.of_tree(text, self._found(answer.tree, f"task tree of {said(text)}", answer))


def _usual(method: str) -> tuple[str, ...]:
    return ("success",) if method == Method.GREEDY else ()


def _checks(options: argparse.Namespace, *, as_trees: bool = False) -> Sequence[Check]:
    """Judge the trees of some files as `check` does; none if they have so many units that they are FOONs."""
    known = load_data(options)
    trees = open_trees(options, known.foon)
    units = sum(len(listing.units) for listing in trees.listings)
    if units > MOST_UNITS and options.show != "tree" and not as_trees:
        return ()
    query = CheckQuery(
        known.kitchen if options.kitchen is not None else None,
        known.kitchen.utensils,
        options.utensils is not None,
        "add",
        "loose",
        options.strict,
    )
    return check_trees(trees, query)
