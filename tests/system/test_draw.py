"""Pictures of answers and files: what is in them, in which format, and what is said where there is none."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest

import foon_asp as fa
from foon_asp import limits
from foon_asp.draw.colours import DARK, LIGHT, Colours, style
from foon_asp.draw.dot import dot_text
from foon_asp.draw.layout import graphviz
from foon_asp.draw.picture import Role, Side
from foon_asp.errors import QueryError
from foon_asp.limits import LimitReachedError
from support.cli import check_same_bytes, run
from support.pictures import SVG, titles
from support.small_foons import foon

CREAM = "whipped cream [creamy, whipped] in [mixing bowl]"


def unit(inputs: str, motion: str, outputs: str) -> str:
    """Return a unit as FOON text; an object is `label:state,state`."""

    def side(text: str) -> str:
        found = ""
        for each in text.split("; "):
            label, _, states = each.partition(":")
            found += f"O\t{label}\n" + "".join(f"S\t{state}\n" for state in states.split(",") if state)
        return found

    return f"{side(inputs)}M\t{motion}\n{side(outputs)}//\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a tree in the wrong order, one in the right order, and a circle."""
    monkeypatch.chdir(tmp_path)
    peel, cut = unit("egg:boiled", "peel", "egg:peeled"), unit("egg:peeled", "cut", "egg:cut")
    (tmp_path / "wrong.txt").write_text("//\n" + cut + peel)
    (tmp_path / "right.txt").write_text("//\n" + peel + cut)
    circle = unit("a:1", "go", "b:1") + unit("b:1", "return", "a:1") + unit("b:1; salt", "end", "c:1")
    (tmp_path / "circle.txt").write_text("//\n" + circle)
    (tmp_path / "empty.json").write_text('[{"label": "salt"}]')
    return tmp_path


def drawn(capsys: pytest.CaptureFixture[str], *arguments: object, status: int = 0) -> str:
    """Draw, and return what is on standard output."""
    found, out, err = run(capsys, "draw", *arguments, "--quiet")
    assert (found, err) == (status, "")
    return out


def texts(svg: str) -> list[str]:
    """Return all words of a picture."""
    return [each.text or "" for each in ElementTree.fromstring(svg).iter(f"{SVG}text")]


def firsts(svg: str) -> list[str]:
    """Return the first lines of all titles: the labels of nodes, and where arrows lead."""
    return [title.split("\n")[0] for title in titles(svg)]


def test_a_tree_has_its_steps_and_its_objects(capsys: pytest.CaptureFixture[str]) -> None:
    tree = fa.load().retrieve("whipped cream").tree
    assert tree is not None
    svg = drawn(capsys, "whipped cream")
    found = firsts(svg)
    for step in tree.steps:
        assert found.count(f"{step.place} {step.motion}") == 1
        for node, origin in zip(step.takes, step.origins, strict=True):
            arrow = f"{node} → {step.place} {step.motion}"
            assert found.count(arrow) == (origin is not None or not tree.world.is_tool(node)), arrow
    assert [title for title in titles(svg) if title.endswith("\ngoal")] == [f"{CREAM}\ngoal"]
    assert svg == tree.draw().to_svg() == tree._repr_svg_()
    assert "prefers-color-scheme" in svg
    assert "prefers-color-scheme" not in drawn(capsys, "whipped cream", "--dark")


@pytest.mark.parametrize(
    ("suffix", "start"),
    [("svg", b"<svg "), ("png", b"\x89PNG"), ("pdf", b"%PDF"), ("dot", b"digraph"), ("mmd", b"---\n")],
)
def test_the_suffix_chooses_the_format(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, suffix: str, start: bytes
) -> None:
    path = tmp_path / f"ice.{suffix}"
    assert drawn(capsys, "ice", "-o", path) == ""
    assert path.read_bytes().startswith(start)
    front = tmp_path / f"front.{suffix}"
    command = ["draw", "whipped cream", "--show", "pareto", "-o", front, "--quiet"]
    if suffix == "mmd":
        assert "a plot is no flow chart" in run(capsys, *command)[2]
    else:
        assert run(capsys, *command) == (0, "", "")
        assert front.read_bytes().startswith(start)


