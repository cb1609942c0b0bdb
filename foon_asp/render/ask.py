"""What rules of one's own show, as tables."""

from __future__ import annotations

from foon_asp.asp.ask import RulesAnswer, Table
from foon_asp.asp.terms import Term, written
from foon_asp.limits import ended
from foon_asp.render.proof import limit_text, proof_text
from foon_asp.render.table import Cell, table
from foon_asp.words import counted


def query_text(answer: RulesAnswer) -> str:
    """Write a table for each predicate, and above them what else is to be known."""
    blocks = ["\n".join(lines) for lines in [_verdict(answer)] if lines]
    if answer.tables is not None:
        blocks += ["\n".join(_table(each)) for each in answer.tables]
        if not answer.tables:
            blocks.append("the rules show nothing")
    return "\n\n".join(blocks) + "\n"


def _verdict(answer: RulesAnswer) -> list[str]:
    if answer.tables is None:
        if answer.status == "limit":
            return [f"no stable model was found before the {limit_text(answer.limit)}"]
        return ["the rules have no stable model"]
    lines = []
    if answer.costs:
        proof = proof_text(answer.status, answer.limit)
        lines.append(f"cost {', '.join(map(str, answer.costs))} ({proof})")
    others = "other models that are as good" if answer.costs else "other stable models"
    if answer.more:
        lines.append(f"one answer of several: {others} show something else")
    elif answer.more is None and answer.status != "limit":
        lines.append(f"{ended(answer.limit)} before it was known whether {others} show something else")
    return lines


def _table(shown: Table) -> list[str]:
    heading = shown.heading
    if not heading.arity:
        return [f"{heading.name}: {'yes' if shown.rows else 'no'}"]
    if heading.columns:
        title = f"{heading.name}({', '.join(heading.columns)})"
    else:
        title = f"{heading.name or 'terms'}/{heading.arity}"
    lines = [f"{title}: {counted(len(shown.rows), 'row') if shown.rows else 'none'}"]
    rows = [[_cell(term) for term in row] for row in shown.rows]
    return lines + [line.rstrip() for line in table(rows, *["="] * heading.arity)]


def _cell(term: Term) -> Cell:
    return term if isinstance(term, int) else written(term).replace("\n", "\\n")
