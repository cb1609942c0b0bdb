"""Pareto fronts as plots: a point for each trade-off, its costs beside it. No library draws them but ours."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from foon_asp.draw.picture import Edge, Node, Picture, Role
from foon_asp.errors import QueryError
from foon_asp.query.objective import Costs, Criterion
from foon_asp.retrieval.alternatives import Alternatives
from foon_asp.words import counted

_WIDTH, _HEIGHT = 460.0, 300.0
"""Size of the plot itself, in points."""

_LEFT, _TOP = 70.0, 40.0
_TICKS = 5


def front_picture(found: Alternatives) -> Picture:
    """Return the trade-offs between the first two criteria as points; others are said beside them.

    Raises `QueryError` where there is no tree, or just one criterion.
    """
    criteria = found.query.objective.criteria
    if len(criteria) < 2:
        raise QueryError("a front is drawn by two criteria; name them as in --pareto units,success")
    if not found.trees:
        raise QueryError(f"no front: {found.reason or found.status}")
    costs = [[_cost(tree.costs, each) for each in criteria] for tree in found.trees]
    across, up = (_Axis.of(str(criteria[n]), [each[n] for each in costs]) for n in (0, 1))
    points = [
        Node(
            f"p{place}",
            Role.POINT,
            "",
            title="\n".join(
                [
                    f"tree {place + 1}",
                    *(f"{name} {cost:.4g}" for name, cost in zip(found.by, paid, strict=True)),
                ]
            ),
            place=(
                _LEFT + across.share(paid[0]) * _WIDTH,
                _TOP + (1 - up.share(paid[1])) * _HEIGHT,
            ),
        )
        for place, paid in enumerate(costs)
    ]
    beside = [_beside(point, place, len(criteria) > 2) for place, point in enumerate(points, 1)]
    nodes, lines = _frame(across, up)
    # By more criteria than the axes show a point may be better than it looks.
    corners, front = _stairs(points) if len(criteria) == 2 else ([], [])
    goal = found.goal.label
    trees = counted(len(found.trees), "tree")
    summary = f"{trees} for {found.goal}, none of them better than another by all of {', '.join(found.by)}."
    head = f"{goal}: {trees}, {' against '.join(found.by[:2])}"
    return Picture(head, summary, [*nodes, *corners, *beside, *points], [*lines, *front])


def _cost(costs: Costs, criterion: Criterion) -> float:
    """Return what a tree costs by a criterion, a chance if that is success alone."""
    found = criterion.bound(criterion.cost(costs))
    if math.isinf(found):
        raise QueryError(f"a front by {criterion} cannot be drawn: it is not known of every tree")
    return found


def _beside(point: Node, place: int, all_of_it: bool) -> Node:
    """Return the words beside a point: the number of its tree, and what the axes do not show."""
    assert point.place is not None
    x, y = point.place
    rest = point.title.split("\n")[3:] if all_of_it else []
    text = ", ".join([f"{place}", *rest])
    return Node(
        f"w{place}", Role.NOTE, "", (text,), title=point.title, place=(x + 10 + 3.4 * len(text), y - 11)
    )


@dataclass(frozen=True, slots=True)
class _Axis:
    """The numbers that an axis shows: from `low` to `high`, with a mark every `step`."""

    name: str
    low: float
    high: float
    step: float

    @classmethod
    def of(cls, name: str, values: Sequence[float]) -> _Axis:
        """Return an axis on which some values are, with round numbers at its marks."""
        least, most = min(values), max(values)
        span = (most - least) or abs(most) or 1.0
        rough = span / _TICKS
        size = 10.0 ** math.floor(math.log10(rough))
        step = next(each * size for each in (1, 2, 5, 10) if each * size >= rough * 0.999)
        if least == int(least) and most == int(most):
            step = max(1.0, step)
        low = (math.ceil(least / step) - 1) * step
        return cls(name, max(low, 0.0) if least >= 0 else low, (math.floor(most / step) + 1) * step, step)

    def share(self, value: float) -> float:
        """Return where a value is on the axis, from 0 to 1."""
        return (value - self.low) / (self.high - self.low)

    def marks(self) -> Iterator[tuple[str, float]]:
        """Yield the numbers at the marks, and where they are."""
        for number in range(round((self.high - self.low) / self.step) + 1):
            value = self.low + number * self.step
            yield f"{value:.4g}", self.share(value)

    @property
    def title(self) -> str:
        """The name, and which way is better."""
        return f"{self.name} ({'more' if self.name == 'success' else 'less'} is better)"


def _stairs(points: Sequence[Node]) -> tuple[list[Node], list[Edge]]:
    """Return the border of what can be had: from point to point, across and then up or down."""
    order = sorted(points, key=lambda point: _placed(point))
    corners, edges = [], []
    for number, (before, after) in enumerate(itertools.pairwise(order)):
        corner = _blank(f"c{number}", (_placed(after)[0], _placed(before)[1]))
        corners.append(corner)
        edges += [
            Edge(before.key, corner.key, strong=True, line=True),
            Edge(corner.key, after.key, strong=True, line=True),
        ]
    return corners, edges


def _placed(node: Node) -> tuple[float, float]:
    assert node.place is not None
    return node.place


def _blank(key: str, place: tuple[float, float]) -> Node:
    """Return a node of which nothing is seen, where a line ends."""
    return Node(key, Role.NOTE, "", place=place)


def _words(key: str, text: str, place: tuple[float, float]) -> Node:
    return Node(key, Role.NOTE, "", (text,), title=text, place=place)


def _frame(across: _Axis, up: _Axis) -> tuple[list[Node], list[Edge]]:
    """Return the marks of both axes, with a line through the plot for each, and their names."""
    bottom, right = _TOP + _HEIGHT, _LEFT + _WIDTH
    nodes = [
        _words("t0", across.title, (_LEFT + _WIDTH / 2, bottom + 38)),
        _words("t1", up.title, (_LEFT + 60.0, _TOP - 18)),
    ]
    edges = []
    marks = [
        *((text, _LEFT + share * _WIDTH, None) for text, share in across.marks()),
        *((text, None, bottom - share * _HEIGHT) for text, share in up.marks()),
    ]
    for number, (text, x, y) in enumerate(marks):
        if x is not None:
            ends, place = ((x, bottom), (x, _TOP)), (x, bottom + 14)
        else:
            assert y is not None
            ends, place = ((_LEFT, y), (right, y)), (_LEFT - 26, y)
        nodes += [
            _words(f"m{number}", text, place),
            *(_blank(f"{k}{number}", e) for k, e in zip("ab", ends, strict=True)),
        ]
        edges.append(Edge(f"a{number}", f"b{number}", line=True))
    return nodes, edges
