"""Trees in which something is replaced: for goals of which there is no tree otherwise.

`encodings/retrieval/substitute.lp` says what such a tree is. Here it is worked out what may be
replaced and which units can matter then, and the tree that is found is replayed with all replacements made.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from itertools import chain

from foon_asp import limits
from foon_asp.asp.model import Model
from foon_asp.asp.program import optimisers, too_deep
from foon_asp.asp.terms import quote
from foon_asp.errors import InternalError
from foon_asp.model.foon import Added, FoonBuilder
from foon_asp.model.kitchen import Kitchen, seen_as
from foon_asp.model.node import FunctionalUnit, ObjectId, ObjectNode, UnitId
from foon_asp.model.relations import loosened
from foon_asp.model.replacing import Changes, Differences, Replaced, Shape, matches, replaced, shape
from foon_asp.model.units import Units
from foon_asp.model.world import World
from foon_asp.query.checks import check_objective
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.query.status import Status
from foon_asp.query.substitutes import Substitutes
from foon_asp.query.substitution import Replacement, Substitution
from foon_asp.query.tariff import tariffs
from foon_asp.retrieval.methods.found import NOTHING, Found
from foon_asp.retrieval.methods.proven import gaps, own_payments
from foon_asp.retrieval.tree import Record, TaskTree, likeliest_to_fail

_ENCODINGS = ("retrieval/substitute.lp", "criteria/likeness.lp")


def substituted(problem: Problem, objective: Objective, substitution: Substitution) -> Found:
    """Return the tree with the likest replacements, and of those the best by an objective, proven.

    At a limit it is the best until then, with nothing proven.
    """
    space = Space(problem, Substitutes(problem.world, substitution))
    return likest(space, objective, _ENCODINGS, lambda model: space.tree(model))[0]


def likest(
    space: Space, objective: Objective, encodings: Sequence[str], tree_of: Callable[[Model], TaskTree]
) -> tuple[Found, Model | None]:
    """Return the best tree of what may be replaced, and its model; at a limit the best until then.

    `encodings` say what a tree is, and what comes before the objective; `tree_of` reads a tree from a model.
    """
    posed = space.problem
    if posed is None:
        return NOTHING, None
    every = check_objective(posed, objective).complete
    priced = tariffs(posed, every)
    best: Model | None = None
    for control in optimisers(posed, priced, encodings=encodings, extra_facts=space.facts()):
        answers = [control.first] if limits.limited_now() else []
        for answer in (each() for each in (*answers, control.best)):
            if answer.atoms is not None:
                best = answer
            elif answer.proven:
                return NOTHING, None
        if not answer.proven:
            tree = None if best is None else tree_of(best)
            return Found(Status.LIMIT, tree, limit=answer.limit), best
        if not too_deep(answer):
            break
    tree = tree_of(answer)
    own = own_payments(answer, control) if posed.constraints.rules else {}
    return Found(Status.OPTIMAL, tree, gaps(posed, priced[: len(objective)], tree, answer), own), answer


class Space:
    """What may be replaced in the trees of a problem: labels, objects that may become the same, and units.

    What `substitutes` want is at hand wherever it replaces what is, or what no unit makes. With `may_go` no
    other labels are replaced.
    """

    def __init__(
        self, problem: Problem, substitutes: Substitutes, may_go: frozenset[str] | None = None
    ) -> None:
        self._asked = problem
        self._may_go = may_go
        self._world = problem.world
        self._substitutes = substitutes
        goals = map(self._world.node, problem.goals)
        self._kept = self._world.kitchen.utensils.union(*map(self._dish, goals))
        self._matched: dict[ObjectId, dict[ObjectId, set[Differences]]] = {}

    def _dish(self, goal: ObjectNode) -> Iterable[str]:
        """Return what is never replaced of a goal: its label or, where that is a vessel, its only content."""
        vessel = goal.label in self._world.kitchen.utensils
        return goal.contents if vessel and len(set(goal.contents)) == 1 else [goal.label]

    def _replacements(self, label: str) -> Mapping[str | None, Replacement]:
        """Return what may replace a label, and how well."""
        if label in self._kept or not (self._may_go is None or label in self._may_go):
            return {}
        return self._substitutes.of(label)

    @cached_property
    def _united(self) -> dict[str, set[str]]:
        """For each label those that may become the same: one replaces the other."""
        united: dict[str, set[str]] = {}
        for label in self._substitutes.food if self._may_go is None else sorted(self._may_go):
            for by in self._replacements(label):
                if by is not None:
                    united.setdefault(label, set()).add(by)
                    united.setdefault(by, set()).add(label)
        return united

    def _may_unite(self, one: str, other: str) -> bool:
        return other in self._united.get(one, ())

    def _changeable(self, number: ObjectId) -> bool:
        """Whether an object names a label that may be replaced."""
        return any(map(self._replacements, self._world.node(number).named_labels))

    def _node(self, number: ObjectId) -> ObjectNode:
        """Return a node as relations are matched."""
        return _as_read(self._world, self._world.node(number))

    @cached_property
    def _sources(self) -> dict[tuple[Shape, str], list[ObjectId]]:
        """The objects of each shape and label that are at hand or that units make."""
        found: dict[tuple[Shape, str], list[ObjectId]] = {}
        makers = self._world.units.makers
        for number in self._world.ids:
            node = self._node(number)
            form = shape(node)
            if form is not None and (number in self._world.stock or number in makers):
                found.setdefault((form, node.label), []).append(number)
        return found

    def _matches(self, number: ObjectId) -> dict[ObjectId, set[Differences]]:
        """Return the objects that may become the same as one, and the ways in which they may."""
        if number not in self._matched:
            node = self._node(number)
            form = shape(node)
            ways: dict[ObjectId, set[Differences]] = {}
            labels = (node.label, *sorted(self._united.get(node.label, ()))) if form is not None else ()
            for other in chain.from_iterable(self._sources.get((form or (), label), ()) for label in labels):
                limits.check()
                if other != number and (found := matches(node, self._node(other), self._may_unite)):
                    ways[other] = found
            self._matched[number] = ways
        return self._matched[number]

    def _makers(self, number: ObjectId) -> Iterable[UnitId]:
        makers = self._world.units.makers
        return makers.of(number) if number in makers else ()

    @cached_property
    def _wanted(self) -> tuple[set[UnitId], set[ObjectId]]:
        """The units and objects that can matter, whatever the kitchen has."""
        world, demanded = self._world, self._asked.constraints.use_units
        needs = world.units.needs
        units: set[UnitId] = set(demanded)
        rest = [*self._asked.goals, *(need for unit in demanded for need in needs[unit])]
        seen = set(rest)
        while rest:
            number = rest.pop()
            if number in world.stock and not self._changeable(number):
                continue
            more = {*self._matches(number)}
            for unit in self._makers(number):
                if unit not in units:
                    units.add(unit)
                    more.update(needs[unit])
            rest += sorted(more - seen)
            seen |= more
        return units, seen

    @cached_property
    def problem(self) -> Problem | None:
        """The problem with the units that matter and may be executed; None if a goal is then out of reach.

        Its kitchen has only what no replacement changes.
        """
        world = self._world
        units, wanted = self._wanted
        reading = world.units
        users: dict[ObjectId, list[UnitId]] = {}
        alike: dict[ObjectId, list[ObjectId]] = {}
        for number in wanted:
            for other in self._matches(number):
                alike.setdefault(other, []).append(number)
        lacking = {unit: set(reading.needs[unit]) for unit in units}
        for unit, needs in lacking.items():
            for need in needs:
                users.setdefault(need, []).append(unit)
        done = [unit for unit, needs in lacking.items() if not needs]
        fresh = [
            number
            for number in wanted
            if number in world.stock or self._droppable(number) or self._may_be_brought(number)
        ]
        available = set(fresh)
        executable: set[UnitId] = set()
        while fresh or done:
            while done:
                unit = done.pop()
                executable.add(unit)
                fresh += [number for number in reading.makes[unit] if number not in available]
                available.update(fresh)
            while fresh:
                number = fresh.pop()
                more = [other for other in alike.get(number, ()) if other not in available]
                available.update(more)
                fresh += more
                for unit in users.get(number, ()):
                    lacking[unit].discard(number)
                    if not lacking[unit] and unit not in executable:
                        done.append(unit)
        demanded = set(self._asked.constraints.use_units)
        if not (available >= set(self._asked.goals) and executable >= demanded):
            return None
        plain = [world.node(number) for number in world.stock if not self._changeable(number)]
        return replace(self._asked, world=world.with_stock(plain), among=tuple(sorted(executable)))

    def _may_be_brought(self, number: ObjectId) -> bool:
        """Whether an object may be at hand though the kitchen lacks it: raw, and of what is wanted alone."""
        return number not in self._world.units.makers and self._of_wanted(
            number, lambda label: bool(self._substitutes.wanted & self._replacements(label).keys())
        )

    def _of_wanted(self, number: ObjectId, becomes_wanted: Callable[[str], bool]) -> bool:
        """Whether all food that an object names is wanted, or becomes that."""
        named = set(self._world.node(number).named_labels) - self._world.kitchen.utensils
        return bool(named) and all(
            label in self._substitutes.wanted or becomes_wanted(label) for label in named
        )

    def _droppable(self, number: ObjectId) -> bool:
        return None in self._replacements(self._world.node(number).label)

    def facts(self) -> str:
        """Return what `substitute.lp` takes beside the facts of the problem."""
        return "".join(f"{fact}\n" for fact in self._facts())

    def _facts(self) -> Iterator[str]:
        assert self.problem is not None
        world = self._world
        units = self.problem.units
        listed = {*self._asked.goals, *(need for unit in units for need in world.units.needs[unit])}
        made = {number for unit in units for number in world.units.makes[unit]}
        stored: set[ObjectId] = {number for number in listed if number in world.stock}
        labels: set[str] = {label for n in (*listed, *made) for label in world.node(n).named_labels}
        count = 0
        for number in sorted(listed):
            if self._droppable(number):
                yield f"called({number},{quote(world.node(number).label)})."
            for other, ways in self._matches(number).items():
                if other in world.stock:
                    stored.add(other)
                elif other not in made:
                    continue
                labels.update(world.node(other).named_labels)
                for way in sorted(ways, key=sorted):
                    count += 1
                    pairs = (f"differs({count},{quote(one)},{quote(two)})." for one, two in sorted(way))
                    yield " ".join([f"match({count},{number},{other}).", *pairs])
        for label in sorted(labels):
            for by, row in self._replacements(label).items():
                yield f"alike({quote(label)},{'nothing' if by is None else quote(by)},{row.cost})."
        for number in sorted(stored):
            named = sorted({label for label in world.node(number).named_labels if self._replacements(label)})
            yield " ".join([f"stored({number}).", *(f"names({number},{quote(label)})." for label in named)])
        for unit in units:
            for label in sorted(self._new_labels(world.foon.units[unit])):
                yield f"brings({unit},{quote(label)})."

        yield from self._more_facts(listed - stored, labels)

    def _more_facts(self, lacking: Iterable[ObjectId], labels: Iterable[str]) -> Iterator[str]:
        """Yield what `adapt.lp` takes beside that: what is wanted, what may be brought, what it is like."""
        world, wanted = self._world, self._substitutes.wanted
        if not wanted:
            return
        yield from (f"wanted({quote(label)})." for label in sorted(wanted))
        for number in sorted(lacking):
            if self._may_be_brought(number):
                named = sorted(set(world.node(number).named_labels) - world.kitchen.utensils)
                yield " ".join(
                    [f"obtainable({number}).", *(f"names({number},{quote(each)})." for each in named)]
                )
        for label in sorted(labels):
            for by, row in self._companions(label).items():
                yield f"near({quote(label)},{quote(by)},{row.cost})."

    def _companions(self, label: str) -> dict[str, Replacement]:
        """Return what is wanted and may be added beside a label, and how well."""
        return {} if label in self._kept else self._substitutes.companions(label)

    def _new_labels(self, unit: FunctionalUnit) -> set[str]:
        """Return the labels that a unit brings about of others, and that may be replaced or added to."""
        world = self._world
        before = {label for number in unit.inputs for label in world.node(number).named_labels}
        behind = {label for n in world.units.makes[unit.id] for label in world.node(n).named_labels}
        return {label for label in behind - before if self._replacements(label) or self._companions(label)}

    def replacements(self, model: Model) -> tuple[Replacement, ...]:
        """Return the replacements of a model, sorted."""
        rows = (
            self._replacements(str(label))[str(by) if isinstance(by, str) else None]
            for label, by in model.rows("replace")
        )
        return tuple(sorted(rows, key=lambda row: row.label))

    def additions(self, model: Model) -> tuple[Replacement, ...]:
        """Return what a model adds, each as if it replaced what it is beside; sorted by what is added."""
        rows = (self._companions(str(beside))[str(label)] for label, beside in model.rows("beside"))
        return tuple(sorted(rows, key=lambda row: row.by or ""))

    def tree(self, model: Model) -> TaskTree:
        """Return the tree of a model with all replacements made, replayed.

        Raises `InternalError` if it cannot be executed.
        """
        units, human = (list(map(UnitId, model.column(name))) for name in ("use", "human"))
        for most in model.column("split"):
            human = likeliest_to_fail(self._world, units, most)
        return self._made(units, human, self.replacements(model), self.additions(model))

    def _made(
        self,
        units: Iterable[UnitId],
        human: Iterable[UnitId],
        rows: tuple[Replacement, ...],
        additions: Iterable[Replacement],
    ) -> TaskTree:
        """Return the tree of some units with replacements made, in a small world that has these units alone.

        Its kitchen has beside that of the problem what is wanted, wherever it replaces or goes with what is
        there. It costs what the units cost as they were annotated. Raises `InternalError` if it cannot be
        executed.
        """
        world = self._world
        labels: Replaced = {row.label: row.by for row in rows}
        beside: dict[str, list[str]] = {}
        for row in additions:
            if row.by is not None:
                beside.setdefault(row.label, []).append(row.by)
        needs = sorted({number for unit in units for number in world.units.needs[unit]})
        there = {_as_read(world, node) for node in world.kitchen.objects}
        brought = [
            node
            for node in _replaced(world, filter(lambda n: self._is_brought(n, labels), needs), labels)
            if _as_read(world, node) not in there
        ]
        there.update(_as_read(world, node) for node in brought)
        changes = Changes(labels, beside, lambda node: _as_read(world, node) in there)
        for node in _replaced(world, needs, labels):
            if _as_read(world, node) in there:
                more = Changes({}, beside, changes.at_hand).of(node)
                brought += [each for each in more if _as_read(world, each) not in there]
        more_at_hand = tuple(dict.fromkeys(brought))
        kitchen = replace(world.kitchen, objects=(*world.kitchen.objects, *more_at_hand))
        tree = _made_with(world, kitchen, self._asked.goals, units, human, changes)
        return replace(tree, replacements=rows, brought=more_at_hand)

    def _is_brought(self, number: ObjectId, labels: Replaced) -> bool:
        """Whether an object is at hand for the sake of what it becomes: that is wanted."""
        wanted = self._substitutes.wanted

        def becomes_wanted(label: str) -> bool:
            return labels.get(label) in wanted

        if number not in self._world.stock:
            return number not in self._world.units.makers and self._of_wanted(number, becomes_wanted)
        changed = labels.keys() & set(self._world.node(number).named_labels)
        return bool(changed) and all(map(becomes_wanted, changed))


def _as_read(world: World, node: ObjectNode) -> ObjectNode:
    """Return what two nodes have in common that are the same as relations are matched."""
    return loosened(node) if world.units.loose else node


def _made_with(
    world: World,
    kitchen: Kitchen,
    goals: Iterable[ObjectId],
    units: Iterable[UnitId],
    human: Iterable[UnitId],
    changes: Changes,
) -> TaskTree:
    """Return the tree of some units with changes made, in a small world that has these units alone.

    It costs what the units cost as they were annotated. Raises `InternalError` if it cannot be executed.
    """
    builder = FoonBuilder()
    gone = {label for label, by in changes.labels.items() if by is None}
    goals = tuple(goals)
    own: dict[UnitId, UnitId] = {}
    products: set[tuple[UnitId, ObjectId]] = set()
    for number in units:
        unit = world.foon.units[number]
        needed = set(world.units.needs[number])
        views = {n for n in unit.inputs if world.units.read(n) not in needed}
        # A vessel that was implied by what it held is not there without it.
        taken = [n for n in unit.inputs if not (n in views and gone & set(world.node(n).named_labels))]
        inputs = [node for n in taken for node in changes.of(world.node(n), view=n in views)]
        outputs = [node for n in unit.outputs for node in changes.of(world.node(n))]
        before, behind = ([builder.object(node) for node in side] for side in (inputs, outputs))
        made, added = builder.unit(unit.motion, before, behind, replace(unit.annotation, marks=()))
        if added is Added.NEW:
            own[made] = number
        # An input may have the label of a bare product now.
        for number_made in world.units.makes[number]:
            products.update((made, builder.object(node)) for node in changes.of(world.node(number_made)))
    wanted = [node for goal in goals for node in changes.of(world.node(goal))]
    for goal in wanted:
        builder.object(goal)
    reading = Units(
        builder.build(),
        world.kitchen.utensils,
        strict=world.strict,
        labels_only=world.labels_only,
        match_relations=world.match_relations,
        products=products,
    )
    small = World(reading, seen_as(kitchen, reading.stand_in) if reading.loose else kitchen)
    done = set(human)
    tree = TaskTree.of(
        small, map(small.id_of, wanted), list(own), [made for made, number in own.items() if number in done]
    )
    if not tree.executable:
        missing = ", ".join(map(str, tree.replay.missing))
        raise InternalError(f"a task tree with replacements fails its replay: {missing} is missing")
    numbers = tuple(own[made] for made in tree.units)
    plain = TaskTree.of(world, goals, numbers, done)
    record = Record(numbers, replace(plain.costs, depth=tree.depth), tree.depth)
    return replace(tree, record=record)


def _replaced(world: World, numbers: Iterable[ObjectId], labels: Replaced) -> list[ObjectNode]:
    """Return what some objects become, but for those that are left out."""
    nodes = (replaced(world.node(number), labels) for number in numbers)
    return [node for node in nodes if node is not None]
