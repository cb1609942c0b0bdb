"""Reading and writing FOON text."""

from __future__ import annotations

from pathlib import Path

import pytest

from foon_asp.errors import InputError
from foon_asp.io.folder import Dataset, read_foon
from foon_asp.io.text import write_text
from foon_asp.model.foon import Foon
from foon_asp.model.node import ObjectId, ObjectNode, Source, State, UnitId, contains, inside
from support.text_reading import meaning, read

UNIT_B = "//\nO\tonion\nS\twhole\nO\tknife\nM\tchop\nO\tonion\nS\tchopped\nO\tknife\n//\n"
UNIT_A = (
    "# Source:\thttp://one\r\n//\r\nO296\tOlive Oil \t1\r\nS65\tin\t[Bottle]\r\nO46\tbowl\t0\r\n"
    "S41\tempty\r\nM54\tpour*\t1:02\t0:01:10\trobot\t0.9\r\nO46\tbowl\t0\t8\r\n"
    "S23\tcontains\t{olive oil}\r\n//\r\n"
)


def codes(text: str) -> list[tuple[str, int]]:
    return [(f.code, f.line) for f in read(text)[1] if f.code != "empty-unit"]


def test_course_dialect() -> None:
    foon, findings = read(UNIT_B)
    [unit] = foon.units
    assert [str(foon.objects[number]) for number in unit.inputs] == ["onion [whole]", "knife"]
    assert [str(foon.objects[number]) for number in unit.outputs] == ["onion [chopped]", "knife"]
    assert unit.motion == "chop"
    assert (unit.source.file, unit.source.line) == ("x.txt", 2)
    assert [f.code for f in findings] == ["empty-unit"]


def test_annotated_dialect_keeps_what_the_annotator_said() -> None:
    foon, _ = read(UNIT_A)
    [unit] = foon.units
    note = unit.annotation
    assert foon.objects[unit.inputs[0]] == ObjectNode.of("olive oil", [inside("bottle")])
    assert foon.objects[unit.outputs[0]] == ObjectNode.of("bowl", [contains("olive oil")])
    assert (unit.motion, note.composite) == ("pour", True)
    assert (note.start, note.end, note.agent, note.rate) == (62.0, 70.0, "robot", 0.9)
    assert [mark.moves for mark in note.marks] == [True, False, False]
    assert note.marks[2].goal == "8"
    assert unit.source.video == "http://one"
    assert foon.marked_goals() == [foon.objects[unit.outputs[0]]]


def test_identity_is_label_and_set_of_states() -> None:
    foon, _ = read("O\tbowl\nS\thot\nS\tcontains\t{b,a}\nM\tstir\nO\tbowl\nS\tcontains\t{a,b}\nS\thot\n//\n")
    assert len(foon.objects) == 1
    assert foon.objects[ObjectId(0)] == ObjectNode.of("bowl", [State("hot"), contains("a", "b")])


