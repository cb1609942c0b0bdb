"""`foon-asp batch`: rows for queries good and bad, killed and resumed runs, Parquet, what the page says."""

from __future__ import annotations

import json
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import psutil
import pyarrow.parquet as pq
import pytest
from conftest import ROOT
from jsonschema import Draft202012Validator
from test_cli import run, run_json

from foon_asp.batch import chunk_size, run_batch
from foon_asp.batch_file import Chunk, QueryFile
from foon_asp.dataset import Dataset
from foon_asp.errors import InputError
from foon_asp.render.batch import row_bytes, row_value
from foon_asp.workers import DIED

Query = dict[str, Any] | str
SCHEMAS = ROOT / "docs" / "schema"
PAGE = (ROOT / "docs" / "batch.md").read_text(encoding="utf-8")


def write_queries(path: Path, queries: Sequence[Query]) -> Path:
    lines = [query if isinstance(query, str) else json.dumps(query) for query in queries]
    path.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    return path


def read_rows(path: Path) -> list[dict[str, Any]]:
    validator = Draft202012Validator(json.loads((SCHEMAS / "batch-result.schema.json").read_text()))
    rows = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
    for row in rows:
        validator.validate(row)
    return rows


@pytest.fixture
def batch(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., list[dict[str, Any]]]:
    """Answer queries in this process and return the rows."""

    def answer(queries: Sequence[Query], *options: object) -> list[dict[str, Any]]:
        path, out = write_queries(tmp_path / "queries.jsonl", queries), tmp_path / "rows.jsonl"
        arguments = ["batch", "--queries", path, "--out", out, "--jobs", 1, "--overwrite", *options]
        status, printed, err = run(capsys, *arguments)
        assert (status, printed) == (0, ""), err
        assert not (tmp_path / "rows.jsonl.partial").exists()
        return read_rows(out)

    return answer


def program(*arguments: object) -> list[str]:
    return [sys.executable, "-m", "foon_asp", *map(str, arguments)]


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
    assert rows[8]["constraints"] == ["without salt", "diet vegan", "at most 1 units"]
    tree = [unit["id"] for unit in rows[1]["units"]]
    domain = built_in.domain()
    made = {thing for unit in tree for thing in domain.reading.makes[unit]}
    assert {domain.foon.objects[thing].label for thing in made} >= {"greek salad", "hummus"}


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
        ({"goal": {"name": "ice"}}, "'goal': 'label' is missing or no text"),
        ({"gaol": "ice"}, "unknown key 'gaol'; closest: goal"),
        ({"goal": "ice", "id": True}, "'id' is a text or a number, not true or false"),
        (
            {"goal": "ice", "constraints": {"max_unit": 3}},
            "unknown constraint 'max_unit'; closest: max_units",
        ),
        ({"goal": "ice", "constraints": {"max_units": "3"}}, "'max_units' takes whole numbers from 0"),
        (
            {"goal": "ice", "constraints": {"min_success": 1.5}},
            "a chance of success is above 0 and at most 1",
        ),
        ({"goal": "ice", "constraints": {"diets": ["vegn"]}}, "no diet 'vegn'; closest: vegan"),
        ({"goal": "ice", "constraints": {"without": ["slat"]}}, "closest: salt"),
        ({"goal": "ice", "by": "unit"}, "there is no criterion 'unit'; closest: units"),
        ({"goal": "ice", "method": "best"}, "unknown method 'best'"),
        ({"goal": "ice", "time_limit": -1}, "'time_limit' is a number from 0 to 1e9"),
        ({"goal": "ice", "time_limit": 10**400}, "'time_limit' is a number from 0 to 1e9"),
        ({"goal": "ice", "kitchen": [], "add": ["salt"]}, "leave out 'add' and 'remove'"),
        ({"goal": "ice", "add": "salt"}, "'add' is a list of objects, not a text"),
        ({"goal": "ice", "remove": ["unicorn"]}, "nothing of the kitchen can be removed by this name"),
        ({"goal": "ice", "remove": [{"label": "sugra"}]}, "the kitchen has no sugra to remove"),
        ({"goal": "\udcff"}, "no object has this label"),
        ('{"goal": "ice", "id": 1e999}', "'id' is a number that is too large"),
    ],
    ids=range(25),
)
def test_a_wrong_query_is_one_error_row(
    query: Query, message: str, batch: Callable[..., list[dict[str, Any]]]
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
    assert run(capsys, "batch", "--queries", queries, "--out", out, "--jobs", 1)[0] == 0
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
    }
    validator.validate(full)
    batch([full])
    for key in ("goal", "by", "constraints", "time_limit", "add"):
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


