"""Statistics and centralities, against small graphs counted by hand and against numpy."""

from __future__ import annotations

import numpy as np
import pytest

from foon_asp.audit.stats import TOP, Degrees, Spread, centralities, projection, statistics
from foon_asp.io.findings import Finding, Severity
from foon_asp.model.foon import merge
from support.plain_centralities import check_against_numpy
from support.small_foons import foon, node

KITCHEN_WORK = foon(
    "onion[whole] + (knife) -cut-> onion[chopped] + (knife)",
    "carrot[whole] + (knife) -cut-> carrot[chopped]",
    "onion[chopped] + carrot[chopped] + bowl{water} -mix-> bowl{onion,carrot}",
    "onion[chopped] + carrot[chopped] + bowl{oil} -mix-> bowl{onion,carrot}",
)


def test_counts_of_a_small_foon() -> None:
    findings = [
        Finding(code, Severity.NOTE, "a.txt", line, "odd")
        for line, code in enumerate(["repeated-object", "bare-line", "repeated-object"])
    ]
    found = statistics(merge([KITCHEN_WORK, KITCHEN_WORK]), 9, findings)
    assert found.units_read == 9
    assert (found.units, found.duplicates) == (4, 4)
    assert (found.objects, found.labels, found.motions) == (8, 4, 2)
    assert list(found.findings.items()) == [("bare-line", 1), ("repeated-object", 2)]
    # Criterion 2: the two bowls are one, and so are the two ways to mix; level 1: onion, knife, carrot, bowl.
    assert found.levels == {3: (4, 8), 2: (3, 6), 1: (3, 4)}
    assert found.degrees == Degrees(
        makers=Spread(5 / 8, 2),
        users=Spread(10 / 8, 2),
        inputs=Spread(10 / 4, 3),
        outputs=Spread(5 / 4, 2),
    )
    names = ["carrot[chopped]", "(knife)", "onion[chopped]", "bowl{oil}", "bowl{water}", "carrot[whole]"]
    assert [thing for thing, _ in found.most_used_objects[:6]] == [node(name) for name in names]
    assert [count for _, count in found.most_used_objects] == [2, 2, 2, 1, 1, 1, 1]
    assert found.most_used_motions == (("cut", 2), ("mix", 2))


def test_only_the_ten_most_used_are_listed() -> None:
    units = [f"a{number} -m{number % 12:02}-> b" for number in range(30)]
    found = statistics(foon(*units), 30, ())
    assert [name for name, _ in found.most_used_motions] == [f"m{number:02}" for number in range(TOP)]
    assert [count for _, count in found.most_used_motions] == [3] * 6 + [2] * 4
    assert len(found.most_used_objects) == TOP


def test_nothing_at_all() -> None:
    found = statistics(foon(), 0, ())
    assert (found.units, found.objects, found.levels) == (0, 0, {1: (0, 0), 2: (0, 0), 3: (0, 0)})
    assert found.degrees == Degrees(*[Spread(0.0, 0)] * 4)
    assert centralities(foon()).degree.values == {}


def test_the_projection_goes_from_inputs_to_outputs() -> None:
    graph = projection(foon("a + b -mix-> c + a", "a -go-> c", "c -back-> a", "(x) -stay-> (x)"))
    names = {number: graph.nodes[number]["node"].label for number in graph}
    edges = sorted(names[a] + names[b] for a, b in graph.edges)
    assert edges == ["ac", "ba", "bc", "ca"]
    assert sorted(names.values()) == ["a", "b", "c", "x"]


GRAPHS = {
    "a kitchen's work": KITCHEN_WORK,
    "a chain": foon(*(f"a{number} -go-> a{number + 1}" for number in range(12))),
    "a star": foon(*(f"(knife) -cut{number}-> a{number}" for number in range(15))),
    "a circle": foon("a -go-> b", "b -go-> c", "c -go-> a", "c -end-> d"),
    "two parts": foon("a + b + c -mix-> d + a + b", "x -go-> y"),
    "one edge": foon("a -go-> b"),
}


@pytest.mark.parametrize("name", GRAPHS)
def test_centralities_are_those_of_numpy(name: str) -> None:
    check_against_numpy(GRAPHS[name], centralities(GRAPHS[name]))


def test_centralities_of_a_star_by_hand() -> None:
    """With 4 rays the largest eigenvalue is 2; the middle has 1/sqrt(2), each ray half of that."""
    found = centralities(foon(*(f"(middle) -cut-> ray{number}" for number in range(4))))
    assert (found.edges, found.eigenvalue, found.alpha) == (4, 2.0, 0.45)
    assert found.eigenvector.top[0] == (node("(middle)"), 0.707107)
    assert [str(thing) for thing, _ in found.eigenvector.top[1:]] == [f"ray{n} [ready]" for n in range(4)]
    assert {value for _, value in found.eigenvector.top[1:]} == {0.353553}
    assert found.degree.top[:2] == ((node("(middle)"), 1.0), (node("ray0"), 0.25))
    # x = 1 + 0.45 * 4 * y and y = 1 + 0.45 * x, so x = 2.8 / 0.19, y = 1 + 1.26 / 0.19.
    middle, ray = 2.8 / 0.19, 1 + 1.26 / 0.19
    length = (middle**2 + 4 * ray**2) ** 0.5
    assert dict(found.katz.top)[node("(middle)")] == pytest.approx(middle / length, abs=1e-6)
    assert dict(found.katz.top)[node("ray3")] == pytest.approx(ray / length, abs=1e-6)


def test_without_edges_nothing_is_central() -> None:
    found = centralities(foon("a -stay-> a", "b -stay-> b"))
    assert (found.edges, found.eigenvalue) == (0, 0.0)
    assert set(found.degree.values.values()) == set(found.eigenvector.values.values()) == {0.0}
    assert set(found.katz.values.values()) == {0.707107}


def test_directions_are_left_out_for_a_reason() -> None:
    """A FOON without circles: the largest eigenvalue of the directed projection is 0."""
    matrix = np.zeros((len(KITCHEN_WORK.objects),) * 2)
    for a, b in projection(KITCHEN_WORK).edges:
        matrix[a, b] = 1
    assert not np.linalg.matrix_power(matrix, len(matrix)).any()
    assert all(value > 0 for value in centralities(KITCHEN_WORK).eigenvector.values.values())
