"""PDDL exports as other programs read them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any

from fast_downward.translate import pddl_parser
from pddl.parser.domain import DomainParser
from pddl.parser.problem import ProblemParser
from unified_planning.io import PDDLReader

from foon_asp.planning.pddl.styles import Document
from foon_asp.planning.pddl.task import Fact
from foon_asp.planning.pddl.write import domain_text, problem_text


@lru_cache(maxsize=1)
def readers() -> tuple[Any, Any, Any]:
    """Make each reader once: they take longer to set up than to read."""
    return PDDLReader(), DomainParser(), ProblemParser()


def up_reading(written: Document) -> Any:
    return readers()[0].parse_problem_string(domain_text(written), problem_text(written))


def check_up(written: Document) -> None:
    """Parse in unified_planning, where a single action takes about 20 ms."""
    assert {action.name for action in up_reading(written).actions} == {
        action.name for action in written.actions
    }


def check_others(written: Document, folder: Path) -> None:
    """Parse in the package `pddl`, and in Fast Downward's translator."""
    _, parse_domain, parse_problem = readers()
    world = parse_domain(domain_text(written))
    assert {action.name for action in world.actions} == {action.name for action in written.actions}
    parse_problem(problem_text(written))
    for name, text in (("domain.pddl", domain_text(written)), ("problem.pddl", problem_text(written))):
        (folder / name).write_text(text, encoding="utf-8")
    task = pddl_parser.open(str(folder / "domain.pddl"), str(folder / "problem.pddl"))
    # The translator drops actions that cannot change anything.
    assert {action.name for action in task.actions} <= {action.name for action in written.actions}
    assert len(task.init) >= len(written.initially)


def check_readers(written: Document, folder: Path) -> None:
    check_up(written)
    check_others(written, folder)


# Effects


def holds(target: Any, state: Any, fact: Fact) -> bool:
    atoms = target.atoms
    return fact in atoms and bool(state.get_value(atoms[fact]).bool_constant_value())


# Plans there and back


def before_pairs(partial: Any, units: Mapping[str, int]) -> list[tuple[int, int]]:
    """Return which units a partial-order plan puts before which, directly or not."""
    steps = list(partial.get_adjacency_list)
    pairs = [
        (steps.index(first), steps.index(second))
        for first, after in partial.get_adjacency_list.items()
        for second in after
    ]
    named = [units[step.action.name] for step in steps]
    return [(named[first], named[second]) for first, second in closed(pairs)]


def closed(pairs: Iterable[tuple[int, int]]) -> set[tuple[int, int]]:
    """Return the transitive closure of pairs."""
    found = set(pairs)
    while more := {(a, d) for a, b in found for c, d in found if b == c} - found:
        found |= more
    return found
