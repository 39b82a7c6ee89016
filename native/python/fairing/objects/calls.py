"""Fairing, filling and rounding of meshes as other libraries hold them."""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Iterable
from dataclasses import replace
from typing import Any, Generic, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.filleting.fillet import fillet
from fairing.filling.fill import fill
from fairing.measure import boundary_loops, self_intersections
from fairing.objects.hosts import opened
from fairing.objects.parts import Parts
from fairing.objects.seams import filled, rounded, with_normals
from fairing.options import arguments
from fairing.results import Diagnostic, FairResult, FilletResult, FillResult, IntArray, NewMeshResult
from fairing.solving.fair import fair
from fairing.solving.surroundings import boundary_normals

Result = TypeVar("Result", FairResult, FillResult, FilletResult)
log = logging.getLogger(__name__.partition(".")[0])


class Made(NamedTuple, Generic[Result]):
    """A new mesh, of the kind that was given, and what the engine reports."""

    mesh: Any
    result: Result


def fair_faces(mesh: Any, selected: Any, *, side: str = "automatic", **options: Any) -> Made[FairResult]:
    """Replace the selected faces' inner vertices by the fairest surface that continues the faces around them.

    Vertices and faces keep their numbers, everything that is stored with them stays, and normals stored at vertices are
    renewed where these move. Vertices in one place on two borders, as files have them along seams, count as one. The
    mesh given is not changed. Errors are those of :func:`fairing.fair`, and ValueError for a mesh that is not known.

    Parameters
    ----------
    mesh : (vertices, faces), trimesh.Trimesh, pyvista.PolyData, meshio.Mesh or open3d.geometry.TriangleMesh
        (n, 3) floats and faces with any number of corners: an (m, k) array, or a list with the corners of each.
    selected : (m,) bool, (k,) int or str
        A mask of the faces, their numbers, or the name of data at faces that is not zero where they are selected.
    side : "automatic" | "outside" | "inside"
        Whose slope counts at the boundary: that of :func:`fairing.boundary_normals`.
    options
        Those of :func:`fairing.fair`.
    """
    parts, make = opened(mesh)
    mask = np.zeros(len(parts.faces.sizes), dtype=bool)
    mask[_selection(selected, parts)] = True
    within = mask[parts.faces.face_of]
    inside, outside = parts.triangles[within], parts.triangles[~within]
    boundary = np.unique(np.concatenate([np.empty(0, np.int32), *boundary_loops(inside)]))
    slopes = boundary_normals(parts.points, inside, boundary, outside=outside, side=side).normals
    known = np.linalg.norm(slopes, axis=1) > 0
    if (parts.faces.sizes[mask] > 3).any():
        options.setdefault("neighbours", _edges(parts, mask))
    result = fair(
        parts.points, inside, fixed=boundary[known], fixed_normals=slopes[known], outside=outside, **options
    )  # fmt: skip
    moved = np.flatnonzero((result.vertices != parts.points).any(axis=1)[parts.same]).astype(np.int32)
    points = parts.points.copy()
    points[moved] = result.vertices[parts.same[moved]]
    made = replace(parts, points=points)
    near = np.isin(parts.own, moved).any(axis=1)
    near[self_intersections(parts.points, parts.own, near=np.flatnonzero(near))] = False  # they did before
    return _made(make, made, result, moved, near)


def fill_holes(
    mesh: Any, *, longest: int = 0, longest_length: float = 0.0, bridge: bool = False, loops: Any = None, **options: Any
) -> Made[FillResult]:
    """Fill the holes of a mesh, or bridge its boundary loops, with the fairest surface that continues what is there.

    Vertices and faces given keep their numbers; new ones come behind them. Real numbers and colours at vertices spread
    over the new surface from its boundary; everything else is that of the nearest vertex or face there. Where a seam
    crosses a hole, new vertices are parted, too. Faces wound against most of their piece are turned
    (INCONSISTENT_WINDING). Outer borders of a sheet stay open. Errors are those of :func:`fairing.fill`: NO_BOUNDARY
    where there is no hole.

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
        Those of :func:`fairing.fill`. Quads become faces of four corners where the kind of mesh has them.
    """
    given = dict(options, longest=longest, longest_length=longest_length, bridge=bridge, loops=loops)
    return fill_accepted(mesh, lambda surface: True, **given)


def fill_accepted(mesh: Any, accept: Callable[[NewMeshResult], bool], **options: Any) -> Made[FillResult]:
    """The same; holes whose surface is not accepted stay open in the mesh."""
    parts, make = opened(mesh)
    parts, turned = _wound_alike(parts)
    if (loops := options.pop("loops", None)) is not None:
        options["loops"] = [parts.same[np.asarray(loop)] for loop in loops]
    result = fill(parts.points, parts.triangles[parts.sound], **options)
    surfaces = [hole.surface for hole in result.holes if hole.surface is not None and accept(hole.surface)]
    made = filled(parts, surfaces) if surfaces else parts
    result = replace(result, warnings=(*result.warnings, *turned))
    new = np.arange(len(parts.points), len(made.points), dtype=np.int32)
    return _made(make, made, result, new, np.arange(len(made.own)) >= len(parts.own))


