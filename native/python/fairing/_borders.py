"""What is known about border loops before they are filled."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _holes, _loops
from fairing._measure import boundary_loops
from fairing._outline import surrounding_normals
from fairing._types import FloatArray


def outer_borders(vertices: npt.ArrayLike, triangles: npt.ArrayLike, loops: Any = None) -> npt.NDArray[np.bool_]:
    """(l,) whether each border loop goes around the outside of a sheet; the others are holes.

    ``loops``: of border vertices, in either direction; default: all of :func:`fairing.boundary_loops`. A loop is an
    outer border where a ball that continues the surroundings would be over 20 times as large as the flat disc: where
    the geodesic curvature along the loop, seen from the mesh, adds up to more than 0.9 · 2π (2π around any sheet, 0 at
    the end of a tube, −2π around a hole in a plane). :func:`fairing.fill` without ``loops`` leaves outer borders open.
    """
    found = _outlines(vertices, triangles, loops)
    return np.array([_holes.is_outer(points, normals) for points, normals in found], dtype=bool)


def expected_vertices(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, loops: Any = None, *, bridge: bool = False, spacing: float = 0.0
) -> float:
    """About how many new vertices :func:`fairing.fill` makes of such loops, by their areas, turnings and edges alone.

    Within some per cent over parts of planes, tubes and balls with even edges, within a factor of two or so over
    others; takes milliseconds. An outer border gives a number beyond all measure. ``loops``: as for
    :func:`fairing.outer_borders`.
    """
    found = _outlines(vertices, triangles, loops)
    loop_points = [points for points, _ in found]
    if bridge and len(found) > 1:
        return _holes.flat_count(loop_points, spacing, True)
    return sum(
        _holes.times_flat(points, normals) * _holes.flat_count([points], spacing, False) for points, normals in found
    )


def _outlines(vertices: npt.ArrayLike, triangles: npt.ArrayLike, loops: Any) -> list[tuple[FloatArray, FloatArray]]:
    """Points and normals of each loop, the mesh on its right."""
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.triangles_within(triangles, len(points))
    named = boundary_loops(faces) if loops is None else loops
    if not len(named):
        return []
    outline = _loops.given_loops(named, points, faces)
    normals = surrounding_normals(points, faces, outline.vertices).normals
    return [(points[loop], part) for loop, part in zip(outline.loops, outline.split(normals), strict=True)]
