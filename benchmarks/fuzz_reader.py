"""Fuzz the readers of FOON files, guided by coverage, with atheris.

    pip install atheris
    python benchmarks/fuzz_reader.py CORPUS -max_total_time=600 -max_len=4096 -print_final_stats=1

CORPUS is a folder, filled with seeds if it is empty; the options are libFuzzer's. Any bytes must give a
FOON or a `FoonError`; a FOON must survive writing in every form and mending, with every unit accounted
for (tests/reading_checks.py). docs/fuzzing.md reports a run.
"""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent

_UNIT = "O\tonion\nS\twhole\nO\tknife\nM\tchop\nO\tonion\nS\tchopped\n//\n"
_SEEDS = (
    "//\n" + _UNIT,
    "# Source:\thttp://one\r\n//\r\nO1\tolive oil\t1\r\nS2\tin\t[bottle]\r\nO4\tbowl\t00\r\n"
    "M5\tpour*\t1:02\t0:01:10\trobot\t0.9\r\nO4\tbowl\t0\t8\r\nS6\tcontains\t{oil,a, b}\r\n//\r\n",
    "O\ta\t1\nS\tcontains\t[x]\nS\tin\t{y}\nM\tmix\t<1:05-1:10>\nO\tb\t0\t!\nS\twith [z] {a,,b}\n",
    "\ufeff# From:\tfile:12\n" + _UNIT + "//\n\n" + _UNIT.replace("chop\n", "chop\tAssumed\t3:0s7\n"),
    '[{"input_nodes": [{"label": "a", "states": ["hot", "in [cup]"], "ingredients": ["x"], '
    '"container": "pan"}], "motion_node": "stir*", "output_nodes": [{"label": "b"}]}]',
    '{"source": "v", "functional_units": [{"input_nodes": [{"object_id": 1, "object_label": "a", '
    '"object_states": [{"state_id": 1, "state_label": "in", "relative_object": "c"}, {"state_label": '
    '"contains"}], "ingredients": ["x"], "object_in_motion": 1}], "motion_node": {"motion_id": 1, '
    '"motion_label": "m", "start_time": "0:05", "end_time": 7.5, "robot_type": "r", '
    '"weight_success": 0.5}, "output_nodes": [{"object_label": "b", "object_states": []}]}]}',
)


def _fill(corpus: Path) -> None:
    """Write the seeds into an empty corpus."""
    corpus.mkdir(parents=True, exist_ok=True)
    if not any(corpus.iterdir()):
        for number, seed in enumerate(_SEEDS):
            (corpus / f"seed{number}").write_bytes(seed.encode())
            (corpus / f"seed{number}-utf16").write_bytes(seed.encode("utf-16"))


def main() -> int:
    try:
        atheris: Any = importlib.import_module("atheris")
    except ImportError:
        print("fuzz_reader: atheris is not installed; pip install atheris", file=sys.stderr)
        return 2
    for argument in sys.argv[1:2]:
        if not argument.startswith("-"):
            _fill(Path(argument))
    sys.path[:0] = [str(ROOT), str(ROOT / "tests")]
    with atheris.instrument_imports(include=["foon_asp"]):
        check = importlib.import_module("reading_checks").check
    atheris.Setup(sys.argv, check)
    atheris.Fuzz()
    return 0


if __name__ == "__main__":
    sys.exit(main())
