"""Print the shape of the public FOON beside that of generated ones of the same size, and how slices grow.

    python benchmarks/shape.py [--seeds N] [--families NAME …]

Growth is measured on unions of random stretches of 33 units. Their kitchen is that of the whole FOON,
and what no unit of theirs makes: else most units of a small part could not be executed. Figures of the
generated FOONs are means over seeds. It takes a minute or two.
"""

from __future__ import annotations

import argparse
import random
import statistics
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Sequence
from pathlib import Path

import networkx as nx
from generate import CUISINE
from machine import DATA

from foon_asp.io.folder import load, read_foon
from foon_asp.io.text import write_text
from foon_asp.model.foon import Foon
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import ObjectId, UnitId
from foon_asp.model.reachability import backward
from foon_asp.model.world import World

STRETCH = 33
PARTS = (8, 18, 36, 54)
"""How many stretches a part of the FOON has; all of the public one are 72."""

Figures = dict[str, float]


def shape(world: World) -> Figures:
    """Measure a FOON seen from a kitchen."""
    foon, reading, closure, stock = world.foon, world.units, world.closure, world.stock
    every_unit = foon.units.ids
    makers = _makers(world)
    makes = [sum(thing not in stock for thing in reading.makes[unit]) for unit in every_unit]
    needs = [sum(thing not in stock for thing in reading.needs[unit]) for unit in closure.executable]
    used = Counter(thing for unit in every_unit for thing in reading.needs[unit])
    slices = _slices(world, makers)
    circles = _circles(world, makers)
    inputs = [len(unit.inputs) for unit in foon.units]
    outputs = [len(unit.outputs) for unit in foon.units]
    states = Counter(min(4, len(node.states)) for node in foon.objects)
    contents = Counter(min(2, len(node.contents)) for node in foon.objects)
    return {
        "object nodes": len(foon.objects),
        "labels": len(foon.labels),
        "kitchen": len(stock),
        "motions": len(foon.motions),
        **{f"units with {size} inputs": inputs.count(size) for size in (1, 2, 3, 4)},
        "units with 5 to 12 inputs": sum(size > 4 for size in inputs),
        **{f"units with {size} outputs": outputs.count(size) for size in (1, 2, 3)},
        "units with 4 to 6 outputs": sum(size > 3 for size in outputs),
        **{f"objects with {size} states": states[size] for size in range(4)},
        "objects with 4 states or more": states[4],
        "objects that contain one thing": contents[1],
        "objects that contain several": contents[2],
        "objects made": len(makers),
        "made by several units": sum(len(found) > 1 for found in makers.values()),
        "most producers": max(map(len, makers.values())),
        "made and never used": sum(not used[thing] for thing in makers),
        "most uses of something made": max(used[thing] for thing in makers),
        "most uses of a kitchen object": max(used[thing] for thing in stock),
        "made objects a unit needs": statistics.mean(needs),
        "objects a unit makes": statistics.mean(makes),
        "implied views": sum(inputs) - sum(len(reading.needs[unit]) for unit in every_unit),
        "units that can be executed": len(closure.executable),
        "rounds": max(closure.available.values()),
        "units in circles": sum(circles),
        "largest circle": max(circles, default=0),
        "slice, mean": statistics.mean(slices),
        **{f"slice, {share}%": slices[len(slices) * share // 100] for share in (10, 25, 50, 75, 90, 99)},
        "slice, largest": slices[-1],
    }


def _makers(world: World) -> dict[ObjectId, list[UnitId]]:
    """Return the units that make each object that the kitchen does not have."""
    found: dict[ObjectId, list[UnitId]] = {}
    for unit in world.foon.units.ids:
        for thing in world.units.makes[unit]:
            if thing not in world.stock:
                found.setdefault(thing, []).append(unit)
    return found


def _slices(world: World, makers: Collection[ObjectId]) -> list[int]:
    """Return, sorted, the sizes of the backward slices of all objects that can be made."""
    goals = (thing for thing in makers if thing in world.closure.available)
    executable = world.closure.executable
    return sorted(len(backward(world.units, [goal], world.stock, executable)) for goal in goals)


def _circles(world: World, makers: dict[ObjectId, list[UnitId]]) -> list[int]:
    """Return the sizes of the circles among units that can be executed, each of two units or more."""
    graph = nx.DiGraph()
    for unit in world.closure.executable:
        for need in world.units.needs[unit]:
            before = (maker for maker in makers.get(need, ()) if maker in world.closure.executable)
            graph.add_edges_from((maker, unit) for maker in before)
    return [len(part) for part in nx.strongly_connected_components(graph) if len(part) > 1]


def growth(world: World, folder: Path) -> Iterator[tuple[int, list[int]]]:
    """Yield, for growing parts of a FOON, how many units they have and their slices, sorted."""
    units = world.foon.units
    stretches = [range(start, min(start + STRETCH, len(units))) for start in range(0, len(units), STRETCH)]
    for count in PARTS:
        chosen = random.Random(1).sample(stretches, count)
        path = folder / "part.txt"
        part = write_text(world.foon, (units[UnitId(unit)] for stretch in chosen for unit in stretch))
        path.write_text(part, encoding="utf-8")
        found = _complete(read_foon([path]).foon, world.kitchen)
        yield len(found.foon.units), _slices(found, _makers(found))


def _complete(foon: Foon, kitchen: Kitchen) -> World:
    """Return a part of a FOON as a domain whose kitchen has what no unit of it makes, too."""
    reading = World.of(foon, kitchen).units
    made = {thing for makes in reading.makes for thing in makes}
    needed = {thing for needs in reading.needs for thing in needs}
    more = tuple(foon.objects[thing] for thing in sorted(needed - made))
    return World.of(foon, Kitchen((*kitchen.objects, *more), kitchen.utensils))


def _figures(folder: Path) -> Figures:
    """Return all figures of a data folder, those of its parts among them."""
    world = load(folder).world()
    figures = shape(world)
    with tempfile.TemporaryDirectory() as temporary:
        for count, (units, slices) in zip(PARTS, growth(world, Path(temporary)), strict=True):
            name = f"{count} stretches"
            figures |= {f"{name}: units": units, f"{name}: slice, mean": statistics.mean(slices)}
            figures |= {f"{name}: slice, 50%": slices[len(slices) // 2]}
            figures |= {f"{name}: slice, 90%": slices[len(slices) * 9 // 10]}
    return figures


def _generated(family: str, seeds: Iterable[int]) -> Figures:
    """Return the means over seeds."""
    found: list[Figures] = []
    generator = Path(__file__).with_name("generate.py")
    for seed in seeds:
        with tempfile.TemporaryDirectory() as folder:
            options = ["--units", str(CUISINE), "--family", family, "--seed", str(seed)]
            subprocess.run([sys.executable, str(generator), *options, folder], check=True)
            found.append(_figures(Path(folder)))
    return {name: statistics.mean(figures[name] for figures in found) for name in found[0]}


def table(columns: dict[str, Figures]) -> Iterator[str]:
    """Yield the figures side by side."""
    yield "| | " + " | ".join(columns) + " |"
    yield "|---|" + "---:|" * len(columns)
    for name in next(iter(columns.values())):
        cells = (f"{figures[name]:,.4g}" for figures in columns.values())
        yield f"| {name} | " + " | ".join(cells) + " |"


def main(arguments: Sequence[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description="Compare generated FOONs with the public one.")
    parser.add_argument("--seeds", type=int, default=5, metavar="N")
    parser.add_argument("--families", nargs="+", choices=("random", "dense"), default=["random", "dense"])
    options = parser.parse_args(arguments)
    if not (DATA / "FOON.txt").exists():
        raise SystemExit(f"no FOON.txt in {DATA}; set FOON_PUBLIC_DATA")
    columns = {"public": _figures(DATA)}
    for family in options.families:
        columns[family] = _generated(family, range(1, options.seeds + 1))
    for line in table(columns):
        print(line)


if __name__ == "__main__":
    main()
