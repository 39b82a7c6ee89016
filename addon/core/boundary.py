"""Normals along the boundary: what the fair surface has to be tangent to."""

from __future__ import annotations

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask
from .outline import face_normals, turned_over
from .region import MeshArrays, Patch
from .vectors import sum_at, unit
from .words import counted


def average_normals(mesh: MeshArrays, at: Ints) -> Floats:
    """Return (k, 3): the normalised mean of the unit normals of the faces at each of the vertices (k,)."""
    asked = np.zeros(len(mesh.positions), dtype=bool)
    asked[at] = True
    corners = np.flatnonzero(asked[mesh.corner_vertices])
    faces = np.unique(mesh.corner_faces[corners])
    normals = face_normals(mesh, faces)
    normals[~np.isfinite(normals).all(axis=1)] = 0.0
    at_corners = normals[np.searchsorted(faces, mesh.corner_faces[corners])]
    return unit(sum_at(mesh.corner_vertices[corners], at_corners, len(mesh.positions))[at])


def custom_normals(mesh: MeshArrays) -> Floats:
    """Return (n, 3): the normalised mean of each vertex's corner normals."""
    if mesh.corner_normals is None:
        raise ValueError("boundary_normals: the mesh was read without its corner normals")
    return unit(sum_at(mesh.corner_vertices, mesh.corner_normals, len(mesh.positions)))


def _fit_outside(mesh: MeshArrays, fixed: Ints, outside: Ints) -> tuple[fairing.SurroundingNormals | None, Mask]:
    """Fit surfaces at those of the `fixed` vertices (mesh indices, k) that have triangles outside: the mask (k,)."""
    touched = np.zeros(len(mesh.positions), dtype=bool)
    touched[outside] = True
    found = touched[fixed]
    if not found.any():
        return None, found
    used, triangles = np.unique(outside, return_inverse=True)
    at = np.searchsorted(used, fixed[found])
    faces = triangles.reshape(-1, 3).astype(np.int64)
    return fairing.surrounding_normals(mesh.positions[used], faces, at, creases=_creases(mesh, used)), found


def _creases(mesh: MeshArrays, used: Ints) -> Ints:
    """Return the (c, 2) creases between vertices `used` (ascending), in their numbers: no fit looks across."""
    if mesh.creases is None:
        return np.empty((0, 2), dtype=np.int64)
    edges = mesh.edges[mesh.creases]
    edges = edges[np.isin(edges, used).all(axis=1)]
    numbered: Ints = np.searchsorted(used, edges).astype(np.int64)
    return numbered


def surrounding_normals(mesh: MeshArrays, fixed: Ints, outside: Ints) -> tuple[Floats, Mask]:
    """Fit normals at the `fixed` vertices (mesh indices, k) to the triangles `outside` (o, 3) the patch.

    Returns ((k, 3) unit normals, (k,) mask of those that have triangles outside). The others take
    the average of all their faces. Where the faces outside are wound against the patch, their
    normals are turned round.
    """
    normals = average_normals(mesh, fixed)
    fits, found = _fit_outside(mesh, fixed, outside)
    if fits is None:
        return normals, found
    fitted = fits.normals
    # A zero normal is one that even the average of the outside faces leaves open.
    decided = np.linalg.norm(fitted, axis=1) > 0.5
    fitted = np.where(turned_over(mesh)[fixed[found], None], -fitted, fitted)
    normals[np.flatnonzero(found)[decided]] = fitted[decided]
    return normals, found


def prescribed_normals(mesh: MeshArrays, patch: Patch, source: str, outside: Ints) -> tuple[Floats, tuple[str, ...]]:
    """Return ((k, 3) unit normals in the order of `patch.fixed`, warnings).

    source: one of options.BOUNDARY_NORMALS; outside: as around.outside_triangles gives them.
    """
    fixed = patch.vertices[patch.fixed]
    if source == "CUSTOM":
        return custom_normals(mesh)[fixed], ()
    if source == "AVERAGE":
        return average_normals(mesh, fixed), ()
    normals, found = surrounding_normals(mesh, fixed, outside)
    alone = int(np.count_nonzero(~found & ~mesh.pinned[fixed]))
    if alone == 0:
        return normals, ()
    text = counted(
        alone,
        "border vertex has no faces outside: its normal comes from the patch",
        "border vertices have no faces outside: their normals come from the patch",
    )
    return normals, (text,)


def prescribed_curvatures(mesh: MeshArrays, patch: Patch, outside: Ints) -> Floats:
    """Return (k,) H of the triangles outside in the order of `patch.fixed`, NaN where they say too little about it."""
    fixed = patch.vertices[patch.fixed]
    curvatures = np.full(len(fixed), np.nan)
    fits, found = _fit_outside(mesh, fixed, outside)
    if fits is not None:
        curvatures[found] = np.where(turned_over(mesh)[fixed[found]], -1.0, 1.0) * fits.trusted_curvatures
    return curvatures
