"""The levels that method "paper" works on."""

from __future__ import annotations

import numpy.typing as npt

from fairing import _arguments, _core
from fairing._types import IntArray


def hierarchy(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    *,
    fixed: npt.ArrayLike | None = None,
    levels: int = 0,
) -> list[tuple[IntArray, IntArray]]:
    """Progressive mesh of §7.4 in levels, coarse to fine: a list of (vertex indices, triangles).

    Half-edge collapses take the shortest edges first and avoid distorted triangles; the topology is kept, and
    so are all vertices that are fixed or on the border. Sizes grow exponentially: ``levels`` of them, or as
    many as make about a factor of four each for 0. Where no collapse is acceptable any more, a level stays
    larger than that, or is missing.

    Both arrays hold indices of ``vertices``: those in use, ascending, and (m, 3) triangles of them. The last
    level is the mesh itself. Errors as in :func:`fairing.fair`.
    """
    points, faces, held = _arguments.held_mesh(vertices, triangles, fixed)
    return _core.hierarchy(points, faces, held, _arguments.whole("levels", levels, 0))
