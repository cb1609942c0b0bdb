"""`foon-asp batch`: rows for queries good and bad, killed and resumed runs, Parquet, what the page says."""

from __future__ import annotations

import json
import os
import re
import signal
import sqlite3
import subprocess
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import closing
from pathlib import Path
from typing import Any

import pyarrow.parquet as pq
import pytest
from jsonschema import Draft202012Validator
from msgspec import to_builtins

from foon_asp.batch.answerer import Answerer, Settings
from foon_asp.batch.query_file import Chunk, QueryFile
from foon_asp.batch.rows import Rows, answer_row, error_row
from foon_asp.batch.run import RunOptions, chunk_size, run_batch
from foon_asp.batch.tasks import DIED
from foon_asp.errors import InputError
from foon_asp.io.folder import Dataset, Sources
from foon_asp.query.query import Query
from foon_asp.query.substitution import Replacement
from foon_asp.retrieval.retrieve import retrieve
from foon_asp.retrieval.wire import row_json
from support.batch_runs import (
    Drawn,
    busy,
    gone,
    many,
    program,
    read_rows,
    read_rows_of,
    rows_in,
    started,
    until,
    workers_of,
    write_queries,
)
from support.cli import run, run_json
from support.paths import ROOT, SCHEMAS

PAGE = (ROOT / "docs" / "batch.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", [None, 1.5, '"units": []', "half \ud83c"])
def test_a_row_is_written_as_if_all_of_it_were_written_anew(name: str | float | None) -> None:
    world = Sources.of().load().world()
    for query in (Query("ice"), Query("whipped cream", human_steps=1), Query("ice", "whipped cream")):
        answer = retrieve(world, query)
        for timings in (False, True):
            value = to_builtins(row_json(3, name, answer, timings=timings))
            row = answer_row(3, name, answer, timings=timings)
            assert json.loads(row.json) == value
            assert row.json.decode() == json.dumps(value, ensure_ascii="\ud83c" in str(name))
            assert answer_row(3, name, answer, timings=timings) == row
    assert value["units"]


@pytest.fixture
def batch(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., list[dict[str, Any]]]:
    """Answer queries in this process and return the rows."""

    def answer(queries: Sequence[Drawn], *options: object) -> list[dict[str, Any]]:
        path, out = write_queries(tmp_path / "queries.jsonl", queries), tmp_path / "rows.jsonl"
        arguments = ["batch", "--queries", path, "-o", out, "--jobs", 1, "--overwrite", *options]
        status, printed, err = run(capsys, *arguments)
        assert (status, printed) == (0, ""), err
        assert not (tmp_path / "rows.jsonl.partial").exists()
        return read_rows(out)

    return answer


# What rows say


def test_rows_say_what_retrieve_says(
    batch: Callable[..., list[dict[str, Any]]], capsys: pytest.CaptureFixture[str]
) -> None:
    (row,) = batch([{"goal": "greek salad", "by": "success,units", "id": "g"}])
    value = run_json(capsys, "retrieve", "greek salad", "--by", "success,units")
    del value["seconds"]
    assert row == {"line": 1, "id": "g", **value}


