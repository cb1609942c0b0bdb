"""Programs with rules of the user's own: checked before they run, and once more when they are grounded."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from foon_asp.asp import derived
from foon_asp.asp.aims import check_aims
from foon_asp.asp.complaints import RulesProgram
from foon_asp.asp.payments import check_payments
from foon_asp.asp.rules import Rules, check_rules
from foon_asp.asp.solver import Solver
from foon_asp.query.constraints import Constraints
from foon_asp.query.objective import Objective


def solver_with_rules(
    constraints: Constraints,
    facts: str,
    encodings: Sequence[str],
    constants: Mapping[str, str | int],
    options: Sequence[str],
) -> Solver:
    """Return a solver for encodings, facts and the rules among some constraints; raise as `grounded` does."""
    rules = _rules(constraints)
    check_aims(rules)
    made = derived.grounded(RulesProgram.of(facts, rules), encodings, constants, options)
    check_payments(made)
    return made


def check_priorities(solver: Solver, constraints: Constraints, objective: Objective) -> None:
    """Raise `InputError` for a criterion of the user's own that would be added to one of the objective."""
    derived.check_priorities(solver, _rules(constraints), objective)


def _rules(constraints: Constraints) -> list[Rules]:
    return [check_rules(each) for each in constraints.rules]
