"""The commands that read and write files: convert, merge, stats, audit, and levels on the way."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path

import pytest
from conftest import ROOT
from jsonschema import Draft202012Validator
from test_cli import run, run_json

from foon_asp.dataset import read_foon
from foon_asp.graph import Foon

A_UNIT = (
    "# Source:\thttp://video\n//\nO5\tonion\t1\nS1\twhole\nO7\tknife\t0\nM2\tchop\t0:05\t0:10\trobot\t0.5\n"
    "O5\tonion\t0\t!\nS3\tchopped\nS4\ton\t[board]\n//\n"
)


def meaning(foon: Foon) -> list[tuple[object, ...]]:
    def nodes(numbers: tuple[int, ...]) -> list[object]:
        return [foon.objects[number] for number in numbers]

    return [(nodes(unit.inputs), unit.motion, nodes(unit.outputs)) for unit in foon.units]


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


def test_convert_of_many_into_a_folder(
    capsys: pytest.CaptureFixture[str], public_data: Path, tmp_path: Path
) -> None:
    files = sorted((public_data / "subgraphs").glob("00*.txt"))[:5]
    assert run(capsys, "convert", *files, "-o", tmp_path, "--to", "api-json")[0] == 0
    for path in files:
        again = read_foon([tmp_path / f"{path.stem}.json"])
        assert meaning(again.foon) == meaning(read_foon([path]).foon)


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


def test_merge_counts_and_keeps_where_each_unit_comes_from(
    capsys: pytest.CaptureFixture[str], public_data: Path, tmp_path: Path
) -> None:
    files = sorted((public_data / "subgraphs").glob("*.txt"))
    out = tmp_path / "FOON.txt"
    status, text, _ = run(capsys, "merge", *files, "-o", out)
    assert status == 0
    assert "56 files, 1131 units read, 1 left out, 32 duplicates removed: 1099 units, 2152 objects" in text
    direct, again = read_foon(files).foon, read_foon([out]).foon
    assert meaning(again) == meaning(direct)
    assert [u.annotation for u in again.units] == [u.annotation for u in direct.units]


def test_merge_on_a_level(capsys: pytest.CaptureFixture[str], annotated: Path, tmp_path: Path) -> None:
    run(capsys, "merge", annotated, "-o", tmp_path / "m.txt", "--level", "1")
    foon = read_foon([tmp_path / "m.txt"]).foon
    assert [node.label for node in foon.objects] == ["onion", "knife"]
    assert all(node.bare for node in foon.objects)


def test_stats_count_units_before_and_after_merging(
    capsys: pytest.CaptureFixture[str], public_data: Path
) -> None:
    files = sorted((public_data / "subgraphs").glob("*.txt"))
    value = run_json(capsys, "stats", *files)
    # Counted without the reader: every M line is a unit, but for the one unit that has none.
    motions = sum(path.read_text().count("\nM") for path in files)
    assert value["units_read"] == motions == 1131
    assert (value["units"], value["objects"]) == independent_count(files)
    assert value["levels"]["3"] == {"units": 1099, "objects": 2152}
    assert value["findings"]["unit-without-motion"] == 1


def independent_count(files: list[Path]) -> tuple[int, int]:
    """Count distinct units and objects by plain text handling, knowing nothing of the reader."""
    units: set[object] = set()
    objects: set[object] = set()
    for path in files:
        for chunk in re.split(r"^//.*$", path.read_text(), flags=re.MULTILINE):
            sides: list[list[tuple[str, set[str]]]] = [[], []]
            motion = ""
            for line in chunk.splitlines():
                fields = [field.strip() for field in line.split("\t")]
                if line.startswith("O"):
                    sides[bool(motion)].append((fields[1], set()))
                elif line.startswith("M"):
                    motion = fields[1].rstrip("*")
                elif line.startswith("S"):
                    sides[bool(motion)][-1][1].add(plain_state(fields[1:]))
            if motion:
                frozen = [frozenset((label, frozenset(states)) for label, states in s) for s in sides]
                units.add((frozen[0], motion, frozen[1]))
                objects |= frozen[0] | frozen[1]
    return len(units), len(objects)


def plain_state(fields: list[str]) -> str:
    name = fields[0]
    text = " ".join(fields[1:])
    inner = text.strip("{}[]")
    items = sorted(item.strip() for item in inner.split(",") if item.strip())
    if not items:
        return name
    braces = "{" in text
    if name == "contains":
        braces = True
    elif braces and len(items) == 1 and name in ("in", "on", "under", "with"):
        braces = False
    return f"{name} {items if braces else [inner.strip()]}"


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


def test_every_public_file_is_audited_with_exit_0(
    capsys: pytest.CaptureFixture[str], public_data: Path
) -> None:
    files = sorted((public_data / "subgraphs").glob("*.txt"))
    for path in [*files, public_data / "universal" / "FOON.txt"]:
        value = run_json(capsys, "audit", path)
        assert value["findings"], path
        assert all(finding["file"] == str(path) for finding in value["findings"])


def test_sarif_is_what_code_hosts_read(capsys: pytest.CaptureFixture[str], annotated: Path) -> None:
    annotated.write_text(A_UNIT.replace("on\t[board]", "on [board]"))
    status, out, _ = run(capsys, "audit", annotated, "--format", "sarif")
    assert status == 0
    log = json.loads(out)
    schema = json.loads((ROOT / "tests" / "sarif_subset.schema.json").read_text())
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
