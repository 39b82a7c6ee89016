"""The boundary of a patch: what its surroundings say about it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments
from fairing.options.checks import where_met
from fairing.results import FloatArray, IntArray, read_only
from fairing.solving.surroundings import Boundary, Surroundings


@dataclass(frozen=True, eq=False)
class SurroundingNormals:
    """What :func:`surrounding_normals` gives back. All arrays are read-only."""

    normals: FloatArray
    """(k, 3) unit normals; rows of zeros where no triangle is adjacent."""
    fitted: npt.NDArray[np.bool_]
    """(k,) False where there were too few points: the normal is the average of the adjacent triangles' then."""
    errors: FloatArray
    """(k,) standard error of each fit's normal, radians; infinite where ``fitted`` is False."""
    curvatures: FloatArray
    """(k,) mean curvature H of the surroundings, length⁻¹: −1/R on a sphere with outward normals; NaN where ``fitted``
    is False."""
    curvature_errors: FloatArray
    """(k,) their standard errors; infinite where ``fitted`` is False."""

    @property
    def trusted_curvatures(self) -> FloatArray:
        """(k,) ``curvatures``, NaN where a fit is far less certain than the others: for ``fixed_curvatures``."""
        errors = self.curvature_errors
        if not self.fitted.any():
            return self.curvatures
        largest = float(np.abs(self.curvatures[self.fitted]).max())
        usual = max(4.0 * float(np.median(errors[self.fitted])), 0.25 * largest)
        return np.where(errors <= usual, self.curvatures, np.nan)


def _bounded(
    vertices: npt.ArrayLike, triangles: tuple[str, npt.ArrayLike], places: tuple[str, npt.ArrayLike]
) -> tuple[FloatArray, IntArray, IntArray]:
    """The arguments, checked; triangles with a corner that is NaN or infinite are left out."""
    points = arguments.floats("vertices", vertices)
    faces = arguments.vertices_of(*triangles, len(points), 3)
    return points, arguments.finite_triangles(points, faces), arguments.vertices_of(*places, len(points))


def surrounding_normals(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, at: npt.ArrayLike, *, creases: npt.ArrayLike | None = None
) -> SurroundingNormals:
    """Normals at the vertices ``at`` of the surface that ``triangles`` alone form.

    For the boundary of a patch: ``triangles`` are those outside it. A polynomial is fitted to the nearest of their
    vertices, a few rings wide; a filter reconciles the fits along the boundary. Rows of vertices without any of these
    triangles are zero, as along a border of the whole mesh: leave them out of ``fixed`` and
    ``fixed_normals``, where a normal of length zero is refused. Triangles with a corner that is NaN or infinite are
    left out.

    A fit uses its own side of hard edges alone (:func:`fairing.hard_edges`); ``creases``: (c, 2) edges that are hard
    whatever they bend. One row of triangles beside a hard edge is enough where it is flat; where it bends, ``errors``
    include that nothing shows how the surface bends across the row. A vertex in which hard edges part the
    surface takes the side on which the boundary's edges lie. Where they lie on several it takes all of them: such
    vertices belong to ``creases`` of :func:`fairing.fair`.
    """
    points, faces, where = _bounded(vertices, ("triangles", triangles), ("at", at))
    edges = arguments.vertices_of("creases", creases, len(points), 2)
    return SurroundingNormals(**_core.surrounding_normals(points, faces, where, edges))


def bad_outline(vertices: npt.ArrayLike, outside: npt.ArrayLike, outline: npt.ArrayLike) -> IntArray:
    """Vertices of ``outline`` whose surroundings say little about the surface, in the order of ``outline``.

    There the standard error of the normal that is fitted to the triangles ``outside`` is above 0.15 rad and four times
    the boundary's median, or the vertex lies off its fit by more than 0.3 edges and four times the median. One vertex
    in a fold is bad, noise everywhere is not; 15 % of the boundary at most are. Select the faces outside them, too,
    and fair again.
    """
    return _core.bad_outline(*_bounded(vertices, ("outside", outside), ("outline", outline)))


SIDES = ("automatic", "outside", "inside")


@dataclass(frozen=True, eq=False)
class BoundaryNormals(SurroundingNormals):
    """What :func:`boundary_normals` gives back. All arrays are read-only."""

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
    points, faces = arguments.mesh(vertices, triangles)
    where = arguments.vertices_of("fixed", fixed, len(points))
    rule = arguments.choice("side", side, SIDES)
    around = Surroundings.of(points, faces, where, outside)
    if rule == "outside":
        found = surrounding_normals(points, around.outside, where, creases=creases)
        return BoundaryNormals(**vars(found), from_inside=read_only(np.zeros(len(where), dtype=bool)))
    edges = arguments.vertices_of("creases", creases, len(points), 2)
    inside = arguments.finite_triangles(points, around.inside)
    return BoundaryNormals(**_core.boundary_normals(points, inside, around.outside, where, edges, rule == "inside"))


def with_curvatures(boundary: Boundary, around: Surroundings, given: Any, kinds: Any = None) -> Boundary:
    """The boundary with H at ``fixed``, as given, or fitted to the triangles outside, NaN where it is not known.

    kinds: the words of the continuity at ``fixed`` (k,), where they differ.
    """
    if given is not None:
        return replace(boundary, curvatures=where_met(arguments.curvatures(given, boundary.fixed), kinds))
    if not len(around.rim):
        raise ValueError(
            "continuity: 'G2' needs the curvature at the outline: pass fixed_curvatures, or the triangles outside as "
            "`outside` or among the triangles with all their vertices in `fixed`"
        )
    fixed = around.rim if boundary.fixed is None else boundary.fixed
    fits = boundary_normals(boundary.vertices, around.inside, fixed, outside=around.outside)
    curvatures = fits.trusted_curvatures
    if boundary.normals is not None:
        given = boundary.normals  # of any length
        beyond = surrounding_normals(boundary.vertices, around.outside, fixed)
        nearer = np.abs((beyond.normals * given).sum(axis=1)) > np.abs((fits.normals * given).sum(axis=1))
        chosen = nearer & fits.from_inside  # somebody prefers the slope outside
        curvatures = np.where(chosen, beyond.trusted_curvatures, curvatures)
        normals = np.where(chosen[:, None], beyond.normals, fits.normals)
        against = (normals * given).sum(axis=1) < 0
        curvatures = np.where(against, -curvatures, curvatures)  # H on the side of the normals
    return replace(boundary, fixed=fixed, curvatures=where_met(curvatures, kinds))
