"""FOON files in every form, and an example of each finding."""

from __future__ import annotations

A = (
    "# Source:\tv\r\n//\r\nO7\toil\t1\r\nS2\tin\t[cup]\r\nO4\tbowl\t0\r\nS1\tempty\r\n"
    "M5\tpour\t0:02\t0:10\r\nO4\tbowl\t0\t!\r\nS6\tcontains\t{oil}\r\n//\r\n"
)
DIALECTS = {
    "A": A,
    "B": "//\nO\toil\nS\tin\t[cup]\nO\tbowl\nS\tempty\nM\tpour\nO\tbowl\nS\tcontains\t{oil}\n//\n",
    "C": "//\nO1\toil\nS1\tin\t[cup]\nO1\tbowl\nS1\tempty\nM1\tpour\nO1\tbowl\nS1\tcontains\t{oil}\n//\n",
    "D": "O\toil\t1\nS\tin\t[cup]\nO\tbowl\t0\nS\tempty\nM\tpour\t0:02\t0:10\n"
    "O\tbowl\t0\nS\tcontains\t{oil}\n//\n",
    "E": "O0\toil\t1\nS0\tin\t[cup]\nO0\tbowl\t0\nS0\tempty\nM0\tpour\t<0:02-0:10>\nO0\tbowl\t0\n"
    "S0\tcontains\t{oil}\n//\n",
    "F": "# A tree\n//\nO\toil\nS\tin\t[cup]\nO\tbowl\nS\tempty\nM\tpour\nO\tbowl\nS\tcontains\t{oil}\n//\n",
    "J1": '[{"input_nodes": [{"label": "Oil", "states": [], "ingredients": [], "container": "cup"},'
    '{"label": "bowl", "states": ["empty"]}], "motion_node": "pour",'
    '"output_nodes": [{"label": "bowl", "states": [], "ingredients": ["oil"], "container": null}]}]',
    "J1 with a motion object": '[{"input_nodes": [{"label": "oil", "states": ["in [cup]"]},'
    '{"label": "bowl", "states": ["empty"]}], "motion_node": {"motion_label": "pour"},'
    '"output_nodes": [{"label": "bowl", "states": ["contains {oil}"]}]}]',
    "J2": '{"functional_units": [{"input_nodes": ['
    '{"object_id": 7, "object_label": "oil", "object_states": [{"state_id": 2, "state_label": "in",'
    '"relative_object": "cup"}], "ingredients": [], "object_in_motion": 1},'
    '{"object_id": 4, "object_label": "bowl", "object_states": [{"state_id": 1, "state_label": "empty"}],'
    '"ingredients": [], "object_in_motion": 0}],'
    '"motion_node": {"motion_id": 5, "motion_label": "pour", "start_time": "0:02", "end_time": "0:10"},'
    '"output_nodes": [{"object_id": 4, "object_label": "bowl", "object_states": [{"state_id": 6,'
    '"state_label": "contains"}], "ingredients": ["oil"], "object_in_motion": 0}]}], "source": "v"}',
}
UNIT = "O\ta\nM\tx\nO\tb\n//\n"
UNIT_JSON = '{"input_nodes": [{"label": "a"}], "motion_node": "x", "output_nodes": [{"label": "b"}]}'


def state_file(row: str) -> str:
    return f"O\ta\n{row}\nM\tx\nO\tb\n//\n"


EXAMPLES: dict[str, str | bytes] = {
    "unreadable-line": "O\ta\nhello\nM\tx\nO\tb\n//\n",
    "unreadable-unit": f"[{UNIT_JSON}, 7]",
    "object-without-label": "O7\nM\tx\nO\tb\n//\n" + UNIT,
    "motion-without-label": "O\ta\nM7\nO\tb\n//\n" + UNIT,
    "unit-without-motion": "O\tc\n//\n" + UNIT,
    "two-motions": "O\ta\nM\tx\nO\tb\nM\ty\nO\tc\n//\n" + UNIT,
    "broken-json": f"[{UNIT_JSON}, {UNIT_JSON[:40]}",
    "text-around-json": f"Here is the tree:\n```json\n[{UNIT_JSON}]\n```\n",
    "no-units": "[]",
    "word-for-none": '[{"input_nodes": [{"label": "a", "container": "None"}], "motion_node": "m"}]',
    "unit-without-inputs": "M\tx\nO\tb\n//\n" + UNIT,
    "unit-without-outputs": "O\ta\nM\tx\n//\n",
    "state-of-motion": "O\ta\nM\tx\nS\thot\nO\tb\n//\n",
    "state-without-name": state_file("S\t[cup]"),
    "contains-without-braces": state_file("S\tcontains"),
    "empty-brackets": state_file("S\ton\t[]"),
    "empty-braces": state_file("S\tcontains\t{}"),
    "comma-in-brackets": state_file("S\tin\t[a,b]"),
    "unbalanced-brackets": state_file("S\tin\t[cup"),
    "stray-text": state_file("S\tin\t[cup] there"),
    "stray-field": "O\ta\t1\t!\tmore\nM\tx\nO\tb\n//\n",
    "tab-in-label": "O\tolive\toil\t1\nM\tx\nO\tb\n//\n",
    "broken-time": "O\ta\nM\tx\t3:0s7\t4:00\nO\tb\n//\n",
    "broken-rate": "O\ta\nM\tx\t3:07\t4:00\trobot\tgood\nO\tb\n//\n",
    "not-utf8": b"O\tcr\xe8me\nM\tx\nO\tb\n//\n",
    "control-character": "O\ta\x00b\nM\tx\nO\tb\n//\n",
    "duplicate-key": f'[{UNIT_JSON[:-1]}, "motion_node": "y"}}]',
    "unknown-key": '[{"input_nodes": [{"label": "a", "stats": ["raw"]}], "motion_node": "m"}]',
    "odd-content": '[{"input_nodes": [{"label": "a", "ingredients": ["x,y"]}], "motion_node": "m"}]',
    "other-rate": "O\ta\nM\tx\t\t\t\t0.5\nO\tb\n//\n" + "O\ta\nM\tx\t\t\t\t0.9\nO\tb\n//\n",
    "other-encoding": UNIT.encode("utf-16"),
    "byte-order-mark": "\ufeff" + UNIT,
    "unit-not-closed": UNIT.removesuffix("//\n"),
    "empty-unit": "//\n" + UNIT,
    "blank-line": "O\ta\n\nM\tx\nO\tb\n//\n",
    "missing-tab": state_file("S\tunder [pan]"),
    "lower-case": "o\ta\nM\tx\nO\tb\n//\n",
    "other-end": "O\ta\nM\tx\nO\tb\n\\\\\n",
    "older-word": state_file("S\tingredients inside\t{x}"),
    "odd-flag": "O\ta\t00\nM\tx\nO\tb\n//\n",
    "contains-in-brackets": state_file("S\tcontains\t[x]"),
    "place-in-braces": state_file("S\tin\t{x}"),
    "state-without-brackets": state_file("S\tin\tcup"),
    "stray-comma": state_file("S\tcontains\t{x,,y}"),
    "space-in-braces": state_file("S\tcontains\t{x, y}"),
    "duplicate-content": state_file("S\tcontains\t{x,x}"),
    "duplicate-state": state_file("S\thot\nS\thot"),
    "duplicate-input": "O\ta\nO\ta\nM\tx\nO\tb\n//\n",
    "duplicate-output": "O\ta\nM\tx\nO\tb\nO\tb\n//\n",
    "duplicate-unit": UNIT + UNIT,
    "times-backwards": "O\ta\nM\tx\t1:16\t1:05\nO\tb\n//\n",
}
