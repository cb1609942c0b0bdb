"""The trace of iterative deepening: the seed paper's example, small graphs, the literal search, real data."""

from __future__ import annotations

import json
from collections.abc import Iterable
from itertools import islice, pairwise

import brute_force
import pytest
from hypothesis import assume, event, given
from hypothesis import strategies as st
from small_foons import domain, many, node, queries

from foon_asp.builder import FoonBuilder
from foon_asp.dataset import Dataset
from foon_asp.graph import Annotation, ObjectNode
from foon_asp.kitchen import Kitchen
from foon_asp.problem import Domain
from foon_asp.render.trace import bound_text, trace_text, trace_value
from foon_asp.retrieve import retrieve
from foon_asp.trace import Bound, bounds, explore, trace

Query = tuple[Domain, ObjectNode]


def labels(where: Domain, bound: Bound) -> str:
    return " ".join(where.node(thing).label for thing, _ in bound.explored)


def traced(units: Iterable[str], kitchen: str, goal: str = "goal") -> list[str]:
    """Return one line for each limit: what was explored, and `!` if the goal was reached."""
    where = domain(units, kitchen)
    found = trace(where, where.id_of(node(goal)))
    assert [bound.limit for bound in found] == list(range(len(found)))
    return [labels(where, bound) + (" !" if bound.reached else "") for bound in found]


# --- Small named graphs ---------------------------------------------------------------------------

PAPER = (
    "b + c + d -m-> a",
    "e + f -m-> b",
    "g -m-> c",
    "h -m-> d",
    "i -m-> e",
    "j + k -m-> f",
    "l -m-> g",
    "m + n -m-> h",
    "o + p -m-> k",
    "r -m-> l",
    "s -m-> n",
)


def test_the_papers_example() -> None:
    assert traced(PAPER, "i + j + m + o + p + r + s", "a") == [
        "a",
        "a b c d",
        "a b e f c g d h",
        "a b e i f j k c g l d h m n",
        "a b e i f j k o p c g l r d h m n s !",
    ]


def test_depth_is_counted_from_the_goal() -> None:
    where = domain(PAPER, "i + j + m + o + p + r + s")
    bound = explore(where, where.id_of(node("a")), 2)
    assert [depth for _, depth in bound.explored] == [0, 1, 2, 2, 1, 2, 1, 2]


@pytest.mark.parametrize(
    ("units", "kitchen", "expected"),
    [
        pytest.param((), "goal", ["goal !"], id="a goal at hand"),
        pytest.param(("a -x-> goal",), "goal + a", ["goal !"], id="what is at hand is not made"),
        pytest.param(("-rain-> goal",), "", ["goal", "goal !"], id="a unit without needs"),
        pytest.param(
            ("a -x-> goal", "b -y-> goal"), "b", ["goal", "goal a b !"], id="the next unit where one fails"
        ),
        pytest.param(
            ("a -x-> goal", "b -y-> goal"), "a + b", ["goal", "goal a !"], id="no unit behind one that works"
        ),
        pytest.param(
            ("no + a + b -x-> goal", "c -y-> goal"),
            "a + b + c",
            ["goal", "goal no a b c !"],
            id="all needs of a unit, though the first fails",
        ),
        pytest.param(
            ("p -x-> goal", "q -y-> goal", "a -z-> p", "b -w-> q"),
            "b",
            ["goal", "goal p q", "goal p a q b !"],
            id="depth first",
        ),
        pytest.param(
            ("p + q -x-> goal", "s -y-> p", "s -z-> q", "a -w-> s"),
            "a",
            ["goal", "goal p q", "goal p s q", "goal p s a q !"],
            id="a result that two units share is explored once",
        ),
        pytest.param(
            ("p + s -x-> goal", "q -y-> p", "s -z-> q", "t -w-> s", "a -v-> t"),
            "a",
            [
                "goal",
                "goal p s",
                "goal p q s t",
                "goal p q s s t a",
                "goal p q s t s t a",
                "goal p q s t a s t !",
            ],
            id="explored again with more depth left",
        ),
        pytest.param(
            ("o + p -x-> goal", "c -u1-> o", "d -u2-> c", "a -u3-> d", "e -v-> o", "q -y-> p", "o -z-> q"),
            "a + e",
            [
                "goal",
                "goal o p",
                "goal o c e p q",
                "goal o c d e p q",
                "goal o c d a p q o e !",
            ],
            id="explored again to be made in fewer units",
        ),
        pytest.param(
            ("b -x-> goal", "goal -y-> b", "a -z-> b"),
            "a",
            ["goal", "goal b", "goal b a !"],
            id="a circle is not followed round",
        ),
        pytest.param(("b -x-> goal", "goal -y-> b"), "a", ["goal", "goal b", "goal b"], id="only a circle"),
        pytest.param(
            ("b -x-> goal", "c -y-> b"), "", ["goal", "goal b", "goal b c", "goal b c"], id="out of reach"
        ),
        pytest.param((), "", ["goal", "goal"], id="nothing makes the goal"),
    ],
)
def test_small_graphs(units: tuple[str, ...], kitchen: str, expected: list[str]) -> None:
    assert traced((*units, "goal -serve-> served"), kitchen) == expected


