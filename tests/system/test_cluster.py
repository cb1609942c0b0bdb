"""`foon-asp batch --scheduler`: a real Dask scheduler and real workers, some of which are killed."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import psutil
import pytest

from foon_asp.batch.answerer import Settings
from foon_asp.batch.cluster import Scheduler, answer_on_cluster
from foon_asp.batch.query_file import QueryFile
from foon_asp.batch.tasks import DIED
from foon_asp.errors import QueryError
from foon_asp.io.folder import Sources
from foon_asp.io.open import open_files
from foon_asp.io.store import write_store
from support.batch_runs import Drawn, busy, many, program, read_rows, rows_in, started, until, write_queries
from support.cli import run
from support.paths import ROOT


class Cluster:
    """A scheduler on this machine, and its workers."""

    def __init__(self, folder: Path, **environment: str) -> None:
        self.folder = folder
        self._stack = ExitStack()
        file = folder / "scheduler.json"
        command = ["scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--no-show"]
        self.scheduler = self._start([*command, "--scheduler-file", str(file)], environment)
        until(lambda: file.exists() and file.read_text(encoding="utf-8").endswith("}"))
        self.address = json.loads(file.read_text(encoding="utf-8"))["address"]

    def worker(self, *options: str, **environment: str) -> subprocess.Popen[bytes]:
        """Start a worker with one thread, in a folder of its own."""
        home = self.folder / f"worker-{len(list(self.folder.iterdir()))}"
        home.mkdir()
        command = ["worker", self.address, "--nthreads", "1", "--host", "127.0.0.1", "--no-dashboard"]
        return self._start([*command, "--local-directory", str(home), *options], environment, home)

    def close(self) -> None:
        self._stack.close()

    def _start(
        self, command: Sequence[str], environment: dict[str, str], home: Path | None = None
    ) -> subprocess.Popen[bytes]:
        process = subprocess.Popen(
            [sys.executable, "-m", "dask", *command],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
            cwd=home or self.folder,
            env={**os.environ, **environment},
            start_new_session=True,
        )
        self._stack.callback(stop, process)
        return process


def stop(process: subprocess.Popen[bytes]) -> None:
    with suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait(30)


@contextmanager
def cluster_in(folder: Path, **environment: str) -> Iterator[Cluster]:
    cluster = Cluster(folder, **environment)
    try:
        yield cluster
    finally:
        cluster.close()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Cluster]:
    with cluster_in(tmp_path_factory.mktemp("cluster")) as cluster:
        for _ in range(2):
            cluster.worker("--no-nanny")
        yield cluster


@pytest.fixture(scope="module")
def local_run(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, bytes]:
    """Queries for some seconds, and the results of a run in one process."""
    folder = tmp_path_factory.mktemp("local")
    queries, out = (
        write_queries(folder / "q.jsonl", [*many(300), "{", {"goal": "unicorn"}]),
        folder / "o.jsonl",
    )
    command = program("batch", "--queries", queries, "-o", out, "--jobs", 1)
    subprocess.run(command, capture_output=True, timeout=120, check=True)
    return queries, out.read_bytes()


def test_a_killed_worker_changes_nothing(
    cluster: Cluster, local_run: tuple[Path, bytes], tmp_path: Path
) -> None:
    queries, expected = local_run
    out, journal = tmp_path / "o.jsonl", tmp_path / "o.jsonl.partial"
    third = cluster.worker("--no-nanny")
    with started("batch", "--queries", queries, "-o", out, "--scheduler", cluster.address) as process:
        until(lambda: rows_in(journal) > 10)
        assert rows_in(journal) < 280
        third.kill()
        # One more joins in the middle.
        cluster.worker("--no-nanny")
        assert process.wait(60) == 0
    assert out.read_bytes() == expected


@pytest.mark.parametrize(
    ("folder", "foon", "ship"),
    [
        ("data", "data/FOON.txt", []),
        ("data", "data/FOON.txt", ["--ship"]),
        ("data", "FOON.foon", ["--ship"]),
        # By this name each process finds what lies in its own folder, so the workers find nothing.
        ("/proc/self/cwd/data", "/proc/self/cwd/data/FOON.txt", []),
    ],
    ids=["by path", "shipped", "store", "shipped when missed"],
)
def test_results_name_files_as_the_local_run_does(
    folder: str,
    foon: str,
    ship: list[str],
    cluster: Cluster,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "data").symlink_to(ROOT / "data")
    monkeypatch.chdir(tmp_path)
    text = Path("data/FOON.txt")
    write_store(open_files(text), Path("FOON.foon"), [text])
    asked: list[Drawn] = [
        {"goal": "hummus"},
        {"goal": "whipped cream", "kitchen": []},
        {"goal": "ice", "add": ["salt"]},
        {
            "goal": "omelette [cooked]",
            "constraints": {"without": ["salt"]},
            "substitute": [{"label": "salt", "by": None, "likeness": 0.5}],
        },
    ]
    queries = write_queries(tmp_path / "q.jsonl", asked)
    command = ["batch", "--queries", queries, "--data", folder, "--foon", foon]
    assert run(capsys, *command, "-o", "a.jsonl", "--jobs", 1)[0] == 0
    remote = program(*command, "-o", "b.jsonl", "--scheduler", cluster.address, *ship)
    subprocess.run(remote, capture_output=True, timeout=60, check=True)
    assert (tmp_path / "b.jsonl").read_bytes() == (tmp_path / "a.jsonl").read_bytes()
    first, *_, replaced = read_rows(tmp_path / "b.jsonl")
    read = str(text) if foon.endswith(".foon") else foon
    assert {unit["source"]["file"] for row in (first, replaced) for unit in row["units"]} == {read}
    assert [row["label"] for row in replaced["replacements"]] == ["salt"]
    until(lambda: not list(cluster.folder.rglob("foon-asp-*")))


def test_data_that_cannot_be_opened_end_the_run(
    cluster: Cluster, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The command looks at them first; a worker that cannot read them says so, too."""
    (tmp_path / "FOON.txt").write_text("not a FOON\n", encoding="utf-8")
    queries, out = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}]), tmp_path / "o.jsonl"
    command = ["batch", "--queries", queries, "-o", out, "--data", tmp_path]
    status, _, err = run(capsys, *command, "--scheduler", cluster.address)
    assert (status, err.count("\n")) == (2, 1)
    assert "not a FOON file" in err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["FOON.txt", "q.jsonl"]
    chunks = QueryFile.scan(queries).chunks(1, lambda _: False)
    answers = answer_on_cluster(Sources.of(tmp_path), Settings(), chunks, Scheduler(cluster.address))
    with pytest.raises(QueryError, match=r"a worker cannot answer: .*not a FOON file"):
        list(answers)


