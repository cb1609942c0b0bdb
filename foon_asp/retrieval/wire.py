"""What the answers are as JSON: each shape declared once, beside the function that makes it."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Any, Literal

from msgspec import UNSET, Meta, UnsetType, structs, to_builtins

from foon_asp.io.object_wire import ObjectJson, UnitJson, object_to_json
from foon_asp.io.wire import (
    FEW,
    UNIQUE,
    Amount,
    Chance,
    Count,
    JsonObject,
    LimitName,
    Place,
    Text,
    means,
    word,
)
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, UnitId
from foon_asp.model.world import World
from foon_asp.query.objective import CRITERIA, Costs

if TYPE_CHECKING:
    # The answers import this module, to write themselves.
    from foon_asp.retrieval.alternatives import Alternatives
    from foon_asp.retrieval.answer import Answer
    from foon_asp.retrieval.compare import HumanTable, Row
    from foon_asp.retrieval.menu import Menu
    from foon_asp.retrieval.suggest import Suggestions
    from foon_asp.retrieval.trace import Bound
    from foon_asp.retrieval.tree import TaskTree

_TERM = rf"(\d+(\.\d+)?\*)?({'|'.join(CRITERIA)})"

Criteria = Annotated[str, Meta(pattern=rf"^{_TERM}(\+{_TERM})*$")]
"""What is minimised together: a criterion, or a weighted sum of several like 2*units+inputs."""

Best = Annotated[
    dict[Criteria, Amount],
    Meta(
        min_length=1,
        extra_json_schema={
            "properties": {
                "success": {
                    "type": "number",
                    "minimum": 0,
                    "maximum": 1,
                    "description": "No tree has a higher chance of success.",
                }
            }
        },
    ),
    means(
        "For each member of `by`, by its text, what no tree can beat among those that are best by the "
        "members before it: for success alone, weighted or not, the highest chance, else the lowest "
        "cost, in which success counts as -ln of the chance."
    ),
]
"""What is proven when the time ran out."""


class CostsJson(JsonObject):
    """What a tree costs."""

    units: Annotated[Count, means("Functional units.")]
    inputs: Annotated[Count, means("Input objects, summed over the units.")]
    success: Annotated[
        Chance | None,
        means("The product of the success rates of what the robot does; null if a rate is unknown."),
    ]
    depth: Annotated[
        Count | None, means("Rounds of parallel execution; null if the tree cannot be executed.")
    ]
    tools: Annotated[
        Count, means("Distinct utensils that are handled; 0 if the data do not say what is a utensil.")
    ]
    dirty: Annotated[
        Count, means("Distinct utensils that hold something; 0 if the data do not say what is a utensil.")
    ]
    motions: Annotated[Count, means("Distinct motions.")]
    time: Annotated[
        Count, means("Seconds of annotated video, summed over the units for which they are known.")
    ]
    human: Annotated[Count, means("Units that a human does.")]
    cost: Annotated[
        Amount | None, means("What the motions cost together; null where nothing says that of one of them.")
    ]


class TreeUnitJson(UnitJson):
    """A functional unit of a tree."""

    agent: Annotated[Literal["robot", "human"], means("Who does it; a human never fails.")]
    tools: Annotated[
        list[ObjectJson] | UnsetType,
        means(
            "What it lists behind its motion alone and does not make: utensils without states. Left out "
            "where there are none."
        ),
    ] = UNSET


Goal = Annotated[ObjectJson, means("The object node that was asked for.")]
Method = Annotated[Literal["optimal", "greedy", "ids", "first"], means("How units were chosen.")]
By = Annotated[
    list[Criteria], UNIQUE, FEW, means("The criteria or sums of criteria, the most important first.")
]
AnyBy = Annotated[
    list[Criteria],
    UNIQUE,
    means(
        "The criteria or sums of criteria, the most important first; empty for the methods that take none."
    ),
]
Founded = Annotated[
    bool, means("False if foundedness was dropped (--reference): then the tree may go in circles.")
]
ConstraintNames = Annotated[
    list[Text],
    means(
        "The names of the constraints that hold, as docs/constraints.md has them; rules files are one "
        "together, `rules`. Empty if there are none."
    ),
]
Reason = Annotated[str, means("Why no task tree exists; empty unless the status is unreachable.")]
Status = Annotated[
    Literal["optimal", "found", "unreachable", "limit"],
    means(
        "optimal: proven minimum by the criteria. found: by a method that proves nothing about the "
        "criteria. unreachable: no task tree exists. limit: the time ran out; the tree, if any, is "
        "the best so far."
    ),
]
Optimality = Annotated[
    Literal["optimal", "unreachable", "limit"],
    means(
        "optimal: proven minimum by the criteria. unreachable: no task tree exists. limit: the time "
        "ran out; the tree, if any, is the best so far."
    ),
]
Executable = Annotated[
    bool,
    means(
        "Whether the replay of the units, in order, from the kitchen reaches the goal; false if "
        "there is no tree."
    ),
]
Size = Annotated[Count | None, means("Functional units in the tree; null if there is no tree.")]
Depth = Annotated[
    Count | None,
    means("Rounds of parallel execution until the goal; null if there is no tree or it cannot be executed."),
]
SomeCosts = Annotated[
    CostsJson | None,
    means("What the tree costs by each criterion, asked for or not; null if there is no tree."),
]
TreeUnits = Annotated[
    list[TreeUnitJson],
    means("The functional units in the order of execution; empty if there is no tree, or nothing to do."),
]
Proven = Annotated[
    Best | None,
    means(
        "What is proven of the criteria asked for when the time ran out (status limit, method "
        "optimal), or of those by which costs had to be rounded so much that the tree may not be best "
        "within a factor of 1.00001 (status optimal); null otherwise."
    ),
]
Own = Annotated[
    dict[Annotated[str, Meta(pattern="^-?[0-9]+$")], int],
    means("What the tree pays by criteria of one's own rules, for each priority that is not a built-in one."),
]


def costs_json(costs: Costs) -> CostsJson:
    """Return what a tree costs."""
    return CostsJson(**{name: getattr(costs, name) for name in CRITERIA})


def some_costs_json(tree: TaskTree | None) -> CostsJson | None:
    """Return what a tree costs, or None where there is no tree."""
    return None if tree is None else costs_json(tree.costs)


def objects_json(nodes: Iterable[ObjectNode]) -> list[ObjectJson]:
    """Return some objects, in their order."""
    return [object_to_json(node) for node in nodes]


class BoundJson(JsonObject):
    """What iterative deepening explores with one limit of depth."""

    limit: Annotated[Count, means("How many units deep the search may go.")]
    explored: Annotated[
        list[ObjectJson], means("The objects in the order in which they are explored, depth first.")
    ]
    reached: Annotated[bool, means("Whether the goal can be made within the limit.")]


def trace_json(world: World, bounds: Iterable[Bound]) -> list[BoundJson]:
    """Return the trace of iterative deepening, one member for each limit."""
    return [
        BoundJson(
            bound.limit, objects_json(world.node(object_id) for object_id, _ in bound.explored), bound.reached
        )
        for bound in bounds
    ]


class ReplacementJson(JsonObject):
    """A label that was replaced in the whole tree."""

    label: Annotated[Text, means("What the data call it.")]
    by: Annotated[Text | None, means("What replaces it; null if it is left out.")]
    likeness: Annotated[Chance, means("How well it does so; at 1 nobody would notice.")]
    why: Annotated[Text, means("Who says so: the note of a table, or the measure.")]


Replacements = Annotated[
    list[ReplacementJson] | UnsetType,
    means("With substitution: what was replaced or left out, with which `units` are shown."),
]


def _replacements(answer: Answer) -> list[ReplacementJson] | UnsetType:
    if answer.query.substitute is None:
        return UNSET
    rows = () if answer.tree is None else answer.tree.replacements
    return [ReplacementJson(row.label, row.by, row.likeness, row.why) for row in rows]


class RetrievalJson(JsonObject):
    """The answer to one goal."""

    goal: Goal
    method: Method
    by: AnyBy
    founded: Founded
    constraints: ConstraintNames
    status: Status
    reason: Reason
    executable: Executable
    size: Size
    depth: Depth
    costs: SomeCosts
    units: TreeUnits
    bound: Proven
    own: Own
    seconds: Annotated[Amount, means("Wall time of the retrieval, without reading the files.")]
    limit: LimitName
    replacements: Replacements = UNSET
    trace: Annotated[
        list[BoundJson] | UnsetType,
        means("With --trace: what iterative deepening explores with each limit of depth."),
    ] = UNSET


def retrieval_json(
    result: Answer,
    trace: list[BoundJson] | UnsetType = UNSET,
    *,
    units: list[TreeUnitJson] | None = None,
) -> RetrievalJson:
    """Return what `retrieve --format json` writes for one goal; `trace` is what `--trace` adds.

    `units` are written instead of those of the tree.
    """
    tree = result.tree
    if units is None:
        units = [] if tree is None else _tree_units(tree)
    costs = some_costs_json(tree)
    return RetrievalJson(
        goal=object_to_json(result.goal),
        method=word(result.query.method),
        by=list(result.by),
        founded=result.query.founded,
        constraints=result.query.constraints.names,
        status=word(result.status),
        reason=result.reason,
        executable=tree is not None and tree.executable,
        size=None if costs is None else costs.units,
        depth=None if costs is None else costs.depth,
        costs=costs,
        units=units,
        bound=result.bound or None,
        own={str(priority): paid for priority, paid in result.own.items()},
        seconds=round(result.seconds, 6),
        limit=result.limit,
        replacements=_replacements(result),
        trace=trace,
    )


class TreeJson(JsonObject):
    """A task tree."""

    executable: Annotated[
        bool, means("Whether the replay of the units, in order, from the kitchen reaches the goal.")
    ]
    size: Annotated[Count, means("Functional units in the tree.")]
    depth: Annotated[
        Count | None,
        means("Rounds of parallel execution, of all units; null if the tree cannot be executed."),
    ]
    costs: Annotated[CostsJson, means("What the tree costs by each criterion, asked for or not.")]
    units: Annotated[
        list[TreeUnitJson],
        means("The functional units in the order of execution; empty if there is nothing to do."),
    ]


def _tree_units(tree: TaskTree) -> list[TreeUnitJson]:
    rows = zip(tree.functional_units, tree.numbers, strict=True)
    return [structs.replace(_tree_unit(tree, unit), id=number) for unit, number in rows]


def _tree_unit(tree: TaskTree, unit: FunctionalUnit) -> TreeUnitJson:
    world = tree.world
    return TreeUnitJson.of(world.foon, unit, agent=_agent(tree, unit), tools=_tools(world, unit))


_WRITTEN = 1 << 14
"""How many units are kept as they were written; each takes about a kilobyte."""


def unit_texts(tree: TaskTree) -> list[str]:
    """Return the units of a tree as JSON in one line each, as `json.dumps` writes it.

    The units of a FOON are written once, and those of its trees are among them.
    """
    if tree.record is not None:
        return [_unit_text(unit) for unit in _tree_units(tree)]
    written = tree.world.units.written
    texts = []
    for number in tree.units:
        key = number, number in tree.human
        text = written.get(key)
        if text is None:
            if len(written) >= _WRITTEN:
                written.clear()
            unit = tree.world.foon.units[number]
            text = written[key] = _unit_text(_tree_unit(tree, unit))
        texts.append(text)
    return texts


def _unit_text(unit: TreeUnitJson) -> str:
    return json.dumps(to_builtins(unit), ensure_ascii=False)


def _tools(world: World, unit: FunctionalUnit) -> list[ObjectJson] | UnsetType:
    """Return the bare outputs of which only the utensils of a world tell that the unit does not make them."""
    before = {world.node(number).label for number in unit.inputs}
    made = world.units.makes[unit.id]
    nodes = (world.node(number) for number in unit.outputs if number not in made)
    return objects_json(node for node in nodes if node.bare and node.label not in before) or UNSET


def _agent(tree: TaskTree, unit: FunctionalUnit) -> Literal["robot", "human"]:
    return "human" if unit.id in tree.human else "robot"


def tree_json(tree: TaskTree) -> TreeJson:
    """Return a task tree: what it costs, and its units in the order of execution, with who does them."""
    costs = costs_json(tree.costs)
    return TreeJson(
        executable=tree.executable, size=costs.units, depth=costs.depth, costs=costs, units=_tree_units(tree)
    )


class AlternativesJson(JsonObject):
    """Several trees for one goal: the answer to -n, --all-optimal, --diverse or --pareto."""

    goal: Goal
    kind: Annotated[
        Literal["best", "all optimal", "diverse", "pareto"],
        means(
            "What was asked for: best (-n), all optimal (--all-optimal), diverse (--diverse) or pareto "
            "(--pareto)."
        ),
    ]
    by: Annotated[
        list[Criteria],
        UNIQUE,
        FEW,
        means(
            "The criteria or sums of criteria, the most important first; for pareto, those that are "
            "weighed against each other."
        ),
    ]
    constraints: ConstraintNames
    status: Annotated[
        Literal["optimal", "unreachable", "limit"],
        means(
            "optimal: each tree is proven to have its place. unreachable: no task tree exists. limit: "
            "the time ran out; the trees that are there are proven."
        ),
    ]
    reason: Reason
    complete: Annotated[bool, means("Whether there are known to be no other trees of this kind.")]
    proven: Annotated[
        bool,
        means(
            "Whether the trees are proven to have their places in the list; if not, there is at most one "
            "tree, which is just some tree."
        ),
    ]
    trees: Annotated[
        list[TreeJson],
        UNIQUE,
        means(
            "The trees, the best first; no two have the same units. Empty if there is none, or none in time."
        ),
    ]
    seconds: Annotated[Amount, means("Wall time of the retrieval, without reading the files.")]
    limit: LimitName


def alternatives_json(result: Alternatives) -> AlternativesJson:
    """Return what `retrieve --format json` writes for one goal where several trees were asked for."""
    return AlternativesJson(
        goal=object_to_json(result.goal),
        kind=word(result.kind),
        by=list(result.by),
        constraints=result.query.constraints.names,
        status=word(result.status),
        reason=result.reason,
        complete=result.complete,
        proven=result.proven,
        trees=[tree_json(tree) for tree in result.trees],
        seconds=round(result.seconds, 6),
        limit=result.limit,
    )


class MenuUnitJson(TreeUnitJson, kw_only=True):
    """A functional unit of the tree for all dishes."""

    dishes: Annotated[
        list[ObjectJson],
        means(
            "The dishes that it is for, in the order in which they were named; empty for a unit that is "
            "superfluous, be it in a tree that is not proven or because of a constraint."
        ),
    ]


class MenuTreeJson(JsonObject):
    """A task tree, if there is one."""

    executable: Annotated[
        bool,
        means(
            "Whether the replay of the units, in order, from the kitchen makes all dishes; false if there is "
            "no tree."
        ),
    ]
    size: Size
    depth: Annotated[
        Count | None,
        means("Rounds of parallel execution, of all units; null if there is no tree."),
    ]
    costs: SomeCosts
    units: Annotated[
        list[MenuUnitJson],
        means("The functional units in the order of execution; empty if there is no tree, or nothing to do."),
    ]


class MenuDishJson(JsonObject):
    """A dish, cooked alone."""

    goal: Goal
    status: Optimality
    reason: Reason
    costs: Annotated[
        CostsJson | None, means("What its tree costs by each criterion; null if there is no tree.")
    ]


class LeftOutJson(JsonObject):
    """A dish that cannot be made."""

    goal: Goal
    reason: Annotated[Text, means("Why no task tree exists.")]


class MenuJson(JsonObject):
    """One task tree for several dishes, and what each of them costs apart."""

    by: By
    constraints: ConstraintNames
    status: Annotated[
        Literal["optimal", "unreachable", "limit"],
        means(
            "Of the tree for all dishes. optimal: proven minimum by the criteria. unreachable: no task "
            "tree exists. limit: the time ran out; the tree, if any, is the best so far."
        ),
    ]
    reason: Reason
    together: Annotated[MenuTreeJson, means("The tree for all dishes but those left out.")]
    bound: Annotated[
        Best | None,
        means("What is proven of each member of `by` when the time ran out (status limit); null otherwise."),
    ]
    apart: Annotated[
        list[MenuDishJson],
        means("Each dish that is not left out, cooked alone, in the order in which they were named."),
    ]
    left_out: Annotated[
        list[LeftOutJson], means("Dishes that no tree makes, if these were to be left out (--leave-out).")
    ]
    seconds: Annotated[Amount, means("Wall time for the tree for all dishes, without reading the files.")]
    limit: LimitName


def menu_json(menu: Menu) -> MenuJson:
    """Return what `menu --format json` writes."""
    together = menu.together
    return MenuJson(
        by=list(together.by),
        constraints=together.query.constraints.names,
        status=word(together.status),
        reason=together.reason,
        together=_menu_tree(menu),
        bound=together.bound or None,
        apart=[
            MenuDishJson(
                object_to_json(each.goal), word(each.status), each.reason, some_costs_json(each.tree)
            )
            for each in menu.apart
        ],
        left_out=[LeftOutJson(object_to_json(each.goal), each.reason) for each in menu.left_out],
        seconds=round(together.seconds, 6),
        limit=together.limit,
    )


def _menu_tree(menu: Menu) -> MenuTreeJson:
    """Return the tree for all dishes; where there is none nothing is known of its costs."""
    tree = menu.together.tree
    if tree is None:
        return MenuTreeJson(executable=False, size=None, depth=None, costs=None, units=[])
    costs = costs_json(tree.costs)
    units = [
        MenuUnitJson.of(
            tree.world.foon,
            unit,
            agent=_agent(tree, unit),
            tools=_tools(tree.world, unit),
            dishes=objects_json(menu.dishes[unit.id]),
        )
        for unit in tree.functional_units
    ]
    return MenuTreeJson(
        executable=tree.executable, size=costs.units, depth=costs.depth, costs=costs, units=units
    )


class CellJson(JsonObject):
    """The tree that a method retrieved."""

    units: Annotated[Count | None, means("Functional units in the tree; null if there is no tree.")]
    executable: Annotated[
        bool | None,
        means(
            "Whether the tree passes its replay; false if there is no tree, null if nobody can tell (the "
            "paper's own figures)."
        ),
    ]
    proven: Annotated[
        bool, means("With a tree: it is proven optimal. Without one: it is proven that none exists.")
    ]


class ComparisonRowJson(JsonObject, kw_only=True):
    """One goal and a cell for each method."""

    goal: Goal
    paper_ids: Annotated[CellJson | UnsetType, means("As published: iterative deepening search.")] = UNSET
    paper_success: Annotated[
        CellJson | UnsetType, means("As published: heuristic 1, highest success rate.")
    ] = UNSET
    paper_inputs: Annotated[CellJson | UnsetType, means("As published: heuristic 2, fewest inputs.")] = UNSET
    first_reference: Annotated[CellJson, means("Method first, reference reading.")]
    greedy_success_reference: Annotated[
        CellJson | UnsetType, means("Method greedy by success, reference reading.")
    ] = UNSET
    greedy_inputs_reference: Annotated[CellJson, means("Method greedy by inputs, reference reading.")]
    first: Annotated[CellJson, means("Method first, founded.")]
    ids: Annotated[CellJson, means("Method ids.")]
    greedy_success: Annotated[CellJson | UnsetType, means("Method greedy by success, founded.")] = UNSET
    greedy_inputs: Annotated[CellJson, means("Method greedy by inputs, founded.")]
    optimal: Annotated[CellJson, means("Method optimal by units, founded.")]


def comparison_json(rows: Iterable[Row]) -> list[ComparisonRowJson]:
    """Return what `compare --format json` writes."""
    return [
        ComparisonRowJson(
            goal=object_to_json(row.goal),
            **{name: CellJson(cell.units, cell.executable, cell.proven) for name, cell in row.cells.items()},
        )
        for row in rows
    ]


class HumanStepsJson(JsonObject):
    """The likeliest tree where a human may do so many steps."""

    human_steps: Annotated[Count, means("How many steps a human may do.")]
    success: Annotated[
        Chance | None,
        means("The product of the success rates of what the robot does; null if no tree was found in time."),
    ]
    units: Annotated[Count | None, means("Functional units in the tree; null if no tree was found in time.")]
    human: Annotated[
        list[Count], UNIQUE, means("The ids of the units that the human does, in ascending order.")
    ]
    proven: Annotated[bool, means("Whether no tree and no split has a higher chance.")]


class HumanTableJson(JsonObject):
    """One goal, and a tree for each number of human steps."""

    goal: Goal
    reason: Annotated[str, means("Why no task tree exists; empty if there is one.")]
    steps: Annotated[
        list[HumanStepsJson],
        means(
            "The trees for 0, 1, 2, … human steps, until nothing can fail or --human-steps is reached; "
            "empty if no task tree exists."
        ),
    ]


def human_json(table: HumanTable) -> HumanTableJson:
    """Return what `compare --human --format json` writes for one goal."""
    steps = [
        HumanStepsJson(
            human_steps=count,
            success=tree.costs.success if tree else None,
            units=len(tree.units) if tree else None,
            human=sorted(tree.human) if tree else [],
            proven=proven,
        )
        for count, (tree, proven) in enumerate(table.trees)
    ]
    return HumanTableJson(object_to_json(table.goal), table.reason, steps)


class ReachJson(JsonObject):
    """What the kitchen can make."""

    objects: Annotated[Count, means("Object nodes that the FOON knows.")]
    available: Annotated[
        Count,
        means(
            "Object nodes in the kitchen or makeable from it; counts kitchen objects that the FOON does "
            "not know."
        ),
    ]
    units: Annotated[Count, means("Functional units of the FOON.")]
    executable: Annotated[Count, means("Functional units that can be executed from the kitchen.")]
    makeable: Annotated[
        list[ObjectJson],
        means("The available objects that are not in the kitchen, in the order of the FOON file."),
    ]


def reach_json(world: World, available: Iterable[ObjectId], executable: Iterable[UnitId]) -> ReachJson:
    """Return what `reach --format json` writes."""
    available = list(available)
    return ReachJson(
        objects=len(world.foon.objects),
        available=len(available),
        units=len(world.foon.units),
        executable=len(list(executable)),
        makeable=objects_json(
            world.node(object_id) for object_id in available if object_id not in world.stock
        ),
    )


class SuggestionJson(JsonObject):
    """A dish and its best task tree, which is proven to be best."""

    dish: Annotated[ObjectJson, means("The object node that is made.")]
    costs: Annotated[CostsJson, means("What its best tree costs by each criterion, asked for or not.")]
    units: Annotated[
        list[Count],
        UNIQUE,
        FEW,
        means("The ids of the functional units of the tree, in the order of execution; the U of the facts."),
    ]


class SuggestionsJson(JsonObject):
    """What can be cooked from a kitchen, ranked by criteria."""

    by: By
    using: Annotated[
        list[Text], UNIQUE, means("What the dishes are really made with: labels; empty if any dish will do.")
    ]
    constraints: ConstraintNames
    candidates: Annotated[
        Count, means("How many dishes the kitchen can make, whatever the constraints and ingredients.")
    ]
    found: Annotated[
        Count,
        means(
            "How many of them are made with the ingredients, under the constraints; more than are listed "
            "if only the best were asked for."
        ),
    ]
    skipped: Annotated[
        Count,
        means(
            "How many were not solved before the time ran out; any of these might be among the dishes, too."
        ),
    ]
    dishes: Annotated[list[SuggestionJson], means("The dishes, the best first, equally good ones by name.")]
    seconds: Annotated[Amount, means("Wall time, without reading the files.")]
    limit: LimitName


def suggestions_json(result: Suggestions, count: int | None = None) -> SuggestionsJson:
    """Return what `suggest --format json` writes, with all dishes or the best so many."""
    return SuggestionsJson(
        by=list(result.by),
        using=list(result.using),
        constraints=result.query.constraints.names,
        candidates=result.candidates,
        found=len(result.dishes),
        skipped=result.skipped,
        dishes=[
            SuggestionJson(object_to_json(each.dish), costs_json(each.costs), list(each.tree.units))
            for each in result.dishes[:count]
        ],
        seconds=round(result.seconds, 6),
        limit=result.limit,
    )


Line = Annotated[Place, means("The line of the query file.")]
Id = Annotated[str | int | float | None, means("What the query gave as its id; null if it gave none.")]


class AnswerRowJson(JsonObject, kw_only=True):
    """The answer to a query: what `retrieve --format json` writes."""

    line: Line
    status: Status
    id: Id
    goals: (
        Annotated[
            list[ObjectJson],
            Meta(min_length=2),
            means("The goals, if the query has several; they are made by one tree."),
        ]
        | UnsetType
    ) = UNSET
    goal: Annotated[ObjectJson, means("The object node that was asked for, or the first of several.")]
    method: Method
    by: AnyBy
    founded: Founded
    constraints: ConstraintNames
    reason: Reason
    executable: Executable
    size: Size
    depth: Depth
    costs: SomeCosts
    units: TreeUnits
    bound: Proven
    own: Own
    seconds: Annotated[Amount | UnsetType, means("Wall time of the query; only with --timings.")] = UNSET
    limit: LimitName
    replacements: Replacements = UNSET


def row_json(
    line: int,
    name: str | float | None,
    result: Answer,
    *,
    timings: bool,
    units: list[TreeUnitJson] | None = None,
) -> AnswerRowJson:
    """Return the row of a batch for a query that was answered; `name` is the id that the query gave.

    `units` are written instead of those of the tree.
    """
    answer: dict[str, Any] = structs.asdict(retrieval_json(result, units=units))
    del answer["trace"]
    if len(result.goals) > 1:
        answer["goals"] = objects_json(result.goals)
    if not timings:
        del answer["seconds"]
    return AnswerRowJson(line=line, id=name, **answer)


class ErrorRowJson(JsonObject):
    """What is wrong with a query."""

    line: Line
    status: Annotated[Literal["error"], means("The query could not be answered.")]
    id: Id
    error: Annotated[Text, means("What is wrong with the query, in one sentence.")]


def error_row_json(line: int, name: str | float | None, problem: str) -> ErrorRowJson:
    """Return the row of a batch for a query without an answer; `problem` says in a sentence what is wrong."""
    return ErrorRowJson(line, "error", name, problem)
