"""Where a new surface passes through faces of the mesh that are no part of it. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

import fairing

from .arrays import Floats, Ints
from .engine import Problem
from .region import MeshArrays, nothing


def pierced(mesh: MeshArrays, matrix: Floats, problem: Problem, after: Floats) -> Ints:
    """Return the mesh vertices of the patch's triangles that pass through unselected faces, and did not before.

    after: (q, 3) new positions of problem.vertices, in the space that the 4×4 `matrix` leads to.
    """
    with np.errstate(invalid="ignore", over="ignore"):
        before = mesh.positions @ matrix[:3, :3].T + matrix[:3, 3]
    moved = before.copy()
    moved[problem.vertices] = after
    own = problem.patch.vertices[problem.patch.triangles]
    others = _near(moved, own, mesh.triangles[~mesh.in_patch[mesh.triangle_faces]])
    found = _crossing(moved, own, others)
    if not (found >= len(own)).any():
        return nothing()
    new = np.setdiff1d(found, _crossing(before, own, others))
    if not (new >= len(own)).any():
        return nothing()
    inside = own[new[new < len(own)]]
    vertices: Ints = np.unique(inside if len(inside) else own[found[found < len(own)]])
    return vertices


def _near(points: Floats, own: Ints, others: Ints) -> Ints:
    """Return those of the other triangles that reach into the box around one's own."""
    box = points[np.unique(own)]
    beyond = _beyond(points, box.min(axis=0), box.max(axis=0))
    a, b, c = others.T
    near = beyond[a] & beyond[b] & beyond[c] == 0
    finite = np.isfinite(points).all(axis=1)
    chosen: Ints = others[near if finite.all() else near & finite[others].all(axis=1)]
    return chosen


def _beyond(points: Floats, low: Floats, high: Floats) -> NDArray[np.uint8]:
    """Return (n,) which sides of a box each point is beyond, a bit each."""
    sides = np.zeros(len(points), dtype=np.uint8)
    with np.errstate(invalid="ignore"):
        for axis in range(3):
            sides |= (points[:, axis] < low[axis]) * np.uint8(1 << axis)
            sides |= (points[:, axis] > high[axis]) * np.uint8(8 << axis)
    return sides


def _crossing(points: Floats, own: Ints, others: Ints) -> Ints:
    """Return which triangles pass through others: one's own are numbered first."""
    used, numbers = np.unique(np.concatenate([own, others]), return_inverse=True)
    return fairing.self_intersections(points[used], numbers.reshape(-1, 3)).astype(np.int64)
