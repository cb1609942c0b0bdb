"""Run a page of the documentation: every block of it does what the page shows.

Pages are parsed by sybil. What a fenced block is, its language says:

- `python`: run in one namespace a page. With prompts (`>>>`) the output must be what is shown; without, there
  must be none.
- `console`: lines `$ COMMAND` with what they print, standard error too. `echo $?` is the exit status.
- `sh`: commands alone. Each must end well; one that names a GOAL, a FILE or a HOST is only parsed.
- `prolog`: a rule file if it begins with `% name.lp:`, and then written for the rest of the page; else it
  must stand, word for word, in some encoding.
- `json`: must be JSON, as one value or one a line.

In what is shown, `…` stands for what is left out: any lines if it is alone on its line, else any text.
Figures that clingo counts are not compared, because each version of it counts in another way.

A comment right above a block says more of it: `<!-- file: NAME -->` writes it to a file for the rest of the
page, `<!-- not run: REASON -->` leaves it alone, `<!-- public data -->` says that it needs the public data,
which is plain where a block names their folder. Those that need it are run apart from the others, with the
files of the page and the blocks that only import. Blocks run in a folder that looks like the checkout.
"""

from __future__ import annotations

import difflib
import io
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import dataclass, field
from doctest import ELLIPSIS
from functools import partial
from pathlib import Path

from sybil import Document, Example, Region
from sybil.evaluators.doctest import DocTestEvaluator
from sybil.evaluators.python import PythonEvaluator
from sybil.parsers.abstract.doctest import DocTestStringParser
from sybil.parsers.markdown.lexers import RawFencedCodeBlockLexer

from foon_asp.cli import main as cli
from support.paths import ROOT

PAGES = [
    ROOT / "README.md",
    *sorted((ROOT / "docs").glob("*.md")),
    ROOT / "CHANGELOG.md",
    *(ROOT / folder / "README.md" for folder in ("benchmarks", "encodings")),
]

LEFT_OUT = "…"
_PLACEHOLDER = re.compile(r"\b(GOAL|FILE|DIR|HOST|PLAN|LABEL)\b")
_MARK = re.compile(r"<!-- (file|not run|public data)(?:: (.+?))? -->\n")
_MARKS_ABOVE = re.compile(r"((?:<!-- [^\n]* -->\n)*)\Z")
_COMMAND = re.compile(r"^\$ (.*)\n((?:(?!\$ ).*\n)*)", re.MULTILINE)
_BEFORE_PIPE = re.compile(r"""((?:[^"'|<>;&]|"[^"]*"|'[^']*')*)(.*)""")


@dataclass(frozen=True, slots=True)
class Block:
    """A fenced block of a page, and what the comments right above say of it."""

    line: int
    language: str
    text: str
    file: str | None = None
    not_run: str | None = None
    public: bool = False

    @classmethod
    def of(cls, region: Region, document: Document) -> Block:
        above = _MARKS_ABOVE.search(document.text[: region.start])
        marks: dict[str, str] = dict(_MARK.findall(above[1])) if above else {}
        language, text = str(region.lexemes["language"]).strip(), str(region.lexemes["source"])
        named = re.match(r"% ([\w.]+\.lp): ", text) if language == "prolog" else None
        return cls(
            document.text.count("\n", 0, region.start) + 1,
            language,
            text,
            named[1] if named else marks.get("file"),
            marks.get("not run"),
            "public data" in marks or "../shared/foon" in text,
        )

    @property
    def always(self) -> bool:
        """Whether both runs of a page need it, with the public data and without."""
        imports = re.fullmatch(r"((>>> )?(import|from) .*\n|\n)+", self.text)
        return self.file is not None or (self.language == "python" and imports is not None)


