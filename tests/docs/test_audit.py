"""The page docs/audit.md lists every finding."""

from __future__ import annotations

import re

from support.paths import ROOT


def test_docs_list_every_code_of_the_audit() -> None:
    text = (ROOT / "docs" / "audit.md").read_text()
    documented = set(re.findall(r"^\| `([a-z-]+)` \|", text, re.MULTILINE))
    modules = ("audit/audit.py", "io/unknown_words.py", "io/kitchen.py")
    sources = [ROOT / "foon_asp" / name for name in modules]
    sources.append(ROOT / "encodings" / "audit" / "audit.lp")
    used = set()
    for path in sources:
        used |= set(
            re.findall(
                r'(?:warning\(|_finding\(\s*|Finding\(|yield _finding\(\s*)"([a-z-]+)"', path.read_text()
            )
        )
    assert documented == used
