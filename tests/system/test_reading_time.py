"""No reader takes more than its share of time, whatever the bytes: a line is never gone over again and again.

The limit is a hundred times what a machine at rest takes; what took the square of a line took minutes.
"""

from __future__ import annotations

import time
from collections import Counter
from contextlib import suppress
from pathlib import Path

import pytest

from foon_asp.asp.rules import check_rules
from foon_asp.audit.audit import audit
from foon_asp.audit.unlock import edits
from foon_asp.errors import FoonError
from foon_asp.io.folder import Dataset
from foon_asp.io.open import FoonReader
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, ObjectNode, State, UnitId
from foon_asp.model.notation import LONGEST
from foon_asp.model.spelling import misspellings
from foon_asp.model.world import World
from foon_asp.planning.pddl.names import Names
from foon_asp.planning.pddl.plan_file import read_plan
from foon_asp.query.goals import find_object, written_object

SIZE = 300_000
LIMIT = 6.0
"""Seconds, on a machine that has other things to do."""

UNIT = "\nM\tx\nO\tb\n//\n"
HEADS = [
    "",
    "//",
    "# From: ",
    "O\t",
    "O\ta\t",
    "M\t",
    "M\tx\t",
    "O\ta\nS\t",
    "O\ta\nS\tin\t",
    "O\ta\nS\tcontains {",
]
PIECES = [
    "O ",
    "S ",
    "0",
    "\t",
    "[",
    "{",
    "[a",
    "{a,",
    "{a}",
    "-",
    "<",
    ":",
    "\t0",
    "\ufeff",
    "\x01",
    "\u00a0",
    "*",
    "a ",
]


def seconds_to_read(text: str) -> float:
    started = time.process_time()
    with suppress(FoonError):
        FoonReader().read_data(text.encode(), Path("x.txt"))
    return time.process_time() - started


