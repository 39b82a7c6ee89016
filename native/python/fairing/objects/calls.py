"""Fairing, filling and rounding of meshes as other libraries hold them."""

from __future__ import annotations

import logging
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from fairing import _arguments
from fairing._boundary_normals import boundary_normals
from fairing._fair import fair
from fairing._fill import fill
from fairing._fillet import fillet
from fairing._measure import boundary_loops
from fairing._new_mesh import FilletResult, FillResult, NewMeshResult
from fairing._types import FairResult, IntArray
from fairing.objects import data
from fairing.objects.hosts import opened
from fairing.objects.parts import Data, Parts, Polygons

Result = TypeVar("Result", FairResult, FillResult, FilletResult)
log = logging.getLogger(__name__.partition(".")[0])


class Made(NamedTuple, Generic[Result]):
    """A new mesh, of the kind that was given, and what the engine reports."""

    mesh: Any
    result: Result


def fair_faces(mesh: Any, selected: Any, *, side: str = "automatic", **options: Any) -> Made[FairResult]:
    """Replace the selected faces' inner vertices by the fairest surface that continues the faces around them.

    Vertices and faces keep their numbers, everything that is stored with them stays, and normals stored at vertices
    are renewed where these move. The boundary is met with the slope of the faces outside; see ``side``. Vertices in one
    place on two borders, as files have them along seams, count as one. The mesh given is not changed.

    Parameters
    ----------
    mesh : (vertices, faces), trimesh.Trimesh, pyvista.PolyData, meshio.Mesh or open3d.geometry.TriangleMesh
        (n, 3) floats and faces with any number of corners: an (m, k) array, or a list with the corners of each.
    selected : (m,) bool, (k,) int or str
        A mask of the faces, their numbers, or the name of data at faces that is not zero where they are selected.
    side : "automatic" | "outside" | "inside"
        Whose slope counts at the boundary: that of :func:`fairing.boundary_normals`.
    options
        Those of :func:`fairing.fair`: ``continuity``, ``equation``, ``detail``, ``progress``, ``threads``, …

    Returns
    -------
    Made
        The new mesh, of the kind given, and the :class:`fairing.FairResult`. Also unpacks: ``mesh, result = …``.

    Raises
    ------
    ValueError
        The mesh or the selection is none that is known here.
    MeshError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fair`.
    """
    parts, make = opened(mesh)
    faces = _selection(selected, parts)
    mask = np.zeros(len(parts.faces.sizes), dtype=bool)
    mask[faces] = True
    within = mask[parts.faces.face_of]
    inside, outside = parts.triangles[within], parts.triangles[~within]
    outline = np.unique(np.concatenate([np.empty(0, np.int32), *boundary_loops(inside)]))
    slopes = boundary_normals(parts.points, inside, outline, outside=outside, side=side).normals
    known = np.linalg.norm(slopes, axis=1) > 0
    if (parts.faces.sizes[mask] > 3).any():
        options.setdefault("neighbours", parts.faces.edges(faces, parts.same))
    result = fair(
        parts.points, inside, fixed=outline[known], fixed_normals=slopes[known], outside=outside, **options
    )  # fmt: skip
    moved = np.flatnonzero((result.vertices != parts.points).any(axis=1)[parts.same]).astype(np.int32)
    points = parts.points.copy()
    points[moved] = result.vertices[parts.same[moved]]
    made = data.with_normals(Parts(points, parts.faces, parts.vertex_data, parts.face_data), moved)
    _report("fair_faces", result, len(moved))
    return Made(make(made), result)


def fill_holes(
    mesh: Any, *, longest: int = 0, longest_length: float = 0.0, bridge: bool = False, loops: Any = None, **options: Any
) -> Made[FillResult]:
    """Fill the holes of a mesh, or bridge its boundary loops, with the fairest surface that continues what is there.

    Vertices and faces given keep their numbers; new ones come behind them. Real numbers and colours stored at vertices
    go on over the new surface, as heat would spread from its boundary. Everything else is taken from the nearest vertex
    or face of the boundary. Outer borders of a sheet stay open.

    Parameters
    ----------
    mesh
        As for :func:`fair_faces`. Seams, where files part vertices in one place, are no holes.
    longest, longest_length : int, float
        Holes with more edges, or longer ones, stay open; 0: none does.
    bridge : bool
        One surface joins all loops.
    loops : list of (k,) int
        These loops of border vertices instead of all holes.
    options
        Those of :func:`fairing.fill`: ``spacing``, ``faces``, ``continuity``, ``edges``, ``progress``, … Quads become
        faces of four corners where the kind of mesh has them.

    Returns
    -------
    Made
        The new mesh and the :class:`fairing.FillResult`, whose ``left_open`` has the loops that stay open.

    Raises
    ------
    ValueError, MeshError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fill`; MeshError NO_BOUNDARY where there is no hole.
    """
    parts, make = opened(mesh)
    given = None if loops is None else [parts.same[np.asarray(loop)] for loop in loops]
    result = fill(
        parts.points, parts.triangles, given,
        bridge=bridge, longest=longest, longest_length=longest_length, **options,
    )  # fmt: skip
    count = len(parts.points)
    points = np.concatenate([parts.points, result.vertices])
    of_vertices = data.spread(parts.vertex_data, points, result.triangles, count)
    rim = np.flatnonzero(np.isin(parts.triangles, np.concatenate(result.loops)).any(axis=1))
    new_faces = Polygons.of(result.triangles)
    if result.quads is not None:
        new_faces = Polygons.joined([Polygons.of(result.quads.quads), Polygons.of(result.quads.triangles)])
    firsts = np.column_stack([new_faces.corners[new_faces.first + k] for k in range(3)])
    middles = [points[triangles].mean(axis=1) for triangles in (firsts, parts.triangles[rim])]
    beside = parts.faces.face_of[rim[data.nearest(*middles)]]
    of_faces = {name: np.concatenate([values, values[beside]]) for name, values in parts.face_data.items()}
    whole = Polygons.joined([parts.faces, new_faces])
    new = np.arange(count, len(points), dtype=np.int32)
    made = data.with_normals(Parts(points, whole, of_vertices, of_faces), new)
    _report("fill_holes", result, len(new))
    return Made(make(made), result)


