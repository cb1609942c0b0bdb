"""The examples of docs/pddl.md stand so in an export."""

from __future__ import annotations

import re

import pytest

from foon_asp.planning.pddl.plan_lines import DIALECTS
from foon_asp.planning.pddl.plansys2 import for_plansys2
from foon_asp.planning.pddl.styles import STYLES
from foon_asp.planning.pddl.write import domain_text, problem_text
from support import small_foons
from support.paths import ROOT
from support.pddl_exports import counted, exported

# The translator of Fast Downward leaves its files open; the others warn of what is theirs alone.
pytestmark = pytest.mark.filterwarnings("ignore:unclosed file:ResourceWarning")


# Text


def test_the_examples_of_the_documentation() -> None:
    """Every block of PDDL in docs/pddl.md and docs/robots.md stands so in an export of a small FOON."""
    where = small_foons.world(
        ["onion[whole] + (knife) -chop-> onion[chopped]"], "onion[whole] + (knife)", utensils=["knife"]
    )
    where = counted(where, onion=1)
    texts = []
    for style in STYLES:
        for durative in (False, True):
            for level in (None, "units", "units+tools"):
                written = exported(
                    where, [small_foons.node("onion[chopped]")], "consume", level, style, durative
                )
                texts.append(domain_text(written) + problem_text(written))
                if style == "lifted" and level is None:
                    texts.append(domain_text(for_plansys2(written)))
    pages = "".join((ROOT / "docs" / name).read_text(encoding="utf-8") for name in ("pddl.md", "robots.md"))
    blocks = re.findall(r"```pddl\n(.*?)```", pages, re.DOTALL)
    assert len(blocks) >= 4
    for block in blocks:
        assert any(block in text for text in texts), block


def test_every_dialect_of_plans_is_documented() -> None:
    text = (ROOT / "docs" / "pddl.md").read_text(encoding="utf-8")
    for name, line in DIALECTS.items():
        assert f"| {name} | `{line.strip()}` |" in text
