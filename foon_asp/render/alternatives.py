"""Several task trees of one goal: a line for each, then their steps."""

from __future__ import annotations

from foon_asp.render.proof import limit_text
from foon_asp.render.tree import costs_parts, not_executable, steps_text
from foon_asp.retrieval.alternatives import Alternatives
from foon_asp.words import counted


def alternatives_text(result: Alternatives) -> str:
    """Write several task trees: a line for each, then their steps."""
    by = ",".join(result.by)
    lines = [str(result.goal)]
    count = len(result.trees)
    if result.status == "unreachable":
        return "\n".join([*lines, f"no task tree: {result.reason}"]) + "\n"
    lines.append(_HEADINGS[result.kind].format(trees=counted(count, "task tree"), by=by))
    if result.status == "limit" and not result.proven:
        words = "the best task tree before the {}, not proven" if count else "none was found before the {}"
        lines[-1] = words.format(limit_text(result.limit))
    elif result.status == "limit":
        lines[-1] += f", before the {limit_text(result.limit)}; there may be others"
    elif result.complete:
        lines[-1] += "; there are no others"
    elif result.kind == "all optimal":
        lines[-1] += ", and there are more"
    shown = result.trees
    if result.kind == "all optimal" and count > 1:
        common = frozenset.intersection(*(frozenset(tree.units) for tree in result.trees))
        lines.append(f"they have {counted(len(common), 'step')} in common; this is one of them:")
        if stuck := sum(not tree.executable for tree in result.trees):
            lines.insert(-1, f"NOT EXECUTABLE in any order: {stuck} of them")
        shown = result.trees[:1]
    for place, tree in enumerate(shown, 1):
        head = f"{place}) " if len(shown) > 1 else ""
        lines += ["", head + (", ".join(costs_parts(tree, result.by)) if tree.units else "nothing to do")]
        if place > 1:
            same = len({*tree.units} & {*result.trees[0].units})
            lines[-1] += f" ({counted(same, 'step')} as in 1)"
        lines += [*not_executable(tree), *steps_text(tree)]
    return "\n".join(lines) + "\n"


_HEADINGS = {
    "best": "the {trees} that are best by {by}, proven",
    "all optimal": "{trees} optimal by {by}, proven",
    "diverse": "{trees} as different as possible, the first one optimal by {by}, proven",
    "pareto": "{trees} that nothing beats by {by} at once, proven",
}