@dataclass(slots=True)
class Page:
    """A page as it is run: its blocks, and what came out otherwise than shown."""

    path: Path
    document: Document = field(init=False)
    blocks: list[Block] = field(default_factory=list)
    status: int = 0
    corrections: list[tuple[int, int, str]] = field(default_factory=list)
    failures: list[str] = field(default_factory=list)
    commands: int = 0
    prompts: int = 0

    def __post_init__(self) -> None:
        self.document = Document.parse(str(self.path), self._regions)

    def _regions(self, document: Document) -> Iterator[Region]:
        lexer = RawFencedCodeBlockLexer(re.compile(r"(?P<language>[^\n]*)\n"))
        for region in lexer(document):
            block = Block.of(region, document)
            self.blocks.append(block)
            region.parsed = block.text if block.language == "python" and not block.file else block
            when = "always" if block.always else "public" if block.public else "own"
            region.lexemes = {**region.lexemes, "when": when}
            if block.not_run is not None:
                continue
            if block.language == "python" and not block.file and block.text.startswith(">>>"):
                for prompt in DocTestStringParser(_Prompts(self))(region.lexemes["source"], document.path):
                    prompt.adjust(region, region.lexemes["source"])
                    prompt.end += region.lexemes["source"].offset
                    prompt.lexemes = region.lexemes
                    yield prompt
                continue
            if block.language == "python" and not block.file:
                region.parsed = region.lexemes["source"]
            region.evaluator = partial(_EVALUATORS.get(block.language, _unknown), self)
            if block.file:
                region.evaluator = partial(_write, self)
            yield region

    def run(self, folder: Path, *, public: Path | None = None) -> list[str]:
        """Run the blocks that need the public data, where their folder is given, or else all the others.

        Works in a folder like the checkout. Returns what did not go as shown.
        """
        now = "own" if public is None else "public"
        with _checkout(folder, public):
            for example in self.document.examples():
                if example.region.lexemes["when"] not in (now, "always"):
                    continue
                try:
                    example.evaluate()
                except (Exception, SystemExit) as error:
                    said = getattr(error, "result", None) or f"{type(error).__name__}: {error}"
                    self.failures.append(f"{page_name(self.path)}:{example.line}: {said}")
        return self.failures

    def corrected(self) -> str:
        """Return the page with everything shown as it came out."""
        text = self.document.text
        for start, end, new in sorted(self.corrections, reverse=True):
            text = text[:start] + new + text[end:]
        return text


@contextmanager
def _checkout(folder: Path, public: Path | None) -> Iterator[None]:
    """Work in a folder that has what pages name: data, encodings, pages, and the public data beside it."""
    top, before = folder / "checkout", Path.cwd()
    top.mkdir()
    shutil.copytree(ROOT / "data", top / "data")
    for name in ("encodings", "docs", "benchmarks"):
        (top / name).symlink_to(ROOT / name)
    if public is not None:
        (folder / "shared").mkdir()
        (folder / "shared" / "foon").symlink_to(public.resolve())
    os.chdir(top)
    try:
        yield
    finally:
        os.chdir(before)


def page_name(path: Path) -> str:
    return path.relative_to(ROOT).as_posix() if path.is_relative_to(ROOT) else path.name


def asked(page: Page) -> list[str]:
    """Return the commands of a page: those of its blocks that are run."""
    run = [block for block in page.blocks if block.not_run is None]
    commands = [line for block in run if block.language == "sh" for line in block.text.splitlines() if line]
    for block in run:
        if block.language == "console":
            commands += [command for command, _ in _COMMAND.findall(block.text)]
    return commands


# --- What is shown, and what came out --------------------------------------------------------------


def agrees(wanted: Sequence[str], lines: Sequence[str]) -> bool:
    """Say whether lines are those that are shown, of which some may be left out."""
    if not wanted:
        return not lines
    if wanted[0] == LEFT_OUT:
        return any(agrees(wanted[1:], lines[skipped:]) for skipped in range(len(lines) + 1))
    return bool(lines) and _same(wanted[0], lines[0]) and agrees(wanted[1:], lines[1:])


def _same(wanted: str, line: str) -> bool:
    if wanted == line:
        return True
    pattern = ".*".join(re.escape(part) for part in wanted.split(LEFT_OUT))
    return LEFT_OUT in wanted and re.fullmatch(pattern, line) is not None


def comparable(line: str) -> str:
    """Return a line without what another version of clingo may count in another way."""
    if re.match(r"\s*[A-Z][\w -]*\w\s* : ", line) and not line.startswith(("Optimization", "Models")):
        return re.sub(r"[\d.]+", "N", re.sub(r"\s+", " ", line))
    return line


def _difference(wanted: Iterable[str], lines: Iterable[str]) -> str:
    return "\n".join(difflib.unified_diff([*wanted], [*lines], "shown", "printed", lineterm="", n=1))


# --- Commands --------------------------------------------------------------------------------------


def _console(page: Page, example: Example) -> str | None:
    text, failures, corrected = example.parsed.text, [], ""
    for command, shown in _COMMAND.findall(text):
        page.commands += 1
        printed = _printed(page, command)
        wanted, lines = ([line.rstrip() for line in each.splitlines()] for each in (shown, printed))
        counted = comparable if "clingo" in command else str
        if agrees([*map(counted, wanted)], [*map(counted, lines)]):
            corrected += f"$ {command}\n{shown}"
            continue
        failures.append(f"$ {command}\n{_difference(wanted, lines)}")
        corrected += f"$ {command}\n" + "".join(f"{line}\n" for line in lines)
    if not text.startswith("$ "):
        failures.append("a console block begins with a command: $ …")
    if failures:
        start = page.document.text.index(text, example.start)
        page.corrections.append((start, start + len(text), corrected))
    return "\n".join(failures) or None


