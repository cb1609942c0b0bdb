"""Criteria of the user's own: all that the rules of a question say of them together means something."""

from __future__ import annotations

from collections.abc import Iterable

from foon_asp.asp.heads import CRITERIA_OF_ONES_OWN
from foon_asp.asp.rules import Derived, Rules, check_rules
from foon_asp.errors import InputError
from foon_asp.words import closest


def check_aims(rules: Iterable[Rules]) -> None:
    """Raise `InputError` for a criterion that nothing pays by, or a payment by what is no criterion.

    What a body speaks of may be meant for that alone: a constraint can add payments up.
    """
    rules = list(rules)
    said = {name: _names(rules, name) for name, _ in CRITERIA_OF_ONES_OWN}
    spoken = frozenset().union(*(part.spoken for part in rules))
    for part in rules:
        for head in _aims(part):
            predicate, name = head.signature[0], str(head.name)
            needed = "penalty" if predicate == "criterion" else "criterion"
            if name in said[needed] or name in spoken:
                continue
            problem = f'{predicate}("{name}",…) is void: there is no {needed}("{name}",…)'
            near = closest(name, said[needed] - said[predicate])
            raise InputError(part.path, head.line, problem + near, "see docs/objectives.md for the two lines")


def refuse_aims(texts: Iterable[str], why: str) -> None:
    """Raise `InputError` for rules that say of a criterion of their own, where it would be void."""
    for part in map(check_rules, texts):
        for head in _aims(part):
            problem = f'{head.signature[0]}("{head.name}",…) is void: {why}'
            raise InputError(part.path, head.line, problem)


def has_aims(rules: Rules) -> bool:
    """Whether rules say anything of a criterion."""
    return bool(_aims(rules))


def _aims(rules: Rules) -> list[Derived]:
    return [head for head in rules.derived if head.signature in CRITERIA_OF_ONES_OWN]


def _names(rules: Iterable[Rules], predicate: str) -> frozenset[str]:
    heads = (head for part in rules for head in _aims(part))
    return frozenset(str(head.name) for head in heads if head.signature[0] == predicate)
