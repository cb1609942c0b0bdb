"""Changes of a file that its reader does not expect, drawn at random."""

from __future__ import annotations

import json
from random import Random
from typing import Any

_TEXTS = (
    *("\t", "\n", "\r", "\r\n", "//\n", "O\t", "O1\ta\t1\n", "S\tin\t[", "S contains {a, b}"),
    *("\0", "{", "}", "[", "]", ",", '"', "\\", "\ufeff", "00", "# From:\tf:1\n", ": 1e999", "\u00a0"),
    *("\x1b[31m", "\u202e", "\u2028", "\u0130", "é", "NaN", "Infinity", "-1", "0", "1e-400", "9" * 400),
    *("2147483648", "-2147483648", "9223372036854775808", "true", "null", "\\u0000", "\\ud800", "[["),
    *('"label": ', '"states": []', "(", ")", ";", "0.5: ", ":-", ":~", "@f()", "#show ", "%*", "{}"),
    *("..", "#const ", "not ", "X", "_", "&a{", "*", "!", "<0:02-0:10>", "Assumed", "in [b]", " [] "),
    *("M\tx*\t1:00-0:59", "#script (lua)", " {} ", "\ud800"),
)
_PIECES = (
    *(text.encode("utf-8", "surrogatepass") for text in _TEXTS),
    *(b"\xff", b"\xc0\x80", b"\xfe\xff", b"\x80\x04K\x01."),
)

_VALUES: tuple[Any, ...] = (
    *(
        None,
        True,
        False,
        0,
        -1,
        7,
        2**31,
        -(2**63) - 1,
        10**400,
        0.5,
        1e308,
        float("nan"),
        float("inf"),
        "",
        " ",
    ),
    *(
        "a",
        "onion",
        "\0",
        "\ud800",
        "a\tb",
        "a\n//",
        "[",
        "in [b]",
        "contains {a,b}",
        "9" * 300,
        "b*",
        "Infinity",
    ),
    *([], [[]], {}, [None], {"a": 1}, ["a", "a"], {"label": "a"}, [[["x"]]], {"states": {"a": []}}),
)

_LONG = 20_000
"""How many bytes a piece that is repeated may come to."""


def mutated(data: bytes, others: tuple[bytes, ...], random: Random) -> bytes:
    """Return a file with one to four changes; `others` are files of the kind, to take pieces of."""
    if data[:1] in (b"{", b"[") and random.random() < 0.5:
        data = _other_json(data, random)
        if random.random() < 0.7:
            return data
    for _ in range(random.choice((1, 1, 2, 3, 4))):
        data = random.choice(_CHANGES)(data, others, random)
    if random.random() < 0.01:
        return data.decode("utf-8", "replace").encode(
            random.choice(("utf-16", "utf-16-be", "latin-1")), "replace"
        )
    return data


def _flip(data: bytes, _: tuple[bytes, ...], random: Random) -> bytes:
    if not data:
        return data
    place = random.randrange(len(data))
    return data[:place] + bytes([data[place] ^ (1 << random.randrange(8))]) + data[place + 1 :]


def _put(data: bytes, _: tuple[bytes, ...], random: Random) -> bytes:
    place = random.randint(0, len(data))
    cut = random.choice((0, 0, 1, 3, random.randint(0, 50)))
    return data[:place] + random.choice(_PIECES) + data[place + cut :]


def _remove(data: bytes, _: tuple[bytes, ...], random: Random) -> bytes:
    place = random.randint(0, len(data))
    return data[:place] + data[place + random.choice((1, 1, 2, 5, 100)) :]


def _cut(data: bytes, _: tuple[bytes, ...], random: Random) -> bytes:
    return data[: random.randint(0, len(data))]


def _double(data: bytes, _: tuple[bytes, ...], random: Random) -> bytes:
    """Put a stretch once more, somewhere."""
    start, place = random.randint(0, len(data)), random.randint(0, len(data))
    return data[:place] + data[start : start + random.randint(1, 80)] + data[place:]


def _splice(data: bytes, others: tuple[bytes, ...], random: Random) -> bytes:
    other = random.choice(others)
    return data[: random.randint(0, len(data))] + other[random.randint(0, len(other)) :]


def _lines(data: bytes, _: tuple[bytes, ...], random: Random) -> bytes:
    """Exchange two lines, double one, or drop one."""
    lines = data.splitlines(keepends=True)
    if len(lines) < 2:
        return data
    one, two = random.randrange(len(lines)), random.randrange(len(lines))
    way = random.randrange(3)
    if way == 0:
        lines[one], lines[two] = lines[two], lines[one]
    elif way == 1:
        lines.insert(two, lines[one])
    else:
        del lines[one]
    return b"".join(lines)


def _repeat(data: bytes, _: tuple[bytes, ...], random: Random) -> bytes:
    """Repeat a piece of the file or of the list, rarely so often that more than linear time would be seen."""
    place = random.randint(0, len(data))
    piece = random.choice((random.choice(_PIECES), data[place : place + random.randint(1, 6)])) or b" "
    most = _LONG if random.random() < 0.02 else 100
    return data[:place] + piece * random.randint(2, max(2, most // len(piece))) + data[place:]


_CHANGES = (_flip, _put, _put, _put, _remove, _remove, _cut, _double, _splice, _lines, _repeat)


def _other_json(data: bytes, random: Random) -> bytes:
    """Put, remove or exchange a value somewhere in a JSON file; what is no JSON is as it was."""
    lines = data.split(b"\n") if b"\n{" in data else [data]
    place = random.randrange(len(lines))
    try:
        value = json.loads(lines[place])
    except ValueError:
        return data
    lines[place] = json.dumps(_changed(value, random)).encode()
    return b"\n".join(lines)


def _changed(value: Any, random: Random) -> Any:
    """Return a value with a change at a random depth."""
    if isinstance(value, dict) and value and random.random() < 0.85:
        key = random.choice(list(value))
        way = random.random()
        if way < 0.6:
            return {**value, key: _changed(value[key], random)}
        if way < 0.75:
            return {name: each for name, each in value.items() if name != key}
        return {
            (key + "s" if random.random() < 0.5 else random.choice(list(value))): random.choice(_VALUES),
            **value,
        }
    if isinstance(value, list) and value and random.random() < 0.85:
        place = random.randrange(len(value))
        new = [_changed(value[place], random)] * random.choice((1, 1, 1, 0, 2))
        return [*value[:place], *new, *value[place + 1 :]]
    return random.choice(_VALUES)
