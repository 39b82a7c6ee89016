"""The triangles around a patch: what they say about its boundary, and a noisy one that is moved onto their fit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments
from fairing.options.checks import where_met
from fairing.results import FOLDS, Diagnostic, FloatArray, IntArray, read_only

Answer = dict[str, Any]


@dataclass(frozen=True)
class Boundary:
    """What a solve is given: vertices (n, 3), ``fixed`` (k,), its normals (k, 3) and curvatures (k,).

    None where left out.
    """

    vertices: FloatArray
    fixed: IntArray | None
    normals: FloatArray | None
    curvatures: FloatArray | None = None


@dataclass(frozen=True)
class Surroundings:
    """Triangles between free vertices, and those around them that stay."""

    inside: IntArray
    outside: IntArray
    rim: IntArray
    """Vertices of both, ascending."""

    @classmethod
    def of(cls, vertices: FloatArray, triangles: IntArray, fixed: IntArray | None, given: Any) -> Surroundings:
        """Outside are the triangles ``given``; without these those of the patch's whose corners are all fixed.

        None are where that leaves most fixed vertices without any: single triangles at the boundary's corners.
        """
        if given is not None:
            return cls.between(vertices, triangles, arguments.vertices_of("outside", given, len(vertices), 3))
        held = marked(np.empty(0, np.int32) if fixed is None else fixed, vertices.shape[0])  # the engine names others
        corners = held[triangles]
        idle = corners[:, 0] & corners[:, 1] & corners[:, 2]
        around = cls.between(vertices, triangles[~idle], triangles[idle]) if idle.any() else None
        if around is None or 2 * len(around.rim) < (held & marked(around.inside, len(held))).sum():
            return cls(triangles, triangles[:0], np.empty(0, np.int32))
        return around

    @classmethod
    def between(cls, vertices: FloatArray, inside: IntArray, outside: IntArray) -> Surroundings:
        """Without triangles outside that have a corner which is not finite."""
        finite = arguments.finite_triangles(vertices, outside)
        rim = marked(inside, len(vertices)) & marked(finite, len(vertices))
        return cls(inside, finite, np.flatnonzero(rim).astype(np.int32))


def marked(vertices: npt.NDArray[Any], count: int) -> npt.NDArray[np.bool_]:
    """Marks (count,) of those of the vertices that exist."""
    marks = np.zeros(count, dtype=bool)
    if vertices.size and (vertices.min() < 0 or vertices.max() >= count):
        vertices = vertices[(vertices >= 0) & (vertices < count)]
    marks[vertices] = True
    return marks


def refuse_creases(creases: Any, around: Surroundings) -> None:
    """Fits would look across a crease that runs on outside, and round it off: only the ends inside are known."""
    ends = np.intersect1d([] if creases is None else creases, around.rim)
    if len(ends):
        raise ValueError(
            f"outline: 'mended' would round creases outside; {len(ends)} of `creases` lie on the boundary, "
            f"vertex {int(ends[0])} among them: pass outline='given', or leave `creases` out"
        )


def solve_fitted(
    call: Callable[[Boundary], Answer], given: Boundary, triangles: IntArray, around: Surroundings
) -> Answer:
    """The better answer: the fitted boundary's, unless the given one is solved, or folds less, or joins better.

    The given one is solved only where the fitted one has a fault.
    """
    if not len(around.rim):
        raise ValueError(
            "outline: 'mended' needs the triangles outside: pass them as `outside`, or among the triangles with all "
            "their vertices in `fixed`"
        )
    fitted = _core.mend_outline(given.vertices, around.outside, around.rim)
    if not len(fitted["moved"]):
        return call(given)
    answer = call(_moved(given, triangles, around.rim, fitted))
    worth = _worth(answer, around)
    if worth != _FLAWLESS:
        kept = call(given)
        if _worth(kept, around) > worth:
            why = "the fitted positions give folds, a larger kink or no solution"
            return _reported(kept, fitted["moved"], why, worse=1.0)
    answer["moved"] = fitted["moved"]
    return _reported(answer, fitted["held"], "moving it would turn triangles over")


def _moved(given: Boundary, triangles: IntArray, rim: IntArray, fitted: Answer) -> Boundary:
    """The fitted positions, and the fitted normals at the rim."""
    fixed = rim if given.fixed is None else given.fixed
    if given.normals is None:
        normals = _core.vertex_normals(given.vertices, triangles, "averaged")[fixed]
    else:
        normals = given.normals.copy()
    place = np.searchsorted(rim, fixed).clip(max=len(rim) - 1)
    found = (rim[place] == fixed) & fitted["fitted"][place]
    normals[found] = fitted["normals"][place[found]]
    return replace(given, vertices=fitted["vertices"], fixed=fixed, normals=normals)


_FLAWLESS = (True, 0, 0.0)


def _worth(answer: Answer, around: Surroundings) -> tuple[bool, int, float]:
    """What two answers are compared by: solved; folds; the worst kink in degrees, as far as it may be visible.

    Below, none is worth a second solve.
    """
    if not answer["converged"]:
        return False, -_folds(answer), 0.0
    degrees, _, seen = _core.visible_join(answer["vertices"], around.inside, around.outside, around.rim)
    return True, -_folds(answer), -float(np.max(degrees[seen], initial=0.0))


def _folds(answer: Answer) -> int:
    return sum(len(warning.elements) for warning in answer["warnings"] if warning.code in FOLDS)


def _reported(answer: Answer, vertices: IntArray, why: str, **figures: float) -> Answer:
    if len(vertices):
        text = f"{len(vertices)} vertices of a noisy boundary keep their positions: {why}"
        figures = {"vertices": len(vertices), **figures}
        answer["warnings"] += (Diagnostic("OUTLINE_KEPT", text, vertices, "vertex", figures),)
    return answer


def with_join(answer: Answer, around: Surroundings) -> Answer:
    """The join measured on the triangles outside, at the vertices that have some."""
    if len(around.rim):
        fixed = answer["fixed"]
        degrees, _, _ = _core.visible_join(answer["vertices"], around.inside, around.outside, fixed)
        answer["join"] = np.where(np.isin(fixed, around.rim), degrees, answer["join"])
        answer["join"].flags.writeable = False
    return answer


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

    trusted_curvatures: FloatArray
    """(k,) ``curvatures``, NaN where a fit is far less certain than the others: for ``fixed_curvatures``."""


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
    points, where = boundary.vertices, arguments.indices_within("fixed", fixed, len(boundary.vertices))
    inside = arguments.finite_triangles(points, around.inside)
    curvatures = _core.curvatures_around(points, inside, around.outside, where, boundary.normals)
    return replace(boundary, fixed=fixed, curvatures=where_met(curvatures, kinds))
