"""What each command of the command line does: open the data, ask, write the answer, say how it ended.

Modules that only one command needs are imported there: a first answer should not wait for them.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from dataclasses import replace
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

from foon_asp.constraints import Constraints
from foon_asp.convert import FORMATS, choose_format
from foon_asp.dataset import Dataset, foon_files, load, read_foon
from foon_asp.errors import InputError, QueryError, closest, counted
from foon_asp.files import is_store, read_objects, read_utensils, write_atomically
from foon_asp.findings import Finding, Severity
from foon_asp.goals import find_on_level
from foon_asp.graph import ObjectNode
from foon_asp.problem import Domain, Problem
from foon_asp.render.json import dumps
from foon_asp.resources import built_in_data, diets

if TYPE_CHECKING:
    from foon_asp.alternatives import Alternatives
    from foon_asp.batch_file import Chunk
    from foon_asp.plan import Plan
    from foon_asp.retrieve import Retrieval
    from foon_asp.workers import Rows

FOUND, UNREACHABLE, BAD_INPUT, LIMIT = 0, 1, 2, 3
"""Exit statuses; an audit that is told to fail uses 1, too."""

_SHOWN = 3
"""How many warnings of one kind are written out."""


def warn(message: str) -> None:
    """Write a warning to standard error."""
    sys.stderr.write(f"foon-asp: warning: {message}\n")


def _load(options: argparse.Namespace) -> Dataset:
    """Load what the options name."""
    return load(
        options.data,
        foon=options.foon,
        kitchen=options.kitchen,
        rates=options.rates,
        utensils=options.utensils,
        default_rate=options.default_rate,
        strict_format=options.strict_format,
    )


def _open(options: argparse.Namespace) -> tuple[Dataset, Domain]:
    """Load the data as a domain, and warn of what cannot be meant."""
    dataset = _load(options)
    _warn_of_losses(dataset.findings)
    domain = dataset.domain(strict=options.strict, level=options.level)
    for node in domain.strangers[:_SHOWN]:
        warn(f"the kitchen has {node}, which the FOON does not know{_nearest(domain, node)}")
    if len(domain.strangers) > _SHOWN:
        warn(f"and {len(domain.strangers) - _SHOWN} more objects that the FOON does not know")
    if not dataset.kitchen.objects:
        warn("the kitchen is empty, nothing is at hand; name one with --kitchen")
    return dataset, domain


def _warn_of_losses(findings: Sequence[Finding]) -> None:
    for finding in findings:
        if finding.severity is Severity.ERROR:
            warn(f"{finding.file}:{finding.line}: {finding.message}")


def _nearest(domain: Domain, node: ObjectNode) -> str:
    """Return the closest node, looking for the label first: that is quick and what people mistype."""
    same_label = [str(other) for other in domain.foon.labelled(node.label)]
    if same_label:
        return closest(str(node), same_label, 1) or f"; there is {same_label[0]}"
    return closest(node.label, domain.foon.labels, 1)


def _find_goals(
    options: argparse.Namespace, dataset: Dataset, domain: Domain, named: Sequence[str]
) -> list[ObjectNode]:
    """Return the goals that were named one by one and in a file, seen on the level of the domain."""
    goals = [_find_goal(options, dataset, domain, text) for text in named]
    if options.goals is not None:
        listed = read_objects(Path(options.goals))
        if not listed:
            raise QueryError(f"{options.goals}: the list of goals is empty")
        for node in listed:
            domain.id_of(node)
        goals += [domain.project(node) for node in listed]
    return goals


def _find_goal(options: argparse.Namespace, dataset: Dataset, domain: Domain, text: str) -> ObjectNode:
    """Return the goal that a text names on the level of the domain, or else on the full level."""
    return find_on_level(domain, text, dataset.goals, lambda: dataset.domain(strict=options.strict))


def _constraints(options: argparse.Namespace) -> Constraints:
    """Return the constraints that the flags name."""
    return Constraints(
        without=_named(options.without),
        without_tools=_named(options.without_tool),
        avoid_motions=_named(options.avoid_motion),
        only_motions=None if options.only_motions is None else _labels(Path(options.only_motions)),
        use_units=tuple(dict.fromkeys(options.use_unit)),
        avoid_units=tuple(dict.fromkeys(options.avoid_unit)),
        max_units=options.max_units,
        max_depth=options.max_depth,
        min_success=options.min_success,
        human_steps=options.human_steps,
        diets=tuple(_diet(name) for name in options.diet),
        rules=_rules(options),
    )


def _named(labels: Iterable[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(label.strip().lower() for label in labels))


def _labels(path: Path) -> tuple[str, ...]:
    return tuple(sorted(read_utensils(path)))


def _diet(name: str) -> tuple[str, tuple[str, ...]]:
    """Return a diet that comes with the program, or that a file lists."""
    known = diets()
    if name in known:
        return name, _labels(known[name])
    path = Path(name)
    if not path.exists():
        raise QueryError(f"no diet {name!r}; there are {', '.join(known)}, or name a file of labels")
    return path.stem, _labels(path)


def _rules(options: argparse.Namespace) -> tuple[str, ...]:
    if not (options.constraint or options.objective):
        return ()
    from foon_asp.rules import read_rules

    paths = [*options.constraint, *options.objective]
    texts = [read_rules(Path(path), allow_script=options.allow_script) for path in paths]
    for path, text in zip(options.objective, texts[len(options.constraint) :], strict=True):
        for predicate in ("criterion(", "penalty("):
            if predicate not in text:
                raise InputError(
                    path,
                    None,
                    f"this objective has no {predicate}…)",
                    "see docs/objectives.md for the two lines",
                )
    return tuple(texts)


def run_retrieve(options: argparse.Namespace) -> int:
    """Retrieve task trees."""
    from foon_asp.render.json import alternatives_value, retrieval_value
    from foon_asp.render.text import alternatives_text, retrieval_text
    from foon_asp.render.trace import trace_text, trace_value
    from foon_asp.retrieve import Retrieval, check_method, retrieve
    from foon_asp.trace import bounds

    if (options.goal is None) == (options.goals is None):
        raise QueryError("name one GOAL, or a file of them with --goals")
    constraints = _constraints(options)
    check_method(options.method, options.by, not options.reference, constraints)
    if options.trace and options.method != "ids":
        raise QueryError("--trace shows the search of --method ids")
    if options.factor is not None and not options.diverse:
        raise QueryError("--factor says how dear --diverse trees may be; name both")
    if options.objective and options.method != "optimal":
        raise QueryError("an objective is for the method 'optimal' alone; leave out --method")
    several = options.k or options.all_optimal or options.diverse or options.pareto is not None
    if several:
        _check_alternatives(options)
    dataset, domain = _open(options)
    goals = _find_goals(options, dataset, domain, [] if options.goal is None else [options.goal])
    results: list[Retrieval | Alternatives] = []
    for place, goal in enumerate(goals):
        if several:
            result: Retrieval | Alternatives = _alternatives(options, domain, goal, constraints)
        else:
            result = retrieve(
                domain,
                goal,
                options.method,
                options.by,
                founded=not options.reference,
                time_limit=options.time_limit,
                constraints=constraints,
            )
        results.append(result)
        if options.format == "text":
            text = retrieval_text(result) if isinstance(result, Retrieval) else alternatives_text(result)
            sys.stdout.write("\n" if place else "")
            if options.trace:
                sys.stdout.write(trace_text(domain, bounds(domain, domain.id_of(goal))) + "\n")
            sys.stdout.write(text)
        elif options.format == "foon" and isinstance(result, Retrieval):
            _write_tree(result)
    if options.format == "json":
        values = [
            retrieval_value(result) if isinstance(result, Retrieval) else alternatives_value(result)
            for result in results
        ]
        if options.trace:
            for goal, value in zip(goals, values, strict=True):
                value["trace"] = trace_value(domain, bounds(domain, domain.id_of(goal)))
        sys.stdout.write(dumps(values[0] if options.goals is None else values))
    return _status(result.status for result in results)


def _status(statuses: Iterable[str]) -> int:
    """Return the exit status for the statuses of some answers."""
    statuses = set(statuses)
    if "limit" in statuses:
        return LIMIT
    return UNREACHABLE if "unreachable" in statuses else FOUND


def _check_alternatives(options: argparse.Namespace) -> None:
    if options.method != "optimal":
        raise QueryError("several trees are found by the method 'optimal' alone; leave out --method")
    if options.format == "foon":
        raise QueryError("--format foon writes one tree; take text or json for several")
    if options.pareto is not None and options.by:
        raise QueryError("--pareto names the criteria itself; leave out --by")
    if options.pareto is not None and options.objective:
        raise QueryError("--pareto weighs built-in criteria; it cannot take --objective")


def _alternatives(
    options: argparse.Namespace, domain: Domain, goal: ObjectNode, constraints: Constraints
) -> Alternatives:
    """Return the several trees that the options ask for."""
    from foon_asp.alternatives import all_optimal_trees, best_trees, diverse_trees, pareto_trees

    founded, limit, by = not options.reference, options.time_limit, options.by
    if options.k:
        return best_trees(
            domain, goal, options.k, by, founded=founded, time_limit=limit, constraints=constraints
        )
    if options.diverse:
        return diverse_trees(
            domain,
            goal,
            options.diverse,
            by,
            factor=1.5 if options.factor is None else options.factor,
            founded=founded,
            time_limit=limit,
            constraints=constraints,
        )
    if options.all_optimal:
        return all_optimal_trees(domain, goal, by, founded=founded, time_limit=limit, constraints=constraints)
    return pareto_trees(
        domain, goal, options.pareto, founded=founded, time_limit=limit, constraints=constraints
    )


def run_menu(options: argparse.Namespace) -> int:
    """Make several dishes together."""
    from foon_asp.menu import plan_menu
    from foon_asp.render.json import menu_value
    from foon_asp.render.text import menu_text
    from foon_asp.retrieve import check_method

    constraints = _constraints(options)
    check_method("optimal", options.by, True, constraints)
    dataset, domain = _open(options)
    goals = _find_goals(options, dataset, domain, options.goal)
    if not goals:
        raise QueryError("name the dishes: foon-asp menu GOAL GOAL…, or a file of them with --goals")
    menu = plan_menu(
        domain,
        goals,
        options.by,
        time_limit=options.time_limit,
        constraints=constraints,
        leave_out=options.leave_out,
    )
    if options.format == "json":
        sys.stdout.write(dumps(menu_value(menu)))
    elif options.format == "text":
        sys.stdout.write(menu_text(menu))
    else:
        _write_tree(menu.together)
    return _status([menu.together.status])


def _write_tree(result: Retrieval) -> None:
    from foon_asp.text import write_text

    if result.tree is None:
        reason = f"no task tree: {result.reason}" if result.reason else "no task tree in time"
        sys.stderr.write(f"foon-asp: {result.goal}: {reason}\n")
        return
    comments = [f"Goal:\t{goal}" for goal in result.goals]
    comments += [f"Method:\t{result.method} {','.join(result.by)}".rstrip()]
    if not result.tree.executable:
        comments.append("NOT EXECUTABLE")
    sys.stdout.write(write_text(result.tree.domain.foon, result.tree.steps, comments))


def run_explain(options: argparse.Namespace) -> int:
    """Say why there is no task tree, or what its steps are for."""
    from foon_asp.explain import explain, first_sentence
    from foon_asp.render.explain import explanation_text, explanation_value, reason_text

    constraints = _constraints(options)
    dataset, domain = _open(options)
    goal = _find_goal(options, dataset, domain, options.goal)
    told = ""
    if options.format == "text":
        # The first sentence takes no solver, so it does not wait for one.
        told = first_sentence(domain.problem([goal], constraints=constraints))
        sys.stdout.write(reason_text(goal, told) if told else "")
        sys.stdout.flush()
    explanation = explain(
        domain,
        goal,
        options.by,
        constraints=constraints,
        step=options.step,
        instead=options.instead,
        everything=options.all,
        time_limit=options.time_limit,
    )
    if options.format == "json":
        sys.stdout.write(dumps(explanation_value(explanation)))
    else:
        sys.stdout.write(explanation_text(explanation, told=bool(told)))
    return {"limit": LIMIT, "reachable": FOUND}.get(explanation.status, UNREACHABLE)


def run_suggest(options: argparse.Namespace) -> int:
    """Say what can be cooked, the best dishes first."""
    from foon_asp.render.suggest import suggestions_text, suggestions_value
    from foon_asp.suggest import suggest

    constraints = _constraints(options)
    dataset, domain = _open(options)
    result = suggest(
        domain,
        [domain.project(goal) for goal in dataset.goals],
        options.by,
        using=[label for label in options.using.split(",") if label.strip()],
        everything=options.all,
        time_limit=options.time_limit,
        constraints=constraints,
    )
    if options.format == "json":
        sys.stdout.write(dumps(suggestions_value(result)))
    else:
        sys.stdout.write(suggestions_text(result, options.n))
    if result.skipped:
        return LIMIT
    return FOUND if result.dishes else UNREACHABLE


def run_query(options: argparse.Namespace) -> int:
    """Run rules of the user's own over the facts."""
    from foon_asp.query import query
    from foon_asp.render.query import query_text, query_value

    dataset, domain = _open(options)
    goals = _find_goals(options, dataset, domain, options.goal)
    answer = query(
        domain,
        Path(options.file),
        goals,
        time_limit=options.time_limit,
        allow_script=options.allow_script,
    )
    if options.format == "json":
        sys.stdout.write(dumps(query_value(answer)))
    else:
        sys.stdout.write(query_text(answer))
    return {"none": UNREACHABLE, "limit": LIMIT}.get(answer.status, FOUND)


