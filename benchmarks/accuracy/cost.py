"""CPU seconds of one call at the default tolerance, single thread, best of three."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

import blend
import shapes
from exact import Scope
from report import Row
from shapes import Patch, Style

CASES: dict[str, Callable[[int], Patch | blend.Blend]] = {
    "hemisphere": shapes.cap,
    "cylinder": shapes.cylinder,
    "catenoid": shapes.catenoid,
    "clothoid": shapes.clothoid,
    "three-cylinder blend": blend.cylinder_blend,
}


def rows(scope: Scope) -> Iterator[Row]:
    """Goal and measured are seconds here; stretched meshes may take three times as long as regular ones."""
    for n_free, goal in ((800, 0.1), (5000, 0.5)):
        for name, make in CASES.items():
            yield _timed(scope, name, make(n_free), goal)
    for n_free in (1000, 10_000):
        for exact in (shapes.cap, shapes.cylinder, shapes.catenoid):
            regular = _timed(scope, "", exact(n_free), np.inf).measured
            for stretch, grading in ((2.5, 8.0), (4.0, 30.0), (0.25, 30.0)):
                style = Style(layout="random", jitter=0.0, stretch=stretch, grading=grading)
                name = f"{exact.__name__}, stretched by {stretch:g}, graded by {grading:g}"
                yield _timed(scope, name, exact(n_free, style), 3 * regular)


def _timed(scope: Scope, name: str, patch: Patch | blend.Blend, goal: float) -> Row:
    start = shapes.membrane(patch.vertices, patch.triangles, patch.fixed)
    runs = [
        scope.engine.fair(start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals)
        for _ in range(3)
    ]
    least = min(outcome.cpu for outcome in runs)
    size = len(patch.vertices) - len(patch.fixed)
    return Row(f"cost, {name}", size, "uniform", goal, least, runs[0].state, runs[0].converged, least)