def _printed(page: Page, line: str) -> str:
    """Return what a command prints, standard error first where a pipe takes the rest."""
    if line == "echo $?":
        return f"{page.status}\n"
    found = _BEFORE_PIPE.fullmatch(line)
    assert found, line
    command, rest = found.groups()
    words = shlex.split(command, comments=True)
    if words[0] != "foon-asp":
        return _shell(line)
    out, err = io.StringIO(), io.StringIO()
    with redirect_stdout(out), redirect_stderr(err if rest else out):
        try:
            page.status = cli.main(_expanded(words[1:]))
        except SystemExit as stop:
            page.status = int(stop.code or 0)
    return err.getvalue() + _shell(f"cat {rest}", out.getvalue()) if rest else out.getvalue()


def _expanded(words: Iterable[str]) -> list[str]:
    """Put the names of files where a word is a pattern that some fit."""
    found = []
    for word in words:
        folder, _, pattern = word.rpartition("/")
        names = Path(folder).glob(pattern) if "*" in pattern else ()
        found += sorted(map(str, names)) or [word]
    return found


def _shell(line: str, given: str = "") -> str:
    folders = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    done = subprocess.run(
        ["sh", "-c", line],
        input=given,
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
        env={**os.environ, "PATH": folders},
    )
    # The statuses of clingo: 10 models, 20 none, 30 an optimum.
    assert done.returncode in (0, 1, 10, 20, 30), done.stderr
    return done.stderr + done.stdout


def _usage(page: Page, example: Example) -> str | None:
    failures = []
    for line in example.parsed.text.splitlines():
        words = shlex.split(line, comments=True)
        if not words:
            continue
        page.commands += 1
        if words[0] == "foon-asp" and any(map(_PLACEHOLDER.search, words)):
            cli._parser().parse_args(words[1:])
            continue
        page.status = 0
        printed = _printed(page, line)
        if page.status != 0:
            failures.append(f"$ {line}\nexit status {page.status}: {printed}")
    return "\n".join(failures) or None


# --- The other languages ---------------------------------------------------------------------------


class _Prompts(DocTestEvaluator):
    """Python with prompts; `…` stands for what is left out."""

    def __init__(self, page: Page) -> None:
        super().__init__(ELLIPSIS)
        self._page = page

    def __call__(self, example: Example) -> str:
        self._page.prompts += 1
        prompt = example.parsed
        shown = prompt.want
        prompt.want = shown.replace(LEFT_OUT, "...")
        said = super().__call__(example)
        if said:
            text = self._page.document.text
            got = re.search(r"^Got(?: nothing|:\n((?:.|\n)*))\s*\Z", said, re.MULTILINE)
            start = example.end - len(shown)
            if got and text[start : example.end] == shown:
                printed = re.sub(r"^    ", "", got[1] or "", flags=re.MULTILINE).rstrip("\n")
                self._page.corrections.append((start, example.end, f"{printed}\n" if printed else ""))
            return f">>> {prompt.source}{said}"
        return ""


def _python(page: Page, example: Example) -> str | None:
    page.prompts += 1
    out = io.StringIO()
    with redirect_stdout(out):
        PythonEvaluator()(example)
    return f"prints, and has no prompts: {out.getvalue()}" if out.getvalue() else None


def _write(_: Page, example: Example) -> None:
    block = example.parsed
    assert block.file is not None
    if block.language == "json":
        _json(_, example)
    Path(block.file).write_text(block.text, encoding="utf-8")


def _prolog(_: Page, example: Example) -> str | None:
    def plain(text: str) -> str:
        return " ".join(text.split())

    encodings = [path.read_text(encoding="utf-8") for path in (ROOT / "encodings").rglob("*.lp")]
    rules = plain(example.parsed.text)
    return None if any(rules in plain(each) for each in encodings) else "no encoding says this"


def _json(_: Page, example: Example) -> None:
    text = example.parsed.text
    try:
        json.loads(text)
    except ValueError:
        for line in text.splitlines():
            json.loads(line)


def _unknown(_: Page, example: Example) -> str:
    return (
        f"nothing is known of blocks of {example.parsed.language or 'no language'!r}; say why it is not run"
    )


_EVALUATORS = {
    "console": _console,
    "sh": _usage,
    "python": _python,
    "prolog": _prolog,
    "json": _json,
}
