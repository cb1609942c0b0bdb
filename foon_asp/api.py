"""The public world: a FOON in a kitchen, and everything that can be asked of it from Python."""

from __future__ import annotations

import sys
import warnings
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import replace
from functools import cached_property
from multiprocessing import get_context
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING, TypedDict, Unpack

from foon_asp.errors import FoonWarning, InputError, QueryError
from foon_asp.io.atomic import write_text
from foon_asp.io.findings import Finding, Severity
from foon_asp.io.folder import Dataset, SourceKeys
from foon_asp.io.folder import load as load_dataset
from foon_asp.io.motions import read_costs
from foon_asp.io.open import FoonReader
from foon_asp.io.transitions import Orders, read_orders, stated_orders
from foon_asp.io.trees import TreeBuilder, TreeFile, trees_beside
from foon_asp.io.unknown_words import unknown
from foon_asp.io.vocabulary import VocabularyName
from foon_asp.model.alignment import Likeness, Measure
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, ObjectId, ObjectNode, UnitId, check_label
from foon_asp.model.relations import Matching
from foon_asp.model.world import World as ModelWorld
from foon_asp.numbers import COUNT, LEAST_LIKENESS, LIKENESS, SOME
from foon_asp.query.constraints import Constraints
from foon_asp.query.goals import Named, find_object, written_object
from foon_asp.query.kitchen_change import KitchenChange
from foon_asp.query.objective import Objective
from foon_asp.query.query import Query
from foon_asp.query.substitution import Replacement, Substitution
from foon_asp.render.explorer import explorer_page
from foon_asp.retrieval.adapt import Adaptation, adapt_dish
from foon_asp.retrieval.alternatives import (
    Alternatives,
    all_optimal_trees,
    best_trees,
    diverse_trees,
    pareto_trees,
)
from foon_asp.retrieval.answer import Answer
from foon_asp.retrieval.check import CheckQuery, Checks, check_trees
from foon_asp.retrieval.compare import Comparison, compare
from foon_asp.retrieval.consolidate import ConsolidateQuery, Consolidation, consolidate_trees
from foon_asp.retrieval.explain import Explanation, explain, explain_step
from foon_asp.retrieval.menu import Menu, plan_menu
from foon_asp.retrieval.progress import OnBetter
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.suggest import Suggestions, suggest
from foon_asp.retrieval.tree import Replay, Step, TaskTree
from foon_asp.values import a_list, said
from foon_asp.words import shortened

if TYPE_CHECKING:
    from foon_asp.draw.formats import Drawing
    from foon_asp.planning.answer import PlanAnswer
    from foon_asp.planning.resources import Resources
    from foon_asp.planning.schedule import Schedule
    from foon_asp.planning.schedule_answer import ScheduleAnswer

Asked = Query | Named
"""A question; a goal alone, as a text or an object node, asks for its best tree."""


