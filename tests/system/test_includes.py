"""Encodings are those of the program, whatever files lie where it is run."""

from __future__ import annotations

from pathlib import Path

import pytest
from clingo.ast import AST, ASTType, Transformer, parse_string

from foon_asp.asp import encodings
from foon_asp.asp import vocabulary as parsed
from foon_asp.asp.encodings import encoding_files, encoding_names, encoding_text, looked_at
from foon_asp.asp.program import _DETAILS, _RATES
from foon_asp.asp.vocabulary import constants, vocabulary
from foon_asp.io.folder import Dataset
from foon_asp.query.query import Query
from foon_asp.retrieval.retrieve import retrieve


def test_files_of_the_current_folder_are_no_encodings(
    built_in: Dataset, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    world = built_in.world()
    queries = [
        Query("greek salad", by="success"),
        Query("greek salad", by="tools,depth", avoid_motions=["shake"], max_depth=30),
        Query("hummus", method="greedy"),
        Query("hummus", method="ids"),
    ]
    names = encoding_names()
    there = [retrieve(world, query).tree for query in queries]
    read = [(looked_at(name), vocabulary(name), constants(name)) for name in names]
    for name in names:
        for path in (tmp_path / "here" / name, tmp_path / "here" / Path(name).name, tmp_path / name):
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text("hostile(1). :- hostile(1).\n")
    monkeypatch.chdir(tmp_path / "here")
    for cache in (encodings._read, encodings.looked_at, parsed._parsed):
        cache.cache_clear()
    assert [retrieve(world, query).tree for query in queries] == there
    assert [(looked_at(name), vocabulary(name), constants(name)) for name in names] == read


class _Predicates(Transformer):
    """Collects the names of predicates."""

    def __init__(self) -> None:
        self.found: set[str] = set()

    def visit_SymbolicAtom(self, atom: AST) -> AST:  # noqa: N802 - the name is clingo's
        symbol = atom.symbol
        while symbol.ast_type == ASTType.UnaryOperation:
            symbol = symbol.argument
        functions = symbol.arguments if symbol.ast_type == ASTType.Pool else [symbol]
        self.found.update(function.name for function in functions)
        return atom


@pytest.mark.parametrize("name", encoding_names())
def test_what_an_encoding_looks_at_is_what_clingo_reads_in_it(name: str) -> None:
    predicates = _Predicates()

    def look_at(statement: AST) -> None:
        predicates.visit(statement)

    for file in encoding_files([name]):
        if file not in ("units.lp", "vocabulary.lp"):
            parse_string(encoding_text(file), look_at)
    assert predicates.found <= looked_at(name)
    # Functions and constants would have more facts written than are needed.
    assert looked_at(name) & (_DETAILS | _RATES) == predicates.found & (_DETAILS | _RATES)
