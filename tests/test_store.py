"""The compiled store: nothing of a FOON is lost in it, and a damaged one is never read."""

from __future__ import annotations

import json
import pickle
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import duckdb
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from conftest import ROOT
from hypothesis import given
from hypothesis import strategies as st
from small_foons import many
from test_formats import foons

from foon_asp.builder import FoonBuilder, merge
from foon_asp.cli import main
from foon_asp.dataset import load
from foon_asp.errors import InputError
from foon_asp.files import FoonFiles
from foon_asp.graph import Annotation, Foon, Mark, ObjectNode, Source, State
from foon_asp.open_foon import open_files
from foon_asp.problem import Domain
from foon_asp.retrieve import retrieve
from foon_asp.store import open_store, read_manifest, write_store
from foon_asp.store_tables import SCHEMAS, from_tables, to_tables

BUILT_IN = ROOT / "data" / "FOON.txt"
TABLES = sorted(f"{name}.parquet" for name in SCHEMAS)


@pytest.fixture
def store(tmp_path: Path) -> Path:
    """Return a store of the built-in FOON."""
    folder = tmp_path / "kb.foon"
    write_store(open_files(BUILT_IN), folder, [BUILT_IN])
    return folder


def test_a_store_says_what_its_files_say(store: Path) -> None:
    assert open_store(store) == open_files(BUILT_IN)


@pytest.mark.parametrize("name", ["universal/FOON.txt", *(f"subgraphs/00{n}*" for n in (10, 46, 83))])
def test_public_files_survive(name: str, public_data: Path, tmp_path: Path) -> None:
    paths = sorted(public_data.glob(name))
    files = open_files(*paths)
    write_store(files, tmp_path / "kb.foon", paths)
    again = open_store(tmp_path / "kb.foon")
    assert again == files
    assert [unit.annotation for unit in again.foon.units] == [unit.annotation for unit in files.foon.units]


def test_all_subgraphs_survive_together(public_data: Path, tmp_path: Path) -> None:
    paths = sorted((public_data / "subgraphs").glob("*.txt"))
    files = open_files(*paths)
    write_store(files, tmp_path / "kb.foon", paths)
    assert open_store(tmp_path / "kb.foon") == files
    assert len(read_manifest(tmp_path / "kb.foon")["sources"]) == 56


@many(100)
@given(foons())
def test_tables_lose_nothing(foon: Foon) -> None:
    again, findings = from_tables(to_tables(foon, []))
    assert (list(again.objects), list(again.units), findings) == (list(foon.objects), list(foon.units), [])
    assert [again.id_of(node) for node in foon.objects] == list(range(len(foon.objects)))


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
    builder.unit("mix", ids[:2], ids[1:], Annotation(places, True, 0.5, 2.25, "robot", 0.0, marks))
    builder.unit("mix", ids[:1], [], Annotation((), end=7.0))
    builder.unit("mix", ids[:2], ids[1:], Annotation((Source("b.txt", 9),)))
    foon = builder.build()
    again, _ = from_tables(to_tables(foon, []))
    assert list(again.objects) == things
    assert list(again.units) == list(foon.units)
    assert again.units[0].annotation == Annotation(
        (*places, Source("b.txt", 9)), True, 0.5, 2.25, "robot", 0.0, marks
    )


