"""Which triangles are near some vertices of a mesh, at the cost of these alone. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

from .around import RINGS
from .types import Floats, Ints


class Neighbourhood:
    """The triangles (t, 3) of a mesh whose corners are all finite, by the vertices that they have."""

    def __init__(self, positions: Floats, triangles: Ints) -> None:
        finite = np.isfinite(positions).all(axis=1)
        self._triangles = triangles if finite.all() else triangles[finite[triangles].all(axis=1)]
        corners = self._triangles.ravel()
        self._order = np.argsort(corners, kind="stable")
        counts = np.bincount(corners, minlength=len(positions))
        self._ends = np.cumsum(counts)
        self._begins = self._ends - counts

    def around(self, vertices: Ints, rings: int = RINGS) -> Ints:
        """Return the (o, 3) triangles within so many steps of the vertices, in the order of the mesh."""
        rows = self._at(vertices)
        for _ in range(rings - 1):
            rows = self._at(np.unique(self._triangles[rows]))
        found: Ints = self._triangles[rows]
        return found

    def _at(self, vertices: Ints) -> Ints:
        """Return the numbers of the triangles with one of these vertices, ascending."""
        begins, counts = self._begins[vertices], (self._ends - self._begins)[vertices]
        shifts = np.repeat(begins - np.cumsum(counts) + counts, counts)
        rows: Ints = np.unique(self._order[shifts + np.arange(len(shifts))] // 3)
        return rows