def test_a_result_of_less_depth_is_not_taken_for_one_of_more() -> None:
    """n is made in one unit, then in three; so p is too deep when it is met again, and n is not."""
    ways = ("c -u1-> n", "d -u2-> c", "a -u3-> d", "e -v-> n", "n -m-> p", "k1 + p + q1 -m-> goal")
    detours = ("k2 -m-> k1", "k3 -m-> k2", "k4 -m-> k3", "n -m-> k4", "q2 -m-> q1", "q3 -m-> q2", "p -m-> q3")
    where = domain((*ways, *detours), "a + e")
    bound = explore(where, where.id_of(node("goal")), 6)
    assert labels(where, bound) == "goal k1 k2 k3 k4 n c e p n c d a q1 q2 q3 p"


def test_implied_views_and_bare_tools_are_read_as_everywhere() -> None:
    where = domain(["bowl{onion} + onion@bowl + (spoon) -stir-> goal"], "onion@bowl", utensils=["bowl"])
    found = trace(where, where.id_of(node("goal")))
    assert [labels(where, bound) for bound in found] == ["goal", "goal onion spoon", "goal onion spoon"]


def chain(length: int) -> Domain:
    """Return a domain in which x0 is made of x1, that of x2, and so on."""
    builder = FoonBuilder()
    things = [builder.object(node(f"x{place}")) for place in range(length + 1)]
    for made, needed in pairwise(things):
        builder.unit("make", [needed], [made], Annotation())
    return Domain(builder.build(), Kitchen((node(f"x{length}"),)))


def test_a_very_deep_chain() -> None:
    length = 100_000
    where = chain(length)
    goal = where.id_of(node("x0"))
    assert not explore(where, goal, length - 1).reached
    bound = explore(where, goal, length)
    assert bound.reached
    assert [depth for _, depth in bound.explored] == list(range(length + 1))
    # The first limits are there at once, though all of them would be five thousand million visits.
    assert [len(each.explored) for each in islice(bounds(where, goal), 3)] == [1, 2, 3]


def test_shared_results_do_not_make_it_exponential() -> None:
    units = [f"a{k + 1} + b{k + 1} -m-> {name}{k}" for k in range(200) for name in "ab"]
    where = domain(units, "a200 + b200")
    goal = where.id_of(node("a0"))
    bound = explore(where, goal, 200)
    assert bound.reached
    assert len(bound.explored) == 2 * 200 + 1
    # No limit shows an object more often than there is depth.
    assert max(len(explore(where, goal, limit).explored) for limit in range(0, 200, 20)) <= 2 * 200 + 1


# --- Properties -----------------------------------------------------------------------------------


class TooLongError(Exception):
    """The literal search takes too long: it repeats itself without end."""


class Literal:
    """The depth-bounded search as it is defined, without any memory, over brute force's own reading."""

    def __init__(self, where: Domain) -> None:
        self.where = where
        self.visits: list[tuple[ObjectNode, int]] = []
        self.kept: set[ObjectNode] = set()

    def search(self, thing: ObjectNode, left: int, depth: int = 0) -> set[ObjectNode] | None:
        """Return the objects of the tree that makes a thing, or None if there is none so deep."""
        self.visits.append((thing, depth))
        if len(self.visits) > 3000:
            raise TooLongError
        if thing in self.where.kitchen.objects:
            return {thing}
        for unit in self.where.foon.units if left else ():
            if thing not in brute_force.makes(self.where, unit):
                continue
            needed = brute_force.needs(self.where, unit)
            needs = [each for each in map(self.where.node, unit.inputs) if each in needed]
            found = [self.search(need, left - 1, depth + 1) for need in needs]
            parts = [each for each in found if each is not None]
            if len(parts) == len(found):
                return {thing}.union(*parts)
        return None


def is_part(short: Iterable[object], long: Iterable[object]) -> bool:
    """Say whether a sequence is another one with some members left out."""
    rest = iter(long)
    return all(item in rest for item in short)


@many(300)
@given(queries(), st.integers(0, 6))
def test_each_limit_is_the_literal_search_with_repeats_left_out(query: Query, limit: int) -> None:
    where, goal = query
    literal = Literal(where)
    try:
        kept = literal.search(goal, limit)
    except TooLongError:
        assume(False)
    bound = explore(where, where.id_of(goal), limit)
    visits = [(where.node(thing), depth) for thing, depth in bound.explored]
    assert bound.reached == (kept is not None)
    assert is_part(visits, literal.visits)
    things = [thing for thing, _ in visits]
    repeats = len(literal.visits) - len({thing for thing, _ in literal.visits})
    event("repeats" if repeats else "no repeats")
    if not repeats:
        assert visits == literal.visits
    assert (kept or set()) <= set(things)


