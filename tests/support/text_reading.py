"""FOON text, and what its units say."""

from __future__ import annotations

from typing import Any

from foon_asp.io.findings import Finding
from foon_asp.io.text import TextReader
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.node import ObjectNode
from support.plain_reader import PlainReader


def read(text: str) -> tuple[Foon, list[Finding]]:
    builder = FoonBuilder()
    reader = TextReader(builder)
    reader.read(text, "x.txt")
    return builder.build(), reader.findings


def meaning(foon: Foon) -> list[tuple[list[ObjectNode], str, list[ObjectNode]]]:
    return [
        (
            [foon.objects[number] for number in unit.inputs],
            unit.motion,
            [foon.objects[number] for number in unit.outputs],
        )
        for unit in foon.units
    ]


def outcome(reader: type[TextReader | PlainReader], texts: list[str]) -> Any:
    """Return all that can be seen of what was read, and of its order."""
    builder = FoonBuilder()
    chosen = reader(builder)
    for number, each in enumerate(texts):
        chosen.read(each, f"{number}.txt")
    foon = builder.build()
    notes, kinds = foon.units.notes, foon.objects.kinds
    words = foon.labels, set(foon.units.motions), set(notes.agents), set(notes.files), set(notes.videos)
    counts = foon.duplicates, builder.read, chosen.reported_units
    return list(foon.objects), list(foon.units), set(kinds), words, counts, chosen.findings
