"""What is said of task trees as JSON: each shape declared once, beside the function that makes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import Meta

from foon_asp.io.findings import ODDITIES
from foon_asp.io.object_wire import ObjectJson, SourceJson, UnitJson, object_to_json
from foon_asp.io.text import write_text
from foon_asp.io.trees import Listing
from foon_asp.io.wire import UNIQUE, Count, JsonObject, LimitName, Place, Text, means, word
from foon_asp.model.node import Source
from foon_asp.model.world import World
from foon_asp.retrieval.prompt import prompt
from foon_asp.retrieval.wire import objects_json

if TYPE_CHECKING:
    # The answers import this module, to write themselves.
    from foon_asp.retrieval.check import Check, CheckedStep, Checks, Lack
    from foon_asp.retrieval.mend import Edit, Mending


class NearestJson(JsonObject):
    """Something that there is and that resembles what a step lacks."""

    of: Annotated[ObjectJson, means("What the step lacks.")]
    object: Annotated[ObjectJson, means("What resembles it.")]
    difference: Annotated[
        Literal["later", "place", "state", "name"],
        means(
            "later: it is the same, and made later. place: it is elsewhere. state: it is in another state. "
            "name: it is called otherwise, perhaps misspelt."
        ),
    ]
    step: Annotated[Place | None, means("The step that makes it; null if it is from the kitchen.")]


class LikelyJson(JsonObject):
    """A unit of the known FOON that would make what a step lacks, of what is at hand before it."""

    closes: Annotated[ObjectJson, means("What the step lacks.")]
    unit: Annotated[UnitJson, means("The unit.")]
    text: Annotated[Text, means("The unit as FOON text.")]
    lacks: Annotated[
        list[ObjectJson], means("Tools that it needs and that are not at hand: bare objects, empty utensils.")
    ]


class CheckedStepJson(JsonObject):
    """A step of a tree, and what is wrong with it."""

    step: Annotated[Place, means("Its place in the order of the file, from 1.")]
    motion: Annotated[Text, means("The motion.")]
    inputs: Annotated[list[ObjectJson], means("The objects listed before the motion.")]
    outputs: Annotated[list[ObjectJson], means("The objects listed behind the motion.")]
    source: Annotated[SourceJson, means("Where it stands.")]
    missing: Annotated[list[ObjectJson], means("What it needs, and nothing has made by then.")]
    doubtful: Annotated[
        list[ObjectJson],
        means(
            "What it needs of a kitchen that was not named, though steps before have had the same in "
            "another state or place."
        ),
    ]
    nearest: Annotated[list[NearestJson], means("What resembles what is missing or doubtful.")]
    likely: Annotated[list[LikelyJson], means("The steps that most likely lack before it.")]
    idle: Annotated[bool, means("Whether it brings about nothing that was not there.")]
    unused: Annotated[
        bool, means("Whether no later step takes what it makes, and the tree is not for it; false if idle.")
    ]


class ReadJson(JsonObject):
    """What was odd in the file of a tree."""

    code: Annotated[
        str,
        Meta(extra_json_schema={"enum": [*ODDITIES]}),
        means("What kind of finding it is (docs/format.md)."),
    ]
    severity: Annotated[
        Literal["note", "warning", "error"], means("How much it matters; an error loses data.")
    ]
    line: Annotated[Count, means("The line, from 1; 0 if it is about no line.")]
    message: Annotated[Text, means("What was found, in one sentence.")]


class EditJson(JsonObject):
    """One edit of a tree."""

    edit: Annotated[Literal["move", "insert", "remove", "change"], means("What is done.")]
    step: Annotated[Place | None, means("The step in the order of the file; null if it is inserted.")]
    to: Annotated[Place | None, means("The step in the mended tree; null if it is removed.")]
    motion: Annotated[Text, means("The motion of the step.")]
    source: Annotated[SourceJson, means("Where the step stands, or the unit that is inserted.")]
    side: Annotated[
        Literal["input", "output"] | None, means("On which side an object is changed; null if none is.")
    ]
    before: Annotated[ObjectJson | None, means("The object that is changed; null if none is.")]
    after: Annotated[ObjectJson | None, means("What it becomes; null if none is changed.")]
    cost: Annotated[Place, means("How many edits it counts as: one for each state or place that changes.")]


class MendedUnitJson(JsonObject):
    """A step of the mended tree."""

    motion: Annotated[Text, means("The motion.")]
    inputs: Annotated[list[ObjectJson], means("The objects listed before the motion.")]
    outputs: Annotated[list[ObjectJson], means("The objects listed behind the motion.")]


class MendJson(JsonObject):
    """The fewest edits after which a tree can be executed and makes what it is for."""

    cost: Annotated[Count | None, means("How many edits there are; null if none do.")]
    proven: Annotated[bool, means("Whether there are no fewer, or none at all.")]
    edits: Annotated[list[EditJson], means("The edits, in the order of the file, inserted steps last.")]
    units: Annotated[list[MendedUnitJson], means("The steps of the mended tree, in the order of execution.")]
    limit: LimitName


class CheckJson(JsonObject):
    """A task tree that someone else made, replayed in the order of its file and judged (docs/checking.md)."""

    tree: Annotated[Text, means("Its file, with its place there if there are several.")]
    executable: Annotated[
        bool,
        means("Whether each step has all that it needs, in the order of the file; false without any step."),
    ]
    semantics: Annotated[
        Literal["add", "transform", "consume"],
        means(
            "What is used up: nothing; what becomes or goes into an output; every input that is not an "
            "output again."
        ),
    ]
    steps: Annotated[list[CheckedStepJson], means("The steps in the order of the file.")]
    goals: Annotated[list[ObjectJson], means("What it is for: what it marks, else what its last step makes.")]
    needs: Annotated[
        list[ObjectJson],
        means(
            "What it needs from a kitchen: what no earlier step makes. With this its order can be executed."
        ),
    ]
    order: Annotated[
        list[Place] | None,
        UNIQUE,
        means("Another order of the steps that can be executed; null if none was found, or none is needed."),
    ]
    findings: Annotated[list[ReadJson], means("What was odd in the file.")]
    mend: Annotated[
        MendJson | None, means("The fewest edits; null if they were not asked for, or there is no step.")
    ]
    prompt: Annotated[Text, means("All of this as a paragraph for a language model that is to try again.")]


def checks_json(checks: Checks) -> CheckJson | list[CheckJson]:
    """Return what `check --format json` writes: one tree, or a list of several."""
    found = [_check(each) for each in checks]
    return found[0] if len(found) == 1 and not checks.skipped else found


def _check(found: Check) -> CheckJson:
    return CheckJson(
        tree=found.name,
        executable=found.executable,
        semantics=word(found.query.semantics),
        steps=[_step(found.world, step) for step in found.steps],
        goals=objects_json(found.goals),
        needs=objects_json(found.needs),
        order=None if found.order is None else list(found.order),
        findings=[
            ReadJson(each.code, word(each.severity.word), each.line, each.message)
            for each in found.listing.findings
        ],
        mend=None if found.mending is None else _mend(found.mending, found.listing),
        prompt=prompt(found),
    )


def _mend(mending: Mending, listing: Listing) -> MendJson:
    node = mending.foon.objects.__getitem__
    return MendJson(
        cost=None if mending.edits is None else mending.cost,
        proven=mending.proven,
        edits=[_edit(edit, listing) for edit in mending.edits or ()],
        units=[
            MendedUnitJson(
                unit.motion, objects_json(map(node, unit.inputs)), objects_json(map(node, unit.outputs))
            )
            for unit in mending.functional_units
        ],
        limit=mending.limit,
    )


def _edit(edit: Edit, listing: Listing) -> EditJson:
    before, after = (None if node is None else object_to_json(node) for node in (edit.before, edit.after))
    source = edit.unit.source if edit.step is None else listing.sources[edit.step - 1]
    return EditJson(
        edit=edit.kind,
        step=edit.step,
        to=edit.to,
        motion=edit.unit.motion,
        source=_source(source),
        side=edit.side,
        before=before,
        after=after,
        cost=edit.cost,
    )


def _step(world: World, step: CheckedStep) -> CheckedStepJson:
    lacks = (*step.missing, *step.doubtful)
    return CheckedStepJson(
        step=step.place,
        motion=step.unit.motion,
        inputs=objects_json(map(world.node, step.unit.inputs)),
        outputs=objects_json(map(world.node, step.unit.outputs)),
        source=_source(step.source),
        missing=objects_json(each.node for each in step.missing),
        doubtful=objects_json(each.node for each in step.doubtful),
        nearest=[near for lack in lacks for near in _nearest(lack)],
        likely=[_likely(world, lack) for lack in lacks if lack.likely is not None],
        idle=step.idle,
        unused=step.unused,
    )


def _source(source: Source) -> SourceJson:
    return SourceJson(source.file, source.line, source.video)


def _nearest(lack: Lack) -> list[NearestJson]:
    of = object_to_json(lack.node)
    return [NearestJson(of, object_to_json(each.node), each.difference, each.step) for each in lack.nearest]


def _likely(world: World, lack: Lack) -> LikelyJson:
    assert lack.likely is not None
    unit = lack.likely.unit
    return LikelyJson(
        object_to_json(lack.node),
        UnitJson.of(world.foon, unit),
        write_text(world.foon, [unit]),
        objects_json(lack.likely.lacks),
    )