def run_reach(options: argparse.Namespace) -> int:
    """Say what the kitchen can make."""
    from foon_asp.render.json import reach_value
    from foon_asp.render.text import reach_text
    from foon_asp.retrieve import reach

    _, domain = _open(options)
    available, executable = reach(domain)
    if options.format == "json":
        sys.stdout.write(dumps(reach_value(domain, available, executable)))
    else:
        sys.stdout.write(reach_text(domain, available, executable, listing=options.list))
    return FOUND


def run_compare(options: argparse.Namespace) -> int:
    """Compare all methods."""
    from foon_asp.compare import compare, compare_human
    from foon_asp.render.json import comparison_value, human_value
    from foon_asp.render.text import comparison_text, human_text

    if options.human_steps is not None and not options.human:
        raise QueryError("--human-steps limits the table of --human; name both")
    dataset, domain = _open(options)
    goals = _find_goals(options, dataset, domain, options.goal)
    goals = goals or list(dict.fromkeys(map(domain.project, dataset.goals)))
    if not goals:
        raise QueryError("no goals: name some, or a file of them with --goals")
    if options.human:
        tables = compare_human(domain, goals, most=options.human_steps, time_limit=options.time_limit)
        if options.format == "json":
            sys.stdout.write(dumps([human_value(table) for table in tables]))
        else:
            sys.stdout.write(human_text(tables))
        return LIMIT if any(not proven for table in tables for _, proven in table.trees) else FOUND
    rows = compare(domain, goals, time_limit=options.time_limit)
    if options.format == "json":
        sys.stdout.write(dumps(comparison_value(rows)))
    else:
        sys.stdout.write(comparison_text(rows))
    return LIMIT if any(row.cells["optimal"].proven is False for row in rows) else FOUND


