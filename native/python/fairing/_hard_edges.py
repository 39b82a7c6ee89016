"""The edges at which a surface is broken."""

from __future__ import annotations

import numpy.typing as npt

from fairing import _arguments, _core
from fairing._types import IntArray


def hard_edges(vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, marked: npt.ArrayLike | None = None) -> IntArray:
    """(h, 2) edges at which the surface is broken, the smaller index first, ascending.

    An edge is hard where its dihedral angle is 35° and more above how the mesh bends across its direction, within
    three rings. A box's edges and a cylinder's rim are hard. A coarse sphere, a tube of five sides and more, and noise
    that bends to both sides have no hard edges. A crease that runs between two rows of triangles makes both rows hard.
    Hard edges run on where they fade, by half of that angle, and fewer than four in a row count where they end at the
    border or at corners alone.

    ``marked``: (m, 2) edges that are hard whatever they bend; pairs that are no edges of the triangles are left out, as
    are triangles with a corner that is NaN or infinite.
    """
    points, faces = _arguments.mesh(vertices, triangles)
    pairs = _arguments.vertices_of("marked", marked, len(points), 2)
    return _core.hard_edges(points, _arguments.finite_triangles(points, faces), pairs)
