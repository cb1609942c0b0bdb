"""Programs: which encodings, constants and facts make up a question about task trees."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Sequence
from functools import lru_cache

from foon_asp import resources
from foon_asp.constraints import FREE
from foon_asp.criteria import Level, parse_by
from foon_asp.errors import QueryError
from foon_asp.facts import facts, read_facts
from foon_asp.problem import Problem
from foon_asp.solve import Answer, ProgramError, Solver

OPTIMISE = ("--opt-strategy=usc,oll,stratify",)
"""Core-guided search proves the optima of trees fastest; large weights first, for costs of success."""

_SPLIT = ("--opt-strategy=bb", "--opt-heuristic=sign,model")
"""Branch and bound does better where work is split between a robot and a human."""


def solver(
    problem: Problem,
    encodings: Sequence[str],
    constants: dict[str, str | int],
    *,
    extra_facts: str = "",
    rates_required: bool = False,
) -> Solver:
    """Return a solver for a problem under its constraints.

    Raises `QueryError` if rules of the user's own do not work.
    """
    constants = {**constants, "strict": int(problem.domain.strict)}
    constraints = problem.constraints
    if constraints != FREE:
        encodings = [*encodings, "constraints.lp"]
        rates_required |= constraints.min_success is not None
    if constraints.max_depth is not None:
        constants["horizon"] = max(int(constants.get("horizon", 1)), constraints.max_depth)
        if "criteria/depth.lp" not in encodings:
            # Last of all criteria it changes no choice that another one makes.
            encodings = [*encodings, "criteria/depth.lp"]
            extra_facts += 'criterion("depth",-1).\n'
    human = constraints.human_steps is not None or "criteria/human.lp" in encodings
    looked_at = frozenset().union(*map(_looked_at, encodings))
    if problem.whole or constraints.rules or looked_at & _DETAILS:
        text = facts(problem, rates_required=rates_required)
    else:
        # A small question takes most of its time to be written and read.
        text = read_facts(problem, rates="success_rate" in looked_at, rates_required=rates_required)
    text += extra_facts
    try:
        return Solver(
            encodings, "\n".join([text, *constraints.rules]), constants, _SPLIT if human else OPTIMISE
        )
    except ProgramError as error:
        if not constraints.rules:
            raise
        lines = (line.strip() for line in str(error).splitlines())
        problems = " ".join(line.split(": ", 1)[-1] for line in lines if line)
        raise QueryError(f"the rules do not work: {problems}") from None


# An encoding that joins needs/2 with kitchen/1 would look closer, too, for the shorter facts leave out what
# the kitchen has. There is none, but for those that only say what is at hand.
_DETAILS = frozenset(
    {
        "input",
        "output",
        "object",
        "label",
        "state",
        "relation",
        "content",
        "utensil",
        "motion",
        "start",
        "end",
    }
)
_COMMENT = re.compile(r"%\*.*?\*%|%[^\n]*", re.DOTALL)
_INCLUDE = re.compile(r'#include "([^"]+)"')
_PREDICATE = re.compile(r"\b([a-z_]+)\(")


@lru_cache
def _looked_at(encoding: str) -> frozenset[str]:
    """Return the predicates in an encoding and those that it includes, but for the readings of units."""
    if encoding in ("units.lp", "vocabulary.lp"):
        return frozenset()
    rules = _COMMENT.sub("", resources.encoding(encoding).read_text(encoding="utf-8"))
    folder = posixpath.dirname(encoding)
    included = (posixpath.normpath(posixpath.join(folder, name)) for name in _INCLUDE.findall(rules))
    return frozenset(_PREDICATE.findall(rules)).union(*map(_looked_at, included))


def all_levels(levels: Sequence[Level]) -> tuple[Level, ...]:
    """Return the levels that were asked for; the last one sees to it that no unit is superfluous."""
    asked = {name for level in levels for name in level.names}
    return tuple(levels) if "units" in asked else (*levels, *parse_by("units"))


def optimisers(
    problem: Problem,
    levels: Sequence[Level],
    *,
    encodings: Sequence[str] = ("task_tree.lp",),
    extra_facts: str = "",
) -> Iterator[Solver]:
    """Yield solvers that minimise some levels, the first of them with the highest priority.

    `encodings` decide what a tree is. Take the first solver whose answer is not `too_deep`. The depth of a
    tree beyond the horizon counts for less than it is, so such a tree may win, but no tree can lose to it
    wrongly: an answer within the horizon is a best one. Each solver has twice the horizon of the one
    before, until no tree can be deeper; if the depth does not matter the first solver is the only one.
    """
    names = [name for level in levels for name in level.names]
    lines = []
    for place, level in enumerate(levels):
        priority = len(levels) - place
        for name, weight in level.weights.items():
            lines.append(f'criterion("{name}",{priority}).')
            if weight != 1:
                lines.append(f'factor("{name}",{weight}).')
        least = min(level.weights, key=level.weights.__getitem__)
        lines.append(f'penalty("{least}","base",1).')
    deepest = len(problem.units) if "depth" in names else 1
    rounds = problem.domain.closure.available
    horizon = max((rounds.get(goal, 1) for goal in problem.goals), default=1)
    while True:
        yield solver(
            problem,
            [*encodings, *(f"criteria/{name}.lp" for name in names)],
            {"founded": int(problem.founded), "horizon": min(horizon, deepest)},
            extra_facts="\n".join(lines) + "\n" + extra_facts,
            rates_required="success" in names,
        )
        if horizon >= deepest:
            return
        horizon *= 2


def too_deep(*answers: Answer) -> bool:
    """Say whether some answer does not know how deep its tree is, so that a larger horizon is needed."""
    return any(name == "too_deep" for answer in answers for name, _ in answer.atoms or ())
