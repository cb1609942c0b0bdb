"""Problems and plans to and from unified_planning, and PDDL files: the only importer of unified_planning.

It is imported where it is used, because that takes seconds; to write PDDL it is not needed at all.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from foon_asp.errors import QueryError
from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId
from foon_asp.planning.pddl.names import Names
from foon_asp.planning.pddl.styles import Atom, Document
from foon_asp.planning.pddl.task import Fact, Step, all_steps, step_orderings
from foon_asp.planning.pddl.timed import TimedPlan
from foon_asp.planning.plan import Plan

if TYPE_CHECKING:
    import unified_planning.model as up_model
    import unified_planning.plans as up_plans
    from unified_planning.environment import Environment


@dataclass(frozen=True, slots=True)
class Unified:
    """A document as unified_planning has it: `problem`, and the expression of each fact in `atoms`."""

    document: Document
    problem: up_model.Problem
    atoms: dict[Fact, Any]

    def instance(self, step: Step) -> up_plans.ActionInstance:
        """Return the ground action of a step."""
        from unified_planning.plans import ActionInstance

        problem = self.problem
        expression = problem.environment.expression_manager.ObjectExp
        arguments = tuple(expression(problem.object(name)) for name in self.document.arguments[step.name])
        return ActionInstance(problem.action(step.name), arguments)


def unified(document: Document, environment: Environment | None = None) -> Unified:
    """Return a document as a unified_planning problem, in its global environment if none is given.

    It equals what unified_planning reads from the text of the document.
    """
    from unified_planning.environment import get_environment
    from unified_planning.model import Object
    from unified_planning.model import Problem as UpProblem
    from unified_planning.model.metrics import MinimizeActionCosts, MinimizeMakespan

    environment = environment or get_environment()
    types: dict[str, Any] = {}
    for name, parent in document.types:
        types[name] = environment.type_manager.UserType(name, types.get(parent))
    bool_type = environment.type_manager.BoolType()
    problem = UpProblem(document.problem_name, environment, initial_defaults={bool_type: False})
    build = _Builder(problem, types)
    for predicate in document.predicates:
        build.fluent(predicate.name, predicate.parameters)
    for name, kind in (*document.constants, *document.objects):
        build.objects[name] = problem.add_object(Object(name, types[kind], environment))
    costs: dict[Any, Any] = {}
    integer = environment.expression_manager.Int
    for action in document.actions:
        made = build.action(action, document.durative)
        problem.add_action(made)
        if action.cost is not None:
            costs[made] = integer(action.cost)
    for atom in document.initially:
        problem.set_initial_value(build.atom(atom, {}), True)
    for atom in document.wanted:
        problem.add_goal(build.atom(atom, {}))
    if document.costed:
        problem.add_quality_metric(MinimizeActionCosts(costs, integer(0), environment))
    elif document.durative:
        problem.add_quality_metric(MinimizeMakespan(environment=environment))
    facts = {fact: build.atom(atom, {}) for fact, atom in document.facts.items()}
    return Unified(document, problem, facts)


class _Builder:
    def __init__(self, problem: up_model.Problem, types: dict[str, Any]) -> None:
        self.problem = problem
        self.types = types
        self.fluents: dict[str, Any] = {}
        self.objects: dict[str, Any] = {}

    def fluent(self, name: str, parameters: Iterable[tuple[str, str]]) -> None:
        from unified_planning.model import Fluent

        environment = self.problem.environment
        signature = {variable.removeprefix("?"): self.types[kind] for variable, kind in parameters}
        fluent = Fluent(name, environment.type_manager.BoolType(), environment=environment, **signature)
        self.fluents[name] = self.problem.add_fluent(fluent)

    def atom(self, atom: Atom, parameters: dict[str, Any]) -> Any:
        manager = self.problem.environment.expression_manager
        arguments = [
            manager.ParameterExp(parameters[name])
            if name.startswith("?")
            else manager.ObjectExp(self.objects[name])
            for name in atom[1:]
        ]
        return manager.FluentExp(self.fluents[atom[0]], arguments)

    def action(self, action: Any, durative: bool) -> Any:
        from collections import OrderedDict

        from unified_planning.model import DurativeAction, InstantaneousAction
        from unified_planning.model.timing import ClosedTimeInterval, EndTiming, StartTiming

        environment = self.problem.environment
        signature = OrderedDict(
            (variable.removeprefix("?"), self.types[kind]) for variable, kind in action.parameters
        )
        kind = DurativeAction if durative else InstantaneousAction
        made: Any = kind(action.name, signature, environment)
        variables = {f"?{parameter.name}": parameter for parameter in made.parameters}

        def atoms(found: Iterable[Atom]) -> list[Any]:
            return [self.atom(atom, variables) for atom in found]

        if durative:
            made.set_fixed_duration(action.duration)
            for condition in atoms(action.conditions):
                made.add_condition(StartTiming(), condition)
            for condition in atoms(action.lasting):
                made.add_condition(ClosedTimeInterval(StartTiming(), EndTiming()), condition)
            for fact in atoms(action.deletes):
                made.add_effect(StartTiming(), fact, False)
            for fact in atoms(action.adds):
                made.add_effect(EndTiming(), fact, True)
        else:
            # The reader makes one conjunction of all conditions.
            if action.conditions:
                made.add_precondition(environment.expression_manager.And(atoms(action.conditions)))
            for fact in atoms(action.adds):
                made.add_effect(fact, True)
            for fact in atoms(action.deletes):
                made.add_effect(fact, False)
        return made


def to_sequential_plan(plan: Plan, target: Unified, effects: Effects) -> up_plans.SequentialPlan:
    """Return a plan as unified_planning has it, with the helpers that it needs: fees, objects taken out."""
    from unified_planning.plans import SequentialPlan

    steps = all_steps(plan, target.document.task, effects)
    return SequentialPlan([target.instance(step) for step in steps], target.problem.environment)


def to_time_triggered(plan: TimedPlan, target: Unified) -> up_plans.TimeTriggeredPlan:
    """Return a schedule as unified_planning has it; the target is made of the document of the plan."""
    from fractions import Fraction

    from unified_planning.plans import TimeTriggeredPlan

    timed = [
        (Fraction(start), target.instance(action), Fraction(action.duration))
        for action, start in zip(plan.actions, plan.starts, strict=True)
    ]
    return TimeTriggeredPlan(timed, target.problem.environment)


def to_partial_order(plan: Plan, target: Unified, effects: Effects) -> up_plans.PartialOrderPlan:
    """Return a plan, helpers included, in which only those steps are ordered that may not be swapped."""
    from unified_planning.plans import PartialOrderPlan

    steps = all_steps(plan, target.document.task, effects)
    # Equal steps are different instances: a unit may come again.
    instances = [target.instance(step) for step in steps]
    after: dict[Any, list[Any]] = {instance: [] for instance in instances}
    for first, second in step_orderings(steps, target.document.task.initially):
        after[instances[first]].append(instances[second])
    return PartialOrderPlan(after, target.problem.environment)


def from_unified_plan(
    found: up_plans.Plan, names: Names, effects: Effects, goals: Iterable[ObjectId]
) -> Plan:
    """Return the units of a sequential, partial-order or time-triggered plan, replayed; helpers are left out.

    Where steps overlap in time they are put into an order that can be executed, if there is one by the
    time of their start or their end.
    """
    orders = _orders(found)
    for order in orders:
        units = [names.unit_of(name) for name in order]
        plan = Plan.of(effects, goals, [unit for unit in units if unit is not None])
        if plan.executable:
            break
    return plan


def _orders(found: Any) -> list[list[str]]:
    """Return the names of the actions of a plan, in the orders to be tried."""
    from unified_planning.plans import PartialOrderPlan, SequentialPlan, TimeTriggeredPlan

    if isinstance(found, SequentialPlan):
        return [[instance.action.name for instance in found.actions]]
    if isinstance(found, PartialOrderPlan):
        return [[instance.action.name for instance in next(iter(found.all_sequential_plans())).actions]]
    if isinstance(found, TimeTriggeredPlan):
        by_start = sorted(found.timed_actions, key=lambda timed: timed[0])
        by_end = sorted(found.timed_actions, key=lambda timed: timed[0] + (timed[2] or 0))
        return [[instance.action.name for _, instance, _ in timed] for timed in (by_start, by_end)]
    if found is None:
        raise QueryError("there is no plan to read: the planner found none")
    raise QueryError(f"a {type(found).__name__} cannot be read; give a plan of actions in order or in time")