def test_goals_kitchens_methods_and_constraints(
    batch: Callable[..., list[dict[str, Any]]], built_in: Dataset
) -> None:
    cream = {"label": "heavy cream", "states": ["cold"], "container": "cup"}
    rows = batch(
        [
            {
                "goal": cream
                | {"label": "whipped cream", "states": ["creamy", "whipped"], "container": "mixing bowl"}
            },
            {"goal": ["greek salad", "hummus"]},
            {"goal": "whipped cream", "remove": ["heavy cream"]},
            {"goal": "whipped cream", "remove": [cream], "add": ["heavy cream [cold] in cup"]},
            {"goal": "whipped cream", "kitchen": []},
            {"goal": "whipped cream", "kitchen": ["whipped cream"]},
            {"goal": "hummus", "method": "ids"},
            {"goal": "hummus", "method": "greedy", "by": ["inputs"], "reference": True},
            {"goal": "hummus", "constraints": {"diets": ["vegan"], "without": ["Salt"], "max_units": 1}},
            {"goal": "pesto pasta", "time_limit": 0},
        ]
    )
    statuses = [row["status"] for row in rows]
    expected = ["optimal", "optimal", "unreachable", "optimal", "unreachable", "optimal", "found", "found"]
    assert statuses == [*expected, "unreachable", "limit"]
    assert [goal["label"] for goal in rows[1]["goals"]] == ["greek salad", "hummus"]
    assert "heavy cream" in rows[2]["reason"]
    assert rows[3]["units"] == rows[0]["units"]
    assert rows[5]["size"] == 0
    assert rows[7]["founded"] is False
    assert rows[8]["constraints"] == ["without salt", "diet vegan", "at most 1 unit"]
    tree = [unit["id"] for unit in rows[1]["units"]]
    world = built_in.world()
    made = {thing for unit in tree for thing in world.units.makes[unit]}
    assert {world.foon.objects[thing].label for thing in made} >= {"greek salad", "hummus"}


SWAP = {"label": "cheddar cheese", "by": "parmesan cheese", "likeness": 0.8, "note": "melts less"}


def test_queries_may_replace_what_is_missing(
    batch: Callable[..., list[dict[str, Any]]], built_in: Dataset
) -> None:
    left_out = {"label": "cheddar cheese", "by": None, "likeness": 0.5}
    note = Replacement("cheddar cheese", "parmesan cheese", 0.8, "melts less")
    goal = "omelette [cooked]"
    query = {"goal": goal, "constraints": {"without": ["cheddar cheese"]}}
    asked: list[tuple[object, Any]] = [
        ([SWAP], [note]),
        (["foon", SWAP, left_out], ["foon", note, Replacement("cheddar cheese", None, 0.5)]),
        ([left_out], [Replacement("cheddar cheese", None, 0.5)]),
        (True, "foon"),
        ("foon", True),
        (False, None),
    ]
    rows = batch([query | {"substitute": given} for given, _ in asked])
    world = built_in.world()
    for row, (_, given) in zip(rows, asked, strict=True):
        answer = retrieve(world, Query(goal, without=["cheddar cheese"], substitute=given))
        value = json.loads(answer.to_json())
        del value["seconds"]
        assert {key: row[key] for key in value} == value
    assert [row["status"] for row in rows] == ["optimal"] * 5 + ["unreachable"]
    assert rows[0]["replacements"][0] == {key: SWAP[key] for key in ("label", "by", "likeness")} | {
        "why": "melts less"
    }


