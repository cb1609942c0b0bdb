"""A planning task in one of the styles: names, parameters and atoms, as PDDL has them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from foon_asp.errors import QueryError
from foon_asp.graph import ObjectNode
from foon_asp.pddl_names import Namer, plain
from foon_asp.pddl_task import Fact, Step, Task

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
        return self.task.level is not None and bool(self.actions)


def document(task: Task, style: str = "objects", durative: bool = False) -> Document:
    """Spell a task in a style; raise `QueryError` if there is no such style."""
    if style not in STYLES:
        raise QueryError(f"unknown style {style!r}; there are {', '.join(STYLES)}")
    spelling = _Objects(task) if style == "objects" else _Lifted(task)
    gone = {fact for step in task.steps for fact in step.deletes}
    actions, arguments = [], {}
    for step in task.steps:
        action, arguments[step.name] = spelling.action(step, gone if durative else set())
        actions.append(action)
    goals = "-and-".join(plain(str(task.domain.node(goal))) for goal in task.goals) or "nothing"
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
        name, text = task.used_names.objects[fact.thing], str(task.domain.node(fact.thing))
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
        self._object = {thing: name for name, thing in task.names.objects.items()}
        nodes = {thing: task.domain.node(thing) for thing in task.things}
        self._counts = sorted({fact.count for fact in task.facts if fact.kind == "left"})
        utensils = task.domain.kitchen.utensils
        parent = {
            label: "utensil" if label in utensils else "food" if utensils else "item"
            for label in sorted({node.label for node in nodes.values()})
        }
        families = sorted(set(parent.values()))
        family = {name: self._namer.free(name, f"{name}-type") for name in families}
        self._item = self._namer.free("thing", "thing-type")
        self._kind = self._namer.free("kind", "kind-type")
        self._number = self._namer.free("amount", "amount-type")
        self._type = {label: self._namer.free(label, f"{label}-type") for label in parent}
        self._the: dict[str, str] = {}
        self._state: dict[tuple[str, ...], str] = {}
        self._words: dict[str, str] = {}
        self._size: dict[int, str] = {}
        self._names: dict[str, str] = {}
        self._spell_dynamic(task.facts)
        self._facts = {thing: self._describe(node) for thing, node in nodes.items()}
        self._tell_apart(nodes)
        named = bool(self._the)
        self.types = (
            *((name, "object") for name in ([self._item] if families else [])),
            *((name, "object") for name in ([self._kind] if named else [])),
            *((name, "object") for name in ([self._number] if self._counts else [])),
            *((name, self._item) for name in family.values()),
            *((self._type[label], family[parent[label]]) for label in parent),
        )
        self._digit = {count: self._namer.name(f"n{count}") for count in self._counts}
        self.constants = (
            *((name, self._kind) for name in self._the.values()),
            *((name, self._number) for name in self._digit.values()),
        )
        self.objects = tuple((self._object[thing], self._type[node.label]) for thing, node in nodes.items())
        self.statics = tuple(
            (atom[0], self._object[thing], *atom[1:]) for thing in nodes for atom in self._facts[thing]
        )

    def _spell_dynamic(self, facts: Iterable[Fact]) -> None:
        kinds = {fact.kind for fact in facts}
        self._names["there"] = self._namer.name("available")
        if "out" in kinds:
            self._names["out"] = self._namer.name("taken-out")
        if "left" in kinds:
            self._names["left"] = self._namer.name("left")

    def _describe(self, node: ObjectNode) -> list[Atom]:
        """Return what the states of a node say, without the node itself, and how much that is."""
        found: dict[Atom, None] = {}
        for state in node.states:
            if state.relatum is not None:
                found[self._predicate("to", state.name), self._label(state.relatum)] = None
            contents = state.contents or ()
            for place, content in enumerate(contents):
                # The same twice is told from the same once.
                again = contents[:place].count(content)
                found[self._predicate("with", state.name, str(again + 1)), self._label(content)] = None
            if state.contents is not None and not contents:
                found[(self._predicate("empty", state.name),)] = None
            if state.plain:
                found[(self._predicate("plain", state.name),)] = None
        size = len(found)
        if size not in self._size:
            self._size[size] = self._namer.name(f"described-by-{size}")
        return [*found, (self._size[size],)]

    def _tell_apart(self, nodes: dict[int, ObjectNode]) -> None:
        """Add a fact to nodes that their states do not tell apart once they are spelled as facts."""
        alike: dict[tuple[str, frozenset[Atom]], list[int]] = {}
        for thing, node in nodes.items():
            alike.setdefault((node.label, frozenset(self._facts[thing])), []).append(thing)
        for things in alike.values():
            for thing in things if len(things) > 1 else ():
                name = self._namer.name(f"known-as-{self._object[thing]}")
                self._state["known", name] = name
                self._words[name] = "tells apart what the other facts do not"
                self._facts[thing].append((name,))

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
        thing, kind = ("?x", self._item), ("?y", self._kind)
        amount = ("?n", self._number)
        found = [Predicate(self._names["there"], (thing,), "it is at hand; all else about things is fixed")]
        if "out" in self._names:
            found.append(Predicate(self._names["out"], (thing,), "the one at hand is the kitchen's"))
        if "left" in self._names:
            found.append(Predicate(self._names["left"], (thing, amount), "how many the kitchen holds"))
        found += [Predicate(name, (), f"the fee for {key} is paid") for key, name in self._task.fees.items()]
        for key, name in self._state.items():
            binary = key[0] in ("to", "with")
            found.append(Predicate(name, (thing, kind) if binary else (thing,), self._words.get(name, "")))
        found += [
            Predicate(name, (thing,), f"no more than {size} of the facts above describe it")
            for size, name in sorted(self._size.items())
        ]
        return tuple(found)

    def atom(self, fact: Fact) -> Atom:
        return self._atom(fact, self._object)

    def _atom(self, fact: Fact, names: dict[int, str]) -> Atom:
        if fact.kind == "paid":
            return (self._task.fees[fact.key],)
        if fact.kind == "left":
            return (self._names["left"], names[fact.thing], self._digit[fact.count])
        return (self._names[fact.kind], names[fact.thing])

    def action(self, step: Step, gone: set[Fact]) -> tuple[Action, tuple[str, ...]]:
        facts = (*step.needs, *step.adds, *step.deletes)
        things = list(dict.fromkeys(fact.thing for fact in facts if fact.thing >= 0))
        namer = Namer()
        variable = {thing: "?" + namer.name(self._task.domain.node(thing).label) for thing in things}
        described = [(atom[0], variable[thing], *atom[1:]) for thing in things for atom in self._facts[thing]]
        conditions = [self._atom(fact, variable) for fact in step.needs]
        lasting = [
            self._atom(fact, variable) for fact in step.needs if fact in gone and fact not in step.deletes
        ]
        return Action(
            step.name,
            step.words,
            tuple((variable[thing], self._type[self._task.domain.node(thing).label]) for thing in things),
            (*described, *conditions),
            tuple(lasting),
            tuple(self._atom(fact, variable) for fact in step.adds),
            tuple(self._atom(fact, variable) for fact in step.deletes),
            step.cost,
            step.duration,
        ), tuple(self._object[thing] for thing in things)


def _order(fact: Fact) -> tuple[int, int, str, int]:
    kinds = ("there", "out", "left", "paid")
    return (kinds.index(fact.kind), fact.thing, fact.key, -fact.count)