def test_duplicate_units_are_merged_and_keep_both_places() -> None:
    foon, _ = read(UNIT_B + UNIT_B.replace("O\tknife\nM", "M").replace("S\twhole", "S\twhole\nO\tknife"))
    [unit] = foon.units
    assert foon.duplicates == 1
    assert [source.line for source in unit.annotation.sources] == [2, 11]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("O\ta\nM\tx\nO\tb\nS\ts", [("unit-not-closed", 4)]),
        ("O\ta\nO\tb\n//\n", [("unit-without-motion", 1)]),
        ("O\ta\nM\tx\n//\n", [("unit-without-outputs", 1)]),
        ("O\ta\nM\tx\nO\tb\nM\ty\nO\tc\n//\n", [("two-motions", 4)]),
        ("O\ta\t00\nM\tx\nO\tb\n//\n", [("odd-flag", 1)]),
        ("O\ta\nS\tcontains\t[x]\nM\tx\nO\tb\n//\n", [("contains-in-brackets", 2)]),
        ("O\ta\nS\tcontains\nM\tx\nO\tb\n//\n", [("contains-without-braces", 2)]),
        ("O\ta\nS\tin\t{cup}\nM\tx\nO\tb\n//\n", [("place-in-braces", 2)]),
        ("O\ta\nS\ton\t[]\nM\tx\nO\tb\n//\n", [("empty-brackets", 2)]),
        ("O\ta\nS\tin\t[a,b]\nM\tx\nO\tb\n//\n", [("comma-in-brackets", 2)]),
        ("O\ta\nS\tcontains\t{x,}\nM\tx\nO\tb\n//\n", [("stray-comma", 2)]),
        ("O\ta\nS\tcontains\t{x, y}\nM\tx\nO\tb\n//\n", [("space-in-braces", 2)]),
        ("O\ta\nS\tcontains\t{x,x}\nM\tx\nO\tb\n//\n", [("duplicate-content", 2)]),
        ("O\ta\nS\tunder [pan]\nM\tx\nO\tb\n//\n", [("missing-tab", 2)]),
        ("O\ta\nO\ta\nM\tx\nO\tb\n//\n", [("duplicate-input", 1)]),
        ("O\ta\nM\tx\t1:16\t1:05\nO\tb\n//\n", [("times-backwards", 2)]),
        ("O\ta\nM\tx\t3:0s7\t4:00\nO\tb\n//\n", [("broken-time", 2)]),
        ("O\ta\nM\tx\tAssumed\tassume\nO\tb\n//\n", []),
        ("O\ta\nM\tx\t<1:00-1:10>\nO\tb\n//\n", []),
        ("O\ta\n\nM\tx\nO\tb\n//\n", [("blank-line", 2)]),
        ("O\ta\nhello\nM\tx\nO\tb\n//\n", [("unreadable-line", 2)]),
        ("O\ta\nM\tx\nS\thot\nO\tb\n//\n", [("state-of-motion", 3)]),
        ("\ufeffO\ta\nM\tx\nO\tb\n//\n", [("byte-order-mark", 1)]),
        ("O\t\nM\tx\nO\tb\n//\n", [("object-without-label", 1)]),
        ("O\ta b\tc\t1\nM\tx\nO\tb\n//\n", [("tab-in-label", 1)]),
        ("O\ta\nM\tput\tin\t1:00\t1:10\nO\tb\n//\n", [("tab-in-label", 2)]),
        ("O\ta\nM\tx\t1:00\t1:10\trobot\t0.5\tmore\nO\tb\n//\n", [("stray-field", 2)]),
        ("O\ta\nM\tx\t1:00\t1:10\trobot\t1.5\nO\tb\n//\n", [("broken-rate", 2)]),
        ("O\ta\nM\tx\t99999999999:00\t1:10\nO\tb\n//\n", [("broken-time", 2)]),
        ("O\ta\nS\twith\t[b] [c]\nM\tx\nO\tb\n//\n", [("stray-text", 2)]),
        ("O\ta\nS\tin\t[{x}]\nM\tx\nO\tb\n//\n", [("stray-text", 2), ("place-in-braces", 2)]),
        ("O\ta\nM\tx\nO\tb\n// O\tc\n", [("stray-text", 4)]),
        ("O\ta\nM\tx\nO\tb\n//x", [("stray-text", 4)]),
        ("O\ta\x00\nM\tx\nO\tb\n//\n", [("control-character", 1)]),
        ("O\ta\nM\t*\nO\tb\n//\n", [("motion-without-label", 2)]),
    ],
)
def test_oddities_are_found_where_they_stand(text: str, expected: list[tuple[str, int]]) -> None:
    assert codes(text) == expected


def test_lines_are_counted_across_units() -> None:
    text = "# one\n# two\n//\n" + UNIT_B.removeprefix("//\n") * 3 + "O\tx\nhello\nM\ty\nO\tz\n//\n"
    assert ("unreadable-line", 29) in codes(text)


