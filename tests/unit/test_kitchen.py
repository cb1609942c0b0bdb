"""What stands beside a FOON, read strictly: each fault is one line with its place."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import foon_asp as fa
from foon_asp.errors import InputError
from foon_asp.io.findings import Finding
from foon_asp.io.kitchen import KitchenFiles, read_goals, read_labels
from foon_asp.io.listed import read_listed
from foon_asp.io.motions import read_costs, read_rates
from foon_asp.io.text import write_text
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectNode, State
from foon_asp.model.world import World
from foon_asp.numbers import QUANTITY, RATE


def kitchen_of(path: Path, foon: str = "") -> tuple[Kitchen, tuple[Finding, ...]]:
    return KitchenFiles(str(path)).read(fa.read(foon) if foon else FoonBuilder().build())


def written(folder: Path, text: str) -> Path:
    path = folder / "file"
    path.write_bytes(text.encode("utf-8", "surrogatepass"))
    return path


@pytest.mark.parametrize(
    ("item", "complaint"),
    [
        ('{"label": "egg", "stats": ["raw"]}', "unknown key 'stats'; closest: states"),
        ('{"lable": "egg"}', "unknown key 'lable'; closest: label"),
        ('{"label": "egg", "quantty": 2}', "unknown key 'quantty'; closest: quantity"),
        ('{"label": "egg", "states": [{"state_label": "in", "relative": "cup"}]}', "unknown key 'relative'"),
        ('{"label": "egg", "label": "milk"}', "the key 'label' stands twice"),
        ('{"label": "egg", "quantity": true}', "'quantity' is a whole number from 0 to 1000000, not True"),
        ('{"label": "egg", "quantity": 1.5}', "'quantity' is a whole number from 0 to 1000000, not 1.5"),
        ('{"label": "egg", "quantity": -1}', "'quantity' is a whole number"),
        ('{"label": "egg", "quantity": 1000001}', "'quantity' is a whole number"),
        ('{"label": "egg", "quantity": "2"}', "'quantity' is a whole number"),
        ('{"label": "egg", "quantity": NaN}', "'quantity' is a whole number"),
        ('{"label": "egg", "quantity": Infinity}', "'quantity' is a whole number"),
        ('{"label": "egg", "quantity": ' + "9" * 10_000 + "}", "'quantity' is a whole number"),
        ('{"label": ""}', "'label' is missing or no text"),
        ("5", "expected an object, found a number"),
    ],
)
def test_a_kitchen_names_the_object_and_its_line(tmp_path: Path, item: str, complaint: str) -> None:
    path = written(tmp_path, '[{"label": "milk"},\n\n' + item + "]")
    with pytest.raises(InputError) as raised:
        read_listed(path)
    assert str(raised.value).startswith(f"{path}:3: object 2: {complaint}")
    assert len(str(raised.value)) < 500


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("{}", "expected a JSON list of objects"),
        ('{"egg": 3}', "expected a JSON list of objects"),
        ("[", "not JSON"),
        ("[5,]", "object 1: expected an object, found a number|not JSON"),
        ("", "nothing is in this file"),
        ('[{"input_nodes": [{"label": "egg"}]}]', "file:1: a unit: this is a FOON"),
        ("O\tegg\nM\tboil\n", "file:2: a motion: this is a FOON"),
        ("S\traw\nO\tegg\n", "the state 'S\\\\traw' belongs to no object"),
        ("O\tegg\nraw\n", "file:2: cannot read 'raw'"),
        ("O5\t\n", "no label in"),
        ("egg\tmilk\n", "no label: "),
        ("egg [raw\n", r"\[raw"),
    ],
)
def test_what_is_no_list_of_objects_is_refused(tmp_path: Path, text: str, complaint: str) -> None:
    with pytest.raises(InputError, match=complaint):
        kitchen_of(written(tmp_path, text))


def test_quantities_add_up_to_plenty(tmp_path: Path) -> None:
    egg = {"label": "Egg", "states": ["raw", "cracked"], "quantity": QUANTITY.most}
    path = written(tmp_path, json.dumps([egg, egg, {"label": "milk", "quantity": 2}, {"label": "tea"}]))
    cracked = ObjectNode("egg", (State("raw"), State("cracked")))
    kitchen, _ = kitchen_of(path)
    assert kitchen.objects == (cracked, ObjectNode("milk"), ObjectNode("tea"))
    assert kitchen.quantities == {ObjectNode("milk"): 2}


@pytest.mark.parametrize(
    "row",
    [
        "pour",
        "pour\t",
        "\t0.5",
        "pour 0.5",
        "po\x00ur\t0.5",
        "po\tur\t0.5",
        "po\u2028ur\t0.5",
        "po\u202eur\t1",
    ],
)
def test_a_row_of_rates_that_cannot_be_read(tmp_path: Path, row: str) -> None:
    with pytest.raises(InputError, match=r"file:3: cannot read .*; write motion<tab>rate"):
        read_rates(written(tmp_path, f"# rates\nmix\t1\n{row}\n"))


@given(
    st.one_of(st.floats().map(str), st.integers().map(str), st.text(), st.just("9" * 10_000), st.just("0_1"))
)
def test_a_rate_is_a_chance(tmp_path_factory: pytest.TempPathFactory, text: str) -> None:
    if any(character in text for character in "\r\n\t"):
        return
    path = written(tmp_path_factory.mktemp("rates"), f"pour\t{text}")
    try:
        expected: float | None = float(text)
    except ValueError:
        expected = None
    if expected is not None and "_" not in text and text.isascii() and 0 <= expected <= 1:
        assert read_rates(path) == {"pour": expected}
        assert RATE.fits(expected)
    else:
        with pytest.raises(InputError, match="cannot read"):
            read_rates(path)


def test_a_motion_has_one_rate(tmp_path: Path) -> None:
    path = written(tmp_path, "pour\t0.5\nmix\t1\nPour *\t0.50\n")
    assert read_rates(path) == {"pour": 0.5, "mix": 1}
    path = written(tmp_path, "pour\t0.5\r\nmix\t1\rPour*\t0.6\n")
    with pytest.raises(
        InputError, match=r"file:3: two rates of 'pour': 0\.6 here and 0\.5 in line 1; keep one"
    ):
        read_rates(path)


@pytest.mark.parametrize("label", ["bo\x00wl", "bo\x1bwl", "bo\u202ewl", "bo\x85wl", "\x00"])
def test_a_label_of_a_list_is_one_that_can_be_shown(tmp_path: Path, label: str) -> None:
    with pytest.raises(InputError, match=r"file:2: no label: .*; write a label a line"):
        read_labels(written(tmp_path, f"Pan\n{label}\n"))


EGG, ONION, PAN = '{"label": "egg", "states": ["raw"]}', "onion [whole] in [bag]", "pan"
FULL_ONION = '{"label": "onion", "states": ["whole"], "ingredients": [], "container": "bag"}'
LISTED = f'{EGG}, {FULL_ONION}, {{"label": "pan"}}'
NOTHING = '"states": ["raw", "None", null], "ingredients": ["null", "N/A", ""], "container": "None"'
FORMS = {
    "a list": (f"[{LISTED}]", set()),
    "a fence": (f"```json\n[{LISTED}]\n```", {"text-around-json"}),
    "prose": (f"The kitchen:\n[{LISTED}].", {"text-around-json"}),
    "a key": (f'{{"kitchen": [{LISTED}], "of": "soup"}}', set()),
    "keys in keys": (
        f'{{"all": {{"food": [{EGG}, {FULL_ONION}], "tools": [{{"label": "pan"}}]}}}}',
        set(),
    ),
    "tags beside": (f'{{"tags": ["easy"], "objects": [{LISTED}]}}', set()),
    "lists in a list": (f'[[{EGG}], [{FULL_ONION}, {{"label": "pan"}}]]', set()),
    "wrappers in a list": (f'[{{"food": [{EGG}, {FULL_ONION}]}}, {{"tools": ["pan"]}}]', set()),
    "lines": (f'{EGG}\n{FULL_ONION}\n{{"label": "pan"}}\n', set()),
    "texts": (f'["egg [raw]", "{ONION}", "Pan", "None", null]', {"word-for-none"}),
    "words for none": (f'[{{"label": "egg", {NOTHING}}}, {FULL_ONION}, "pan"]', {"word-for-none"}),
    "keys of the API": (
        '[{"object_label": "egg", "object_states": [{"state_label": "raw"}]}, {"label": "pan"}, '
        '{"object_id": 4, "object_label": "onion", "object_states": [{"state_label": "whole"}, '
        '{"state_label": "in", "relative_object": "bag"}]}]',
        set(),
    ),
    "FOON text": ("O\tegg\nS\traw\nO\tonion\nS\twhole\nS\tin\t[bag]\nO\tpan\n", set()),
    "FOON text of a unit": (
        "# at hand\r\n//\r\nO5\tegg\t0\r\nS1\tRaw\r\n//\r\nO2\tonion\t1\t!\r\n"
        "S1\twhole\r\nS2\tin [bag]\r\n\r\nO7\tpan",
        {"missing-tab"},
    ),
    "a label a line": (f"# at hand\negg [raw]\n\n{ONION}\r\n PAN \nnone\n", {"word-for-none"}),
}


@pytest.mark.parametrize("form", FORMS)
def test_a_kitchen_in_any_form_is_the_same(tmp_path: Path, form: str) -> None:
    text, codes = FORMS[form]
    kitchen, findings = kitchen_of(written(tmp_path, text))
    world = World.of(FoonBuilder().build(), kitchen)
    assert set(map(str, world.kitchen.objects)) == {"egg [raw]", ONION, PAN}
    assert {finding.code for finding in findings} == codes
    goals, _ = read_goals(str(written(tmp_path, text)), FoonBuilder().build())
    assert set(map(str, goals)) == {"egg [raw]", ONION, PAN}


@pytest.mark.parametrize(
    "text",
    [
        f'[{EGG}, {{"label": "oni',
        f'[{EGG}, {{"label": "onion", "states": ["wh',
        f'{{"kitchen": [{EGG}, {{"label": "oni',
        f'[{{"kitchen": [{EGG}, {{"label": "oni',
        f'{{"tags": ["easy"], "kitchen": [{EGG}, ',
        f"{EGG}\n{{",
        '["egg [raw]", "oni',
        '{"none": ["None"], "kitchen": ["egg [raw]", "oni',
    ],
)
def test_of_a_kitchen_that_is_cut_off_the_whole_objects_are_read(tmp_path: Path, text: str) -> None:
    kitchen, findings = kitchen_of(written(tmp_path, text))
    assert list(map(str, kitchen.objects)) == ["egg [raw]"]
    assert {finding.code for finding in findings} - {"word-for-none"} == {"broken-json"}


_COOKED = fa.read(
    [
        (["onion [whole]", "knife"], "chop", ["onion [chopped]"]),
        (["onion [chopped]", "pot [empty]", "water [cold]"], "cook", ["pot {onion}", "water [hot]"]),
        (["water [icy]"], "wait", ["water [cold]"]),
        (["pot {onion}"], "serve", ["soup [hot]", "soup [warm]"]),
    ]
)
COOKED = write_text(_COOKED, _COOKED.units)


@pytest.mark.parametrize(
    ("label", "objects", "told"),
    [
        ("onion", ["onion [whole]"], "label-alone: 'onion' is onion [whole]"),
        ("Knife", ["knife"], ""),
        ("pot", ["pot [empty]"], "label-alone: 'pot' is pot [empty]"),
        (
            "soup",
            [],
            "ambiguous-label: 'soup' is nothing that is at hand: units make soup [hot]; ",
        ),
        ("water", ["water [icy]"], "label-alone: 'water' is water [icy]"),
        ("onion [chopped]", ["onion [chopped]"], ""),
        ("saffron", ["saffron"], "unknown-object: the kitchen has saffron, which the FOON does not know"),
    ],
)
def test_a_label_is_all_that_no_unit_makes(tmp_path: Path, label: str, objects: list[str], told: str) -> None:
    (tmp_path / "FOON.txt").write_text(COOKED, encoding="utf-8")
    (tmp_path / "kitchen.txt").write_text(f"{label}\n", encoding="utf-8")
    world = fa.load(tmp_path)
    assert list(map(str, world.kitchen.objects)) == objects
    beside = [each for each in world.findings if each.file == str(tmp_path / "kitchen.txt")]
    assert "; ".join(f"{each.code}: {each.message}" for each in beside).startswith(told)
    assert len(beside) == bool(told)


def test_a_label_of_several_objects_lists_them(tmp_path: Path) -> None:
    foon = "O\tegg\nS\traw\nO\tegg\nS\told\nM\tboil\nO\tegg\nS\tboiled\n//\n"
    (tmp_path / "FOON.txt").write_text(foon, encoding="utf-8")
    (tmp_path / "kitchen.txt").write_text("egg\n", encoding="utf-8")
    world = fa.load(tmp_path)
    assert list(map(str, world.kitchen.objects)) == ["egg [raw]", "egg [old]"]
    [finding] = [each for each in world.findings if each.code == "ambiguous-label"]
    assert finding.message == "'egg' may be egg [raw]; egg [old]; all of them are at hand"


def test_goals_as_texts_mean_what_they_do_on_the_command_line(tmp_path: Path) -> None:
    path = written(tmp_path, "pot {onion}\nsoup\nknife\nsaffron\nwater [hot]\n")
    goals, [finding] = read_goals(str(path), fa.read(COOKED))
    assert list(map(str, goals)) == ["pot {onion}", "knife", "saffron", "water [hot]"]
    assert str(finding) == (
        f"{path}:2: error: ambiguous goal 'soup': soup [hot]; soup [warm]; it is left out [ambiguous-goal]"
    )


@pytest.mark.parametrize("read", [read_rates, read_costs])
def test_a_table_of_motions_is_the_same_in_json(
    tmp_path: Path, read: Callable[[Path], dict[str, float]]
) -> None:
    expected = {"pour": 0.5, "mix": 1.0}
    for text in (
        "pour\t0.5\nmix*\t1\n",
        '{"pour": 0.5, "Mix *": 1}',
        '```json\n{"rates": {"pour": 0.5}, "more": {"mix": 1}}\n```',
        '{"pour": 0.5}\n{"mix": 1, "pour": 0.5}',
    ):
        assert read(written(tmp_path, text)) == expected


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        (
            '{"pour": 0.5,\n"Pour*": 0.6}',
            r"file:2: two rates of 'pour': 0\.6 here and 0\.5 in line 1; keep one",
        ),
        (
            '{"mix": 1,\n\n"pour": 1.5}',
            r"file:3: cannot read 'pour', 1\.5; write .* between 0 and 1",
        ),
        ('{"pour": "0.5"}', "file:1: cannot read 'pour', '0.5'"),
        ('{"": 1}', "cannot read '', 1"),
        ('["pour"]', "not JSON: Expecting '{' delimiter"),
        ('{"pour": 0.5', "not JSON: "),
    ],
)
def test_what_is_no_table_of_rates_in_json(tmp_path: Path, text: str, complaint: str) -> None:
    with pytest.raises(InputError, match=complaint):
        read_rates(written(tmp_path, text))


def test_utensils_may_be_a_json_list(tmp_path: Path) -> None:
    assert read_labels(written(tmp_path, '["Pan", "bowl"]')) == {"pan", "bowl"}
    with pytest.raises(InputError, match=r"file:1: no label: \{'label': 'pan'\}"):
        read_labels(written(tmp_path, '[{"label": "pan"}]'))
