"""Triangles paired into quads."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._new_mesh import PairedQuads
from fairing._types import IntArray


def paired_quads(vertices: npt.ArrayLike, triangles: npt.ArrayLike, kept: npt.ArrayLike | None = None) -> PairedQuads:
    """Pair the triangles (m, 3) of a mesh (n, 3) into quads: those of best shape first, then as many as possible.

    A quad is convex: no angle is above 165°. It is bent by less than 40° along the edge that went. Vertices stay where
    they are, and so does each edge that ``kept``, (e, 2), names in either order, and the border. A triangle is used
    once. Raises ValueError for arrays of other shapes, coordinates that aren't finite, a triangle that names a vertex
    twice, or a kept edge that the triangles don't have, and MeshError INDEX_RANGE for an index that is no vertex.
    """
    points, faces = _arguments.mesh(vertices, triangles)
    _check(points, faces)
    quads, pairs, rest = _core.paired_quads(points, faces, _arguments.edges_of("kept", kept, faces))
    return PairedQuads(quads, faces[rest], pairs, rest)


def _check(points: npt.NDArray[np.float64], faces: IntArray) -> None:
    used = np.unique(faces)
    bad = used[~np.isfinite(points[used]).all(axis=1)]
    if len(bad):
        raise ValueError(f"vertices: the coordinates of vertex {bad[0]} are not finite")
    twice = np.flatnonzero((faces == np.roll(faces, 1, axis=1)).any(axis=1))
    if len(twice):
        raise ValueError(f"triangles: row {twice[0]} names a vertex twice: {faces[twice[0]].tolist()}")
