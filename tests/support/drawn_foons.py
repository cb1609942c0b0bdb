"""FOONs drawn at random with everything that files can say."""

from __future__ import annotations

import re

from hypothesis import strategies as st

from foon_asp.characters import without_control_characters
from foon_asp.io.syntax import known_times, says_none
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.node import Annotation, Interval, Mark, ObjectNode, Source, State
from foon_asp.model.notation import PLACES


def _says_something(text: str) -> bool:
    """Words like `null` mean nothing where JSON is read."""
    return not says_none(text)


# Public data and the round trips
LABELS = (
    st.text(st.characters(exclude_categories=("Cc", "Cs"), exclude_characters="\ufeff"), max_size=8)
    | st.sampled_from(["olive oil", "bowl", 'a "b"', "c\\d", "#e", "//", "1:00", "in", "contains", "naïve"])
).map(lambda text: without_control_characters(text).lower().strip())
LABEL = LABELS.filter(_says_something)
NAME = LABELS.map(lambda text: re.sub(r"[\[\]{}]", "", text).strip()).filter(_says_something)
CONTENT = NAME.map(lambda text: text.replace(",", "").strip()).filter(_says_something)
CONTENTS = st.lists(CONTENT, max_size=3).map(lambda items: tuple(sorted(items)))


def _sayable(state: State) -> bool:
    if " " in state.name and state.name.split(maxsplit=1)[0] in {"contains", "attached", *PLACES}:
        return False
    if state.relatum is None and state.contents is not None and state.name in PLACES:
        return len(state.contents) != 1
    return state.name != "contains" or state.relatum is None or state.contents is not None


STATE = st.builds(
    State,
    NAME | st.sampled_from(["in", "on", "contains", "hot"]),
    st.none() | NAME,
    st.none() | CONTENTS,
).filter(_sayable)
NODE = st.builds(ObjectNode.of, LABEL, st.lists(STATE, max_size=3))
MOTION = LABEL.map(lambda text: text.rstrip("*").strip()).filter(lambda text: text and text[-1] != "*")
TIME = st.none() | st.integers(0, 10**7).map(lambda count: count / 1000)
TIMES = st.lists(st.builds(Interval, TIME, TIME), max_size=3).map(known_times)
MARK = st.builds(Mark, st.sampled_from([None, True, False]), st.sampled_from(["", "", "!", "0", "29"]))
SOURCE = st.builds(Source, LABELS, st.integers(0, 10**6), LABELS)


@st.composite
def foons(draw: st.DrawFn) -> Foon:
    builder = FoonBuilder()
    pool = draw(st.lists(NODE, min_size=1, max_size=4))
    for _ in range(draw(st.integers(1, 3))):
        inputs, outputs = (
            draw(st.lists(st.sampled_from(pool), min_size=least, max_size=3, unique=True)) for least in (1, 0)
        )
        count = len(inputs) + len(outputs)
        note = Annotation(
            sources=tuple(draw(st.lists(SOURCE, min_size=1, max_size=2))),
            composite=draw(st.booleans()),
            times=draw(TIMES),
            agent=draw(LABELS),
            rate=draw(st.none() | st.floats(0, 1)),
            marks=tuple(draw(st.just([]) | st.lists(MARK, min_size=count, max_size=count))),
        )
        left = [builder.object(node) for node in inputs]
        right = [builder.object(node) for node in outputs]
        builder.unit(draw(MOTION), left, right, note)
    return builder.build()
