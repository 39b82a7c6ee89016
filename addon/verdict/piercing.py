"""Where a new surface passes through faces of the mesh that are no part of it. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

import fairing

from ..arrays.region import MeshArrays, nothing
from ..arrays.types import Floats, Ints


@dataclass(frozen=True)
class Sheet:
    """Triangles (m, 3) over a mesh's n vertices, in their places, and k more of their own."""

    points: Floats  # (n + k, 3) in world space
    triangles: Ints


def places(mesh: MeshArrays, matrix: Floats) -> Floats:
    """Return the mesh's (n, 3) positions in the space that the 4×4 `matrix` leads to."""
    with np.errstate(invalid="ignore", over="ignore"):
        found: Floats = mesh.positions @ matrix[:3, :3].T + matrix[:3, 3]
    return found


def pierced(mesh: MeshArrays, before: Sheet, after: Sheet) -> Ints:
    """Return the numbers of the points of those triangles that pass through unselected faces `before` did not."""
    others = near(after, mesh.triangles[~mesh.in_patch[mesh.triangle_faces]])
    now = _crossed(after, others)
    if not len(now):
        return nothing()
    new = np.setdiff1d(now, _crossed(before, others, now))
    if not len(new):
        return nothing()
    own = len(after.triangles)
    found = crossing(after, others[new], np.arange(own, own + len(new)))
    numbers: Ints = np.unique(after.triangles[found[found < own]])
    return numbers


def near(sheet: Sheet, others: Ints) -> Ints:
    """Return those of the other triangles that reach into the box around the sheet."""
    box = sheet.points[np.unique(sheet.triangles)]
    beyond = _beyond(sheet.points, box.min(axis=0), box.max(axis=0))
    a, b, c = others.T
    inside = beyond[a] & beyond[b] & beyond[c] == 0
    finite = np.isfinite(sheet.points).all(axis=1)
    chosen: Ints = others[inside if finite.all() else inside & finite[others].all(axis=1)]
    return chosen


def _beyond(points: Floats, low: Floats, high: Floats) -> NDArray[np.uint8]:
    """Return (n,) which sides of a box each point is beyond, a bit each."""
    sides = np.zeros(len(points), dtype=np.uint8)
    with np.errstate(invalid="ignore"):
        for axis in range(3):
            sides |= (points[:, axis] < low[axis]) * np.uint8(1 << axis)
            sides |= (points[:, axis] > high[axis]) * np.uint8(8 << axis)
    return sides


def crossing(sheet: Sheet, others: Ints, few: Ints | None = None) -> Ints:
    """Return which of the triangles pass through others, or through one of `few` and these themselves.

    The sheet's own are numbered first.
    """
    triangles = np.concatenate([sheet.triangles, others])
    used = np.zeros(len(sheet.points), dtype=bool)
    used[triangles] = True
    numbers = np.cumsum(used) - 1  # the points that no triangle has may be many, or not finite
    return fairing.self_intersections(sheet.points[used], numbers[triangles], near=few).astype(np.int64)


def _crossed(sheet: Sheet, others: Ints, few: Ints | None = None) -> Ints:
    """Return which of the others cross the sheet, or each other; of pairs only those with one of the few in them."""
    own = len(sheet.triangles)
    found = crossing(sheet, others, None if few is None else own + few) - own
    numbers: Ints = found[found >= 0]
    return numbers