def run_plan(options: argparse.Namespace) -> int:
    """Plan with things being used up."""
    from foon_asp.effects import Effects
    from foon_asp.planning import PlanAnswer, plan
    from foon_asp.render.plan import answer_text, answer_value

    dataset, domain = _open(options)
    goals = [_find_goal(options, dataset, domain, text) for text in options.goal]
    answer: PlanAnswer = plan(
        domain,
        goals,
        options.engine,
        options.semantics,
        options.by,
        max_steps=options.max_steps,
        time_limit=options.time_limit,
        progress=_progress(options.engine),
    )
    effects = Effects(domain, options.semantics)
    if options.format == "json":
        sys.stdout.write(dumps(answer_value(answer)))
    elif options.format == "text":
        sys.stdout.write(answer_text(answer, effects))
    elif answer.plan is None:
        sys.stderr.write(f"foon-asp: no plan: {answer.reason or answer.status}\n")
    else:
        _write_plan(answer.plan, f"{answer.engine} {answer.semantics}")
    return {"optimal": FOUND, "solved": FOUND, "unsolvable": UNREACHABLE, "failed": BAD_INPUT}.get(
        answer.status, LIMIT
    )


def _progress(engine: str) -> Callable[[float], None] | None:
    """Return what shows a person that an engine is at work; nothing where nobody looks."""
    if not sys.stderr.isatty():
        return None

    def show(seconds: float) -> None:
        sys.stderr.write(f"\rfoon-asp: {engine} is at work, {seconds:.0f} s\x1b[K\r")
        sys.stderr.flush()

    return show


