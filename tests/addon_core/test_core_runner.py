"""Runs in a thread: progress, cancel, errors."""

from __future__ import annotations

import threading
from typing import Any

import pytest

from core.runner import Run, wait_for_all


def test_returns_what_the_work_returns() -> None:
    assert Run(lambda _progress: 42).result() == 42


def test_raises_what_the_work_raises() -> None:
    def work(_progress: Any) -> int:
        raise ValueError("spoilt")

    with pytest.raises(ValueError, match="spoilt"):
        Run(work).result()


def test_shows_progress_and_ends() -> None:
    told, go_on = threading.Event(), threading.Event()

    def work(progress: Any) -> int:
        assert progress(0.25, "descent")
        told.set()
        assert go_on.wait(10.0)
        return 1

    background = Run(work)
    assert told.wait(10.0)
    assert not background.finished
    assert (background.fraction, background.stage) == (0.25, "descent")
    go_on.set()
    assert background.wait(10.0)
    assert background.result() == 1


def test_cancel_returns_at_once_and_the_work_hears_of_it() -> None:
    answers: list[bool] = []
    started, go_on = threading.Event(), threading.Event()

    def work(progress: Any) -> int:
        answers.append(progress(0.0, "first"))
        started.set()
        assert go_on.wait(10.0)
        answers.append(progress(0.5, "second"))
        return 0

    background = Run(work)
    assert started.wait(10.0)
    background.cancel()
    assert not background.finished  # the work is still busy: cancelling did not wait for it
    assert not wait_for_all(0.0)
    go_on.set()
    assert background.wait(10.0)
    assert answers == [True, False]
    assert wait_for_all(10.0)
