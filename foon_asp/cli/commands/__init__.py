"""The commands by name. A module of this folder is imported when its command runs, and not before."""

from __future__ import annotations

from foon_asp.cli.parser import Command


def _command(name: str, summary: str, description: str = "") -> Command:
    return Command(f"{__name__}.{name}", summary, description)


COMMANDS = {
    "retrieve": _command("retrieve", "retrieve a task tree for a goal"),
    "explain": _command("explain", "say why there is no task tree, or what its steps are for"),
    "draw": _command("draw", "draw task trees, plans, menus, FOONs, and what is missing"),
    "suggest": _command("suggest", "say what can be cooked, the best dishes first"),
    "menu": _command("menu", "make several dishes, and share their steps"),
    "adapt": _command("adapt", "adapt the nearest dish: with some ingredients, without others"),
    "reach": _command("reach", "say what the kitchen can make"),
    "compare": _command("compare", "compare all methods, reference and founded, with the proven optimum"),
    "check": _command("check", "replay trees that others made, and say what is wrong with them"),
    "consolidate": _command("consolidate", "make several trees of one dish into one"),
    "query": _command("query", "run rules of your own over the facts"),
    "batch": _command("batch", "answer a file of queries, here or on a cluster"),
    "plan": _command("plan", "plan with things being used up, by any engine"),
    "explore": _command(
        "explore",
        "write a page in which a browser searches, plans and draws",
        "Write a page with the FOON, the kitchen and the solver, which a browser needs nothing else for.",
    ),
    "schedule": _command("schedule", "say who does what when, in the least time"),
    "engines": _command("engines", "list planning engines", "List planning engines and how to install them."),
    "pddl": _command("pddl", "write PDDL, read plans", "Write PDDL, and read plans that were made from it."),
    "facts": _command("facts", "print the facts that clingo is given"),
    "audit": _command("audit", "find what is wrong in FOON files, and the mends"),
    "stats": _command("stats", "count what is in a FOON"),
    "convert": _command("convert", "write FOON files in another format"),
    "merge": _command("merge", "merge FOON files into a universal FOON"),
    "compile": _command("compile", "compile FOON files into a store that opens quickly, however large"),
    "goals": _command("goals", "list the goals of the data folder"),
}

PDDL_COMMANDS = {
    "export": _command("pddl_export", "write a domain, a problem and a map of names"),
    "decode": _command("pddl_decode", "read a plan that another planner made"),
}
"""The commands of `foon-asp pddl`."""
