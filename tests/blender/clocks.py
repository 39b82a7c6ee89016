"""How long Blender stands still, on a machine that has other work too."""

from __future__ import annotations

import time

LONGEST = 0.3  # seconds of the processor that Blender may stand still
STUCK = 5.0  # seconds by the wall: so long it waits for something, whatever else the machine does


def clocks() -> tuple[float, float]:
    """Seconds of this thread's processor, and by the wall."""
    return time.thread_time(), time.perf_counter()


def assert_was_quick(begin: tuple[float, float]) -> None:
    """Fail if what began then has held Blender up."""
    spent, passed = (now - then for now, then in zip(clocks(), begin, strict=True))
    assert spent < LONGEST
    assert passed < STUCK
