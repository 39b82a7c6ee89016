"""No call of the engine stops Python's other threads: a thread counts meanwhile."""

import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import shapes
from fairing import _core

CAP = shapes.cap(4000)
POINTS = np.ascontiguousarray(CAP.vertices, float)
FACES = np.ascontiguousarray(CAP.triangles, np.int32)
FIXED = np.ascontiguousarray(CAP.fixed, np.int32)
CALLS: dict[str, tuple[Any, ...]] = {
    "components": (FACES, FIXED, len(POINTS)),
    "denoised": (POINTS, FACES, FIXED, np.full(len(POINTS), 0.1), 1, None),
    "girth": (POINTS, FACES, None),
    "mean_curvature": (POINTS, FACES, None, None, "fitted"),
    "self_intersections": (POINTS, FACES, None),
}
BINDINGS = Path(__file__).parents[2] / "native/bindings"


@pytest.fixture
def _nobody_is_interrupted() -> Iterator[None]:
    """Python changes threads where one waits, and nowhere else."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(1000.0)
    yield
    sys.setswitchinterval(before)


def counted_during(call: Callable[[], object]) -> int:
    """How often another thread had its turn."""
    turns, ended = 0, False
    figures: list[int] = []

    def work() -> None:
        nonlocal ended
        figures.append(turns)
        for _ in range(500):  # a short call may be over before the other thread wakes
            call()
            if turns > figures[0]:
                break
        figures.append(turns)
        ended = True

    thread = threading.Thread(target=work)
    thread.start()
    while not ended and thread.is_alive():
        turns += 1
        time.sleep(0)
    thread.join()
    return figures[1] - figures[0]


@pytest.mark.usefixtures("_nobody_is_interrupted")
@pytest.mark.parametrize("name", CALLS)
def test_other_threads_go_on(name: str) -> None:
    assert counted_during(lambda: getattr(_core, name)(*CALLS[name])) > 0


@pytest.mark.usefixtures("_nobody_is_interrupted")
def test_a_call_that_keeps_the_lock_is_seen() -> None:
    numbers = list(range(1000))
    assert counted_during(lambda: sorted(numbers, reverse=True)) == 0


def test_all_functions_are_bound_in_the_way_of_these() -> None:
    """By `bind`, which alone defines functions of the module."""
    assert [file.name for file in BINDINGS.iterdir() if "module.def(" in file.read_text()] == ["bind.h"]
