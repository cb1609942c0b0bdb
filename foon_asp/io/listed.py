"""Lists of objects, a kitchen or goals, as people keep them: JSON, FOON text, a label a line."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from foon_asp.characters import is_label, one_line, without_control_characters
from foon_asp.errors import InputError, QueryError
from foon_asp.io.document import OBJECTS_ADVICE, Document
from foon_asp.io.files import read_string, rows
from foon_asp.io.findings import Finding, oddity
from foon_asp.io.lines import HEAD
from foon_asp.io.lines import read_object as read_object_line
from foon_asp.io.lines import read_state as read_state_line
from foon_asp.io.mend import ANY_ID
from foon_asp.io.objects import object_from_json, refuse_unknown_keys
from foon_asp.io.syntax import says_none
from foon_asp.io.vocabulary import Vocabulary, VocabularyName, vocabulary
from foon_asp.model.foon import Foon
from foon_asp.model.lookup import written_node
from foon_asp.model.node import ObjectNode, State
from foon_asp.model.notation import read_object, tidy
from foon_asp.numbers import QUANTITY
from foon_asp.values import said

_JSON = re.compile(r"\A\s*[\[{]|^[ \t]*[\[{]\s*[\[{\"]|\[\s*\{\s*\"", re.MULTILINE)
"""JSON, which prose or a fence may stand before; an object in our notation has no such brackets."""
_FOON_TEXT = re.compile(rf"^[ \t]*(?:[OSMosm]{ANY_ID}\t|[OM]{ANY_ID} )", re.MULTILINE)
_TEXT_ADVICE = "an object is an O line and the S lines of its states"
_LABEL_ADVICE = "write a label a line"


@dataclass(frozen=True, slots=True)
class Listed:
    """An object that a file lists: a node, or a text that names one; how many there are, None for plenty."""

    line: int
    named: ObjectNode | str
    quantity: int | None = None


@dataclass(frozen=True, slots=True)
class ObjectFile:
    """The objects that a file lists, in its order, and what was odd in it."""

    path: Path
    objects: tuple[Listed, ...]
    findings: tuple[Finding, ...]

    def named_in(self, foon: Foon) -> Iterator[tuple[Listed, ObjectNode | str]]:
        """Yield what is listed, each with the node that it is, or with a label that stands alone.

        A text that is a label of the FOON is nothing more. Raises `InputError` for a text that names nothing.
        """
        labels: set[str] | None = None
        for each in self.objects:
            if isinstance(each.named, ObjectNode):
                yield each, each.named
                continue
            labels = foon.labels if labels is None else labels
            yield each, self._named(each, each.named, labels)

    def _named(self, each: Listed, text: str, labels: set[str]) -> ObjectNode | str:
        if tidy(text) in labels:
            return tidy(text)
        try:
            node = written_node(read_object(text), text)
        except QueryError as error:
            raise InputError(self.path, each.line, str(error)) from None
        return node.label if node.bare else node


def read_listed(path: Path, vocabulary_name: VocabularyName = "current") -> ObjectFile:
    """Read a list of objects, JSON, FOON text or labels, told by what stands in the file; see docs/format.md.

    What stands around JSON is left out, and what is cut off, each with a finding. Raises `InputError`.
    """
    text = read_string(path)
    if not text.strip():
        raise InputError(path, 1, "nothing is in this file", "write [] for nothing, or a label a line")
    findings: list[Finding] = []
    if _JSON.search(text):
        listed = _read_json(text, path, findings)
    elif _FOON_TEXT.search(text):
        listed = _read_text(text, path, findings, vocabulary(vocabulary_name))
    else:
        listed = _read_labels(text, path, findings)
    objects = tuple(listed)
    return ObjectFile(path, objects, tuple(findings))


def _read_json(text: str, path: Path, findings: list[Finding]) -> Iterator[Listed]:
    document = Document(text, path)
    document.read_objects()
    findings += (oddity(code, str(path), line, message) for line, code, message in document.oddities)
    for place, item in enumerate(document.items, 1):
        report = _Report(path, item.line, findings)
        try:
            if item.repeated:
                raise ValueError(f"the key {item.repeated[0]!r} stands twice")
            if isinstance(item.value, str):
                if not says_none(item.value, report):
                    yield Listed(item.line, one_line(item.value))
            elif item.value is not None:
                node = object_from_json(item.value, report, more=("quantity",))
                yield Listed(item.line, node, _quantity(item.value))
        except ValueError as error:
            raise InputError(path, item.line, f"object {place}: {error}", OBJECTS_ADVICE) from None


@dataclass(frozen=True, slots=True)
class _Report:
    """Takes what is odd in an object; raises `ValueError` for a key that means nothing."""

    path: Path
    line: int
    findings: list[Finding]

    def __call__(self, code: str, message: str) -> None:
        refuse_unknown_keys(code, message)
        self.findings.append(oddity(code, str(self.path), self.line, message))


def _quantity(item: dict[str, object]) -> int | None:
    quantity = item.get("quantity")
    if quantity is None:
        return None
    if not QUANTITY.fits(quantity):
        raise ValueError(f"'quantity' is {QUANTITY.words}, not {said(quantity)}")
    assert isinstance(quantity, int)
    return quantity


def _read_text(text: str, path: Path, findings: list[Finding], words: Vocabulary) -> Iterator[Listed]:
    label, begin = "", 0
    states: list[State] = []
    for line, whole in rows(text):
        row = without_control_characters(whole).strip()
        head = HEAD.match(row)
        kind = "S" if head is None else (head[1] or "").upper()
        if kind == "M":
            problem = "a motion: this is a FOON, and no list of objects"
            raise InputError(path, line, problem, "name it with --foon")
        if not kind:
            continue
        if kind == "O":
            if label:
                yield Listed(begin, ObjectNode.of(label, states))
            label, _, odd = read_object_line(row)
            begin, states = line, []
        else:
            state, odd = read_state_line(row, words)
            if state is not None:
                states.append(state)
        wrong = next((message for code, message, _ in odd if code in _REFUSED), "")
        if not wrong and not label:
            wrong = f"the state {said(row)} belongs to no object"
        if wrong:
            raise InputError(path, line, wrong, _TEXT_ADVICE)
        findings += (oddity(code, str(path), line, message, mend) for code, message, mend in odd)
    if label:
        yield Listed(begin, ObjectNode.of(label, states))


_REFUSED = frozenset({"unreadable-line", "object-without-label"})
"""What is wrong in a line of an object as an unknown key is in JSON; what else is odd is a finding."""


def _read_labels(text: str, path: Path, findings: list[Finding]) -> Iterator[Listed]:
    for line, row in rows(text):
        label = row.strip()
        if not is_label(label):
            problem = f"no label: {said(row)} has a character that no label may have"
            raise InputError(path, line, problem, _LABEL_ADVICE)
        if says_none(label):
            findings.append(oddity("word-for-none", str(path), line, f"{label!r} is read as nothing"))
        else:
            yield Listed(line, label)
