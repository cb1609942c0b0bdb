"""How the encodings are written."""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

import clingo
import pytest
from clingo.ast import AST, ASTType, Transformer

from foon_asp.asp.encodings import encoding_path
from foon_asp.asp.facts import facts
from foon_asp.model.node import ObjectId
from foon_asp.query.problem import Problem
from support.encoding_files import FILES, NAMES, Signature, heads, of_type, shown
from support.models import load
from support.small_foons import node, world

DOCUMENTED = re.compile(r"^%\*! (\w+)\(([^)]*)\)$", re.MULTILINE)
DEFINED = re.compile(r"^#defined (\w+)/(\d+)\.", re.MULTILINE)
LETTERS = {
    "U": "unit",
    "V": "another unit",
    "O": "object",
    "N": "needed object",
    "P": "another object",
    "G": "goal",
    "L": "label",
    "C": "content",
    "D": "depth",
    "E": "another depth",
    "T": "time",
    "S": "start of a time, or a state",
    "R": "rate",
    "I": "the place in a list",
    "K": "how many",
    "W": "world",
}
"""The one-letter variables; anything else is a word."""


def signatures(pattern: re.Pattern[str], text: str) -> list[Signature]:
    return [(name, int(arity)) for name, arity in pattern.findall(text)]


def documented(paths: Iterable[Path]) -> set[Signature]:
    comments = (match for path in paths for match in DOCUMENTED.findall(path.read_text("utf-8")))
    return {(name, len(arguments.split(","))) for name, arguments in comments}


def sentence_above(lines: list[str], line: int) -> str:
    """Return the block of plain comment lines right above a line (counted from 1), joined."""
    block: list[str] = []
    for text in reversed(lines[: line - 1]):
        if not text.startswith("% "):
            break
        block.append(text[2:].strip())
    return " ".join(reversed(block))


def test_the_folder_of_encodings_is_found() -> None:
    assert {"vocabulary.lp", "units.lp", "retrieval/task_tree.lp", "criteria/units.lp"} <= set(NAMES)


@pytest.mark.parametrize("path", FILES, ids=NAMES)
class TestStyle:
    def test_the_header_says_purpose_input_output_and_constants(self, path: Path) -> None:
        header = path.read_text("utf-8").split("\n\n")[0].splitlines()
        assert all(line.startswith("%") for line in header)
        fields = [match[1] for line in header if (match := re.match(r"% ([A-Z][a-z]+): +\S", line))]
        constants = ["Const"] if of_type(path, ASTType.Definition) else []
        assert fields == ["Purpose", "Input", "Output", *constants]

    def test_the_header_names_every_constant(self, path: Path) -> None:
        header = path.read_text("utf-8").split("\n\n")[0]
        for constant in of_type(path, ASTType.Definition):
            assert re.search(rf"^%(?: Const:)? +{constant.name} +- ", header, re.MULTILINE)

    def test_it_is_said_what_a_constraint_forbids_and_what_is_minimised(self, path: Path) -> None:
        lines = path.read_text("utf-8").splitlines()
        for rule in of_type(path, ASTType.Rule, ASTType.Minimize):
            line = rule.location.begin.line
            sentence = sentence_above(lines, line)
            if rule.ast_type == ASTType.Minimize:
                assert re.fullmatch(r"Minimised.*\.", sentence), f"{path.name}:{line}: {rule}"
            elif str(rule.head) == "#false":
                assert re.fullmatch(r"Forbidden.*\.", sentence), f"{path.name}:{line}: {rule}"

    def test_no_sentence_says_less_than_its_rule(self, path: Path) -> None:
        """A rule needs no sentence; one that has some has something to say, in more than a few words."""
        lines = path.read_text("utf-8").splitlines()
        for rule in of_type(path, ASTType.Rule):
            sentence = sentence_above(lines, rule.location.begin.line)
            assert not sentence or len(sentence) > 35, f"{path.name}: {sentence}"

    def test_derived_and_shown_predicates_are_documented(self, path: Path) -> None:
        derived = {head for rule in of_type(path, ASTType.Rule) for head in heads(rule)}
        assert derived | shown(path) <= documented(FILES)

    def test_a_predicate_is_documented_once_in_a_file_and_before_its_rules(self, path: Path) -> None:
        text = path.read_text("utf-8")
        places = [
            ((match[1], len(match[2].split(","))), text.count("\n", 0, match.start()) + 1)
            for match in DOCUMENTED.finditer(text)
        ]
        assert len(places) == len(dict(places))
        for rule in of_type(path, ASTType.Rule):
            for head in heads(rule) & dict(places).keys():
                assert dict(places)[head] < rule.location.begin.line

    def test_variables_are_the_letters_of_the_house_or_words(self, path: Path) -> None:
        found: set[str] = set()

        class Variables(Transformer):
            def visit_Variable(self, variable: AST) -> AST:  # noqa: N802 - the name is clingo's
                found.add(variable.name)
                return variable

        for rule in of_type(path, ASTType.Rule, ASTType.Minimize):
            Variables().visit(rule)
        assert {name for name in found if len(name) == 1} <= {*LETTERS, "_"}

    def test_lines_are_short_and_there_are_no_scripts(self, path: Path) -> None:
        text = path.read_text("utf-8")
        assert max(map(len, text.splitlines())) <= 110
        assert not of_type(path, ASTType.Script)
        assert "#script" not in text