def test_bytes_go_to_standard_output(capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    assert run_bytes("draw", "ice", "--format", "png", "--quiet") == 0
    assert capfdbinary.readouterr().out.startswith(b"\x89PNG")


def run_bytes(*arguments: str) -> int:
    from foon_asp.cli.main import main

    return main(list(arguments))


def test_the_kinds_of_pictures(
    capsys: pytest.CaptureFixture[str],
    folder: Path,  # noqa: ARG001 - the current folder
) -> None:
    menu = texts(drawn(capsys, "hummus", "falafel"))
    assert menu.count("goal") == 2
    assert {"for hummus", "for falafel", "for all"} <= set(menu)

    plan = firsts(drawn(capsys, "whipped cream", "--show", "plan"))
    assert "4 shake" in plan
    assert "jar {heavy cream} → 2 add (used up)" in plan

    compared = texts(drawn(capsys, "hummus", "--compare", "units", "success"))
    assert compared[0] == "hummus: 6 steps in both, 4 only in units, 9 only in success"
    assert (compared.count("only in units"), compared.count("only in success")) == (4, 9)

    front = drawn(capsys, "whipped cream", "--show", "pareto")
    assert [title.split("\n")[0] for title in titles(front) if title.startswith("tree")] == [
        *["tree 1", "tree 2", "tree 3"] * 2
    ]

    around = firsts(drawn(capsys, "--around", "onion [peeled]"))
    assert "onion [peeled] → chop" in around
    assert "peel → onion [peeled]" in around

    wrong = drawn(capsys, "wrong.txt")
    assert "too early: step 2 makes egg [peeled]" in re.sub(r"\s+", " ", wrong)
    assert "egg [peeled] → 1 cut (missing)" in firsts(wrong)
    assert "(missing)" not in drawn(capsys, "right.txt")
    assert "(missing)" not in drawn(capsys, "wrong.txt", "--show", "foon")

    assert texts(drawn(capsys, "--compare", "wrong.txt", "right.txt"))[0].endswith(
        "2 steps in both, 0 only in wrong.txt, 0 only in right.txt"
    )

    circle = drawn(capsys, "c", "--foon", "circle.txt", "--kitchen", "empty.json", status=1)
    ring = [
        group
        for group in ElementTree.fromstring(circle).iter(f"{SVG}g")
        if group.get("class") == "foon-strong"
    ]
    assert {group.findtext(f"{SVG}title") for group in ring} == {
        *("a [1] → go", "go → b [1]", "b [1] → return", "return → a [1]"),
    }
    assert "missing" in " ".join(texts(circle))


def test_a_large_foon_has_an_overview(capsys: pytest.CaptureFixture[str]) -> None:
    found = drawn(capsys)
    nodes = [title.split("\n") for title in titles(found)]
    dishes = [title for title in nodes if title[-1].endswith(" steps")]
    shared = [title for title in nodes if re.fullmatch(r"in \d+ dishes", title[-1])]
    assert len(dishes) > 20
    assert len(shared) > 10
    arrows = [title[0] for title in nodes if " → " in title[0]]
    assert sum(int(title[-1].split()[1]) for title in shared) == len(arrows)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["ice", "-o", "ice.bmp"], "ice.bmp: no picture has this suffix"),
        (["ice", "--hops", "2"], "--hops says how far to look around an object"),
        (["ice", "--show", "tree", "--compare", "units", "success"], "ask for one of them"),
        (["ice", "wrong.txt"], "name goals or files, not both"),
        (["wrong.txt", "--compare", "wrong.txt", "right.txt"], "leave out the files before it"),
        (["ice", "--around", "onion [peeled]"], "leave out the goals"),
        (["ice", "--show", "foon"], "--show foon is not for what is named here"),
        (["wrong.txt", "--show", "menu"], "--show menu is not for what is named here"),
        (["nowhere.txt"], "no such file"),
        (["nonesuch"], "unknown goal 'nonesuch'"),
        (["ice", "hummus", "--compare", "units", "success"], "trees of one goal are compared"),
        (["--compare", "ice", "nonesuch"], "unknown goal 'nonesuch'"),
        (["ice", "--show", "pareto", "--by", "units"], "a trade-off needs two criteria"),
        (["--around", "nonesuch"], "unknown"),
    ],
)
def test_what_cannot_be_drawn_is_one_line(
    capsys: pytest.CaptureFixture[str],
    folder: Path,  # noqa: ARG001 - the current folder
    arguments: list[str],
    message: str,
) -> None:
    status, out, err = run(capsys, "draw", *arguments, "--quiet")
    assert (status, out) == (2, "")
    assert message in err
    assert err.count("\n") == 1


@pytest.mark.parametrize("flags", [["hummus"], ["--show", "plan"], ["--show", "pareto"]])
def test_where_there_is_nothing_to_draw_there_is_no_file(
    capsys: pytest.CaptureFixture[str], folder: Path, flags: list[str]
) -> None:
    status, out, err = run(
        capsys, "draw", "ice", *flags, "--kitchen", "empty.json", "-o", "ice.svg", "--quiet"
    )
    assert (status, out, err.count("\n")) == (1, "", 1)
    assert re.match("foon-asp: no (task tree|plan)", err)
    assert not (folder / "ice.svg").exists()


def _pretend(folder: Path, monkeypatch: pytest.MonkeyPatch, code: str) -> None:
    """Have another pygraphviz found, in this process and those that it starts."""
    (folder / "pygraphviz.py").write_text(code)
    monkeypatch.syspath_prepend(folder)


