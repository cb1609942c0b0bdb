"""Write into pages what their commands print now, and what they draw: python tests/docs/rewrite.py [PAGE …]

Read the difference before you keep it: the page may be right, and the program wrong. What is shown with `…`
is replaced, too, where it does not fit any more.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "tests"))

from support import paths  # noqa: E402
from support.notebooks import executed, written  # noqa: E402
from support.pages import PAGES, Page  # noqa: E402
from support.pictures import shown  # noqa: E402

TUTORIAL = ROOT / "docs" / "tutorial.ipynb"


def main(names: list[str]) -> None:
    for path in [Path(name).resolve() for name in names] or [*PAGES, TUTORIAL]:
        if path == TUTORIAL:
            with TemporaryDirectory() as folder:
                path.write_text(written(executed(path, Path(folder))), encoding="utf-8")
            continue
        for public in (None, paths.PUBLIC_DATA):
            page = Page(path)
            with TemporaryDirectory() as folder:
                failures = page.run(Path(folder), public=public)
                for picture in shown(path) if public is None else ():
                    drawn = Path(folder) / "checkout" / picture.name
                    if drawn.exists():
                        shutil.copy(drawn, picture)
            sys.stdout.write("".join(f"{failure}\n\n" for failure in failures))
            path.write_text(page.corrected(), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