@many(150)
@given(queries())
def test_it_ends_at_the_bound_of_the_method_ids(query: Query) -> None:
    where, goal = query
    found = trace(where, where.id_of(goal))
    rounds, _ = brute_force.closure(where, range(len(where.foon.units)))
    tree = retrieve(where, goal, "ids").tree
    last = found[-1]
    assert [bound.limit for bound in found] == list(range(len(found)))
    assert not any(bound.reached for bound in found[:-1])
    assert last.reached == (goal in rounds) == (tree is not None)
    if tree is None:
        seen = {thing for bound in found[:-1] for thing, _ in bound.explored}
        assert {thing for thing, _ in last.explored} <= seen
        return
    assert last.limit == rounds[goal] == tree.depth
    # The tree of the method lies within what was explored last, and so does all that the goal takes.
    things = {where.node(thing) for thing, _ in last.explored}
    assert {where.node(thing) for unit in tree.units for thing in where.reading.needs[unit]} <= things
    enough = [unit.id for unit in where.foon.units if brute_force.needs(where, unit) <= things]
    assert brute_force.closure(where, enough)[0][goal] == last.limit


def distances(where: Domain, goal: ObjectNode) -> dict[ObjectNode, int]:
    """Return how many units objects are away from the goal, by any way at all."""
    found = {goal: 0}
    for _ in where.foon.objects:
        for unit in where.foon.units:
            made = [found[thing] for thing in brute_force.makes(where, unit) if thing in found]
            for thing in brute_force.needs(where, unit) if made else ():
                found[thing] = min(min(made) + 1, found.get(thing, min(made) + 1))
    return found


@many(150)
@given(queries())
def test_no_object_is_further_away_than_the_limit(query: Query) -> None:
    where, goal = query
    away = distances(where, goal)
    for bound in trace(where, where.id_of(goal)):
        visits: dict[int, list[int]] = {}
        for thing, depth in bound.explored:
            assert away[where.node(thing)] <= depth <= bound.limit
            visits.setdefault(thing, []).append(depth)
        # So there are at most objects times depth of them.
        assert all(len(depths) == len(set(depths)) for depths in visits.values())


# --- How it is written ----------------------------------------------------------------------------

ONIONS = ("onion[whole] + (knife) -cut-> onion[chopped]@bowl", "onion[chopped]@bowl -fry-> goal")


def test_text() -> None:
    where = domain(ONIONS, "onion[whole] + (knife)")
    goal = where.id_of(node("goal"))
    assert trace_text(where, bounds(where, goal)) == (
        "limit 0: goal [ready]\n"
        "limit 1: goal [ready], onion [chopped] in [bowl]\n"
        "limit 2: goal [ready], onion [chopped] in [bowl], onion [whole], knife\n"
        "the goal is reached with limit 2\n"
    )
    where = domain(ONIONS, "onion[whole]")
    assert trace_text(where, trace(where, goal)).splitlines()[-1] == "the goal is not reached with limit 3"


def test_long_lines_are_wrapped() -> None:
    where = chain(40)
    bound = explore(where, where.id_of(node("x0")), 39)
    lines = bound_text(where, bound).splitlines()
    assert len(lines) > 3
    assert max(map(len, lines)) <= 100
    assert lines[0].startswith("limit 39: x0 [ready], x1")
    assert all(line.startswith("    x") or line.startswith("    [ready]") for line in lines[1:])


def test_json() -> None:
    where = domain(ONIONS, "onion[whole] + (knife)")
    value = trace_value(where, bounds(where, where.id_of(node("goal"))))
    assert json.loads(json.dumps(value)) == value
    assert [(each["limit"], len(each["explored"]), each["reached"]) for each in value] == [
        (0, 1, False),
        (1, 2, False),
        (2, 4, True),
    ]
    assert value[2]["explored"][1] == {
        "label": "onion",
        "states": ["chopped"],
        "ingredients": [],
        "container": "bowl",
    }


# --- Real data ------------------------------------------------------------------------------------


def check_all(data: Dataset, where: Domain) -> int:
    """Compare with the method `ids`, goal by goal; return how many could be made."""
    made = 0
    for goal in data.goals:
        last = trace(where, where.id_of(goal))[-1]
        tree = retrieve(where, goal, "ids").tree
        assert last.reached == (tree is not None)
        if tree is not None:
            made += 1
            assert last.limit == tree.depth
            needs = {thing for unit in tree.units for thing in where.reading.needs[unit]}
            assert needs <= {thing for thing, _ in last.explored}
    return made


def test_built_in_goals(built_in: Dataset) -> None:
    assert check_all(built_in, built_in.domain()) > 0


def test_universal_goals(universal: Dataset, universal_domain: Domain) -> None:
    assert check_all(universal, universal_domain) == 23
    # Fewer than two thousand visits for each goal: this can be read.
    goals = map(universal_domain.id_of, universal.goals)
    sizes = [sum(len(bound.explored) for bound in trace(universal_domain, goal)) for goal in goals]
    assert max(sizes) == 1742