def test_words_in_a_text_are_not_taken_for_objects() -> None:
    with pytest.raises(InputError, match=r"prose\.txt:1: not a FOON file: cannot read 'Once upon"):
        _read_file("prose.txt", "Once upon a time\nMother said: Salt!\n")


def _read_file(name: str, text: str) -> Foon:
    import tempfile

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / name
        path.write_text(text)
        return read_foon([path]).foon


def test_an_empty_file_is_an_empty_foon() -> None:
    with pytest.raises(InputError, match="an empty FOON"):
        _read_file("FOON.txt", "")


def test_an_empty_foon_names_what_was_left_out() -> None:
    with pytest.raises(InputError, match=r"x\.txt:1: a unit without a motion is left out; an empty FOON"):
        _read_file("x.txt", "O\tonion\n//\n")


def test_built_in_data_survives_writing(built_in: Dataset) -> None:
    again, _ = read(write_text(built_in.foon, built_in.foon.units))
    assert meaning(again) == meaning(built_in.foon)


def test_annotated_writing() -> None:
    foon, _ = read(UNIT_A + UNIT_B)
    assert write_text(foon, foon.units, ["two\nlines"], "A") == (
        "# two lines\n//\n# Source:\thttp://one\nO2\tolive oil\t1\nS3\tin\t[bottle]\nO0\tbowl\t0\n"
        "S2\tempty\nM1\tpour*\t1:02\t1:10\trobot\t0.9\nO0\tbowl\t0\t8\nS1\tcontains\t{olive oil}\n//\n"
        "O3\tonion\nS4\twhole\nO1\tknife\nM0\tchop\tAssumed\tAssumed\nO3\tonion\nS0\tchopped\n"
        "O1\tknife\n//\n"
    )


def test_provenance_is_written_and_read_back() -> None:
    foon, _ = read(UNIT_A + UNIT_B + UNIT_A.replace("one", "two"))
    text = write_text(foon, foon.units, provenance=True)
    assert text.startswith(
        "//\n# Source:\thttp://one\n# From:\tx.txt:3\n# Source:\thttp://two\n# From:\tx.txt:22\nO\tolive"
    )
    again, _ = read(text)
    assert again.units[UnitId(0)].annotation.sources == (
        Source("x.txt", 3, "http://one"),
        Source("x.txt", 22, "http://two"),
    )
    assert [unit.annotation.sources for unit in again.units] == [u.annotation.sources for u in foon.units]


def test_a_comment_inside_of_a_unit_is_no_provenance() -> None:
    foon, _ = read("O\ta\n# From:\ty.txt:7\nM\tx\nO\tb\n//\n")
    assert foon.units[UnitId(0)].source == Source("x.txt", 1)


def test_objects_of_units_left_out_are_not_in_the_graph() -> None:
    foon, _ = read("O\tlost\n//\n" + UNIT_B)
    assert "lost" not in foon.labels


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("O\t\t1\nM\tcut\nO\tb\n//\n", "object-without-label"),
        ("O7 \t \t1\t!\nM\tcut\nO\tb\n//\n", "object-without-label"),
        ("O\ta\nM\t\t0:01\t0:02\nO\tb\n//\n", "motion-without-label"),
        ("O\ta\nM3\t\t\tcut\nO\tb\n//\n", "motion-without-label"),
        ("O\ta\nS\t\t[cup]\nM\tcut\nO\tb\n//\n", "state-without-name"),
    ],
)
def test_an_empty_field_is_not_skipped(text: str, code: str) -> None:
    """What stands behind it is no label: it reads as if the line ended there."""
    whole = "O\tegg\nM\tfry\nO\tegg\nS\tfried\n//\n"
    foon, findings = read(whole + text)
    assert [finding.code for finding in findings] == [code]
    labels = {node.label for node in foon.objects}
    assert not labels & {"1", "!", "0:01", "[cup]"}
    assert set(foon.motions) == ({"fry", "cut"} if code == "state-without-name" else {"fry"})