def test_where_graphviz_is_not_there_a_line_says_what_to_install(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    _pretend(tmp_path, monkeypatch, "raise ImportError('libXrender.so.1: cannot open shared object file')")
    status, out, err = run(capsys, "draw", "ice")
    assert (status, out, err.count("\n")) == (2, "", 1)
    assert "libXrender.so.1" in err
    assert "pip install pygraphviz" in err
    assert "digraph" in drawn(capsys, "ice", "--format", "dot")
    assert "flowchart" in drawn(capsys, "ice", "--format", "mermaid")
    answer = fa.load().retrieve("ice")
    assert answer.tree is not None
    assert answer.tree._repr_svg_() is None
    assert "<svg" not in answer._repr_html_()
    assert "crank" in answer._repr_html_()


def test_a_process_that_reads_late_is_given_all(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """More than a pipe holds, after more than one look whether it is done."""
    late = (
        "import time\ntime.sleep(0.5)\nclass AGraph:\n"
        "    def __init__(self, string): self.string = string\n"
        "    def draw(self, format, prog): return self.string.encode()[::-1]\n"
    )
    _pretend(tmp_path, monkeypatch, late)
    text = "digraph { } " * 100_000
    assert graphviz(text, "json0") == text.encode()[::-1]


def test_a_layout_ends_with_the_time(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    waits = "import time\nclass AGraph:\n    def __init__(self, string): time.sleep(1000)\n"
    _pretend(tmp_path, monkeypatch, waits)
    with limits.limited(0.01), pytest.raises(LimitReachedError):
        graphviz("digraph {}", "json0")


def test_without_a_font_letters_are_not_left_out(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "fonts.conf").write_text(
        f'<?xml version="1.0"?><fontconfig><cachedir>{tmp_path}</cachedir></fontconfig>'
    )
    monkeypatch.setenv("FONTCONFIG_FILE", str(tmp_path / "fonts.conf"))
    answer = fa.load().retrieve("ice")
    with pytest.raises(QueryError, match="png and pdf need a font"):
        answer.draw().to_png()
    # Letters are measured without a font.
    assert "crank" in answer.draw().to_svg()


def test_the_same_picture_each_time(tmp_path: Path) -> None:
    check_same_bytes(["draw", "whipped cream", "--quiet"], tmp_path)


def _light(colour: str) -> float:
    parts = [int(colour[place : place + 2], 16) / 255 for place in (1, 3, 5)]
    red, green, blue = (
        each / 12.92 if each <= 0.04045 else ((each + 0.055) / 1.055) ** 2.4 for each in parts
    )
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


def contrast(one: str, other: str) -> float:
    """Return the contrast of two colours as WCAG defines it, 1 to 21."""
    low, high = sorted([_light(one), _light(other)])
    return (high + 0.05) / (low + 0.05)


@pytest.mark.parametrize("colours", [LIGHT, DARK], ids=lambda colours: colours.name)
def test_letters_and_lines_stand_out(colours: Colours) -> None:
    for role in Role:
        for side in Side:
            look = style(colours, role, side)
            below = look.fill if role is not Role.POINT else colours.paper
            assert contrast(look.ink, below) >= 4.5, (role, side)
            if role is not Role.NOTE and side is not Side.BOTH and role is not Role.AT_HAND:
                assert contrast(look.line, colours.paper) >= 3, (role, side)
    assert contrast(colours.ink, colours.paper) >= 4.5
    assert contrast(colours.arrow, colours.paper) >= 3
    assert contrast(colours.strong, colours.paper) >= 3


def test_what_notebooks_show() -> None:
    small = foon("a -mix-> b", "b + (pan) -fry-> c")
    assert "<svg" in small._repr_html_()
    world = fa.World(small, ["a [ready]", "pan"])
    assert "<svg" in world._repr_html_()
    plan = world.plan("c [ready]")
    assert "<svg" in plan._repr_html_()
    assert "proven optimal" in plan._repr_html_()
    assert plan.plan is not None
    assert plan.plan.to_frame()["motion"].tolist() == ["mix", "fry"]
    assert plan.plan.to_frame()["gone"].tolist() == ["", "b [ready]"]
    assert str(plan).startswith("c [ready]\n2 steps, 2 in parallel")
    assert small.to_frame()["motion"].tolist() == ["mix", "fry"]
    graph = small.to_networkx()
    assert (graph.number_of_nodes(), graph.number_of_edges()) == (6, 5)
    # A large one is drawn only when it is asked for.
    assert fa.load().foon._repr_svg_() is None
    with pytest.raises(QueryError, match=r"explain\(query\)\.draw\(\)"):
        world.retrieve(fa.Query("c [ready]", remove=["pan"])).draw()
    assert "missing" in world.explain(fa.Query("c [ready]", remove=["pan"])).draw().to_dot()
    assert dot_text(world.draw().picture) == world.draw().to_dot()
