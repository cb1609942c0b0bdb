"""Every form of FOON file there is: told apart, accounted for, written and read back, mended."""

from __future__ import annotations

import json
import pickle
import re
from pathlib import Path

import pytest
from conftest import ROOT
from hypothesis import given, settings
from hypothesis import strategies as st
from reading_checks import (
    MENDED,
    check,
    check_mending,
    check_writing,
    codes,
    count_units,
    meaning,
    read,
)

from foon_asp.builder import FoonBuilder
from foon_asp.dataset import read_foon
from foon_asp.errors import InputError
from foon_asp.files import object_from_json
from foon_asp.foon_json import write_api, write_units
from foon_asp.graph import Annotation, Foon, Mark, ObjectNode, Source, State, contains, inside
from foon_asp.mend import mend_text
from foon_asp.oddities import ODDITIES
from foon_asp.open_foon import decode
from foon_asp.state_syntax import PLACES
from foon_asp.text import write_text

A = (
    "# Source:\tv\r\n//\r\nO7\toil\t1\r\nS2\tin\t[cup]\r\nO4\tbowl\t0\r\nS1\tempty\r\n"
    "M5\tpour\t0:02\t0:10\r\nO4\tbowl\t0\t!\r\nS6\tcontains\t{oil}\r\n//\r\n"
)
DIALECTS = {
    "A": A,
    "B": "//\nO\toil\nS\tin\t[cup]\nO\tbowl\nS\tempty\nM\tpour\nO\tbowl\nS\tcontains\t{oil}\n//\n",
    "C": "//\nO1\toil\nS1\tin\t[cup]\nO1\tbowl\nS1\tempty\nM1\tpour\nO1\tbowl\nS1\tcontains\t{oil}\n//\n",
    "D": "O\toil\t1\nS\tin\t[cup]\nO\tbowl\t0\nS\tempty\nM\tpour\t0:02\t0:10\n"
    "O\tbowl\t0\nS\tcontains\t{oil}\n//\n",
    "E": "O0\toil\t1\nS0\tin\t[cup]\nO0\tbowl\t0\nS0\tempty\nM0\tpour\t<0:02-0:10>\nO0\tbowl\t0\n"
    "S0\tcontains\t{oil}\n//\n",
    "F": "# A tree\n//\nO\toil\nS\tin\t[cup]\nO\tbowl\nS\tempty\nM\tpour\nO\tbowl\nS\tcontains\t{oil}\n//\n",
    "J1": '[{"input_nodes": [{"label": "Oil", "states": [], "ingredients": [], "container": "cup"},'
    '{"label": "bowl", "states": ["empty"]}], "motion_node": "pour",'
    '"output_nodes": [{"label": "bowl", "states": [], "ingredients": ["oil"], "container": null}]}]',
    "J1 with a motion object": '[{"input_nodes": [{"label": "oil", "states": ["in [cup]"]},'
    '{"label": "bowl", "states": ["empty"]}], "motion_node": {"motion_label": "pour"},'
    '"output_nodes": [{"label": "bowl", "states": ["contains {oil}"]}]}]',
    "J2": '{"functional_units": [{"input_nodes": ['
    '{"object_id": 7, "object_label": "oil", "object_states": [{"state_id": 2, "state_label": "in",'
    '"relative_object": "cup"}], "ingredients": [], "object_in_motion": 1},'
    '{"object_id": 4, "object_label": "bowl", "object_states": [{"state_id": 1, "state_label": "empty"}],'
    '"ingredients": [], "object_in_motion": 0}],'
    '"motion_node": {"motion_id": 5, "motion_label": "pour", "start_time": "0:02", "end_time": "0:10"},'
    '"output_nodes": [{"object_id": 4, "object_label": "bowl", "object_states": [{"state_id": 6,'
    '"state_label": "contains"}], "ingredients": ["oil"], "object_in_motion": 0}]}], "source": "v"}',
}
UNIT = "O\ta\nM\tx\nO\tb\n//\n"
UNIT_JSON = '{"input_nodes": [{"label": "a"}], "motion_node": "x", "output_nodes": [{"label": "b"}]}'


