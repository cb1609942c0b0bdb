"""A planning task in one of the styles: names, parameters and atoms, as PDDL has them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from foon_asp.errors import QueryError
from foon_asp.model.node import ObjectId, ObjectNode, State
from foon_asp.planning.pddl.names import Namer, plain
from foon_asp.planning.pddl.task import Fact, Step, Task
from foon_asp.values import said

STYLES = ("objects", "lifted")

Atom = tuple[str, ...]
"""A predicate and its arguments; an argument that begins with `?` is a parameter."""

Typed = tuple[tuple[str, str], ...]
"""Names, each with its type."""


@dataclass(frozen=True, slots=True)
class Predicate:
    name: str
    parameters: Typed = ()
    words: str = ""


@dataclass(frozen=True, slots=True)
class Action:
    """An action schema. `lasting` are the conditions that must hold until it ends."""

    name: str
    words: tuple[str, ...]
    parameters: Typed
    conditions: tuple[Atom, ...]
    lasting: tuple[Atom, ...]
    adds: tuple[Atom, ...]
    deletes: tuple[Atom, ...]
    cost: int | None
    duration: int


@dataclass(frozen=True, slots=True)
class Document:
    """A PDDL domain and problem.

    `arguments` has the objects that fill the parameters of each action, `facts` the atom of each fact.
    """

    task: Task
    style: str
    durative: bool
    problem_name: str
    types: Typed
    constants: Typed
    objects: Typed
    predicates: tuple[Predicate, ...]
    actions: tuple[Action, ...]
    arguments: dict[str, tuple[str, ...]]
    facts: dict[Fact, Atom]
    initially: tuple[Atom, ...]
    wanted: tuple[Atom, ...]

    @property
    def costed(self) -> bool:
        """Whether there are costs to be minimised; unified_planning cannot read costs without actions."""
        return self.task.criterion is not None and bool(self.actions)


def document(task: Task, style: str = "objects", durative: bool = False) -> Document:
    """Spell a task in a style; raise `QueryError` if there is no such style."""
    if style not in STYLES:
        raise QueryError(f"unknown style {said(style)}; there are {', '.join(STYLES)}")
    spelling = _Objects(task) if style == "objects" else _Lifted(task)
    gone = {fact for step in task.steps for fact in step.deletes}
    actions, arguments = [], {}
    for step in task.steps:
        action, arguments[step.name] = spelling.action(step, gone if durative else set())
        actions.append(action)
    goals = "-and-".join(plain(str(task.world.node(goal))) for goal in task.goals) or "nothing"
    return Document(
        task,
        style,
        durative,
        f"get-{plain(goals)}",
        spelling.types,
        spelling.constants,
        spelling.objects,
        spelling.predicates,
        tuple(actions),
        arguments,
        {fact: spelling.atom(fact) for fact in task.facts},
        (*spelling.statics, *map(spelling.atom, task.initially)),
        tuple(map(spelling.atom, task.wanted)),
    )


class _Objects:
    """One predicate for each object, and no parameters at all."""

    types: Typed = ()
    constants: Typed = ()
    objects: Typed = ()
    statics: tuple[Atom, ...] = ()

    def __init__(self, task: Task) -> None:
        self._task = task
        self._namer = task.used_names.namer.copy()
        self._names: dict[Fact, str] = {}
        predicates = []
        for fact in sorted(task.facts, key=_order):
            name, words = self._spell(fact)
            self._names[fact] = name
            predicates.append(Predicate(name, (), words))
        self.predicates = tuple(predicates)

    def _spell(self, fact: Fact) -> tuple[str, str]:
        task = self._task
        if fact.kind == "paid":
            return task.fees[fact.key], f"the fee for {fact.key} is paid"
        name, text = task.used_names.objects[fact.object_id], str(task.world.node(fact.object_id))
        if fact.kind == "there":
            return name, text
        if fact.kind == "out":
            return self._namer.name(f"{name}-out"), f"{text}: the one at hand is the kitchen's"
        return self._namer.name(f"{name}-left-{fact.count}"), f"{text}: {fact.count} in the kitchen"

    def atom(self, fact: Fact) -> Atom:
        return (self._names[fact],)

    def action(self, step: Step, gone: set[Fact]) -> tuple[Action, tuple[str, ...]]:
        lasting = tuple(self.atom(fact) for fact in step.needs if fact in gone and fact not in step.deletes)
        return Action(
            step.name,
            step.words,
            (),
            tuple(map(self.atom, step.needs)),
            lasting,
            tuple(map(self.atom, step.adds)),
            tuple(map(self.atom, step.deletes)),
            step.cost,
            step.duration,
        ), ()


class _Lifted:
    """Typed objects that static facts describe, one dynamic predicate, and schemas that describe nodes."""

    def __init__(self, task: Task) -> None:
        self._task = task
        self._namer = task.used_names.namer.copy()
        self._object = {object_id: name for name, object_id in task.names.objects.items()}
        self._nodes = {object_id: task.world.node(object_id) for object_id in task.object_ids}
        self._the: dict[str, str] = {}
        self._state: dict[tuple[str, ...], str] = {}
        self._words: dict[str, str] = {}
        self._size: dict[int, str] = {}
        # Each name is given out once, so that who comes first has the plainest one.
        self._name_types()
        self._name_dynamic()
        self._facts = {object_id: self._describe(node) for object_id, node in self._nodes.items()}
        self._tell_apart()
        self._name_amounts()

    def _name_types(self) -> None:
        """Name the types: what the labels are kinds of, what else there is, and a type for each label."""
        utensils = self._task.world.kitchen.utensils
        food = "food" if utensils else "item"
        labels = sorted({node.label for node in self._nodes.values()})
        self._parent = {label: "utensil" if label in utensils else food for label in labels}
        self._family = {name: self._type_name(name) for name in sorted(set(self._parent.values()))}
        self._item = self._type_name("thing")
        self._kind = self._type_name("kind")
        self._number = self._type_name("amount")
        self._type = {label: self._type_name(label) for label in labels}

    def _type_name(self, text: str) -> str:
        return self._namer.free(text, f"{text}-type")

    def _name_dynamic(self) -> None:
        """Name the predicates that change, if there are facts for them."""
        kinds = {fact.kind for fact in self._task.facts}
        self._names = {"there": self._namer.name("available")}
        for kind, name in (("out", "taken-out"), ("left", "left")):
            if kind in kinds:
                self._names[kind] = self._namer.name(name)

    def _describe(self, node: ObjectNode) -> list[Atom]:
        """Return what the states of a node say, without the node itself, and how much that is."""
        found = list(dict.fromkeys(atom for state in node.states for atom in self._said(state)))
        size = len(found)
        if size not in self._size:
            self._size[size] = self._namer.name(f"described-by-{size}")
        return [*found, (self._size[size],)]

    def _said(self, state: State) -> Iterator[Atom]:
        """Yield what a state says."""
        if state.relatum is not None:
            yield self._predicate("to", state.name), self._label(state.relatum)
        contents = state.contents or ()
        for place, content in enumerate(contents):
            # The same twice is told from the same once.
            again = contents[:place].count(content)
            yield self._predicate("with", state.name, str(again + 1)), self._label(content)
        if state.contents is not None and not contents:
            yield (self._predicate("empty", state.name),)
        if state.plain:
            yield (self._predicate("plain", state.name),)

    def _tell_apart(self) -> None:
        """Add a fact to nodes that their states do not tell apart once they are spelled as facts."""
        alike: dict[tuple[str, frozenset[Atom]], list[ObjectId]] = {}
        for object_id, node in self._nodes.items():
            alike.setdefault((node.label, frozenset(self._facts[object_id])), []).append(object_id)
        for object_ids in alike.values():
            for object_id in object_ids if len(object_ids) > 1 else ():
                name = self._namer.name(f"known-as-{self._object[object_id]}")
                self._state["known", name] = name
                self._words[name] = "tells apart what the other facts do not"
                self._facts[object_id].append((name,))

    def _name_amounts(self) -> None:
        """Name the numbers of objects that the kitchen may hold."""
        counts = sorted({fact.count for fact in self._task.facts if fact.kind == "left"})
        self._digit = {count: self._namer.name(f"n{count}") for count in counts}

    @property
    def types(self) -> Typed:
        roots = ((self._item, self._family), (self._kind, self._the), (self._number, self._digit))
        return (
            *((name, "object") for name, used in roots if used),
            *((name, self._item) for name in self._family.values()),
            *((self._type[label], self._family[parent]) for label, parent in self._parent.items()),
        )

    @property
    def constants(self) -> Typed:
        return (
            *((name, self._kind) for name in self._the.values()),
            *((name, self._number) for name in self._digit.values()),
        )

    @property
    def objects(self) -> Typed:
        return tuple(
            (self._object[object_id], self._type[node.label]) for object_id, node in self._nodes.items()
        )

    @property
    def statics(self) -> tuple[Atom, ...]:
        return tuple(
            (atom[0], self._object[object_id], *atom[1:])
            for object_id in self._nodes
            for atom in self._facts[object_id]
        )

    def _predicate(self, sort: str, name: str, times: str = "1") -> str:
        key = (sort, name, times)
        if key not in self._state:
            text = {"empty": f"{name} nothing"}.get(sort, name if times == "1" else f"{name} {times} times")
            self._state[key] = self._namer.name(text, "state")
        return self._state[key]

    def _label(self, label: str) -> str:
        if label not in self._the:
            self._the[label] = self._namer.name(f"the-{plain(label)}")
        return self._the[label]

    @property
    def predicates(self) -> tuple[Predicate, ...]:
        item, kind = ("?x", self._item), ("?y", self._kind)
        amount = ("?n", self._number)
        found = [Predicate(self._names["there"], (item,), "it is at hand; all else about objects is fixed")]
        if "out" in self._names:
            found.append(Predicate(self._names["out"], (item,), "the one at hand is the kitchen's"))
        if "left" in self._names:
            found.append(Predicate(self._names["left"], (item, amount), "how many the kitchen holds"))
        found += [Predicate(name, (), f"the fee for {key} is paid") for key, name in self._task.fees.items()]
        for key, name in self._state.items():
            binary = key[0] in ("to", "with")
            found.append(Predicate(name, (item, kind) if binary else (item,), self._words.get(name, "")))
        found += [
            Predicate(name, (item,), f"no more than {size} of the facts above describe it")
            for size, name in sorted(self._size.items())
        ]
        return tuple(found)

    def atom(self, fact: Fact) -> Atom:
        return self._atom(fact, self._object)

    def _atom(self, fact: Fact, names: Mapping[ObjectId, str]) -> Atom:
        if fact.kind == "paid":
            return (self._task.fees[fact.key],)
        if fact.kind == "left":
            return (self._names["left"], names[fact.object_id], self._digit[fact.count])
        return (self._names[fact.kind], names[fact.object_id])

    def action(self, step: Step, gone: set[Fact]) -> tuple[Action, tuple[str, ...]]:
        facts = (*step.needs, *step.adds, *step.deletes)
        object_ids = list(dict.fromkeys(fact.object_id for fact in facts if fact.object_id >= 0))
        namer = Namer()
        variable = {
            object_id: "?" + namer.name(self._task.world.node(object_id).label) for object_id in object_ids
        }
        described = [
            (atom[0], variable[object_id], *atom[1:])
            for object_id in object_ids
            for atom in self._facts[object_id]
        ]
        conditions = [self._atom(fact, variable) for fact in step.needs]
        lasting = [
            self._atom(fact, variable) for fact in step.needs if fact in gone and fact not in step.deletes
        ]
        return Action(
            step.name,
            step.words,
            tuple(
                (variable[object_id], self._type[self._task.world.node(object_id).label])
                for object_id in object_ids
            ),
            (*described, *conditions),
            tuple(lasting),
            tuple(self._atom(fact, variable) for fact in step.adds),
            tuple(self._atom(fact, variable) for fact in step.deletes),
            step.cost,
            step.duration,
        ), tuple(self._object[object_id] for object_id in object_ids)


def _order(fact: Fact) -> tuple[int, int, str, int]:
    kinds = ("there", "out", "left", "paid")
    return (kinds.index(fact.kind), fact.object_id, fact.key, -fact.count)