def _write_plan(plan: Plan, how: str) -> None:
    from foon_asp.text import write_text

    foon = plan.domain.foon
    comments = [*(f"Goal:\t{plan.domain.node(goal)}" for goal in plan.goals), f"Plan:\t{how}"]
    if not plan.executable:
        comments.append("NOT EXECUTABLE")
    sys.stdout.write(write_text(foon, [foon.units[unit] for unit in plan.units], comments))


def run_engines(options: argparse.Namespace) -> int:
    """List planning engines."""
    from foon_asp.engines import ENGINES
    from foon_asp.render.plan import engines_text, engines_value

    if options.format == "json":
        sys.stdout.write(dumps(engines_value(ENGINES)))
    else:
        sys.stdout.write(engines_text(ENGINES))
    return FOUND


def run_pddl_export(options: argparse.Namespace) -> int:
    """Write a planning domain, a problem and a map of their names."""
    from foon_asp.criteria import Level
    from foon_asp.effects import Effects
    from foon_asp.pddl import export

    dataset, domain = _open(options)
    goals = [_find_goal(options, dataset, domain, text) for text in options.goal]
    problem = Problem(domain, tuple(map(domain.id_of, goals)), whole=options.whole)
    level = None if options.by is None else Level.parse(options.by)
    folder = Path(options.output)
    effects = Effects(domain, options.semantics)
    written = export(problem, effects, level, options.style, options.durative, folder=folder)
    actions = counted(len(written.actions), "action")
    sys.stderr.write(f"foon-asp: {folder}/: domain.pddl, problem.pddl, names.json ({actions})\n")
    return FOUND