def state_file(row: str) -> str:
    return f"O\ta\n{row}\nM\tx\nO\tb\n//\n"


EXAMPLES: dict[str, str | bytes] = {
    "unreadable-line": "O\ta\nhello\nM\tx\nO\tb\n//\n",
    "unreadable-unit": f"[{UNIT_JSON}, 7]",
    "object-without-label": "O7\nM\tx\nO\tb\n//\n" + UNIT,
    "motion-without-label": "O\ta\nM7\nO\tb\n//\n" + UNIT,
    "unit-without-motion": "O\tc\n//\n" + UNIT,
    "two-motions": "O\ta\nM\tx\nO\tb\nM\ty\nO\tc\n//\n" + UNIT,
    "unit-without-inputs": "M\tx\nO\tb\n//\n",
    "unit-without-outputs": "O\ta\nM\tx\n//\n",
    "state-of-motion": "O\ta\nM\tx\nS\thot\nO\tb\n//\n",
    "state-without-name": state_file("S\t[cup]"),
    "contains-without-braces": state_file("S\tcontains"),
    "empty-brackets": state_file("S\ton\t[]"),
    "empty-braces": state_file("S\tcontains\t{}"),
    "comma-in-brackets": state_file("S\tin\t[a,b]"),
    "unbalanced-brackets": state_file("S\tin\t[cup"),
    "stray-text": state_file("S\tin\t[cup] there"),
    "stray-field": "O\ta\t1\t!\tmore\nM\tx\nO\tb\n//\n",
    "tab-in-label": "O\tolive\toil\t1\nM\tx\nO\tb\n//\n",
    "broken-time": "O\ta\nM\tx\t3:0s7\t4:00\nO\tb\n//\n",
    "broken-rate": "O\ta\nM\tx\t3:07\t4:00\trobot\tgood\nO\tb\n//\n",
    "not-utf8": b"O\tcr\xe8me\nM\tx\nO\tb\n//\n",
    "control-character": "O\ta\x00b\nM\tx\nO\tb\n//\n",
    "duplicate-key": f'[{UNIT_JSON[:-1]}, "motion_node": "y"}}]',
    "odd-content": '[{"input_nodes": [{"label": "a", "ingredients": ["x,y"]}], "motion_node": "m"}]',
    "other-encoding": UNIT.encode("utf-16"),
    "byte-order-mark": "\ufeff" + UNIT,
    "unit-not-closed": UNIT.removesuffix("//\n"),
    "empty-unit": "//\n" + UNIT,
    "blank-line": "O\ta\n\nM\tx\nO\tb\n//\n",
    "missing-tab": state_file("S\tunder [pan]"),
    "odd-flag": "O\ta\t00\nM\tx\nO\tb\n//\n",
    "contains-in-brackets": state_file("S\tcontains\t[x]"),
    "place-in-braces": state_file("S\tin\t{x}"),
    "state-without-brackets": state_file("S\tin\tcup"),
    "stray-comma": state_file("S\tcontains\t{x,,y}"),
    "space-in-braces": state_file("S\tcontains\t{x, y}"),
    "duplicate-content": state_file("S\tcontains\t{x,x}"),
    "duplicate-state": state_file("S\thot\nS\thot"),
    "duplicate-input": "O\ta\nO\ta\nM\tx\nO\tb\n//\n",
    "duplicate-output": "O\ta\nM\tx\nO\tb\nO\tb\n//\n",
    "duplicate-unit": UNIT + UNIT,
    "times-backwards": "O\ta\nM\tx\t1:16\t1:05\nO\tb\n//\n",
}


@pytest.mark.parametrize("dialect", DIALECTS)
def test_every_dialect_says_the_same(dialect: str) -> None:
    files = read(DIALECTS[dialect])
    assert meaning(files.foon) == meaning(read(DIALECTS["B"]).foon)
    assert codes(files.findings) == []
    assert (files.units_read, files.units_reported) == (1, 0)
    note = files.foon.units[0].annotation
    if dialect in ("A", "D", "E", "J2"):
        assert (note.start, note.end) == (2.0, 10.0)
        assert [mark.moves for mark in note.marks] == [True, False, False]
    if dialect in ("A", "J2"):
        assert note.sources[0].video == "v"
    check(DIALECTS[dialect].encode())


