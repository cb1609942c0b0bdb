"""What a task tree must not do: constraints by name, and rules of the user's own."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from foon_asp.errors import counted


@dataclass(frozen=True, slots=True)
class Constraints:
    """Constraints on a task tree; each has a name, so that an explanation can speak of it.

    `without`: labels that no unit touches, by label, contents or relatum. `without_tools`: labels that no
    unit handles, by label or relatum. `only_motions`: None allows all. `use_units`: ids that must be in the
    tree, `avoid_units`: those that must not. `max_depth`: rounds of parallel execution. `min_success`: a
    chance in (0, 1]. `human_steps`: how many steps a human, who never fails, may take over from the robot;
    None: there is no human. `diets`: name and forbidden labels, as `without` but under one name, and labels
    that the FOON does not know are fine. `rules`: texts of answer-set programs over the vocabulary, checked
    by `rules.read_rules`.
    """

    without: tuple[str, ...] = ()
    without_tools: tuple[str, ...] = ()
    avoid_motions: tuple[str, ...] = ()
    only_motions: tuple[str, ...] | None = None
    use_units: tuple[int, ...] = ()
    avoid_units: tuple[int, ...] = ()
    max_units: int | None = None
    max_depth: int | None = None
    min_success: float | None = None
    human_steps: int | None = None
    diets: tuple[tuple[str, tuple[str, ...]], ...] = ()
    rules: tuple[str, ...] = ()

    def named(self) -> Iterator[tuple[str, str, tuple[str | int | float, ...]]]:
        """Yield the kind of each constraint, as `encodings/constraints.lp` has it, its name and values."""
        for label in self.without:
            yield "without", f"without {label}", (label,)
        for diet, labels in self.diets:
            yield "without", f"diet {diet}", labels
        for label in self.without_tools:
            yield "without_tool", f"without tool {label}", (label,)
        for motion in self.avoid_motions:
            yield "avoid_motion", f"avoid motion {motion}", (motion,)
        if self.only_motions is not None:
            yield "only_motion", "only these motions", self.only_motions
        for unit in self.use_units:
            yield "use_unit", f"use unit {unit}", (unit,)
        for unit in self.avoid_units:
            yield "avoid_unit", f"avoid unit {unit}", (unit,)
        if self.max_units is not None:
            yield "max_units", f"at most {self.max_units} units", (self.max_units,)
        if self.max_depth is not None:
            yield "max_depth", f"at most {self.max_depth} rounds", (self.max_depth,)
        if self.min_success is not None:
            yield "max_failure", f"success at least {self.min_success:g}", (self.min_success,)
        if self.human_steps is not None:
            yield "human_steps", f"at most {counted(self.human_steps, 'human step')}", (self.human_steps,)


FREE = Constraints()
"""No constraint at all."""
