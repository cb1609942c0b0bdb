"""Every FOON survives writing, and what is read or merged twice keeps the better."""

from __future__ import annotations

import json
from contextlib import suppress

from hypothesis import given
from hypothesis import strategies as st

from foon_asp.io.json import write_api
from foon_asp.io.syntax import LONGEST_TIME, parse_time, time_text
from foon_asp.io.text import write_text
from foon_asp.model.foon import Foon, FoonBuilder, merge
from foon_asp.model.node import Annotation, ObjectNode
from support.drawn_foons import foons
from support.examples import many
from support.reading_checks import check_writing, read

# Round trips


PART = st.integers(0, 10**9).map(str)
TIME = st.builds(
    "{}{}:{}{}".format, st.just("") | PART.map("{}:".format), PART, PART, st.just("") | PART.map(".{}".format)
)


@given(TIME)
def test_every_time_that_is_read_is_written_so_that_it_can_be_read(text: str) -> None:
    with suppress(ValueError):
        seconds = parse_time(text)
        assert seconds is not None
        assert seconds <= LONGEST_TIME
        assert parse_time(time_text(seconds)) == seconds


@given(st.integers(0, round(LONGEST_TIME) * 1000))
def test_every_time_that_a_store_may_have_survives_writing(thousandths: int) -> None:
    assert parse_time(time_text(thousandths / 1000)) == thousandths / 1000


@many(200)
@given(foons())
def test_every_foon_survives_writing(foon: Foon) -> None:
    check_writing(foon)


RATES = st.one_of(st.none(), st.floats(0, 1))


@given(st.lists(RATES, min_size=1, max_size=4), st.booleans())
def test_units_alike_but_for_their_rate_keep_the_best(rates: list[float | None], as_json: bool) -> None:
    """In text, in JSON, in a FOON that is merged; whatever differs is told."""
    parts = []
    for rate in rates:
        builder = FoonBuilder()
        a, b = (builder.object(ObjectNode(label)) for label in "ab")
        builder.unit("x", [a], [b], Annotation(rate=rate))
        foon = builder.build()
        parts.append(foon)
    known = [rate for rate in rates if rate is not None]
    best = max(known) if known else None
    assert [unit.annotation.rate for unit in merge(parts).units] == [best]
    if as_json:
        texts = [write_api(foon, foon.units) for foon in parts]
        text = "[" + ",\n".join(json.dumps(json.loads(unit)["functional_units"][0]) for unit in texts) + "]"
    else:
        text = "".join(write_text(foon, foon.units, dialect="A") for foon in parts)
    files = read(text)
    assert [unit.annotation.rate for unit in files.foon.units] == [best]
    told = [finding for finding in files.findings if finding.code == "other-rate"]
    assert bool(told) == (len(set(rates)) > 1)
    assert len(told) <= len(rates) - 1