def test_formats_can_be_mixed_and_lines_are_those_of_units(tmp_path: Path) -> None:
    (tmp_path / "one.txt").write_text(DIALECTS["B"])
    (tmp_path / "two.json").write_text("[\n\n" + DIALECTS["J1"][1:])
    (tmp_path / "three").write_text('{"functional_units": [\n\n' + UNIT_JSON + "\n,\n" + UNIT_JSON + "]}")
    files = read_foon([tmp_path / name for name in ("one.txt", "two.json", "three")])
    assert (len(files.foon.units), files.units_read) == (2, 4)
    assert [Path(s.file).name for s in files.foon.units[0].annotation.sources] == ["one.txt", "two.json"]
    assert [s.line for s in files.foon.units[0].annotation.sources] == [2, 3]
    assert [s.line for s in files.foon.units[1].annotation.sources] == [3, 5]


@pytest.mark.parametrize(
    ("name", "data"),
    [("x.txt", pickle.dumps([1], protocol)) for protocol in range(2, pickle.HIGHEST_PROTOCOL + 1)]
    + [("x.pkl", UNIT.encode()), ("x.PICKLE", pickle.dumps([1], 0))],
)
def test_a_pickle_is_never_loaded(name: str, data: bytes) -> None:
    with pytest.raises(InputError, match="a pickle, which can run any code"):
        read(data, name)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[", r"x\.txt:1: not JSON: Expecting value"),
        ("[\n" + UNIT_JSON + "\n" + UNIT_JSON + "]", r"x\.txt:3: not JSON: Expecting ',' delimiter"),
        ("[\n" + UNIT_JSON + ",\n]", r"x\.txt:3: not JSON: Expecting value"),
        ("[]\nmore", r"x\.txt:2: not JSON: Extra data"),
        ('{"a": 1}', "no list 'functional_units'"),
        ('{"functional_units": 7}', "no list 'functional_units'"),
        ("{1: 2}", "Expecting property name"),
        ('{"a": 1,}', "Expecting property name"),
        ('{"a" 1}', "Expecting ':' delimiter"),
        ("[" * 100_000, "nested too deeply"),
        ('{"a":' * 100_000, "nested too deeply"),
        ('[\n{"label": "onion"}]', r"x\.txt:2: not a FOON file: 'motion_node' is missing"),
        ("[7]", "not a FOON file: expected a unit, found a number"),
        ('[{"motion_node": "*"}]', "the motion has no label"),
        ('[{"motion_node": "x", "input_nodes": {}}]', "'input_nodes' is not a list"),
        ('[{"motion_node": "x", "input_nodes": [{}]}]', "'input_nodes', object 1: 'label' is missing"),
        ('[{"motion_node": "x", "input_nodes": [[]]}]', "expected an object, found a list"),
        ('[{"motion_node": "x", "input_nodes": [{"label": "a", "states": [{}]}]}]', "a state is no text"),
        ('[{"motion_node": "x", "input_nodes": [{"label": "a", "states": [7]}]}]', "is not a list of texts"),
        ('[{"motion_node": "x", "input_nodes": [{"label": "a", "states": "b"}]}]', "'states' is not a list"),
    ],
)
def test_what_json_cannot_be_read(text: str, message: str) -> None:
    with pytest.raises(InputError, match=message):
        read(text)


def test_an_item_that_cannot_be_read_is_reported_at_its_line() -> None:
    files = read(f'[\n{UNIT_JSON},\n{{"motion_node": 3}}\n,[]]')
    assert (files.units_read, files.units_reported) == (1, 2)
    assert codes(files.findings) == [("unreadable-unit", 3), ("unreadable-unit", 4)]