def run_pddl_decode(options: argparse.Namespace) -> int:
    """Read a plan that another planner made from an export."""
    from foon_asp.effects import Effects
    from foon_asp.pddl_names import read_names
    from foon_asp.plan import Plan
    from foon_asp.plan_file import read_plan
    from foon_asp.render.plan import plan_text, plan_value

    _, domain = _open(options)
    names = read_names(Path(options.names), domain)
    effects = Effects(domain, names.semantics)
    plan = Plan.of(effects, names.goals, read_plan(Path(options.plan), names))
    if options.format == "json":
        sys.stdout.write(dumps(plan_value(plan)))
    elif options.format == "text":
        sys.stdout.write(plan_text(plan, effects))
    else:
        _write_plan(plan, names.semantics)
    return FOUND if plan.executable else UNREACHABLE


def run_facts(options: argparse.Namespace) -> int:
    """Print the facts that clingo is given."""
    from foon_asp.facts import facts

    dataset, domain = _open(options)
    named = [_find_goal(options, dataset, domain, text) for text in options.goal]
    goals = tuple(domain.id_of(goal) for goal in named)
    whole = options.whole or not goals
    sys.stdout.write(facts(Problem(domain, goals, founded=not options.reference, whole=whole)))
    return FOUND


def run_goals(options: argparse.Namespace) -> int:
    """List the goals of the data folder."""
    from foon_asp.state_syntax import object_to_json

    dataset, domain = _open(options)
    goals = list(dict.fromkeys(map(domain.project, dataset.goals)))
    if options.format == "json":
        sys.stdout.write(dumps([object_to_json(goal) for goal in goals]))
        return FOUND
    for goal in goals:
        reachable = domain.foon.id_of(goal) in domain.closure.available
        sys.stdout.write(f"{goal}{'' if reachable else '  (this kitchen cannot make it)'}\n")
    return FOUND


def run_audit(options: argparse.Namespace) -> int:
    """Find what is wrong in FOON files."""
    from foon_asp.audit import audit
    from foon_asp.render.audit import audit_text, audit_value
    from foon_asp.render.sarif import sarif_value

    if (options.fix or options.fix_dir) and not options.files:
        raise QueryError("name the files to repair: foon-asp audit --fix FILE…")
    if options.files:
        # What lies beside the first file belongs to it.
        options.data = options.data or str(Path(options.files[0]).parent)
        options.foon = options.files
    dataset = _load(options)
    if options.goals is not None:
        dataset = replace(dataset, goals=tuple(read_objects(Path(options.goals))))
    for goal in dataset.goals:
        if dataset.foon.id_of(goal) is None:
            warn(f"the goal {goal} is no object of this FOON")
    report = audit(dataset.foon, dataset.kitchen, dataset.goals, dataset.findings)
    if options.format == "json":
        sys.stdout.write(dumps(audit_value(report)))
    elif options.format == "sarif":
        sys.stdout.write(dumps(sarif_value(report.findings, version("foon-asp"))))
    else:
        sys.stdout.write(audit_text(report, Severity[options.severity.upper()]))
    if options.fix or options.fix_dir:
        _fix_all([Path(name) for name in options.files], options.fix_dir)
    worst = max((finding.severity for finding in report.findings), default=None)
    if options.fail_on and worst is not None and worst >= Severity[options.fail_on.upper()]:
        return UNREACHABLE
    return FOUND