@pytest.mark.parametrize("path", FILES, ids=NAMES)
def test_every_aim_has_a_name(path: Path) -> None:
    """Either it sums payments by criterion, or the first of its terms is a text: the name."""
    for aim in of_type(path, ASTType.Minimize):
        first = str(aim.terms[0]) if aim.terms else ""
        assert first == "Criterion" or re.fullmatch(r'"[a-z ]+"', first), f"{path.name}: {aim}"


def test_every_input_predicate_is_documented_in_the_vocabulary() -> None:
    vocabulary = encoding_path("vocabulary.lp")
    inputs = signatures(DEFINED, vocabulary.read_text("utf-8"))
    assert len(inputs) == len(set(inputs)) == 27
    assert set(inputs) == documented([vocabulary])


def test_every_fact_that_is_written_belongs_to_the_vocabulary() -> None:
    where = world(
        ["onion + (knife) + bowl{onion} -cut-> onion[chopped]@bowl"],
        "onion + (knife) + bowl{onion}",
        utensils=["bowl"],
    )
    text = facts(Problem(where, (ObjectId(0),), whole=True))
    found = {(atom, 1 + arguments.count(",")) for atom, arguments in re.findall(r"(\w+)\(([^)]*)\)\.", text)}
    vocabulary = encoding_path("vocabulary.lp").read_text("utf-8")
    assert len(found) >= 11
    assert found <= set(signatures(DEFINED, vocabulary))


PARTS = {
    "retrieval/ids.lp": (("check", 0), ("step", 1), ("check", 1), ("choose", 1)),
    "planning/plan.lp": (("check", 0), ("step", 1), ("check", 1), ("cheapest", 1)),
    "planning/plan_pruning.lp": (("check", 0), ("step", 1), ("check", 1), ("cheapest", 1)),
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("full", [False, True], ids=["no facts", "facts"])
def test_clingo_has_nothing_to_warn_of(name: str, full: bool) -> None:
    said: list[str] = []
    control = clingo.Control(
        ["--warn=all", "--warn=no-file-included"], lambda _, message: said.append(message)
    )
    load(control, ["retrieval/task_tree.lp", name] if name.startswith("criteria/") else [name])
    if full:
        where = world(["onion + (knife) -cut-> soup"], "onion + (knife)")
        criterion = f'criterion("{Path(name).stem}",1).'
        control.add("base", [], facts(Problem.of(where, [node("soup")])) + criterion)
    control.ground([("base", [])])
    for part, number in PARTS.get(name, ()):
        control.ground([(part, [clingo.Number(number)])])
    assert said == []


def test_clingo_has_nothing_to_warn_of_at_the_bound_0() -> None:
    said: list[str] = []
    control = clingo.Control(["--warn=all"], lambda _, message: said.append(message))
    control.load(str(encoding_path("retrieval/ids.lp")))
    control.add("base", [], facts(Problem.of(world(["onion -cut-> soup"], "soup"), [node("soup")])))
    control.ground([("base", [])])
    for part in ("check", "choose"):
        control.ground([(part, [clingo.Number(0)])])
    assert said == []
