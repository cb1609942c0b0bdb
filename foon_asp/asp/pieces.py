"""What clingo grounds of a piece of a problem, a unit or a goal: grounded once, kept for the next question.

Most encodings look at one unit at a time. What clingo makes of them is then the same for a unit in whatever
question, and for all units of which the same is said: only the numbers differ. So the ground program of a
question can be joined of pieces that were grounded before (`foon_asp.asp.joined`).
"""

from __future__ import annotations

import re
import threading
from collections import OrderedDict, defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import clingo

from foon_asp import limits
from foon_asp.asp.encodings import encoding_files, encoding_text
from foon_asp.asp.facts import COST
from foon_asp.asp.model import ProgramError
from foon_asp.errors import InternalError

MOST = 8192
"""How many grounded pieces are kept; each takes one or two kilobytes."""

_AT_ONCE = 500
"""How many pieces are grounded at once: clingo cannot be stopped in between."""

_OPEN = frozenset({"use", "at_hand"})
"""What pieces decide of each other. All else that names a unit or an object is of one piece alone."""

_BOUNDARY = """
#external at_hand(O) : needs(_,O), not kitchen(O).
#external at_hand(O) : goal(O), not kitchen(O).
"""
"""What a piece needs may be made by others."""

_NAME = re.compile(r'"(?:[^"\\]|\\.)*"|\b([uo])(\d+)\b')
_NUMBERED = re.compile(r'"(?:[^"\\]|\\.)*"|\b[uo](\d+)_(\d+)\b')


class Kind(NamedTuple):
    """What pieces are grounded with: encodings, values of constants, and facts that name no id."""

    encodings: tuple[str, ...]
    constants: tuple[tuple[str, str | int], ...]
    facts: str


class Statement(NamedTuple):
    """A ground statement in aspif, with `%d` for each of some atoms, or for the cost of a piece."""

    text: str
    atoms: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class Block:
    """The ground program of a piece.

    Its atoms are, in this order, `own` ones of which no other piece knows, those of `open` (a predicate, and
    which of the piece's ids it is about), and `shared` ones, which name no id. `statement` names them by
    their places, and behind the last one stands the cost of the piece. Those in `common` are about shared
    atoms alone; they stand once in a program. `shown` says how atoms are shown, with a place for each id.
    """

    own: int
    open: tuple[tuple[str, int], ...]
    shared: tuple[str, ...]
    statement: Statement
    common: tuple[tuple[str, tuple[str, ...]], ...]
    shown: tuple[tuple[str, int], ...]


class Kept:
    """Blocks by kind and text, so many at most: those that were not used for longest go. For all threads."""

    def __init__(self, most: int) -> None:
        self._most = most
        self._blocks: OrderedDict[tuple[Kind, str], Block] = OrderedDict()
        self._lock = threading.Lock()

    def take(self, kind: Kind, texts: Iterable[str]) -> dict[str, Block]:
        """Return those of the blocks that are there."""
        found = {}
        with self._lock:
            for text in texts:
                block = self._blocks.get((kind, text))
                if block is not None:
                    self._blocks.move_to_end((kind, text))
                    found[text] = block
        return found

    def put(self, kind: Kind, blocks: Mapping[str, Block]) -> None:
        """Keep blocks."""
        with self._lock:
            for text, block in blocks.items():
                self._blocks[kind, text] = block
            while len(self._blocks) > self._most:
                self._blocks.popitem(last=False)

    def __len__(self) -> int:
        return len(self._blocks)


KEPT = Kept(MOST)


def blocks(kind: Kind, texts: Iterable[str], kept: Kept = KEPT) -> dict[str, Block]:
    """Return the ground programs of pieces, of which `texts` say what they are.

    An empty text stands for what a program has without any piece. In the others ids are constants, `u0` for
    a unit and `o1` for an object that are the first and the second id of the piece. Raises `ProgramError`.
    """
    wanted = dict.fromkeys(texts)
    found = kept.take(kind, wanted)
    missing = [text for text in wanted if text not in found]
    for start in range(0, len(missing), _AT_ONCE):
        limits.check()
        made = dict(_grounded(kind, missing[start : start + _AT_ONCE]))
        kept.put(kind, made)
        found |= made
    return found