def test_json_says_times_in_numbers_and_rates_in_text() -> None:
    motion = (
        '{"motion_label": "x", "start_time": 62, "end_time": 70.25, "robot_type": "r",'
        ' "weight_success": "0.5"}'
    )
    files = read("[" + UNIT_JSON.replace('"x"', motion) + "]")
    note = files.foon.units[0].annotation
    assert (note.start, note.end, note.agent, note.rate) == (62.0, 70.25, "r", 0.5)
    for bad in ("NaN", "1e999", "9" * 5000, "[[1]]", "true"):
        odd = motion.replace("70.25", bad).replace('"0.5"', bad)
        found = codes(read("[" + UNIT_JSON.replace('"x"', odd) + "]").findings)
        assert found in ([("broken-time", 1), ("broken-rate", 1)], [("broken-time", 1)])


def test_strings_of_json_can_hold_anything() -> None:
    files = read('[{"input_nodes": [{"label": "A\\u0000\\ud800\\n\\"b"}], "motion_node": "x\\ty"}]')
    assert [str(node) for node in files.foon.objects] == ['a\ufffd "b']
    assert files.foon.units[0].motion == "x y"
    assert ("control-character", 1) in codes(files.findings)


def test_one_line_that_is_not_utf8_leaves_the_others_alone() -> None:
    files = read("O\tjalapeño\n".encode() + b"S\tsaut\xe9\nM\tx\nO\tb\n//\n")
    assert codes(files.findings) == [("not-utf8", 2)]
    assert str(files.foon.objects[0]) == "jalapeño [sauté]"


@pytest.mark.parametrize("encoding", ["utf-16", "utf-32", "utf-8-sig"])
@pytest.mark.parametrize("form", ["A", "J2"])
def test_byte_order_marks(encoding: str, form: str) -> None:
    files = read(DIALECTS[form].encode(encoding))
    code = "byte-order-mark" if encoding == "utf-8-sig" else "other-encoding"
    assert codes(files.findings) == [(code, 1)]


def test_files_that_were_joined_have_byte_order_marks_inside() -> None:
    files = read("\ufeff" + UNIT + "\ufeff\ufeff" + UNIT.replace("x", "y"))
    assert codes(files.findings) == [("byte-order-mark", 1), ("byte-order-mark", 5)]
    assert files.units_read == 2


@pytest.mark.parametrize(
    "text", ["O\tA \"b\" \\ 'c'\nM\tX\nO\tB\n//\n", f"O\t{'a' * 1_000_000}\nM\tx\nO\tb\n//\n"]
)
def test_labels_can_be_loud_quoted_and_long(text: str) -> None:
    files = check(text.encode())
    assert files is not None
    assert files.findings == ()


@pytest.mark.parametrize(
    "text",
    [
        "O\ta\nS\tin\t" + "{" * 200_000 + "\nM\tx\nO\tb\n",
        "O\ta\nM\tx" + "* " * 200_000 + "\nO\tb\n",
        "O\ta\nM\ty\nO\tb" + "\tc" * 200_000 + "\n",
        "\n" * 100_000 + UNIT,
    ],
)
def test_no_line_takes_more_than_linear_time(text: str) -> None:
    files = read(text)
    assert files.units_read == 1
    assert max(len(str(finding)) for finding in files.findings) < 1000


def test_every_code_has_an_example() -> None:
    assert EXAMPLES.keys() == ODDITIES.keys()


@pytest.mark.parametrize("code", EXAMPLES)
def test_examples_show_their_code_and_strict_reading_refuses_them(code: str) -> None:
    files = read(EXAMPLES[code])
    found = next(finding for finding in files.findings if finding.code == code)
    assert found.severity is ODDITIES[code]
    data = EXAMPLES[code]
    check(data if isinstance(data, bytes) else data.encode())
    if code in ("empty-unit", "duplicate-unit"):
        assert read(EXAMPLES[code], strict=True).foon == files.foon
        return
    first = min((f for f in files.findings if f.code != "empty-unit"), key=lambda finding: finding.line)
    with pytest.raises(InputError, match=rf"^x\.txt:{first.line}: .*\[{first.code}\]"):
        read(EXAMPLES[code], strict=True)


