"""Every form of FOON file there is: told apart, accounted for, written and read back, mended."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import pytest

from foon_asp.errors import InputError
from foon_asp.io.findings import ODDITIES, USUAL
from foon_asp.io.folder import read_foon
from foon_asp.io.json import write_api, write_units
from foon_asp.io.objects import object_from_json
from foon_asp.io.text import write_text
from foon_asp.io.trees import TreeBuilder
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.node import Annotation, ObjectId, ObjectNode, Source, State, UnitId, contains, inside
from support.foon_texts import DIALECTS, EXAMPLES, UNIT, UNIT_JSON, A, state_file
from support.paths import ROOT
from support.reading_checks import check, check_mending, check_writing, codes, meaning, read


@pytest.mark.parametrize("dialect", DIALECTS)
def test_every_dialect_says_the_same(dialect: str) -> None:
    files = read(DIALECTS[dialect])
    assert meaning(files.foon) == meaning(read(DIALECTS["B"]).foon)
    assert codes(files.findings) == []
    assert (files.units_read, files.units_reported) == (1, 0)
    note = files.foon.units[UnitId(0)].annotation
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
    assert [Path(s.file).name for s in files.foon.units[UnitId(0)].annotation.sources] == [
        "one.txt",
        "two.json",
    ]
    assert [s.line for s in files.foon.units[UnitId(0)].annotation.sources] == [2, 3]
    assert [s.line for s in files.foon.units[UnitId(1)].annotation.sources] == [3, 5]


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


@pytest.mark.parametrize(
    ("text", "units", "found"),
    [
        ("[\n" + UNIT_JSON + "\n" + UNIT_JSON + "]", (1, 1), [("broken-json", 3)]),
        ("[\n" + UNIT_JSON + ",\n]", (1, 1), [("broken-json", 3)]),
        ("[\n" + UNIT_JSON + ",\n" + UNIT_JSON[:60], (1, 1), [("broken-json", 3)]),
        ('{"tree": [\n' + UNIT_JSON + ",\n" + UNIT_JSON[:60], (1, 1), [("broken-json", 3)]),
        (f'[{{"tree": [\n{UNIT_JSON}]}},\n{{"tree": [{UNIT_JSON}]}}]', (2, 0), [("duplicate-unit", 3)]),
        (f'[{{"tree": [\n{UNIT_JSON},\n{UNIT_JSON[:60]}', (1, 1), [("broken-json", 3)]),
        (f"[{UNIT_JSON}].", (1, 0), [("text-around-json", 1)]),
        (f"Sure!\n\n[{UNIT_JSON}]\nEnjoy [it].", (1, 0), [("text-around-json", 1), ("text-around-json", 4)]),
        (f"```json\n[{UNIT_JSON}]\n```\n", (1, 0), [("text-around-json", 1), ("text-around-json", 3)]),
        (f'Trees: {{"a": {{"b": [{UNIT_JSON}]}}}}', (1, 0), [("text-around-json", 1)]),
        ("[]\nmore", (0, 0), [("text-around-json", 2), ("no-units", 1)]),
        ("{}", (0, 0), [("no-units", 1)]),
    ],
)
def test_what_stands_around_json_or_breaks_it_is_a_finding(
    text: str, units: tuple[int, int], found: list[tuple[str, int]]
) -> None:
    files = read(text)
    assert (files.units_read, files.units_reported) == units
    assert codes(files.findings) == found


@pytest.mark.parametrize("none", ['"None"', '"none"', '"NULL"', '" N/A"', '""', "null"])
def test_words_that_mean_none_are_none_in_any_field(none: str) -> None:
    egg = f'{{"label": "egg", "states": ["raw", {none}], "ingredients": [{none}], "container": {none}}}'
    api = (
        f'{{"label": "egg", "states": [{{"state_label": "raw", "relative_object": {none}}}],'
        f' "ingredients": {none}}}'
    )
    for node in (egg, api):
        files = read(f'[{{"input_nodes": [{node}], "motion_node": "boil", "output_nodes": {none}}}]')
        assert [str(each) for each in files.foon.objects] == ["egg [raw]"]
        said = "word-for-none" in {finding.code for finding in files.findings}
        assert said == (none not in ('""', "null"))
    bare = f'{{"label": "egg", "states": {none}, "ingredients": {none}}}'
    assert object_from_json(json.loads(bare)) == ObjectNode.of("egg", [])
    nameless = read(f'[{UNIT_JSON}, {{"input_nodes": [{{"label": {none}}}], "motion_node": "boil"}}]')
    assert (nameless.units_read, nameless.units_reported) == (1, 1)
    motionless = read(f'[{UNIT_JSON}, {{"input_nodes": [{egg}], "motion_node": {none}}}]')
    assert (motionless.units_read, motionless.units_reported) == (1, 1)


@pytest.mark.parametrize("form", ["json", "text"])
def test_contents_and_places_without_brackets(form: str) -> None:
    rows = ["contains Water, salt", "on table", "attached to wall", "incomplete"]
    listed = "".join(f"\nS\t{row}" for row in rows)
    text = state_file(listed[1:])
    if form == "json":
        states = json.dumps(rows)
        text = f'[{{"input_nodes": [{{"label": "a", "states": {states}}}], "motion_node": "x"}}]'
    files = read(text)
    relations = (State("on", "table"), State("attached to", "wall"))
    expected = ObjectNode.of("a", [contains("water", "salt"), *relations, State("incomplete")])
    assert expected in files.foon.objects
    assert [code for code, _ in codes(files.findings)].count("state-without-brackets") == 3


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
    note = files.foon.units[UnitId(0)].annotation
    assert (note.start, note.end, note.agent, note.rate) == (62.0, 70.25, "r", 0.5)
    for bad in ("NaN", "1e999", "9" * 5000, "[[1]]", "true"):
        odd = motion.replace("70.25", bad).replace('"0.5"', bad)
        found = codes(read("[" + UNIT_JSON.replace('"x"', odd) + "]").findings)
        assert found in ([("broken-time", 1), ("broken-rate", 1)], [("broken-time", 1)])


def test_strings_of_json_can_hold_anything() -> None:
    files = read('[{"input_nodes": [{"label": "A\\u0000\\ud800\\n\\"b"}], "motion_node": "x\\ty"}]')
    assert [str(node) for node in files.foon.objects] == ['a\ufffd "b']
    assert files.foon.units[UnitId(0)].motion == "x y"
    assert ("control-character", 1) in codes(files.findings)


def test_one_line_that_is_not_utf8_leaves_the_others_alone() -> None:
    files = read("O\tjalapeño\n".encode() + b"S\tsaut\xe9\nM\tx\nO\tb\n//\n")
    assert codes(files.findings) == [("not-utf8", 2)]
    assert str(files.foon.objects[ObjectId(0)]) == "jalapeño [sauté]"


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


@pytest.mark.parametrize("end", ["//", "/", "\\", "\\\\"])
def test_an_end_too_many_is_deleted_whatever_it_is_written_with(end: str) -> None:
    text = f"O\ta\nM\tx\nO\tb\n{end}\n{end}\n"
    assert check_mending(text, read(text)) == "O\ta\nM\tx\nO\tb\n//\n"


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
    if code in USUAL:
        assert read(EXAMPLES[code], strict=True).foon == files.foon
        return
    first = min((f for f in files.findings if f.code not in USUAL), key=lambda finding: finding.line)
    with pytest.raises(InputError, match=rf"^x\.txt:{first.line}: .*\[{first.code}\]"):
        read(EXAMPLES[code], strict=True)


def test_strict_reading_of_files(tmp_path: Path) -> None:
    path = tmp_path / "FOON.txt"
    path.write_text("//\n" + UNIT + UNIT)
    assert read_foon([path], strict=True).units_read == 2
    path.write_text(UNIT + "\n" + UNIT)
    with pytest.raises(InputError, match=r"FOON\.txt:5: a blank line \[blank-line\]; delete the line"):
        read_foon([path], strict=True)


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


# Round trips


def test_built_in_data_survive_writing_and_are_strict() -> None:
    data = (ROOT / "data" / "FOON.txt").read_bytes()
    check(data)
    assert read(data, strict=True).units_reported == 0


def test_writing_is_the_same_whatever_the_order_of_ids() -> None:
    text = write_text(read(A).foon, read(A).foon.units, dialect="A")
    assert text == write_text(read(A + UNIT).foon, read(A).foon.units, dialect="A")


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (f"[{UNIT_JSON}, {UNIT_JSON}]", [2]),
        (f"[[{UNIT_JSON}], [{UNIT_JSON}, {UNIT_JSON}]]", [1, 2]),
        (f"{UNIT_JSON}\n{UNIT_JSON}\n", [2]),
        (f"[{UNIT_JSON}]\n[{UNIT_JSON}]\n", [1, 1]),
        (f'{{"dish": "soup", "units": [{UNIT_JSON}]}}', [1]),
        (f'{{"tags": [{{"a": 1}}], "trees": [[{UNIT_JSON}], [{UNIT_JSON}]]}}', [1, 1]),
        (f'{{"one": [{UNIT_JSON}], "two": [{UNIT_JSON}, {UNIT_JSON}]}}', [1, 2]),
        (f'{{"answer": {{"tree": [{UNIT_JSON}]}}}}', [1]),
        (f'{{"functional_units": [{UNIT_JSON}], "others": [{UNIT_JSON}, {UNIT_JSON}]}}', [1]),
        (f'{{"tree": [{UNIT_JSON}]}}\n{{"tree": [{UNIT_JSON}]}}', [1, 1]),
    ],
)
def test_units_may_be_wrapped_and_lists_of_them_stay_apart(
    tmp_path: Path, text: str, parts: list[int]
) -> None:
    path = tmp_path / "x.json"
    path.write_text(text, encoding="utf-8")
    file = TreeBuilder().read_file(path)
    assert [len(part) for part in file.parts] == parts
    lines = [source.line for part in file.parts for _, source in part]
    assert lines == sorted(lines)
    assert file.findings == tuple(f for f in file.findings if f.code == "duplicate-unit")


@pytest.mark.parametrize("state", ["contains y}", "contains {y", "in bowl]", "contains }", "on [ plate"])
def test_a_state_without_its_brackets_survives_writing(state: str) -> None:
    check(f"O\ta\nS\t{state}\nM\tx\nO\tb\nS\ty\n//\n".encode())
