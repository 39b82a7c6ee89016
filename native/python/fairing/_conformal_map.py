"""Flat maps, for textures."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._types import FloatArray


def conformal_map(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, fixed: npt.ArrayLike, places: npt.ArrayLike
) -> FloatArray:
    """(n, 2) places in the plane: those given, (k, 2), at the ``fixed`` vertices (k,); the others keep angles.

    The least squares conformal map (Lévy et al. 2002), whose borders are free where they are not fixed. Triangles are
    counter-clockwise in it, as far as the places given allow. Zero at vertices without a triangle. SolverError where a
    piece of the mesh has less than two fixed vertices, or no area. Other errors as in :func:`fairing.fair`.
    """
    points, faces = _arguments.mesh(vertices, triangles)
    held = _arguments.vertices_of("fixed", fixed, len(points))
    given = np.ascontiguousarray(places, dtype=np.float64)
    if given.shape != (len(held), 2):
        raise ValueError(f"places: expected shape ({len(held)}, 2), got {given.shape}")
    if not np.isfinite(given).all():
        raise ValueError("places: expected finite numbers")
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