def test_strict_reading_of_files(tmp_path: Path) -> None:
    path = tmp_path / "FOON.txt"
    path.write_text("//\n" + UNIT + UNIT)
    assert read_foon([path], strict=True).units_read == 2
    path.write_text(UNIT + "\n" + UNIT)
    with pytest.raises(InputError, match=r"FOON\.txt:5: a blank line \[blank-line\]; delete the line"):
        read_foon([path], strict=True)


def test_the_table_of_codes_is_complete() -> None:
    page = (ROOT / "docs" / "format.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `([\w-]+)` \| (\w+) \|", page, flags=re.MULTILINE)
    assert len(rows) == len(dict(rows))
    assert dict(rows) == {code: severity.word for code, severity in ODDITIES.items()}


def test_objects_keep_every_state_in_json() -> None:
    states = [
        State("with", "rind"),
        inside("cup"),
        inside("pot"),
        contains("b", "a"),
        State("seasoned", None, ("c",)),
    ]
    for node in (
        ObjectNode.of("x", states),
        ObjectNode.of("x", [State("contains"), contains("a")]),
        ObjectNode.of("x", [State("contains", contents=())]),
    ):
        builder = FoonBuilder()
        builder.unit("m", [builder.object(node)], [], Annotation((Source(),)))
        check_writing(builder.build())


def test_the_form_of_the_api() -> None:
    foon = read(A).foon
    value = json.loads(write_api(foon, foon.units))
    assert value == {
        "functional_units": [
            {
                "input_nodes": [
                    {
                        "object_id": 1,
                        "object_label": "oil",
                        "object_states": [{"state_id": 2, "state_label": "in", "relative_object": "cup"}],
                        "ingredients": [],
                        "object_in_motion": 1,
                    },
                    {
                        "object_id": 0,
                        "object_label": "bowl",
                        "object_states": [{"state_id": 1, "state_label": "empty"}],
                        "ingredients": [],
                        "object_in_motion": 0,
                    },
                ],
                "motion_node": {
                    "motion_id": 0,
                    "motion_label": "pour",
                    "start_time": "0:02",
                    "end_time": "0:10",
                },
                "output_nodes": [
                    {
                        "object_id": 0,
                        "object_label": "bowl",
                        "object_states": [{"state_id": 0, "state_label": "contains"}],
                        "ingredients": ["oil"],
                        "object_in_motion": 0,
                    }
                ],
            }
        ],
        "source": "v",
    }
    assert json.loads(write_units(foon, foon.units))[0]["motion_node"] == "pour"


def test_a_kitchen_can_be_in_the_form_of_the_api() -> None:
    item = json.loads(DIALECTS["J2"])["functional_units"][0]["output_nodes"][0]
    assert object_from_json(item) == ObjectNode.of("bowl", [contains("oil")])


# Mending


@pytest.mark.parametrize(
    ("text", "mended"),
    [
        (state_file("S\tunder [pan]"), state_file("S\tunder\t[pan]")),
        (state_file("S1 under [pan]"), state_file("S1\tunder\t[pan]")),
        ("O Onion\nM chop\nO\tb\n//\n", "O\tOnion\nM\tchop\nO\tb\n//\n"),
        (state_file("S\tcontains\t[X]"), state_file("S\tcontains\t{X}")),
        (state_file("S\tcontains [x, y]"), state_file("S\tcontains\t{x,y}")),
        (state_file("S\tin\t{ Cup}"), state_file("S\tin\t[Cup]")),
        (state_file("S\tcontains\t{b,,a, b ,}"), state_file("S\tcontains\t{b,a,b}")),
        (state_file("S\tin\t[{x}] [y]"), None),
        (state_file("S\tcontains\t[x"), None),
        ("O5\ta\t00\t!\r\nM\tx\r\nO\tb\t001", "O5\ta\t0\t!\r\nM\tx\r\nO\tb\t1\r\n//\r\n"),
        ("# c\n//\n//\n\n//\n" + UNIT + "//\n# c\n//\n", "# c\n//\n" + UNIT + "# c\n//\n"),
        ("\ufeff" + UNIT[:-1] + "\n\n \t\r" + UNIT, UNIT + UNIT),
        ("O\ta\x00\nM\tx\nO\tb\n//\n\x00", UNIT),
    ],
)
def test_mending(text: str, mended: str | None) -> None:
    files = read(text)
    assert check_mending(text, files) == (text if mended is None else mended)


