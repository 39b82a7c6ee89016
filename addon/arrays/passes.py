"""Boundaries that pass a vertex several times: new triangles in numbers of the passes. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .types import Ints


def numbered_by_pass(numbered: Ints, triangles: Ints, loops: Sequence[Ints]) -> Ints:
    """Return the numbered triangles (m, 3) with the right pass of the loops at each of their corners.

    numbered: with any of the passes of a vertex; triangles: the same in the numbers of the loops, which have them on
    their left.
    """
    outline = np.concatenate(loops)
    following = np.concatenate([np.roll(loop, -1) for loop in loops])
    result = numbered.copy()
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