@pytest.mark.parametrize("head", HEADS)
def test_long_lines(head: str) -> None:
    for piece in PIECES:
        assert seconds_to_read(head + piece * (SIZE // len(piece)) + "\u00a0" + UNIT) < LIMIT, piece


GOAL_HEADS = ["", "ice ", "ice [a] ", "ice [", "ice {", "ice in ", '"', "["]
GOAL_PIECES = [
    " in a",
    " x [y]",
    " x [y]{z}",
    "{a} ",
    "[a] ",
    ",",
    "a, ",
    '"a", ',
    '""',
    " ",
    "{",
    "[",
    "]",
    "a ",
]


@pytest.mark.parametrize("size", [LONGEST, SIZE])
@pytest.mark.parametrize("head", GOAL_HEADS)
def test_long_goals(built_in: Dataset, head: str, size: int) -> None:
    world = built_in.world()
    for piece in GOAL_PIECES:
        for tail in ("", " [b"):
            text = head + piece * ((size - len(head) - len(tail)) // len(piece)) + tail
            started = time.process_time()
            with suppress(FoonError):
                find_object(world, text)
            with suppress(FoonError):
                written_object(text)
            assert time.process_time() - started < LIMIT / 10, (piece, tail)


def test_a_flag_behind_a_long_label() -> None:
    assert seconds_to_read("O\t" + "O " * 75_000 + "\t" + "0" * 150_000 + "1\u00a0" + UNIT) < LIMIT


RULE_PIECES = ["use(1;", "p(X) :- use(X). ", 'violated("x",1) :- use(1).\n', "%", "a:-b.", "f(", "1+", '"a",']


@pytest.mark.parametrize("piece", RULE_PIECES)
@pytest.mark.parametrize("size", [60_000, SIZE])
def test_long_rules(piece: str, size: int) -> None:
    started = time.process_time()
    with suppress(FoonError):
        check_rules("a :- " + piece * (size // len(piece)))
    assert time.process_time() - started < LIMIT


def test_a_table_of_facts_is_as_long_as_it_likes() -> None:
    started = time.process_time()
    check_rules("".join(f'calories("food {number}",{number}).\n' for number in range(20_000)))
    assert time.process_time() - started < LIMIT
    with pytest.raises(FoonError, match="more than 100,000 characters beside facts"):
        check_rules("".join(f"p({number}) :- q.\n" for number in range(20_000)))


def test_a_long_plan_of_many_names(tmp_path: Path) -> None:
    names = Names({}, {f"do-{number}": UnitId(number) for number in range(50_000)})
    path = tmp_path / "plan"
    path.write_text("".join(f"(do-{number % 50_000})\n" for number in range(80_000)))
    started = time.process_time()
    assert len(read_plan(path, names)) == 80_000
    assert time.process_time() - started < LIMIT


@pytest.mark.parametrize("uses", [1, 9])
def test_many_words_with_the_same_first_letter(uses: int) -> None:
    """Half of them are used so often that the others may be misspellings of them."""
    letters = "abcdefgh"
    words = [
        "a" + "".join(letters[number >> shift & 7] for shift in range(0, 24, 3)) for number in range(8000)
    ]
    counts = Counter({word: 1 if place % 2 else uses for place, word in enumerate(words)})
    started = time.process_time()
    found = list(misspellings(counts, ()))
    assert time.process_time() - started < LIMIT
    assert bool(found) == (uses > 5)


def test_two_long_words_that_differ_in_a_letter() -> None:
    one, other = "a" * 8000, "a" * 4000 + "b" + "a" * 3999
    started = time.process_time()
    list(misspellings(Counter({one: 1, other: 9}), ()))
    assert time.process_time() - started < LIMIT


WORDS = [f"a{number:04x}{number * 7919 % 4096:03x}" for number in range(1500)]


@pytest.mark.parametrize(
    ("names", "others"),
    [(WORDS, [word + "z" for word in WORDS]), (["a" * 99_999 + "b"], ["a" * 50_000 + "c" + "a" * 50_000])],
    ids=["many", "long"],
)
def test_unknown_words_that_are_like_known_ones(names: list[str], others: list[str]) -> None:
    units = zip(names, others, strict=True)
    reader = FoonReader()
    text = "".join(f"O\t{name}\nS\tin\t[{other}]\nM\t{other}\nO\tb\n//\n" for name, other in units)
    reader.read_data(text.encode(), Path("x.txt"))
    started = time.process_time()
    report = audit(reader.finish().foon, Kitchen((), rates=dict.fromkeys(names, 0.5)))
    assert time.process_time() - started < LIMIT
    for code in ("unknown-label", "motion-without-rate"):
        found = [finding.message for finding in report.findings if finding.code == code]
        assert len(found) == len(names)
        assert sum("closest: " in message for message in found) == (100 if len(names) > 1 else 0)


MANY = 10_000
RECIPES = {
    "a ring": [((place + 1) % MANY, place) for place in range(MANY)],
    "a way out of a ring": [(place, place + 1) for place in range(MANY)] + [(0, 0)],
    "a way out of a ring, the last unit first": [(place + 1, place) for place in range(MANY)]
    + [(MANY, MANY)],
    "many rings": [(place, place - 2 if place % 3 == 2 else place + 1) for place in range(MANY)],
    "nothing in common": [(2 * place, 2 * place + 1) for place in range(MANY)],
}
"""What each of many units needs and makes, by number."""


@pytest.mark.parametrize("shape", RECIPES)
def test_many_units_that_never_run(shape: str) -> None:
    builder = FoonBuilder()
    for need, made in RECIPES[shape]:
        needs, makes = (builder.object(ObjectNode.of(str(each), [State("ready")])) for each in (need, made))
        builder.unit("x", [needs], [makes], Annotation())
    world = World.of(builder.build(), Kitchen(()))
    started = time.process_time()
    opened = sum(len(edit.opened) for edit in edits(world))
    assert time.process_time() - started < LIMIT
    assert opened == len(RECIPES[shape])
