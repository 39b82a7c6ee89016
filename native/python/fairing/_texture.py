"""Colours of a surface for a texture: short edges where they are given, harmonic values, texels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._types import FloatArray, IntArray


@dataclass(frozen=True)
class GradedMesh:
    """A finer mesh of the same surface: ``s`` triangles in the ``m`` given ones."""

    vertices: FloatArray  # (q, 3); the given ones come first
    triangles: IntArray  # (s, 3)
    parent: IntArray  # (s,) the given triangle that each lies in
    weights: FloatArray  # (s, 3, 3): of each corner, barycentric in that triangle
    chosen: npt.NDArray[np.bool_]  # (s, 3): sides that lie on those chosen


def graded_mesh(vertices: npt.ArrayLike, triangles: npt.ArrayLike, chosen: npt.ArrayLike, finest: float) -> GradedMesh:
    """Halve edges until none is longer than ``finest``, or than a quarter of its distance to the chosen sides.

    chosen: (m, 3) mask; side k of a triangle runs from corner k to the next. Where no side is chosen nothing is halved.
    """
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.triangles_within(triangles, len(points))
    sides = np.ascontiguousarray(chosen, dtype=bool)
    if sides.shape != faces.shape:
        raise ValueError(f"chosen: expected shape {faces.shape}, got {sides.shape}")
    if not (np.isfinite(finest) and finest > 0.0):
        raise ValueError(f"finest: a length above 0 is needed, not {finest}")
    if not np.isfinite(points).all():
        raise ValueError("vertices: expected finite numbers")
    found = _core.graded_mesh(points, faces, sides, float(finest))
    return GradedMesh(found[0], found[1], found[2], found[3].reshape(-1, 3, 3), found[4])


def harmonic_extension(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, known: npt.ArrayLike, values: npt.ArrayLike
) -> FloatArray:
    """(n, c) values at all vertices: those given, (k, c), at the ``known`` ones (k,), harmonic at the others.

    As :func:`fairing.interpolate`, but borders need no values: nothing flows across them then. The weights are those
    of the intrinsic Delaunay triangulation, so that on a flat surface it does not count how it is triangulated. NaN at
    vertices that hang together with no known one.
    """
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.triangles_within(triangles, len(points))
    held = _arguments.indices_within("known", _arguments.integers("known", known, None), len(points))
    given = np.ascontiguousarray(values, dtype=np.float64)
    if given.ndim != 2 or len(given) != len(held):
        raise ValueError(f"values: expected shape ({len(held)}, c), got {given.shape}")
    if not (np.isfinite(given).all() and np.isfinite(points).all()):
        raise ValueError("vertices, values: expected finite numbers")
    found: FloatArray = _core.harmonic_extension(points, faces, held, given)
    return found


def texel_owners(corners: npt.ArrayLike, width: int, height: int) -> tuple[IntArray, int]:
    """(height, width): the last triangle over each texel's centre, −1: none; and how many pairs there are.

    corners: (t, 3, 2) in texels; the first texel's centre is (½, ½). Triangles that share an edge share no texel and
    leave none out. What lies beyond the image comes in on its other side.
    """
    found: tuple[IntArray, int] = _core.texel_owners(_places(corners, width, height), width, height)
    return found


def texel_values(corners: npt.ArrayLike, values: npt.ArrayLike, width: int, height: int) -> npt.NDArray[np.float32]:
    """(height, width, c): values (t, 3, c) of triangles' corners (t, 3, 2), linear in between; NaN where none is.

    As :func:`texel_owners` says.
    """
    places = _places(corners, width, height)
    given = np.ascontiguousarray(values, dtype=np.float64)
    if given.ndim != 3 or given.shape[:2] != places.shape[:2]:
        raise ValueError(f"values: expected shape ({len(places)}, 3, c), got {given.shape}")
    return _core.texel_values(places, given, width, height)


def _places(corners: npt.ArrayLike, width: int, height: int) -> FloatArray:
    places = np.ascontiguousarray(corners, dtype=np.float64)
    if places.ndim != 3 or places.shape[1:] != (3, 2):
        raise ValueError(f"corners: expected shape (t, 3, 2), got {places.shape}")
    if width < 1 or height < 1:
        raise ValueError(f"width, height: expected at least one texel, got {width} × {height}")
    return places