def fillet_edges(mesh: Any, edges: npt.ArrayLike | None = None, *, width: float, **options: Any) -> Made[FilletResult]:
    """Round edges of a mesh: what lies within ``width`` of them becomes the fairest surface.

    Faces that the fillet cuts become triangles; the others keep their order. Data at vertices is mixed from the corners
    of the old triangle that a new vertex lies on, that of faces comes from the old face. The numbers of the result are
    those of the old vertices and, behind them, the new ones; the mesh has them in this order without the old ones that
    no face uses any more. Errors are those of :func:`fairing.fillet`.

    Parameters
    ----------
    mesh
        As for :func:`fair_faces`.
    edges : (e, 2) int
        Default: all hard edges (:func:`fairing.hard_edges`).
    width : float
        How far the fillet reaches on either side.
    options
        Those of :func:`fairing.fillet`.
    """
    parts, make = opened(mesh)
    seam = None if edges is None else parts.same[arguments.integers("edges", edges, 2)]
    if (parts.faces.sizes > 3).any():
        options.setdefault("neighbours", _edges(parts, np.ones(len(parts.faces.sizes), dtype=bool)))
    result = fillet(parts.points, parts.triangles, seam, width=width, **options)
    made, kept = rounded(parts, result)
    new = np.arange(kept, len(made.points), dtype=np.int32)
    return _made(make, made, result, new, np.isin(made.own, new).any(axis=1))


def _wound_alike(parts: Parts) -> tuple[Parts, tuple[Diagnostic, ...]]:
    """The same with faces turned that are wound against most of their piece, and what to say of it."""
    sound = np.flatnonzero(parts.sound)
    turned = sound[_core.turned_triangles(parts.triangles[sound], len(parts.points))]
    faces = np.unique(parts.faces.face_of[turned])
    if not len(faces):
        return parts, ()
    text = f"{len(faces)} faces faced the other way than the rest and were flipped"
    said = Diagnostic("INCONSISTENT_WINDING", text, turned.astype(np.int32), "triangle", {"faces": float(len(faces))})
    return replace(parts, faces=parts.faces.turned(faces)), (said,)


def _edges(parts: Parts, faces: npt.NDArray[np.bool_]) -> IntArray:
    """(e, 2) the edges of some faces, those between two of them once."""
    return np.unique(np.sort(parts.same[parts.faces.sides(faces)], axis=1), axis=0)


def _selection(selected: Any, parts: Parts) -> IntArray:
    """The numbers of the selected faces."""
    if isinstance(selected, str):
        if selected not in parts.face_data:
            raise ValueError(f"selected: no data at faces is called {selected!r}; there are {sorted(parts.face_data)}")
        selected = np.asarray(parts.face_data[selected]) != 0
    array, count = np.asarray(selected), len(parts.faces.sizes)
    if array.dtype == bool:
        if array.shape != (count,):
            raise ValueError(f"selected: a mask of {count} faces is needed, not one of shape {array.shape}")
        array = np.flatnonzero(array)
    faces = arguments.rows_within("selected", array, count, "face")
    if not len(faces):
        raise ValueError("selected: no face is selected")
    return faces


def _made(make: Callable[[Parts], Any], made: Parts, result: Any, moved: IntArray, new: npt.NDArray[Any]) -> Made[Any]:
    """The new mesh; ``new``: its new triangles. Where these cross others is reported: the engine doesn't see it."""
    crossing = self_intersections(made.points, made.own, near=np.flatnonzero(new))
    if len(crossing) and not any(warning.code == "SELF_INTERSECTION" for warning in result.warnings):
        text = f"{len(crossing)} triangles cross: the surface passes through other faces of the mesh"
        found = Diagnostic("SELF_INTERSECTION", text, crossing, "triangle", {"others": float(len(crossing))})
        result = replace(result, warnings=(*result.warnings, found))
    call = {"FairResult": "fair_faces", "FillResult": "fill_holes"}.get(type(result).__name__, "fillet_edges")
    log.info("%s: %d vertices, %s, %.2f s", call, len(moved), result.termination, result.seconds["total"])
    for warning, count in once(result.warnings):
        log.warning("%s: %s: %s%s", call, warning.code, warning.message, f" ({count} times)" if count > 1 else "")
    return Made(make(with_normals(made, moved)), result)


def once(found: Iterable[Diagnostic]) -> list[tuple[Diagnostic, int]]:
    """Diagnostics that differ in figures alone as the first of them, and how many there are."""
    alike: dict[tuple[str, str], list[Diagnostic]] = {}
    for each in found:
        alike.setdefault((each.code, re.sub(r"[-\d.,]+", "#", each.message)), []).append(each)
    return [(group[0], len(group)) for group in alike.values()]
