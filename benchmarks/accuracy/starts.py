"""The same boundary from different interiors: given, flattened, folded, noisy. Positions must agree."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np

import blend
import shapes
from engine import FloatArray, Outcome
from exact import TIGHT, Scope
from meshing import IntArray
from report import WEIGHTS, Row
from shapes import Patch, Style


def given(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """The mesh itself."""
    return vertices


def flattened(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """Projected on the plane that fits the outline best."""
    rim = vertices[fixed]
    centre = rim.mean(axis=0)
    normal = np.linalg.svd(rim - centre)[2][2]
    return np.asarray(vertices - ((vertices - centre) @ normal)[:, None] * normal)


def folded(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """Everything on one side of a plane through the centroid reflected to the other."""
    centre = vertices.mean(axis=0)
    normal = np.linalg.svd(vertices - centre, full_matrices=False)[2][0]
    height = (vertices - centre) @ normal
    return np.asarray(vertices - 2 * np.maximum(height, 0)[:, None] * normal)


def noisy(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """Gaussian noise of two mean edge lengths."""
    return np.asarray(vertices + 2 * h * np.random.default_rng(5).standard_normal(vertices.shape))


STARTS: dict[str, Callable[[FloatArray, IntArray, float], FloatArray]] = {
    "given": given, "flattened": flattened, "folded": folded, "noisy": noisy,
}  # fmt: skip


def moved(kind: str, vertices: FloatArray, triangles: IntArray, fixed: IntArray) -> FloatArray:
    """The start of this kind, fixed vertices in their places."""
    edges = np.linalg.norm(vertices[triangles] - np.roll(vertices[triangles], 1, axis=1), axis=2)
    result = STARTS[kind](vertices, fixed, float(edges.mean())).copy()
    result[fixed] = vertices[fixed]
    return result


def rows(scope: Scope) -> Iterator[Row]:
    """Largest distance between vertices of the same number, over D, from the mesh given."""
    patches: dict[str, Callable[[int], Patch]] = {
        "hemisphere": shapes.cap,
        "cylinder, length 3": partial(shapes.cylinder, length=3.0),
        "clothoid, strongly jittered": partial(
            shapes.clothoid, style=Style(jitter=1.2, layout="grid"), shape="rectangle"
        ),
        "catenoid, random": partial(shapes.catenoid, style=Style(layout="random")),
    }
    for name, make in patches.items():
        patch = make(2000)
        for weights in WEIGHTS:
            yield _compared(scope, name, patch, patch.diameter, weights)
    made = blend.cylinder_blend(2000)
    yield _compared(scope, "three-cylinder blend", made, made.diameter, "uniform")


def _compared(scope: Scope, name: str, patch: Patch | blend.Blend, diameter: float, weights: str) -> Row:
    results: list[Outcome] = []
    for kind in STARTS:
        start = moved(kind, patch.vertices, patch.triangles, patch.fixed)
        options = {} if weights == "uniform" else {"reference": patch.vertices}
        results.append(
            scope.engine.fair(
                start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals,
                inner_fairness=weights, tolerance=TIGHT, **options,
            )
        )  # fmt: skip
    refusals = [outcome for outcome in results if outcome.refused]
    size = len(patch.vertices) - len(patch.fixed)
    case = f"four starts, {name}"
    if refusals:
        return Row(case, size, weights, 1e-6, np.nan, refusals[0].state, False, np.nan, refusals[0].refused[:90])
    away = [np.abs(outcome.vertices - results[0].vertices).max() / diameter for outcome in results]
    note = ", ".join(f"{kind} {value:.1e}" for kind, value in zip(STARTS, away, strict=True) if value > 1e-6)
    state = " / ".join(sorted({outcome.state for outcome in results}))
    settled = all(outcome.converged for outcome in results)
    return Row(case, size, weights, 1e-6, float(max(away)), state, settled, sum(o.cpu for o in results), note)
