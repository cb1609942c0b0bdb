"""The ground program of a question, joined of what clingo grounds of each unit and of each goal.

It is what clingo makes of the encodings and the facts of the question, statement by statement, in an order of
its own: first what is there anyway, then the units as they stand in the file, then the goals. So the answer,
one of several that are as good, does not depend on what was grounded before.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence

from foon_asp.asp.facts import pieces
from foon_asp.asp.pieces import Block, Kind, blocks
from foon_asp.query.problem import Problem
from foon_asp.query.tariff import Tariff


def joined(
    problem: Problem,
    encodings: Sequence[str],
    constants: Mapping[str, str | int],
    criteria: str,
    tariff: Tariff | None = None,
    details: Collection[str] = (),
) -> str:
    """Return the ground program of a founded problem without constraints, in aspif.

    `criteria` are facts that are the same for all units. `tariff` says what chances cost, none of which is 0.
    `details` are the predicates at which the encodings look beside needs and makes.
    """
    said = list(pieces(problem, tariff, details))
    values = {**constants, "labels_only": int(problem.world.labels_only)}
    kind = Kind(tuple(encodings), tuple(sorted(values.items())), criteria)
    grounded = blocks(kind, ["", *(piece.text for piece in said)])
    program = _Joined()
    program.add(grounded[""], (), 0)
    for text, ids, cost in said:
        program.add(grounded[text], ids, cost)
    return program.text()


class _Joined:
    """A ground program that grows piece by piece."""

    def __init__(self) -> None:
        self._lines = ["asp 1 0 0"]
        self._shown: list[str] = []
        self._common: set[tuple[str, tuple[str, ...]]] = set()
        self._atoms: dict[str | tuple[str, int], int] = {}
        self._count = 0

    def add(self, block: Block, ids: Sequence[int], cost: int) -> None:
        """Add the block of a piece about units and objects with these ids."""
        atoms = [*range(self._count + 1, self._count + 1 + block.own)]
        self._count += block.own
        atoms += [self._atom((predicate, ids[place])) for predicate, place in block.open]
        atoms += map(self._atom, block.shared)
        numbers = [*atoms, cost]
        text, order = block.statement
        if text:
            self._lines.append(text % tuple([numbers[place] for place in order]))
        for statement in block.common:
            if statement not in self._common:
                self._common.add(statement)
                text, names = statement
                self._lines.append(text % tuple(map(self._atom, names)))
        for shown, place in block.shown:
            name = shown.format(*ids)
            self._shown.append(f"4 {len(name.encode())} {name} 1 {atoms[place]}")

    def text(self) -> str:
        """Return the program."""
        return "\n".join([*self._lines, *self._shown, "0\n"])

    def _atom(self, key: str | tuple[str, int]) -> int:
        number = self._atoms.get(key)
        if number is None:
            self._count += 1
            number = self._atoms[key] = self._count
        return number
