"""What stands beside a FOON, read strictly: each fault is one line with its place."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from foon_asp.errors import InputError
from foon_asp.io.kitchen import read_labels, read_objects, read_rates, read_stock
from foon_asp.model.node import ObjectNode, State
from foon_asp.numbers import QUANTITY, RATE


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
        read_stock(path)
    assert str(raised.value).startswith(f"{path}:3: object 2: {complaint}")
    assert len(str(raised.value)) < 500
    with pytest.raises(InputError, match=":3: object 2: "):
        read_objects(path)


@pytest.mark.parametrize("text", ["{}", "5", "NaN", '"egg"', "[", "[5,]", "", '[{"label": "a"}] x'])
def test_what_is_no_list_of_objects_is_refused(tmp_path: Path, text: str) -> None:
    with pytest.raises(InputError, match=r"file:1: (expected a JSON list of objects|not JSON)"):
        read_stock(written(tmp_path, text))


def test_quantities_add_up_to_plenty(tmp_path: Path) -> None:
    egg = {"label": "Egg", "states": ["raw", "cracked"], "quantity": QUANTITY.most}
    path = written(tmp_path, json.dumps([egg, egg, {"label": "milk", "quantity": 2}, {"label": "tea"}]))
    cracked = ObjectNode("egg", (State("raw"), State("cracked")))
    assert read_stock(path) == {cracked: None, ObjectNode("milk"): 2, ObjectNode("tea"): None}


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
