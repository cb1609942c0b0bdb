"""One clingo control: a program, grounded part by part, and its models. Only this module drives clingo.

Whatever it does ends soon after a limit is reached (`foon_asp.limits`), but for grounding, at which clingo
cannot be stopped: that is what `foon_asp.asp.process` is for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import clingo

from foon_asp import limits
from foon_asp.asp.chance import ExactChance, LeastChance
from foon_asp.asp.model import Atom, Model, Models, ProgramError, Value
from foon_asp.asp.terms import Function, Row, Term
from foon_asp.limits import SLICE, Limit

Progress = Callable[[Model], None]
"""Is told of each better model, in a thread of clingo."""


@dataclass(frozen=True, slots=True)
class Program:
    """What clingo is given: the texts of a program, values of constants, and options.

    If it is `ground` already, its only text is in aspif, and clingo is not to ground it again. With `timed`
    its texts may have difference constraints, `&diff { x-y } <= d`, and models say `dl(x,value)` of each
    variable.
    """

    texts: tuple[str, ...]
    constants: Mapping[str, str | int]
    options: tuple[str, ...] = ()
    ground: bool = False
    timed: bool = False


@dataclass(frozen=True, slots=True)
class Shown:
    """What a model shows: the rows of some predicates, each in clingo's order, and the terms of `#show`."""

    tables: tuple[tuple[Row, ...], ...]
    terms: Row


@dataclass(frozen=True, slots=True)
class Look:
    """What the best models show.

    `shown` is of the best model so far, None if there is none; `costs` is what it pays. `best`: none is
    better. `others`: another one that is as good shows something else. `exhausted`: all were seen.
    """

    shown: Shown | None
    costs: tuple[int, ...]
    best: bool
    others: bool
    exhausted: bool
    limit: Limit | None = None


