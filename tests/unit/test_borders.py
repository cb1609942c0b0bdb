"""What Python gives is checked where it is given: a `FoonError` that says what to pass."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import foon_asp as fa
from foon_asp.errors import FoonError
from foon_asp.numbers import COUNT, FACTOR, LEAST_SUCCESS, QUANTITY, RATE, SECONDS, SOME, Number

EGG = fa.ObjectNode("egg")
W: Any = fa.load()
"""The built-in kitchen; what it is asked here has the wrong types."""

fa_: Any = fa

WRONG: tuple[Callable[[], object], ...] = (
    lambda: fa_.Kitchen(["egg"]),
    lambda: fa_.Kitchen("egg"),
    lambda: fa_.Kitchen((), utensils="bowl"),
    lambda: fa_.Kitchen((), default_rate=2),
    lambda: fa_.Kitchen((), default_rate=True),
    lambda: fa_.Kitchen((), default_rate=math.nan),
    lambda: fa_.Kitchen((), default_rate="0.5"),
    lambda: fa_.Kitchen((), rates={"pour": 2}),
    lambda: fa_.Kitchen((), rates=[("pour", 0.2)]),
    lambda: fa_.Kitchen((), rates={"po\nur": 0.2}),
    lambda: fa_.Kitchen((EGG,), quantities={"egg": 2}),
    lambda: fa_.Kitchen((EGG,), quantities={EGG: -1}),
    lambda: fa_.Kitchen((EGG,), quantities={EGG: 10**5000}),
    lambda: fa_.Kitchen((EGG,), quantities={EGG: 1.5}),
    lambda: fa_.ObjectNode("egg", "raw"),
    lambda: fa_.ObjectNode("egg", ["raw"]),
    lambda: fa_.ObjectNode(""),
    lambda: fa_.ObjectNode(5),
    lambda: fa_.ObjectNode("e\x00gg"),
    lambda: fa_.ObjectNode("e\u202egg"),
    lambda: fa_.ObjectNode("e\ud800gg"),
    lambda: fa_.State(""),
    lambda: fa_.State("in", 5),
    lambda: fa_.State("contains", contents="salt"),
    lambda: fa_.State("contains", contents=[1]),
    lambda: fa_.World("FOON.txt"),
    lambda: fa_.World(W.foon, "egg"),
    lambda: fa_.World(W.foon, [5]),
    lambda: fa_.World(W.foon, ["egg"], utensils="bowl"),
    lambda: fa_.World(W.foon, ["egg"], utensils=[5]),
    lambda: fa_.World(W.foon, ["egg"], rates={"pour": 3}),
    lambda: fa_.World(W.foon, 5),
    lambda: fa_.World(W.foon, fa_.Kitchen(()), utensils=["bowl"]),
    lambda: fa_.Query("ice").replace(goals="ice"),
    lambda: fa_.Query("ice").replace(goals=3),
    lambda: W.explain(fa_.Query()),
    lambda: W.all_optimal(fa_.Query()),
    lambda: W.pareto(fa_.Query(by="units,inputs")),
    lambda: W.menu(fa_.Query()),
    lambda: W.with_kitchen("egg"),
    lambda: W.with_kitchen(add="egg"),
    lambda: W.with_kitchen(remove="egg"),
    lambda: W.with_kitchen([5]),
    lambda: W.with_kitchen(5),
    lambda: W.find(5),
    lambda: W.find(""),
    lambda: W.find("e\x00gg"),
    lambda: W.on_level(7),
    lambda: W.on_level(True),
    lambda: W.on_level("2"),
    lambda: W.retrieve(fa_.Query()),
    lambda: W.retrieve(5),
    lambda: W.retrieve(None),
    lambda: fa_.Query(5),
    lambda: fa_.Query(["ice"]),
    lambda: fa_.Query("ice", time_limit=-1),
    lambda: fa_.Query("ice", time_limit="5"),
    lambda: fa_.Query("ice", time_limit=True),
    lambda: fa_.Query("ice", time_limit=math.nan),
    lambda: fa_.Query("ice", max_units=5.5),
    lambda: fa_.Query("ice", max_units="5"),
    lambda: fa_.Query("ice", max_units=True),
    lambda: fa_.Query("ice", min_success="a"),
    lambda: fa_.Query("ice", min_success=2),
    lambda: fa_.Query("ice", min_success=math.nan),
    lambda: fa_.Query("ice", use_units=(True,)),
    lambda: fa_.Query("ice", use_units=5),
    lambda: fa_.Query("ice", use_units=("5",)),
    lambda: fa_.Query("ice", use_units=(1.5,)),
    lambda: fa_.Query("ice", without="egg"),
    lambda: fa_.Query("ice", without=[5]),
    lambda: fa_.Query("ice", without=5),
    lambda: fa_.Query("ice", only_motions=["po\x00ur"]),
    lambda: fa_.Query("ice", diets="vegan"),
    lambda: fa_.Query("ice", diets=[5]),
    lambda: fa_.Query("ice", diets={"x": "egg"}),
    lambda: fa_.Query("ice", diets=5),
    lambda: fa_.Query("ice", by=5),
    lambda: fa_.Query("ice", by=[5]),
    lambda: fa_.Query("ice", method=5),
    lambda: fa_.Query("ice", founded="no"),
    lambda: fa_.Query("ice", rules="a."),
    lambda: fa_.Query("ice", rules=[5]),
    lambda: fa_.Query("ice", kitchen="egg"),
    lambda: fa_.Query("ice", kitchen=5),
    lambda: fa_.Query("ice", add="egg"),
    lambda: fa_.Query("ice", constraints=5),
    lambda: W.retrieve(fa_.Query("ice", kitchen=[5])),
    lambda: W.best("ice", 0),
    lambda: W.best("ice", 1.5),
    lambda: W.best("ice", "2"),
    lambda: W.diverse("ice", -1),
    lambda: W.diverse("ice", 2, math.nan),
    lambda: W.diverse("ice", 2, math.inf),
    lambda: W.diverse("ice", 2, "a"),
    lambda: W.explain("ice", most=-1),
    lambda: W.explain("ice", most="1"),
    lambda: W.explain_step("ice", "5"),
    lambda: W.explain_step("ice", True),
    lambda: W.suggest(-1),
    lambda: W.suggest(1.5),
    lambda: W.suggest(using="egg"),
    lambda: W.suggest(using=[5]),
    lambda: W.suggest(query="ice"),
    lambda: W.compare(time_limit=-1),
    lambda: W.compare("ice"),
    lambda: W.compare([5]),
    lambda: W.menu("ice"),
    lambda: W.menu([]),
    lambda: W.menu([5]),
    lambda: W.menu(5),
    lambda: list(W.answer_many(["ice"], jobs=0)),
    lambda: list(W.answer_many(["ice"], jobs=1.5)),
    lambda: list(W.answer_many("ice")),
    lambda: list(W.answer_many([5])),
    lambda: fa_.load(default_rate=2),
    lambda: fa_.load(foon="FOON.txt"),
    lambda: fa_.load(foon=5),
    lambda: fa_.load(5),
    lambda: fa_.load(level=7),
    lambda: fa_.load(kitchen=5),
    lambda: fa_.read(5),
    lambda: fa_.read("O\ta\ud800\nM\tx\nO\tb\n//\n"),
    lambda: fa_.read([("egg", "crack", "egg")]),
    lambda: fa_.read([(["egg"], 5, ["egg"])]),
    lambda: fa_.read([(["egg"], "", ["egg"])]),
    lambda: fa_.read([(["egg"], "cr\nack", ["egg"])]),
    lambda: fa_.read([(["egg"], "x")]),
    lambda: fa_.read([5]),
    lambda: fa_.read([([5], "x", ["egg"])]),
    lambda: fa_.merge(5),
    lambda: fa_.merge([5]),
    lambda: fa_.Objective.parse(5),
)


@pytest.mark.parametrize("ask", WRONG)
def test_a_value_of_another_kind_is_refused(ask: Callable[[], object]) -> None:
    with pytest.raises(FoonError) as raised:
        ask()
    message = str(raised.value)
    assert "\n" not in message
    assert len(message) < 300
    assert message.isprintable()


def test_what_is_meant_is_taken() -> None:
    """Numbers of numpy, lists of any kind, states in any order, generators."""
    kitchen = fa_.Kitchen([EGG], ["bowl"], {"pour": np.float32(0.5)}, np.float64(1), {EGG: np.int64(2)})
    assert kitchen == fa.Kitchen((EGG,), frozenset({"bowl"}), {"pour": 0.5}, 1.0, {EGG: 2})
    assert type(kitchen.quantities[EGG]) is int
    assert fa_.Query("ice", max_units=np.int64(5), min_success=np.float64(0.5)).constraints.max_units == 5
    assert fa_.read(unit for unit in [(("egg",), "crack", ("egg [cracked]",))]).units[0].motion == "crack"
    assert fa_.World(W.foon, (each for each in ["egg", EGG])).kitchen.objects == (EGG, EGG)


names = st.text(st.sampled_from("ab "), min_size=1, max_size=3).filter(str.strip)
states = st.builds(fa.State, names, st.none() | names, st.none() | st.lists(names, max_size=3).map(tuple))


@given(st.lists(states, max_size=4), st.randoms())
def test_states_in_any_order_make_the_same_node(given_: list[fa.State], random: Any) -> None:
    other = [fa.State(s.name, s.relatum, s.contents and tuple(reversed(s.contents))) for s in given_ * 2]
    random.shuffle(other)
    nodes = {fa_.ObjectNode("x", given_), fa_.ObjectNode("x", tuple(other)), fa.ObjectNode.of("x", other)}
    assert len(nodes) == 1
    [node] = nodes
    assert len(set(node.states)) == len(node.states)
    assert list(node.states) == sorted(set(given_), key=lambda state: state.sort_key)


KINDS = (COUNT, SOME, QUANTITY, RATE, LEAST_SUCCESS, SECONDS, FACTOR)


@given(st.sampled_from(KINDS), st.integers() | st.floats() | st.booleans() | st.text(max_size=5) | st.none())
def test_a_number_fits_or_is_refused(kind: Number, value: Any) -> None:
    """By the definition once more: no truth value, no text, finite, whole where it must be, within bounds."""
    number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
    low = number and (value > kind.least if kind.above else value >= kind.least)
    fits = low and value <= kind.most and (not kind.whole or isinstance(value, int))
    assert kind.fits(value) == fits
    if fits:
        assert kind.checked(value, "x") == value
        assert kind.read(repr(value)) == value
    else:
        with pytest.raises(fa.QueryError, match=r"^'x' is a (whole )?(number|chance)"):
            kind.checked(value, "x")


@pytest.mark.parametrize("text", [" ", "nan", "inf", "1_0", "0x1", "١", "1e", "9" * 5000, "--1", "1,0"])
def test_a_text_that_is_no_number(text: str) -> None:
    for kind in KINDS:
        with pytest.raises(ValueError, match=re.escape(text[:10])):
            kind.read(text)