# Files


def test_parquet_says_the_same(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    asked: list[Query] = [
        {"goal": "hummus", "id": 3},
        {"goal": "unicorn"},
        {"goal": "ice", "kitchen": []},
        {"goal": "ice", "id": "i"},
    ]
    queries = write_queries(tmp_path / "q.jsonl", asked)
    for name in ("rows.jsonl", "rows.parquet"):
        command = ["batch", "--queries", queries, "--out", tmp_path / name, "--jobs", 1]
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
        ([queries, tmp_path], "this is no regular file"),
        ([queries, queries], "this would replace the queries"),
        ([queries, "/dev/null/x"], "cannot be written"),
        ([queries, new, "--data", tmp_path / "nowhere"], "no such folder"),
        ([queries, new, "--foon", tmp_path / "no.txt"], "no such file"),
        ([queries, new, "--foon", queries, "--jobs", 2], "not a FOON file"),
        ([queries, new, "--scheduler", "nonsense"], "'nonsense' is no address of a scheduler"),
        ([queries, new, "--ship"], "--ship sends the data to the workers of --scheduler"),
    ]
    for arguments, message in cases:
        first, second, *rest = arguments
        command = ["batch", "--queries", first, "--out", second, *rest]
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

        def answer(chunks: Iterator[Chunk], text: str = text) -> Iterator[list[bytes]]:
            path.write_text(text)
            for chunk in chunks:
                yield [row_bytes(row_value(line, None, "tried", timings=False)) for line, _ in chunk]

        with pytest.raises(InputError, match="the query file was changed during the run"):
            run_batch(file, out, answer, {}, chunk=1)  # type: ignore[arg-type]
        assert not out.exists()
        (tmp_path / "o.jsonl.partial").unlink(missing_ok=True)


def test_few_queries_are_shared_by_all_processes() -> None:
    assert [chunk_size(queries, 2) for queries in (1, 8, 16, 40, 1000)] == [1, 1, 2, 5, 16]


def test_a_journal_of_something_else_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    queries, out = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}]), tmp_path / "o.jsonl"
    journal = tmp_path / "o.jsonl.partial"
    command = ["batch", "--queries", queries, "--out", out, "--jobs", 1]
    for content in ("shopping list\n", "shopping list", '{"foon-asp batch": 1, \n'):
        journal.write_text(content, encoding="utf-8")
        status, _, err = run(capsys, *command)
        assert (status, journal.read_text(encoding="utf-8")) == (2, content)
        assert "this is no journal of foon-asp batch; remove the file to start afresh" in err
    for torn in ("", '{"foon-asp', '{"foon-asp batch": 1, "query fi'):
        journal.write_text(torn, encoding="utf-8")
        assert run(capsys, *command, "--overwrite")[0] == 0


def test_two_runs_do_not_write_one_journal(tmp_path: Path) -> None:
    from foon_asp.batch import Journal

    path = tmp_path / "o.jsonl.partial"
    with Journal(path, {"data": "x"}, 3), pytest.raises(InputError, match="another run is writing this"):
        Journal(path, {"data": "x"}, 3)
    assert not path.exists()


