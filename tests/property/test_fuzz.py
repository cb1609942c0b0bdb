"""Whatever the bytes are: a FOON that survives writing and mending, or a `FoonError`. Never a traceback."""

from __future__ import annotations

import json

from hypothesis import given
from hypothesis import strategies as st

from foon_asp.io.json import write_api, write_units
from foon_asp.io.text import write_text
from support.examples import many
from support.foon_texts import DIALECTS
from support.paths import ROOT
from support.reading_checks import check, read

_BUILT_IN = (ROOT / "data" / "FOON.txt").read_bytes()
_FOON = read(_BUILT_IN[:3000].rpartition(b"//")[0]).foon
_FILES = [
    _BUILT_IN[:2500],
    write_text(_FOON, _FOON.units[:8], dialect="A", provenance=True).encode(),
    write_units(_FOON, _FOON.units[:3]).encode(),
    write_api(_FOON, _FOON.units[:3]).encode(),
    *(text.encode() for text in DIALECTS.values()),
]
_PIECES = [
    *(
        b"\t",
        b"\n",
        b"\r\n",
        b"//\n",
        b"O\t",
        b"S\tin\t[",
        b"S contains {a, b}",
        b"M\tx*\t1:00-0:59",
        b"\x00",
    ),
    *(
        b"{",
        b"}",
        b"[",
        b"]",
        b",",
        b'"',
        b"\\",
        b"\xff",
        "\ufeff".encode(),
        b"00",
        b"# From:\tf:1\n",
        b": 1e999",
    ),
]
moderate = many(300)


@moderate
@given(
    st.binary(max_size=300) | st.text(max_size=200).map(lambda text: text.encode("utf-16", "surrogatepass"))
)
def test_any_bytes(data: bytes) -> None:
    check(data)


@moderate
@given(st.lists(st.sampled_from([*_PIECES, b"O\ta\n", b"M\tx\n", b"S\thot\n", b"a", b" "]), max_size=30))
def test_any_lines(pieces: list[bytes]) -> None:
    check(b"".join(pieces))


@st.composite
def mutated_files(draw: st.DrawFn) -> bytes:
    data = draw(st.sampled_from(_FILES))
    for _ in range(draw(st.integers(1, 5))):
        place = draw(st.integers(0, len(data)))
        cut = draw(st.integers(0, 3) | st.integers(0, 200))
        piece = draw(st.sampled_from(_PIECES) | st.binary(max_size=3))
        data = data[:place] + piece + data[place + cut :]
    return data


@moderate
@given(mutated_files())
def test_mutated_files(data: bytes) -> None:
    check(data)


_KEYS = st.sampled_from(
    [
        "functional_units",
        "source",
        "input_nodes",
        "output_nodes",
        "motion_node",
        "motion_label",
        "start_time",
        "end_time",
        "robot_type",
        "weight_success",
        "label",
        "states",
        "ingredients",
        "container",
        "object_label",
        "object_states",
        "object_in_motion",
        "state_label",
        "relative_object",
    ]
)
_LEAVES = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.floats()
    | st.text(max_size=5)
    | st.sampled_from(["a", "contains", "in [b]", "c {d, e}", "0:05", "Assumed", "*", "[", "\x00", "\ud800"])
)
_VALUES = st.recursive(
    _LEAVES,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(_KEYS, inner, max_size=4),
    max_leaves=20,
)
_OBJECTS = st.fixed_dictionaries(
    {"label": _LEAVES},
    optional={
        "states": st.lists(_LEAVES, max_size=3) | _VALUES,
        "ingredients": _VALUES,
        "container": _VALUES,
    },
)
_UNITS = st.fixed_dictionaries(
    {"motion_node": _LEAVES | st.dictionaries(_KEYS, _LEAVES, max_size=5)},
    optional={
        "input_nodes": st.lists(_OBJECTS, max_size=3),
        "output_nodes": st.lists(_OBJECTS, max_size=3) | _VALUES,
    },
)


@moderate
@given(
    _VALUES | st.lists(_UNITS, max_size=3) | st.builds(lambda u: {"functional_units": u}, st.lists(_UNITS))
)
def test_any_json(value: object) -> None:
    check(json.dumps(value).encode())
