"""Write into pages what their commands print now: python tests/docs/rewrite.py [PAGE …]

Read the difference before you keep it: the page may be right, and the program wrong. What is shown with `…`
is replaced, too, where it does not fit any more.
"""

from __future__ import annotations

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from support import paths  # noqa: E402
from support.pages import PAGES, Page  # noqa: E402


def main(names: list[str]) -> None:
    for path in [Path(name).resolve() for name in names] or PAGES:
        for public in (None, paths.PUBLIC_DATA):
            page = Page(path)
            with TemporaryDirectory() as folder:
                failures = page.run(Path(folder), public=public)
            sys.stdout.write("".join(f"{failure}\n\n" for failure in failures))
            path.write_text(page.corrected(), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
