"""Opening FOON files of every kind: the format is told by what stands in the file, not by its name."""

from __future__ import annotations

import codecs
import gc
import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from foon_asp.errors import InputError
from foon_asp.io.document import JSON_ADVICE, is_json
from foon_asp.io.files import is_store, read_bytes
from foon_asp.io.findings import USUAL, Finding, Severity, oddity
from foon_asp.io.syntax import other_rate
from foon_asp.io.text import TextReader
from foon_asp.io.vocabulary import VocabularyName, vocabulary
from foon_asp.model.foon import Foon, FoonBuilder

if TYPE_CHECKING:
    from foon_asp.io.json import JsonReader


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


_WIDE = (
    # The marks of UTF-16 are the beginning of those of UTF-32.
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)


_LINE = re.compile(rb"[^\r\n]*(?:\r\n|\r|\n|\Z)")


_PICKLE_SUFFIXES = frozenset({".pkl", ".pickle"})


_NEWEST_PICKLE = 5


_TEXT_ADVICE = "a unit is O and S lines, an M line, O and S lines, and '//'"


class FoonReader:
    """Reads FOON files, one after the other, into one FOON."""

    def __init__(
        self,
        *,
        strict: bool = False,
        builder: FoonBuilder | None = None,
        words: VocabularyName = "current",
    ) -> None:
        self._strict = strict
        self._builder = FoonBuilder() if builder is None else builder
        self._text = TextReader(self._builder, vocabulary(words))
        self._json: JsonReader | None = None
        self._findings: list[Finding] = []
        self._reported = 0

    @property
    def part(self) -> int:
        """Which list of units of a JSON file is being read, from 0: each may be a tree of its own."""
        return 0 if self._json is None else self._json.part

    @property
    def units_reported(self) -> int:
        """How many units were left out so far, each with a finding."""
        in_json = 0 if self._json is None else self._json.reported_units
        return self._text.reported_units + in_json + self._reported

    def read(self, path: Path) -> None:
        """Read a file or a store.

        Raises `InputError` if it cannot be read, is no FOON, or is odd and must not be.
        """
        if is_store(path):
            self._include(open_files(path, strict=self._strict))
        else:
            self.read_data(read_bytes(path), path)

    def _include(self, files: FoonFiles) -> None:
        for number, unit in self._builder.include(files.foon):
            message = other_rate(self._builder.rate(number))
            self._findings.append(oddity("other-rate", unit.source.file, unit.source.line, message))
        self._builder.read += files.foon.duplicates
        self._reported += files.units_reported
        self._findings += files.findings

    def read_data(self, data: bytes, path: Path) -> None:
        """Read what a file holds; the path only says how to name it."""
        _refuse_pickle(data, path)
        read, reported = self._builder.read, self.units_reported
        text, findings = decode(data, str(path))
        in_json = is_json(text)
        reader = self._json_reader() if in_json else self._text
        reader.findings.clear()
        with _no_search_for_cycles():
            reader.read(text, str(path))
        findings += reader.findings
        if self._builder.read == read and not _has_units(findings, self.units_reported - reported, in_json):
            _refuse_unreadable(findings, path, JSON_ADVICE if in_json else _TEXT_ADVICE)
        if self._strict:
            _refuse_odd(findings, path)
        self._findings += findings

    def _json_reader(self) -> JsonReader:
        """Return the reader of JSON, which most questions need not import."""
        if self._json is None:
            from foon_asp.io.json import JsonReader

            self._json = JsonReader(self._builder)
        return self._json

    def finish(self) -> FoonFiles:
        """Return what was read from all files."""
        return FoonFiles(
            self._builder.build(), tuple(self._findings), self._builder.read, self.units_reported
        )


def open_files(
    *paths: Path, strict: bool = False, words: VocabularyName = "current", repeats: bool = False
) -> FoonFiles:
    """Read FOON files, text, JSON or stores, and merge them; a store alone is opened as it is.

    With `strict` anything odd is an error. `words` says how words of older text files are read. A unit is
    kept as often as it stands there with `repeats`. Raises `InputError` if one cannot be read as a FOON.
    """
    if len(paths) == 1 and is_store(paths[0]):
        # pyarrow takes a while to load, and most questions are about files.
        from foon_asp.io.store import open_store

        files = open_store(paths[0])
        if strict:
            _refuse_odd(files.findings, paths[0])
        return files
    reader = FoonReader(strict=strict, builder=FoonBuilder(repeats=repeats), words=words)
    for path in paths:
        reader.read(path)
    return reader.finish()


@contextmanager
def _no_search_for_cycles() -> Iterator[None]:
    """Keep Python from looking for cycles: a reader makes millions of objects, and not one cycle."""
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


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


def _refuse_pickle(data: bytes, path: Path) -> None:
    by_content = len(data) > 1 and data[0] == 0x80 and data[1] <= _NEWEST_PICKLE
    if by_content or path.suffix.lower() in _PICKLE_SUFFIXES:
        raise InputError(
            path,
            None,
            "a pickle, which can run any code when it is loaded, so it never is",
            "save the FOON as text or JSON where the pickle was made",
        )


def _has_units(findings: Iterable[Finding], reported: int, in_json: bool) -> bool:
    """Tell whether what was left out of a file were units: then it is a FOON, though there is none in it."""
    if in_json:
        return any(finding.code == "unit-without-inputs" for finding in findings)
    return reported > 0


def _refuse_unreadable(findings: list[Finding], path: Path, advice: str) -> None:
    for finding in findings:
        if finding.severity is Severity.ERROR:
            raise InputError(path, finding.line, f"not a FOON file: {finding.message}", advice)


def _refuse_odd(findings: Iterable[Finding], path: Path) -> None:
    odd = [finding for finding in findings if finding.code not in USUAL]
    if odd:
        first = min(odd, key=lambda finding: finding.line)
        raise InputError(path, first.line, f"{first.message} [{first.code}]", first.mend)
