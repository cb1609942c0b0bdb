"""From facts and encodings to an answer: the only place that drives clingo."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any, Union

import clingo

from foon_asp import resources
from foon_asp.errors import InternalError

Value = Union[int, str, "tuple[Value, ...]"]
Atom = tuple[str, tuple[Value, ...]]


@dataclass(frozen=True, slots=True)
class Answer:
    """The shown atoms of the best model, or none if there is no model.

    `proven` says that no better model exists (or that none exists at all). `costs` is what the model pays
    and `bounds` what is proven of it so far, one number for each priority, the highest first; a bound
    holds among the models that are best by the priorities before. clingo leaves out a priority at which
    nothing can ever be paid; `priorities` are those that are there.
    """

    atoms: tuple[Atom, ...] | None
    proven: bool
    bounds: tuple[int, ...] = ()
    costs: tuple[int, ...] = ()
    priorities: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class Answers:
    """Best models; `complete` says that there are no others."""

    found: tuple[Answer, ...]
    complete: bool


class ProgramError(InternalError):
    """clingo does not take a program, or warns of it. Where rules of the user's own are in it, look there."""


class Solver:
    """One clingo control: encodings and facts, grounded part by part."""

    def __init__(
        self,
        encodings: Sequence[str],
        facts: str,
        constants: dict[str, str | int] | None = None,
        options: Sequence[str] = (),
    ) -> None:
        self._messages: list[str] = []
        # Two encodings may well include a third one both; clingo takes it once, and need not say so.
        arguments = ["--warn=no-file-included", *options]
        for name, value in sorted((constants or {}).items()):
            arguments += ["-c", f"{name}={value}"]
        self._control = clingo.Control(arguments, self._log)
        with self._complaints():
            for encoding in encodings:
                self._control.load(str(resources.encoding(encoding)))
            self._control.add("base", [], facts)
        self.ground("base")

    def _log(self, _: clingo.MessageCode, message: str) -> None:
        self._messages.append(message.strip())

    def ground(self, part: str, *numbers: int) -> None:
        """Ground a part of the program with integer parameters."""
        with self._complaints():
            self._control.ground([(part, [clingo.Number(number) for number in numbers])])

    @contextmanager
    def _complaints(self) -> Iterator[None]:
        """Raise all that clingo complains of, be it an error or a mere hint, as one `ProgramError`."""
        try:
            yield
        except RuntimeError as error:
            raise ProgramError(" / ".join(self._messages) or str(error)) from None
        if self._messages:
            raise ProgramError(" / ".join(self._messages))

    def switch(self, external: str, number: int, value: bool) -> None:
        """Set the external atom `external(number)`."""
        self._control.assign_external(clingo.Function(external, [clingo.Number(number)]), value)

    def first(self) -> Answer:
        """Return a first model, whatever it costs, without proving anything of it.

        Core-guided optimisation may prove bounds for long before it has a model; this one is quick.
        """
        configuration: Any = self._control.configuration
        configuration.solve.opt_mode = "ignore"
        answer = self.best()
        configuration.solve.opt_mode = "opt"
        return Answer(answer.atoms, answer.atoms is None)

    def all_best(self, distinct: str, deadline: float | None = None, most: int | None = None) -> Answers:
        """Return all best models, each set of atoms of the predicate `distinct` once, in their order.

        It ends early at the deadline, and once there are `most` models.
        """
        if deadline is not None and time.monotonic() >= deadline:
            return Answers((), False)
        found: dict[tuple[Atom, ...], Answer] = {}

        def on_model(model: clingo.Model) -> bool:
            if model.optimality_proven or not model.cost:
                answer = _answer(model, proven=True)
                found.setdefault(tuple(atom for atom in answer.atoms or () if atom[0] == distinct), answer)
            return most is None or len(found) < most

        exhausted = self._enumerate(on_model, deadline)
        return Answers(tuple(found[atoms] for atoms in sorted(found)), exhausted)

    def best(self, deadline: float | None = None) -> Answer:
        """Return the best model, or the best found until the deadline (`time.monotonic()` seconds)."""
        if deadline is not None and time.monotonic() >= deadline:
            return Answer(None, False)
        found: list[Answer] = []

        def on_model(model: clingo.Model) -> None:
            found[:] = [_answer(model, proven=False)]

        proven = self._run(on_model, deadline)
        if not found:
            return Answer(None, proven, () if proven else self._lower_bounds())
        # Where there is nothing to pay the first model is a best one, and clingo looks no further.
        proven = proven or not found[0].costs
        bounds = found[0].costs if proven else self._lower_bounds()
        return replace(found[0], proven=proven, bounds=bounds)

    def _enumerate(self, on_model: Callable[[clingo.Model], bool | None], deadline: float | None) -> bool:
        """Solve for all best models, each set of shown atoms once, and say whether that was all of them."""
        configuration: Any = self._control.configuration
        configuration.solve.opt_mode, configuration.solve.models = "optN", 0
        configuration.solve.project = "show"
        exhausted = self._run(on_model, deadline)
        configuration.solve.opt_mode, configuration.solve.models = "opt", -1
        configuration.solve.project = "no"
        return exhausted

    def _run(self, on_model: Callable[[clingo.Model], bool | None], deadline: float | None) -> bool:
        """Solve until the deadline, and say whether nothing is left to search."""
        if deadline is None:
            return bool(self._control.solve(on_model=on_model).exhausted)
        with self._control.solve(on_model=on_model, async_=True) as handle:
            if not handle.wait(max(0.0, deadline - time.monotonic())):
                handle.cancel()
            return bool(handle.get().exhausted)

    def _lower_bounds(self) -> tuple[int, ...]:
        """Return what is proven of each priority, of all: the callback for bounds leaves some out."""
        summary: Any = self._control.statistics["summary"]
        return tuple(int(bound) for bound in summary.get("lower", ()))


def _answer(model: clingo.Model, *, proven: bool) -> Answer:
    costs = tuple(model.cost)
    return Answer(_atoms(model), proven, costs if proven else (), costs, tuple(model.priority))


def _atoms(model: clingo.Model) -> tuple[Atom, ...]:
    symbols = sorted(model.symbols(shown=True))
    return tuple((symbol.name, tuple(map(_value, symbol.arguments))) for symbol in symbols)


def _value(symbol: clingo.Symbol) -> Value:
    if symbol.type is clingo.SymbolType.Number:
        return symbol.number
    if symbol.type is clingo.SymbolType.String:
        return symbol.string
    return tuple(map(_value, symbol.arguments))