class Control:
    """One clingo control in this process."""

    def __init__(self, program: Program) -> None:
        """Ground the base part. Raises `ProgramError`."""
        self._messages: list[str] = []
        arguments = list(program.options)
        for name, value in sorted(program.constants.items()):
            arguments += ["-c", f"{name}={value}"]
        self._control = clingo.Control(arguments, self._log)
        self._theory = _difference_logic() if program.timed else None
        with self._complaints():
            if self._theory is not None:
                self._theory.register(self._control)
            for text in program.texts:
                self._add(text)
        if not program.ground:
            self.ground("base")

    def _log(self, _: clingo.MessageCode, message: str) -> None:
        self._messages.append(message.strip())

    def _add(self, text: str) -> None:
        """Add a text; one with difference constraints goes through the theory, which rewrites them."""
        theory = self._theory
        if theory is None or "&diff" not in text:
            self._control.add("base", [], text)
            return
        # It takes a while to load, and most questions need none of it.
        from clingo.ast import ProgramBuilder, parse_string

        with ProgramBuilder(self._control) as builder:
            parse_string(text, lambda each: theory.rewrite_ast(each, builder.add), logger=self._log)

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

    def extend(self, part: str, text: str) -> None:
        """Add a part to the program, and ground it."""
        self._control.add(part, [], text)
        self.ground(part)

    def watch(self, rates: Iterable[tuple[int, float]], least: float, name: str, human_steps: int) -> None:
        """Let only models pass that succeed with a chance, as `foon_asp.asp.chance` says."""
        self._control.register_propagator(ExactChance(LeastChance(dict(rates), least, name, human_steps)))

    def switch(self, external: str, number: int, value: bool) -> None:
        """Set the external atom `external(number)`."""
        self._control.assign_external(clingo.Function(external, [clingo.Number(number)]), value)

    def first(self) -> Model:
        """Return a first model, whatever it costs, without proving anything of it.

        Core-guided optimisation may prove bounds for long before it has a model; this one is quick. So it has
        a moment even where no time is left.
        """
        configuration: Any = self._control.configuration
        configuration.solve.opt_mode = "ignore"
        with limits.moment():
            answer = self.best()
        configuration.solve.opt_mode = "opt"
        return Model(answer.atoms, answer.limit is None and answer.atoms is None, limit=answer.limit)

    def best(self, progress: Progress | None = None) -> Model:
        """Return the best model, or the best until a limit."""
        found: list[_Seen] = []

        def on_model(model: clingo.Model) -> None:
            if self._theory is not None:
                self._theory.on_model(model)
            # Most models are not the last one: what they say is read when that is known.
            found[:] = [_Seen.of(model)]
            if progress is not None:
                progress(found[0].model())

        proven, limit = self._run(on_model)
        if not found:
            return Model(None, proven, () if proven else self._lower_bounds(), limit=limit)
        # Where there is nothing to pay the first model is a best one, and clingo looks no further.
        proven = proven or not found[0].costs
        bounds = found[0].costs if proven else self._lower_bounds()
        return replace(found[0].model(), proven=proven, bounds=bounds, limit=None if proven else limit)

    def possible(self) -> Model:
        """Return what some model shows, all such atoms together; `proven` says that these are all.

        A program that minimises something is not asked this.
        """
        configuration: Any = self._control.configuration
        configuration.solve.enum_mode, configuration.solve.models = "brave", 0
        answer = self.best()
        configuration.solve.enum_mode, configuration.solve.models = "auto", -1
        return replace(answer, proven=answer.limit is None)

    def all_best(self, distinct: str, most: int | None = None) -> Models:
        """Return all best models, each set of atoms of the predicate `distinct` once, in their order.

        It ends early at a limit, and once there are `most` models.
        """
        found: dict[tuple[Atom, ...], Model] = {}

        def on_model(model: clingo.Model) -> bool:
            if model.optimality_proven or not model.cost:
                answer = _answer(model, proven=True)
                found.setdefault(tuple(atom for atom in answer.atoms or () if atom[0] == distinct), answer)
            return most is None or len(found) < most

        exhausted, limit = self._each_best(on_model)
        return Models(tuple(found[atoms] for atoms in sorted(found)), exhausted, limit)

    def look(self, predicates: Sequence[tuple[str, int]]) -> Look:
        """Look at the best models until two show something else: some predicates, and what is no atom.

        A predicate that is negated classically has `-` before its name.
        """
        literals = [self._possible(name, arity) for name, arity in predicates]
        shown: Shown | None = None
        costs: tuple[int, ...] = ()
        found = others = False

        def on_model(model: clingo.Model) -> bool:
            nonlocal shown, costs, found, others
            rows = (
                tuple(symbol for symbol, literal in pairs if model.is_true(literal)) for pairs in literals
            )
            now = Shown(
                tuple(tuple(tuple(map(_term, symbol.arguments)) for symbol in table) for table in rows),
                tuple(map(_term, sorted(model.symbols(terms=True)))),
            )
            best = model.optimality_proven or not model.cost
            if not found:
                shown, costs, found = now, tuple(model.cost), best
            elif best and now != shown:
                others = True
            return not others

        exhausted, limit = self._each_best(on_model)
        return Look(shown, costs, found, others, exhausted, limit)

    def derived(self, predicates: Sequence[tuple[str, int]]) -> tuple[tuple[Row, ...], ...]:
        """Return the rows of some predicates that can be true in some model."""
        atoms = (self._possible(name, arity) for name, arity in predicates)
        return tuple(tuple(tuple(map(_term, symbol.arguments)) for symbol, _ in each) for each in atoms)

    def _possible(self, name: str, arity: int) -> list[tuple[clingo.Symbol, int]]:
        """Return the atoms of a predicate that can be true, with their literals."""
        atoms = self._control.symbolic_atoms
        found = atoms.by_signature(name.lstrip("-"), arity, not name.startswith("-"))
        return [(atom.symbol, atom.literal) for atom in found]

    def _each_best(self, on_model: Callable[[clingo.Model], bool]) -> tuple[bool, Limit | None]:
        """Hand over all best models, each set of shown atoms once, and say whether that was all of them.

        Models that are not proven to be best come first, where something is optimised. It ends early at a
        limit, and when `on_model` returns False.
        """
        configuration: Any = self._control.configuration
        configuration.solve.opt_mode, configuration.solve.models = "optN", 0
        configuration.solve.project = "show"
        ended = self._run(on_model)
        configuration.solve.opt_mode, configuration.solve.models = "opt", -1
        configuration.solve.project = "no"
        return ended

    def _run(self, on_model: Callable[[clingo.Model], bool | None]) -> tuple[bool, Limit | None]:
        """Solve, and say whether nothing is left to search, and which limit ended it."""
        limit = limits.reached()
        if limit is not None:
            return False, limit
        if self._theory is not None:
            self._theory.prepare(self._control)
        if not limits.may_end_early():
            # A thread of its own costs a fifth of a small question.
            return bool(self._control.solve(on_model=on_model).exhausted), None
        # clingo solves in a thread of its own, so that no signal comes in the middle of `on_model`.
        with limits.waiting(), self._control.solve(on_model=on_model, async_=True) as handle:
            while not handle.wait(min(SLICE, limits.seconds_left())):
                limit = limits.reached()
                if limit is not None:
                    handle.cancel()
                    break
            exhausted = bool(handle.get().exhausted)
        return exhausted, None if exhausted else limit

    def _lower_bounds(self) -> tuple[int, ...]:
        """Return what is proven of each priority, of all: the callback for bounds leaves some out."""
        summary: Any = self._control.statistics["summary"]
        return tuple(int(bound) for bound in summary.get("lower", ()))


