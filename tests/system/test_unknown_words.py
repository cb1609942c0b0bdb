"""What beside a FOON is probably misspelt is told once; what it may rightly know is not."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterable
from pathlib import Path

import pytest

import foon_asp as fa
from foon_asp.io.findings import Finding
from support.cli import run, run_json
from support.paths import ROOT

DATA = ("FOON.txt", "kitchen.json", "motion.txt", "utensils.txt", "goal_nodes.json")


def folder(path: Path, **changed: tuple[str, str]) -> Path:
    """Copy the built-in data with a line of some files replaced."""
    for name in DATA:
        shutil.copy(ROOT / "data" / name, path / name)
    for name, (before, after) in changed.items():
        file = path / f"{name}.txt"
        text = file.read_text()
        assert f"\n{before}" in text
        file.write_text(text.replace(f"\n{before}", f"\n{after}", 1))
    return path


def warned(capsys: pytest.CaptureFixture[str], *arguments: str | Path) -> list[str]:
    status, _, err = run(capsys, "retrieve", "ice", *arguments)
    assert status == 0
    return [line.removeprefix("foon-asp: warning: ") for line in err.splitlines() if "does not know" in line]


MISSPELT = [
    "rates: motions that the FOON does not know: puor (closest: pour)",
    "utensils: labels that the FOON does not know: bowll (closest: bowl)",
]


def test_misspelt_words_are_told_with_the_closest(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    """Of files that the command names; those of a folder are for the audit."""
    data = folder(tmp_path, motion=("pour\t", "puor\t"), utensils=("bowl\n", "bowll\n"))
    diet = tmp_path / "lean.diet"
    diet.write_text("buttter\nqqqqqqqq\n")
    rates, utensils = tmp_path / "motion.txt", tmp_path / "utensils.txt"
    named = ("--data", data, "--diet", diet, "--rates", rates, "--utensils", utensils)
    lean = f"{diet}: labels that the FOON does not know: buttter (closest: butter)"
    assert warned(capsys, *named) == [
        *(line.replace("rates", str(rates)).replace("utensils", str(utensils)) for line in MISSPELT),
        lean,
    ]
    assert warned(capsys, *named, "--quiet") == []
    assert warned(capsys, "--data", data, "--diet", diet) == [lean]


@pytest.mark.parametrize("option", ["--rates", "--costs"])
def test_a_table_in_json_is_looked_at_as_one_of_lines(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, option: str
) -> None:
    for text in ('{"puor": 0.5, "mix": 1, "qqqqqqqq": 0.1}', "puor\t0.5\nmix\t1\nqqqqqqqq\t0.1\n"):
        table = tmp_path / "table"
        table.write_text(text)
        assert warned(capsys, option, table) == [
            f"{table}: motions that the FOON does not know: puor (closest: pour)"
        ]


NOT_KNOWN = "which the FOON does not know"


def unknown(findings: Iterable[Finding]) -> list[tuple[str, str, str]]:
    found = [each for each in findings if each.code.startswith("unknown-")]
    return sorted((Path(each.file).name, each.code, each.message) for each in found)


def test_the_audit_and_python_tell_all_that_the_files_of_a_folder_name(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    data = folder(tmp_path, motion=("pour\t", "puor\t"), utensils=("bowl\n", "bowll\n"))
    for name in ("kitchen.json", "goal_nodes.json"):
        objects = json.loads((data / name).read_text())
        (data / name).write_text(json.dumps([*objects, {"label": "sallt"}]))
    found = [
        ("goal_nodes.json", "unknown-goal", "the goal sallt is no object of this FOON"),
        (
            "kitchen.json",
            "unknown-object",
            "the kitchen has sallt, which the FOON does not know; closest: salt",
        ),
        ("motion.txt", "unknown-word", "the FOON does not know 'puor' (closest: pour)"),
        ("utensils.txt", "unknown-word", "the FOON does not know 'bowll' (closest: bowl)"),
    ]
    world = fa.load(data)
    # What the kitchen has can be wanted.
    assert unknown(world.findings) == found[1:]
    assert world.on_level(2).findings == world.with_kitchen(add=["salt"]).findings == world.findings
    (data / "kitchen.json").write_text((ROOT / "data" / "kitchen.json").read_text())
    told = unknown(fa.load(data).findings)
    assert told[0][:2] == found[0][:2]
    assert told[0][2].startswith(found[0][2])
    report = run_json(capsys, "audit", "--data", data)["findings"]
    assert {each["code"] for each in report} >= {"unknown-goal", "unknown-word"}
    _, out, _ = run(capsys, "goals", "--data", data)
    assert out.splitlines()[-1].startswith("sallt  (no object of this FOON")
    _, _, err = run(capsys, "suggest", "--data", data, "-n", "1")
    assert "warning: the goal sallt is no object of this FOON" in err


def test_python_is_warned_of_what_is_lost() -> None:
    text = (ROOT / "data" / "FOON.txt").read_text()
    assert "\nM\t" in text
    with pytest.warns(fa.FoonWarning, match=r"<text>:\d+: ") as told:
        foon = fa.read(text.replace("\nM\t", "\nN\t", 1))
    assert len(foon.units) == len(fa.load().foon.units) - 1
    assert [each.filename for each in told] == [__file__]


def test_what_is_near_to_nothing_is_no_fault(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "rates.txt").write_text((ROOT / "data" / "motion.txt").read_text() + "xylograph\t0.5\n")
    assert warned(capsys, "--rates", tmp_path / "rates.txt") == []
    assert warned(capsys) == []


def test_the_built_in_words_beside_another_foon_are_no_fault(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """Of crack and crank, which the built-in rates both have, this FOON has one."""
    foon = tmp_path / "x.txt"
    foon.write_text("O\tice\nS\twhole\nM\tcrack\nO\tice\nS\tcracked\n//\n")
    (tmp_path / "k.json").write_text('[{"label": "ice", "states": ["whole"]}]')
    files = ("--foon", foon, "--kitchen", tmp_path / "k.json")
    _, _, err = run(capsys, "retrieve", "ice [cracked]", *files)
    assert "does not know" not in err
    (tmp_path / "rates.txt").write_text("crank\t0.5\ncrack\t0.5\n")
    _, _, err = run(capsys, "retrieve", "ice [cracked]", *files, "--rates", tmp_path / "rates.txt")
    assert "rates.txt: motions that the FOON does not know: crank (closest: crack)" in err


ODD = ("\x1b[31m", "\x9b", "\u202e", "\u2067", "\u200f", "\x07")


@pytest.mark.parametrize("odd", ODD)
def test_no_label_tells_a_terminal_what_to_do(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, odd: str
) -> None:
    """Whatever the files, the goal or their names hold; nor is it in what is exported."""
    foon = tmp_path / "x.txt"
    foon.write_text(f"# Source:\t{odd}v\nO\tegg{odd}\nS\traw{odd}\nM\tcrack{odd}\nO\tegg\nS\tcracked\n//\n")
    odd_label = "egg" + odd.encode("unicode_escape").decode().replace("\\x", "\\u00")
    odd_state = "raw" + odd.encode("unicode_escape").decode().replace("\\x", "\\u00")
    kitchen = tmp_path / "k.json"
    kitchen.write_text(f'[{{"label": "{odd_label}", "states": ["{odd_state}"]}}]')
    files = ("--foon", foon, "--kitchen", kitchen, "--default-rate", "1")
    out_files = tmp_path / "export"
    for command in (
        ("retrieve", "egg [cracked]"),
        ("retrieve", f"egg{odd} [cracked]"),
        ("plan", "egg [cracked]"),
        ("explain", f"milk{odd}"),
        ("audit",),
        ("pddl", "export", "egg [cracked]", "-o", out_files),
        ("retrieve", "egg", "--rates", tmp_path / f"no{odd}"),
    ):
        _, out, err = run(capsys, *command, *files)
        assert odd[0] not in out + err, command
    for path in out_files.iterdir():
        assert odd[0] not in path.read_text(), path
