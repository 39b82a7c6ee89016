"""The search for a live region's surface once all is quiet: in a thread of its own, while Blender goes on.

The thread sees arrays alone. Until it has ended nobody else may ask the region, since both would use its solver.
"""

from __future__ import annotations

from ..arrays.types import Floats
from ..run.runner import Run
from .region import LiveRegion
from .region_search import Found, sought


class Search:
    """One search, for the region at these positions."""

    def __init__(self, region: LiveRegion, positions: Floats, matrix: Floats) -> None:
        """Begin at once. positions: (n, 3) of region.vertices; matrix: (4, 4) to world space."""
        self._run = Run(lambda progress: sought(region, positions, matrix, progress))

    @property
    def stopped(self) -> bool:
        """Whether it was asked to end, here or with all other runs."""
        return self._run.cancelled

    def stop(self) -> None:
        """Ask it to end; what it finds counts no more. Returns at once."""
        self._run.cancel()

    def wait(self, seconds: float | None) -> bool:
        """Wait for the end, at most so long; return whether it has come."""
        return self._run.wait(seconds)

    def found(self) -> Found:
        """Return how it ended; waits for that, and raises what went wrong on the way."""
        return self._run.result()
