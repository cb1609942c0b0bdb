"""Statistics of a FOON: sizes, degrees, what is used most, and centrality in the one-mode projection."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Hashable, Iterable, Mapping
from dataclasses import dataclass
from math import fsum
from typing import TYPE_CHECKING, TypeVar

from foon_asp.errors import QueryError
from foon_asp.io.findings import Finding
from foon_asp.model.foon import Foon
from foon_asp.model.levels import FULL, LEVELS, at_level, check_level
from foon_asp.model.node import ObjectId, ObjectNode

if TYPE_CHECKING:
    import networkx as nx

TOP = 10
"""How many of the most used or most central are listed."""

DAMPING = 0.9
"""Katz centrality weights walks by powers of this fraction of 1 / (largest eigenvalue)."""

DIGITS = 6
_ROUNDS = 10_000
_EIGENVECTOR_TOLERANCE = 1e-11
_KATZ_TOLERANCE = 1e-8

_Item = TypeVar("_Item", bound=Hashable)


@dataclass(frozen=True, slots=True)
class Spread:
    """Mean and maximum of a degree; both are 0 where there is nothing to count."""

    mean: float
    maximum: int


@dataclass(frozen=True, slots=True)
class Degrees:
    """By object: the units that list it as output (`makers`) or input (`users`). By unit: its ports.

    These are the edges as annotated; that a bare output is not made does not matter here.
    """

    makers: Spread
    users: Spread
    inputs: Spread
    outputs: Spread


@dataclass(frozen=True, slots=True)
class Statistics:
    """What there is in a FOON.

    `units_read` is given by the caller: units in the files, before duplicates were removed. `findings`
    counts them by code, `levels` says the units and objects on each level of detail. Objects are used by
    the units that list them as inputs, motions by the units that have them; equally many are sorted by
    name.
    """

    units_read: int
    units: int
    duplicates: int
    objects: int
    labels: int
    motions: int
    findings: Mapping[str, int]
    levels: Mapping[int, tuple[int, int]]
    degrees: Degrees
    most_used_objects: tuple[tuple[ObjectNode, int], ...]
    most_used_motions: tuple[tuple[str, int], ...]


@dataclass(frozen=True, slots=True)
class Centrality:
    """A centrality of every object, by its id, rounded; and the most central, equal ones by name."""

    values: Mapping[ObjectId, float]
    top: tuple[tuple[ObjectNode, float], ...]


@dataclass(frozen=True, slots=True)
class Centralities:
    """Three centralities on the same graph, and that graph's numbers, all rounded to 6 digits.

    `edges` counts its edges, `eigenvalue` is the largest one of its adjacency matrix, `alpha` the
    attenuation of Katz centrality.
    """

    edges: int
    eigenvalue: float
    alpha: float
    degree: Centrality
    katz: Centrality
    eigenvector: Centrality


def statistics(foon: Foon, units_read: int, findings: Iterable[Finding], level: int = FULL) -> Statistics:
    """Count what is in a FOON, seen on a level; `levels` is always that of the FOON as given."""
    views = {each: at_level(foon, each) for each in LEVELS}
    foon = views[check_level(level)]
    users = Counter(object_id for unit in foon.units for object_id in unit.inputs)
    makers = Counter(object_id for unit in foon.units for object_id in unit.outputs)
    motions = Counter(unit.motion for unit in foon.units)
    codes = Counter(finding.code for finding in findings)
    used = {foon.objects[number]: count for number, count in users.items()}
    return Statistics(
        units_read=units_read,
        units=len(foon.units),
        duplicates=foon.duplicates,
        objects=len(foon.objects),
        labels=len(foon.labels),
        motions=len(motions),
        findings={code: codes[code] for code in sorted(codes)},
        levels={each: (len(view.units), len(view.objects)) for each, view in views.items()},
        degrees=Degrees(
            makers=_spread(makers.values(), len(foon.objects)),
            users=_spread(users.values(), len(foon.objects)),
            inputs=_spread([len(unit.inputs) for unit in foon.units], len(foon.units)),
            outputs=_spread([len(unit.outputs) for unit in foon.units], len(foon.units)),
        ),
        most_used_objects=_top(used, lambda node: node.sort_key),
        most_used_motions=_top(motions, lambda motion: motion),
    )


def projection(foon: Foon) -> nx.DiGraph:
    """Return the one-mode projection: the objects by id, and an edge from each input to each output.

    Units are no nodes any more, however many lie between two objects; there are no loops. Every node has
    its object as the attribute `node`.
    """
    import networkx as nx

    graph = nx.DiGraph()
    graph.add_nodes_from((number, {"node": node}) for number, node in enumerate(foon.objects))
    for unit in foon.units:
        graph.add_edges_from((a, b) for a in unit.inputs for b in unit.outputs if a != b)
    return graph


def centralities(foon: Foon) -> Centralities:
    """Return degree, Katz and eigenvector centrality in the one-mode projection without directions.

    Degree is the fraction of the other objects that are neighbours. Eigenvector centrality belongs to the
    largest eigenvalue of the adjacency matrix, by power iteration from equal values; where the graph has
    several parts, objects outside the part with the largest eigenvalue have none. Katz centrality solves
    x = alpha A x + 1 with alpha = 0.9 / (largest eigenvalue). Both have Euclidean length 1. Raises
    `QueryError` if the iteration does not settle, which takes two eigenvalues that are almost equal.

    Directions are left out because with them the eigenvector is zero for every object that is on no way
    to or from a circle, and in a FOON without circles for all; see `docs/levels.md`.
    """
    import networkx as nx

    graph = projection(foon).to_undirected()
    edges = graph.number_of_edges()
    if not edges:
        even = {number: 1 / len(foon.objects) ** 0.5 for number in graph}
        none = dict.fromkeys(graph, 0.0)
        return Centralities(0, 0.0, 0.0, *(_centrality(foon, each) for each in (none, even, none)))
    try:
        eigenvector = nx.eigenvector_centrality(graph, max_iter=_ROUNDS, tol=_EIGENVECTOR_TOLERANCE)
        # The Rayleigh quotient of a vector of length 1.
        eigenvalue = 2 * fsum(eigenvector[a] * eigenvector[b] for a, b in graph.edges)
        alpha = DAMPING / eigenvalue
        katz = nx.katz_centrality(graph, alpha, max_iter=_ROUNDS, tol=_KATZ_TOLERANCE)
    except nx.PowerIterationFailedConvergence as error:
        raise QueryError(
            f"the eigenvector centrality of this FOON does not settle in {_ROUNDS} rounds"
            " (two parts of it are almost equally central); take a part of the FOON"
        ) from error
    return Centralities(
        edges=edges,
        eigenvalue=round(eigenvalue, DIGITS),
        alpha=round(alpha, DIGITS),
        degree=_centrality(foon, nx.degree_centrality(graph)),
        katz=_centrality(foon, katz),
        eigenvector=_centrality(foon, eigenvector),
    )


def _centrality(foon: Foon, raw: Mapping[ObjectId, float]) -> Centrality:
    values = {number: round(raw[number], DIGITS) for number in foon.objects.ids}
    ranked = _top(values, lambda number: foon.objects[number].sort_key)
    return Centrality(values, tuple((foon.objects[number], value) for number, value in ranked))


_Number = TypeVar("_Number", int, float)


def _top(
    values: Mapping[_Item, _Number], name: Callable[[_Item], object]
) -> tuple[tuple[_Item, _Number], ...]:
    """Return the items with the highest values, equal ones sorted by name."""
    ranked = sorted(values.items(), key=lambda entry: (-entry[1], name(entry[0])))
    return tuple(ranked[:TOP])


def _spread(degrees: Collection[int], count: int) -> Spread:
    """Return mean and maximum over so many, those of degree 0 left out of the list."""
    return Spread(sum(degrees) / count if count else 0.0, max(degrees, default=0))