def test_every_command_takes_a_store(store: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    def ask(*arguments: str) -> str:
        assert main(list(arguments)) == 0, arguments
        return capsys.readouterr().out

    kitchen = ["--data", str(BUILT_IN.parent), "--foon"]
    for command in (
        ["retrieve", "whipped cream", "--format", "foon", *kitchen],
        ["explain", "whipped cream", *kitchen],
        ["plan", "whipped cream", "--format", "foon", *kitchen],
        ["menu", "ice", "macaroni", "--format", "foon", *kitchen],
        ["suggest", *kitchen],
        ["reach", *kitchen],
        ["facts", *kitchen],
        ["goals", *kitchen],
        ["stats"],
        ["merge"],
    ):
        assert ask(*command, str(store)) == ask(*command, str(BUILT_IN)), command
    for out in ("text.txt", "api.json"):
        for name in (BUILT_IN, store):
            ask("convert", str(name), "-o", str(tmp_path / f"{name.name}-{out}"))
        assert (tmp_path / f"FOON.txt-{out}").read_bytes() == (tmp_path / f"kb.foon-{out}").read_bytes()
    assert "0 units" not in ask("stats", str(store))
    assert main(["audit", str(store), "--fix"]) == 0
    assert "repair the files that it was compiled from" in capsys.readouterr().err


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


def test_findings_of_the_files_are_kept(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    odd = tmp_path / "odd.txt"
    odd.write_text("O egg\nS\twhole\nM\tfry\nO\tegg\nS\tfried\n")
    assert main(["compile", str(odd), "-o", str(tmp_path / "odd.foon")]) == 0
    assert open_store(tmp_path / "odd.foon") == open_files(odd)
    assert main(["retrieve", "egg [fried]", "--foon", str(tmp_path / "odd.foon"), "--strict-format"]) == 2
    assert f"{tmp_path}/odd.foon:1: no tab" in capsys.readouterr().err


def test_compile_says_what_it_wrote(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target = tmp_path / "kb.foon"
    for _ in range(2):
        assert main(["compile", str(BUILT_IN), "-o", str(target)]) == 0
        out = capsys.readouterr().out
        foon = load().foon
        assert out.startswith(f"{target}: {len(foon.units)} units, {len(foon.objects)} objects, ")
        assert sorted(path.name for path in tmp_path.iterdir()) == ["kb.foon"]
    assert sorted(path.name for path in target.iterdir()) == sorted([*TABLES, "manifest.json"])


def test_compiling_twice_gives_the_same_bytes(store: Path, tmp_path: Path) -> None:
    write_store(open_files(BUILT_IN), tmp_path / "again.foon", [BUILT_IN])
    for path in store.iterdir():
        assert path.read_bytes() == (tmp_path / "again.foon" / path.name).read_bytes(), path.name


def test_compile_replaces_stores_only(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "papers").mkdir()
    (tmp_path / "papers" / "thesis.tex").write_text("years of work")
    assert main(["compile", str(BUILT_IN), "-o", str(tmp_path / "papers")]) == 2
    assert "'thesis.tex' in it, which no store has" in capsys.readouterr().err
    (tmp_path / "web").mkdir()
    (tmp_path / "web" / "manifest.json").write_text('{"name": "web app"}')
    assert main(["compile", str(BUILT_IN), "-o", str(tmp_path / "web")]) == 2
    assert "'manifest.json' in it, which no store has" in capsys.readouterr().err
    assert main(["compile", str(BUILT_IN), "-o", str(BUILT_IN)]) == 2
    assert "replace an input" in capsys.readouterr().err
    assert (tmp_path / "papers" / "thesis.tex").read_text() == "years of work"


def test_a_store_with_files_of_others_is_not_replaced(
    store: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (store / "kitchen.json").write_text('[{"label": "egg"}]')
    assert main(["compile", str(BUILT_IN), "-o", str(store)]) == 2
    assert "'kitchen.json' in it, which no store has" in capsys.readouterr().err
    assert load(store).kitchen.objects == (ObjectNode("egg"),)


def test_an_empty_folder_becomes_a_store(tmp_path: Path) -> None:
    (tmp_path / "kb.foon").mkdir()
    assert main(["compile", str(BUILT_IN), "-o", str(tmp_path / "kb.foon")]) == 0
    assert open_store(tmp_path / "kb.foon").foon == load().foon


def test_a_manifest_of_something_else_makes_no_store(tmp_path: Path) -> None:
    shutil.copy(BUILT_IN, tmp_path)
    (tmp_path / "manifest.json").write_text('{"name": "web app"}')
    assert load(tmp_path).foon.objects == load().foon.objects


def test_values_and_tables_go_to_other_processes(store: Path) -> None:
    """What multiprocessing sends there is found in sets there: the hash of a text is another one."""
    domain = load(foon=[store]).domain()
    assert domain.closure is not None
    code = (
        "import pickle, sys; node, domain = pickle.load(sys.stdin.buffer);"
        "assert node in set(domain.kitchen.objects); assert domain.id_of(node) in domain.closure.available"
    )
    sent = pickle.dumps((domain.kitchen.objects[0], domain))
    subprocess.run([sys.executable, "-c", code], input=sent, check=True)


def test_a_store_does_not_replace_itself(store: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["compile", str(store), str(BUILT_IN), "-o", str(store)]) == 2
    assert "replace an input" in capsys.readouterr().err
    open_store(store)


def _cut(path: Path) -> None:
    path.write_bytes(path.read_bytes()[:-7])


def _flip(path: Path) -> None:
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)


def _empty(path: Path) -> None:
    path.write_bytes(b"")


@pytest.mark.parametrize("name", [*TABLES, "manifest.json"])
@pytest.mark.parametrize("damage", [_cut, _flip, _empty, Path.unlink])
def test_a_damaged_store_is_never_read(
    store: Path, name: str, damage: Callable[[Path], None], capsys: pytest.CaptureFixture[str]
) -> None:
    damage(store / name)
    assert main(["retrieve", "whipped cream", "--foon", str(store)]) == 2
    told = capsys.readouterr().err
    assert told.count("\n") == 1
    assert str(store) in told
    if name != "manifest.json":
        assert f"a damaged store: {name}" in told


def test_tables_of_two_stores_do_not_mix(store: Path, tmp_path: Path) -> None:
    other = tmp_path / "other.txt"
    other.write_text("O\tegg\nS\tfried\nM\tserve\nO\tdinner\nS\tready\n//\n")
    write_store(open_files(other), tmp_path / "other.foon", [other])
    shutil.copy(tmp_path / "other.foon" / "inputs.parquet", store)
    with pytest.raises(InputError, match=r"damaged store: inputs.parquet was changed"):
        open_store(store)


def test_another_version_is_refused(store: Path) -> None:
    manifest = json.loads((store / "manifest.json").read_text())
    (store / "manifest.json").write_text(json.dumps(manifest | {"version": 2}))
    with pytest.raises(InputError, match="version 2, and this program reads version 1; update foon-asp"):
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


def test_a_compile_that_is_killed_leaves_the_store_as_it_was(store: Path, tmp_path: Path) -> None:
    """Kill compiling at many moments: the old store or the new one is there, and always whole."""
    before = open_store(store)
    other = tmp_path / "other.txt"
    other.write_text("O\tegg\nS\tfried\nM\tserve\nO\tdinner\nS\tready\n//\n")
    after = open_files(other)
    command = [sys.executable, "-m", "foon_asp", "compile", str(other), "-o", str(store)]
    started = time.perf_counter()
    subprocess.run(command, check=True, capture_output=True)
    whole = time.perf_counter() - started
    write_store(before, store, [BUILT_IN])
    seen = []
    for part in np.linspace(0.3, 1.0, 8):
        child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(whole * float(part))
        child.send_signal(signal.SIGKILL)
        child.wait()
        # Between two renames the old store has another name.
        found = open_store(store if store.exists() else next(store.parent.glob(".*.old")))
        seen.append(found in (before, after))
    assert all(seen)


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


@many(50)
@given(foons(), st.data())
def test_unknown_nodes_are_not_found(foon: Foon, data: st.DataObject) -> None:
    """A node is found by all of its states and its label, and only then."""
    node = data.draw(st.sampled_from([*foon.objects, ObjectNode("nothing")]))
    known = set(foon.objects)
    for states in (node.states[1:], (*node.states, State("never said"))):
        other = ObjectNode.of(node.label, states)
        assert (foon.id_of(other) is not None) == (other in known)
    stranger = replace(node, label=node.label + "?")
    assert (foon.id_of(stranger) is not None) == (stranger in known)


def test_another_stock_shares_the_readings() -> None:
    data = load()
    domain = data.domain()
    egg = [node for node in data.kitchen.objects if node.label != "tomato"]
    fresh = Domain(data.foon, replace(data.kitchen, objects=tuple(egg)))
    shared = domain.with_stock(egg)
    assert shared.reading is domain.reading
    assert shared.closure.available.keys() == fresh.closure.available.keys()
    assert shared.closure.available.keys() < domain.closure.available.keys()
    for goal in data.goals:
        one, other = retrieve(shared, goal), retrieve(fresh, goal)
        assert (one.status, one.tree and one.tree.units) == (other.status, other.tree and other.tree.units)


def test_a_store_that_cannot_be_written(tmp_path: Path) -> None:
    files = FoonFiles(load().foon, (), 1, 0)
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"):
        write_store(files, tmp_path / "file" / "kb.foon", [])
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


PAGE = (ROOT / "docs" / "scale.md").read_text(encoding="utf-8")


def test_the_page_names_all_tables_and_columns() -> None:
    rows = [row for row in PAGE.splitlines() if row.startswith("| `")]
    for name, schema in SCHEMAS.items():
        (row,) = [row for row in rows if f"`{name}`" in row.split("|")[1]]
        named = re.findall(r"`(\w+)`", row.split("|")[3])
        assert [column for column in named if column in schema.names] == schema.names, name


def test_the_queries_of_the_page(
    public_data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["compile", str(public_data / "universal" / "FOON.txt"), "-o", "kb.foon"]) == 0
    (query,) = re.findall(r"```sql\n(.*?)```", PAGE, re.DOTALL)
    told = ", ".join(f"{label} {uses}" for label, uses in duckdb.execute(query).fetchall())
    assert told == "bowl 811, cooking pan 296, cutting board 279"
    assert f"this gives {' and '.join(told.rsplit(', ', 1))}." in PAGE
    (script,) = [text for text in re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL) if "pandas" in text]
    printed = subprocess.run(
        [sys.executable, "-c", script], check=True, capture_output=True, text=True
    ).stdout
    assert [row.split()[0] for row in printed.splitlines()[1:4]] == ["pour", "pick-and-place", "sprinkle"]
    assert capsys.readouterr().out.startswith("kb.foon: 2376 units")
