"""The answer to a query as tables and as a JSON value."""

from __future__ import annotations

from typing import Any

from foon_asp.errors import counted
from foon_asp.query import Function, QueryAnswer, Table, Term, written
from foon_asp.state_syntax import object_to_json


def query_text(answer: QueryAnswer) -> str:
    """Write a table for each predicate, and above them what else is to be known."""
    blocks = ["\n".join(lines) for lines in [_verdict(answer)] if lines]
    if answer.tables is not None:
        blocks += ["\n".join(_table(table)) for table in answer.tables]
        if not answer.tables:
            blocks.append("the rules show nothing")
    return "\n\n".join(blocks) + "\n"


def _verdict(answer: QueryAnswer) -> list[str]:
    if answer.tables is None:
        if answer.status == "limit":
            return ["no stable model was found before the time limit"]
        return ["the rules have no stable model"]
    lines = []
    if answer.costs:
        proof = "proven optimal" if answer.status == "optimal" else "time limit, not proven"
        lines.append(f"cost {', '.join(map(str, answer.costs))} ({proof})")
    others = "other models that are as good" if answer.costs else "other stable models"
    if answer.more:
        lines.append(f"one answer of several: {others} show something else")
    elif answer.more is None and answer.status != "limit":
        lines.append(f"the time ran out before it was known whether {others} show something else")
    return lines


def _table(table: Table) -> list[str]:
    heading = table.heading
    if not heading.arity:
        return [f"{heading.name}: {'yes' if table.rows else 'no'}"]
    if heading.columns:
        title = f"{heading.name}({', '.join(heading.columns)})"
    else:
        title = f"{heading.name or 'terms'}/{heading.arity}"
    lines = [f"{title}: {counted(len(table.rows), 'row') if table.rows else 'none'}"]
    columns = [_column([row[place] for row in table.rows]) for place in range(heading.arity)]
    lines += ["  ".join(cells).rstrip() for cells in zip(*columns, strict=True)]
    return lines


def _column(terms: list[Term]) -> list[str]:
    """Write the cells of a column, all of one width: numbers to the right, all else to the left."""
    cells = [written(term).replace("\n", "\\n") for term in terms]
    width = max(map(len, cells), default=0)
    return [
        cell.rjust(width) if isinstance(term, int) else cell.ljust(width)
        for term, cell in zip(terms, cells, strict=True)
    ]


def query_value(answer: QueryAnswer) -> dict[str, Any]:
    """Return the value that `query --format json` writes."""
    return {
        "goals": [object_to_json(goal) for goal in answer.goals],
        "status": answer.status,
        "costs": list(answer.costs),
        "more": answer.more,
        "predicates": None
        if answer.tables is None
        else [
            {
                "name": table.heading.name,
                "arity": table.heading.arity,
                "columns": list(table.heading.columns),
                "count": len(table.rows),
                "rows": [[_term_value(term) for term in row] for row in table.rows],
            }
            for table in answer.tables
        ],
        "seconds": round(answer.seconds, 6),
    }


def _term_value(term: Term) -> Any:
    if isinstance(term, tuple):
        return [_term_value(each) for each in term]
    if isinstance(term, Function):
        return {"name": term.name, "arguments": [_term_value(each) for each in term.arguments]}
    return term