@pytest.mark.parametrize(
    ("query", "message"),
    [
        ("{", "not JSON: Expecting property name enclosed in double quotes at column 2"),
        ('"whipped cream"', "a query is an object like"),
        ('{"goal": NaN}', "NaN is no JSON number"),
        ("[" * 100_000, "nested too deeply"),
        ("{}", "the query has no 'goal'"),
        ({"goal": []}, "the list of goals is empty"),
        ({"goal": "whiped cream"}, "closest: whipped cream"),
        ({"goal": {"name": "ice"}}, "'goal': unknown key 'name'"),
        ({"gaol": "ice"}, "unknown key 'gaol'; closest: goal"),
        ({"goal": "ice", "id": True}, "'id' is a number or a text or null, not true or false"),
        (
            {"goal": "ice", "constraints": {"max_unit": 3}},
            "unknown constraint 'max_unit'; closest: max_units",
        ),
        (
            {"goal": "ice", "constraints": {"max_units": "3"}},
            "'constraints.max_units' is a whole number or null, not a text",
        ),
        (
            {"goal": "ice", "constraints": {"min_success": 1.5}},
            "'constraints.min_success' is at most 1, not 1.5",
        ),
        ({"goal": "ice", "constraints": {"diets": ["vegn"]}}, "no diet 'vegn'; closest: vegan"),
        ({"goal": "ice", "constraints": {"without": ["slat"]}}, "closest: salt"),
        ({"goal": "ice", "by": "unit"}, "there is no criterion 'unit'; closest: units"),
        ({"goal": "ice", "method": "best"}, "unknown method 'best'"),
        ({"goal": "ice", "time_limit": -1}, "'time_limit' is at least 0, not -1"),
        ({"goal": "ice", "time_limit": 10**400}, "'time_limit' is a number that is too large"),
        ({"goal": "ice", "kitchen": [], "add": ["salt"]}, "leave out 'add' and 'remove'"),
        ({"goal": "ice", "add": "salt"}, "'add' is a list, not a text"),
        ({"goal": "ice", "remove": ["unicorn"]}, "nothing of the kitchen can be removed by this name"),
        ({"goal": "ice", "remove": [{"label": "sugra"}]}, "the kitchen has no sugra to remove"),
        ({"goal": "\udcff"}, "no object has this label"),
        ('{"goal": "ice", "id": 1e999}', "'id' is a number that is too large"),
        ({"goal": "ice", "substitute": "fon"}, "'substitute' goes by foon or vectors, not by 'fon'"),
        ({"goal": "ice", "substitute": [{"label": "a", "likeness": 1}]}, "'substitute[0]' has no 'by'"),
        ({"goal": "ice", "substitute": [SWAP | {"likeness": 0}]}, "'substitute[0].likeness' is above 0"),
        ({"goal": "ice", "substitute": [SWAP | {"why": "x"}]}, "unknown key of a replacement 'why'"),
        ({"goal": "ice", "substitute": True, "method": "ids"}, "by the method 'optimal' alone"),
    ],
    ids=range(30),
)
def test_a_wrong_query_is_one_error_row(
    query: Drawn, message: str, batch: Callable[..., list[dict[str, Any]]]
) -> None:
    before, wrong, after = batch([{"goal": "ice"}, query, {"goal": "ice"}])
    assert before["status"] == after["status"] == "optimal"
    assert (wrong["line"], wrong["status"]) == (2, "error")
    assert message in wrong["error"]


