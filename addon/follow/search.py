"""The search for a live region's surface once all is quiet: in a thread of its own, while Blender goes on.

The thread sees arrays alone. Until it has ended nobody else may ask the region, since both would use its solver.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import fairing

from ..core.arrays import Floats
from ..core.engine import Progress
from ..core.live_region import LiveRegion
from ..core.runner import Run

LEISURE = 3.0  # seconds of the processor for each of the three ways to an answer: other work is no reason to give up

Ask = Callable[[Floats, Floats, Progress], "Floats | None"]


@dataclass(frozen=True)
class Found:
    """How a search has ended."""

    positions: Floats | None = None  # (k, 3) of the region's free vertices; None: there is no surface
    stands_in: bool = False  # the surface of least variation instead of the one that was asked for


class Search:
    """One search, for the region at these positions."""

    def __init__(self, region: LiveRegion, positions: Floats, matrix: Floats) -> None:
        """Begin at once. positions: (n, 3) of region.vertices; matrix: (4, 4) to world space."""
        self.stopped = False
        self._run = Run(lambda progress: sought(region, positions, matrix, progress))

    def stop(self) -> None:
        """Ask it to end; what it finds counts no more. Returns at once."""
        self.stopped = True
        self._run.cancel()

    def wait(self, seconds: float | None) -> bool:
        """Wait for the end, at most so long; tell whether it has come."""
        return self._run.wait(seconds)

    def found(self) -> Found:
        """Return how it ended; waits for that, and raises what went wrong on the way."""
        return self._run.result()


def sought(region: LiveRegion, positions: Floats, matrix: Floats, progress: Progress) -> Found:
    """Search for the surface itself, from the last answer and afresh, then for the one that stands in for it."""
    for ask in (region.answer, region.afresh, region.stand_in):
        if progress(0.0, "") is False:  # even to begin may take a while
            break
        answer = _asked(ask, positions, matrix, progress)
        if answer is not None:
            return Found(answer, ask == region.stand_in)
    return Found()


def _asked(ask: Ask, positions: Floats, matrix: Floats, progress: Progress) -> Floats | None:
    end = time.thread_time() + LEISURE

    def in_time(part: float, stage: str) -> bool:
        return progress(part, stage) is not False and time.thread_time() < end

    try:
        return ask(positions, matrix, in_time)
    except (fairing.Cancelled, fairing.SolverError):
        return None
