"""CPU seconds of one call at the default tolerance, single thread, best of three."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

import blend
import graded
import shapes
from exact import Scope
from report import Row
from shapes import Patch

CASES: dict[str, Callable[[int], Patch | blend.Blend]] = {
    "hemisphere": shapes.cap,
    "cylinder": shapes.cylinder,
    "catenoid": shapes.catenoid,
    "clothoid": shapes.clothoid,
    "three-cylinder blend": blend.cylinder_blend,
    "graded hemisphere": lambda n: graded.regraded(shapes.cap(60), n),
    "graded cylinder, length 3": lambda n: graded.regraded(shapes.cylinder(60, length=3.0), n),
}


def rows(scope: Scope) -> Iterator[Row]:
    """Goal and measured are seconds here."""
    for n_free, goal in ((800, 0.1), (5000, 0.5)):
        seconds = []
        for name, make in CASES.items():
            made = _timed(scope, name, make(n_free), goal)
            seconds.append(made.measured)
            yield made
        yield Row(f"cost, median of {n_free}", n_free, "uniform", goal, float(np.median(seconds)), "", True, np.nan)


def _timed(scope: Scope, name: str, patch: Patch | blend.Blend, goal: float) -> Row:
    start = shapes.membrane(patch.vertices, patch.triangles, patch.fixed)
    runs = [
        scope.engine.fair(start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals)
        for _ in range(3)
    ]
    least = min(outcome.cpu for outcome in runs)
    size = len(patch.vertices) - len(patch.fixed)
    return Row(f"cost, {name}", size, "uniform", goal, least, runs[0].state, runs[0].converged, least)
