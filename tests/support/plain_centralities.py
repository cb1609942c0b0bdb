"""Centralities by numpy."""

from __future__ import annotations

import numpy as np
import pytest

from foon_asp.audit.stats import TOP, Centralities
from foon_asp.model.foon import Foon
from foon_asp.model.node import ObjectId


def adjacency(where: Foon) -> np.ndarray:
    matrix = np.zeros((len(where.objects), len(where.objects)))
    for unit in where.units:
        for before in unit.inputs:
            for behind in unit.outputs:
                if before != behind:
                    matrix[before, behind] = matrix[behind, before] = 1
    return matrix


def check_against_numpy(where: Foon, found: Centralities) -> None:
    matrix = adjacency(where)
    size = len(matrix)
    eigenvalues, vectors = np.linalg.eigh(matrix)
    eigenvector = np.abs(vectors[:, -1])
    katz = np.linalg.solve(np.eye(size) - 0.9 / eigenvalues[-1] * matrix, np.ones(size))
    katz /= np.linalg.norm(katz)
    for centrality, expected in (
        (found.degree, matrix.sum(axis=0) / (size - 1)),
        (found.katz, katz),
        (found.eigenvector, eigenvector),
    ):
        assert list(centrality.values) == list(range(size))
        assert list(centrality.values.values()) == pytest.approx(list(expected), abs=2e-6)
        assert all(value == round(value, 6) for value in centrality.values.values())
        assert [value for _, value in centrality.top] == sorted(centrality.values.values())[::-1][:TOP]
        assert all(
            centrality.values[where.id_of(thing) or ObjectId(0)] == value for thing, value in centrality.top
        )
    assert found.eigenvalue == pytest.approx(eigenvalues[-1], abs=1e-6)
    assert found.alpha == pytest.approx(0.9 / eigenvalues[-1], abs=1e-6)
    assert found.edges == matrix.sum() / 2
