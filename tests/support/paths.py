"""Where things lie."""

from __future__ import annotations

import os
from pathlib import Path

ROOT = Path(__file__).parent.parent.parent
SCHEMAS = ROOT / "docs" / "schema"
BUILT_IN = ROOT / "data" / "FOON.txt"
PUBLIC_DATA = Path(os.environ.get("FOON_PUBLIC_DATA", ROOT.parent / "shared" / "foon"))
