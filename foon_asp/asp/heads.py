"""What rules of the user's own may speak of and derive: they add to the encodings, and redefine nothing."""

from __future__ import annotations

from collections.abc import Mapping, Set
from dataclasses import dataclass
from enum import Enum
from functools import cache

from foon_asp.asp.encodings import encoding_names
from foon_asp.asp.vocabulary import Signature, vocabulary


class Argument(Enum):
    """What stands at a place of an atom."""

    TEXT = "a text in quotes, on one line"
    KEY = "any term"
    INTEGER = "an integer"
    PAYMENT = "a whole number from 0"
    FACTOR = "a whole number from 1"
    UNIT = "the id of a unit"
    OBJECT = "the id of an object"


@dataclass(frozen=True, slots=True)
class Head:
    """A predicate of the encodings that rules may derive.

    `written` is how it is written, `meaning` what it says, both as in the docs; `arguments` are checked once
    the rules are grounded.
    """

    written: str
    meaning: str
    arguments: tuple[Argument, ...]

    @property
    def signature(self) -> Signature:
        """Its name and number of arguments."""
        return self.written.partition("(")[0], len(self.arguments)


def _table(*heads: Head) -> dict[Signature, Head]:
    return {head.signature: head for head in heads}


TREE_HEADS = _table(
    Head(
        "violated(Name,Key)",
        "the tree breaks the constraint Name; Key says where",
        (Argument.TEXT, Argument.KEY),
    ),
    Head(
        "criterion(Name,Priority)",
        "the criterion Name is minimised; higher priorities come first",
        (Argument.TEXT, Argument.INTEGER),
    ),
    Head(
        "penalty(Name,Key,Value)",
        "the tree pays Value by the criterion Name; Key tells payments apart",
        (Argument.TEXT, Argument.KEY, Argument.PAYMENT),
    ),
    Head(
        "factor(Name,Factor)",
        "each payment by the criterion Name counts Factor times",
        (Argument.TEXT, Argument.FACTOR),
    ),
    Head("human(U)", "a human, who never fails, does unit U of the tree", (Argument.UNIT,)),
)
"""What rules for task trees may derive beside predicates of their own; docs/constraints.md has this table."""

QUERY_HEADS = _table(
    Head("kitchen(O)", "the kitchen has the object, too", (Argument.OBJECT,)),
    Head("goal(O)", "the object is wanted, too", (Argument.OBJECT,)),
    Head(
        "at_first(W,O)",
        "the world W has the object to begin with",
        (Argument.KEY, Argument.OBJECT),
    ),
    Head("may(W,U)", "the world W has the unit", (Argument.KEY, Argument.UNIT)),
)
"""What the rules of a query may derive beside predicates of their own; docs/querying.md has this table."""

CRITERIA_OF_ONES_OWN: Set[Signature] = frozenset({("criterion", 2), ("penalty", 3), ("factor", 2)})
"""What is said of a criterion: its first argument is the name of one of the user's own."""

RESERVED = frozenset({"overlap", "likeness"})
"""Names that no criterion of the user's own may have, beside those of the built-in ones: what is foremost."""

ASK = "ask.lp"
"""The encoding that the rules of a query are run with."""


ANOTHER_NAME = "take another name for a predicate of your own"
INSTEAD: Mapping[str, str] = {
    "use": 'to demand a unit, write violated("unit 7",0) :- not use(7). or --use-unit 7',
    "kitchen": "name what is at hand with --kitchen FILE",
    "goal": "name the goals on the command line",
    "utensil": "name the utensils with --utensils FILE",
    "success_rate": "name the rates with --rates FILE",
    "available": "ask for a world of your own with at_first/2 and may/2",
    "executable": "ask for a world of your own with at_first/2 and may/2",
}
"""What to write instead of a head that belongs to the encodings."""


@dataclass(frozen=True, slots=True)
class Purpose:
    """What rules are for.

    `root` is the encoding that they are run with, None for those of retrieval. `heads` are what they may
    derive beside predicates of their own. `known` are the predicates that they may speak of, `refused` those
    that they may not even have as their own, `ours` the names that a predicate of their own may not have.
    `advice` goes with predicates that the encodings have elsewhere.
    """

    root: str | None
    heads: Mapping[Signature, Head]
    known: Set[Signature]
    refused: Set[Signature]
    ours: Set[str]
    advice: str

    @property
    def may_derive(self) -> str:
        """What rules may derive, in words."""
        heads = ", ".join(f"{name}/{arity}" for name, arity in self.heads)
        return f"{heads} and predicates of their own"


_ALWAYS_THERE = (
    "retrieval/task_tree.lp",
    "retrieval/selection.lp",
    "constraints/constraints.lp",
    "criteria/rounds.lp",
    "criteria/takeover.lp",
)
"""What rules can speak of, whichever trees are asked for; clingo says what the method does not have."""

_BESIDE = (
    "retrieval/greedy.lp",
    "retrieval/alternatives.lp",
    "retrieval/diverse.lp",
    "retrieval/pareto.lp",
    "retrieval/suggest.lp",
    "retrieval/substitute.lp",
    "retrieval/adapt.lp",
)
"""Encodings that the rules may be run with."""

_OURS_ALONE: Set[Signature] = frozenset({("name", 2), ("source", 3), ("foremost", 1), ("waived", 1)})
"""Only queries are given names and sources; what is foremost or waived depends on the search at hand."""

_FOR_TREES_ALONE: Set[Signature] = frozenset({*CRITERIA_OF_ONES_OWN, ("violated", 2)})
"""What a query would pass over in silence."""


@cache
def for_trees() -> Purpose:
    """Return what rules for `retrieve` and its like may say."""
    beside = [name for name in encoding_names() if name.startswith(("criteria/", "constraints/"))]
    ours = frozenset().union(*(vocabulary(name) for name in (*_ALWAYS_THERE, *_BESIDE, *beside)))
    known = frozenset().union(*(vocabulary(name) for name in _ALWAYS_THERE), TREE_HEADS) - _OURS_ALONE
    names = frozenset(name for name, _ in ours)
    return Purpose(None, TREE_HEADS, known, _OURS_ALONE, names, "is not available here; see encodings/")


@cache
def for_queries() -> Purpose:
    """Return what the rules of a query may say."""
    known = vocabulary(ASK) - _FOR_TREES_ALONE
    there = ", ".join(f"{name}/{arity}" for name, arity in sorted(known))
    advice = f"is not available in a query, where nothing is decided; there are {there}"
    names = frozenset(name for name, _ in known)
    return Purpose(ASK, QUERY_HEADS, known, _FOR_TREES_ALONE, names, advice)


PURPOSES = {"trees": for_trees, "queries": for_queries}
"""What rules can be meant for."""
