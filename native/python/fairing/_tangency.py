"""Where a surface does not continue its surroundings although it is the equation's."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing._loops import Outline
from fairing._types import Diagnostic, FairResult, FloatArray, IntArray

_OPPOSITE = -0.5  # cosine between the normals of two sides of a wall
_TOLD_ELSEWHERE = ("loft", "smoothed", "bilaplacian")  # by NO_SOLUTION, with their kinks


def not_tangent(
    report: FairResult, outline: Outline, vertices: FloatArray, triangles: IntArray
) -> tuple[Diagnostic, ...]:
    """Warnings with the boundary's vertices where the surface turns back, or where a thin wall asks for finer edges.

    ``vertices``, ``triangles``: of the mesh around.
    """
    if not report.converged or report.equation in _TOLD_ELSEWHERE:
        return ()
    back = report.join > _core.LIMITS["turned_back"]
    off = (report.boundary_angle > _core.LIMITS["off_slope"]) & ~back
    off[off] = _at_thin_walls(report.fixed[off], outline, vertices, triangles)
    refine = "the wall is thinner there than the boundary's edges are long: refine these and what is around"
    cases = (
        (back, report.join, "folded_back", "turns back", "triangles around are folded over there: unfold them"),
        (off, report.boundary_angle, "coarse", "leaves its surroundings", refine),
    )
    found = []
    for bad, angle, figure, what, advice in cases:
        if bad.any():
            degrees, count = float(angle[bad].max()), float(bad.sum())
            text = f"the surface {what} by up to {degrees:.0f}° at {count:.0f} vertices of the boundary; {advice}"
            figures = {"vertices": count, "degrees": degrees, figure: 1.0}
            found.append(Diagnostic("NOT_TANGENT", text, report.fixed[bad], "vertex", figures))
    return tuple(found)


def _at_thin_walls(
    chosen: IntArray, outline: Outline, vertices: FloatArray, triangles: IntArray
) -> npt.NDArray[np.bool_]:
    """Which of these vertices of the boundary have the other side of a wall nearer than their edges there are long."""
    reach = np.zeros(len(vertices))
    for loop in outline.loops:
        lengths = np.linalg.norm(vertices[np.roll(loop, -1)] - vertices[loop], axis=1)
        reach[loop] = np.maximum(lengths, np.roll(lengths, 1))
    normals = _core.vertex_normals(vertices, triangles, "averaged")
    return np.array([_faces_another(v, vertices, normals, reach[v]) for v in chosen.tolist()], dtype=bool)


def _faces_another(vertex: int, vertices: FloatArray, normals: FloatArray, reach: float) -> bool:
    near = np.flatnonzero((np.abs(vertices - vertices[vertex]) < reach).all(axis=1))
    near = near[np.linalg.norm(vertices[near] - vertices[vertex], axis=1) < reach]
    return bool((normals[near] @ normals[vertex] < _OPPOSITE).any())
