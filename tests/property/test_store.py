"""Stores lose nothing, whatever is drawn."""

from __future__ import annotations

from dataclasses import replace

from hypothesis import given
from hypothesis import strategies as st

from foon_asp.io.store_tables import from_tables, to_tables
from foon_asp.model.foon import Foon
from foon_asp.model.node import ObjectNode, State
from support.drawn_foons import foons
from support.examples import many


@many(100)
@given(foons())
def test_tables_lose_nothing(foon: Foon) -> None:
    again, findings = from_tables(to_tables(foon, []))
    assert (list(again.objects), list(again.units), findings) == (list(foon.objects), list(foon.units), [])
    assert [again.id_of(node) for node in foon.objects] == list(range(len(foon.objects)))


@many(50)
@given(foons(), st.data())
def test_unknown_nodes_are_not_found(foon: Foon, data: st.DataObject) -> None:
    """A node is found by all of its states and its label, and only then."""
    node = data.draw(st.sampled_from([*foon.objects, ObjectNode("nothing")]))
    known = set(foon.objects)
    for states in (node.states[1:], (*node.states, State("never said"))):
        other = ObjectNode.of(node.label, states)
        assert (foon.id_of(other) is not None) == (other in known)
    stranger = replace(node, label=node.label + "?")
    assert (foon.id_of(stranger) is not None) == (stranger in known)
