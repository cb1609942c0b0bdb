"""Characters that a picture cannot hold: XML has none of them, and Graphviz reads labels as XML, too."""

from __future__ import annotations

import re

_ILLEGAL = re.compile("[^\\t\\n\\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def legal(text: str) -> str:
    """Return a text with `\ufffd` for each character that XML cannot hold."""
    return _ILLEGAL.sub("\ufffd", text)
