"""How states and objects are written inside a line: `in [cup]`, `contains {salt,water}`.

Shared by the text format, by JSON (whose `states` may hold any state as text) and by goals.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from foon_asp.graph import ObjectNode, State, contains, inside

Report = Callable[[str, str], None]
"""Receives the code and the message of an oddity."""

_STATE = re.compile(r"(?P<name>[^\[\]{}]*)(?P<rest>.*)", re.DOTALL)
_GROUP = re.compile(r"\[(?P<relatum>[^\[\]{}]*)(?:\]|\Z)|\{(?P<contents>[^\[\]{}]*)(?:\}|\Z)")
_BRACKET = re.compile(r"[\[\]{}]")
_CONTROL = dict.fromkeys([*range(9), *range(11, 32), *range(127, 160)])
_SPACES = re.compile(r"[\t\r\n]+")
_SURROGATE = re.compile(r"[\ud800-\udfff]")
PLACES = frozenset({"in", "on", "under", "with", "inside", "attached to", "around", "between"})


def quiet(code: str, message: str) -> None:
    """Take a report and do nothing with it."""


def without_control_characters(text: str) -> str:
    """Remove control characters but tab and newline: they would cut the strings of clingo short."""
    return text.translate(_CONTROL)


def one_line(text: str) -> str:
    """Return a text that may hold anything as it can stand in one field of a line."""
    return _SURROGATE.sub("\ufffd", without_control_characters(_SPACES.sub(" ", text))).strip()


def clean(text: str, report: Report = quiet) -> str:
    """Return the label in a text that may hold anything: one line, stripped, lower case."""
    plain = one_line(text)
    if plain != text.strip():
        report("control-character", f"{text[:60]!r} is read as {plain[:60]!r}")
    return plain.lower()


def parse_state(text: str, report: Report = quiet) -> State | None:
    """Read `name`, `name [relatum]` or `name {content, content}`; None if there is no name."""
    match = _STATE.fullmatch(text)
    name = match["name"].strip().lower() if match else ""
    if match is None or not name:
        return None
    return make_state(name, match["rest"], report)


def make_state(name: str, detail: str, report: Report = quiet) -> State:
    """Make a state of its name and of what stands in braces or brackets behind it."""
    detail = detail.strip()
    if not detail:
        if name == "contains":
            report("contains-without-braces", "'contains' does not say what")
        return State(name)
    groups = list(_GROUP.finditer(detail))
    contents_text = next((g["contents"] for g in groups if g["contents"] is not None), None)
    relatum_text = next((g["relatum"] for g in groups if g["relatum"] is not None), None)
    if detail.count("{") != detail.count("}") or detail.count("[") != detail.count("]"):
        report("unbalanced-brackets", f"the brackets of {detail!r} do not match")
    if not groups:
        return _without_groups(name, " ".join(_BRACKET.sub(" ", detail).split()), report)
    rest = _GROUP.sub("", detail).strip()
    if rest or len(groups) > (contents_text is not None) + (relatum_text is not None):
        report("stray-text", f"{rest or detail!r} is more than one thing in brackets; the first counts")
    contents = None if contents_text is None else _parse_contents(contents_text, report)
    relatum = None if relatum_text is None else _parse_relatum(relatum_text, name, report)
    if name == "contains" and contents is None and relatum is not None:
        report("contains-in-brackets", f"contents stand in '[{relatum}]' instead of braces")
        return State(name, contents=_parse_contents(relatum, report))
    if name in PLACES and relatum is None and contents and len(contents) == 1:
        report("place-in-braces", f"a place stands in '{{{contents[0]}}}' instead of brackets")
        return State(name, relatum=contents[0])
    return State(name, relatum, contents)


def _without_groups(name: str, text: str, report: Report) -> State:
    """Make a state whose detail stands in no brackets."""
    if not text:
        return State(name)
    report("state-without-brackets", f"{text!r} stands without brackets")
    if name == "contains":
        return State(name, contents=_parse_contents(text, report))
    return State(name, text.lower())


def _parse_contents(text: str, report: Report) -> tuple[str, ...]:
    raw = text.lower().split(",")
    items = [item.strip() for item in raw]
    kept = sorted(item for item in items if item)
    if len(kept) != len(items):
        if kept:
            report("stray-comma", f"a comma too many in '{{{text}}}'")
        else:
            report("empty-braces", "nothing stands between the braces")
    if any(item != item.strip() for item in raw):
        report("space-in-braces", f"spaces beside a comma or brace in '{{{text}}}'")
    if len(set(kept)) != len(kept):
        report("duplicate-content", f"something is named twice in '{{{text}}}'")
    return tuple(kept)


def _parse_relatum(text: str, name: str, report: Report) -> str | None:
    relatum = text.strip().lower()
    if not relatum:
        report("empty-brackets", f"{name!r} does not say of what")
        return None
    if "," in relatum:
        report("comma-in-brackets", f"a comma inside '[{text}]'")
    return relatum


def read_contents(texts: list[str], report: Report = quiet) -> tuple[str, ...]:
    """Return the contents that a list names, sorted; brackets and commas cannot be part of a content."""
    found: list[str] = []
    for text in texts:
        content = clean(text, report)
        parts = [part.strip() for part in _BRACKET.sub(" ", content).split(",")]
        kept = [part for part in parts if part]
        if content and kept != [content]:
            report("odd-content", f"the content {text[:60]!r} is read as {kept}")
        found += kept
    return tuple(sorted(found))


def read_relatum(text: str, report: Report = quiet) -> str | None:
    """Return what a relation names; brackets cannot be part of it. None if nothing is left."""
    relatum = clean(text, report)
    kept = _BRACKET.sub(" ", relatum).strip()
    if kept != relatum:
        report("odd-content", f"{text[:60]!r} is read as {kept!r}")
    return kept or None


def object_to_json(node: ObjectNode) -> dict[str, object]:
    """Write a node as `{label, states, ingredients, container}`; what does not fit goes to `states`."""
    states: list[str] = []
    ingredients: list[str] = []
    container: str | None = None
    # Beside a plain `contains`, ingredients would be read as its contents.
    fits = State("contains") not in node.states
    for state in node.states:
        if container is None and state == inside(state.relatum or ""):
            container = state.relatum
        elif fits and not ingredients and state.contents and state == contains(*state.contents):
            ingredients = list(state.contents)
        else:
            states.append(str(state))
    return {
        "label": node.label,
        "states": states,
        "ingredients": ingredients,
        "container": container,
    }