def test_bytes_that_are_no_text_are_an_error_row(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    queries, out = tmp_path / "q.jsonl", tmp_path / "o.jsonl"
    queries.write_bytes(
        b'\xef\xbb\xbf{"goal": "ice"}\r\n\r\n  \n{"goal": "\xff"}\n{"goal": "ice", "id": 1.5}'
    )
    assert run(capsys, "batch", "--queries", queries, "-o", out, "--jobs", 1)[0] == 0
    rows = read_rows(out)
    assert [(row["line"], row["status"], row["id"]) for row in rows] == [
        (1, "optimal", None),
        (4, "error", None),
        (5, "optimal", 1.5),
    ]
    assert "byte 0xff is not UTF-8" in rows[1]["error"]


def test_an_error_row_keeps_the_id(batch: Callable[..., list[dict[str, Any]]]) -> None:
    (row,) = batch([{"id": "x", "goal": "nothing like it"}])
    assert (row["id"], row["status"]) == ("x", "error")


def test_a_limit_for_all_and_timings(batch: Callable[..., list[dict[str, Any]]]) -> None:
    queries = [{"goal": "pesto pasta"}, {"goal": "pesto pasta", "time_limit": 60}]
    rows = batch(queries, "--time-limit", 0, "--timings")
    assert [row["status"] for row in rows] == ["limit", "optimal"]
    assert all(row["seconds"] > 0 for row in rows)


def test_levels_are_those_of_retrieve(
    batch: Callable[..., list[dict[str, Any]]], capsys: pytest.CaptureFixture[str]
) -> None:
    (row,) = batch([{"goal": "pesto pasta", "add": []}], "--level", 1)
    value = run_json(capsys, "retrieve", "pesto pasta", "--level", "1")
    assert [unit["id"] for unit in row["units"]] == [unit["id"] for unit in value["units"]]


def test_levels_and_kitchens_go_together(
    batch: Callable[..., list[dict[str, Any]]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    objects = json.loads((ROOT / "data" / "kitchen.json").read_text(encoding="utf-8"))[::-1]
    less = [each for each in objects if each["label"] != "heavy cream"]
    path = tmp_path / "kitchen.json"
    path.write_text(json.dumps(less), encoding="utf-8")
    for level in (1, 2, 3):
        asked = [
            {"goal": "whipped cream", "kitchen": less},
            {"goal": "whipped cream", "remove": ["heavy cream"]},
        ]
        rows = batch(asked, "--level", level)
        _, out, _ = run(
            capsys, "retrieve", "whipped cream", "--kitchen", path, "--level", level, "--format", "json"
        )
        value = json.loads(out)
        assert [row["status"] for row in rows] == [value["status"]] * 2
        assert [row["reason"] for row in rows] == [value["reason"]] * 2


def test_the_query_schema_takes_what_is_read(batch: Callable[..., list[dict[str, Any]]]) -> None:
    validator = Draft202012Validator(json.loads((SCHEMAS / "batch-query.schema.json").read_text()))
    full: dict[str, Any] = {
        "id": 1,
        "goal": "hummus",
        "add": ["salt"],
        "remove": [],
        "method": "optimal",
        "by": "2*units+inputs",
        "reference": False,
        "time_limit": 60,
        "constraints": {
            "without": ["cumin"],
            "without_tools": [],
            "avoid_motions": ["fry"],
            "only_motions": None,
            "use_units": [],
            "avoid_units": [0],
            "max_units": 100,
            "max_depth": 100,
            "min_success": 0.001,
            "human_steps": None,
            "diets": ["vegan"],
        },
        "substitute": ["foon", SWAP],
    }
    validator.validate(full)
    batch([full])
    for key in ("goal", "by", "constraints", "time_limit", "add", "substitute"):
        assert not validator.is_valid(full | {key: 5.5 if key != "time_limit" else "5"}), key
    assert not validator.is_valid(full | {"gaol": "ice"})


def test_schema_and_page_name_all_keys(batch: Callable[..., list[dict[str, Any]]]) -> None:
    rows = batch([{"goal": "ice", "?": 1}, {"goal": "ice", "constraints": {"?": 1}}])
    keys, constraints = (set(row["error"].rpartition("there are ")[2].split(", ")) for row in rows)
    schema = json.loads((SCHEMAS / "batch-query.schema.json").read_text(encoding="utf-8"))
    assert schema["properties"].keys() == keys
    assert schema["$defs"]["constraints"]["properties"].keys() == constraints
    _, first, second = PAGE.partition("## Results")[0].split("|---|---|---|\n")
    for table, names in ((first, keys), (second, constraints)):
        cells = [line.split("|")[1] for line in table.splitlines() if line.startswith("| `")]
        assert set(re.findall(r"`(\w+)`", "".join(cells))) == names


def test_results_name_files_as_they_were_given(monkeypatch: pytest.MonkeyPatch) -> None:
    """Other paths, by which workers open the data, are seen nowhere; what a query says is not touched."""
    monkeypatch.chdir(ROOT)
    given, real = Path("data", "FOON.txt"), ROOT / "data" / "FOON.txt"
    answerer = Answerer(Sources.of("data").absolute(), Settings())
    (row,) = answerer.answer([(1, json.dumps({"id": str(real), "goal": "ice"}).encode())])
    value = json.loads(row.json)
    assert (row.id, value["id"]) == (str(real), str(real))
    assert {unit["source"]["file"] for unit in value["units"]} == {str(given)}


# Files


def test_parquet_says_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked: list[Drawn] = [
        {"goal": "hummus", "id": 3},
        {"goal": "unicorn"},
        {"goal": "ice", "kitchen": []},
        {"goal": "ice", "id": "i"},
    ]
    queries = write_queries(tmp_path / "q.jsonl", asked)
    for name in ("rows.jsonl", "rows.parquet"):
        command = ["batch", "--queries", queries, "-o", tmp_path / name, "--jobs", 1]
        assert run(capsys, *command)[0] == 0
    rows = read_rows(tmp_path / "rows.jsonl")
    table = pq.read_table(tmp_path / "rows.parquet")
    flat = table.to_pylist()
    assert [json.loads(row["result"]) for row in flat] == rows
    assert [(row["line"], row["id"], row["status"]) for row in flat] == [
        (1, "3", "optimal"),
        (2, None, "error"),
        (3, None, "unreachable"),
        (4, "i", "optimal"),
    ]
    assert flat[0]["tree"] == [unit["id"] for unit in rows[0]["units"]]
    assert {key: flat[0][key] for key in rows[0]["costs"]} == rows[0]["costs"]
    assert flat[0]["goal"] == ["hummus [smooth] in [bowl]"]
    assert (flat[1]["error"], flat[1]["tree"], flat[1]["units"]) == (rows[1]["error"], None, None)
    assert (flat[2]["reason"], flat[2]["tree"]) == (rows[2]["reason"], None)
    said = [line.split("|")[1] for line in PAGE.split("## Parquet")[1].splitlines() if line.startswith("| `")]
    assert re.findall(r"`(\w+)`", "".join(said)) == table.column_names
    assert len(table.to_pandas()) == 4


def test_files_that_will_not_do(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    queries = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}])
    empty = write_queries(tmp_path / "empty.jsonl", ["", "  "])
    there = tmp_path / "there.jsonl"
    there.write_text("mine", encoding="utf-8")
    new = tmp_path / "new.jsonl"
    cases: list[tuple[list[object], str]] = [
        ([tmp_path / "no.jsonl", new], "no such file"),
        ([tmp_path, new], "this is no regular file; save the queries in one"),
        (["/dev/null", new], "this is no regular file; save the queries in one"),
        ([queries, new, "--foon", "x" * 300], "cannot be read (File name too long)"),
        ([empty, new], "there is no query in this file"),
        ([queries, there], "this file is there already; name another one, or add --overwrite"),
        ([queries, tmp_path], "this is a folder; name a file"),
        ([queries, queries], "this would replace an input"),
        ([queries, "/dev/null/x"], "cannot be written"),
        ([queries, new, "--data", tmp_path / "nowhere"], "no such folder"),
        ([queries, new, "--foon", tmp_path / "no.txt"], "no such file"),
        ([queries, new, "--foon", queries, "--jobs", 2], "not a FOON file"),
        ([queries, new, "--scheduler", "nonsense"], "'nonsense' is no address of a scheduler"),
        ([queries, new, "--ship"], "--ship sends the data to the workers of --scheduler"),
    ]
    for arguments, message in cases:
        first, second, *rest = arguments
        command = ["batch", "--queries", first, "-o", second, *rest]
        status, out, err = run(capsys, *command)
        assert (status, out, err.count("\n")) == (2, "", 1)
        assert message in err
    assert there.read_text(encoding="utf-8") == "mine"
    assert sorted(path.name for path in tmp_path.iterdir()) == ["empty.jsonl", "q.jsonl", "there.jsonl"]


def test_queries_that_change_during_the_run(tmp_path: Path) -> None:
    """No row is lost, and no other query answered, where a file grows, shrinks or is edited."""
    path = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}] * 4)
    written = path.read_text()
    for text in (written * 2, written[:40], written.replace("ice", "tea", 1)):
        path.write_text(written)
        file = QueryFile.scan(path)
        out = tmp_path / "o.jsonl"

        def answer(chunks: Iterator[Chunk], text: str = text) -> Generator[Rows, None, None]:
            path.write_text(text)
            for chunk in chunks:
                yield [error_row(line, None, "tried") for line, _ in chunk]

        with pytest.raises(InputError, match="the query file was changed during the run"):
            run_batch(file, out, answer, RunOptions({}, chunk=1))
        assert not out.exists()
        (tmp_path / "o.jsonl.partial").unlink(missing_ok=True)


