"""The compiled store: nothing of a FOON is lost in it, and a damaged one is never read."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import duckdb
import pandas as pd
import pyarrow as pa
import pyarrow.compute as pc
import pyarrow.parquet as pq
import pytest

from foon_asp.errors import InputError
from foon_asp.io.folder import load
from foon_asp.io.open import FoonFiles, open_files
from foon_asp.io.store import open_store, write_store
from foon_asp.io.store_tables import SCHEMAS, from_tables, to_tables
from foon_asp.model.foon import FoonBuilder, merge
from foon_asp.model.node import Annotation, Interval, Mark, ObjectNode, Source, State, UnitId
from support.paths import BUILT_IN
from support.stores import as_first_version, seal, write_small_store


def test_a_store_says_what_its_files_say(store: Path) -> None:
    assert open_store(store) == open_files(BUILT_IN)


def test_everything_that_can_be_noted_survives() -> None:
    builder = FoonBuilder()
    odd = [State("contains", contents=()), State("on", relatum="a, b"), State("in", "c", ("d",))]
    things = [
        ObjectNode("bare"),
        ObjectNode.of("x", odd),
        ObjectNode.of("ünïcode \N{CLINKING BEER MUGS}", [State("contains", contents=("a", "a", "b"))]),
    ]
    ids = [builder.object(thing) for thing in things]
    marks = (Mark(True, "!"), Mark(False), Mark(), Mark(None, "17"))
    places = (Source("a.txt", 1, "one"), Source("", 0, ""))
    goes = (Interval(0.5, 2.25), Interval(), Interval(None, 9.0))
    builder.unit("mix", ids[:2], ids[1:], Annotation(places, True, goes, "robot", 0.0, marks))
    builder.unit("mix", ids[:1], [], Annotation((), times=(Interval(end=7.0),)))
    builder.unit("mix", ids[:2], ids[1:], Annotation((Source("b.txt", 9),)))
    foon = builder.build()
    again, _ = from_tables(to_tables(foon, []))
    assert list(again.objects) == things
    assert list(again.units) == list(foon.units)
    assert again.units[UnitId(0)].annotation == Annotation(
        (*places, Source("b.txt", 9)), True, goes, "robot", 0.0, marks
    )


def test_a_store_is_a_data_folder_and_lies_in_one(store: Path, tmp_path: Path) -> None:
    assert load(store).foon == load().foon
    folder = tmp_path / "kitchen"
    folder.mkdir()
    shutil.copytree(store, folder / "FOON.foon")
    shutil.copy(BUILT_IN.parent / "kitchen.json", folder)
    data = load(folder)
    assert (data.foon, data.kitchen.objects) == (load().foon, load().kitchen.objects)


def test_stores_are_merged(store: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.txt"
    other.write_text("O\tegg\nS\tfried\nM\tserve\nO\tdinner\nS\tready\n//\n")
    both = open_files(store, other, store)
    plain = open_files(BUILT_IN, other, BUILT_IN)
    assert list(both.foon.units) == list(plain.foon.units)
    assert (both.units_read, both.foon.duplicates) == (plain.units_read, plain.foon.duplicates)
    assert both.foon == merge([open_store(store).foon, open_files(other).foon, open_store(store).foon])


def test_compiling_twice_gives_the_same_bytes(store: Path, tmp_path: Path) -> None:
    write_store(open_files(BUILT_IN), tmp_path / "again.foon", [BUILT_IN])
    for path in store.iterdir():
        assert path.read_bytes() == (tmp_path / "again.foon" / path.name).read_bytes(), path.name


def test_a_manifest_of_something_else_makes_no_store(tmp_path: Path) -> None:
    shutil.copy(BUILT_IN, tmp_path)
    (tmp_path / "manifest.json").write_text('{"name": "web app"}')
    assert load(tmp_path).foon.objects == load().foon.objects


def test_tables_of_two_stores_do_not_mix(store: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.txt"
    other.write_text("O\tegg\nS\tfried\nM\tserve\nO\tdinner\nS\tready\n//\n")
    write_store(open_files(other), tmp_path / "other.foon", [other])
    shutil.copy(tmp_path / "other.foon" / "inputs.parquet", store)
    with pytest.raises(InputError, match=r"damaged store: inputs.parquet was changed"):
        open_store(store)


def test_another_version_is_refused(store: Path) -> None:
    manifest = json.loads((store / "manifest.json").read_text())
    (store / "manifest.json").write_text(json.dumps(manifest | {"version": 3}))
    with pytest.raises(
        InputError, match="version 3, and this program reads version 1 and 2; update foon-asp"
    ):
        open_store(store)


def test_a_store_of_the_first_version_is_read(tmp_path: Path) -> None:
    store = write_small_store(tmp_path)
    known = open_store(store)
    as_first_version(store)
    assert open_store(store) == known
    assert {unit.annotation.times for unit in known.foon.units} == {(), (Interval(1.0, 5.0),)}


def test_a_store_in_which_something_is_made_from_nothing_asks_to_be_compiled_anew(tmp_path: Path) -> None:
    store = write_small_store(tmp_path)
    path = store / "inputs.parquet"
    table = pq.read_table(path)
    pq.write_table(table.filter(pc.field("unit") > 0), path)
    seal(store)
    with pytest.raises(InputError, match=r"a unit has no input; compile it again"):
        open_store(store)


def test_a_folder_of_the_name_that_is_no_store(tmp_path: Path) -> None:
    (tmp_path / "kb.foon").mkdir()
    with pytest.raises(InputError, match=r"damaged store: manifest\.json is missing"):
        open_files(tmp_path / "kb.foon")
    (tmp_path / "kb.foon" / "manifest.json").write_text('{"name": "web app"}')
    with pytest.raises(InputError, match="does not describe a store"):
        open_files(tmp_path / "kb.foon")


@pytest.mark.parametrize(
    ("table", "column", "value", "told"),
    [
        ("inputs", "object", 10**6, "some objects are missing"),
        ("outputs", "unit", 10**6, "some units are missing"),
        ("units", "unit", 1, "not numbered"),
        ("objects", "object", 5, "not numbered"),
    ],
)
def test_tables_that_do_not_fit_together(table: str, column: str, value: int, told: str) -> None:
    tables = to_tables(load().foon, [])
    chosen = tables[table]
    numbers = chosen[column].to_numpy().copy()
    numbers[0] = value
    place = chosen.schema.get_field_index(column)
    tables[table] = chosen.set_column(place, chosen.schema.field(column), pa.array(numbers))
    with pytest.raises(ValueError, match=told):
        from_tables(tables)


def test_other_programs_read_the_tables(store: Path) -> None:
    foon = load().foon
    motions = pd.read_parquet(store / "units.parquet")["motion"].value_counts()
    assert motions.to_dict() == {
        motion: sum(unit.motion == motion for unit in foon.units) for motion in foon.motions
    }
    rows = duckdb.execute(
        f"""SELECT o.label, count(*) FROM '{store}/inputs.parquet' AS i
            JOIN '{store}/objects.parquet' AS o USING (object) GROUP BY o.label ORDER BY o.label"""
    ).fetchall()
    labels = [foon.objects[thing].label for unit in foon.units for thing in unit.inputs]
    assert rows == sorted((label, labels.count(label)) for label in set(labels))


def test_the_tables_are_those_of_the_schema(store: Path) -> None:
    for name, schema in SCHEMAS.items():
        assert pq.read_schema(store / f"{name}.parquet").equals(schema, check_metadata=False), name


def test_a_store_that_cannot_be_written(tmp_path: Path) -> None:
    files = FoonFiles(load().foon, (), 1, 0)
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"):
        write_store(files, tmp_path / "file" / "kb.foon", [])
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_store_that_is_merged_keeps_the_better_rate_and_tells_it(tmp_path: Path) -> None:
    for name, rate in (("one", "0.5"), ("two", "0.9")):
        (tmp_path / f"{name}.txt").write_text(f"O\ta\nM\tx\t\t\t\t{rate}\nO\tb\n//\n")
        source = tmp_path / f"{name}.txt"
        write_store(open_files(source), tmp_path / f"{name}.foon", [source])
    for names in (("one.foon", "two.foon"), ("two.foon", "one.foon"), ("two.txt", "one.foon")):
        files = open_files(*(tmp_path / name for name in names))
        assert [unit.annotation.rate for unit in files.foon.units] == [0.9]
        assert [(f.code, f.line) for f in files.findings if f.code == "other-rate"] == [("other-rate", 1)]
