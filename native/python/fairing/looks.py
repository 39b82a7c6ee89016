"""What a surface looks like: figures of it, and where. From when on it looks wrong is in LIMITS."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments
from fairing.results import FloatArray, IntArray

__all__ = [
    "LIMITS",
    "Flank",
    "Girth",
    "Needles",
    "VisibleJoin",
    "flank",
    "flipped_triangles",
    "girth",
    "has_lost_grain",
    "is_rougher",
    "is_spoilt",
    "knobs",
    "needles",
    "rounded_edges",
    "seam_kinks",
    "sunken",
    "visible_join",
]


LIMITS: dict[str, float] = _core.LIMITS


class Girth(NamedTuple):
    """How thick a surface between boundary loops is, and where; radii by the areas within cross-sections."""

    least: float
    """The thinnest cross-section over the thinner end; 1 for tubes and cones, less than that for waists."""
    largest: float
    """The thickest one over the thicker end; more than 1 for balloons."""
    thinnest: IntArray
    """Vertices beside the thinnest cross-section, ascending; none where ``least`` is 1."""
    thickest: IntArray
    """Vertices beside the thickest one, ascending; none where ``largest`` is 1."""


class Flank(NamedTuple):
    """A boundary on the slope of a bump or a dent."""

    boundary: IntArray
    """Its vertices, one after the other."""
    is_bump: bool
    """Or a dent."""
    width: float
    """From the boundary to the end of the slope."""


class Needles(NamedTuple):
    """Triangles without a height."""

    all: IntArray
    """Those whose height is below a thousandth of their longest side, ascending."""
    seen: IntArray
    """Those of them whose neighbours bend by more than 1°: on a plane no one sees them."""


class VisibleJoin(NamedTuple):
    """How much a join shows, and where the eye finds a kink."""

    degrees: FloatArray
    """(k,) at each vertex of the outline."""
    limit: float
    """Degrees from which a kink stands out among triangles that bend as those outside do: 5 to 30."""
    seen: IntArray
    """Places in the outline where one does, ascending: there neighbours above the limit add up to five times that."""


def girth(vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, fixed: npt.ArrayLike | None = None) -> Girth | None:
    """How thick a surface between boundary loops is, and where; None where no component has several.

    The worst of all components. ``girth`` of the result of :func:`fairing.fair` has its two figures, between the ends
    of tubes. Errors as for :func:`fairing.fair`.
    """
    points, faces, held = arguments.held_mesh(vertices, triangles, fixed)
    found = _core.girth(points, faces, held)
    return None if found is None else Girth(*found)


def knobs(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, fixed: npt.ArrayLike | None = None, before: float = 0.0
) -> tuple[float, IntArray]:
    """(extent, tops): by how much, of 2π, discs bend both like a ball and like a saddle at most, and where they swell.

    By Gauss and Bonnet a disc's boundary with its slopes settles the integral of its Gaussian curvature; a knob on a
    neck adds as much of both signs. The tops are the most bent vertices, half of the turn, where that is more than a
    quarter and more than four fifths of ``before``, the extent of another surface. Components (see
    :func:`fairing.components`) with several loops or with pins don't count. Errors as for :func:`fairing.fair`.
    """
    points, faces, held = arguments.held_mesh(vertices, triangles, fixed)
    return _core.knobs(points, faces, held, before)


def flank(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, around: npt.ArrayLike, *, fixed: npt.ArrayLike | None = None
) -> Flank | None:
    """Where a disc's boundary lies on the flank of a bump or a dent, which the surface continues; None where none does.

    All around, the disc bends over to one side and the triangles ``around`` it, (m, 3) wound likewise, as far as it is
    wide, bend back. Components with several loops, with pins or with an open border don't count. Errors as for
    :func:`fairing.fair`.
    """
    points, faces, held = arguments.held_mesh(vertices, triangles, fixed)
    beyond = arguments.vertices_of("around", around, len(points), 3)
    found = _core.flank(points, faces, beyond, held)
    return None if found is None else Flank(*found)


def sunken(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    normals: npt.ArrayLike,
    *,
    fixed: npt.ArrayLike | None = None,
) -> tuple[float, IntArray]:
    """(depth, where): how far discs sink below the lines that run on across them, a share of their lengths; 0: nowhere.

    A line runs from one vertex of the boundary to another as a cubic that leaves both along the tangent planes of the
    ``normals`` there: unit vectors (n, 3), of which only those of the fixed vertices count, and zeros don't. Only lines
    that go straight on are drawn; the depth is the median over them, and the vertices are those as deep as that,
    ascending. Components with several loops or with pins don't count. Errors as for :func:`fairing.fair`.
    """
    points, faces, held = arguments.held_mesh(vertices, triangles, fixed)
    directions = arguments.floats("normals", normals)
    if directions.shape != points.shape:
        raise ValueError(f"normals: expected one for each of {len(points)} vertices, got shape {directions.shape}")
    return _core.sunken(points, faces, directions, held)


def has_lost_grain(before: npt.ArrayLike, after: npt.ArrayLike, inside: npt.ArrayLike, outside: npt.ArrayLike) -> bool:
    """Whether the triangles ``inside`` had the pores and the noise of those ``outside``, (m, 3) each, and have no more.

    Grain turns the normals (n, 3) of a surface away from their means over some six edges: by 2.5° or more in the median
    and evenly, as features don't. ``before`` and ``after`` are positions (n, 3).
    """
    old, new = arguments.floats("before", before), arguments.floats("after", after)
    if old.shape != new.shape:
        raise ValueError(f"after: expected shape {old.shape} as of before, got {new.shape}")
    within = arguments.triangles_within(inside, old.shape[0])
    return _core.has_lost_grain(old, new, within, arguments.triangles_within(outside, old.shape[0]))


def is_rougher(vertices: npt.ArrayLike, inside: npt.ArrayLike, outside: npt.ArrayLike) -> bool:
    """Whether the triangles ``inside`` are crumpled: many edges bend as those ``outside``, (m, 3) each, do not.

    Beyond the range of nine tenths of these, by more than 5°: more than 16 in 100. Edges on the border don't count.
    """
    points = arguments.floats("vertices", vertices)
    within = arguments.triangles_within(inside, points.shape[0])
    return _core.is_rougher(points, within, arguments.triangles_within(outside, points.shape[0]))


def needles(vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> Needles:
    """Triangles without a height, and those of them that are seen."""
    points = arguments.floats("vertices", vertices)
    return Needles(*_core.needles(points, arguments.triangles_within(triangles, points.shape[0])))


def rounded_edges(
    before: npt.ArrayLike,
    after: npt.ArrayLike,
    triangles: npt.ArrayLike,
    moved: npt.ArrayLike,
    *,
    marked: npt.ArrayLike | None = None,
) -> IntArray:
    """Those of the vertices ``moved`` (k,), ascending, at hard edges that became flatter by 15° and more.

    ``before``, ``after``: (n, 3). Hard edges are those of :func:`fairing.hard_edges` that run on straight: two of a
    chain stay with their triangles. With ``marked``, (m, 2), these count instead, wherever they
    end, as far as they bent by 35°; none where more than a quarter of all edges are marked. Triangles with a corner
    that is NaN or infinite are left out.
    """
    old = arguments.floats("before", before)
    new = arguments.floats("after", after, old.shape[0])
    faces = arguments.triangles_within(triangles, old.shape[0])
    where = arguments.vertices_of("moved", moved, len(old))
    pairs = None
    if marked is not None:
        pairs = np.sort(arguments.vertices_of("marked", marked, len(old), 2), axis=1)
    known = np.isfinite(old[faces]).all(axis=(1, 2)) & np.isfinite(new[faces]).all(axis=(1, 2))
    return _core.rounded_edges(old, new, faces[known], where, pairs)


def seam_kinks(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, held: npt.ArrayLike, limit: float = LIMITS["visible_kink"]
) -> IntArray:
    """Vertices at seams inside a surface that stay, ascending, where it shows a kink.

    A seam is where vertices of ``held`` lie in the same place, as doubled ones do: the surface is open there, and what
    held it up shows as a crest. ``limit``: ``limit`` of :func:`fairing.looks.visible_join`.
    """
    points, faces = arguments.mesh(vertices, triangles)
    places = arguments.vertices_of("held", held, len(points))
    return _core.seam_kinks(points, faces, places, limit)


def is_spoilt(vertices: npt.ArrayLike, inside: npt.ArrayLike, outside: npt.ArrayLike) -> bool:
    """Whether the shape of the triangles ``inside`` is no texture to keep: a vertex is pulled out, or all is crumpled.

    Pulled out: by more than 1.6 edges from the mean of its neighbours. Crumpled: by a quarter of an edge in the median,
    and by twice as much as around, among the triangles ``outside``. Border vertices of both don't count.
    """
    points = arguments.floats("vertices", vertices)
    within = arguments.triangles_within(inside, points.shape[0])
    return _core.is_spoilt(points, within, arguments.triangles_within(outside, points.shape[0]))


def flipped_triangles(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, fixed: npt.ArrayLike | None = None
) -> IntArray:
    """Triangles that are turned over: their normals point against the mean of their corners' normals. Ascending.

    The corners' normals are those of N. Max, at free vertices alone. This is what the warning FLIPPED_TRIANGLES of
    :func:`fairing.fair` names for the same ``fixed``. Errors as there.
    """
    points, faces, held = arguments.held_mesh(vertices, triangles, fixed)
    return _core.flipped_triangles(points, faces, held)


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
    points = arguments.floats("vertices", vertices)
    sides = (arguments.vertices_of(*side, len(points), 3) for side in (("inside", inside), ("outside", outside)))
    within, beyond = (arguments.finite_triangles(points, side) for side in sides)
    where = arguments.vertices_of("outline", outline, len(points))
    earlier = None if before is None else arguments.floats("before", before, points.shape[0])
    return VisibleJoin(*_core.visible_join(points, within, beyond, where, earlier))