class World:
    """A FOON seen from a kitchen; what is worked out for one question serves the next.

    A world never changes, and threads may share it. Objects, wherever they are asked for, are object nodes or
    texts as on the command line: `onion [chopped]`, `bowl {salt, water}`, `egg in bowl`.
    """

    def __init__(
        self,
        foon: Foon | Dataset | ModelWorld,
        kitchen: Kitchen | Iterable[Named] = (),
        *,
        utensils: Iterable[str] = (),
        rates: dict[str, float] | None = None,
    ) -> None:
        """See a FOON from a kitchen: the objects at hand, labels of utensils, success rates by motion.

        `load` makes a world of files, `read` a FOON of values. Raises `QueryError` for a text that names no
        object, and for values of another kind.
        """
        if isinstance(foon, Foon) and not isinstance(kitchen, Kitchen):
            objects = tuple(_node(each) for each in a_list(kitchen, "kitchen", "objects"))
            kitchen = Kitchen(objects, frozenset(a_list(utensils, "utensils", "labels")), rates or {})
        elif utensils or rates or not (isinstance(foon, Foon) or kitchen == ()):
            raise QueryError("there is a kitchen already; its objects, utensils and rates are those it has")
        self._world = _seen(foon, kitchen)
        self._files = (foon, self._world) if isinstance(foon, Dataset) else None

    def __repr__(self) -> str:
        return repr(self._world)

    def draw(self, around: Named | None = None, hops: int = 1, *, dark: bool | None = None) -> Drawing:
        """Return the FOON as a picture (of a large one an overview), or what is `around` an object of it.

        The units that make or need the object are one hop away.
        """
        from foon_asp.draw.views import world_drawing

        return world_drawing(self._world, around, hops, dark)

    def _repr_svg_(self) -> str | None:
        from foon_asp.draw.views import svg_unasked

        return svg_unasked(self.foon.units, self.draw)

    def _repr_html_(self) -> str:
        from foon_asp.render.notebook import pictured, table

        foon = self.foon
        rows = [
            ("functional units", f"{len(foon.units):,}"),
            ("object nodes", f"{len(foon.objects):,}"),
            ("motions", f"{len(foon.motions):,}"),
            ("objects in the kitchen", f"{len(self.kitchen.objects):,}"),
            ("goals named by the data", f"{len(self.goals):,}"),
        ]
        return pictured(self._repr_svg_(), table(("world", ""), rows))

    @property
    def foon(self) -> Foon:
        """The FOON: `foon.units` and `foon.objects`, each by its id."""
        return self._world.foon

    @property
    def kitchen(self) -> Kitchen:
        """The objects at hand, the utensils and the success rates."""
        return self._world.kitchen

    @property
    def goals(self) -> tuple[ObjectNode, ...]:
        """The goals that the data name."""
        return self._world.goals

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """What was odd or lost in the files that were read, and what they name and the FOON does not know."""
        if self._files is None:
            return ()
        dataset, world = self._files
        return (*dataset.findings, *unknown(dataset, world.full))

    @cached_property
    def makeable(self) -> tuple[ObjectNode, ...]:
        """Everything that the kitchen can make and does not have."""
        world = self._world
        return tuple(world.node(number) for number in world.closure.available if number not in world.stock)

    def find(self, text: str) -> ObjectNode:
        """Return the object node that a text names; raise `QueryError` with the closest if there is none."""
        return find_object(self._world, text)

    def with_kitchen(
        self,
        objects: Iterable[Named] | None = None,
        *,
        add: Iterable[Named] = (),
        remove: Iterable[Named] = (),
    ) -> World:
        """Return the world with another kitchen: these objects, or the same with some added and removed."""
        return self._changed(KitchenChange.of(objects, add, remove).applied(self._world))

    def on_level(self, level: int) -> World:
        """Return the world in less detail: 1 labels, 2 labels and states, 3 everything."""
        return self._changed(self._world.full.on_level(level))

    def _changed(self, world: ModelWorld) -> World:
        """Return another view of the same files."""
        other = World(world)
        other._files = self._files
        return other

    def retrieve(self, query: Asked, *, on_better: OnBetter | None = None) -> Answer:
        """Return the best task tree, or what the method finds; an answer is true if it has a tree.

        Where that takes long `on_better` is called meanwhile, with each tree that is better than the last.
        """
        return retrieve(self._world, query, on_better)

    def best(self, query: Asked, count: int) -> Alternatives:
        """Return the best task trees, at most so many, the best first."""
        return best_trees(self._world, query, _how_many(count))

    def all_optimal(self, query: Asked) -> Alternatives:
        """Return every optimal task tree."""
        return all_optimal_trees(self._world, query)

    def diverse(self, query: Asked, count: int, factor: float = 1.5) -> Alternatives:
        """Return the best task tree and others as different as possible, within `factor` of its cost."""
        return diverse_trees(self._world, query, _how_many(count), factor)

    def pareto(self, query: Asked) -> Alternatives:
        """Return one task tree for each trade-off between the criteria of the query."""
        return pareto_trees(self._world, query)

    def menu(self, goals: Iterable[Named] | Query, *, leave_out: bool = False) -> Menu:
        """Return one tree for several dishes; `leave_out` leaves out those that cannot be made."""
        query = goals if isinstance(goals, Query) else Query(*a_list(goals, "goals", "objects"))
        return plan_menu(self._world, query, leave_out=leave_out)

    def plan(
        self,
        query: Asked,
        *,
        engine: str = "clingo",
        semantics: str = "consume",
        max_steps: int | None = None,
    ) -> PlanAnswer:
        """Return a plan, in which things are used up as `semantics` says; it is true if there is one.

        `engine` is clingo or one that unified-planning finds; clingo tries `max_steps` parallel steps.
        """
        # It takes 50 ms to import, of 400 for all of this, and few programs plan.
        from foon_asp.planning.planner import plan
        from foon_asp.planning.query import PlanQuery

        return plan(self._world, PlanQuery(Query.of(query), engine, semantics, max_steps))

    def adapt(self, query: Asked, wanted: Iterable[str] = ()) -> Adaptation:
        """Return the nearest dish of a kind, with what is wanted and without what the query forbids.

        The query names a dish, what it is a kind of (`salad`), or a category of the files (`"15"`).
        """
        return adapt_dish(self._world, query, wanted)

    def schedule(
        self,
        goals: Asked | Iterable[Named],
        *,
        hands: int | None = None,
        resources: Resources | str | Path | None = None,
        have: Mapping[str, int] | None = None,
        passive: Iterable[str] = (),
        durations: Mapping[str, float] | str | Path | None = None,
        semantics: str = "consume",
        front: bool = False,
        known: Schedule | None = None,
    ) -> ScheduleAnswer:
        """Return the shortest schedule for goals: which steps are done when, by whom, and with what.

        `resources` (or the file that says them) are workers, stations and utensils; `hands` are those of the
        only worker, `have={"bowl": 2}` counts utensils and stations, `passive` motions go by themselves.
        `durations` are seconds by motion, where no video says them. `front=True` adds longer schedules that
        are better by the criterion of the query. What is answered is no longer than the `known` schedule, of
        the same goals with fewer resources. Raises `QueryError`, and `InputError` for a file that cannot be
        read.
        """
        # As of `plan`.
        from foon_asp.io.motions import read_durations
        from foon_asp.planning.resource_file import read_resources
        from foon_asp.planning.resources import Resources
        from foon_asp.planning.schedule_query import ScheduleQuery
        from foon_asp.planning.scheduler import schedule

        query = goals if isinstance(goals, Query) else Query(*_several(goals))
        if isinstance(resources, str | Path):
            resources = read_resources(Path(resources))
        found = Resources() if resources is None else resources
        if hands is not None:
            found = found.with_hands(_how_many(hands, "hands"))
        found = found.with_passive(self._world, a_list(passive, "passive", "motions"))
        found = found.with_counts(self._world, (have or {}).items())
        if isinstance(durations, str | Path):
            durations = read_durations(Path(durations))
        asked = ScheduleQuery(query, found, semantics, durations or {}, front)
        return schedule(self._world, asked, known)

    def explain(self, query: Asked, *, most: int = 1) -> Explanation:
        """Say why there is no task tree and what is missing, `most` smallest sets; or what steps are for."""
        return explain(self._world, query, most=_how_many(most, "most"))

    def explain_step(self, query: Asked, unit: int, *, instead: bool = False) -> Explanation:
        """Say what one step of the best tree is for, by its unit; `instead` adds the best tree without it."""
        chosen = UnitId(int(COUNT.checked(unit, "unit")))
        return explain_step(self._world, query, chosen, instead=instead)

    def suggest(
        self,
        count: int | None = None,
        *,
        query: Query | None = None,
        using: Iterable[str] = (),
        everything: bool = False,
    ) -> Suggestions:
        """Return the dishes that the kitchen can make, all or the best so many, the best first."""
        most = None if count is None else _how_many(count)
        asked = Query() if query is None else query
        found = suggest(self._world, asked, using=using, everything=everything)
        return found if most is None else replace(found, dishes=found.dishes[:most])

    def compare(self, goals: Iterable[Named] | None = None, *, time_limit: float | None = None) -> Comparison:
        """Return how many units each method needs for goals, those of the data if none are named."""
        listed = self.goals if goals is None else a_list(goals, "goals", "objects")
        wanted = [find_object(self._world, goal) for goal in listed]
        return compare(self._world, wanted, time_limit=time_limit)

    def explore(self, path: str | Path, goals: Iterable[Named] = (), *, title: str = "FOON") -> Path:
        """Write a page in which a browser searches, plans and draws; return its path.

        `title` names the data. With `goals` it has only the units that can matter for them, for a FOON that
        is too large for a page. A file of this name is replaced. Raises `QueryError` and `InputError`.
        """
        nodes = [find_object(self._world, goal) for goal in a_list(goals, "goals", "objects")]
        page = explorer_page(self._world, title=title, goals=nodes)
        write_text(Path(path), page.text)
        return Path(path)

    def answer_many(self, queries: Iterable[Asked], *, jobs: int = 1) -> Iterator[Answer]:
        """Yield the answers to many queries, in order, in so many processes.

        The trees are those of this world. Raises what `retrieve` raises, at the query that is wrong.
        """
        asked = [Query.of(query) for query in a_list(queries, "queries", "questions")]
        if _how_many(jobs, "jobs") == 1:
            yield from (retrieve(self._world, query) for query in asked)
            return
        context = get_context("spawn")
        with ProcessPoolExecutor(jobs, context, _open, (self._world,)) as pool:
            size = max(1, min(16, len(asked) // (4 * jobs)))
            with _without_main():
                answers = pool.map(_answer, asked, chunksize=size)
            for query, (answer, ids) in zip(asked, answers, strict=True):
                yield (
                    answer
                    if ids is None
                    else replace(answer, tree=TaskTree(query.seen_in(self._world), *ids))
                )


def _seen(foon: Foon | Dataset | ModelWorld, kitchen: Kitchen | Iterable[Named]) -> ModelWorld:
    """Return the world that a FOON and a kitchen are, or that something is already."""
    if isinstance(foon, ModelWorld):
        return foon
    if isinstance(foon, Dataset):
        return foon.world()
    if not isinstance(foon, Foon) or not isinstance(kitchen, Kitchen):
        raise QueryError(f"a world is seen of a Foon, not {said(foon)}; load reads files, read makes a Foon")
    return ModelWorld.of(foon, kitchen)


def _how_many(value: int, name: str = "count") -> int:
    """Return how many are asked for; raise `QueryError` if that is no whole number from 1."""
    return int(SOME.checked(value, name))


def _several(goals: Asked | Iterable[Named]) -> list[Named]:
    """Return one goal, or several, as a list."""
    return [goals] if isinstance(goals, str | ObjectNode) else a_list(goals, "goals", "objects")


def _node(named: Named) -> ObjectNode:
    return named if isinstance(named, ObjectNode) else written_object(named)


@contextmanager
def _without_main() -> Iterator[None]:
    """Start processes that do not run the caller's script again, which need not guard its main part so."""
    main = sys.modules["__main__"]
    sys.modules["__main__"] = ModuleType("__main__")
    try:
        yield
    finally:
        sys.modules["__main__"] = main


_opened: ModelWorld | None = None
"""The world that a process of `answer_many` answers from."""


def _open(world: ModelWorld) -> None:
    global _opened
    _opened = world


_Ids = tuple[tuple[ObjectId, ...], tuple[UnitId, ...], tuple[int, ...], Replay, frozenset[UnitId]]
"""What a task tree is beside its world."""


def _answer(query: Query) -> tuple[Answer, _Ids | None]:
    """Answer a query in a process; the world is there on the other side, and only what differs travels."""
    assert _opened is not None
    answer = retrieve(_opened, query)
    tree = answer.tree
    if tree is None or tree.record is not None:
        # One with replacements has a world of its own.
        return answer, None
    ids = (tree.goals, tree.units, tree.rounds, tree.replay, tree.human)
    return replace(answer, tree=None), ids


def load(folder: str | Path | None = None, **files: Unpack[SourceKeys]) -> World:
    """Return the world of a data folder, of the built-in kitchen by default.

    A folder has `FOON.txt` (or subgraphs `*.txt`), and may have `kitchen.json`, `motion.txt` (success rates),
    `motion_cost.json`, `utensils.txt` and `goal_nodes.json`; `foon=[…]`, `kitchen=…`, `rates=…`, `costs=…`,
    `utensils=…`, `goals=…` name other files. `strict=True` needs every input, `level=2` shows less detail;
    with `vocabulary="as-written"` words of older FOON text, like `ingredients inside`, stay as they are.
    Raises `InputError`, and warns (`FoonWarning`) if something in a FOON file is lost; `World.findings` has
    all that is odd.
    """
    dataset = load_dataset(folder, **files)
    _warn_of_losses(dataset.findings)
    return World(dataset)


def _warn_of_losses(findings: Iterable[Finding]) -> None:
    """Warn the caller of the caller of whatever could not be read."""
    lost = [
        f"{each.file}:{each.line}: {each.message}" for each in findings if each.severity is Severity.ERROR
    ]
    if lost:
        warnings.warn(shortened(lost, mark=";"), FoonWarning, stacklevel=3)


Unit = tuple[Iterable[Named], str, Iterable[Named]] | Step
"""A functional unit as values: its inputs, its motion, its outputs; a step of a task tree is one, too."""


def read(units: str | Iterable[Unit], *, vocabulary: VocabularyName = "current") -> Foon:
    """Return a FOON of values, without a file: of FOON text or JSON, or of units.

    A unit is `(inputs, motion, outputs)`, with one input at least; objects are object nodes or texts as in
    goals. With the vocabulary "as-written" words of older FOON text stay as they are. Raises `InputError` for
    a text that is no FOON, `QueryError` for what cannot be read; warns (`FoonWarning`) if something in a text
    is lost.
    """
    if isinstance(units, str):
        reader = FoonReader(words=vocabulary)
        reader.read_data(_encoded(units), Path("<text>"))
        files = reader.finish()
        _warn_of_losses(files.findings)
        return files.foon
    builder = FoonBuilder()
    _add_units(builder, units)
    foon = builder.build()
    _refuse_from_nothing(foon)
    return foon


def _refuse_from_nothing(foon: Foon) -> None:
    """Raise `QueryError` if a unit has no input, as units of files have that are left out."""
    for unit in foon.units:
        if not unit.inputs:
            raise QueryError(f"nothing is made from nothing: a unit of {said(unit.motion)} has no input")


def _add_units(builder: FoonBuilder, units: Iterable[Unit]) -> None:
    for unit in a_list(units, "units", "functional units"):
        inputs, motion, outputs = _sides(unit)
        before, behind = ([builder.object(_node(each)) for each in side] for side in (inputs, outputs))
        builder.unit(motion, before, behind, Annotation())


Tree = str | Path | Foon | Iterable[Unit]
"""A task tree to be checked: a file, which may hold several; a FOON; units as values, in their order."""


class CheckKeys(TypedDict, total=False):
    """How trees are judged, as the flags of `foon-asp check` say it."""

    kitchen: Kitchen | Iterable[Named] | None
    utensils: Iterable[str] | None
    semantics: str
    match_relations: Matching
    strict: bool
    mend: bool
    vocabulary: VocabularyName
    time_limit: float | None
    memory_limit: float | None


def check(*trees: Tree, known: World | None = None, **asked: Unpack[CheckKeys]) -> Checks:
    """Replay task trees that someone else made, each in its own order, and say what is wrong with them.

    Steps that are likely missing are looked for in a `known` world, the built-in one by default, whose
    utensils hold. `kitchen` is what is at hand, without it all that no unit of a tree makes; `utensils` are
    all there are; `semantics` says what is used up ("add": nothing, "transform", "consume");
    `match_relations="strict"` tells `on` from `in`; `strict=True` needs every input; `mend=True` looks for
    the fewest edits, too. Raises `InputError` for a file that cannot be read, and `QueryError`.
    """
    if unknown := asked.keys() - CheckKeys.__annotations__.keys():
        raise TypeError(f"check() got an unexpected keyword argument {min(unknown)!r}")
    world = load() if known is None else known
    if not isinstance(world, World):
        raise QueryError(f"what is known is a World, not {said(world)}; load makes one of files")
    kitchen, utensils = asked.get("kitchen"), asked.get("utensils")
    if kitchen is not None and not isinstance(kitchen, Kitchen):
        kitchen = Kitchen(tuple(_node(each) for each in a_list(kitchen, "kitchen", "objects")))
    query = CheckQuery(
        kitchen,
        world.kitchen.utensils if utensils is None else frozenset(a_list(utensils, "utensils", "labels")),
        utensils is not None,
        asked.get("semantics", "add"),
        asked.get("match_relations", "loose"),
        asked.get("strict", False),
        asked.get("mend", False),
        asked.get("time_limit"),
        asked.get("memory_limit"),
    )
    files = _tree_files(trees, asked.get("vocabulary", "current"))
    for file in files:
        _refuse_from_nothing(file.foon)
    _warn_of_losses([finding for file in files for finding in file.findings])
    return check_trees(trees_beside(world.foon, files), query)


class ConsolidateKeys(TypedDict, total=False):
    """How trees are made into one, as the flags of `foon-asp consolidate` say it."""

    goal: Named | None
    by: str | Iterable[str] | Objective
    costs: str | Path | Mapping[str, float]
    default_cost: float | None
    states: str | Path | Iterable[Iterable[str]]
    locations: str | Path | Iterable[Iterable[str]]
    motions: str | Path | Iterable[Iterable[str]]
    adjacent: bool
    kitchen: Kitchen | Iterable[Named] | None
    utensils: Iterable[str]
    likeness: Likeness | str | Iterable[str | Replacement] | None
    least_likeness: float
    constraints: Constraints | None
    strict: bool
    match_relations: Matching
    vocabulary: VocabularyName
    time_limit: float | None
    memory_limit: float | None


def consolidate(*trees: Tree, **asked: Unpack[ConsolidateKeys]) -> Consolidation:
    """Make several trees of one dish into one: the best that their sound steps allow, proven.

    `goal` is what it is for, without one what most trees are for. `by` says what it is best by: what motions
    cost, if `costs` are named (a file, or a dictionary), else the number of steps. `states`, `locations` and
    `motions` are the orders in which these may come (files, or lists of lists); with `adjacent=True` only the
    next word of an order may follow. `kitchen` is what is at hand, without it what no unit of the trees
    makes. `likeness` says how alike two labels are in meaning: a function of both, from 0 to 1, or as
    `substitute` of a `Query` "vectors" and replacements; those of `least_likeness` are taken for one. Raises
    `InputError` for a file that cannot be read, and `QueryError`.
    """
    if unknown := asked.keys() - ConsolidateKeys.__annotations__.keys():
        raise TypeError(f"consolidate() got an unexpected keyword argument {min(unknown)!r}")
    goal = asked.get("goal")
    question = Query(
        *(() if goal is None else (goal,)),
        by=asked.get("by", ()),
        constraints=asked.get("constraints"),
        time_limit=asked.get("time_limit"),
        memory_limit=asked.get("memory_limit"),
    )
    query = ConsolidateQuery(
        question,
        _kitchen(asked),
        {
            "state": _orders(asked.get("states", ()), "states"),
            "location": _orders(asked.get("locations", ()), "locations"),
            "motion": _orders(asked.get("motions", ()), "motions"),
        },
        asked.get("adjacent", False),
        _measure(asked),
        asked.get("strict", False),
        asked.get("match_relations", "loose"),
    )
    files = _tree_files(trees, asked.get("vocabulary", "current"))
    _warn_of_losses([finding for file in files for finding in file.findings])
    return consolidate_trees(trees_beside(FoonBuilder().build(), files), query)


def _measure(asked: ConsolidateKeys) -> Measure | None:
    """Return which labels mean the same, if anything says that."""
    given = asked.get("likeness")
    if given is None:
        return None
    least = LIKENESS.checked(asked.get("least_likeness", LEAST_LIKENESS), "least_likeness")
    if callable(given):
        return Measure(given, least)
    substitution = Substitution.of(given)
    return None if substitution is None else Measure(substitution.alike(), least)


def _kitchen(asked: ConsolidateKeys) -> Kitchen:
    """Return what is at hand, if that is said, and what motions cost."""
    given, costs = asked.get("kitchen"), asked.get("costs", {})
    if not isinstance(given, Kitchen):
        listed = () if given is None else a_list(given, "kitchen", "objects")
        given = Kitchen(tuple(map(_node, listed)), stated=given is not None)
    named = read_costs(Path(costs)) if isinstance(costs, str | Path) else costs
    utensils = frozenset(a_list(asked.get("utensils", ()), "utensils", "labels"))
    return replace(
        given,
        utensils=given.utensils | utensils,
        costs=named or given.costs,
        default_cost=asked.get("default_cost", given.default_cost),
    )


def _orders(given: str | Path | Iterable[Iterable[str]], name: str) -> Orders:
    return read_orders(Path(given)) if isinstance(given, str | Path) else stated_orders(given, name)


def _tree_files(trees: Iterable[Tree], words: VocabularyName) -> list[TreeFile]:
    return [_tree_file(tree, f"tree {place}", words) for place, tree in enumerate(trees, 1)]


def _tree_file(tree: Tree, name: str, words: VocabularyName) -> TreeFile:
    builder = TreeBuilder(words)
    if isinstance(tree, str | Path):
        return builder.read_file(Path(tree))
    if isinstance(tree, Foon):
        builder.include(tree)
    else:
        _add_units(builder, tree)
    return builder.file(name)


def _encoded(text: str) -> bytes:
    try:
        return text.encode("utf-8")
    except UnicodeEncodeError as error:
        line = text.count("\n", 0, error.start) + 1
        problem = f"{said(text[error.start])} is half of a surrogate pair, which is no character"
        raise InputError("<text>", line, problem, "decode the text as UTF-8") from None


def _sides(unit: object) -> tuple[list[Named], str, list[Named]]:
    """Return the inputs, the motion and the outputs of a unit; raise `QueryError` for what is none."""
    if isinstance(unit, Step):
        return list(unit.takes), unit.motion, list(unit.outputs)
    if not isinstance(unit, tuple) or len(unit) != 3:
        raise QueryError(f"a unit is (inputs, motion, outputs), not {said(unit)}")
    inputs, motion, outputs = unit
    check_label(motion, "a motion")
    return a_list(inputs, "inputs", "objects"), motion, a_list(outputs, "outputs", "objects")
