"""Run a notebook as Jupyter does, and compare what comes out with what is in its file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient

from support.pictures import skeleton

PATIENCE = 280
"""Seconds that a cell, and the start of the kernel, may take on a machine with much to do."""


def opened(path: Path) -> Any:
    """Return a notebook as it is in its file."""
    return nbformat.reads(path.read_text(encoding="utf-8"), as_version=4)  # type: ignore[no-untyped-call]


def written(notebook: Any) -> str:
    """Return a notebook as it is in a file."""
    return f"{nbformat.writes(notebook)}\n"  # type: ignore[no-untyped-call]


def executed(path: Path, folder: Path) -> Any:
    """Return a notebook with what its cells put out now; it works in a folder."""
    notebook = opened(path)
    client = NotebookClient(
        notebook,
        kernel_name="python3",
        timeout=PATIENCE,
        startup_timeout=PATIENCE,
        resources={"metadata": {"path": str(folder)}},
        record_timing=False,
    )
    manager = client.create_kernel_manager()
    # Files instead of ports: another process may take a port that was free a moment ago.
    manager.transport, manager.ip = "ipc", str(folder / "kernel")
    client.execute()
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            output.get("metadata", {}).clear()
    notebook.metadata = {key: notebook.metadata[key] for key in ("kernelspec", "language_info")}
    notebook.metadata.language_info = {"name": "python"}
    return notebook


def shown(notebook: Any) -> list[object]:
    """Return what the cells put out, in which all machines agree: texts, and what is in pictures."""
    found: list[object] = []
    for cell in notebook.cells:
        for output in cell.get("outputs", ()):
            data = output.get("data", {})
            if "image/svg+xml" in data:
                found.append(skeleton(data["image/svg+xml"]))
            found.append(data.get("text/plain", output.get("text")))
    return found
