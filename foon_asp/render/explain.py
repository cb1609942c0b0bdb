"""Explanations as text that a cook can follow, and as a JSON value."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import fields
from textwrap import wrap

from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode
from foon_asp.model.world import World
from foon_asp.query.objective import Costs
from foon_asp.render.proof import limit_text
from foon_asp.render.table import table
from foon_asp.retrieval.explain import Deadlock, Explanation, MissingObject
from foon_asp.retrieval.nearest import Near
from foon_asp.retrieval.steps import Instead, StepRole
from foon_asp.retrieval.tree import TaskTree
from foon_asp.words import WIDTH, counted, short_source, wrapped

_TIE = "\xa0"
_LETTERS = "abcdefghijklmnopqrstuvwxyz"


def reason_text(goal: ObjectNode, reason: str) -> str:
    """Write the first sentence: it can be had at once, before the rest is worked out."""
    return f"{goal}\nno task tree: {reason}\n"


def explanation_text(explanation: Explanation, *, told: bool = False) -> str:
    """Write an explanation; without its first sentence if that was `told` before."""
    if explanation.status == "unreachable":
        head = reason_text(explanation.goal, explanation.reason)
        return ("" if told else head) + _missing_text(explanation)
    if explanation.status == "constrained":
        return reason_text(explanation.goal, explanation.reason)
    tree = explanation.answer.tree if explanation.answer else None
    if tree is None:
        limit = limit_text(explanation.limit)
        return f"{explanation.goal}\nno task tree was found before the {limit}\n"
    if not tree.units:
        return f"{explanation.goal}\nnothing to do: the kitchen has it\n"
    unproven = explanation.status == "limit"
    if explanation.step is not None:
        lines = _step_lines(explanation.steps[0], tree)
    else:
        lines = _overview_lines(explanation.steps, tree, unproven=unproven)
    if explanation.instead is not None:
        lines += ["", *_instead_lines(explanation.instead, tree)]
    return "\n".join([str(explanation.goal), *lines]) + "\n"


def _missing_text(explanation: Explanation) -> str:
    lines: list[str] = []
    missing = explanation.missing
    if missing is not None and missing.sets:
        lines += ["", *_set_lines(explanation)]
    else:
        if explanation.deadlocks:
            lines += ["", "Nothing that could be added to the kitchen would help, but the dish itself."]
        lines += _near_lines(explanation.near, "  ")
    if explanation.give_way:
        lines += ["", "Even then there is no task tree, unless these constraints give way:"]
        lines += [f"  {name}" for name in explanation.give_way]
    named = {missing.node for missing in explanation.missing_objects}
    for deadlock in explanation.deadlocks:
        lines += ["", *_circle_lines(explanation.world, deadlock)]
        if explanation.world.node(deadlock.circle.objects[0]) not in named:
            lines += _near_lines(deadlock.near, "  ")
    return "".join(f"{line}\n" for line in lines)


def _set_lines(explanation: Explanation) -> list[str]:
    missing = explanation.missing
    assert missing is not None
    by_id = {explanation.world.id_of(each.node): each for each in explanation.missing_objects}
    sets = [set(each) for each in missing.sets]
    common = set.intersection(*sets)
    shared = _object_lines(by_id[object_id] for object_id in _ordered(common, explanation.world))
    size = len(missing.sets[0])
    if len(sets) == 1:
        proof = "" if missing.proven else " (not proven to be the least, but nothing of it is superfluous)"
        lines = [f"It could be made if the kitchen had {_these(size)}{proof}:", *shared]
        return [*lines, "Nothing else as small would do."] if missing.complete and missing.proven else lines
    if common:
        lines = [f"It could be made if the kitchen had {counted(size, 'more thing')}. In any case:", *shared]
        lines.append(f"and one of these {len(sets)} choices:")
    else:
        lines = [f"It could be made if the kitchen had one of these {len(sets)} choices:"]
    for place, each in enumerate(sets):
        rest = [by_id[object_id] for object_id in _ordered(each - common, explanation.world)]
        names = [f"{other.node}{_remark(other)}" for other in rest]
        lines += _listed(names, f"  {_letter(place)}) ", " " * 5)
    if not missing.complete:
        lines.append(f"There are more: no more than {len(sets)} were looked for.")
    return lines


def _these(size: int) -> str:
    return "this" if size == 1 else f"these {size} things"


def _listed(names: Iterable[str], first: str, indent: str) -> list[str]:
    """Write names in lines, with semicolons; no name is broken."""
    text = "; ".join(name.replace(" ", _TIE) for name in names)
    return [line.replace(_TIE, " ") for line in wrapped(text, first, indent)]


def _letter(place: int) -> str:
    """Return a for 0, b for 1, and so on; aa comes behind z."""
    more, place = divmod(place, len(_LETTERS))
    return (_letter(more - 1) if more else "") + _LETTERS[place]


def _ordered(object_ids: Iterable[ObjectId], world: World) -> list[ObjectId]:
    """Bring food before utensils, and alike objects together."""

    def key(object_id: ObjectId) -> tuple[bool, object]:
        node = world.node(object_id)
        return world.is_tool(node), node.sort_key

    return sorted(object_ids, key=key)


def _remark(missing: MissingObject) -> str:
    if missing.same_dish:
        return " (the same thing in another state or place)"
    return "" if missing.raw else " (prepared)"


def _object_lines(objects: Iterable[MissingObject]) -> list[str]:
    lines = []
    for missing in objects:
        lines.append(f"  {missing.node}{_remark(missing)}")
        lines += _near_lines(missing.near, " " * 6)
    return lines


def _near_lines(near: Sequence[Near], indent: str) -> list[str]:
    """Say what there is that resembles an object."""
    lines = []
    for words, at_hand in (("the kitchen has ", True), ("the kitchen can make ", False)):
        names = [str(each.node) for each in near if each.at_hand == at_hand]
        if names:
            lines += _listed(names, indent + words, indent + "  ")
    return lines


def _circle_lines(world: World, deadlock: Deadlock) -> list[str]:
    """Tell a circle link by link."""
    circle = deadlock.circle
    names = [world.node(object_id) for object_id in circle.objects]
    units = [world.foon.units[unit] for unit in circle.units]
    lines = ["This goes round in a circle:"]
    for place, unit in enumerate(units, 1):
        need = f"{names[place]}" if place < len(names) else f"{names[0]} again"
        lines.append(f"  {_place(unit)} makes {names[place - 1]}")
        lines.append(f"      and needs {'it itself' if len(names) == 1 else need}")
    if circle.others:
        word = "makes" if len(circle.others) == 1 else "make"
        more = counted(len(circle.others), "more unit")
        held = "is held up" if len(circle.others) == 1 else "are held up"
        lines.append(f"  {more} {word} something of it, and {held} as well")
    return lines


def _place(unit: FunctionalUnit) -> str:
    source = unit.source
    return unit.motion + (f" [{short_source(source.file, source.line)}]" if source.file else "")


def _overview_lines(steps: Sequence[StepRole], tree: TaskTree, *, unproven: bool) -> list[str]:
    """Say in a line or two what each step is for."""
    lines = [counted(len(tree.units), "step") + (", not proven to be the fewest" if unproven else ""), ""]
    for step in steps:
        lines.append(f"{step.place:3}. {_place(step.unit)}, unit {step.unit.id}")
        lines += [f"     {line}" for line in _made_lines(step, tree, named=False)]
    return lines


def _step_lines(step: StepRole, tree: TaskTree) -> list[str]:
    lines = [f"step {step.place} of {len(tree.units)}: {_place(step.unit)}, unit {step.unit.id}", ""]
    taken = []
    for each in step.takes:
        if each.at_hand:
            taken.append(f"{each.node} from the kitchen")
        elif each.step is not None:
            taken.append(f"{each.node} from {_named(each.step, tree)}")
    lines += _block("takes", taken)
    lines += _block("makes", _made_lines(step, tree, named=True))
    if len(step.way) > 1:
        way = " → ".join(f"{place} {tree.functional_units[place - 1].motion}" for place in step.way)
        goal = tree.world.node(tree.goals[0]) if len(tree.goals) == 1 else "the goals"
        lines += wrap(f"{way} → {goal}", WIDTH, initial_indent="  so     ", subsequent_indent=" " * 9)
    return lines


def _block(word: str, rows: Sequence[str]) -> list[str]:
    return [f"  {word if not place else '':7}{row}" for place, row in enumerate(rows)]


def _made_lines(step: StepRole, tree: TaskTree, *, named: bool) -> list[str]:
    """Say what a step makes and for whom; what nobody takes comes last, if at all."""
    lines = []
    for made in step.makes:
        users = [_named(place, tree) if named else str(place) for place in made.steps]
        parts = ["the goal"] if made.goal else []
        if users:
            word = "" if named else "step " if len(users) == 1 else "steps "
            parts.append(word + ", ".join(users))
        if parts:
            lines.append(f"{made.node}: {'' if made.goal else 'for '}{' and for '.join(parts)}")
    idle = [str(made.node) for made in step.makes if not made.steps and not made.goal]
    if not lines:
        return ["nothing that a later step needs"]
    if idle and named:
        lines.append(f"{'; '.join(idle)}: nothing needs {'it' if len(idle) == 1 else 'them'}")
    return lines


def _named(place: int, tree: TaskTree) -> str:
    return f"step {place} ({tree.functional_units[place - 1].motion})"


def _instead_lines(instead: Instead, tree: TaskTree) -> list[str]:
    other = instead.answer.tree
    if other is None:
        if instead.answer.status == "limit":
            return [f"without it: no task tree was found before the {limit_text(instead.answer.limit)}"]
        return ["There is no task tree without it."]
    rows = [("", "with it", "without it")]
    rows += [
        (f"  {name}", _number(mine), _number(theirs))
        for name, mine, theirs in _side_by_side(tree.costs, other.costs)
    ]
    lines = table(rows, "<10", ">12", ">12", gap="")
    if instead.answer.status == "limit":
        lines.append("(the time ran out: there may be a better tree without it)")
    places = {unit: place for place, unit in enumerate(tree.units, 1)}
    their_places = {unit: place for place, unit in enumerate(other.units, 1)}
    units = tree.world.foon.units
    lines += ["", f"without it these steps go ({len(instead.goes)}) and come ({len(instead.comes)}):"]
    lines += [f"  - {places[unit]:3}. {_place(units[unit])}, unit {unit}" for unit in instead.goes]
    lines += [f"  + {their_places[unit]:3}. {_place(units[unit])}, unit {unit}" for unit in instead.comes]
    return lines


def _side_by_side(mine: Costs, theirs: Costs) -> list[tuple[str, float | None, float | None]]:
    """Return the costs of two trees by each criterion that says something of either."""
    rows = [(each.name, getattr(mine, each.name), getattr(theirs, each.name)) for each in fields(Costs)]
    return [row for row in rows if row[1] or row[2]]


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.3g}" if isinstance(value, float) else str(value)
