"""Holes that one face closes: a loop of three edges, or of four, none of them longer than the edges wanted.

A mesh with edges as long as these has no vertex inside. A new one would lift the surface of a flat place by as much as
the fitted normals are off, over half an edge.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from fairing._outline import visible_join
from fairing._types import FloatArray, IntArray

_SPLIT = 4.0 / 3.0  # of the wanted length: longer edges are split, as in every new mesh


def is_single(points: FloatArray, spacing: float) -> bool:
    """Whether one face closes a loop (k, 3); spacing: the wanted length, 0 for that of the loop's own edges."""
    if len(points) > 4:
        return False
    longest = float(np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).max())
    return not spacing or longest <= _SPLIT * spacing


def face_over(loop: IntArray, points: FloatArray, normals: FloatArray, edges: set[tuple[int, int]]) -> IntArray:
    """(1, 3) or (2, 3) triangles over a loop of three or four vertices with unit normals (k, 3).

    Of two diagonals the one whose triangles face as the surroundings do, unless it is one of the mesh's edges already
    (each with its smaller end first).
    """
    if len(loop) == 3:
        return loop.reshape(1, 3).astype(np.int32)
    cuts = [loop[np.array(corners)] for corners in ([[0, 1, 2], [0, 2, 3]], [[1, 2, 3], [1, 3, 0]])]
    there = [(min(a, b), max(a, b)) in edges for a, b in (loop[[0, 2]].tolist(), loop[[1, 3]].tolist())]
    facing = [_facing(points[cut], normals.sum(axis=0)) - 10.0 * taken for cut, taken in zip(cuts, there, strict=True)]
    better: IntArray = cuts[int(facing[1] > facing[0])].astype(np.int32)
    return better


def _facing(corners: FloatArray, normal: FloatArray) -> float:
    """The least cosine between triangles (2, 3, 3) and a normal."""
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(areas, axis=1) * np.linalg.norm(normal)
    return float(((areas @ normal) / np.maximum(size, 1e-300)).min())


def edges_among(triangles: IntArray, vertices: IntArray) -> set[tuple[int, int]]:
    """The edges between some vertices, the smaller end first."""
    near = triangles[np.isin(triangles, vertices).sum(axis=1) > 1]
    sides = np.sort(np.concatenate([near[:, [0, 1]], near[:, [1, 2]], near[:, [2, 0]]]), axis=1)
    return set(map(tuple, sides.tolist()))


def angles_at(loop: IntArray, points: FloatArray, normals: FloatArray, faces: IntArray) -> FloatArray:
    """(k,) degrees between the normals (k, 3) of a loop and those of the face over it there, area by area."""
    corners = points[faces]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.stack([areas[(faces == vertex).any(axis=1)].sum(axis=0) for vertex in loop.tolist()])
    size = np.maximum(np.linalg.norm(sums, axis=1), 1e-300)
    cosine = (sums * normals).sum(axis=1) / size
    angles: FloatArray = np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))
    return angles


def fields_of(
    faces: Sequence[IntArray], angles: Sequence[FloatArray], loops: Sequence[IntArray], around: IntArray,
    points: FloatArray,
) -> dict[str, Any]:  # fmt: skip
    """The arrays of a result with these faces (see `FillResult`), without new vertices."""
    triangles = np.concatenate(faces)
    passes = np.concatenate(loops)
    fixed, place = np.unique(passes, return_inverse=True)
    angle = np.zeros(len(fixed))
    np.maximum.at(angle, place, np.concatenate(angles))
    return {
        "vertices": np.empty((0, 3)),
        "triangles": triangles,
        "mean_curvature": np.empty(0),
        "fixed": fixed.astype(np.int32),
        "boundary_angle": angle,
        "join": visible_join(points, triangles, around, fixed).degrees if len(around) else angle,
    }


def report_of(equation: str, continuity: str) -> dict[str, Any]:
    """The other fields, where nothing had to be solved."""
    return {
        "continuity": continuity, "converged": True, "polished": True, "cut": False, "termination": "converged",
        "equation": "harmonic" if equation == "automatic" else equation, "provenance": "equation", "girth": None,
        "iterations": 0, "residual": 0.0, "initial_residual": 0.0, "levels": (), "seconds": {"total": 0.0}, "way": (),
        "warnings": (),
    }  # fmt: skip
