"""The boundary of a patch: what its surroundings say about it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._types import FloatArray, IntArray


class VisibleJoin(NamedTuple):
    """How much a join shows, and where the eye finds a kink."""

    degrees: FloatArray
    """(k,) at each vertex of the outline."""
    limit: float
    """Degrees from which a kink stands out among triangles that bend as those outside do: 5 to 30."""
    seen: IntArray
    """Places in the outline where one does, ascending: there neighbours above the limit add up to five times that."""


@dataclass(frozen=True, eq=False)
class _OutlineNormals:
    """Normals along a boundary, fitted to the triangles outside it. All arrays are read-only."""

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


@dataclass(frozen=True, eq=False)
class SurroundingNormals(_OutlineNormals):
    """What :func:`surrounding_normals` gives back; unpacks as ``normals, fitted``. All arrays are read-only."""

    @property
    def trusted_curvatures(self) -> FloatArray:
        """(k,) ``curvatures``, NaN where a fit is far less certain than the others: for ``fixed_curvatures``."""
        errors = self.curvature_errors
        if not self.fitted.any():
            return self.curvatures
        largest = float(np.abs(self.curvatures[self.fitted]).max())
        usual = max(4.0 * float(np.median(errors[self.fitted])), 0.25 * largest)
        return np.where(errors <= usual, self.curvatures, np.nan)

    def __iter__(self) -> Iterator[npt.NDArray[Any]]:
        return iter((self.normals, self.fitted))


@dataclass(frozen=True, eq=False)
class MendedOutline(_OutlineNormals):
    """A noisy boundary, moved onto the fit of its surroundings. All arrays are read-only."""

    vertices: FloatArray
    """(n, 3) positions; vertices that are not in ``moved`` keep their bits."""
    moved: IntArray
    """Vertices that were moved, ascending: of the boundary and the two rings outside."""
    held: IntArray
    """Vertices that stay although the fit lies elsewhere: the move would turn triangles over."""
    noise: float
    """Median distance of the vertices near the boundary from their fits, in edges. Below 0.02 nothing is moved."""


def _bounded(
    vertices: npt.ArrayLike, triangles: tuple[str, npt.ArrayLike], places: tuple[str, npt.ArrayLike]
) -> tuple[FloatArray, IntArray, IntArray]:
    """The arguments, checked; triangles with a corner that is NaN or infinite are left out."""
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.vertices_of(*triangles, len(points), 3)
    return points, _arguments.finite_triangles(points, faces), _arguments.vertices_of(*places, len(points))


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
    edges = _arguments.vertices_of("creases", creases, len(points), 2)
    return SurroundingNormals(**_core.surrounding_normals(points, faces, where, edges))


def bad_outline(vertices: npt.ArrayLike, outside: npt.ArrayLike, outline: npt.ArrayLike) -> IntArray:
    """Vertices of ``outline`` whose surroundings say little about the surface, in the order of ``outline``.

    There the standard error of the normal that is fitted to the triangles ``outside`` is above 0.15 rad and four times
    the boundary's median, or the vertex lies off its fit by more than 0.3 edges and four times the median. One vertex
    in a fold is bad, noise everywhere is not; 15 % of the boundary at most are. Select the faces outside them, too,
    and fair again.
    """
    return _core.bad_outline(*_bounded(vertices, ("outside", outside), ("outline", outline)))


def mend_outline(vertices: npt.ArrayLike, outside: npt.ArrayLike, outline: npt.ArrayLike) -> MendedOutline:
    """Move a noisy boundary onto the surface that the triangles outside it suggest.

    The vertices of ``outline`` go onto their fits, those of the two rings outside by two thirds and one third of
    the distance, all by no more than a quarter of their edges' mean length. Nothing moves where the noise is less than
    0.02 edges. Moves that would turn a triangle over are left out (``held``). No argument is changed.
    """
    points, faces, where = _bounded(vertices, ("outside", outside), ("outline", outline))
    return MendedOutline(**_core.mend_outline(points, faces, where))


def visible_join(
    vertices: npt.ArrayLike,
    inside: npt.ArrayLike,
    outside: npt.ArrayLike,
    outline: npt.ArrayLike,
    *,
    before: npt.ArrayLike | None = None,
) -> VisibleJoin:
    """How visible the join of the two lists of triangles is at the vertices of ``outline`` (k,), each named once.

    ``degrees``: by how much the signed dihedral angles of the outline's edges exceed what is usual across their
    direction within three rings on either side (the middle half of the angles, by length and direction), and what the
    same edge had in ``before`` (n, 3), the positions before fairing; the mean over the outline's edges at the vertex. 0
    on a sphere or tube however coarse, and on a crease that goes on on either side. ``limit``: of nine tenths of the
    edges outside the range of bends, as far as it lies between 5 and ``LIMITS["visible_kink"]`` = 12, or half of it
    where that is more, up to 30. 12 without triangles outside.
    """
    points, within, where = _bounded(vertices, ("inside", inside), ("outline", outline))
    _, beyond, _ = _bounded(vertices, ("outside", outside), ("outline", outline))
    earlier = None if before is None else _arguments.floats("before", before, points.shape[0])
    return VisibleJoin(*_core.visible_join(points, within, beyond, where, earlier))