def test_mends_are_said() -> None:
    [finding] = read(state_file("S\tcontains\t[x]")).findings
    assert finding.mend == r"write 'S\tcontains\t{x}'"
    assert str(finding).endswith(r"; write 'S\tcontains\t{x}'")


def test_public_files_can_be_mended(public_data: Path) -> None:
    for path in public_files(public_data):
        text, _ = decode(path.read_bytes(), str(path))
        files = read(path.read_bytes())
        mended, done = mend_text(text, files.findings)
        left = read(mended).findings
        assert not {f.code for f in left} & (MENDED - {"empty-unit"})
        assert [f.code for f in left if f.code == "empty-unit"] in ([], ["empty-unit"])
        changed = {finding.line for finding in done}
        rows = text.splitlines(keepends=True)
        kept = [row for number, row in enumerate(rows, 1) if number not in changed]
        rest = iter(mended.splitlines(keepends=True))
        assert all(row in rest for row in kept), path


# Public data and the round trips


def public_files(public_data: Path) -> list[Path]:
    return [public_data / "universal" / "FOON.txt", *sorted((public_data / "subgraphs").glob("*.txt"))]


def test_public_files_have_every_unit_and_survive_writing(public_data: Path) -> None:
    for path in public_files(public_data):
        files = read(path.read_bytes())
        assert files.units_read + files.units_reported == count_units(path.read_text()), path
        check_writing(files.foon)


def test_built_in_data_survive_writing_and_are_strict() -> None:
    data = (ROOT / "data" / "FOON.txt").read_bytes()
    check(data)
    assert read(data, strict=True).units_reported == 0


LABELS = (
    st.text(st.characters(exclude_categories=("Cc", "Cs"), exclude_characters="\ufeff"), max_size=8)
    | st.sampled_from(["olive oil", "bowl", 'a "b"', "c\\d", "#e", "//", "1:00", "in", "contains", "naïve"])
).map(lambda text: text.lower().strip())
LABEL = LABELS.filter(bool)
NAME = LABELS.map(lambda text: re.sub(r"[\[\]{}]", "", text).strip()).filter(bool)
CONTENT = NAME.map(lambda text: text.replace(",", "").strip()).filter(bool)
CONTENTS = st.lists(CONTENT, max_size=3).map(lambda items: tuple(sorted(items)))


def _sayable(state: State) -> bool:
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
MARK = st.builds(Mark, st.sampled_from([None, True, False]), st.sampled_from(["", "", "!", "0", "29"]))
SOURCE = st.builds(Source, LABELS, st.integers(0, 10**6), LABELS)


@st.composite
def foons(draw: st.DrawFn) -> Foon:
    builder = FoonBuilder()
    pool = draw(st.lists(NODE, min_size=1, max_size=4))
    for _ in range(draw(st.integers(1, 3))):
        sides = st.lists(st.sampled_from(pool), max_size=3, unique=True)
        inputs, outputs = draw(sides), draw(sides)
        count = len(inputs) + len(outputs)
        note = Annotation(
            sources=tuple(draw(st.lists(SOURCE, min_size=1, max_size=2))),
            composite=draw(st.booleans()),
            start=draw(TIME),
            end=draw(TIME),
            agent=draw(LABELS),
            rate=draw(st.none() | st.floats(0, 1)),
            marks=tuple(draw(st.just([]) | st.lists(MARK, min_size=count, max_size=count))),
        )
        left = [builder.object(node) for node in inputs]
        right = [builder.object(node) for node in outputs]
        builder.unit(draw(MOTION), left, right, note)
    return builder.build()


@settings(max_examples=200, deadline=None, derandomize=True)
@given(foons())
def test_every_foon_survives_writing(foon: Foon) -> None:
    check_writing(foon)


def test_writing_is_the_same_whatever_the_order_of_ids() -> None:
    text = write_text(read(A).foon, read(A).foon.units, dialect="A")
    assert text == write_text(read(A + UNIT).foon, read(A).foon.units, dialect="A")