def _fix_all(paths: Sequence[Path], folder: str | None) -> None:
    """Write a repaired copy of each file, beside it or in a folder."""
    if folder is None:
        targets = [path.with_name(f"{path.stem}.fixed{path.suffix}") for path in paths]
    else:
        targets = [Path(folder) / path.name for path in paths]
    _refuse_overwriting(targets, paths)
    for path, target in zip(paths, targets, strict=True):
        _fix(path, target)


def _fix(path: Path, target: Path) -> None:
    """Write a copy of a text file with the certain mends, and list them on standard error."""
    from foon_asp.files import read_bytes
    from foon_asp.mend import mend_text
    from foon_asp.open_foon import FoonReader, decode, is_json

    if is_store(path):
        warn(f"{path}: only text files can be repaired; repair the files that it was compiled from")
        return
    data = read_bytes(path)
    text, encoding = decode(data, str(path))
    if is_json(text):
        warn(f"{path}: only text files can be repaired")
        return
    reader = FoonReader()
    reader.read_data(data, path)
    mended, mends = mend_text(text, reader.finish().findings)
    rows = [f"{finding.file}:{finding.line}: {finding.code}: {finding.mend}" for finding in mends]
    rows += [f"{finding.file}:{finding.line}: {finding.code}: saved as UTF-8" for finding in encoding]
    rows = list(dict.fromkeys(rows))
    if not rows:
        sys.stderr.write(f"foon-asp: {path}: nothing to mend\n")
        return
    write_atomically(target, mended)
    sys.stderr.write("".join(f"{row}\n" for row in rows))
    sys.stderr.write(f"foon-asp: {target}: {counted(len(rows), 'mend')}\n")


def _refuse_overwriting(targets: Sequence[Path], sources: Sequence[Path]) -> None:
    """Raise `InputError` if writing the targets would replace a source, or one target another."""
    inputs = {source.resolve() for source in sources}
    seen: set[Path] = set()
    for target in targets:
        place = target.resolve()
        if place in inputs:
            raise InputError(target, None, "this would replace an input", "name another output")
        if place in seen:
            raise InputError(target, None, "two inputs would be written here", "convert them one by one")
        seen.add(place)


def run_stats(options: argparse.Namespace) -> int:
    """Count what is in a FOON."""
    from foon_asp.levels import at_level
    from foon_asp.render.stats import statistics_text, statistics_value
    from foon_asp.stats import centralities, statistics

    folder = built_in_data() if options.data is None else Path(options.data)
    paths = [Path(name) for name in options.files] or foon_files(folder)
    files = read_foon(paths or [folder], strict=options.strict_format)
    counts = statistics(files.foon, files.units_read, files.findings, options.level)
    central = centralities(at_level(files.foon, options.level)) if options.centrality else None
    if options.format == "json":
        sys.stdout.write(dumps(statistics_value(counts, central)))
    else:
        sys.stdout.write(statistics_text(counts, central))
    return FOUND


def run_convert(options: argparse.Namespace) -> int:
    """Write FOON files in another format."""
    sources = [Path(name) for name in options.files]
    out = Path(options.output)
    if os.path.isdir(out) or options.output.endswith("/"):  # noqa: PTH112 - Path.is_dir raises on long names
        if options.to is None:
            raise QueryError("name the format with --to where the output is a folder")
        targets = [out / (source.stem + FORMATS[options.to].suffix) for source in sources]
        _refuse_overwriting(targets, sources)
        for source, target in zip(sources, targets, strict=True):
            _convert([source], target, options)
    else:
        _refuse_overwriting([out], sources)
        _convert(sources, out, options)
    return FOUND


def _convert(sources: Sequence[Path], target: Path, options: argparse.Namespace) -> None:
    """Write some files as one, and say what the format cannot say of them."""
    files = read_foon(sources, strict=options.strict_format)
    _warn_of_losses(files.findings)
    form = choose_format(files.foon, target, options.to)
    write_atomically(target, form.write(files.foon))
    poorer = sum(form.loses(unit) for unit in files.foon.units)
    if poorer:
        what = "goal marks" if form.name == "api-json" else "flags, marks, times, agents and rates"
        warn(f"{target}: the format {form.name!r} has no {what}; lost of {counted(poorer, 'unit')}")
    sys.stderr.write(f"foon-asp: {target}: {counted(len(files.foon.units), 'unit')} ({form.name})\n")