def test_few_queries_are_shared_by_all_processes() -> None:
    assert [chunk_size(queries, 2) for queries in (1, 8, 16, 40, 1000)] == [1, 1, 2, 5, 16]


def test_a_journal_of_something_else_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    queries, out = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}]), tmp_path / "o.jsonl"
    journal = tmp_path / "o.jsonl.partial"
    command = ["batch", "--queries", queries, "-o", out, "--jobs", 1]
    # The last two are how journals of earlier versions began, and what a kill left of one.
    old = ('{"foon-asp batch": 1, "data": "x"}\n{"line": 1, "status": "error", "id": null}\n', '{"foon-asp')
    for content in ("shopping list\n", "shopping list", *old):
        journal.write_text(content, encoding="utf-8")
        status, _, err = run(capsys, *command)
        assert (status, journal.read_text(encoding="utf-8")) == (2, content)
        assert "this is no journal of foon-asp batch; remove the file to start afresh" in err
    journal.write_bytes(b"")
    assert run(capsys, *command)[0] == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["o.jsonl", "q.jsonl"]


def test_a_progress_bar_has_rate_and_time_left(tmp_path: Path) -> None:
    queries = write_queries(tmp_path / "q.jsonl", many(60))
    command = program("batch", "--queries", queries, "-o", tmp_path / "o.jsonl", "--jobs", 1)
    done = subprocess.run([*command, "--progress"], capture_output=True, text=True, timeout=60, check=True)
    assert re.search(r"\d+%\|.*\| \d+/60 \[\d\d:\d\d<\d\d:\d\d, +[\d.]+ queries/s\]", done.stderr)
    assert re.search(r"o\.jsonl: 60 queries: 56 optimal, 4 unreachable; [\d.]+ queries/s\n$", done.stderr)
    quiet = subprocess.run([*command, "--overwrite"], capture_output=True, text=True, timeout=60, check=True)
    assert quiet.stderr.count("\n") == 1
    assert "%" not in quiet.stderr