@dataclass(frozen=True, slots=True)
class _Seen:
    """What a model of clingo shows and pays; there is no such model once the search goes on."""

    shown: Sequence[clingo.Symbol]
    costs: tuple[int, ...]
    priorities: tuple[int, ...]

    @classmethod
    def of(cls, model: clingo.Model) -> _Seen:
        return cls(model.symbols(shown=True, theory=True), tuple(model.cost), tuple(model.priority))

    def model(self) -> Model:
        """Return it as plain values, of which nothing is proven."""
        return Model(_atoms(self.shown), False, (), self.costs, self.priorities)


def _difference_logic() -> Any:
    """Return the theory of difference constraints, of clingo-dl."""
    # It is loaded for schedules alone.
    from clingodl import ClingoDLTheory

    theory: Any = ClingoDLTheory
    return theory()


def _answer(model: clingo.Model, *, proven: bool) -> Model:
    seen = _Seen.of(model)
    return replace(seen.model(), proven=proven, bounds=seen.costs if proven else ())


def _atoms(symbols: Sequence[clingo.Symbol]) -> tuple[Atom, ...]:
    """Return atoms in clingo's order: by the number of arguments, by name, by arguments."""
    atoms = [(symbol.name, tuple(map(_value, symbol.arguments))) for symbol in symbols]
    if all(isinstance(value, int) for _, values in atoms for value in values):
        # Numbers are in order as they are; to ask clingo of each pair takes as long as a small search.
        return tuple(sorted(atoms, key=lambda atom: (len(atom[1]), atom)))
    return tuple((symbol.name, tuple(map(_value, symbol.arguments))) for symbol in sorted(symbols))


def _value(symbol: clingo.Symbol) -> Value:
    if symbol.type is clingo.SymbolType.Number:
        return symbol.number
    if symbol.type is clingo.SymbolType.String:
        return symbol.string
    return tuple(map(_value, symbol.arguments))


def _term(symbol: clingo.Symbol) -> Term:
    if symbol.type is clingo.SymbolType.Number:
        return symbol.number
    if symbol.type is clingo.SymbolType.String:
        return symbol.string
    if symbol.type is not clingo.SymbolType.Function:
        return Function(str(symbol))
    arguments = tuple(map(_term, symbol.arguments))
    if not symbol.name:
        return arguments
    return Function(("" if symbol.positive else "-") + symbol.name, arguments)
