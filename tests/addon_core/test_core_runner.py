"""Runs in a thread: progress, cancel, errors."""

from __future__ import annotations

import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest

import fairing
from core.runner import NAME, Run, stop_all


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
    assert background.cancelled
    assert not background.finished  # the work is still busy: cancelling did not wait for it
    go_on.set()
    assert background.wait(10.0)
    assert answers == [True, False]
    with pytest.raises(fairing.Cancelled):  # although the work has returned something
        background.result()


def until_stopped(progress: Any) -> None:
    while progress(0.0, ""):
        time.sleep(0.001)


def test_all_runs_are_stopped_and_joined() -> None:
    """Those as well that have been cancelled before, and those that nobody holds any more."""
    ended, runs = Run(lambda _progress: 42), [Run(until_stopped) for _ in range(3)]
    assert ended.wait(10.0)
    runs[0].cancel()
    del runs[1]
    stop_all()
    assert all(run.finished and run.cancelled for run in runs)
    assert NAME not in [thread.name for thread in threading.enumerate()]
    assert ended.result() == 42
    stop_all()  # there is nothing to stop


EXIT = """
import sys, time
sys.path[:0] = [{addon!r}, {tests!r}]
import shapes, fairing
from core.runner import Run

cap = shapes.cap(20000)

def work(progress):
    while True:  # whenever the process ends, it ends in the engine
        fairing.fair(cap.vertices, cap.triangles, fixed=cap.fixed, fixed_normals=cap.fixed_normals, progress=progress)

run = Run(work)
while run.fraction == 0.0:
    time.sleep(0.001)
time.sleep({seconds})
{last}
assert not run.finished
"""


@pytest.mark.parametrize("last", ["", "run.cancel()"], ids=["during", "cancelled"])
@pytest.mark.parametrize("seconds", [0.0, 0.1, 0.2])
def test_a_process_ends_well_during_a_run(last: str, seconds: float) -> None:
    tests = Path(__file__).parents[1]
    lines = EXIT.format(addon=str(tests.parent / "addon"), tests=str(tests), seconds=seconds, last=last)
    ended = subprocess.run([sys.executable, "-c", lines], capture_output=True, text=True, timeout=60.0, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")
