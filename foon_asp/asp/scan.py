"""What must be told of a rule text before clingo is given it: clingo's parser reads files, and can die."""

from __future__ import annotations

import re
from collections.abc import Container
from pathlib import Path

from foon_asp.errors import InputError

_TOKEN = re.compile(
    r"""(?P<text>"(?:[^"\\\n]|\\["\\n])*")
    |(?P<block>%\*)
    |(?P<comment>%[^\n]*)
    |(?P<word>\#?_*[A-Za-z][A-Za-z0-9_']*)
    |(?P<number>0x[0-9A-Fa-f]+|0o[0-7]+|0b[01]+|[0-9]+)
    |(?P<open>[(\[{])
    |(?P<close>[)\]}])
    |(?P<end>[,;:.])
    |(?P<operator>[-+*/\\^&?~|@])
    |(?P<other>[ \t\n]+|_+|[!#-^`-~])""",
    re.VERBOSE,
)
_IN_BLOCK = re.compile(r"(?P<block>%\*)|(?P<end>\*%)|%[^\n]*|[^%*]+|\*")
"""Block comments nest, and a line comment in one hides the end of it."""

_TERM = r'(?:-?[0-9]+|"(?:[^"\\\n]|\\["\\n])*"|(?!not\b)[a-z][A-Za-z0-9_]*)'
_ARGUMENT = re.compile(_TERM)
_FACT = re.compile(rf"(?P<name>(?!not\b)[a-z][A-Za-z0-9_]*)\((?P<arguments>{_TERM}(?:,{_TERM})*)\)\.[ \t]*")
"""A fact that fills a line."""

_RUNS_CODE = re.compile(r"#(include|script)")

_DEEPEST = 64
"""How many brackets and operators may stand in one another: clingo dies of some tens of thousands."""

_LARGEST = 2**31 - 1
"""The largest integer of clingo, which takes larger ones for others."""


def scanned(text: str, path: str | Path) -> str:
    """Return the text of rules as clingo may be given it: with plain line ends, and no word that runs code.

    What stands in comments is no code, and yet taken out of clingo's sight. Raises `InputError` with the line
    for `#include`, `#script`, characters that are no part of the language, integers that clingo cannot hold,
    and terms that are nested too deeply for its parser.
    """
    text = text.replace("\r\n", "\n")
    _check_characters(text, path)
    scan = _Scan(text, path)
    scan.run()
    return _RUNS_CODE.sub(r"_\1", text)


def _check_characters(text: str, path: str | Path) -> None:
    """Raise `InputError` for what clingo's strings cannot hold, and for line ends that it takes for none."""
    found = re.search("[\0\r\ud800-\udfff]", text)
    if found is None:
        return
    line = text.count("\n", 0, found.start()) + 1
    if found[0] == "\r":
        raise InputError(path, line, "a carriage return without a newline", "save the file with plain lines")
    raise InputError(path, line, f"the character {found[0]!a} cannot be in rules", "delete it")


def without_repeated_facts(text: str, looked_at: Container[str]) -> str:
    """Return a text in which a table of facts has its first row only, and all other lines where they were.

    clingo's parser takes a second for some thousands of facts, and the first of them says all but the values.
    A line is left out if the line above it is a fact, too, of the same predicate: then no statement goes on
    in it. Facts of the names that are looked at are kept.
    """
    above = None
    lines = text.split("\n")
    for place, line in enumerate(lines):
        fact = _FACT.fullmatch(line)
        table = (fact["name"], len(_ARGUMENT.findall(fact["arguments"]))) if fact else None
        if table is not None and table == above and table[0] not in looked_at:
            lines[place] = ""
        above = table
    return "\n".join(lines)


class _Scan:
    """One walk over the tokens of a text."""

    def __init__(self, text: str, path: str | Path) -> None:
        self._text = text
        self._path = path
        self._open: list[int] = []
        self._operators = 0

    def run(self) -> None:
        """Raise `InputError` for the first token that clingo must not be given."""
        place = 0
        while place < len(self._text):
            token = _TOKEN.match(self._text, place)
            if token is None:
                self._refuse_character(place)
                return
            place = self._behind_block(token.end()) if token.lastgroup == "block" else token.end()
            self._look_at(token)

    def _look_at(self, token: re.Match[str]) -> None:
        kind, word = token.lastgroup, token[0]
        if kind == "word":
            self._check_word(token)
        elif kind == "text" and _RUNS_CODE.search(word):
            self._refuse(token.start(), f"{word} names what runs other code", "take another text")
        elif kind == "number":
            self._check_number(token)
        elif kind == "open":
            self._open.append(self._operators)
            self._operators = 0
        elif kind == "close":
            self._operators = self._open.pop() if self._open else 0
        elif kind == "end":
            self._operators = 0
        elif kind == "operator":
            self._operators += 1
        # What waits in open brackets is still to be closed, so a term is as deep as all of it together.
        if kind in ("open", "operator") and len(self._open) + sum(self._open) + self._operators > _DEEPEST:
            problem = f"more than {_DEEPEST} brackets and operators in one another"
            self._refuse(token.start(), problem, "say it in several rules")

    def _check_word(self, token: re.Match[str]) -> None:
        if token[0].startswith("#include"):
            self._refuse(token.start(), "#include is not allowed", "give each file on the command line")
        if token[0].startswith("#script"):
            self._refuse(token.start(), "#script runs any code", "leave it out")

    def _check_number(self, token: re.Match[str]) -> None:
        digits = token[0]
        plain = digits.lstrip("0") or "0"
        # Python reads no thousands of decimal digits.
        large = len(plain) > 10 if plain.isdecimal() else int(digits, 0) > _LARGEST
        if large or (plain.isdecimal() and int(plain) > _LARGEST):
            shown = digits if len(digits) <= 20 else digits[:20] + "…"
            self._refuse(token.start(), f"{shown} is too large for clingo", f"at most {_LARGEST}")

    def _behind_block(self, place: int) -> int:
        """Return where the block comment that begins before `place` ends; clingo says if it does not."""
        depth = 1
        while depth and (token := _IN_BLOCK.match(self._text, place)):
            depth += {"block": 1, "end": -1}.get(token.lastgroup or "", 0)
            place = token.end()
        return place

    def _refuse_character(self, place: int) -> None:
        character = self._text[place]
        if character == '"':
            problem = "this text does not end, or has a backslash before something else than \\, n or a quote"
            self._refuse(place, problem, "texts end on their line")
        self._refuse(place, f"the character {character!a} outside of texts and comments", "put it in quotes")

    def _refuse(self, place: int, problem: str, advice: str) -> None:
        line = self._text.count("\n", 0, place) + 1
        raise InputError(self._path, line, problem, advice)
