"""How states and objects are written inside a line: `in [cup]`, `contains {salt,water}`.

Shared by the text format, by JSON (whose `states` may hold any state as text) and by goals.
"""

from __future__ import annotations

import re
from collections.abc import Callable

from foon_asp.graph import ObjectNode, State, contains, inside

Report = Callable[[str, str], None]
"""Receives the code and the message of an oddity."""

_STATE = re.compile(r"(?P<name>[^\[\]{}]*)(?P<rest>[\[{].*)?$", re.DOTALL)
_BRACES = re.compile(r"\{([^{}]*)(?:\}|$)")
_BRACKETS = re.compile(r"\[([^\[\]]*)(?:\]|$)")
PLACES = frozenset({"in", "on", "under", "with", "inside", "attached to", "around", "between"})


def _quiet(code: str, message: str) -> None:
    """Take a report and do nothing with it."""


def parse_state(text: str, report: Report = _quiet) -> State | None:
    """Read `name`, `name [relatum]` or `name {content, content}`; None if there is no name."""
    match = _STATE.match(text)
    name = match["name"].strip().lower() if match else ""
    if match is None or not name:
        return None
    return make_state(name, match["rest"] or "", report)


def make_state(name: str, detail: str, report: Report = _quiet) -> State:
    """Make a state of its name and of what stands in braces or brackets behind it."""
    detail = detail.strip()
    if not detail:
        if name == "contains":
            report("contains-without-braces", "'contains' does not say what")
        return State(name)
    braces = _BRACES.search(detail)
    brackets = _BRACKETS.search(detail)
    rest = _BRACKETS.sub("", _BRACES.sub("", detail)).strip()
    if detail.count("{") != detail.count("}") or detail.count("[") != detail.count("]"):
        report("unbalanced-brackets", f"the brackets of {detail!r} do not match")
    contents = None if braces is None else _parse_contents(braces[1], report)
    relatum = None if brackets is None else _parse_relatum(brackets[1], name, report)
    if rest and braces is None and brackets is None:
        report("state-without-brackets", f"{detail!r} stands without brackets")
        if name == "contains":
            contents = _parse_contents(rest, report)
        else:
            relatum = rest.lower()
    elif rest:
        report("stray-text", f"{rest!r} stands outside of the brackets")
    if name == "contains" and contents is None and relatum is not None:
        report("contains-in-brackets", f"contents stand in '[{relatum}]' instead of braces")
        return State(name, contents=_parse_contents(relatum, report))
    if name in PLACES and relatum is None and contents and len(contents) == 1:
        report("place-in-braces", f"a place stands in '{{{contents[0]}}}' instead of brackets")
        return State(name, relatum=contents[0])
    return State(name, relatum, contents)


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


def object_to_json(node: ObjectNode) -> dict[str, object]:
    """Write a node as `{label, states, ingredients, container}`; what does not fit goes to `states`."""
    states: list[str] = []
    ingredients: list[str] = []
    container: str | None = None
    for state in node.states:
        if container is None and state == inside(state.relatum or ""):
            container = state.relatum
        elif not ingredients and state.contents and state == contains(*state.contents):
            ingredients = list(state.contents)
        else:
            states.append(str(state))
    return {
        "label": node.label,
        "states": states,
        "ingredients": ingredients,
        "container": container,
    }
