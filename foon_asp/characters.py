"""Characters that no label may hold: what ends a line or a string, or makes a terminal show something else.

These are control characters, line ends, marks of writing direction, which turn the text behind them around,
and halves of surrogate pairs, which no file can hold. All else may stand in a label.
"""

from __future__ import annotations

import re

_DIRECTION = (0x061C, 0x200E, 0x200F, *range(0x2028, 0x202F), *range(0x2066, 0x2070))
_LEFT_OUT = dict.fromkeys([*range(9), *range(11, 32), *range(127, 160), *_DIRECTION])
_ODD = re.compile("[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u206f\ud800-\udfff]")
_UNSEEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u206f\ud800-\udfff]")
_SPACES = re.compile(r"[\t\r\n]+")
_SURROGATE = re.compile(r"[\ud800-\udfff]")


def without_control_characters(text: str) -> str:
    """Remove what no label may hold but tab, newline and surrogates."""
    return text if text.isprintable() or not _UNSEEN.search(text) else text.translate(_LEFT_OUT)


def one_line(text: str) -> str:
    """Return a text that may hold anything as it can stand in one field of a line."""
    if text.isprintable():
        return text.strip()
    return _SURROGATE.sub("\ufffd", without_control_characters(_SPACES.sub(" ", text))).strip()


def is_label(text: object) -> bool:
    """Tell whether a value can be a label, a motion or a word of a state: a text that one line can show."""
    return isinstance(text, str) and bool(text.strip()) and (text.isprintable() or not _ODD.search(text))


def visible(text: str) -> str:
    r"""Return a text as a terminal may show it, tabs and lines kept: what it would act on becomes `\x1b`."""
    return text if text.isprintable() else _UNSEEN.sub(_escaped, text)


def _escaped(match: re.Match[str]) -> str:
    return match[0].encode("unicode_escape").decode("ascii")
