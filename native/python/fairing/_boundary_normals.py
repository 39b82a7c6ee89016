"""Normals along the boundary of a patch: from the faces outside, but not along walls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._mending import Surroundings
from fairing._outline import SurroundingNormals, surrounding_normals

SIDES = ("automatic", "outside", "inside")


@dataclass(frozen=True, eq=False)
class BoundaryNormals(SurroundingNormals):
    """What :func:`boundary_normals` gives back; unpacks as ``normals, fitted``. All arrays are read-only."""

    from_inside: npt.NDArray[np.bool_]
    """(k,) whether the slope is not that of the triangles outside."""


def boundary_normals(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    fixed: npt.ArrayLike,
    *,
    outside: npt.ArrayLike | None = None,
    side: str = "automatic",
    creases: npt.ArrayLike | None = None,
) -> BoundaryNormals:
    """Normals at the vertices ``fixed`` (k,) of a patch, for ``fixed_normals``, in their order.

    ``vertices``, ``triangles``, ``fixed``, ``outside``: as for :func:`fairing.fair`.

    ``side``: "outside" takes the slope of the triangles outside, as :func:`fairing.surrounding_normals` does. "inside"
    takes that of the patch's own triangles beside the boundary, for the top of a box that is to stay flat. "automatic"
    looks for walls, beside which the surface does not go on: sides of boxes and cans, bevels. There the slope is that
    of the patch's own triangles where these are clean, else that of a film over the boundary. The outside counts
    everywhere else, and at a vertex between edges of both kinds.

    ``creases``: (c, 2) edges that are hard whatever they bend. Fits use one side of hard edges alone.
    """
    points, faces = _arguments.mesh(vertices, triangles)
    where = _arguments.vertices_of("fixed", fixed, len(points))
    rule = _arguments.choice("side", side, SIDES)
    around = Surroundings.of(points, faces, where, outside)
    if rule == "outside":
        found = surrounding_normals(points, around.outside, where, creases=creases)
        return BoundaryNormals(**vars(found), from_inside=_none(len(where)))
    edges = _arguments.vertices_of("creases", creases, len(points), 2)
    inside = _arguments.finite_triangles(points, around.inside)
    return BoundaryNormals(**_core.boundary_normals(points, inside, around.outside, where, edges, rule == "inside"))


def _none(count: int) -> npt.NDArray[np.bool_]:
    marks = np.zeros(count, dtype=bool)
    marks.flags.writeable = False
    return marks
