"""From facts and encodings to an answer: the only place that drives clingo."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import clingo

from foon_asp import resources
from foon_asp.errors import InternalError

Atom = tuple[str, tuple[int, ...]]


@dataclass(frozen=True, slots=True)
class Answer:
    """The shown atoms of the best model, or none if there is no model.

    `proven` says that no better model exists (or that none exists at all); `costs` are what the model
    pays and `bounds` what every model pays at least, one number for each priority, highest first.
    """

    atoms: tuple[Atom, ...] | None
    proven: bool
    costs: tuple[int, ...] = ()
    bounds: tuple[int, ...] = ()


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
        arguments = [*options]
        for name, value in sorted((constants or {}).items()):
            arguments += ["-c", f"{name}={value}"]
        self._control = clingo.Control(arguments, self._log)
        for encoding in encodings:
            self._control.load(str(resources.encoding(encoding)))
        self._control.add("base", [], facts)
        self.ground("base")

    def _log(self, _: clingo.MessageCode, message: str) -> None:
        self._messages.append(message.strip())

    def ground(self, part: str, *numbers: int) -> None:
        """Ground a part of the program with integer parameters."""
        self._control.ground([(part, [clingo.Number(number) for number in numbers])])
        if self._messages:
            raise InternalError("clingo: " + " / ".join(self._messages))

    def switch(self, external: str, number: int, value: bool) -> None:
        """Set the external atom `external(number)`."""
        self._control.assign_external(clingo.Function(external, [clingo.Number(number)]), value)

    def best(self, deadline: float | None = None) -> Answer:
        """Return the best model, or the best found until the deadline (`time.monotonic()` seconds).

        With a deadline a first model is taken before, whatever it costs and however long it takes: core-
        guided optimisation may prove bounds for long before it has a model.
        """
        if deadline is None:
            return self._solve(None)
        configuration: Any = self._control.configuration
        configuration.solve.opt_mode = "ignore"
        first = self._solve(None)
        configuration.solve.opt_mode = "opt"
        if first.atoms is None:
            return first
        answer = self._solve(deadline)
        if answer.atoms is None:
            return Answer(first.atoms, False, bounds=answer.bounds)
        return answer

    def _solve(self, deadline: float | None) -> Answer:
        found: list[tuple[tuple[Atom, ...], tuple[int, ...]]] = []
        bounds: list[tuple[int, ...]] = []

        def on_model(model: clingo.Model) -> None:
            found[:] = [(_atoms(model), tuple(model.cost))]

        def on_unsat(lower: Sequence[int]) -> None:
            bounds[:] = [tuple(lower)]

        with self._control.solve(on_model=on_model, on_unsat=on_unsat, async_=True) as handle:
            if deadline is None:
                handle.wait()
            elif not handle.wait(max(0.0, deadline - time.monotonic())):
                handle.cancel()
            result = handle.get()
        lower = bounds[0] if bounds else ()
        if not found:
            return Answer(None, bool(result.exhausted), bounds=lower)
        atoms, costs = found[0]
        # Where there is nothing to pay the first model is a best one, and clingo looks no further.
        proven = bool(result.exhausted) or not costs
        return Answer(atoms, proven, costs, costs if proven else lower)


def _atoms(model: clingo.Model) -> tuple[Atom, ...]:
    symbols = sorted(model.symbols(shown=True))
    return tuple((s.name, tuple(argument.number for argument in s.arguments)) for s in symbols)