def run_compile(options: argparse.Namespace) -> int:
    """Write FOON files as a store that opens quickly."""
    from foon_asp.store import write_store

    sources = [Path(name) for name in options.files]
    target = Path(options.output)
    _refuse_overwriting([target], sources)
    files = read_foon(sources, strict=options.strict_format)
    _warn_of_losses(files.findings)
    manifest = write_store(files, target, sources)
    size = sum(table["bytes"] for table in manifest["tables"].values())
    sys.stdout.write(
        f"{target}: {counted(len(files.foon.units), 'unit')}, {counted(len(files.foon.objects), 'object')},"
        f" {size / 1e6:.1f} MB\n"
    )
    return FOUND


def run_merge(options: argparse.Namespace) -> int:
    """Merge FOON files into a universal FOON."""
    from foon_asp.levels import at_level
    from foon_asp.text import write_text

    sources = [Path(name) for name in options.files]
    if options.output is not None:
        if options.output.lower().endswith(".json"):
            raise QueryError("a merged FOON is text; convert it to JSON afterwards: foon-asp convert")
        _refuse_overwriting([Path(options.output)], sources)
    files = read_foon(sources, strict=options.strict_format)
    _warn_of_losses(files.findings)
    foon = at_level(files.foon, options.level)
    text = write_text(foon, foon.units, dialect="A", provenance=True)
    summary = (
        f"{counted(len(sources), 'file')}, {files.units_read} units read, {files.units_reported} left out,"
        f" {foon.duplicates} duplicates removed: {len(foon.units)} units, {len(foon.objects)} objects\n"
    )
    if options.output is None:
        sys.stdout.write(text)
        sys.stderr.write(f"foon-asp: {summary}")
    else:
        write_atomically(Path(options.output), text)
        sys.stdout.write(f"{options.output}: {summary}")
    return FOUND


def run_batch(options: argparse.Namespace) -> int:
    """Answer a file of queries."""
    from foon_asp.batch import chunk_size
    from foon_asp.batch import run_batch as run
    from foon_asp.batch_file import QueryFile
    from foon_asp.workers import Settings, Sources, answer_here, answer_in_processes, cores

    if options.scheduler is not None and options.jobs is not None:
        raise QueryError("--jobs counts processes of this machine; leave it out with --scheduler")
    if options.ship and options.scheduler is None:
        raise QueryError("--ship sends the data to the workers of --scheduler; name one")
    if options.scheduler is not None and find_spec("distributed") is None:
        raise QueryError("a cluster needs Dask: pip install 'foon-asp[cluster]'")
    queries = QueryFile.scan(Path(options.queries))
    sources = Sources.of(
        options.data,
        foon=options.foon,
        kitchen=options.kitchen,
        rates=options.rates,
        utensils=options.utensils,
        default_rate=options.default_rate,
        strict_format=options.strict_format,
        strict=options.strict,
        level=options.level,
    )
    settings = Settings(options.time_limit, options.timings)
    jobs = min(options.jobs or cores(), queries.queries)
    fingerprint = {"data": sources.digest(), "options": str(settings)}

    def answer(chunks: Iterator[Chunk]) -> Generator[Rows, None, None]:
        if options.scheduler is not None:
            from foon_asp.cluster import answer_on_cluster

            return answer_on_cluster(sources, settings, chunks, options.scheduler, ship=options.ship)
        if options.jobs == 1:
            return answer_here(sources, settings, chunks)
        # In a process of its own even on a single core: a query that takes all memory must not end the run.
        return answer_in_processes(sources, settings, chunks, jobs)

    try:
        summary = run(
            queries,
            Path(options.out),
            answer,
            fingerprint,
            chunk=chunk_size(queries.queries, jobs),
            overwrite=options.overwrite,
            progress=sys.stderr if options.progress or sys.stderr.isatty() else None,
        )
    except KeyboardInterrupt:
        sys.stderr.write("foon-asp: stopped; the same command goes on from here\n")
        raise
    sys.stderr.write(f"foon-asp: {options.out}: {summary}\n")
    return FOUND
