"""Opening FOON files of every kind: the format is told by what stands in the file, not by its name."""

from __future__ import annotations

import codecs
import re
from dataclasses import dataclass
from pathlib import Path

from foon_asp.errors import InputError
from foon_asp.files import read_bytes
from foon_asp.findings import Finding, Severity
from foon_asp.foon_json import JSON_ADVICE, JsonReader
from foon_asp.graph import Foon, FoonBuilder
from foon_asp.oddities import USUAL, oddity
from foon_asp.text import TextReader

_WIDE = (
    # The marks of UTF-16 are the beginning of those of UTF-32.
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
_LINE = re.compile(rb"[^\r\n]*(?:\r\n|\r|\n|\Z)")
_JSON = re.compile(r"[\s\x00-\x1f\x7f-\x9f\ufeff]*[\[{]")
_PICKLE_SUFFIXES = frozenset({".pkl", ".pickle"})
_NEWEST_PICKLE = 5
_TEXT_ADVICE = "a unit is O and S lines, an M line, O and S lines, and '//'"


@dataclass(frozen=True, slots=True)
class FoonFiles:
    """What some files hold: the FOON, what is odd in them, and how many units became of it.

    `units_read` counts duplicates, too; `units_reported` are left out of the FOON, each with a finding.
    Both together are all the units in the files.
    """

    foon: Foon
    findings: tuple[Finding, ...]
    units_read: int
    units_reported: int


class FoonReader:
    """Reads FOON files, one after the other, into one FOON."""

    def __init__(self, *, strict: bool = False) -> None:
        self._strict = strict
        self._builder = FoonBuilder()
        self._text = TextReader(self._builder)
        self._json = JsonReader(self._builder)
        self._findings: list[Finding] = []

    @property
    def units_reported(self) -> int:
        return self._text.reported_units + self._json.reported_units

    def read(self, path: Path) -> None:
        """Read a file. Raises `InputError` if it cannot be read, is no FOON, or is odd and must not be."""
        self.read_data(read_bytes(path), path)

    def read_data(self, data: bytes, path: Path) -> None:
        """Read what a file holds; the path only says how to name it."""
        _refuse_pickle(data, path)
        read, reported = self._builder.read, self.units_reported
        text, findings = decode(data, str(path))
        reader = self._json if is_json(text) else self._text
        reader.findings.clear()
        reader.read(text, str(path))
        findings += reader.findings
        if self._builder.read == read and (reader is self._json or self.units_reported == reported):
            _refuse_unreadable(findings, path, JSON_ADVICE if reader is self._json else _TEXT_ADVICE)
        if self._strict:
            _refuse_odd(findings, path)
        self._findings += findings

    def finish(self) -> FoonFiles:
        """Return what was read from all files."""
        return FoonFiles(
            self._builder.build(), tuple(self._findings), self._builder.read, self.units_reported
        )


def decode(data: bytes, file: str) -> tuple[str, list[Finding]]:
    """Return the text of a file, UTF-8 unless it says otherwise; lines that are not are read as cp1252.

    Line ends and a byte order mark stay in the text.
    """
    for mark, name in _WIDE:
        if data.startswith(mark):
            message = f"the file is {name.upper()}, not UTF-8"
            text = data[len(mark) :].decode(name, "replace")
            return text, [oddity("other-encoding", file, 1, message)]
    try:
        return data.decode("utf-8"), []
    except UnicodeDecodeError:
        return _decode_lines(data, file)


def _decode_lines(data: bytes, file: str) -> tuple[str, list[Finding]]:
    lines: list[str] = []
    findings: list[Finding] = []
    for number, match in enumerate(_LINE.finditer(data), 1):
        try:
            lines.append(match[0].decode("utf-8"))
        except UnicodeDecodeError as error:
            byte = match[0][error.start]
            message = f"byte 0x{byte:02x} is not UTF-8; the line is read as Windows-1252"
            findings.append(oddity("not-utf8", file, number, message))
            lines.append(match[0].decode("cp1252", "replace"))
    return "".join(lines), findings


def is_json(text: str) -> bool:
    """Tell whether a text is meant as JSON: no line of FOON text begins with a bracket."""
    return _JSON.match(text) is not None


def _refuse_pickle(data: bytes, path: Path) -> None:
    by_content = len(data) > 1 and data[0] == 0x80 and data[1] <= _NEWEST_PICKLE
    if by_content or path.suffix.lower() in _PICKLE_SUFFIXES:
        raise InputError(
            path,
            None,
            "a pickle, which can run any code when it is loaded, so it never is",
            "save the FOON as text or JSON where the pickle was made",
        )


def _refuse_unreadable(findings: list[Finding], path: Path, advice: str) -> None:
    for finding in findings:
        if finding.severity is Severity.ERROR:
            raise InputError(path, finding.line, f"not a FOON file: {finding.message}", advice)


def _refuse_odd(findings: list[Finding], path: Path) -> None:
    odd = [finding for finding in findings if finding.code not in USUAL]
    if odd:
        first = min(odd, key=lambda finding: finding.line)
        raise InputError(path, first.line, f"{first.message} [{first.code}]", first.mend)
