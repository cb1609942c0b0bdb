"""What is shipped of the explorer: built of the sources that are here, and with a policy that fits it."""

from __future__ import annotations

import base64
import hashlib
import json
import re

from foon_asp.render.explorer import inert
from support.paths import ROOT

SOURCES = ROOT / "explorer"
SHIPPED = ROOT / "foon_asp" / "explorer"
PINS = ("build.mjs", "package.json", "package-lock.json", "tsconfig.json", "licences.txt")


def sha256(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()


def test_the_page_was_built_of_these_sources() -> None:
    files = [path.relative_to(SOURCES).as_posix() for path in (SOURCES / "src").rglob("*") if path.is_file()]
    text = "".join(f"{name}\n{sha256((SOURCES / name).read_bytes())}\n" for name in sorted([*files, *PINS]))
    page = (SHIPPED / "page.html").read_text(encoding="utf-8")
    built = re.search('name="built-from" content="([0-9a-f]{64})"', page)
    assert built is not None
    assert built[1] == sha256(text.encode()), "the sources of the explorer were changed: run make explorer"


def test_the_policy_lets_only_what_is_shipped_run() -> None:
    page = (SHIPPED / "page.html").read_text(encoding="utf-8")
    policy = re.search('http-equiv="Content-Security-Policy" content="([^"]*)"', page)
    assert policy is not None

    def hashed(tag: str) -> str:
        [text] = re.findall(f"<{tag}>(.*?)</{tag}>", page, re.DOTALL)
        return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"

    assert policy[1].split("; ") == [
        "default-src 'none'",
        f"script-src {hashed('script')} 'wasm-unsafe-eval'",
        f"style-src {hashed('style')}",
        "worker-src blob:",
        "connect-src blob:",
        "base-uri 'none'",
        "form-action 'none'",
    ]


def test_every_package_is_pinned_and_has_no_address() -> None:
    package = json.loads((SOURCES / "package.json").read_text(encoding="utf-8"))
    pins = {**package["dependencies"], **package["devDependencies"]}
    assert all(re.fullmatch(r"\d+\.\d+\.\d+", version) for version in pins.values())
    assert pins["clingo-wasm"] == "0.6.0"
    lock = json.loads((SOURCES / "package-lock.json").read_text(encoding="utf-8"))
    assert not [name for name, each in lock["packages"].items() if "resolved" in each]
    licences = (SHIPPED / "LICENSES.txt").read_text(encoding="utf-8")
    assert all(f"{name} {version}" in licences for name, version in package["dependencies"].items())


def test_data_are_no_markup() -> None:
    value = {"</script>": ["<!--<script>", "&lt;", "\u2028", '"', "\\u003c", "é"]}
    text = inert(value)
    assert json.loads(text) == value
    assert not set(text) & set("<>&\u2028\u2029")
