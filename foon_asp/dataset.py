"""A data folder: a FOON with its kitchen, success rates, utensils and goals."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from foon_asp.errors import InputError
from foon_asp.files import FoonFiles, is_store, read_objects, read_rates, read_stock, read_utensils
from foon_asp.findings import Finding, Severity
from foon_asp.graph import Foon, ObjectNode
from foon_asp.kitchen import Kitchen
from foon_asp.levels import FULL
from foon_asp.open_foon import open_files
from foon_asp.problem import Domain
from foon_asp.resources import built_in_data

_BESIDE_A_FOON = frozenset({"motion.txt", "utensils.txt", "words.txt"})


@dataclass(frozen=True, slots=True)
class Dataset:
    """What a folder holds.

    `findings` says what was odd in the FOON files; `units_read` counts units before duplicates went.
    """

    foon: Foon
    kitchen: Kitchen
    goals: tuple[ObjectNode, ...]
    findings: tuple[Finding, ...]
    units_read: int

    def domain(self, *, strict: bool = False, level: int = FULL) -> Domain:
        """See the FOON from the kitchen, on a level of detail."""
        return Domain(self.foon, self.kitchen, strict=strict, level=level)


def read_foon(paths: Sequence[Path], strict: bool = False) -> FoonFiles:
    """Read FOON files, text, JSON or compiled stores, and merge them, duplicate units removed.

    With `strict` anything odd is an error. Raises `InputError` if a file cannot be read as a FOON or no
    functional unit is in any of them.
    """
    files = open_files(*paths, strict=strict)
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
        if universal.exists():
            return [universal]
    if is_store(folder):
        return [folder]
    return sorted(path for path in folder.glob("*.txt") if path.name not in _BESIDE_A_FOON)


def load(
    folder: str | Path | None = None,
    *,
    foon: Sequence[str | Path] = (),
    kitchen: str | Path | None = None,
    rates: str | Path | None = None,
    utensils: str | Path | None = None,
    goals: str | Path | None = None,
    default_rate: float | None = None,
    strict_format: bool = False,
) -> Dataset:
    """Load a data folder, the built-in one by default; files named one by one replace its own.

    A folder has `FOON.txt` (or `FOON.json`, or the store `FOON.foon`) or several subgraphs `*.txt`, and may
    have `kitchen.json`, `motion.txt`, `utensils.txt` and `goal_nodes.json`. What the folder lacks is empty.
    With `strict_format` anything odd in a FOON file is an error. Raises `InputError`.
    """
    root = built_in_data() if folder is None else Path(folder)
    if not root.is_dir():
        problem = "this is no folder" if root.exists() else "no such folder"
        raise InputError(root, None, problem, "name one with FOON.txt, or a file with --foon")
    foon_paths = [Path(path) for path in foon] or foon_files(root)
    if not foon_paths:
        raise InputError(root, None, "no FOON.txt and no other *.txt", "name FOON files with --foon")
    files = read_foon(foon_paths, strict=strict_format)
    kitchen_path = _choose(kitchen, root / "kitchen.json")
    rates_path = _choose(rates, root / "motion.txt")
    utensils_path = _choose(utensils, root / "utensils.txt")
    goals_path = _choose(goals, root / "goal_nodes.json")
    stock = read_stock(kitchen_path) if kitchen_path else {}
    return Dataset(
        foon=files.foon,
        kitchen=Kitchen(
            objects=tuple(stock),
            utensils=read_utensils(utensils_path) if utensils_path else frozenset(),
            rates=read_rates(rates_path) if rates_path else {},
            default_rate=default_rate,
            quantities={node: quantity for node, quantity in stock.items() if quantity is not None},
        ),
        goals=tuple(read_objects(goals_path)) if goals_path else (),
        findings=files.findings,
        units_read=files.units_read,
    )


def _choose(named: str | Path | None, usual: Path) -> Path | None:
    if named is not None:
        return Path(named)
    return usual if usual.exists() else None
