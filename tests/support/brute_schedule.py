"""The least makespan by trying everything, second by second; only the effects are the scheduler's."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from foon_asp.model.consumption import Effects
from foon_asp.model.node import ObjectId, UnitId

Running = tuple[tuple[UnitId, int], ...]
"""What is being done, each with the seconds that it still takes."""

State = tuple[frozenset[ObjectId], tuple[tuple[ObjectId, int], ...], Running]
"""What was made and is there, how many are left of what the kitchen counts, and what is being done."""


class Kitchen:
    """Whatever can be done with so many hands, of which each unit takes one, or none if it goes by itself."""

    def __init__(
        self, effects: Effects, seconds: Mapping[UnitId, int], hands: int, passive: frozenset[UnitId]
    ) -> None:
        self.effects, self.seconds, self.hands, self.passive = effects, seconds, hands, passive

    def least(self, goals: Sequence[ObjectId], most: int) -> int | None:
        """Return the least makespan; None if no schedule reaches the goals within so many states."""
        layer: set[State] = {(frozenset(), tuple(sorted(self.effects.counted.items())), ())}
        seen: set[State] = set()
        now = 0
        while layer:
            layer = {self.ended(state) for state in layer}
            if any(all(self.has(state, goal) for goal in goals) for state in layer):
                return now
            following: set[State] = set()
            for state in layer - seen:
                following.update(self.begun(state, 0, ()))
            seen |= layer
            assert len(seen) <= most
            layer = {
                (made, left, tuple((unit, rest - 1) for unit, rest in running))
                for made, left, running in following
                if running
            }
            now += 1
        return None

    def has(self, state: State, thing: ObjectId) -> bool:
        made, left, _ = state
        return thing in self.effects.endless or thing in made or dict(left).get(thing, 0) > 0

    def ended(self, state: State) -> State:
        """Have what ends now."""
        for unit, rest in state[2]:
            if rest == 0:
                restored = [each for each in self.effects.restores(unit) if not self.has(state, each)]
                state = (state[0] | {*self.effects.adds(unit), *restored}, state[1], state[2])
        return (state[0], state[1], tuple(each for each in state[2] if each[1] > 0))

    def without(self, state: State, things: Sequence[ObjectId]) -> State:
        made, left = set(state[0]), dict(state[1])
        for thing in things:
            if thing in made:
                made.remove(thing)
            elif left.get(thing, 0):
                left[thing] -= 1
        return (frozenset(made), tuple(sorted(left.items())), state[2])

    def begun(self, state: State, first: int, views: tuple[ObjectId, ...]) -> Iterator[State]:
        """Yield what can be begun now, in the order of the units; `views` goes besides, at last.

        Who needs something takes it first; what is taken without a need goes then, and whatever is being done
        must still have all that it needs and does not use up.
        """
        effects = self.effects
        last = self.without(state, views)
        kept = {
            need for unit, _ in state[2] for need in set(effects.needs(unit)) - set(effects.deletes(unit))
        }
        if all(self.has(last, need) for need in kept):
            yield last
        units = list(self.seconds)
        for place in range(first, len(units)):
            unit = units[place]
            busy = sum(each not in self.passive for each, _ in state[2])
            if unit not in self.passive and busy >= self.hands:
                continue
            needs, deletes = effects.needs(unit), effects.deletes(unit)
            if not all(self.has(state, need) for need in needs):
                continue
            after = self.without(state, [each for each in deletes if each in needs])
            running = tuple(sorted((*state[2], (unit, self.seconds[unit]))))
            more = (*views, *(each for each in deletes if each not in needs))
            # What goes by itself is begun once at a time: twice at once makes no more.
            yield from self.begun((after[0], after[1], running), place + (unit in self.passive), more)
