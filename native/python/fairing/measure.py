"""What can be measured on a mesh."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments
from fairing.results import FloatArray, IntArray

_NORMALS = _core.WORDS["normals"]


def mean_curvature(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    *,
    fixed: npt.ArrayLike | None = None,
    fixed_normals: npt.ArrayLike | None = None,
    normals: str = "fitted",
) -> FloatArray:
    """(n,) H at each vertex by the fit of §6, −1/R on a sphere of radius R with outward normals.

    Curves of ``fixed`` vertices are cut and get the mean of their sides. Without ``fixed_normals`` the
    normals of fixed and border vertices are fitted to their own side. Zero at vertices without triangles.
    Errors as in :func:`fairing.fair`.
    """
    points, faces = arguments.mesh(vertices, triangles)
    held, given = arguments.boundary(fixed, fixed_normals)
    kind = arguments.choice("normals", normals, _NORMALS)
    return _core.mean_curvature(points, faces, held, given, kind)


def vertex_normals(vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, normals: str = "fitted") -> FloatArray:
    """(n, 3) unit normals on the side from which the triangles are counter-clockwise.

    "fitted": consistent with the curvature fit; "averaged": normalised sum of cross products (§6). Zero at
    vertices without triangles.
    """
    points, faces = arguments.mesh(vertices, triangles)
    return _core.vertex_normals(points, faces, arguments.choice("normals", normals, _NORMALS))


def cotan_laplacian(vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> tuple[IntArray, IntArray, FloatArray]:
    """(rows, columns, values) of S for all vertices (§5, eq. 6, 7).

    S_ij = −(cot α + cot β), without ½; rows sum to zero; positive semidefinite.
    """
    points, faces = arguments.mesh(vertices, triangles)
    return _core.cotan_laplacian(points, faces)


def edges_with_uses(triangles: npt.ArrayLike) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """(e, 2) edges, ascending, the smaller index of each first; and (e,) how many triangles each has."""
    faces = arguments.triangles_within(triangles, np.iinfo(np.int32).max).astype(np.int64)
    count = int(faces.max(initial=0)) + 1
    sides = np.sort(np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    numbers, uses = np.unique(sides @ [count, 1], return_counts=True)
    return np.stack(np.divmod(numbers, count), axis=1), uses


def boundary_loops(triangles: npt.ArrayLike) -> list[IntArray]:
    """Closed loops of border vertices, each with the mesh on its left, starting at its smallest vertex.

    A list of (k,) vertex indices, one for each loop; empty for a closed mesh. Where the border touches itself in a
    vertex (a pinch), that vertex stands in the list as often as the border passes through it. ``fixed`` takes each
    vertex once: give it ``np.unique(np.concatenate(loops))``. Memory grows with the largest index.
    """
    faces = arguments.triangles_within(triangles, np.iinfo(np.int32).max)  # one more is counted
    return _core.boundary_loops(faces)


def components(triangles: npt.ArrayLike, *, fixed: npt.ArrayLike | None = None) -> IntArray:
    """(m,) which component each triangle belongs to: 0, 1, … by their lowest triangles; −1 where no vertex is free.

    A component is what :func:`fairing.fair` solves on its own: a connected piece of the mesh after cutting along curves
    of ``fixed`` vertices. Errors as there. Memory grows with the largest index.
    """
    faces = arguments.triangles_within(triangles, np.iinfo(np.int32).max)  # one more is counted
    held, _ = arguments.boundary(fixed, None)
    count = int(max(faces.max(initial=-1), -1 if held is None else held.max(initial=-1))) + 1
    return _core.components(faces, held, count)


def hierarchy(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, fixed: npt.ArrayLike | None = None, levels: int = 0
) -> list[tuple[IntArray, IntArray]]:
    """Ever finer meshes, the last of which is the one given: (vertices in use, ascending; triangles (m, 3)) of each.

    They are those of multigrid, by connectivity alone: each has about a quarter of the next one's free vertices, and
    all fixed ones. ``levels``: how many at most; 0: as many as there are. Errors as in :func:`fairing.fair`.
    """
    points, faces, held = arguments.held_mesh(vertices, triangles, fixed)
    found = _core.mesh_levels(points, faces, held, arguments.whole("levels", levels, 0))
    return [(np.unique(level), level) for level in [*found[:0:-1], faces]]


def self_intersections(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, near: npt.ArrayLike | None = None
) -> IntArray:
    """Triangles that another one pierces: an edge of one passes through the inside of the other. Ascending.

    Triangles that share an edge don't count, nor do those that only touch or overlap in one plane, nor those with a
    corner that is NaN or infinite. This is what the warning SELF_INTERSECTION of :func:`fairing.fair` names in each
    component; here any triangles are compared. With ``near``, (k,) numbers of triangles, only pairs with one of these
    count, and both of a pair are named: faster where these are few. ValueError where a number is none of a triangle.
    """
    points, faces = arguments.mesh(vertices, triangles)
    asked = None if near is None else arguments.rows_within("near", near, len(faces), "triangle")
    whole = np.isfinite(points[faces]).all(axis=(1, 2))
    finite = np.flatnonzero(whole)
    if asked is not None:
        asked = np.searchsorted(finite, asked[whole[asked]]).astype(np.int32)
    found = finite[_core.self_intersections(points, faces[finite], asked)].astype(np.int32)
    found.flags.writeable = False
    return found


def conformal_distortion(reference: npt.ArrayLike, vertices: npt.ArrayLike, triangles: npt.ArrayLike) -> FloatArray:
    """(m,) ratio ≥ 1 of the singular values of each triangle's map from ``reference`` to ``vertices``.

    1: angles are kept; infinite where a triangle is degenerate on one side.
    """
    points = arguments.floats("vertices", vertices)
    m0 = arguments.floats("reference", reference, points.shape[0])
    faces = arguments.triangles_within(triangles, points.shape[0])
    return _core.conformal_distortion(m0, points, faces)


def deviation(vertices: npt.ArrayLike, reference: npt.ArrayLike, triangles: npt.ArrayLike) -> FloatArray:
    """(n,) signed distance of each vertex to another surface, in the unit of the positions.

    vertices: (n, 3); the surface: ``triangles`` (m, 3) over the positions ``reference`` (k, 3). Positive on the side
    from which its triangles are counter-clockwise, by the normal at the nearest point, which on edges and corners is
    the mean by angles (Baerentzen & Aanaes 2005); beyond the border of an open surface the sign is that of its nearest
    triangles' side. NaN at vertices that aren't finite; triangles with such a corner are left out. MeshError where a
    triangle names a vertex that isn't there, ValueError where no triangle is left.
    """
    points = arguments.floats("vertices", vertices)
    surface = arguments.floats("reference", reference)
    faces = arguments.triangles_within(triangles, surface.shape[0])
    faces = faces[np.isfinite(surface[faces]).all(axis=(1, 2))]
    if len(faces) == 0:
        raise ValueError("triangles: no triangle with finite corners is there to measure from")
    found = np.full(len(points), np.nan)
    finite = np.isfinite(points).all(axis=1)
    used, named = np.unique(faces, return_inverse=True)
    found[finite] = _core.signed_distances(points[finite], surface[used], named.reshape(-1, 3).astype(np.int32))
    return found


def hard_edges(vertices: npt.ArrayLike, triangles: npt.ArrayLike, *, marked: npt.ArrayLike | None = None) -> IntArray:
    """(h, 2) edges at which the surface is broken, the smaller index first, ascending.

    An edge is hard where its dihedral angle is 35° and more above how the mesh bends across its direction, within
    three rings. A box's edges and a cylinder's rim are hard. A coarse sphere, a tube of five sides and more, and noise
    that bends to both sides have no hard edges. A crease that runs between two rows of triangles makes both rows hard.
    Hard edges run on where they fade, by half of that angle, and fewer than four in a row count where they end at the
    border or at corners alone.

    ``marked``: (m, 2) edges that are hard whatever they bend; pairs that are no edges of the triangles are left out, as
    are triangles with a corner that is NaN or infinite.
    """
    points, faces = arguments.mesh(vertices, triangles)
    pairs = arguments.vertices_of("marked", marked, len(points), 2)
    return _core.hard_edges(points, arguments.finite_triangles(points, faces), pairs)


def nearest(places: FloatArray, ends: FloatArray) -> IntArray:
    """(k,) the nearest of the ends (s, 3), in blocks of places."""
    block = max(1, 2_000_000 // max(1, len(ends)))
    found = [
        ((part[:, None] - ends[None]) ** 2).sum(axis=2).argmin(axis=1)
        for part in np.array_split(places, range(block, len(places), block))
    ]
    return np.concatenate(found)
