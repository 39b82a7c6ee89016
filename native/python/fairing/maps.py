"""What is carried over to another mesh: values, flat maps, pairs of triangles."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments
from fairing.results import FloatArray, PairedQuads

__all__ = ["conformal_map", "interpolate", "paired_quads"]


def interpolate(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, fixed: npt.ArrayLike, values: npt.ArrayLike
) -> FloatArray:
    """(n, c) values at all vertices: those given, (k, c), at the ``fixed`` ones (k,), harmonic at the others.

    That is as heat would spread: no value leaves the range of its column. Cotangent weights, none below a thousandth.
    ``fixed`` must have all border vertices that triangles use. Zero at vertices that hang together with no fixed one.
    Errors as in :func:`fairing.fair`.
    """
    points, faces, held = arguments.held_mesh(vertices, triangles, fixed)
    given = arguments.numbers("values", values, (0 if held is None else len(held), -1))
    border = [np.empty(0, dtype=np.int32), *_core.boundary_loops(faces)]
    missing = np.setdiff1d(np.concatenate(border), np.empty(0) if held is None else held)
    if len(missing):
        raise ValueError(f"fixed: border vertex {missing[0]} needs a value")
    if held is None or not given.shape[1]:
        return np.zeros((len(points), given.shape[1]))
    everywhere: FloatArray = _core.interpolate(points, faces, held, given).copy()
    everywhere[held] = given
    return np.clip(everywhere, given.min(axis=0), given.max(axis=0))


def conformal_map(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, fixed: npt.ArrayLike, places: npt.ArrayLike
) -> FloatArray:
    """(n, 2) places in the plane: those given, (k, 2), at the ``fixed`` vertices (k,); the others keep angles.

    The least squares conformal map (Lévy et al. 2002), whose borders are free where they are not fixed. Triangles are
    counter-clockwise in it, as far as the places given allow. Zero at vertices without a triangle. SolverError where a
    piece of the mesh has less than two fixed vertices, or no area. Other errors as in :func:`fairing.fair`.
    """
    points, faces = arguments.mesh(vertices, triangles)
    held = arguments.vertices_of("fixed", fixed, len(points))
    given = arguments.numbers("places", places, (len(held), 2))
    if len(np.unique(held)) < len(held):
        raise ValueError("fixed: a vertex is named twice")
    used = np.unique(faces)
    number = np.full(len(points), -1, dtype=np.int32)
    number[used] = np.arange(len(used), dtype=np.int32)
    inside = number[held] >= 0
    flat = np.zeros((len(points), 2))
    flat[used] = _core.conformal_map(points[used], number[faces], number[held][inside], given[inside])
    flat[held] = given
    return flat


def paired_quads(vertices: npt.ArrayLike, triangles: npt.ArrayLike, kept: npt.ArrayLike | None = None) -> PairedQuads:
    """Pair the triangles (m, 3) of a mesh (n, 3) into quads: those of best shape first, then as many as possible.

    A quad is convex: no angle is above 165°. It is bent by less than 40° along the edge that went. Vertices stay where
    they are, and so does each edge that ``kept``, (e, 2), names in either order, and the border. A triangle is used
    once. Raises ValueError for arrays of other shapes, a triangle that names a vertex twice, or a kept edge that the
    triangles don't have, and MeshError INDEX_RANGE or NONFINITE.
    """
    points, faces = arguments.finite_mesh(vertices, triangles)
    twice = np.flatnonzero((faces == np.roll(faces, 1, axis=1)).any(axis=1))
    if len(twice):
        raise ValueError(f"triangles: row {twice[0]} names a vertex twice: {faces[twice[0]].tolist()}")
    quads, pairs, rest = _core.paired_quads(points, faces, arguments.edges_of("kept", kept, faces))
    return PairedQuads(quads, faces[rest], pairs, rest)