def _grounded(kind: Kind, texts: Sequence[str]) -> Iterator[tuple[str, Block]]:
    """Ground pieces beside each other, and tell apart what is of which."""
    said: list[str] = []
    arguments = [part for name, value in kind.constants for part in ("-c", f"{name}={value}")]
    control = clingo.Control(arguments, lambda _, message: said.append(message.strip()))
    program = _Program()
    control.register_observer(program)
    numbered = (_numbered(text, number) for number, text in enumerate(texts))
    parts = [*map(encoding_text, encoding_files(kind.encodings)), kind.facts, _BOUNDARY, *numbered]
    try:
        control.add("base", [], "\n".join(parts))
        control.ground([("base", [])])
    except RuntimeError as error:
        raise ProgramError(" / ".join(said) or str(error)) from None
    if said:
        raise ProgramError(" / ".join(said))
    program.names = {atom.literal: atom.symbol for atom in control.symbolic_atoms}
    split = _Split(program)
    for number, text in enumerate(texts):
        yield text, split.block(number if text else _BASE)


def _numbered(text: str, piece: int) -> str:
    """Return the text of a piece with names for its ids that no other piece has."""
    return _NAME.sub(lambda found: f"{found[1]}{piece}_{found[2]}" if found[1] else found[0], text)


_BASE = -1
"""Stands among the numbers of pieces for what a program has without any."""

_COST = 0
"""Stands among the numbers of atoms for what it costs that a unit may fail."""


class _Program(clingo.Observer):
    """What clingo says of a program that it grounds."""

    def __init__(self) -> None:
        self.defined: list[tuple[Statement, tuple[int, ...]]] = []
        self.shown: list[tuple[clingo.Symbol, int]] = []
        self.names: dict[int, clingo.Symbol] = {}

    def rule(self, choice: bool, head: Sequence[int], body: Sequence[int]) -> None:
        parts = ["1", str(int(choice)), str(len(head)), *["%d"] * len(head), "0", str(len(body))]
        parts += ["%d" if literal > 0 else "-%d" for literal in body]
        self._add(" ".join(parts), head, (*head, *map(abs, body)))

    def minimize(self, priority: int, literals: Sequence[tuple[int, int]]) -> None:
        for literal, weight in literals:
            sign = "" if literal > 0 else "-"
            paid, atoms = ("%d", (_COST,)) if weight == COST else (str(weight), ())
            self._add(f"2 {priority} 1 {sign}%d {paid}", (), (abs(literal), *atoms))

    def output_atom(self, symbol: clingo.Symbol, atom: int) -> None:
        self.shown.append((symbol, atom))

    def weight_rule(self, *_: object) -> None:
        raise InternalError("this encoding counts over several units: it cannot be grounded in pieces")

    def _add(self, text: str, head: Sequence[int], atoms: tuple[int, ...]) -> None:
        self.defined.append((Statement(text, atoms), tuple(head)))