def fillet_edges(mesh: Any, edges: npt.ArrayLike | None = None, *, width: float, **options: Any) -> Made[FilletResult]:
    """Round edges of a mesh: what lies within ``width`` of them becomes the fairest surface.

    Faces that the fillet cuts become triangles; the others keep their order. Data at vertices is mixed from the corners
    of the old triangle that a new vertex lies on, that of faces comes from the old face.

    Parameters
    ----------
    mesh
        As for :func:`fair_faces`.
    edges : (e, 2) int
        Default: all hard edges (:func:`fairing.hard_edges`).
    width : float
        How far the fillet reaches on either side.
    options
        Those of :func:`fairing.fillet`: ``width_2``, ``walls``, ``profile``, ``spacing``, ``faces``, …

    Returns
    -------
    Made
        The new mesh and the :class:`fairing.FilletResult`. Its numbers are those of the old vertices and, behind them,
        the new ones; the mesh has them in this order without the old ones that no face uses any more.

    Raises
    ------
    ValueError, MeshError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fillet`.
    """
    parts, make = opened(mesh)
    seam = None if edges is None else parts.same[_arguments.integers("edges", edges, 2)]
    if (parts.faces.sizes > 3).any():
        options.setdefault("neighbours", parts.faces.edges(np.arange(len(parts.faces.sizes)), parts.same))
    result = fillet(parts.points, parts.triangles, seam, width=width, **options)
    triangles, weights = result.origin
    of_vertices = data.mixed(parts.vertex_data, parts.faces.triangles[triangles], weights)
    stays = ~np.isin(np.arange(len(parts.triangles)), result.gone)
    whole = np.ones(len(parts.faces.sizes), dtype=bool)
    whole[parts.faces.face_of[result.gone]] = False
    halves = np.flatnonzero(stays & ~whole[parts.faces.face_of])
    new_faces, under = Polygons.of(result.triangles), result.parent
    if result.quads is not None:
        new_faces = Polygons.joined([Polygons.of(result.quads.triangles), Polygons.of(result.quads.quads)])
        under = np.concatenate([under[result.quads.rest], under[result.quads.pairs[:, 0]]])
    faces = Polygons.joined([parts.faces.chosen(whole), Polygons.of(parts.faces.triangles[halves]), new_faces])
    order = np.concatenate(
        [np.flatnonzero(whole), parts.faces.face_of[halves], parts.faces.face_of[under]]
    )  # the old face of each
    of_faces = {name: values[order] for name, values in parts.face_data.items()}
    points = np.concatenate([parts.points, result.vertices])
    new = np.arange(len(parts.points), len(points), dtype=np.int32)
    made = data.with_normals(Parts(points, faces, of_vertices, of_faces), new)
    _report("fillet_edges", result, len(new))
    return Made(make(_without_unused(made, parts)), result)


def _without_unused(made: Parts, before: Parts) -> Parts:
    """Without the vertices that only faces which have gone did use."""
    kept = np.isin(np.arange(len(made.points)), made.faces.corners)
    kept[: len(before.points)] |= ~np.isin(np.arange(len(before.points)), before.faces.corners)
    number = np.cumsum(kept) - 1
    of_vertices: Data = {name: values[kept] for name, values in made.vertex_data.items()}
    faces = Polygons(number[made.faces.corners].astype(np.int32), made.faces.sizes)
    return Parts(made.points[kept], faces, of_vertices, made.face_data)


def _selection(selected: Any, parts: Parts) -> IntArray:
    """The numbers of the selected faces."""
    if isinstance(selected, str):
        if selected not in parts.face_data:
            raise ValueError(f"selected: no data at faces is called {selected!r}; there are {sorted(parts.face_data)}")
        selected = np.asarray(parts.face_data[selected]) != 0
    array = np.asarray(selected)
    count = len(parts.faces.sizes)
    if array.dtype == bool:
        if array.shape != (count,):
            raise ValueError(f"selected: a mask of {count} faces is needed, not one of shape {array.shape}")
        array = np.flatnonzero(array)
    faces = _arguments.integers("selected", array, None)
    if not len(faces):
        raise ValueError("selected: no face is selected")
    if faces.min() < 0 or faces.max() >= count:
        raise ValueError(f"selected: names a face that is not one of 0 … {count - 1}")
    return faces


def _report(call: str, result: FairResult | NewMeshResult, vertices: int) -> None:
    log.info("%s: %d vertices, %s, %.2f s", call, vertices, result.termination, result.seconds["total"])
    for warning in result.warnings:
        log.warning("%s: %s: %s", call, warning.code, warning.message)
