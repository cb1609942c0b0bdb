"""Limits: nested ones only get tighter, and belong to the thread that set them."""

from __future__ import annotations

import math
import threading
import time

import pytest

from foon_asp import limits
from foon_asp.limits import Limit, LimitReachedError, limited, moment


def test_without_a_limit_nothing_is_ever_reached() -> None:
    assert (limits.seconds_left(), limits.memory_allowed()) == (math.inf, math.inf)
    assert not limits.limited_now()
    assert limits.reached() is None
    limits.check()


def test_a_limit_inside_another_one_is_only_tighter() -> None:
    with limited(100, 50):
        assert limits.limited_now()
        assert 99 < limits.seconds_left() <= 100
        with limited(1000, 20):
            assert limits.seconds_left() <= 100
            assert limits.memory_allowed() == 20_000_000
        with limited():
            assert (limits.seconds_left() <= 100, limits.memory_allowed()) == (True, 50_000_000)
    assert not limits.limited_now()


def test_who_has_something_to_show_gets_no_moment_more() -> None:
    with limited(100), limits.strictly():
        limits.check()
    with limited(0), limits.strictly(), pytest.raises(LimitReachedError):
        limits.check()


def test_what_is_over_raises_and_a_moment_is_always_there() -> None:
    with limited(0):
        assert limits.reached() is Limit.TIME
        limits.check()
        time.sleep(0.6)
        with pytest.raises(LimitReachedError, match="the time ran out") as caught:
            limits.check()
        assert caught.value.limit is Limit.TIME
        with moment():
            limits.check()
            assert 0 < limits.seconds_left() < 1
        assert limits.reached() is Limit.TIME
    with limited(100), moment():
        assert limits.seconds_left() > 99


def test_an_error_ends_a_limit() -> None:
    with pytest.raises(ZeroDivisionError), limited(0):
        _ = 1 / 0
    limits.check()


def test_other_threads_are_not_limited() -> None:
    seen: list[float] = []
    with limited(5):
        thread = threading.Thread(target=lambda: seen.append(limits.seconds_left()))
        thread.start()
        thread.join()
    assert seen == [math.inf]


def test_only_what_waits_may_be_told_to_finish() -> None:
    assert not limits.finish_if_waiting()
    limits.let_interrupts_finish()
    try:
        assert not limits.finish_if_waiting()
        with limits.waiting():
            assert not limits.interrupted()
    finally:
        limits.let_interrupts_finish(False)
