"""Runs in a thread: progress, cancel, errors."""

import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

import pytest
from addon.run.runner import NAME, Run, stop_all

import fairing


def test_raises_what_the_work_raises() -> None:
    def work(_progress: Any) -> int:
        raise ValueError("spoilt")

    with pytest.raises(ValueError, match="spoilt"):
        Run(work).result()


def test_shows_progress_and_ends() -> None:
    reported, go_on = threading.Event(), threading.Event()

    def work(progress: Any) -> int:
        assert progress(0.25, "descent")
        reported.set()
        assert go_on.wait(10.0)
        return 1

    background = Run(work)
    assert reported.wait(10.0)
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
sys.path.insert(0, {addon!r})
import numpy as np
import fairing
from addon.run.runner import Run

size = 60
y, x = np.mgrid[-1.0 : 1.0 : size * 1j, -1.0 : 1.0 : size * 1j].reshape(2, -1)
corners = (np.arange(size - 1)[:, None] * size + np.arange(size - 1)).ravel()
triangles = np.concatenate([corners[:, None] + [0, 1, size + 1], corners[:, None] + [0, size + 1, size]])
bowl = np.stack([x, y, x**2 + y**2], axis=1)

def work(progress):
    while True:  # whenever the process ends, it ends in the engine
        fairing.fair(bowl, triangles, progress=progress)

run = Run(work)
while run.fraction == 0.0:
    time.sleep(0.001)
time.sleep({seconds})
{last}
assert not run.finished
"""


@pytest.mark.parametrize("last", ["", "run.cancel()"], ids=["during", "cancelled"])
@pytest.mark.parametrize("seconds", [0.0, 0.1])
def test_a_process_ends_well_during_a_run(last: str, seconds: float) -> None:
    lines = EXIT.format(addon=str(Path(__file__).parents[2] / "addon"), seconds=seconds, last=last)
    ended = subprocess.run([sys.executable, "-c", lines], capture_output=True, text=True, timeout=120.0, check=False)
    assert (ended.returncode, ended.stderr) == (0, "")
