"""The reader works on columns of numbers; a reader that goes from line to line must read the same."""

from __future__ import annotations

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foon_asp import limits
from foon_asp.io import lines, text
from foon_asp.io.text import TextReader
from foon_asp.model import numbering
from foon_asp.model.foon import FoonBuilder, merge
from support.examples import many
from support.foon_texts import DIALECTS, EXAMPLES
from support.paths import BUILT_IN
from support.plain_reader import PlainReader
from support.text_reading import outcome

_PLAIN = [
    *("O\ta", "O\tb", "O\tc", "O1\ta\t1\t!", "O2\tb\t0", "S\tin\t[a]", "S\tcontains\t{a,b}", "S\thot", "//"),
    *("M\tx", "M\tx", "M1\ty\t0:01\t0:05\tr\t0.5", "M\tx\t0:01\t0:05\tr\t0.7", "//", "//", "//"),
]
_ODD = [
    *("", " ", "//x", "// ", "# no", "# Source:\tv", "# Source:\tw", "# From:\tf:3", "#From: g", "text"),
    *("O", "O\t", "M", "M\t", "O\ta\tb\t00", "S\tcontains\t{b,a,}", "S hot", "S1\thot", "M\tx*\t0:05\t0:01"),
    *("\ufeffO\ta", "\x01", "O\x02\tb", "\x01\ufeff//", "M\tx\t1\t2\tr\tmuch", "S\tin\t[a]\t{b}", "/", "Moo"),
    *("o\ta", "s hot", "m\tx", "\\\\", "ONone\tb\tNone", "MNULL\tx\tnone", "Snone\thot", "S\tno state"),
    *("M\tx\t<0:01-0:02,0:04-0:05>\tr\t0.5", "M\tx\t<0:01,0:05>", "M\tx\t<0:01-0:05-", "M\tpick + place"),
    *("S\tingredients inside\t{a}", "S\tin foil\t{b}"),
]
_ENDS = st.sampled_from(["\n", "\n", "\n", "\r\n", "\r"])
_ROWS = st.lists(st.tuples(st.sampled_from(_PLAIN) | st.sampled_from(_ODD), _ENDS), max_size=40)
_TEXTS = st.tuples(_ROWS, st.booleans()).map(
    lambda drawn: "".join(map("".join, drawn[0]))[: None if drawn[1] else -1]
)
moderate = many(150)

BUILT_IN_TEXT = BUILT_IN.read_text(encoding="utf-8")


@pytest.fixture(params=["at once", "in pieces"])
def pieces(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Read as long texts are read: line by line parted, by pyarrow, in short stretches."""
    if request.param == "in pieces":
        monkeypatch.setattr(lines, "_LONG", 0)
        monkeypatch.setattr(lines, "_PIECE", 20)
        monkeypatch.setattr(numbering, "_MANY", 0)
        monkeypatch.setattr(text, "_STRETCH", 5)


@pytest.mark.usefixtures("pieces")
class TestSame:
    @moderate
    @given(st.lists(_TEXTS, min_size=1, max_size=3))
    def test_drawn_lines(self, texts: list[str]) -> None:
        assert outcome(TextReader, texts) == outcome(PlainReader, texts)

    def test_every_dialect_and_finding(self) -> None:
        texts = [each for each in (*DIALECTS.values(), *EXAMPLES.values()) if isinstance(each, str)]
        for each in texts:
            assert outcome(TextReader, [each]) == outcome(PlainReader, [each])
        assert outcome(TextReader, texts) == outcome(PlainReader, texts)

    def test_damaged_units(self) -> None:
        """Lines of the built-in FOON swapped, doubled, cut and left out."""
        rng = random.Random(0)
        rows = BUILT_IN_TEXT.splitlines()
        for _ in range(60):
            begin = rng.randrange(len(rows) - 80)
            part = rows[begin : begin + 80]
            for _ in range(rng.randrange(1, 12)):
                place, other = rng.randrange(len(part)), rng.randrange(len(part))
                part[place] = rng.choice((part[other], part[place][: rng.randrange(4)], "", "//", "M\tx"))
            damaged = "\n".join(part)
            assert outcome(TextReader, [damaged]) == outcome(PlainReader, [damaged])


def test_the_built_in_foon() -> None:
    texts = [BUILT_IN_TEXT, BUILT_IN_TEXT[:5000]]
    assert outcome(TextReader, texts) == outcome(PlainReader, texts)


@moderate
@given(st.lists(_TEXTS, min_size=1, max_size=3))
def test_merging_is_reading_one_after_the_other(texts: list[str]) -> None:
    """Units of other FOONs are added in columns, too."""
    foons = []
    builder = FoonBuilder()
    for number, each in enumerate(texts):
        alone = FoonBuilder()
        TextReader(alone).read(each, f"{number}.txt")
        foons.append(alone.build())
        TextReader(builder).read(each, f"{number}.txt")
    merged, read = merge(foons), builder.build()
    assert list(merged.objects) == list(read.objects)
    assert list(merged.units) == list(read.units)
    assert merged.duplicates == read.duplicates


def test_a_limit_of_time_ends_the_reading() -> None:
    reader = TextReader(FoonBuilder())
    with limits.limited(-1), pytest.raises(limits.LimitReachedError):
        reader.read(BUILT_IN_TEXT, "x.txt")
