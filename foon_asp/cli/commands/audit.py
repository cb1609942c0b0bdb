"""`foon-asp audit`: what is wrong in FOON files, and the mends."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

from foon_asp.audit.audit import audit
from foon_asp.audit.wire import audit_json
from foon_asp.cli import options as add
from foon_asp.cli.inputs import note_kitchen, paths_to_read, sources
from foon_asp.cli.messages import listing, note, warn
from foon_asp.cli.output import STDOUT, Reply, check_targets
from foon_asp.cli.parser import Parser
from foon_asp.errors import QueryError
from foon_asp.io import atomic
from foon_asp.io.document import is_json
from foon_asp.io.files import is_store, read_bytes
from foon_asp.io.findings import Severity
from foon_asp.io.mend import mend_text
from foon_asp.io.open import FoonReader, decode
from foon_asp.io.overwriting import refuse_inputs
from foon_asp.io.unknown_words import unknown
from foon_asp.io.wire import dumps
from foon_asp.model.levels import FULL
from foon_asp.render.audit import audit_text
from foon_asp.render.sarif import sarif_value
from foon_asp.resources import program_version
from foon_asp.words import counted


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    parser.add_argument(
        "files", nargs="*", metavar="FILE", help="FOON files; kitchen.json etc. beside the first are used"
    )
    add.goals_file(parser)
    words = [severity.word for severity in Severity]
    parser.add_argument(
        "--severity",
        choices=words,
        default=Severity.NOTE.word,
        help="the least severity that the table shows (default: note)",
    )
    parser.add_argument(
        "--fail-on",
        choices=words,
        help="exit with 1 if there is a finding of this severity or a higher one",
    )
    parser.add_argument(
        "--fix", action="store_true", help="write NAME.fixed beside each file with certain mends"
    )
    parser.add_argument("--fix-dir", metavar="DIR", help="write repaired copies into this folder instead")
    add.limits(parser, "for the whole audit")
    add.output(parser, "text", "json", "sarif")


def run(options: argparse.Namespace) -> Reply:
    """Audit, and write repaired copies."""
    fixing = options.fix or options.fix_dir is not None
    if fixing and not options.files:
        raise QueryError("name the files to repair: foon-asp audit --fix FILE…")
    read = sources(options)
    dataset = replace(read, goals=options.goals or read.goals).load()
    if fixing:
        _fix_all(options)
    world = dataset.world(level=FULL)
    if not dataset.kitchen.stated:
        note_kitchen(options, world)
    findings = [*dataset.findings, *unknown(dataset, world)]
    report = audit(
        dataset.foon,
        dataset.kitchen,
        dataset.goals,
        findings,
        time_limit=options.time_limit,
        memory_limit=options.memory_limit,
    )
    worst = max((finding.severity for finding in report.findings), default=None)
    least = Severity[options.severity.upper()]
    return Reply(
        lambda: audit_text(report, least),
        lambda: audit_json(report),
        {"sarif": lambda: dumps(sarif_value(report.findings, program_version()))},
        [report.status],
        failed=bool(options.fail_on and worst is not None and worst >= Severity[options.fail_on.upper()]),
    )


def _fix_all(options: argparse.Namespace) -> None:
    """Write a repaired copy of each file, beside it or in a folder; none if one must not be written."""
    paths = [Path(name) for name in options.files]
    if options.fix_dir is None:
        targets = [path.with_name(f"{path.stem}.fixed{path.suffix}") for path in paths]
    else:
        targets = [Path(options.fix_dir) / path.name for path in paths]
    report = [] if options.output == STDOUT else [Path(options.output)]
    refuse_inputs([*targets, *report], paths_to_read(options))
    fixes = {target: _mended(options, path) for path, target in zip(paths, targets, strict=True)}
    written = {target: found for target, found in fixes.items() if found is not None}
    check_targets(options, *written)
    for target, (text, rows) in written.items():
        atomic.write_text(target, text)
        listing(options, rows)
        note(options, f"{target}: {counted(len(rows), 'mend')}")


def _mended(options: argparse.Namespace, path: Path) -> tuple[str, list[str]] | None:
    """Return the text of a file with the certain mends, and a row for each; nothing if there are none."""
    if is_store(path):
        warn(options, f"{path}: only text files can be repaired; repair the files that it was compiled from")
        return None
    data = read_bytes(path)
    text, encoding = decode(data, str(path))
    if is_json(text):
        warn(options, f"{path}: only text files can be repaired")
        return None
    reader = FoonReader(words=options.vocabulary)
    reader.read_data(data, path)
    mended, mends = mend_text(text, reader.finish().findings)
    rows = [f"{finding.file}:{finding.line}: {finding.code}: {finding.mend}" for finding in mends]
    rows += [f"{finding.file}:{finding.line}: {finding.code}: saved as UTF-8" for finding in encoding]
    if not rows:
        note(options, f"{path}: nothing to mend")
        return None
    return mended, list(dict.fromkeys(rows))
