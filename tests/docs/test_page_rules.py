"""What holds of every page: nothing escapes the tests, and what a page names is there."""

from __future__ import annotations

import contextlib
import doctest
import io
import re
from pathlib import Path

import pytest

import foon_asp
from foon_asp.cli.main import main
from support.pages import LEFT_OUT, PAGES, Page, agrees, comparable, page_name
from support.paths import ROOT

NOT_RUN = {
    "README.md": ["the Makefile sets up an environment of its own", "installs"],
    "docs/batch.md": ["takes several machines"],
    "docs/commands.md": ["a pattern, not a command"],
    "docs/design.md": ["a picture"],
    "docs/format.md": ["a grammar"],
    "docs/fuzzing.md": ["takes ten minutes and a fuzzer"],
    "docs/pddl.md": ["PDDL, which tests look up in an export"] * 5,
    "docs/planning.md": ["takes ten minutes and other planners"],
    "docs/reliability.md": ["takes five minutes"],
    "docs/robots.md": ["PDDL, which tests look up in an export"],
    "docs/scale.md": ["takes Spark"],
    "docs/scheduling.md": ["takes ten minutes and the public data"],
    "benchmarks/README.md": ["takes forty minutes", "takes a minute and the public data"],
}
"""The blocks that are not run, and why."""


