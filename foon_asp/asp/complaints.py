"""From what clingo complains of to a line of the user's own rules."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from foon_asp.asp.rules import Rules

_BEHIND_ENCODINGS = 10_000
"""clingo counts the lines of each text from 1; no encoding is as long as that."""

_PLACE = re.compile(r"<block>:(\d+):(\d+)(?:-[\d:]+)?: ")
_UNSAFE = re.compile(r"<block>:(\d+):(\d+)(?:-[\d:]+)?: note: '(\w+)' is unsafe")


@dataclass(frozen=True, slots=True)
class RulesProgram:
    """Facts, and rules of the user's own behind them; `text` is both.

    `starts` is the line before the first of each rule file.
    """

    text: str
    rules: tuple[Rules, ...]
    starts: tuple[int, ...]

    @classmethod
    def of(cls, facts: str, rules: Sequence[Rules]) -> RulesProgram:
        """Put rules behind facts, so that a line tells where it is from."""
        line = max(_BEHIND_ENCODINGS, facts.count("\n"))
        parts, starts = [facts, "\n" * (line - facts.count("\n"))], []
        for each in rules:
            starts.append(line)
            parts.append(each.text + "\n")
            line += each.text.count("\n") + 1
        return cls("".join(parts), tuple(rules), tuple(starts))

    def complaint(self, messages: str) -> str:
        """Return what clingo complains of first in one line, with the place in the user's rules."""
        complaints = messages.split(" / ")
        complaint = next((each for each in complaints if ": error: " in each), complaints[0])
        if unsafe := _UNSAFE.search(complaint):
            # clingo would quote the rule as it has rewritten it.
            line, column, variable = unsafe.groups()
            why = "no positive literal of the body says what it can be"
            return f"{self._place(line, column)}: the variable {variable} is unsafe; {why}"
        if "(Factor*Value)" in complaint:
            return f"{self.rules[0].path}: a Value of penalty/3 or a Factor of factor/2 is not an integer"
        place = _PLACE.search(complaint)
        text = re.sub(r"\S+:\d+:\d+(?:-[\d:]+)?: (?:error|info|note): ", "", " ".join(complaint.split()))
        where = self._place(place[1], place[2]) if place else self.rules[0].path
        if ":" not in where and "tuple ignored" in complaint:
            return f"{where}: a Priority of criterion/2 is not an integer"
        return f"{where}: {text}" if ":" in where else f"{where}: the rules do not work: {text}"

    def _place(self, line: str, column: str) -> str:
        """Return the place of a line of the text, or only the file if it is not one of the user's."""
        for rules, start in zip(reversed(self.rules), reversed(self.starts), strict=True):
            if int(line) > start:
                return f"{rules.path}:{int(line) - start}:{column}"
        return self.rules[0].path
