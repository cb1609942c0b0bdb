"""Answers as graphs of networkx."""

from __future__ import annotations

import networkx as nx

from foon_asp.model.foon import Foon
from foon_asp.retrieval.tree import TaskTree


def tree_graph(tree: TaskTree) -> nx.DiGraph:
    """Return a task tree as a directed graph of object nodes and steps.

    Object nodes are `ObjectNode`s with `kind="object"`, `goal` and `at_hand`; steps are their places (1, 2,
    …) with `kind="motion"`, `motion`, `unit` and `human`. Edges lead from what a step takes to the step, and
    from the step to what it makes.
    """
    graph = nx.DiGraph()
    goals = {tree.world.node(goal) for goal in tree.goals}
    at_hand = set(tree.world.kitchen.objects)
    for step in tree.steps:
        for node in (*step.takes, *step.makes):
            graph.add_node(node, kind="object", goal=node in goals, at_hand=node in at_hand)
        graph.add_node(step.place, kind="motion", motion=step.motion, unit=step.unit, human=step.human)
        graph.add_edges_from((node, step.place) for node in step.takes)
        graph.add_edges_from((step.place, node) for node in step.makes)
    for goal in goals:
        graph.add_node(goal, kind="object", goal=True, at_hand=goal in at_hand)
    return graph


def foon_graph(foon: Foon) -> nx.DiGraph:
    """Return a FOON as a directed graph of object nodes and units.

    Object nodes are `ObjectNode`s with `kind="object"`; units are their ids (0, 1, …) with `kind="motion"`,
    `motion` and `source`. Edges lead from inputs to units, and from units to outputs, as they are annotated.
    """
    graph = nx.DiGraph()
    for node in foon.objects:
        graph.add_node(node, kind="object")
    for unit in foon.units:
        graph.add_node(unit.id, kind="motion", motion=unit.motion, source=str(unit.source))
        graph.add_edges_from((foon.objects[number], unit.id) for number in unit.inputs)
        graph.add_edges_from((unit.id, foon.objects[number]) for number in unit.outputs)
    return graph
