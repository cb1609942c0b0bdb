"""The commands that read and write files: convert, merge, stats, audit, and levels on the way."""

from __future__ import annotations

import json
import os
import threading
from contextlib import suppress
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from foon_asp.errors import InputError
from foon_asp.io import files
from foon_asp.io.folder import read_foon
from support.cli import run, run_json
from support.text_reading import meaning

A_UNIT = (
    "# Source:\thttp://video\n//\nO5\tonion\t1\nS1\twhole\nO7\tknife\t0\nM2\tchop\t0:05\t0:10\trobot\t0.5\n"
    "O5\tonion\t0\t!\nS3\tchopped\nS4\ton\t[board]\n//\n"
)


@pytest.fixture
def annotated(tmp_path: Path) -> Path:
    path = tmp_path / "a.txt"
    path.write_text(A_UNIT)
    return path


@pytest.mark.parametrize("form", ["text", "annotated", "json", "api-json"])
def test_convert_keeps_the_graph(
    capsys: pytest.CaptureFixture[str], annotated: Path, tmp_path: Path, form: str
) -> None:
    out = tmp_path / "out.foon"
    assert run(capsys, "convert", annotated, "-o", out, "--to", form)[0] == 0
    assert meaning(read_foon([out]).foon) == meaning(read_foon([annotated]).foon)


@pytest.mark.parametrize(("suffix", "word"), [(".txt", "M0\tchop\t0:05"), (".json", '"start_time"')])
def test_convert_takes_the_fuller_format_of_a_suffix(
    capsys: pytest.CaptureFixture[str], annotated: Path, tmp_path: Path, suffix: str, word: str
) -> None:
    out = tmp_path / f"out{suffix}"
    run(capsys, "convert", annotated, "-o", out)
    assert word in out.read_text()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["{}/a.txt", "-o", "{}/x.foon"], "the suffix does not tell the format; name it with --to"),
        (["{}/a.txt", "-o", "{}", "--to", "annotated"], "this would replace an input"),
        (["{}/a.txt", "-o", "{}"], "name the format with --to"),
        (["{}/a.txt", "-o", "{}/a.txt/x.txt"], "cannot be written"),
        (["{}/none.txt", "-o", "{}/x.txt"], "no such file"),
        (["{}/a.pkl", "-o", "{}/x.txt"], "a pickle, which can run any code"),
    ],
)
def test_convert_says_in_one_line_what_is_wrong(
    capsys: pytest.CaptureFixture[str], annotated: Path, arguments: list[str], message: str
) -> None:
    folder = annotated.parent
    (folder / "a.pkl").write_bytes(b"\x80\x04N.")
    status, _, err = run(capsys, "convert", *(each.replace("{}", str(folder)) for each in arguments))
    assert status == 2
    assert message in err
    assert err.count("\n") == 1
    assert annotated.read_text() == A_UNIT


def test_no_input_is_ever_replaced(
    capsys: pytest.CaptureFixture[str], annotated: Path, tmp_path: Path
) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "a.txt").write_text(A_UNIT)
    (tmp_path / "link.txt").symlink_to(annotated)
    other = tmp_path / "sub" / "a.txt"
    for arguments in (
        ["convert", annotated, "-o", annotated],
        ["convert", annotated, "-o", tmp_path / "link.txt"],
        ["merge", annotated, other, "-o", other],
        ["convert", annotated, other, "-o", tmp_path / "sub", "--to", "text"],
        ["audit", annotated, "--fix-dir", tmp_path],
        ["audit", annotated, other, "--fix-dir", tmp_path / "new"],
    ):
        status, _, err = run(capsys, *arguments)
        assert status == 2, arguments
        assert "would replace an input" in err or "two inputs would be written here" in err
    assert annotated.read_text() == other.read_text() == A_UNIT
    assert not (tmp_path / "new").exists()


def test_a_pipe_is_written_to_and_not_replaced(
    capsys: pytest.CaptureFixture[str], annotated: Path, tmp_path: Path
) -> None:
    pipe = tmp_path / "pipe.txt"
    os.mkfifo(pipe)
    reader = os.open(pipe, os.O_RDONLY | os.O_NONBLOCK)
    assert run(capsys, "convert", annotated, "-o", pipe, "--to", "text")[0] == 0
    assert os.read(reader, 9) == b"//\nO\tonion"[:9]
    os.close(reader)
    assert pipe.is_fifo()


def test_merge_on_a_level(capsys: pytest.CaptureFixture[str], annotated: Path, tmp_path: Path) -> None:
    run(capsys, "merge", annotated, "-o", tmp_path / "m.txt", "--level", "1")
    foon = read_foon([tmp_path / "m.txt"]).foon
    assert [node.label for node in foon.objects] == ["onion", "knife"]
    assert all(node.bare for node in foon.objects)


def test_stats_with_centrality(capsys: pytest.CaptureFixture[str]) -> None:
    value = run_json(capsys, "stats", "--centrality")
    assert len(value["centrality"]["katz"]) == 10
    status, out, _ = run(capsys, "stats", "--centrality")
    assert status == 0
    assert "eigenvector centrality" in out


