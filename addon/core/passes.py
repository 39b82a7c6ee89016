"""Boundaries that pass a vertex several times: new triangles in numbers of the passes. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .arrays import Ints


def numbered_by_pass(triangles: Ints, loops: Sequence[Ints], count: int) -> Ints:
    """Return triangles (m, 3) with the passes of the loops as their first numbers, then their new vertices.

    triangles: of `count` old vertices and then new ones; loops: of old ones, the triangles on their left.
    """
    outline = np.concatenate(loops)
    following = np.concatenate([np.roll(loop, -1) for loop in loops])
    number = np.full(count, -1, dtype=np.int64)
    number[outline] = np.arange(len(outline))
    is_old = triangles < count
    result = np.where(is_old, number[np.where(is_old, triangles, 0)], triangles - count + len(outline))
    names, passes = np.unique(outline, return_counts=True)
    for vertex in names[passes > 1].tolist():
        corners = np.argwhere(triangles == vertex).tolist()
        spokes = {int(triangles[t, (k + 1) % 3]): (t, k, int(triangles[t, (k + 2) % 3])) for t, k in corners}
        for place in np.flatnonzero(outline == vertex).tolist():
            spoke = int(following[place])
            while spoke in spokes:  # counter-clockwise from the edge along which the pass leaves
                t, k, spoke = spokes.pop(spoke)
                result[t, k] = place
    return result