# Killed and resumed


@pytest.fixture(scope="module")
def long_run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, bytes]:
    """Queries for some seconds, and the results of a run that nothing disturbs."""
    folder = tmp_path_factory.mktemp("long")
    queries = write_queries(folder / "q.jsonl", many(300))
    out = folder / "o.jsonl"
    command = program("batch", "--queries", queries, "-o", out, "--jobs", 1)
    subprocess.run(command, capture_output=True, timeout=120, check=True)
    return queries, out.read_bytes()


def test_a_killed_run_goes_on_where_it_stopped(
    long_run: tuple[Path, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    command = ["batch", "--queries", queries, "-o", out, "--jobs", 2]
    with started(*command) as process:
        # These are several transactions: a chunk has 15 queries.
        until(lambda: rows_in(journal) > 20)
        workers = workers_of(process)
        process.kill()
        process.wait(60)
        assert len(workers) == 2
        until(lambda: gone(workers))
    assert not out.exists()
    done = rows_in(journal)
    assert 20 < done < 300
    # As if it had been killed in the middle of a write, too: what was written last has no end.
    log = tmp_path / "o.jsonl.partial-wal"
    log.write_bytes(log.read_bytes()[:-20])
    left = rows_in(journal)
    assert 0 < left <= done
    status, _, err = run(capsys, *command)
    assert status == 0
    assert f"{left} done before" in err
    assert out.read_bytes() == expected
    assert sorted(path.name for path in tmp_path.iterdir()) == ["o.jsonl"]


def test_a_journal_of_other_queries_is_left_alone(
    long_run: tuple[Path, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "-o", out, "--jobs", 1) as process:
        until(lambda: rows_in(journal) > 10)
        process.kill()
    before = rows_in(journal)
    other = write_queries(tmp_path / "other.jsonl", [{"goal": "ice"}])
    kitchen = tmp_path / "kitchen.json"
    kitchen.write_text("[]", encoding="utf-8")
    for options, what in (
        (["--queries", other], "query file"),
        (["--queries", queries, "--kitchen", kitchen], "data"),
        (["--queries", queries, "--strict"], "data"),
        (["--queries", queries, "--time-limit", 3], "options"),
        (["--queries", other, "--overwrite", "--timings"], "query file, options"),
    ):
        status, _, err = run(capsys, "batch", *options, "-o", out, "--jobs", 1)
        assert (status, rows_in(journal)) == (2, before)
        assert f"this is the journal of another run: not the same {what}; finish that run, or remove" in err
    status, _, err = run(capsys, "batch", "--queries", queries, "-o", out, "--jobs", 1)
    assert (status, out.read_bytes()) == (0, expected)
    assert f"{before} done before" in err


def test_a_run_that_was_killed_at_the_very_end(
    long_run: tuple[Path, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "-o", out, "--jobs", 1) as process:
        until(lambda: rows_in(journal) > 10)
        process.kill()
    # All rows are there, those that were missing backwards, and so is the result.
    rows = [(row["line"], json.dumps(row["id"]), row["status"]) for row in read_rows_of(expected)]
    with closing(sqlite3.connect(journal)) as database, database:
        written = zip(rows, expected.splitlines(), strict=True)
        missing = [(*row, line) for row, line in written if row[0] > rows_in(journal)]
        database.executemany("INSERT INTO rows VALUES (?, ?, ?, ?)", reversed(missing))
    out.write_bytes(expected)
    status, _, err = run(capsys, "batch", "--queries", queries, "-o", out, "--jobs", 1)
    assert status == 0
    assert "300 done before" in err
    assert out.read_bytes() == expected
    assert not journal.exists()


def test_a_worker_that_is_killed_is_replaced(long_run: tuple[Path, bytes], tmp_path: Path) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "-o", out, "--jobs", 2) as process:
        until(lambda: rows_in(journal) > 10)
        # One that has opened the data: to die before is the end of a run.
        max(workers_of(process), key=lambda worker: sum(worker.cpu_times()[:2])).kill()
        assert process.wait(60) == 0
    assert out.read_bytes() == expected


def test_a_query_that_kills_twice_is_an_error_row(tmp_path: Path) -> None:
    # Nobody waits for the second one: the test plays the system that is out of memory.
    goals = json.loads((ROOT / "data" / "goal_nodes.json").read_text(encoding="utf-8"))
    endless: Drawn = {"id": "big", "goal": goals, "by": "success,depth", "constraints": {"human_steps": 5}}
    queries = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}, endless, {"goal": "ice"}])
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "-o", out, "--jobs", 2) as process:
        until(lambda: any(busy(worker) for worker in workers_of(process)))
        (first,) = [worker for worker in workers_of(process) if busy(worker)]
        first.kill()
        until(lambda: gone([first]))
        # What stood behind the query in its chunk is answered all the same.
        until(lambda: rows_in(journal) == 2)
        until(lambda: any(busy(worker) for worker in workers_of(process)))
        (second,) = [worker for worker in workers_of(process) if busy(worker)]
        second.kill()
        assert process.wait(30) == 0
    rows = read_rows(out)
    assert [row["status"] for row in rows] == ["optimal", "error", "optimal"]
    assert (rows[1]["id"], rows[1]["error"]) == ("big", DIED)


def test_an_interrupted_run_stops_cleanly(
    long_run: tuple[Path, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "-o", out, "--jobs", 2) as process:
        until(lambda: rows_in(journal) > 10)
        workers = workers_of(process)
        # Ctrl-C reaches every process of the group.
        os.killpg(process.pid, signal.SIGINT)
        assert process.wait(60) == 130
        assert process.stderr is not None
        assert process.stderr.read() == "foon-asp: stopped; the same command goes on from here\n"
        until(lambda: gone(workers))
    done = rows_in(journal)
    assert done > 10
    status, _, err = run(capsys, "batch", "--queries", queries, "-o", out, "--jobs", 1)
    assert (status, out.read_bytes()) == (0, expected)
    assert f"{done} done before" in err


# The page
