"""`foon-asp check`: task trees that someone else made, replayed and judged."""

from __future__ import annotations

import argparse
from pathlib import Path

from foon_asp.cli import options as add
from foon_asp.cli.inputs import load_data, open_trees, tell_labels
from foon_asp.cli.messages import listing, note, tell
from foon_asp.cli.output import Reply, check_targets
from foon_asp.cli.parser import Parser
from foon_asp.errors import QueryError
from foon_asp.io import atomic
from foon_asp.io.formats import choose_format
from foon_asp.io.object_wire import object_to_json
from foon_asp.io.wire import dumps
from foon_asp.limits import ended
from foon_asp.render.check import checks_text, mending_head
from foon_asp.retrieval.check import CheckQuery, Checks, check_trees
from foon_asp.retrieval.check_wire import checks_json
from foon_asp.retrieval.mend import edit_rows
from foon_asp.retrieval.prompt import prompt
from foon_asp.words import counted


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser, match_relations="loose")
    parser.add_argument("trees", nargs="+", metavar="TREE", help="files of task trees; - is standard input")
    parser.add_argument(
        "--write-kitchen", metavar="FILE", help="write what the trees need from a kitchen, a JSON list"
    )
    parser.add_argument(
        "--mend",
        action="store_true",
        help="write the tree with the fewest edits after which it can be executed, and list them",
    )
    add.semantics(parser, "add")
    add.limits(parser, "for all trees")
    add.output(parser, "text", "json", "prompt")


def run(options: argparse.Namespace) -> Reply:
    """Check trees, and write the kitchen that they need."""
    if options.level != 3:
        raise QueryError("trees are checked with all that they say; leave out --level")
    target = None if options.write_kitchen is None else Path(options.write_kitchen)
    if target is not None:
        check_targets(options, target)
    if options.mend and options.format == "text":
        options.format = "foon"
    known = load_data(options)
    trees = open_trees(options, known.foon)
    query = CheckQuery(
        known.kitchen if options.kitchen is not None else None,
        known.kitchen.utensils,
        options.utensils is not None,
        options.semantics,
        options.match_relations,
        options.strict,
        options.mend,
        options.time_limit,
        options.memory_limit,
    )
    if options.format == "foon" and len(trees.listings) != 1:
        raise QueryError("one tree at a time is written mended; take --format json for several")
    checks = check_trees(trees, query)
    if checks.found and options.kitchen is not None:
        tell_labels(options, known, checks[0].world)
    if target is not None:
        _write_kitchen(options, target, checks)
    return Reply(
        lambda: checks_text(checks),
        lambda: checks_json(checks),
        {
            "prompt": lambda: (f"{prompt(each)}\n" for each in checks),
            "foon": lambda: _mended(options, checks),
        },
        [checks.status],
    )


def _mended(options: argparse.Namespace, checks: Checks) -> str:
    """Return the mended tree in the format that the output file names, and list the edits."""
    mending = checks[0].mending if checks.found else None
    if mending is None or mending.edits is None:
        why = ended(checks.limit) if checks.skipped else "there is no step"
        tell(f"no mended tree: {why if mending is None else mending_head(mending)}")
        return ""
    rows = edit_rows(mending, checks[0].listing.sources)
    listing(options, rows)
    note(options, mending_head(mending))
    path = Path(options.output)
    form = choose_format(mending.foon, path if path.suffix.lower() == ".json" else Path("tree.txt"), None)
    return form.write(mending.foon, mending.functional_units, [f"Mended:\t{row}" for row in rows])


def _write_kitchen(options: argparse.Namespace, target: Path, checks: Checks) -> None:
    needs = dict.fromkeys(node for each in checks for node in each.needs)
    atomic.write_text(target, dumps([object_to_json(node) for node in needs]))
    note(options, f"{target}: {counted(len(needs), 'object')}")
