"""`foon-asp consolidate`: several trees of one dish made into one."""

from __future__ import annotations

import argparse
from pathlib import Path

from foon_asp.cli import options as add
from foon_asp.cli.commands.retrieve import tree_as_foon
from foon_asp.cli.inputs import open_trees, warn_of_findings
from foon_asp.cli.messages import note
from foon_asp.cli.output import Reply, check_targets
from foon_asp.cli.parser import Parser
from foon_asp.cli.question import likenesses, question
from foon_asp.io import atomic
from foon_asp.io.formats import choose_format
from foon_asp.io.kitchen import KitchenFiles
from foon_asp.io.transitions import read_orders
from foon_asp.model.alignment import Measure
from foon_asp.model.foon import FoonBuilder
from foon_asp.model.relations import MATCHINGS
from foon_asp.query.substitution import Substitution
from foon_asp.render.consolidate import consolidation_text
from foon_asp.retrieval.consolidate import ConsolidateQuery, Consolidation, consolidate_trees, foon_of
from foon_asp.retrieval.consolidate_wire import consolidation_json
from foon_asp.retrieval.transitions import Aspect
from foon_asp.words import counted

_MODELS: dict[str, Aspect] = {"states": "state", "locations": "location", "motions": "motion"}
"""The flags that name a model, and what it is about."""


def configure(parser: Parser) -> None:
    """Add the options."""
    parser.add_argument("trees", nargs="+", metavar="TREE", help="files of task trees; - is standard input")
    add.named_goal(parser, "what the tree is for (default: what most trees are for)")
    add.criteria(parser, "; default: cost if costs are named, else units")
    group = parser.add_argument_group("models")
    add.costs(group)
    for flag in _MODELS:
        group.add_argument(
            f"--{flag}", metavar="FILE", help=f"the orders in which {flag} may come, JSON lists"
        )
    group.add_argument(
        "--adjacent", action="store_true", help="only the next word of an order may follow, not any later one"
    )
    add.similar(group)
    group = parser.add_argument_group("kitchen")
    add.kitchen(group, " (default: what no unit of the trees makes)")
    group.add_argument("--strict", action="store_true", help="need every input, implied views too")
    group.add_argument(
        "--match-relations",
        choices=MATCHINGS,
        default="loose",
        help="strict: on is not in; loose: what is on, under, … counts as in (default: loose)",
    )
    add.vocabulary(parser.add_argument_group("reading"))
    add.constraints(parser)
    parser.add_argument(
        "--write-tree", metavar="FILE", help="write the tree as a FOON, text or JSON by its suffix"
    )
    add.limits(parser)
    add.output(parser, "text", "json", "foon")


def run(options: argparse.Namespace) -> Reply:
    """Make several trees into one, and write it."""
    target = None if options.write_tree is None else Path(options.write_tree)
    if target is not None:
        check_targets(options, target)
        # Told before anything is worked out.
        choose_format(FoonBuilder().build(), target, None)
    trees = open_trees(options, FoonBuilder().build())
    kitchen, odd = KitchenFiles(
        options.kitchen,
        options.utensils,
        options.rates,
        options.costs,
        options.default_rate,
        options.default_cost,
        options.vocabulary,
    ).read(trees.foon)
    warn_of_findings(options, odd, [options.kitchen or ""])
    asked = ConsolidateQuery(
        question(options, *options.goal),
        kitchen,
        {
            about: read_orders(Path(path))
            for flag, about in _MODELS.items()
            if (path := getattr(options, flag))
        },
        options.adjacent,
        _measure(options),
        strict=options.strict,
        match_relations=options.match_relations,
    )
    found = consolidate_trees(trees, asked)
    if target is not None:
        _write_tree(options, target, found)
    return Reply(
        lambda: consolidation_text(found),
        lambda: consolidation_json(found),
        {"foon": lambda: [tree_as_foon(found.answer)]},
        [found.status],
    )


def _measure(options: argparse.Namespace) -> Measure | None:
    if not options.similar:
        return None
    given = Substitution.of(likenesses(options.similar))
    return None if given is None else Measure(given.alike(), options.least_likeness)


def _write_tree(options: argparse.Namespace, target: Path, found: Consolidation) -> None:
    tree = found.answer.tree
    if tree is None:
        note(options, f"{target}: not written, for there is no tree")
        return
    foon = foon_of(tree.world.foon, tree.units)
    form = choose_format(foon, target, None)
    atomic.write_text(target, form.write(foon))
    note(options, f"{target}: {counted(len(foon.units), 'unit')} ({form.name})")