def test_a_progress_bar_has_rate_and_time_left(tmp_path: Path) -> None:
    queries = write_queries(tmp_path / "q.jsonl", many(60))
    command = program("batch", "--queries", queries, "--out", tmp_path / "o.jsonl", "--jobs", 1)
    done = subprocess.run([*command, "--progress"], capture_output=True, text=True, timeout=60, check=True)
    assert re.search(r"\d+%\|.*\| \d+/60 \[\d\d:\d\d<\d\d:\d\d, +[\d.]+ queries/s\]", done.stderr)
    assert re.search(r"o\.jsonl: 60 queries: 56 optimal, 4 unreachable; [\d.]+ queries/s\n$", done.stderr)
    quiet = subprocess.run([*command, "--overwrite"], capture_output=True, text=True, timeout=60, check=True)
    assert quiet.stderr.count("\n") == 1
    assert "%" not in quiet.stderr


# Killed and resumed

GOALS = ("whipped cream", "greek salad", "hummus", "pesto pasta", "ice")


def many(count: int) -> list[Query]:
    """Return queries that take some milliseconds each, from a few kitchens."""
    return [
        {
            "id": place,
            "goal": GOALS[place % len(GOALS)],
            "by": "units,success",
            "remove": removed(place // 40),
        }
        for place in range(count)
    ]


def removed(kitchen: int) -> list[str]:
    return [[], ["oregano"], ["cumin"], ["powdered sugar"]][kitchen % 4]


@pytest.fixture(scope="module")
def long_run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, bytes]:
    """Queries for some seconds, and the results of a run that nothing disturbs."""
    folder = tmp_path_factory.mktemp("long")
    queries = write_queries(folder / "q.jsonl", many(120))
    out = folder / "o.jsonl"
    command = program("batch", "--queries", queries, "--out", out, "--jobs", 1)
    subprocess.run(command, capture_output=True, timeout=120, check=True)
    return queries, out.read_bytes()


@contextmanager
def started(*arguments: object) -> Iterator[subprocess.Popen[str]]:
    """Start the program in a group of its own, and leave nothing of it behind."""
    process = subprocess.Popen(program(*arguments), stderr=subprocess.PIPE, text=True, start_new_session=True)
    try:
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate(timeout=30)


def until(condition: Callable[[], object], seconds: float = 30) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "this takes too long"
        time.sleep(0.02)


def rows_in(journal: Path) -> int:
    return journal.read_bytes().count(b"\n") - 1 if journal.exists() else 0


def workers_of(process: subprocess.Popen[str]) -> list[psutil.Process]:
    found = []
    for child in psutil.Process(process.pid).children():
        with suppress(psutil.NoSuchProcess):
            if any("spawn_main" in part for part in child.cmdline()):
                found.append(child)
    return found


def gone(processes: Sequence[psutil.Process]) -> bool:
    return not any(each.is_running() and each.status() != psutil.STATUS_ZOMBIE for each in processes)