def test_a_cluster_that_is_not_there(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    queries, out = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}]), tmp_path / "o.jsonl"
    command = ["batch", "--queries", queries, "-o", out, "--scheduler", "tcp://127.0.0.1:9"]
    status, _, err = run(capsys, *command)
    assert (status, err.count("\n")) == (2, 1)
    assert "no Dask scheduler answers at tcp://127.0.0.1:9" in err


def test_workers_that_are_missing_or_know_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    queries, out = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}]), tmp_path / "o.jsonl"
    other = tmp_path / "path" / "foon_asp.py"
    other.parent.mkdir()
    other.write_text('"""Something else of this name."""\n', encoding="utf-8")
    home = tmp_path / "cluster"
    home.mkdir()
    with cluster_in(home) as cluster:
        command = ["batch", "--queries", queries, "-o", out, "--scheduler", cluster.address]
        with monkeypatch.context() as patience:
            patience.setattr("foon_asp.batch.cluster._FIRST_WORKER", 1)
            status, _, err = run(capsys, *command)
        assert (status, err.count("\n")) == (2, 1)
        assert f"the scheduler has no workers; start some with: dask worker {cluster.address}" in err
        cluster.worker("--no-nanny", PYTHONPATH=str(other.parent))
        status, _, err = run(capsys, *command)
        assert (status, err.count("\n")) == (2, 1)
        assert "cannot run foon-asp" in err
        assert "install foon-asp==" in err


def test_a_query_that_kills_and_a_scheduler_that_is_lost(
    local_run: tuple[Path, bytes], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    home = tmp_path / "cluster"
    home.mkdir()
    # With no death forgiven by the scheduler, a second one is the end of a query.
    with cluster_in(home, DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES="0") as cluster:
        nanny = psutil.Process(cluster.worker().pid)
        goals = json.loads((ROOT / "data" / "goal_nodes.json").read_text(encoding="utf-8"))
        endless: Drawn = {"id": 5, "goal": goals, "by": "success,depth", "constraints": {"human_steps": 5}}
        queries = write_queries(tmp_path / "q.jsonl", [{"goal": "ice"}, endless, {"goal": "hummus"}])
        out = tmp_path / "o.jsonl"
        with started("batch", "--queries", queries, "-o", out, "--scheduler", cluster.address) as process:
            for _ in range(2):
                until(lambda: any(map(busy, nanny.children(recursive=True))), 60)
                (worker,) = [child for child in nanny.children(recursive=True) if busy(child)]
                worker.kill()
                worker.wait(30)
            assert process.wait(60) == 0
        rows = read_rows(out)
        assert [row["status"] for row in rows] == ["optimal", "error", "optimal"]
        assert (rows[1]["id"], rows[1]["error"]) == (5, DIED)

        queries, expected = local_run
        out, journal = tmp_path / "lost.jsonl", tmp_path / "lost.jsonl.partial"
        command = ["batch", "--queries", queries, "-o", out]
        with started(*command, "--scheduler", cluster.address) as process:
            until(lambda: rows_in(journal) > 10)
            cluster.scheduler.kill()
            _, err = process.communicate(timeout=60)
        assert (process.returncode, err.count("\n")) == (2, 1)
        assert (
            f"the scheduler {cluster.address} is gone; once there is one again, the same command goes on"
            in err
        )
    done = rows_in(journal)
    assert 10 < done < 302
    status, _, err = run(capsys, *command, "--jobs", 1)
    assert (status, out.read_bytes()) == (0, expected)
    assert f"{done} done before" in err
