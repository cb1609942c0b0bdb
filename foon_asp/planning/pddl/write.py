"""Writing PDDL: the text of a domain and of a problem, laid out to be read.

unified-planning has a writer of its own. It knows no comments, puts each precondition on one line however
long, and needs the problem as an object of unified-planning first, which takes longer than the writing.
"""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Iterator
from dataclasses import replace
from pathlib import Path

from foon_asp.characters import one_line
from foon_asp.io import atomic
from foon_asp.planning.pddl.names import names_text
from foon_asp.planning.pddl.styles import Action, Atom, Document, Typed
from foon_asp.words import WIDTH

FILES = ("domain.pddl", "problem.pddl", "names.json")
"""What an export consists of."""


def export(written: Document, folder: Path) -> None:
    """Write domain.pddl, problem.pddl and names.json into a folder, each whole or not at all.

    Raises `InputError` if the files cannot be written.
    """
    texts = (domain_text(written), problem_text(written), written_names(written))
    for name, text in zip(FILES, texts, strict=True):
        atomic.write_text(folder / name, text)


def written_names(document: Document) -> str:
    """Return the text of names.json."""
    task = document.task
    names = replace(task.names, arguments=document.arguments)
    return names_text(names, task.world, {"style": document.style, "durative": document.durative})


DOMAIN_NAME = "foon"


def domain_text(document: Document) -> str:
    """Write domain.pddl."""
    return "\n".join(_domain(document)) + "\n"


def problem_text(document: Document) -> str:
    """Write problem.pddl."""
    return "\n".join(_problem(document)) + "\n"


def comment(text: str, indent: str = "") -> list[str]:
    """Write a text as lines of comment; no character of it can end the comment early."""
    lines = textwrap.wrap(" ".join(one_line(text).split()), WIDTH - len(indent) - 4, break_on_hyphens=False)
    return [f"{indent}; {'  ' * (place > 0)}{line}" for place, line in enumerate(lines)]


def _domain(document: Document) -> Iterator[str]:
    task = document.task
    yield from comment(
        f"Functional units as actions (style {document.style}, semantics {task.semantics})."
        + (f" Costs: {task.criterion}." if document.costed else "")
        + (" Durations are seconds; what is not annotated takes 1." if document.durative else "")
    )
    yield from comment("names.json says which unit or object each name stands for.")
    yield f"(define (domain {DOMAIN_NAME})"
    yield f"  (:requirements {' '.join(_requirements(document))})"
    if document.types:
        yield from _section(":types", _typed(document.types))
    if document.constants:
        yield from _section(":constants", _typed(document.constants))
    yield ""
    yield "  (:predicates"
    for predicate in document.predicates:
        parameters = "".join(f" {name} - {kind}" for name, kind in predicate.parameters)
        line = f"    ({predicate.name}{parameters})"
        words = " ".join(one_line(predicate.words).split())
        # A name that says it all already is not said again.
        if not words or _squeezed(words) == _squeezed(predicate.name):
            yield line
        elif len(line) + len(words) + 4 <= WIDTH:
            yield f"{line}  ; {words}"
        else:
            yield from comment(words, "    ")
            yield line
    yield "  )"
    if document.costed:
        yield ""
        yield "  (:functions (total-cost) - number)"
    for action in document.actions:
        yield ""
        yield from _action(action, document.durative)
    yield ")"


def _requirements(document: Document) -> list[str]:
    found = [":strips"]
    if document.types:
        found.append(":typing")
    if document.durative:
        found.append(":durative-actions")
        if document.costed:
            found.append(":numeric-fluents")
    elif document.costed:
        found.append(":action-costs")
    return found


def _squeezed(text: str) -> str:
    return "".join(character for character in text.lower() if character.isalnum())


def _section(keyword: str, lines: Iterable[str]) -> Iterator[str]:
    yield ""
    yield f"  ({keyword}"
    for line in lines:
        yield f"    {line}"
    yield "  )"


def _typed(names: Typed) -> Iterator[str]:
    """Write names of one type in one line, or in as many as it takes."""
    groups: dict[str, list[str]] = {}
    for name, kind in names:
        groups.setdefault(kind, []).append(name)
    for kind, members in groups.items():
        yield from textwrap.wrap(
            " ".join(members) + f" - {kind}", WIDTH - 4, break_long_words=False, break_on_hyphens=False
        )


def _action(action: Action, durative: bool) -> Iterator[str]:
    for words in action.words:
        yield from comment(words, "  ")
    yield f"  (:{'durative-action' if durative else 'action'} {action.name}"
    parameters = [f"{name} - {kind}" for name, kind in action.parameters]
    yield from _group(":parameters (", parameters, ")")
    if durative:
        yield f"    :duration (= ?duration {action.duration})"
        conditions = [f"(at start {_written(atom)})" for atom in action.conditions]
        conditions += [f"(over all {_written(atom)})" for atom in action.lasting]
        yield from _group(":condition (and ", conditions, ")")
        effects = [f"(at start (not {_written(atom)}))" for atom in action.deletes]
        effects += [f"(at end {_written(atom)})" for atom in action.adds]
        if action.cost is not None:
            effects.append(f"(at end (increase (total-cost) {action.cost}))")
    else:
        # Standard PDDL lets an empty one be left out, but not all readers do.
        yield from _group(":precondition (and ", map(_written, action.conditions), ")")
        effects = [_written(atom) for atom in action.adds]
        effects += [f"(not {_written(atom)})" for atom in action.deletes]
        if action.cost is not None:
            effects.append(f"(increase (total-cost) {action.cost})")
    yield from _group(":effect (and ", effects, "))")


def _group(start: str, items: Iterable[str], end: str) -> Iterator[str]:
    """Write items in one line behind the start, or each in a line of its own."""
    items = list(items)
    line = f"    {start}{' '.join(items)}".rstrip() + end
    if len(line) <= WIDTH:
        yield line
        return
    yield f"    {start}".rstrip()
    for item in items[:-1]:
        yield f"      {item}"
    yield f"      {items[-1]}{end}"


def _written(atom: Atom) -> str:
    return f"({' '.join(atom)})"


def _problem(document: Document) -> Iterator[str]:
    task = document.task
    goals = "; ".join(str(task.world.node(goal)) for goal in task.goals)
    yield from comment(f"Get {goals or 'nothing'}.")
    yield f"(define (problem {document.problem_name})"
    yield f"  (:domain {DOMAIN_NAME})"
    if document.objects:
        yield from _section(":objects", _typed(document.objects))
    yield ""
    yield "  (:init"
    if document.costed:
        yield "    (= (total-cost) 0)"
    for atom in document.initially:
        yield f"    {_written(atom)}"
    yield "  )"
    yield ""
    yield f"  (:goal (and {' '.join(map(_written, document.wanted))}".rstrip() + "))"
    if document.costed:
        yield "  (:metric minimize (total-cost))"
    elif document.durative:
        yield "  (:metric minimize (total-time))"
    yield ")"
