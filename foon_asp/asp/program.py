"""Programs: which encodings, constants and facts make up a question about task trees."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from foon_asp.asp.control import Program
from foon_asp.asp.encodings import looked_at
from foon_asp.asp.facts import facts, read_facts
from foon_asp.asp.joined import joined
from foon_asp.asp.model import Model
from foon_asp.asp.solver import Solver, open_program, open_solver
from foon_asp.query.constraints import FREE
from foon_asp.query.objective import Objective
from foon_asp.query.problem import Problem
from foon_asp.query.tariff import Tariff, success_tariff

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
    tariff: Tariff | None = None,
) -> Solver:
    """Return a solver for a problem under its constraints; with a tariff, chances cost what it says.

    Raises `InputError` for rules of the user's own that are refused, `QueryError` if they do not work, or a
    unit has no rate where that matters.
    """
    constants = {**constants, "strict": int(problem.world.strict)}
    constraints = problem.constraints
    if constraints != FREE:
        encodings = [*encodings, "constraints/constraints.lp"]
    if constraints.min_success is not None:
        tariff = tariff or success_tariff(problem)
    if constraints.max_depth is not None and _binds(problem, constraints.max_depth):
        enough = min(constraints.max_depth, len(problem.units))
        constants["horizon"] = max(int(constants.get("horizon", 1)), enough)
        encodings = [*encodings, "criteria/rounds.lp"]
    human = constraints.human_steps is not None or "criteria/human.lp" in encodings
    named = frozenset().union(*map(looked_at, encodings))
    details = named & _DETAILS
    if _in_pieces(problem, encodings, tariff):
        text = joined(problem, encodings, constants, extra_facts, tariff, details)
        return open_program(Program((text,), {}, OPTIMISE, ground=True))
    if problem.whole or constraints.rules or details:
        text = facts(problem, tariff)
    else:
        # A small question takes most of its time to be written and read.
        text = read_facts(problem, tariff, rates=bool(named & _RATES), costs="costs" in named)
    text += extra_facts
    options = _SPLIT if human else OPTIMISE
    if constraints.rules:
        # Most questions have no rules, and clingo's parser and all that looks at rules take a while to load.
        from foon_asp.asp.own_rules import solver_with_rules

        control = solver_with_rules(constraints, text, encodings, constants, options)
    else:
        control = open_solver(encodings, text, constants, options)
    if constraints.min_success is not None:
        _watch(control, problem)
    return control


_BY_UNITS = ("units", "success", "inputs", "motions", "tools", "dirty", "time")
_IN_PIECES = frozenset({"retrieval/task_tree.lp", *(f"criteria/{name}.lp" for name in _BY_UNITS)})
"""Encodings of which no rule looks at two units at once, but for what they take and make."""


def _in_pieces(problem: Problem, encodings: Iterable[str], tariff: Tariff | None) -> bool:
    """Whether what clingo grounds of each unit alone is all that it grounds of a problem."""
    plain = problem.founded and not problem.whole and not problem.switched
    # Pieces say nothing of what counts as something else.
    plain = plain and not problem.world.units.loose
    return plain and _IN_PIECES.issuperset(encodings) and (tariff is None or not tariff.ruin)


def _binds(problem: Problem, most_rounds: int) -> bool:
    """Whether rounds need be counted: no tree takes more of them than it has units, but a circle does."""
    return most_rounds < len(problem.units) or not problem.founded or bool(problem.constraints.rules)


def _watch(control: Solver, problem: Problem) -> None:
    """Let no tree pass that is less likely to succeed than it must, by however little."""
    constraints = problem.constraints
    [(name, least)] = [
        (name, least) for atom, name, (least, *_) in constraints.named() if atom == "max_failure"
    ]
    rates = {int(unit): problem.world.kitchen.rate(problem.world.foon.units[unit]) for unit in problem.units}
    control.watch(list(rates.items()), float(least), name, constraints.human_steps or 0)


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
        "duration",
    }
)


_RATES = frozenset({"success_rate", "fails", "never_succeeds", "finer"})
"""What is said of the success rates of units."""


def optimisers(
    problem: Problem,
    priced: Sequence[Tariff],
    *,
    encodings: Sequence[str] = ("retrieval/task_tree.lp",),
    extra_facts: str = "",
) -> Iterator[Solver]:
    """Yield solvers that minimise criteria, the first one with the highest priority, as their tariffs say.

    `encodings` decide what a tree is. Take the first solver whose answer is not `too_deep`. The depth of a
    tree beyond the horizon counts for less than it is, so such a tree may win, but no tree can lose to it
    wrongly: an answer within the horizon is a best one. Each solver has twice the horizon of the one
    before, until no tree can be deeper; if the depth does not matter the first solver is the only one.
    """
    objective = Objective(tuple(tariff.criterion for tariff in priced))
    names = [name for criterion in objective for name in criterion.names]
    lines = []
    for place, tariff in enumerate(priced):
        priority = len(objective) - place
        for name, weight in tariff.weights.items():
            lines.append(f'criterion("{name}",{priority}).')
            if weight != 1:
                lines.append(f'factor("{name}",{weight}).')
        least = min(tariff.weights, key=tariff.weights.__getitem__)
        lines.append(f'penalty("{least}","base",1).')
    deepest = len(problem.units) if "depth" in names else 1
    closure = problem.world.closure
    # No tree is shallower than the closure is where it has the goals, and the units that are demanded.
    rounds = [closure.available.get(goal, 1) for goal in problem.goals]
    rounds += [closure.executable.get(unit, 1) for unit in problem.constraints.use_units]
    horizon = max([1, *rounds])
    while True:
        made = solver(
            problem,
            [*encodings, *(f"criteria/{name}.lp" for name in names)],
            {"founded": int(problem.founded), "horizon": min(horizon, deepest)},
            extra_facts="\n".join(lines) + "\n" + extra_facts,
            tariff=next((each for each in priced if "success" in each.weights), None),
        )
        if problem.constraints.rules:
            from foon_asp.asp.own_rules import check_priorities

            check_priorities(made, problem.constraints, objective)
        yield made
        if horizon >= deepest:
            return
        horizon *= 2


def too_deep(*answers: Model) -> bool:
    """Say whether some answer does not know how deep its tree is, so that a larger horizon is needed."""
    return any(name == "too_deep" for answer in answers for name, _ in answer.atoms or ())