class _Split:
    """A ground program of several pieces, statement by statement in blocks."""

    def __init__(self, program: _Program) -> None:
        self._names = program.names
        self._ids = {atom: tuple(_ids(symbol)) for atom, symbol in program.names.items()}
        used = {atom for statement, head in program.defined for atom in statement.atoms[len(head) :]}
        used.update(atom for _, atom in program.shown)
        # clingo also lists the facts, which it has put to use.
        self._defined = [
            (statement, head)
            for statement, head in program.defined
            if statement.text != _FACT or head[0] in used
        ]
        self._shown = [atom for _, atom in program.shown if atom]
        self._owners: dict[int, set[int]] = {
            atom: {piece for piece, _ in ids} for atom, ids in self._ids.items() if ids
        }
        while self._trace():
            pass
        self._mine: defaultdict[int, list[Statement]] = defaultdict(list)
        self._common: defaultdict[int, list[tuple[str, tuple[str, ...]]]] = defaultdict(list)
        self._definitions: defaultdict[int, list[Statement]] = defaultdict(list)
        for statement, head in self._defined:
            self._sort(statement, head)

    def _trace(self) -> bool:
        """Say of the atoms that name no id because of which pieces they are there; return if that is new."""
        known = sum(map(len, self._owners.values()))
        for statement, head in self._defined:
            owners = self._of(statement) or self._because(statement.atoms[len(head) :])
            for atom in head:
                if not self._ids.get(atom):
                    self._owners.setdefault(atom, set()).update(owners)
        return sum(map(len, self._owners.values())) > known

    def _sort(self, statement: Statement, head: Sequence[int]) -> None:
        """Put a statement to those of the piece, or pieces, because of which it is there."""
        for atom in head:
            self._definitions[atom].append(statement)
        if not all(map(self._is_shared, statement.atoms)):
            self._mine[next(iter(self._of(statement)), _BASE)].append(statement)
            return
        written = statement.text, tuple(map(self._written, statement.atoms))
        for piece in self._because(statement.atoms[len(head) :]) or {_BASE}:
            self._common[piece].append(written)

    def _because(self, atoms: Iterable[int]) -> set[int]:
        return set().union(*(self._owners.get(atom, ()) for atom in atoms))

    def _of(self, statement: Statement) -> set[int]:
        """Return the piece that alone has some atom of a statement; none if it is about shared ones."""
        pieces = self._because(atom for atom in statement.atoms if not self._is_shared(atom))
        if len(pieces) > 1:
            raise InternalError("this encoding looks at several units at once: it has no pieces")
        return pieces

    def _is_shared(self, atom: int) -> bool:
        return atom in self._names and not self._ids[atom]

    def block(self, piece: int) -> Block:
        """Return what there is because of a piece, or because of none."""
        mine = list(self._shortened(self._mine[piece]))
        # clingo's order depends on what is grounded beside a piece.
        mine.sort(key=lambda each: (each.text, [*map(self._written, each.atoms)]))
        atoms = dict.fromkeys(atom for statement in mine for atom in statement.atoms)
        shared = [atom for atom in atoms if self._is_shared(atom)]
        open_ = [atom for atom in atoms if self._is_open(atom)]
        own = [atom for atom in atoms if atom not in {*shared, *open_, _COST}]
        place = {atom: number for number, atom in enumerate([*own, *open_, *shared, _COST])}
        return Block(
            len(own),
            tuple((self._names[atom].name, self._ids[atom][0][1]) for atom in open_),
            tuple(map(self._written, shared)),
            Statement(
                "\n".join(statement.text for statement in mine),
                tuple(place[atom] for statement in mine for atom in statement.atoms),
            ),
            tuple(sorted(self._common[piece])),
            tuple(
                (self._written(atom), place[atom])
                for atom in self._shown
                if atom in place and self._owners.get(atom) == {piece}
            ),
        )

    def _shortened(self, statements: Sequence[Statement]) -> Iterator[Statement]:
        """Leave out atoms that only stand for another one, and name that instead."""
        meant: dict[int, int] = {}
        for statement in statements:
            if statement.text == _SAME and len(self._definitions[statement.atoms[0]]) == 1:
                atom, other = statement.atoms
                if not self._is_shared(atom) and not self._is_open(atom):
                    meant[atom] = meant.get(other, other)
        for text, atoms in statements:
            if text != _SAME or atoms[0] not in meant:
                yield Statement(text, tuple(meant.get(atom, atom) for atom in atoms))

    def _written(self, atom: int) -> str:
        """Write an atom with a place in braces for each id; nothing, if it has no name."""
        return _NUMBERED.sub(_in_braces, str(self._names.get(atom, "")))

    def _is_open(self, atom: int) -> bool:
        return atom in self._names and self._names[atom].name in _OPEN


_FACT = "1 0 1 %d 0 0"
"""How aspif says that an atom is true."""


_SAME = "1 0 1 %d 0 1 %d"
"""How aspif says that an atom is true if another one is."""


def _in_braces(found: re.Match[str]) -> str:
    """Return the place of an id for `str.format`; a text that is no id as it is."""
    return f"{{{found[2]}}}" if found[1] else found[0].replace("{", "{{").replace("}", "}}")


def _ids(symbol: clingo.Symbol) -> Iterator[tuple[int, int]]:
    """Yield piece and place of each id in a term."""
    # To look at each argument would take ten calls of clingo.
    for found in _NUMBERED.finditer(str(symbol)):
        if found[1]:
            yield int(found[1]), int(found[2])