def text_of(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def prose(path: Path) -> str:
    """Return a page without its blocks."""
    return re.sub(r"^```.*?^```$", "", text_of(path), flags=re.MULTILINE | re.DOTALL)


def test_every_block_that_is_not_run_says_why() -> None:
    found = {page_name(path): [block.not_run for block in Page(path).blocks] for path in PAGES}
    said = {name: [why for why in reasons if why is not None] for name, reasons in found.items()}
    assert {name: reasons for name, reasons in said.items() if reasons} == NOT_RUN


@pytest.mark.parametrize("path", PAGES, ids=page_name)
def test_code_stands_in_blocks_that_are_run(path: Path) -> None:
    """No code that is only indented, or fenced in another way: nothing would run it."""
    assert not re.findall(r"^\n(?: {4}|\t).*|^~~~.*", prose(path), re.MULTILINE)


@pytest.mark.parametrize("path", PAGES, ids=page_name)
def test_no_merge_is_left_half_done(path: Path) -> None:
    assert not re.findall(r"^(?:<<<<<<<|=======|>>>>>>>).*", text_of(path), re.MULTILINE)


@pytest.mark.parametrize("path", PAGES, ids=page_name)
def test_files_of_the_page_are_used(path: Path) -> None:
    blocks = Page(path).blocks
    names = [block.file for block in blocks if block.file]
    assert len(names) == len(set(names))
    others = "".join(block.text for block in blocks if not block.file)
    assert [name for name in names if name not in others] == []


def anchors(path: Path) -> set[str]:
    """Return what links may point to: the headings, as code hosts write them."""
    heads = re.findall(r"^#+ (.*)$", prose(path), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", head.lower()).replace(" ", "-") for head in heads}


@pytest.mark.parametrize("path", PAGES, ids=page_name)
def test_links_lead_somewhere(path: Path) -> None:
    for target in re.findall(r"\]\(([^)\s]+)\)", prose(path)):
        if target.startswith("https://"):
            continue
        name, _, anchor = target.partition("#")
        there = (path.parent / name).resolve() if name else path
        assert there.exists(), target
        assert not anchor or anchor in anchors(there), target


NOT_THERE = {"FOON_graph_analyser.py", "encodings/__init__.py"}
"""Files that pages speak of though they are not there: one of another program, and one that must not be."""


@pytest.mark.parametrize("path", PAGES, ids=page_name)
def test_modules_and_encodings_that_are_named_are_there(path: Path) -> None:
    folders = ("foon_asp", "encodings", "tests", "benchmarks")
    there = {each.as_posix() for name in folders for each in (ROOT / name).rglob("*.*")}
    there |= {block.file for block in Page(path).blocks if block.file}
    named = re.findall(r"`([\w/.-]+\.(?:py|lp))`", prose(path))
    ends = {"/".join(each.split("/")[-parts:]) for each in there for parts in range(1, 6)}
    assert {name for name in named if name not in ends} <= NOT_THERE


def help_of(*command: str) -> str:

    out = io.StringIO()
    with contextlib.redirect_stdout(out), pytest.raises(SystemExit):
        main([*command, "--help"])
    return out.getvalue()


def test_the_pages_name_every_command_and_every_flag() -> None:
    overview, details = text_of(ROOT / "README.md"), text_of(ROOT / "docs" / "commands.md")
    details += text_of(ROOT / "docs" / "batch.md")
    commands = re.findall(r"^ {4}(\w+)(?: .*)?$", help_of(), re.MULTILINE)
    assert len(commands) >= 18
    for name in commands:
        assert f"foon-asp {name}" in overview, name
        for flag in set(re.findall(r"(?<![\w-])--[a-z][a-z-]*", help_of(name))) - {"--help"}:
            assert re.search(rf"{flag}(?![\w-])", details), f"{name} {flag}"


def test_the_page_names_everything_public() -> None:
    page = text_of(ROOT / "docs" / "python.md")
    world = [name for name in dir(foon_asp.World) if not name.startswith("_")]
    assert [name for name in (*foon_asp.__all__, *world) if not re.search(rf"\b{name}\b", page)] == []


def test_the_example_of_the_package_is_right() -> None:
    assert doctest.testmod(foon_asp) == (0, 4)


def test_readme_is_short() -> None:
    assert len(text_of(ROOT / "README.md").splitlines()) <= 200


# --- The tests of the pages can fail ---------------------------------------------------------------


def test_the_comparison_can_fail() -> None:
    assert agrees(["a", LEFT_OUT, "c"], ["a", "b", "b", "c"])
    assert agrees(["a", LEFT_OUT], ["a"])
    assert agrees([f"5 queries; {LEFT_OUT} queries/s"], ["5 queries; 7.3 queries/s"])
    assert not agrees([f"5 queries; {LEFT_OUT} queries/s"], ["4 queries; 7.3 queries/s"])
    assert not agrees(["a", "c"], ["a", "b", "c"])
    assert not agrees(["a", LEFT_OUT, "c"], ["a", "b", "c", "d"])
    assert not agrees([], ["a"])
    assert not agrees([LEFT_OUT, "c"], [])
    assert comparable("Rules        : 4980") == comparable("Rules   : 12") != comparable("Atoms   : 12")
    assert comparable("Optimization : 3 4") != comparable("Optimization : 3 5")
    assert comparable("5 steps, 5 rounds") != comparable("6 steps, 5 rounds")


GOOD = """\
```python
>>> x = 1
>>> x + 1
2
```

```prolog
% own.lp: units
many(U) :- unit(U).
```

```console
$ foon-asp goals | head -1
whipped cream [creamy, whipped] in [mixing bowl]
$ foon-asp retrieve nothing
foon-asp: error: …
$ echo $?
2
$ cat own.lp | head -1
% own.lp: units
```

```sh
foon-asp goals
foon-asp retrieve GOAL --by success      # a comment
```

<!-- not run: it would fail -->
```python
x = 1 / 0
```
"""
BAD = {
    "another output of Python": ("1\n2\n", "1\n3\n"),
    "an error of Python": ("x = 1\n", "x = y\n"),
    "output without prompts": (">>> x = 1\n>>> x + 1\n2\n", "print(1)\n"),
    "another output of a command": ("whipped cream", "whiped cream"),
    "another exit status": ("$?\n2", "$?\n0"),
    "a flag that went": ("GOAL --by", "GOAL --buy"),
    "a command that fails": ("foon-asp goals\nfoon", "foon-asp goals --data nowhere\nfoon"),
    "a rule that no encoding has": ("% own.lp: units\nmany", "many"),
    "a language that nothing runs": ("```sh", "```zsh"),
    "no language": ("```sh", "```"),
    "no reason": ("<!-- not run: it would fail -->\n", ""),
}


def run(text: str, folder: Path) -> list[str]:
    path = folder / "page.md"
    path.write_text(text, encoding="utf-8")
    return Page(path).run(folder)


def test_a_page_that_is_right_passes(tmp_path: Path) -> None:
    assert run(GOOD, tmp_path) == []


@pytest.mark.parametrize("fault", BAD)
def test_a_page_that_is_wrong_fails(fault: str, tmp_path: Path) -> None:
    old, new = BAD[fault]
    assert GOOD.count(old) == 1
    # A rule file that is none any more is missed by the command that shows it, too.
    assert 1 <= len(run(GOOD.replace(old, new), tmp_path)) <= 2


def test_what_came_out_can_be_written_into_the_page(tmp_path: Path) -> None:
    wrong = GOOD.replace("1\n2\n", "1\n3\n").replace("whipped cream", "whiped cream")
    (tmp_path / "page.md").write_text(wrong, encoding="utf-8")
    page = Page(tmp_path / "page.md")
    assert len(page.run(tmp_path)) == 2
    assert page.corrected() == GOOD
