"""Task trees that others wrote: the units of a file in its own order, each as often as it stands there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from foon_asp.io.files import read_bytes
from foon_asp.io.findings import Finding
from foon_asp.io.open import FoonFiles, FoonReader
from foon_asp.io.vocabulary import VocabularyName
from foon_asp.model.foon import Added, Foon, FoonBuilder
from foon_asp.model.node import Annotation, FunctionalUnit, ObjectId, ObjectNode, Source, UnitId

STDIN = "-"
"""What the file of a tree is called that comes from standard input."""


@dataclass(frozen=True, slots=True)
class Listing:
    """The units of one tree in the order in which it lists them, and where each stands.

    `name` is that of the file, with the place of the tree in it if there are several. `goals` are marked in
    the file. `findings` say what was odd in it, and what of it could not be read.
    """

    name: str
    units: tuple[UnitId, ...]
    sources: tuple[Source, ...]
    goals: tuple[ObjectNode, ...] = ()
    findings: tuple[Finding, ...] = ()


@dataclass(frozen=True, slots=True)
class Trees:
    """Trees beside a FOON that is known: all units in one FOON, of which the first `known` ones are its."""

    foon: Foon
    known: int
    listings: tuple[Listing, ...]


@dataclass(frozen=True, slots=True)
class TreeFile:
    """What one file holds: its units, and its trees: units in order, each with the place where it stands."""

    name: str
    foon: Foon
    parts: tuple[tuple[tuple[UnitId, Source], ...], ...]
    findings: tuple[Finding, ...] = ()


class TreeBuilder(FoonBuilder):
    """Remembers the units that are added one by one, the places where they were read, and in which part."""

    def __init__(self, words: VocabularyName = "current") -> None:
        """Start with nothing; `words` says how words of older text files are read."""
        super().__init__()
        self._words = words
        self._order: list[tuple[int, UnitId, Source]] = []
        self._part: Callable[[], int] = lambda: 0

    def unit(
        self, motion: str, inputs: Sequence[ObjectId], outputs: Sequence[ObjectId], note: Annotation
    ) -> tuple[UnitId, Added]:
        """Add a unit, and remember it."""
        number, added = super().unit(motion, inputs, outputs, note)
        self._order.append((self._part(), number, note.sources[0] if note.sources else Source()))
        return number, added

    def read_file(self, path: Path) -> TreeFile:
        """Read the trees of a file, `-` for standard input; raise `InputError` if it is no FOON."""
        reader = FoonReader(builder=self, words=self._words)
        self._part = lambda: reader.part
        if str(path) == STDIN:
            reader.read_data(read_bytes(Path("/dev/stdin")), path)
        else:
            reader.read(path)
        return self.file(str(path), reader.finish())

    def file(self, name: str, files: FoonFiles | None = None) -> TreeFile:
        """Return the trees of what was added, or of files that were read into this."""
        foon, findings = (self.build(), ()) if files is None else (files.foon, files.findings)
        # The reader of texts adds many units at once, but their lines say how they stand.
        order = self._order or _by_lines(foon, name)
        parts: dict[int, list[tuple[UnitId, Source]]] = {}
        for part, unit, source in order:
            parts.setdefault(part, []).append((unit, source))
        return TreeFile(name, foon, tuple(map(tuple, parts.values())) or ((),), findings)


def _by_lines(foon: Foon, file: str) -> list[tuple[int, UnitId, Source]]:
    """Return all places of a file where a unit begins; one that comments place elsewhere follows the last."""
    found = []
    line = 0
    for unit in foon.units:
        here = [source for source in unit.annotation.sources if source.file == file]
        line = min((source.line for source in here), default=line)
        found += [(source.line, unit.id, source) for source in here] or [(line, unit.id, unit.source)]
    return [(0, number, source) for _, number, source in sorted(found, key=lambda each: each[:2])]


def trees_beside(known: Foon, files: Iterable[TreeFile]) -> Trees:
    """Put the trees of some files beside a FOON."""
    builder = FoonBuilder()
    _add(builder, known)
    listings = []
    for file in files:
        ids = _add(builder, file.foon)
        goals = tuple(file.foon.marked_goals())
        for place, part in enumerate(file.parts, 1):
            name = f"{file.name}#{place}" if len(file.parts) > 1 else file.name
            units, sources = tuple(ids[unit] for unit, _ in part), tuple(source for _, source in part)
            listings.append(Listing(name, units, sources, goals, file.findings))
    return Trees(builder.build(), len(known.units), tuple(listings))


def _add(builder: FoonBuilder, foon: Foon) -> list[UnitId]:
    """Add all units of a FOON, and return the ids that they have now."""
    objects = [builder.object(node) for node in foon.objects]

    def added(unit: FunctionalUnit) -> UnitId:
        inputs, outputs = ([objects[number] for number in side] for side in (unit.inputs, unit.outputs))
        return builder.unit(unit.motion, inputs, outputs, unit.annotation)[0]

    return [added(unit) for unit in foon.units]
