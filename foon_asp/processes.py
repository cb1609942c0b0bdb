"""Processes that are started here: how much memory they take, how they end, and that none is left behind."""

from __future__ import annotations

import multiprocessing
import os
import threading
from contextlib import suppress
from multiprocessing.connection import wait

import psutil


def family(pid: int) -> list[psutil.Process]:
    """Return what a process has started, and what that has, and last the process itself."""
    with suppress(psutil.NoSuchProcess):
        process = psutil.Process(pid)
        return [*process.children(recursive=True), process]
    return []


def memory_taken(pid: int) -> int:
    """Return how many bytes of memory a process takes, with all that it started."""
    taken = 0
    for each in family(pid):
        with suppress(psutil.NoSuchProcess):
            taken += each.memory_info().rss
    return taken


def end_family(pid: int, *, itself: bool = True) -> None:
    """End all that a process started, in sessions of their own, too, and itself."""
    for each in family(pid):
        if itself or each.pid != pid:
            with suppress(psutil.NoSuchProcess):
                each.kill()


def leave_with_parent() -> None:
    """End this process, with all that it started, when the one that started it ends, however that is."""
    parent = multiprocessing.parent_process()
    if parent is not None:
        threading.Thread(target=_leave_after, args=(parent.sentinel,), daemon=True).start()


def _leave_after(sentinel: int) -> None:
    wait([sentinel])
    end_family(os.getpid(), itself=False)
    os._exit(1)
