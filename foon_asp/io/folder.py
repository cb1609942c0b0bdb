"""A data folder: a FOON with its kitchen, success rates, utensils and goals."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypedDict, Unpack

from foon_asp.errors import InputError, QueryError
from foon_asp.io.files import exists, is_folder, is_store
from foon_asp.io.findings import Finding, Severity
from foon_asp.io.kitchen import KitchenFiles, read_goals
from foon_asp.io.open import FoonFiles, open_files
from foon_asp.io.vocabulary import VocabularyName
from foon_asp.model.foon import Foon
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.levels import FULL
from foon_asp.model.node import ObjectNode
from foon_asp.model.relations import Matching, check_matching
from foon_asp.model.tables import UnitTable
from foon_asp.model.world import World
from foon_asp.resources import built_in_data
from foon_asp.values import a_list, said

BESIDE = {
    "kitchen": ("kitchen.json", "kitchen.txt"),
    "rates": ("motion.txt", "motion.json"),
    "costs": ("motion_cost.json", "motion_cost.txt"),
    "utensils": ("utensils.txt", "utensils.json"),
    "goals": ("goal_nodes.json", "goal_nodes.txt"),
}
"""What may lie in a data folder beside the FOON, and by which names; the first that is there counts."""

_NO_FOON = frozenset({"words.txt", *(name for names in BESIDE.values() for name in names)})


@dataclass(frozen=True, slots=True)
class Dataset:
    """What a folder holds.

    `findings` says what was odd in the FOON files; `units_read` counts units before duplicates went.
    `sources` are the files that were read.
    """

    foon: Foon
    kitchen: Kitchen
    goals: tuple[ObjectNode, ...]
    findings: tuple[Finding, ...]
    units_read: int
    sources: Sources
    strict: bool = False
    match_relations: Matching = "strict"
    level: int = FULL

    def world(self, *, strict: bool | None = None, level: int | None = None) -> World:
        """See the FOON from the kitchen, on a level of detail, as the sources say or else as given here."""
        return World.of(
            self.foon,
            self.kitchen,
            strict=self.strict if strict is None else strict,
            match_relations=self.match_relations,
            level=self.level if level is None else level,
            goals=self.goals,
        )


def read_foon(
    paths: Sequence[Path],
    strict: bool = False,
    vocabulary: VocabularyName = "current",
    *,
    repeats: bool = False,
) -> FoonFiles:
    """Read FOON files, text, JSON or compiled stores, and merge them, duplicate units removed.

    With `strict` anything odd is an error. With the vocabulary "as-written" words of older text files stay as
    they are. With `repeats` a unit is kept as often as it stands there. Raises `InputError` if a file cannot
    be read as a FOON or no functional unit is in any of them.
    """
    files = open_files(*paths, strict=strict, words=vocabulary, repeats=repeats)
    if not files.foon.units:
        problem = "an empty FOON: no functional unit"
        for finding in files.findings:
            if finding.severity > Severity.NOTE:
                raise InputError(finding.file, finding.line, f"{finding.message}; {problem}")
        raise InputError(paths[0] if paths else "no file", None, problem, "name a FOON file")
    return files


def foon_files(folder: Path) -> list[Path]:
    """Return the universal FOON of a folder (text, JSON or store), or else its subgraphs (`*.txt`), sorted.

    A store is a folder itself, that of the FOON alone.
    """
    for universal in (folder / "FOON.txt", folder / "FOON.json", folder / "FOON.foon"):
        if exists(universal):
            return [universal]
    if is_store(folder):
        return [folder]
    if not is_folder(folder):
        return []
    return sorted(path for path in folder.glob("*.txt") if path.name not in _NO_FOON)


class SourceKeys(TypedDict, total=False):
    """Files that replace those of a data folder, and how all of them are read; flags have the same words."""

    foon: Iterable[str | Path]
    kitchen: str | Path | None
    rates: str | Path | None
    costs: str | Path | None
    utensils: str | Path | None
    goals: str | Path | None
    default_rate: float | None
    default_cost: float | None
    strict_format: bool
    strict: bool
    match_relations: Matching
    level: int
    vocabulary: VocabularyName


@dataclass(frozen=True, slots=True)
class Sources:
    """The files of a run, and how they are read.

    `shown` are paths as results name them, where they are opened by another name.
    """

    folder: str
    foon: tuple[str, ...]
    kitchen: str | None = None
    rates: str | None = None
    costs: str | None = None
    utensils: str | None = None
    goals: str | None = None
    default_rate: float | None = None
    default_cost: float | None = None
    strict_format: bool = False
    strict: bool = False
    match_relations: Matching = "strict"
    level: int = FULL
    vocabulary: VocabularyName = "current"
    shown: tuple[tuple[str, str], ...] = ()

    @classmethod
    def of(cls, folder: str | Path | None = None, **files: Unpack[SourceKeys]) -> Sources:
        """Find the files of a data folder, the built-in one by default; those that are named replace its own.

        The built-in kitchen is that of the built-in FOON alone: beside files that are named without one, all
        is at hand that no unit makes. A folder has `FOON.txt` (or `FOON.json`, or the store `FOON.foon`) or
        several subgraphs `*.txt`, and may have the files of `BESIDE`.
        Raises `InputError` if there is no FOON.
        """
        if unknown := files.keys() - SourceKeys.__annotations__.keys():
            # What Python itself would say of a misspelt argument.
            raise TypeError(f"load() got an unexpected keyword argument {min(unknown)!r}")
        check_matching(files.get("match_relations", "strict"))
        if not isinstance(folder, str | Path | None):
            raise QueryError(f"a folder is a path, not {said(folder)}")
        root = built_in_data() if folder is None else Path(folder)
        if not is_folder(root):
            problem = "this is no folder" if exists(root) else "no such folder"
            raise InputError(root, None, problem, "name one with FOON.txt, or a file with --foon")
        named = a_list(files.get("foon", ()), "foon", "files")
        paths = [str(path) for path in named] or [str(path) for path in foon_files(root)]
        if not paths:
            raise InputError(root, None, "no FOON.txt and no other *.txt", "name FOON files with --foon")

        others = folder is None and bool(named)

        def beside(what: str, given: str | Path | None) -> str | None:
            there = (str(root / usual) for usual in BESIDE[what] if exists(root / usual))
            return next(there, None) if given is None else str(given)

        def made_for_it(what: str, given: str | Path | None) -> str | None:
            """Return a file that goes with one FOON: the built-in kitchen and goals are of no other."""
            return None if given is None and others else beside(what, given)

        return cls(
            str(root),
            tuple(paths),
            made_for_it("kitchen", files.get("kitchen")),
            beside("rates", files.get("rates")),
            beside("costs", files.get("costs")),
            beside("utensils", files.get("utensils")),
            made_for_it("goals", files.get("goals")),
            files.get("default_rate"),
            files.get("default_cost"),
            files.get("strict_format", False),
            files.get("strict", False),
            files.get("match_relations", "strict"),
            files.get("level", FULL),
            files.get("vocabulary", "current"),
        )

    @property
    def beside(self) -> dict[str, str]:
        """The files that are read beside the FOON, by what they are: the keys of `BESIDE`."""
        named = {
            "kitchen": self.kitchen,
            "rates": self.rates,
            "costs": self.costs,
            "utensils": self.utensils,
            "goals": self.goals,
        }
        return {what: path for what, path in named.items() if path is not None}

    @property
    def paths(self) -> list[Path]:
        """All files and stores that are read."""
        return [Path(path) for path in (*self.foon, *self.beside.values())]

    def absolute(self) -> Sources:
        """Return the same files by names that mean the same in any folder; results keep the old ones."""
        foon = tuple(str(Path(path).absolute()) for path in self.foon)
        return replace(
            self,
            folder=str(Path(self.folder).absolute()),
            foon=foon,
            kitchen=_absolute(self.kitchen),
            rates=_absolute(self.rates),
            costs=_absolute(self.costs),
            utensils=_absolute(self.utensils),
            goals=_absolute(self.goals),
            shown=tuple(pair for pair in zip(foon, self.foon, strict=True) if pair[0] != pair[1]),
        )

    def load(self) -> Dataset:
        """Read all files; raise `InputError`. The FOON names its files as results do."""
        files = read_foon([Path(path) for path in self.foon], self.strict_format, self.vocabulary)
        kitchen, odd = KitchenFiles(
            self.kitchen,
            self.utensils,
            self.rates,
            self.costs,
            self.default_rate,
            self.default_cost,
            self.vocabulary,
        ).read(files.foon)
        goals, odd_goals = read_goals(self.goals, files.foon, self.vocabulary)
        return Dataset(
            foon=_renamed_files(files.foon, dict(self.shown)) if self.shown else files.foon,
            kitchen=kitchen,
            goals=goals if self.goals else tuple(files.foon.marked_goals()),
            findings=(*files.findings, *odd, *odd_goals),
            units_read=files.units_read,
            sources=self,
            strict=self.strict,
            match_relations=self.match_relations,
            level=self.level,
        )


def _renamed_files(foon: Foon, names: Mapping[str, str]) -> Foon:
    """Return the same FOON, read from files of other names."""
    units = foon.units
    notes = replace(units.notes, files=[names.get(file, file) for file in units.notes.files])
    return replace(foon, units=UnitTable(units.motions, units.motion, units.inputs, units.outputs, notes))


def _absolute(path: str | None) -> str | None:
    return None if path is None else str(Path(path).absolute())


def load(folder: str | Path | None = None, **files: Unpack[SourceKeys]) -> Dataset:
    """Load a data folder, the built-in one by default; files named one by one replace its own.

    `files` are those of `Sources.of`. What the folder lacks is empty. With `strict_format` anything odd in a
    FOON file is an error. Raises `InputError`.
    """
    return Sources.of(folder, **files).load()