@pytest.mark.parametrize("level", [1, 2])
@pytest.mark.parametrize("method", ["optimal", "greedy", "ids", "first"])
def test_retrieve_on_a_level(capsys: pytest.CaptureFixture[str], level: int, method: str) -> None:
    value = run_json(capsys, "retrieve", "whipped cream [creamy]", "--level", level, "--method", method)
    assert value["executable"]
    full = run_json(capsys, "retrieve", "whipped cream [creamy]")
    assert value["size"] <= full["size"] or method != "optimal"


def test_reach_grows_with_every_level_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    counts = [run_json(capsys, "reach", "--level", level) for level in (1, 2, 3)]
    assert all(count["executable"] == count["units"] for count in counts)
    assert counts[0]["objects"] < counts[1]["objects"] < counts[2]["objects"]


def test_sarif_is_what_code_hosts_read(capsys: pytest.CaptureFixture[str], annotated: Path) -> None:
    annotated.write_text(A_UNIT.replace("on\t[board]", "on [board]"))
    status, out, _ = run(capsys, "audit", annotated, "--format", "sarif")
    assert status == 0
    log = json.loads(out)
    schema = json.loads(Path(__file__).with_name("sarif_subset.schema.json").read_text())
    Draft202012Validator(schema).validate(log)
    [result] = [r for r in log["runs"][0]["results"] if r["ruleId"] == "missing-tab"]
    place = result["locations"][0]["physicalLocation"]
    assert place["artifactLocation"]["uri"] == annotated.as_uri()
    assert place["region"]["startLine"] == 9


def test_fix_writes_a_repaired_copy_and_lists_the_mends(
    capsys: pytest.CaptureFixture[str], annotated: Path
) -> None:
    annotated.write_text(A_UNIT.replace("on\t[board]", "on [board]"))
    status, _, err = run(capsys, "audit", annotated, "--fix")
    assert status == 0
    assert f"{annotated}:9: missing-tab" in err
    assert (annotated.parent / "a.fixed.txt").read_text() == A_UNIT


def test_fail_on_is_for_continuous_integration(capsys: pytest.CaptureFixture[str], annotated: Path) -> None:
    assert run(capsys, "audit", annotated, "--fail-on", "error")[0] == 0
    assert run(capsys, "audit", annotated, "--fail-on", "note")[0] == 1
    assert run(capsys, "audit", "--fail-on", "warning")[0] == 0


def test_strict_format_stops_at_the_first_oddity(capsys: pytest.CaptureFixture[str], annotated: Path) -> None:
    annotated.write_text(A_UNIT.replace("on\t[board]", "on [board]"))
    for command in (["stats"], ["audit"], ["merge"]):
        status, out, err = run(capsys, *command, annotated, "--strict-format")
        assert (status, out) == (2, "")
        assert f"{annotated}:9: " in err
        assert "missing-tab" in err


def test_the_suffix_and_the_format_agree(
    capsys: pytest.CaptureFixture[str], annotated: Path, tmp_path: Path
) -> None:
    for name, form in (("x.json", "text"), ("x.JSON", "annotated"), ("x.txt", "json"), ("x.TXT", "api-json")):
        status, _, err = run(capsys, "convert", annotated, "-o", tmp_path / name, "--to", form)
        assert (status, err.count("\n")) == (2, 1)
        assert "the suffix says" in err
        assert not (tmp_path / name).exists()
    for name, form in (("y.JSON", "json"), ("y.TXT", "text"), ("y", "json"), ("y.foon", "text")):
        assert run(capsys, "convert", annotated, "-o", tmp_path / name, "--to", form)[0] == 0
    assert run(capsys, "convert", annotated, "-o", tmp_path / "z.JSON")[0] == 0
    assert json.loads((tmp_path / "z.JSON").read_text())


@pytest.mark.parametrize(
    "command",
    [["stats", "{}"], ["reach", "--kitchen", "{}"], ["query", "{}"], ["retrieve", "ice", "--rates", "{}"]],
)
def test_what_never_ends_is_not_read(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, command: list[str]
) -> None:
    (tmp_path / "link.txt").symlink_to("/dev/zero")
    for name in ("/dev/zero", str(tmp_path / "link.txt"), "/dev/urandom"):
        status, _, err = run(capsys, *(each.replace("{}", name) for each in command))
        assert (status, err) == (
            2,
            f"foon-asp: error: {name}: this is a device, which has no end; name a file\n",
        )


def test_a_stream_that_goes_on_is_read_to_a_limit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A pipe is read like a file, up to a size that no FOON has."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    monkeypatch.setattr(files, "_LONGEST_STREAM", 1 << 20)

    def fill(size: int) -> None:
        with suppress(BrokenPipeError), pipe.open("wb") as file:
            file.write(bytes(size))

    for size in (1 << 20, (1 << 20) + 1):
        writer = threading.Thread(target=fill, args=(size,))
        writer.start()
        if size > 1 << 20:
            with pytest.raises(InputError, match="more than 1 MB come from here; save them in a file"):
                files.read_bytes(pipe)
        else:
            assert len(files.read_bytes(pipe)) == size
        writer.join(10)
