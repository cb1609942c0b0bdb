"""What clingo answers, as plain values."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Union

from foon_asp.errors import InternalError
from foon_asp.limits import Limit

Value = Union[int, str, "tuple[Value, ...]"]

Atom = tuple[str, tuple[Value, ...]]


@dataclass(frozen=True, slots=True)
class Model:
    """The shown atoms of the best model, or none if there is no model.

    `proven` says that no better model exists (or that none exists at all); if it is false, `limit` says what
    ended the search. `costs` is what the model pays and `bounds` what is proven of it so far, one number for
    each priority, the highest first; a bound holds among the models that are best by the priorities before.
    clingo leaves out a priority at which nothing can ever be paid; `priorities` are those that are there.
    """

    atoms: tuple[Atom, ...] | None
    proven: bool
    bounds: tuple[int, ...] = ()
    costs: tuple[int, ...] = ()
    priorities: tuple[int, ...] = ()
    limit: Limit | None = None

    def rows(self, predicate: str) -> list[tuple[Value, ...]]:
        """Return the arguments of each atom of a predicate, in clingo's order of terms."""
        return [arguments for name, arguments in self.atoms or () if name == predicate]

    def column(self, predicate: str) -> list[int]:
        """Return the first arguments of a predicate, sorted, each once."""
        return sorted({ids[0] for ids in self.rows(predicate) if isinstance(ids[0], int)})


@dataclass(frozen=True, slots=True)
class Models:
    """Best models; `complete` says that there are no others, else `limit` may say what ended the search."""

    found: tuple[Model, ...]
    complete: bool
    limit: Limit | None = None


class ProgramError(InternalError):
    """clingo does not take a program, or warns of it. Where rules of the user's own are in it, look there."""
