"""Statistics of the public universal FOON."""

from __future__ import annotations

from collections import Counter

import pytest

from foon_asp.audit.stats import centralities, statistics
from foon_asp.io.folder import Dataset
from foon_asp.model.levels import at_level
from support.plain_centralities import check_against_numpy
from support.small_foons import node

# --- The public data ------------------------------------------------------------------------------


def test_statistics_of_the_universal_foon(universal: Dataset) -> None:
    found = statistics(universal.foon, len(universal.foon.units), universal.findings)
    assert (found.units, found.objects, found.motions) == (2376, 4305, 129)
    assert found.labels == found.levels[1][1] == len({thing.label for thing in universal.foon.objects})
    assert found.findings == Counter(finding.code for finding in universal.findings)
    edges = sum(len(unit.inputs) for unit in universal.foon.units)
    assert found.degrees.users.mean * 4305 == pytest.approx(edges)
    assert found.degrees.inputs.mean * 2376 == pytest.approx(edges)
    assert found.most_used_objects[0] == (node("(knife)"), 191)
    assert found.most_used_motions[0] == ("pour", 539)


def test_centralities_of_the_universal_foon(universal: Dataset) -> None:
    found = centralities(universal.foon)
    tops = [each.top[0][0] for each in (found.degree, found.katz, found.eigenvector)]
    assert tops == [node("bowl[empty]")] * 3
    neighbours = {
        tuple(sorted((a, b)))
        for unit in universal.foon.units
        for a in unit.inputs
        for b in unit.outputs
        if a != b
    }
    assert found.edges == len(neighbours)
    assert sum(found.degree.values.values()) * 4304 == pytest.approx(2 * found.edges, rel=1e-2)


def test_centralities_of_the_labels_are_those_of_numpy(universal: Dataset) -> None:
    view = at_level(universal.foon, 1)
    found = centralities(view)
    assert found == centralities(view)
    check_against_numpy(view, found)
    assert [each.top[0][0].label for each in (found.degree, found.katz, found.eigenvector)] == ["bowl"] * 3
