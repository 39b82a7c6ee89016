"""The loops around holes, and what is known about them before they are filled."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.measure import boundary_loops
from fairing.options import arguments
from fairing.results import FloatArray, IntArray

__all__ = ["HoleLoops", "expected_vertices", "hole_loops", "outer_borders"]


@dataclass(frozen=True, eq=False)
class HoleLoops:
    """All borders of a mesh."""

    loops: tuple[IntArray, ...]
    """Closed, each with the hole on its left, starting at its smallest vertex; ordered by that vertex."""
    torn: tuple[IntArray, ...]
    """Chains of border vertices that close to no loop: triangles are wound against each other at one of their ends."""


def hole_loops(vertices: npt.ArrayLike, triangles: npt.ArrayLike, border: npt.ArrayLike | None = None) -> HoleLoops:
    """The loops that :func:`fairing.fill` fills by default, and what is no loop.

    Edges with one triangle make loops, whatever the rest of the mesh is like. Where a border touches itself or another
    one in a vertex, loops are parted so that surfaces over all of them leave a manifold: two holes that meet in a
    corner are two loops; a face that hangs into a hole by a corner makes the loop pass that vertex twice.

    ``border``: (e, 2) the edges with one triangle, where they are known, each in the direction that has the hole on its
    left. Then of the triangles those at pinches are enough.
    """
    points, faces = arguments.mesh(vertices, triangles)
    edges = None if border is None else arguments.vertices_of("border", border, len(points), 2)
    loops, torn = _core.hole_loops(points, faces, edges)
    return HoleLoops(tuple(loops), tuple(torn))


def outer_borders(vertices: npt.ArrayLike, triangles: npt.ArrayLike, loops: Any = None) -> npt.NDArray[np.bool_]:
    """(l,) whether each border loop goes around the outside of a sheet; the others are holes.

    ``loops``: of border vertices, in either direction; default: all of :func:`fairing.boundary_loops`. A loop is an
    outer border where a ball that continues the surroundings would be over 20 times as large as the flat disc: where
    the geodesic curvature along the loop, seen from the mesh, adds up to more than 0.9 · 2π (2π around any sheet, 0 at
    the end of a tube, −2π around a hole in a plane). :func:`fairing.fill` without ``loops`` leaves outer borders open.
    """
    points, faces = arguments.mesh(vertices, triangles)
    return np.array(_core.outer_borders(points, faces, _named(loops, points, faces)), dtype=bool)


def expected_vertices(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, loops: Any = None, *, bridge: bool = False, spacing: float = 0.0
) -> float:
    """About how many new vertices :func:`fairing.fill` makes of such loops, by their areas, turnings and edges alone.

    Within some per cent over parts of planes, tubes and balls with even edges, within a factor of two or so over
    others; takes milliseconds. An outer border gives a number beyond all measure. ``loops``: as for
    :func:`fairing.borders.outer_borders`.
    """
    points, faces = arguments.mesh(vertices, triangles)
    return _core.expected_fill(points, faces, _named(loops, points, faces), bridge, spacing)


def given_loops(loops: Any, count: int) -> list[IntArray]:
    """The caller's loops, of vertices below ``count``."""
    if isinstance(loops, np.ndarray) and loops.ndim == 1 and loops.dtype != object:
        loops = [loops]
    if not isinstance(loops, (Sequence, np.ndarray)) or isinstance(loops, str) or not len(loops):
        raise ValueError("loops: a list of vertex indices for each loop is needed")
    if all(isinstance(entry, (int, np.integer)) for entry in loops):
        loops = [loops]
    return [arguments.vertices_of("loops", loop, count) for loop in loops]


def _named(loops: Any, points: FloatArray, triangles: IntArray) -> list[IntArray]:
    found = boundary_loops(triangles) if loops is None else loops
    return given_loops(found, len(points)) if len(found) else []
