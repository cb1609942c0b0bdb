"""What audit and statistics are as JSON: each shape declared once, beside the function that makes it."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Literal

from msgspec import UNSET, Meta, UnsetType, field

from foon_asp.io.findings import ODDITIES, Finding
from foon_asp.io.object_wire import ObjectJson, object_to_json
from foon_asp.io.wire import FEW, UNIQUE, Amount, Count, JsonObject, LimitName, Place, Text, means, word

if TYPE_CHECKING:
    # The answers import this module, to write themselves.
    from foon_asp.audit.audit import Audit, LockedGoal
    from foon_asp.audit.locks import Lock
    from foon_asp.audit.stats import Centralities, Centrality, Statistics

CODES = (
    "does-nothing",
    "output-is-input",
    "content-appears",
    "content-vanishes",
    "not-in-container",
    "empty-but-contains",
    "holds-itself",
    "unknown-label",
    "nowhere-from",
    "never-runs",
    "locked",
    "goal-locked",
    "spelling",
    "motion-without-rate",
    "unknown-object",
    "unknown-goal",
    "ambiguous-label",
    "label-alone",
    "ambiguous-goal",
    "unknown-word",
    "times-overlap",
    "times-out-of-order",
)
"""The codes of the findings of the audit, beside those of reading."""


class FindingJson(JsonObject):
    """One sentence about one place."""

    code: Annotated[
        str,
        Meta(extra_json_schema={"enum": [*ODDITIES, *CODES]}),
        means(
            "What kind of finding it is: those of reading (docs/format.md), then those of the audit "
            "(docs/audit.md)."
        ),
    ]
    severity: Annotated[Literal["note", "warning", "error"], means("How much it matters.")]
    file: Annotated[
        str, means("The file, named as it was given; empty if the finding is about no place in a file.")
    ]
    line: Annotated[Count, means("The line, from 1; 0 if the finding is about no line.")]
    message: Annotated[Text, means("What was found, in one sentence.")]
    mend: Annotated[
        Text | None, means("What to write instead or what would help; null if that is not known.")
    ]


def _finding(finding: Finding) -> FindingJson:
    return FindingJson(
        code=finding.code,
        severity=word(finding.severity.word),
        file=finding.file,
        line=finding.line,
        message=finding.message,
        mend=finding.mend or None,
    )


class LockJson(JsonObject):
    """A need that keeps units from ever running, and the edit that opens most of them: in `unit`, `need`
    is replaced by `replacement`.
    """

    unit: Annotated[
        Count,
        means(
            "The unit to edit. This and other ids count the units of the FOON from 0, duplicates left out."
        ),
    ]
    file: Annotated[str, means("The file in which it stands.")]
    line: Annotated[Count, means("The line on which it begins.")]
    need: Annotated[ObjectJson, means("The input that cannot be had.")]
    replacement: Annotated[
        ObjectJson | None,
        means(
            "What was probably meant; null if nothing that can be had resembles the need, so that it has "
            "to be taken away or made."
        ),
    ]
    circle: Annotated[
        list[Count],
        UNIQUE,
        means(
            "Ids of the units that keep the need from being made, `unit` among them; empty if nothing "
            "makes it."
        ),
    ]
    opens: Annotated[
        list[Count],
        UNIQUE,
        FEW,
        means("Ids of the units that can run after the edit and those of the locks before."),
    ]
    unlocks: Annotated[
        list[ObjectJson],
        means("The goals that can be made then, or else the end products: objects that no unit needs."),
    ]


def _lock(lock: Lock) -> LockJson:
    return LockJson(
        unit=lock.unit.id,
        file=lock.unit.source.file,
        line=lock.unit.source.line,
        need=object_to_json(lock.need),
        replacement=object_to_json(lock.replacement) if lock.replacement else None,
        circle=[unit.id for unit in lock.circle],
        opens=[unit.id for unit in lock.opens],
        unlocks=[object_to_json(node) for node in lock.unlocks],
    )


class LockedGoalJson(JsonObject):
    """A goal that the kitchen can never make."""

    goal: Annotated[ObjectJson, means("The goal.")]
    missing: Annotated[
        Annotated[list[ObjectJson], FEW] | None,
        means("The smallest set of objects that the kitchen would have to have; null if no set helps."),
    ]


def _locked_goal(locked: LockedGoal) -> LockedGoalJson:
    missing = locked.missing
    return LockedGoalJson(
        goal=object_to_json(locked.goal),
        missing=None if missing is None else [object_to_json(node) for node in missing],
    )


class AuditJson(JsonObject):
    """What is odd, doubtful or locked in FOON files (docs/audit.md). Options that choose what the table
    shows leave this as it is.
    """

    findings: Annotated[list[FindingJson], means("All findings, sorted by file, line, code and message.")]
    locks: Annotated[
        list[LockJson],
        means(
            "Groups of units that never run, the one that opens most first. Each is described as if "
            "those before it were mended."
        ),
    ]
    locked_goals: Annotated[list[LockedGoalJson], means("The goals that the kitchen can never make.")]
    limit: LimitName


def audit_json(report: Audit) -> AuditJson:
    """Return what `audit --format json` writes."""
    return AuditJson(
        findings=[_finding(finding) for finding in report.findings],
        locks=[_lock(lock) for lock in report.locks],
        locked_goals=[_locked_goal(locked) for locked in report.locked_goals],
        limit=report.limit,
    )


class LevelJson(JsonObject):
    """What a FOON has on one level."""

    units: Annotated[Count, means("Functional units.")]
    objects: Annotated[Count, means("Object nodes.")]


class LevelsJson(JsonObject):
    """The levels of detail."""

    labels: Annotated[LevelJson, means("Labels alone.")] = field(name="1")
    states: Annotated[LevelJson, means("Labels and states.")] = field(name="2")
    full: Annotated[LevelJson, means("All that is written.")] = field(name="3")


class SpreadJson(JsonObject):
    """Mean and maximum of a degree."""

    mean: Annotated[Amount, means("The mean, not rounded; 0 if there is nothing to count.")]
    maximum: Annotated[Count, means("The maximum.")]


class DegreesJson(JsonObject):
    """Degrees, as mean and maximum."""

    makers: Annotated[SpreadJson, means("Units that list an object as output, by object.")]
    users: Annotated[SpreadJson, means("Units that list an object as input, by object.")]
    inputs: Annotated[SpreadJson, means("Input objects, by unit.")]
    outputs: Annotated[SpreadJson, means("Output objects, by unit.")]


class UsedObjectJson(JsonObject):
    """An object and how many units use it."""

    object: Annotated[ObjectJson, means("The object node.")]
    count: Annotated[Place, means("Units that list it as input.")]


class UsedMotionJson(JsonObject):
    """A motion and how many units have it."""

    motion: Annotated[Text, means("The label of the motion.")]
    count: Annotated[Place, means("Units with this motion.")]


class MostUsedJson(JsonObject):
    """Objects by the units that list them as inputs, motions by the units that have them."""

    objects: Annotated[list[UsedObjectJson], Meta(max_length=10), means("Objects, the most used first.")]
    motions: Annotated[list[UsedMotionJson], Meta(max_length=10), means("Motions, the most used first.")]


class CentralObjectJson(JsonObject):
    """An object and its centrality."""

    object: Annotated[ObjectJson, means("The object node.")]
    value: Annotated[Amount, means("Its centrality.")]


Ranking = Annotated[
    list[CentralObjectJson],
    Meta(max_length=10),
    means("The most central objects, at most ten, the most central first; equal ones are sorted by name."),
]


class CentralityJson(JsonObject):
    """Centralities in the one-mode projection without directions, rounded to 6 digits
    (docs/levels.md).
    """

    edges: Annotated[Count, means("Edges of the graph.")]
    eigenvalue: Annotated[Amount, means("The largest eigenvalue of its adjacency matrix; 0 without edges.")]
    alpha: Annotated[Amount, means("The attenuation of Katz centrality, 0.9 / eigenvalue; 0 without edges.")]
    degree: Annotated[Ranking, means("By degree: neighbours, as a fraction of the other objects.")]
    katz: Annotated[Ranking, means("By Katz centrality.")]
    eigenvector: Annotated[Ranking, means("By eigenvector centrality.")]


class StatisticsJson(JsonObject):
    """What there is in a FOON. With --level everything but `units_read`, `findings` and the levels above
    describes the view on that level.
    """

    units_read: Annotated[Count, means("Functional units in the files, before duplicates were removed.")]
    units: Annotated[Count, means("Functional units of the FOON.")]
    duplicates: Annotated[
        Count,
        means(
            "Units that were left out because an equal one came before; on a lower level also those that "
            "look the same there."
        ),
    ]
    objects: Annotated[Count, means("Object nodes.")]
    labels: Annotated[Count, means("Labels of objects.")]
    motions: Annotated[Count, means("Motions: labels of motion nodes.")]
    findings: Annotated[
        dict[str, Place],
        Meta(extra_json_schema={"propertyNames": {"enum": [*ODDITIES]}}),
        means("How often each oddity was found in reading the files, by its code (docs/format.md)."),
    ]
    levels: Annotated[LevelsJson, means("Units and objects on each level of detail (docs/levels.md).")]
    degrees: Annotated[DegreesJson, means("How units and objects are linked, as annotated.")]
    most_used: Annotated[
        MostUsedJson, means("What is used most, at most ten each; equally many are sorted by name.")
    ]
    centrality: Annotated[CentralityJson | UnsetType, means("Only with --centrality.")] = UNSET


def statistics_json(counts: Statistics, central: Centralities | None = None) -> StatisticsJson:
    """Return what `stats --format json` writes."""
    levels = [LevelJson(units, objects) for _, (units, objects) in sorted(counts.levels.items())]
    return StatisticsJson(
        units_read=counts.units_read,
        units=counts.units,
        duplicates=counts.duplicates,
        objects=counts.objects,
        labels=counts.labels,
        motions=counts.motions,
        findings=dict(counts.findings),
        levels=LevelsJson(*levels),
        degrees=DegreesJson(
            **{name: SpreadJson(**spread) for name, spread in asdict(counts.degrees).items()}
        ),
        most_used=MostUsedJson(
            [UsedObjectJson(object_to_json(node), count) for node, count in counts.most_used_objects],
            [UsedMotionJson(motion, count) for motion, count in counts.most_used_motions],
        ),
        centrality=UNSET if central is None else _centrality(central),
    )


def _centrality(central: Centralities) -> CentralityJson:
    return CentralityJson(
        edges=central.edges,
        eigenvalue=central.eigenvalue,
        alpha=central.alpha,
        degree=_ranking(central.degree),
        katz=_ranking(central.katz),
        eigenvector=_ranking(central.eigenvector),
    )


def _ranking(measure: Centrality) -> list[CentralObjectJson]:
    return [CentralObjectJson(object_to_json(node), value) for node, value in measure.top]
