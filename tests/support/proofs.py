"""What a peer of the benchmark must have proven."""

from __future__ import annotations

from proof import Proof

from support.small_foons import world

CIRCLE = world(
    [
        "b -melt-> a",
        "a + salt -freeze-> b",
        "c -press-> b",
        "milk -heat-> d",
        "d -stir-> e",
        "e -cool-> c",
        "a + b -mix-> f",
    ],
    "milk + salt",
)
"""A and B make each other; it takes four units more to make either from the kitchen."""


def units(proof: Proof) -> int:
    assert proof.status == "optimal"
    assert proof.tree is not None
    assert proof.tree.executable
    assert sum(proof.phases.values()) <= proof.seconds
    return len(proof.tree.units)
