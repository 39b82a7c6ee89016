"""Where new faces lie over other faces in the texture. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from ..arrays.types import Floats, Ints, Mask

MOST_CELLS = 256  # along each side of the grid in which triangles are looked up
INSIDE = 1e-3  # of a triangle: what lies nearer to its edges counts as beside it


def covering(new: Floats, others: Floats) -> Mask:
    """Return the (m,) mask of new triangles that lie over others or over each other; all (·, 3, 2).

    Judged by the triangles' middles: what overlaps by less than a third of a triangle may be missed.
    """
    found = np.zeros(len(new), dtype=bool)
    points, triangles = _hits(new.mean(axis=1), np.concatenate([others, new]))
    found[points[triangles != len(others) + points]] = True
    points, triangles = _hits(others.mean(axis=1), new)
    found[triangles] = True
    return found


def _hits(points: Floats, triangles: Floats) -> tuple[Ints, Ints]:
    """Return the points (p, 2) that lie inside triangles (t, 3, 2), and these: (h,) numbers each."""
    points_at, triangles_at = _in_one_cell(points, triangles)
    corners = triangles[triangles_at]
    to = corners - points[points_at][:, None]
    ahead = np.roll(to, -1, axis=1)
    parts = to[:, :, 0] * ahead[:, :, 1] - to[:, :, 1] * ahead[:, :, 0]
    whole = parts.sum(axis=1)
    inside = (parts * np.sign(whole)[:, None] > INSIDE * np.abs(whole)[:, None]).all(axis=1)
    return points_at[inside], triangles_at[inside]


def _in_one_cell(points: Floats, triangles: Floats) -> tuple[Ints, Ints]:
    """Return pairs of points and triangles that share a cell of a grid: (h,) numbers each."""
    usable = np.flatnonzero(np.isfinite(points).all(axis=1))
    if not len(usable):
        return usable, usable
    low, high = points[usable].min(axis=0), points[usable].max(axis=0)
    least, most = triangles.min(axis=1), triangles.max(axis=1)
    whole = np.isfinite(triangles).all(axis=(1, 2))
    near = np.flatnonzero(whole & ((least <= high) & (most >= low)).all(axis=1))
    cells = int(np.clip(np.sqrt(len(near)), 1, MOST_CELLS))
    size = np.maximum((high - low) / cells, np.finfo(float).tiny)

    def cell(places: Floats) -> Ints:
        found: Ints = np.clip((places - low) / size, 0, cells - 1).astype(np.int64)
        return found

    first = cell(least[near])
    span = cell(most[near]) - first + 1
    count = span.prod(axis=1)
    of = np.repeat(np.arange(len(near)), count)
    place = _counted_up(count)
    keys = (first[of, 0] + place // span[of, 1]) * cells + first[of, 1] + place % span[of, 1]
    order = np.argsort(keys, kind="stable")
    wanted = cell(points[usable]) @ [cells, 1]
    begin, end = (np.searchsorted(keys[order], wanted, side=side) for side in ("left", "right"))
    of_point = np.repeat(np.arange(len(usable)), end - begin)
    return usable[of_point], near[of[order[begin[of_point] + _counted_up(end - begin)]]]


def _counted_up(count: Ints) -> Ints:
    """Return 0 … c − 1 for each of the counts, one after the other."""
    numbers: Ints = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
    return numbers


def meeting(places: Floats, starts: Ints, box: Floats) -> Mask:
    """Return the (f,) mask of faces whose boxes meet this one: (2, 2), its lowest and its highest corner.

    places: (c, 2) of the faces' corners, face by face; starts: (f,) of each face's first, ascending. Faces with places
    that are no numbers meet nothing.
    """
    if not len(starts):
        return np.zeros(0, dtype=bool)
    low, high = box
    least, most = (ends.reduceat(places, starts, axis=0) for ends in (np.minimum, np.maximum))
    found: Mask = ((least <= high) & (most >= low)).all(axis=1)
    return found
