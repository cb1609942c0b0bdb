"""Object nodes read from JSON; `foon_asp.io.object_wire` writes them."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from foon_asp.io.files import kind_of
from foon_asp.io.syntax import Report, clean, parse_state, quiet, read_contents, read_relatum, says_none
from foon_asp.model.node import ObjectNode, State, contains, inside
from foon_asp.words import closest

_KEYS = ("label", "states", "ingredients", "container")
_API_KEYS = ("object_label", "object_states", "object_id", "object_in_motion")
_STATE_KEYS = ("state_label", "label", "relative_object", "state_id")


def refuse_unknown_keys(code: str, message: str) -> None:
    """Raise `ValueError` for an unknown key; all else is read as in a FOON."""
    if code == "unknown-key":
        raise ValueError(message)


def check_keys(value: Collection[str], known: Sequence[str], report: Report) -> None:
    """Report the keys of an object of JSON that mean nothing, each with the closest that do."""
    for key in value:
        if key not in known:
            report("unknown-key", f"unknown key {key[:60]!r}{closest(key[:60], known, 1)}")


def object_from_json(item: object, report: Report = quiet, *, more: Sequence[str] = ()) -> ObjectNode:
    """Read one object; `ingredients` are the contents of `contains`, `container` the relatum of `in`.

    The FOON API's keys `object_label` and `object_states` are read, too; `more` are keys that it may have
    beside those. Raises `ValueError` with what is wrong.
    """
    if not isinstance(item, dict):
        raise ValueError(f"expected an object, found {kind_of(item)}")
    if report is not quiet:
        check_keys(item, (*_KEYS, *more, *_API_KEYS), report)
    label = item.get("label", item.get("object_label"))
    if says_none(label) or not isinstance(label, str) or not clean(label):
        raise ValueError("'label' is missing or no text")
    ingredients = read_contents(_texts(item, "ingredients", report), report)

    def report_state(code: str, message: str) -> None:
        if not (ingredients and code == "contains-without-braces"):
            report(code, message)

    states = [_state_from_json(state, report_state) for state in _states(item, report)]
    if ingredients:
        # The FOON API names the state beside its contents.
        states = [state for state in states if state != State("contains")]
        states.append(contains(*ingredients))
    container = item.get("container")
    if says_none(container, report):
        container = ""
    if not isinstance(container, str):
        raise ValueError("'container' is neither text nor null")
    relatum = read_relatum(container, report)
    if relatum is not None:
        states.append(inside(relatum))
    return ObjectNode.of(clean(label, report), states)


def _states(item: dict[str, object], report: Report) -> list[object]:
    key = "object_states" if "object_states" in item else "states"
    found = _listed(item, key, report)
    if not all(isinstance(state, str | dict) for state in found):
        raise ValueError(f"{key!r} is not a list of texts")
    return found


def _state_from_json(value: object, report: Report) -> State:
    """Read a state: a text, or `{state_label, relative_object}`."""
    related = None
    if isinstance(value, dict):
        check_keys(value, _STATE_KEYS, report)
        related = value.get("relative_object")
        value = value.get("state_label", value.get("label"))
    if says_none(related, report):
        related = ""
    if not isinstance(value, str) or not isinstance(related, str):
        raise ValueError("a state is no text")
    text = clean(value, report)
    relatum = read_relatum(related, report)
    state = parse_state(text if relatum is None else f"{text} [{relatum}]", report)
    if state is None:
        raise ValueError(f"the state {value[:60]!r} cannot be read")
    return state


def _texts(item: dict[str, object], key: str, report: Report) -> list[str]:
    texts = [text for text in _listed(item, key, report) if isinstance(text, str)]
    if len(texts) != len(_listed(item, key)):
        raise ValueError(f"{key!r} is not a list of texts")
    return texts


def _listed(item: dict[str, object], key: str, report: Report = quiet) -> list[object]:
    """Return what a list names, without what means that there is nothing."""
    value = item.get(key)
    if says_none(value, report):
        return []
    if not isinstance(value, list):
        raise ValueError(f"{key!r} is not a list of texts")
    return [each for each in value if not says_none(each, report)]
