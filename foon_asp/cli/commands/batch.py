"""`foon-asp batch`: a file of queries, answered here or on a cluster."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Generator, Iterator
from importlib.util import find_spec
from pathlib import Path

from foon_asp.batch.answerer import Settings
from foon_asp.batch.digest import digest
from foon_asp.batch.processes import answer_here, answer_in_processes, cores
from foon_asp.batch.query_file import Chunk, QueryFile
from foon_asp.batch.rows import Rows
from foon_asp.batch.run import RunOptions, chunk_size, files_of, run_batch
from foon_asp.cli import options as add
from foon_asp.cli.inputs import load_data, note_kitchen, paths_to_read, sources, tell_labels
from foon_asp.cli.messages import tell
from foon_asp.cli.output import STDOUT, Reply, file_to_write
from foon_asp.cli.parser import Parser, Renamed
from foon_asp.errors import QueryError
from foon_asp.io.folder import Dataset
from foon_asp.io.overwriting import refuse_inputs
from foon_asp.limits import let_interrupts_finish
from foon_asp.model.levels import FULL


def configure(parser: Parser) -> None:
    """Add the options."""
    add.world(parser)
    parser.add_argument("--queries", required=True, metavar="FILE", help="JSON lines: one query a line")
    parser.add_argument(
        "--jobs",
        type=add.positive,
        metavar="N",
        help="processes (default: one for each core); 1: in this one",
    )
    parser.add_argument("--scheduler", metavar="ADDRESS", help="run on a Dask cluster, tcp://host:8786")
    parser.add_argument("--ship", action="store_true", help="send the data to the workers of the cluster")
    add.limits(parser, "for each query that says none")
    parser.add_argument("--timings", action="store_true", help="say in each result how long it took")
    parser.add_argument("--progress", action="store_true", help="show a bar even if nobody looks on")
    group = parser.add_argument_group("output")
    either = group.add_mutually_exclusive_group(required=True)
    either.add_argument(
        "-o", "--output", dest="target", metavar="OUT", help="output, a file: .parquet, or else JSON lines"
    )
    either.add_argument("--out", dest="target", action=Renamed, new="-o/--output", metavar="OUT")
    add.overwrite(group)
    add.messages(group)


def run(options: argparse.Namespace) -> Reply:
    """Answer the queries."""
    if options.scheduler is not None and options.jobs is not None:
        raise QueryError("--jobs counts processes of this machine; leave it out with --scheduler")
    if options.ship and options.scheduler is None:
        raise QueryError("--ship sends the data to the workers of --scheduler; name one")
    if options.scheduler is not None and find_spec("distributed") is None:
        raise QueryError("a cluster needs Dask: pip install 'foon-asp[cluster]'")
    if options.progress and options.quiet:
        raise QueryError("--quiet shows no bar; leave out --progress")
    if options.target == STDOUT:
        raise QueryError("a run that is stopped goes on from its results; name a file for them")
    # Half an answer must not be taken for one; a run goes on from where it stopped.
    let_interrupts_finish(False)
    target = file_to_write(options.target)
    refuse_inputs(files_of(target), paths_to_read(options))
    queries = QueryFile.scan(Path(options.queries))
    data = sources(options)
    opened = _opened(options)
    alone = options.scheduler is None and options.jobs == 1
    # What others answer from is not kept here, too.
    dataset = opened if alone else None
    del opened
    settings = Settings(options.time_limit, options.memory_limit, options.timings)
    jobs = min(options.jobs or cores(), queries.queries)

    def answer(chunks: Iterator[Chunk]) -> Generator[Rows, None, None]:
        if options.scheduler is not None:
            # Dask takes a second to import.
            from foon_asp.batch.cluster import Scheduler, answer_on_cluster

            return answer_on_cluster(data, settings, chunks, Scheduler(options.scheduler, options.ship))
        if dataset is not None:
            return answer_here(data, dataset, settings, chunks)
        # In a process of its own even on a single core: a query that takes all memory must not end the run.
        return answer_in_processes(data, settings, chunks, jobs)

    shown = options.progress or (sys.stderr.isatty() and not options.quiet)
    how = RunOptions(
        {"data": digest(data), "options": str(settings)},
        chunk_size(queries.queries, jobs),
        options.overwrite,
        sys.stderr if shown else None,
    )
    try:
        summary = run_batch(queries, target, answer, how)
    except KeyboardInterrupt:
        tell("stopped; the same command goes on from here")
        raise
    if data.kitchen is None:
        note_kitchen(options)
    return Reply(summary=f"{options.target}: {summary}")


def _opened(options: argparse.Namespace) -> Dataset:
    """Read the data, and say what is odd in them: processes that answer cannot tell."""
    dataset = load_data(options)
    if dataset.kitchen.labels:
        tell_labels(options, dataset, dataset.world(level=FULL))
    return dataset