def test_a_killed_run_goes_on_where_it_stopped(
    long_run: tuple[Path, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    command = ["batch", "--queries", queries, "--out", out, "--jobs", 2]
    with started(*command) as process:
        until(lambda: rows_in(journal) > 10)
        workers = workers_of(process)
        process.kill()
        process.wait(10)
        assert len(workers) == 2
        until(lambda: gone(workers))
    assert not out.exists()
    done = rows_in(journal)
    assert 10 < done < 120
    # As if it had been killed in the middle of a write, too: the last row has no end.
    journal.write_bytes(journal.read_bytes()[:-20])
    status, _, err = run(capsys, *command)
    assert status == 0
    assert f"{done - 1} done before" in err
    assert out.read_bytes() == expected
    assert sorted(path.name for path in tmp_path.iterdir()) == ["o.jsonl"]


def test_a_journal_of_other_queries_is_left_alone(
    long_run: tuple[Path, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "--out", out, "--jobs", 1) as process:
        until(lambda: rows_in(journal) > 10)
        process.kill()
    before = journal.read_bytes()
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
        status, _, err = run(capsys, "batch", *options, "--out", out, "--jobs", 1)
        assert (status, journal.read_bytes()) == (2, before)
        assert f"this is the journal of another run: not the same {what}; finish that run, or remove" in err
    status, _, _ = run(capsys, "batch", "--queries", queries, "--out", out, "--jobs", 1)
    assert (status, out.read_bytes()) == (0, expected)


def test_a_run_that_was_killed_at_the_very_end(
    long_run: tuple[Path, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "--out", out, "--jobs", 1) as process:
        until(lambda: rows_in(journal) > 10)
        process.kill()
    header, *_ = journal.read_bytes().splitlines(keepends=True)
    # All rows are there, backwards and one of them twice, and so is the result.
    rows = expected.splitlines(keepends=True)
    journal.write_bytes(header + b"".join(reversed(rows)) + rows[7])
    out.write_bytes(expected)
    status, _, err = run(capsys, "batch", "--queries", queries, "--out", out, "--jobs", 1)
    assert status == 0
    assert "120 done before" in err
    assert out.read_bytes() == expected
    assert not journal.exists()


def test_a_worker_that_is_killed_is_replaced(long_run: tuple[Path, bytes], tmp_path: Path) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "--out", out, "--jobs", 2) as process:
        until(lambda: rows_in(journal) > 10)
        workers_of(process)[0].kill()
        assert process.wait(60) == 0
    assert out.read_bytes() == expected


def test_a_query_that_kills_twice_is_an_error_row(tmp_path: Path) -> None:
    # Nobody waits for the second one: the test plays the system that is out of memory.
    goals = json.loads((ROOT / "data" / "goal_nodes.json").read_text(encoding="utf-8"))
    endless: Query = {"id": "big", "goal": goals, "by": "success,depth", "constraints": {"human_steps": 5}}
    queries = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}, endless, {"goal": "ice"}])
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "--out", out, "--jobs", 2) as process:
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


def busy(process: psutil.Process) -> bool:
    """Whether a worker is at something that takes long: opening the data takes it about a second."""
    with suppress(psutil.NoSuchProcess):
        return sum(process.cpu_times()[:2]) > 2.5
    return False


def test_an_interrupted_run_stops_cleanly(
    long_run: tuple[Path, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    queries, expected = long_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    with started("batch", "--queries", queries, "--out", out, "--jobs", 2) as process:
        until(lambda: rows_in(journal) > 10)
        workers = workers_of(process)
        # Ctrl-C reaches every process of the group.
        os.killpg(process.pid, signal.SIGINT)
        assert process.wait(10) == 130
        assert process.stderr is not None
        assert process.stderr.read() == "foon-asp: stopped; the same command goes on from here\n"
        assert gone(workers)
    done = rows_in(journal)
    assert done > 10
    status, _, err = run(capsys, "batch", "--queries", queries, "--out", out, "--jobs", 1)
    assert (status, out.read_bytes()) == (0, expected)
    assert f"{done} done before" in err


# The page


def test_the_page_shows_what_is_printed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    (queries,) = re.findall(r"```json\n(.*?)```", PAGE, re.DOTALL)
    (tmp_path / "queries.jsonl").write_text(queries, encoding="utf-8")
    (block,) = re.findall(r"```\n(\$ foon-asp batch .*?)```", PAGE, re.DOTALL)
    commands = re.findall(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", block, re.MULTILINE)
    assert len(commands) == 2
    (first, said), (second, shown) = commands
    status, out, err = run(capsys, *shlex.split(first)[1:])
    assert (status, out) == (0, "")
    assert re.sub(r"[\d.]+ queries/s", "N queries/s", err) == re.sub(r"[\d.]+ queries/s", "N queries/s", said)
    done = subprocess.run(
        [sys.executable, *shlex.split(second)[1:]], capture_output=True, text=True, timeout=30, check=True
    )
    assert done.stdout == shown
