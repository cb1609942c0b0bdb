"""A schedule as a Gantt chart: a row for each hand and station, time from left to right."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from html import escape

from foon_asp.draw.legal import legal
from foon_asp.planning.schedule import Schedule, ScheduledStep
from foon_asp.planning.schedule_answer import ScheduleAnswer
from foon_asp.words import cut

_LEFT = 150
_WIDTH = 900
_ROW = 28
_HEAD = 34
_TICKS = (1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600)
_COLOURS = ("#4e79a7", "#f28e2b", "#59a14f", "#b07aa1", "#76b7b2", "#edc948", "#e15759", "#9c755f")
"""Of motions, in the order in which they come; the same again where there are more."""


def gantt_svg(answer: ScheduleAnswer) -> str:
    """Return the schedule of an answer as an SVG picture, or one that says that there is none."""
    if answer.schedule is None:
        return "".join(_document(_LEFT + _WIDTH, 60, [_text(12, 34, f"no schedule: {answer.reason}")]))
    return _chart(answer.schedule, answer.durations.unit, answer.durations.guessed)


def _chart(schedule: Schedule, unit: str, guessed: Iterable[int]) -> str:
    rows = _rows(schedule)
    scale = _WIDTH / max(1, schedule.makespan)
    height = _HEAD + _ROW * len(rows) + 12
    unsure = set(guessed)
    motions = list(dict.fromkeys(schedule.world.foon.units[step.unit].motion for step in schedule.steps))
    parts: list[str] = []
    for tick in _ticks(schedule.makespan):
        x = _LEFT + tick * scale
        parts.append(f'<path d="M{x:.1f} {_HEAD - 6}V{height - 8}" stroke="#ddd"/>')
        parts.append(_text(x, _HEAD - 12, f"{tick} {unit}" if tick == 0 else str(tick), "middle"))
    for number, (name, steps) in enumerate(rows):
        y = _HEAD + number * _ROW
        parts.append(_text(_LEFT - 8, y + 18, cut(name, 22), "end"))
        for place, step in steps:
            motion = schedule.world.foon.units[step.unit].motion
            colour = _COLOURS[motions.index(motion) % len(_COLOURS)]
            parts += _bar(_LEFT + step.start * scale, y, (step.end - step.start) * scale, colour)
            goal = "; ".join(str(schedule.world.node(each)) for each in schedule.world.units.makes[step.unit])
            note = f"{place}. {motion} ({step.start} to {step.end} {unit}) get {goal}"
            if step.unit in unsure:
                note += "; how long it takes is guessed"
            room = int((step.end - step.start) * scale / 7)
            label = f"{place} {motion}" if len(f"{place} {motion}") <= room else str(place)
            if len(label) <= room:
                parts.append(_text(_LEFT + step.start * scale + 4, y + 18, label, colour="#fff"))
            parts.append(f"<title>{escape(legal(note))}</title></g>")
    return "".join(_document(_LEFT + _WIDTH + 20, height, parts))


def _rows(schedule: Schedule) -> list[tuple[str, list[tuple[int, ScheduledStep]]]]:
    """Return the rows by name: hands, what goes by itself, then stations and utensils."""
    rows: dict[tuple[int, str, int], list[tuple[int, ScheduledStep]]] = {}
    for place, step in enumerate(schedule.steps, 1):
        keys = [(0, step.worker, hand) for hand in step.hands] or [(1, "by itself", 0)]
        keys += [(2, name, number) for name, number in (*step.stations, *step.vessels)]
        for key in keys:
            rows.setdefault(key, []).append((place, step))
    names = {key: f"{key[1]} {key[2]}" if key[2] else key[1] for key in rows}
    return [(names[key], rows[key]) for key in sorted(rows)]


def _ticks(makespan: int) -> range:
    step = next((each for each in _TICKS if makespan / each <= 15), max(1, makespan // 10))
    return range(0, makespan + 1, step)


def _bar(x: float, y: float, width: float, colour: str) -> Iterator[str]:
    yield f'<g><rect x="{x:.1f}" y="{y + 3}" width="{max(1.0, width - 1):.1f}" height="{_ROW - 6}" rx="3" '
    yield f'fill="{colour}"/>'


def _text(x: float, y: float, text: str, anchor: str = "start", colour: str = "#222") -> str:
    words = escape(legal(text))
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}">{words}</text>'


def _document(width: int, height: int, parts: Iterable[str]) -> Iterator[str]:
    yield f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
    yield f'viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">\n'
    yield f'<rect width="{width}" height="{height}" fill="#fff"/>\n'
    yield "".join(f"{part}\n" if part.endswith(("/>", "</text>", "</g>")) else part for part in parts)
    yield "</svg>\n"
