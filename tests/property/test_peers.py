"""The peers of the benchmark are exact."""

from __future__ import annotations

import cp_sat
import integer_program
from hypothesis import given

from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from support import brute_force
from support.examples import many
from support.proofs import units
from support.small_foons import queries

Drawn = tuple[World, ObjectNode]


def test_peers_are_exact() -> None:
    peers = (cp_sat.solve, integer_program.solve)

    @many(60)
    @given(queries())
    def check(query: Drawn) -> None:
        where, goal = query
        trees = brute_force.trees(where, goal)
        for solve in peers:
            proof = solve(where, goal, 60.0)
            if not trees:
                assert proof.status == "unreachable"
                continue
            assert units(proof) == brute_force.best(trees, ["units"])["units"]
            assert proof.tree is not None
            assert brute_force.replays(where, goal, proof.tree.units)

    check()
