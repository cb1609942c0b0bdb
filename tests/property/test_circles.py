"""The groups that lock a goal, held against their definition."""

from __future__ import annotations

from random import Random

from foon_asp.model.node import ObjectId
from foon_asp.query.unreachable import _closed_groups


def defined(start: ObjectId, steps: dict[ObjectId, list[ObjectId]]) -> list[list[ObjectId]]:
    """Return each set of nodes that lead to each other and nowhere else, the nearest to the start first."""
    after = {node: beyond(node, steps) for node in steps}
    near = [start]
    for node in near:
        near += [other for other in dict.fromkeys(steps[node]) if other not in near]
    groups: list[list[ObjectId]] = []
    for node in near:
        if all(node in after[other] for other in after[node]) and not any(node in group for group in groups):
            groups.append([other for other in near if other in after[node]])
    return groups


def beyond(node: ObjectId, steps: dict[ObjectId, list[ObjectId]]) -> set[ObjectId]:
    found, queue = {node}, [node]
    for each in queue:
        queue += [other for other in dict.fromkeys(steps[each]) if other not in found]
        found.update(queue)
    return found


def drawn(seed: int) -> dict[ObjectId, list[ObjectId]]:
    random = Random(seed)
    size = random.randint(1, 12)
    most = random.choice([1, 2, 2, 3])
    nodes = [ObjectId(number) for number in range(size)]
    return {
        node: random.sample(nodes, random.randint(random.random() < 0.8, min(most, size))) for node in nodes
    }


def test_closed_groups_are_those_of_the_definition() -> None:
    several = large = 0
    for seed in range(3000):
        steps = drawn(seed)
        groups = _closed_groups(ObjectId(0), steps)
        assert groups == defined(ObjectId(0), steps)
        several += len(groups) > 1
        large += any(len(group) > 2 for group in groups)
    assert several > 50
    assert large > 300
