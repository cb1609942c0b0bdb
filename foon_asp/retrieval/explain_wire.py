"""What an explanation is as JSON: each shape declared once, and the function that makes it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Literal

from foon_asp.io.object_wire import ObjectJson, UnitJson, object_to_json
from foon_asp.io.wire import FEW, UNIQUE, Amount, Count, JsonObject, LimitName, Place, means, word
from foon_asp.model.world import World
from foon_asp.retrieval.wire import CostsJson, objects_json, some_costs_json

if TYPE_CHECKING:
    # The explanation imports this module, to write itself.
    from foon_asp.retrieval.explain import Deadlock, Explanation, MissingObject
    from foon_asp.retrieval.nearest import Near
    from foon_asp.retrieval.steps import Instead, StepRole


class NearJson(JsonObject):
    """Something that resembles an object."""

    object: Annotated[ObjectJson, means("The object.")]
    at_hand: Annotated[bool, means("Whether the kitchen has it; else the kitchen can make it.")]


class MissingThingJson(JsonObject):
    """An object that the kitchen would have to have."""

    object: Annotated[ObjectJson, means("The object.")]
    raw: Annotated[
        bool, means("Whether no unit makes it, or it is a utensil with nothing in it; else it is prepared.")
    ]
    same_dish: Annotated[bool, means("Whether it is the goal in another state, vessel or place.")]
    nearest: Annotated[list[NearJson], means("What there is that resembles it, the nearest first.")]


class MissingJson(JsonObject):
    """The smallest sets of objects with any of which the kitchen could make the goal."""

    things: Annotated[list[MissingThingJson], means("Every object of the sets, each once.")]
    sets: Annotated[
        list[Annotated[list[Count], FEW, UNIQUE, means("Places in `things`, from 0.")]],
        means("The sets; empty if no set helps. One of them, unless all are asked for."),
    ]
    proven: Annotated[
        bool,
        means(
            "Whether no set is better: fewer guises of the dish itself, then fewer prepared things, then "
            "fewer things, then plainer ones."
        ),
    ]
    complete: Annotated[bool, means("Whether these are all the best sets.")]


class LinkJson(JsonObject):
    """One unit of a circle."""

    unit: Annotated[UnitJson, means("The unit.")]
    makes: Annotated[ObjectJson, means("What it makes of the circle.")]
    needs: Annotated[ObjectJson, means("What it needs of the circle: what the next unit makes.")]


class CircleJson(JsonObject):
    """Units that hold each other up: each needs what the next makes, and the last what the first makes.
    No unit outside of their group makes any of it.
    """

    links: Annotated[list[LinkJson], FEW, means("The units of a shortest such circle.")]
    others: Annotated[
        list[Count], UNIQUE, means("Ids of further units that make something of it; they are held up, too.")
    ]
    nearest: Annotated[list[NearJson], means("What there is that resembles what the first unit makes.")]


class TakenJson(JsonObject):
    """An input of a step, and where it comes from."""

    object: Annotated[ObjectJson, means("The object.")]
    step: Annotated[Place | None, means("The step that makes it; null if none does.")]
    at_hand: Annotated[
        bool,
        means(
            "Whether the kitchen has it. If it has not, and no step makes it, another input shows the "
            "same thing."
        ),
    ]


class MadeJson(JsonObject):
    """What a step makes, and for whom."""

    object: Annotated[ObjectJson, means("The object.")]
    steps: Annotated[list[Place], UNIQUE, means("The later steps that take it.")]
    goal: Annotated[bool, means("Whether it is the goal.")]


class StepJson(JsonObject):
    """What one step of the tree is for."""

    step: Annotated[Place, means("Its place in the order of execution, from 1.")]
    unit: Annotated[UnitJson, means("The unit.")]
    takes: Annotated[list[TakenJson], means("Its inputs, as annotated.")]
    makes: Annotated[list[MadeJson], means("What it makes.")]
    way: Annotated[
        list[Place],
        UNIQUE,
        means(
            "The steps by which what it makes gets into the goal, itself the first; the shortest way. "
            "Empty if the goal does not need it."
        ),
    ]


class InsteadJson(JsonObject):
    """The best tree without the step."""

    status: Annotated[
        Literal["optimal", "unreachable", "limit"],
        means(
            "optimal: proven. unreachable: there is no tree without the step. limit: the time ran out; "
            "there may be a better tree."
        ),
    ]
    reason: Annotated[str, means("Why there is no tree without it; empty if there is one.")]
    costs: Annotated[CostsJson | None, means("What it costs; null if there is none.")]
    goes: Annotated[list[Count], UNIQUE, means("Ids of the units of the tree that it does without.")]
    comes: Annotated[list[UnitJson], means("The units that it has instead, in the order of execution.")]


class ExplanationJson(JsonObject):
    """Why there is no task tree for a goal and what is missing, or what each step of the best tree is for
    (docs/explain.md).
    """

    goal: Annotated[ObjectJson, means("The goal.")]
    status: Annotated[
        Literal["unreachable", "constrained", "reachable", "limit"],
        means(
            "unreachable: the kitchen cannot make the goal. constrained: it could, but for the "
            "constraints. reachable: there is a tree. limit: the time ran out before a tree was found or "
            "proven best."
        ),
    ]
    reason: Annotated[str, means("Why there is no task tree, in one sentence; empty if there is one.")]
    missing: Annotated[
        MissingJson | None, means("What the kitchen would have to have; null unless the goal is unreachable.")
    ]
    circles: Annotated[
        list[CircleJson], means("What locks the goal, if that is so, the nearest to it first.")
    ]
    nearest: Annotated[
        list[NearJson], means("What there is that resembles the goal, if it is unreachable and no set helps.")
    ]
    give_way: Annotated[
        list[str],
        UNIQUE,
        means(
            "The names of the fewest constraints that must be given up; if the goal is unreachable, "
            "those that must be given up besides having the first set."
        ),
    ]
    costs: Annotated[CostsJson | None, means("What the tree costs; null if there is none.")]
    steps: Annotated[
        list[StepJson],
        means("The steps of the tree in the order of execution, or the one that was asked for."),
    ]
    instead: Annotated[InsteadJson | None, means("The best tree without the step, if that was asked for.")]
    seconds: Annotated[Amount, means("Wall time, without reading the files.")]
    limit: LimitName


def explanation_json(explanation: Explanation) -> ExplanationJson:
    """Return what `explain --format json` writes."""
    world = explanation.world
    return ExplanationJson(
        goal=object_to_json(explanation.goal),
        status=word(explanation.status),
        reason=explanation.reason,
        missing=_missing(explanation),
        circles=[_circle(world, deadlock) for deadlock in explanation.deadlocks],
        nearest=_nearest(explanation.near),
        give_way=list(explanation.give_way),
        costs=some_costs_json(explanation.answer.tree if explanation.answer else None),
        steps=[_step(world, step) for step in explanation.steps],
        instead=None if explanation.instead is None else _instead(explanation.instead),
        seconds=round(explanation.seconds, 6),
        limit=explanation.limit,
    )


def _missing(explanation: Explanation) -> MissingJson | None:
    missing = explanation.missing
    if missing is None:
        return None
    places = {
        explanation.world.id_of(missing.node): place
        for place, missing in enumerate(explanation.missing_objects)
    }
    return MissingJson(
        things=[_missing_object(missing) for missing in explanation.missing_objects],
        sets=[[places[number] for number in each] for each in missing.sets],
        proven=missing.proven,
        complete=missing.complete,
    )


def _missing_object(missing: MissingObject) -> MissingThingJson:
    return MissingThingJson(
        object_to_json(missing.node), missing.raw, missing.same_dish, _nearest(missing.near)
    )


def _nearest(near: Iterable[Near]) -> list[NearJson]:
    return [NearJson(object_to_json(each.node), each.at_hand) for each in near]


def _circle(world: World, deadlock: Deadlock) -> CircleJson:
    circle = deadlock.circle
    nodes = objects_json(map(world.node, circle.objects))
    links = [
        LinkJson(UnitJson.of(world.foon, world.foon.units[unit]), made, needed)
        for unit, made, needed in zip(circle.units, nodes, [*nodes[1:], nodes[0]], strict=True)
    ]
    return CircleJson(links, list(circle.others), _nearest(deadlock.near))


def _step(world: World, step: StepRole) -> StepJson:
    return StepJson(
        step=step.place,
        unit=UnitJson.of(world.foon, step.unit),
        takes=[TakenJson(object_to_json(each.node), each.step, each.at_hand) for each in step.takes],
        makes=[MadeJson(object_to_json(each.node), list(each.steps), each.goal) for each in step.makes],
        way=list(step.way),
    )


def _instead(instead: Instead) -> InsteadJson:
    result = instead.answer
    foon = result.tree.world.foon if result.tree else None
    return InsteadJson(
        status=word(result.status),
        reason=result.reason,
        costs=some_costs_json(result.tree),
        goes=list(instead.goes),
        comes=[] if foon is None else [UnitJson.of(foon, foon.units[unit]) for unit in instead.comes],
    )
