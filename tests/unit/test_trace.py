"""The trace of iterative deepening: the seed paper's example, small graphs, the literal search, real data."""

from __future__ import annotations

import json
from collections.abc import Iterable
from itertools import islice, pairwise

import pytest
from msgspec import to_builtins

from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation
from foon_asp.model.world import World
from foon_asp.render.trace import bound_text, trace_text
from foon_asp.retrieval.trace import Bound, bounds, explore, trace
from foon_asp.retrieval.wire import trace_json
from support.small_foons import node, world


def labels(where: World, bound: Bound) -> str:
    return " ".join(where.node(thing).label for thing, _ in bound.explored)


def traced(units: Iterable[str], kitchen: str, goal: str = "goal") -> list[str]:
    """Return one line for each limit: what was explored, and `!` if the goal was reached."""
    where = world(units, kitchen)
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
    where = world(PAPER, "i + j + m + o + p + r + s")
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
    where = world((*ways, *detours), "a + e")
    bound = explore(where, where.id_of(node("goal")), 6)
    assert labels(where, bound) == "goal k1 k2 k3 k4 n c e p n c d a q1 q2 q3 p"


def test_implied_views_and_bare_tools_are_read_as_everywhere() -> None:
    where = world(["bowl{onion} + onion@bowl + (spoon) -stir-> goal"], "onion@bowl", utensils=["bowl"])
    found = trace(where, where.id_of(node("goal")))
    assert [labels(where, bound) for bound in found] == ["goal", "goal onion spoon", "goal onion spoon"]


def chain(length: int) -> World:
    """Return a domain in which x0 is made of x1, that of x2, and so on."""
    builder = FoonBuilder()
    things = [builder.object(node(f"x{place}")) for place in range(length + 1)]
    for made, needed in pairwise(things):
        builder.unit("make", [needed], [made], Annotation())
    return World.of(builder.build(), Kitchen((node(f"x{length}"),)))


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
    where = world(units, "a200 + b200")
    goal = where.id_of(node("a0"))
    bound = explore(where, goal, 200)
    assert bound.reached
    assert len(bound.explored) == 2 * 200 + 1
    # No limit shows an object more often than there is depth.
    assert max(len(explore(where, goal, limit).explored) for limit in range(0, 200, 20)) <= 2 * 200 + 1


# --- How it is written ----------------------------------------------------------------------------

ONIONS = ("onion[whole] + (knife) -cut-> onion[chopped]@bowl", "onion[chopped]@bowl -fry-> goal")


def test_text() -> None:
    where = world(ONIONS, "onion[whole] + (knife)")
    goal = where.id_of(node("goal"))
    assert trace_text(where, bounds(where, goal)) == (
        "limit 0: goal [ready]\n"
        "limit 1: goal [ready], onion [chopped] in [bowl]\n"
        "limit 2: goal [ready], onion [chopped] in [bowl], onion [whole], knife\n"
        "the goal is reached with limit 2\n"
    )
    where = world(ONIONS, "onion[whole]")
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
    where = world(ONIONS, "onion[whole] + (knife)")
    value = to_builtins(trace_json(where, bounds(where, where.id_of(node("goal")))))
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
