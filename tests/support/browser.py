"""A real browser for the tests of the explorer, and what a page is asked in it."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import msgspec
import pytest
from selenium.webdriver import Chrome
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

from foon_asp.model.node import ObjectNode
from foon_asp.model.world import World
from foon_asp.render.explorer import explorer_page, world_rows
from support.paths import ROOT

AXE = ROOT / "explorer" / "node_modules" / "axe-core" / "axe.min.js"
_PATIENCE = 250
"""Seconds after which a script that does not end is an error; on a busy machine some take a while."""

_ARGUMENTS = (
    "--headless=new",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-dev-shm-usage",
    "--disable-background-networking",
    "--disable-component-update",
    "--no-first-run",
)

FREE: Mapping[str, Any] = {
    "without": [],
    "diets": [],
    "without_tools": [],
    "avoid_motions": [],
    "use_units": [],
    "avoid_units": [],
    "max_units": None,
    "max_depth": None,
}
"""No constraint, as the page has it."""


def lacking(what: str, advice: str) -> None:
    """Skip a test for what is not on this machine; `.ci/run` installs it wherever it can."""
    pytest.skip(f"no {what}: {advice}")


def start() -> Iterator[Chrome]:
    """Start a browser without a window, and end it."""
    chromium = shutil.which("chromium") or shutil.which("google-chrome")
    driver = shutil.which("chromedriver")
    if chromium is None or driver is None:
        lacking("browser", "apt-get install chromium chromium-driver")
        return
    options = Options()
    options.binary_location = chromium
    for argument in _ARGUMENTS:
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    browser = Chrome(options=options, service=Service(driver))
    try:
        browser.set_script_timeout(_PATIENCE)
        yield browser
    finally:
        browser.quit()


class Explorer:
    """A page that is open in a browser."""

    def __init__(self, browser: Chrome, world: World, folder: Path, **options: Any) -> None:
        self.browser = browser
        self.world = world
        path = folder / "explorer.html"
        path.write_text(explorer_page(world, title="test", **options).text, encoding="utf-8")
        self.address = path.as_uri()
        self.open()
        # What others' pages drew is theirs.
        self.complaints()

    def open(self, state: str = "") -> None:
        """Open the page anew, in a state."""
        self.browser.get("about:blank")
        self.browser.get(f"{self.address}#{state}")
        self.wait("return window.foonExplorer !== undefined")

    def wait(self, script: str) -> None:
        """Wait until a script returns something true; the page says by itself when it changes."""
        self.call(
            f"const until = () => {{ {script} }};", "until() ? done() : setTimeout(wait, 20)", loop=True
        )

    def settled(self) -> None:
        """Wait until what was asked is answered."""
        self.wait("return document.querySelector('#answer').ariaBusy === 'false'")

    def script(self, text: str, *values: object) -> Any:
        return self.browser.execute_script(text, *values)

    def call(self, before: str, text: str, *values: object, loop: bool = False) -> Any:
        """Run a script that calls `done` with what it returns."""
        body = f"const wait = () => {{ {text} }}; wait();" if loop else text
        script = f"const done = arguments[arguments.length - 1]; {before} {body}"
        return self.browser.execute_async_script(script, *values)

    def ask_all(self, world: World | None, questions: Sequence[Mapping[str, Any]]) -> list[Any]:
        """Ask the page several questions over a world, its own if none is given, in one call."""
        row = None if world is None else json.dumps(rows(world))
        answers = self.call(
            "const row = JSON.parse(arguments[0] ?? 'null'), asked = JSON.parse(arguments[1]), found = [];",
            "(async () => { for (const each of asked) {"
            " const { kind, ...question } = each;"
            " const failed = error => ({ error: String(error.stack) });"
            " found.push(await foonExplorer[kind](row, question).catch(failed));"
            " } return JSON.stringify(found); })().then(done)",
            row,
            json.dumps(list(questions)),
        )
        found: list[Any] = json.loads(answers)
        return found

    def reach(self, worlds: Sequence[World]) -> list[Any]:
        """Return what the page says that units of some worlds need, make and can be done in."""
        said = self.script(
            "return JSON.stringify(JSON.parse(arguments[0]).map(row => foonExplorer.reach(row)))",
            json.dumps([rows(world) for world in worlds]),
        )
        found: list[Any] = json.loads(said)
        return found

    def complaints(self) -> list[str]:
        """Return what the browser complained of since it was asked last."""
        log: list[dict[str, str]] = self.browser.execute("getLog", {"type": "browser"})["value"]
        return [entry["message"] for entry in log]


def rows(world: World) -> Any:
    """Return a world as the page reads it."""
    return msgspec.to_builtins(world_rows(world, title="test"))


def question(*goals: ObjectNode, kind: str = "ask", **changes: Any) -> dict[str, Any]:
    """Return a question as the page takes it."""
    nodes = [[node.label, [[s.name, s.relatum, s.contents] for s in node.states]] for node in goals]
    asked = {"kind": kind, "goals": nodes, "method": "optimal", "by": ["units"], "founded": True, "count": 1}
    return {**asked, "constraints": dict(FREE), **changes}
