"""What a surface looks like: figures of it, and where. From when on it looks wrong is in LIMITS."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments
from fairing.results import FloatArray, IntArray, Progress

__all__ = [
    "LIMITS",
    "Faults",
    "Girth",
    "Judged",
    "VisibleJoin",
    "flipped_triangles",
    "girth",
    "judged",
    "visible_join",
]


LIMITS: dict[str, float] = _core.LIMITS


UNUSABLE = ("no_surface", "folded", "crossing")


def fault(result: Any, *, folded: bool, crossing: bool, kinked: bool) -> str:
    """The worst that is wrong: one of UNUSABLE, or what deserves a look, "" where all is good."""
    least, largest = result.girth or (1.0, 1.0)
    found = {
        "no_surface": not result.converged and result.termination != "folded",
        "folded": folded or result.termination == "folded",
        "crossing": crossing,
        "kink": kinked and result.equation != "soap_film",  # which meets its boundary with a crease
        result.equation: result.equation in ("loft", "bilaplacian", "smoothed"),  # they stand in
        "thin_tube": least < LIMITS["waist"],
        "thick_tube": largest > LIMITS["balloon"],
    }
    return next((name for name, holds in found.items() if holds), "")


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


class VisibleJoin(NamedTuple):
    """How much a join shows, and where the eye finds a kink."""

    degrees: FloatArray
    """(k,) at each vertex of the boundary."""
    limit: float
    """Degrees from which a kink stands out among triangles that bend as those outside do: 5 to 30."""
    seen: IntArray
    """Places on the boundary where one does, ascending; none where that is an eighth of it or less."""


class Faults(NamedTuple):
    """What is wrong with a surface by itself: numbers of its triangles, ascending."""

    folded: IntArray
    """Turned over, as :func:`flipped_triangles` has them, with a corner that is not held."""
    crossing: IntArray
    """Those that pass through others of the surface."""


class Judged(NamedTuple):
    """All that the verdict reads of a new surface in its mesh."""

    join: VisibleJoin
    now: Faults
    before: Faults | None
    """Crossings only where there are some now; None without a shape before."""
    pierced: IntArray
    """Triangles of the surface that pass through others of the mesh, and did not before."""
    rounded: IntArray
    """Moved vertices at hard edges (:func:`fairing.hard_edges`) that run on straight over two edges that stay, and that
    became flatter by 15° and more; ascending."""
    blunt: IntArray
    """Moved vertices at ``marked`` edges of 35° and more that did; none where a quarter of all are marked."""
    seams: IntArray
    """Held vertices in the same place as others, as doubled ones are, where the surface shows a kink."""


def judged(
    vertices: npt.ArrayLike,
    surface: npt.ArrayLike,
    others: npt.ArrayLike,
    *,
    held: npt.ArrayLike,
    rim: npt.ArrayLike,
    before: npt.ArrayLike | None = None,
    old: npt.ArrayLike | None = None,
    moved: npt.ArrayLike = (),
    marked: npt.ArrayLike | None = None,
    is_clear: bool = False,
    progress: Progress | None = None,
) -> Judged:
    """Measure a surface, triangles (m, 3), and how it lies among the ``others`` of its mesh, (o, 3).

    ``held``: its vertices that stay; ``rim``: those of them at which the join counts. ``before``: where the vertices
    were; ``old``: the triangles that were there, if not these. ``moved``: vertices whose edges are compared.
    ``is_clear``: no triangle of the surface passes through another, that is known. Triangles of the others with a
    corner that is NaN or infinite don't count. On all threads. Errors as for :func:`fairing.fair`.
    """
    points = arguments.floats("vertices", vertices)
    count = len(points)
    earlier = None if before is None else arguments.floats("before", before)
    inside = arguments.triangles_within(surface, count)
    was = inside if old is None or earlier is None else arguments.triangles_within(old, len(earlier))
    pairs = np.empty((0, 2), np.int32)
    if marked is not None:
        pairs = np.sort(arguments.vertices_of("marked", marked, count, 2), axis=1)
    where = (arguments.vertices_of(*each, count) for each in (("held", held), ("rim", rim), ("moved", moved)))
    fixed, ends, changed = where
    rest = arguments.triangles_within(others, count)
    found = _core.judged(points, inside, rest, fixed, ends, earlier, was, changed, pairs, is_clear, progress)
    found["join"], found["now"] = VisibleJoin(*found["join"]), Faults(*found["now"])
    found["before"] = None if found["before"] is None else Faults(*found["before"])
    return Judged(**found)


def girth(vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, fixed: npt.ArrayLike | None = None) -> Girth | None:
    """How thick a surface between boundary loops is, and where; None where no component has several.

    The worst of all components. ``girth`` of the result of :func:`fairing.fair` has its two figures, between the ends
    of tubes. Errors as for :func:`fairing.fair`.
    """
    points, faces, held = arguments.held_mesh(vertices, triangles, fixed)
    found = _core.girth(points, faces, held)
    return None if found is None else Girth(*found)


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
    boundary: npt.ArrayLike,
) -> VisibleJoin:
    """How visible the join of the two lists of triangles is at the vertices of ``boundary`` (k,), each named once.

    ``degrees``: by how much the signed dihedral angles of the boundary's edges exceed what is usual across their
    direction within three rings on either side (the middle half of the angles, by length and direction); the mean over
    the boundary's edges at the vertex. 0 on a sphere or tube however coarse, and on a crease that goes on on either
    side. ``limit``: of nine tenths of the edges outside the range of bends, as far as it lies between 5 and
    ``LIMITS["visible_kink"]`` = 12, or half of it where that is more, up to 30. 12 without triangles outside.
    """
    points = arguments.floats("vertices", vertices)
    sides = (arguments.vertices_of(*side, len(points), 3) for side in (("inside", inside), ("outside", outside)))
    within, beyond = (arguments.finite_triangles(points, side) for side in sides)
    where = arguments.vertices_of("boundary", boundary, len(points))
    return VisibleJoin(*_core.visible_join(points, within, beyond, where))
