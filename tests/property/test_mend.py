"""The fewest edits of a tree: all sets of few edits are tried on small trees."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from hypothesis import assume, event, given
from hypothesis import strategies as st

from foon_asp.model.consumption import SEMANTICS, Effects
from foon_asp.model.node import ObjectNode, State, UnitId
from foon_asp.model.world import World
from foon_asp.retrieval.judge import purpose
from foon_asp.retrieval.mend import Mending, mend
from support.examples import many
from support.small_foons import domains, world
from support.tokens import Deed, Tokens

_MOST = 2
"""How many edits are tried."""


@dataclass(frozen=True)
class _Step:
    """What a step lists now; `original`: it was in the tree; `open_`: what was not changed of it."""

    inputs: tuple[ObjectNode, ...]
    outputs: tuple[ObjectNode, ...]
    original: bool = True
    moved: bool = False
    open_: frozenset[tuple[bool, int]] = frozenset()


_Tree = tuple[_Step, ...]


def _step(where: World, number: UnitId, *, original: bool) -> _Step:
    unit = where.foon.units[number]
    inputs, outputs = (tuple(map(where.node, side)) for side in (unit.inputs, unit.outputs))
    ports = [*((True, place) for place in range(len(inputs))), *((False, p) for p in range(len(outputs)))]
    return _Step(inputs, outputs, original, open_=frozenset(ports if original else ()))


def _distance(one: ObjectNode, other: ObjectNode) -> int | None:
    """Count states and places that change, by hand."""
    if one.label != other.label or one == other:
        return None

    def parts(thing: ObjectNode) -> tuple[set[State], set[State], set[State]]:
        full = {state for state in thing.states if state.contents is not None}
        placed = {state for state in thing.states if state.relatum is not None} - full
        return full, placed, set(thing.states) - full - placed

    (full, placed, plain), (full_, placed_, plain_) = parts(one), parts(other)
    if full != full_:
        return None
    return max(len(placed - placed_), len(placed_ - placed)) + max(len(plain - plain_), len(plain_ - plain))


def _edited(where: World, known: int, tree: _Tree) -> Iterator[tuple[int, int, _Tree]]:
    """Yield each tree after one edit, with what that costs and how many steps it inserts."""
    universe = [where.node(number) for number in where.ids]
    for place, step in enumerate(tree):
        rest = tree[:place] + tree[place + 1 :]
        if not step.original:
            continue
        yield 1, 0, rest
        if not step.moved:
            for to in range(len(tree)):
                yield 1, 0, (*rest[:to], replace(step, moved=True), *rest[to:])
        for before, port in step.open_:
            side = step.inputs if before else step.outputs
            for other in universe:
                cost = _distance(side[port], other)
                if cost is not None and cost <= _MOST:
                    now = (*side[:port], other, *side[port + 1 :])
                    left = step.open_ - {(before, port)}
                    changed = (
                        replace(step, inputs=now, open_=left)
                        if before
                        else replace(step, outputs=now, open_=left)
                    )
                    yield cost, 0, (*tree[:place], changed, *tree[place + 1 :])
    for unit in list(where.foon.units.ids)[:known]:
        for to in range(len(tree) + 1):
            yield 1, 1, (*tree[:to], _step(where, unit, original=False), *tree[to:])


class _Kitchen(Tokens):
    """Tells whether a tree can be executed and makes its goals; they may be used up by then."""

    def __init__(self, where: World, semantics: str, goals: Sequence[ObjectNode]) -> None:
        super().__init__(where, semantics)
        self.goals = goals
        self._known: dict[object, Deed] = {}

    def works(self, tree: _Tree) -> bool:
        state, open_ = self.start, {goal for goal in self.goals if not self.has(self.start, goal)}
        for step in tree:
            deed = self._deed(step)
            # What nothing made was a tool; nobody makes one.
            if self.lacks(state, deed) or (self.semantics != "add" and deed.adds & self.lasting):
                return False
            state = self.after(state, [deed])
            open_ = {goal for goal in open_ if not self.has(state, goal)}
        return not open_

    def _deed(self, step: _Step) -> Deed:
        sides = (step.inputs, step.outputs)
        if sides not in self._known:
            self._known[sides] = self.deed(*sides)
        return self._known[sides]


def _fewest(kitchen: _Kitchen, known: int, tree: _Tree) -> tuple[int, int] | None:
    """Return the fewest edits, and the fewest inserted steps with so many, by trying all with few edits."""
    costs = {tree: (0, 0)}
    frontier = {tree}
    while frontier:
        new = set()
        for each in frontier:
            spent, inserted = costs[each]
            for cost, inserts, after in _edited(kitchen.where, known, each) if spent < _MOST else ():
                paid = (spent + cost, inserted + inserts)
                if paid[0] <= _MOST and paid < costs.get(after, (_MOST + 1, 0)):
                    costs[after] = paid
                    new.add(after)
        frontier = new
    return min((paid for each, paid in costs.items() if kitchen.works(each)), default=None)


@st.composite
def _trees(draw: st.DrawFn) -> tuple[World, tuple[UnitId, ...], int]:
    """Draw a FOON in a kitchen, some of its units in some order, and how many of its units are known."""
    where = draw(domains(strict=False))
    ids = list(where.foon.units.ids)
    things = list(where.foon.objects)
    more = draw(st.lists(st.sampled_from(things), max_size=len(things) - 1, unique=True))
    where = where.with_stock((*where.kitchen.objects, *more))
    order = draw(st.lists(st.sampled_from(ids), min_size=1, max_size=4))
    few = draw(st.lists(st.sampled_from(where.kitchen.objects), unique=True)) if where.kitchen.objects else []
    counts = {thing: draw(st.integers(0, 2)) for thing in few}
    where = World.of(where.foon, replace(where.kitchen, quantities=counts))
    return where, tuple(order), draw(st.integers(0, min(3, len(ids))))


_THINGS = [f"{label}[{state}]" for label in "abc" for state in "pq"]


@st.composite
def _scarce(draw: st.DrawFn) -> tuple[World, tuple[UnitId, ...], int]:
    """Draw the same, of few objects of which the kitchen has one or two each: what is used up is lacking."""
    sides = st.lists(st.sampled_from(_THINGS), min_size=1, max_size=2, unique=True)
    units = draw(st.lists(st.tuples(sides, sides), min_size=2, max_size=4))
    texts = [
        f"{' + '.join(ins)} -do{place}-> {' + '.join(outs)}"
        for place, (ins, outs) in enumerate(units)
        if not set(outs) <= set(ins)
    ]
    assume(texts)
    where = world(
        texts, " + ".join(draw(st.lists(st.sampled_from(_THINGS), min_size=1, max_size=4, unique=True)))
    )
    counts = {thing: draw(st.sampled_from((1, 1, 2))) for thing in where.kitchen.objects}
    where = World.of(where.foon, replace(where.kitchen, quantities=counts))
    ids = list(where.foon.units.ids)
    order = draw(st.lists(st.sampled_from(ids), min_size=2, max_size=3))
    return where, tuple(order), draw(st.integers(0, min(2, len(ids))))


def _replays(kitchen: _Kitchen, found: Mending) -> bool:
    steps = []
    for unit in found.functional_units:
        inputs, outputs = (tuple(found.foon.objects[n] for n in side) for side in (unit.inputs, unit.outputs))
        steps.append(_Step(inputs, outputs))
    return kitchen.works(tuple(steps))


_Drawn = tuple[World, tuple[UnitId, ...], int]


@given(_trees(), st.sampled_from(SEMANTICS))
@many(300)
def test_there_are_no_fewer_edits(drawn: _Drawn, semantics: str) -> None:
    _compare(drawn, semantics)


@given(_scarce(), st.sampled_from(("transform", "consume", "consume")))
@many(300)
def test_there_are_no_fewer_edits_where_things_are_scarce(drawn: _Drawn, semantics: str) -> None:
    _compare(drawn, semantics)


def _compare(drawn: _Drawn, semantics: str) -> None:
    where, order, known = drawn
    ids = purpose(where, order, ())
    kitchen = _Kitchen(where, semantics, [where.node(goal) for goal in ids])
    found = mend(Effects(where, semantics), known, order, ids)
    assert found.proven or (semantics != "add" and found.edits is None)
    if found.edits is not None:
        assert _replays(kitchen, found)
    tree = tuple(_step(where, number, original=True) for number in order)
    fewest = _fewest(kitchen, known, tree)
    event(f"fewest ({semantics}): {None if fewest is None else fewest[0]}")
    if found.edits is None or found.cost > _MOST:
        assert fewest is None
    else:
        inserts = sum(edit.kind == "insert" for edit in found.edits)
        assert fewest == (found.cost, inserts)


def test_each_kind_of_edit() -> None:
    units = ["a -boil-> b", "b -cook-> c", "c -eat-> d", "x -melt-> y"]
    where = world(units, "a")
    boil, cook, eat, melt = where.foon.units.ids

    def kinds(*order: UnitId, known: int = 0) -> list[tuple[str, int | None, int | None]]:
        found = mend(Effects(where, "add"), known, order, purpose(where, order, ()))
        assert found.proven
        return [(edit.kind, edit.step, edit.to) for edit in found.edits or ()]

    assert kinds(boil, cook, eat) == []
    assert kinds(cook, boil, eat) == [("move", 1, 2)]
    assert kinds(boil, eat, known=2) == [("insert", None, 2)]
    assert kinds(eat, boil, cook) == [("move", 1, 3)]
    assert kinds(boil, melt, cook) == [("remove", 2, None)]
    assert mend(Effects(where, "add"), 0, (boil, eat), purpose(where, (boil, eat), ())).edits is None


def test_a_state_is_changed_where_that_is_least() -> None:
    where = world(
        ["onion[whole] -chop-> onion[chopped]", "onion[chopped,fried] -serve-> dish"], "onion[whole]"
    )
    order = tuple(where.foon.units.ids)
    found = mend(Effects(where, "add"), 0, order, purpose(where, order, ()))
    [edit] = found.edits or ()
    assert (edit.kind, edit.step, edit.side, edit.cost) == ("change", 1, "output", 1)
    assert (str(edit.before), str(edit.after)) == ("onion [chopped]", "onion [chopped, fried]")


def test_many_states_of_one_node_may_have_to_change() -> None:
    where = world(["a -mix-> b[s1,s2,s3,s4,s5]", "b[t1,t2,t3,t4,t5] -bake-> c"], "a")
    order = tuple(where.foon.units.ids)
    for semantics in SEMANTICS:
        found = mend(Effects(where, semantics), 0, order, purpose(where, order, ()))
        assert (found.cost, found.proven) == (5, True)
