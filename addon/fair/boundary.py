"""Normals along the boundary: what the fair surface has to be tangent to."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from ..arrays.boundary import face_normals, turned_over
from ..arrays.places import numbers_in, sum_at, unit
from ..arrays.region import MeshArrays, Patch
from ..arrays.types import Floats, Ints, Mask
from ..words.words import said

MOST_MARKED = 0.25  # of the edges around: importers mark nearly all of them, which sets none apart


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
        raise ValueError("boundary_normals: expected a mesh that was read with its corner normals")
    return unit(sum_at(mesh.corner_vertices, mesh.corner_normals, len(mesh.positions)))


@dataclass(frozen=True)
class Boundary:
    """What a surface has to be tangent to, in the order of `patch.fixed` (k,)."""

    normals: Floats  # (k, 3) unit
    curvatures: Floats  # (k,) H of the faces that count, NaN where they say too little about it
    from_inside: Mask  # (k,) where the slope is that of the selected faces
    notes: tuple[str, ...] = ()

    def inward(self, patch: Patch) -> Ints:
        """Return the mesh vertices whose slope is that of the selected faces, ascending."""
        chosen: Ints = patch.vertices[patch.fixed[self.from_inside]]
        return chosen


@dataclass(frozen=True)
class _Fits:
    """Fits at those of the fixed vertices that have triangles outside."""

    found: Mask  # (k,)
    fits: fairing.solving.surroundings.BoundaryNormals | None  # None where none has any


def boundary(mesh: MeshArrays, patch: Patch, source: str, outside: Ints) -> Boundary:
    """Return the boundary data of a patch.

    source: one of the choices of boundary_normals; outside: (o, 3) as around.outside_triangles gives them.
    """
    fixed = patch.vertices[patch.fixed]
    fitted = _fit(mesh, patch, _SIDES.get(source, "outside"), outside)
    from_inside, against = np.zeros(len(fixed), dtype=bool), np.zeros(len(fixed), dtype=bool)
    curvatures = np.full(len(fixed), np.nan)
    if fitted.fits is not None:
        from_inside[fitted.found] = fitted.fits.from_inside
        against = turned_over(mesh)[fixed] & ~from_inside
        curvatures[fitted.found] = fitted.fits.trusted_curvatures
        curvatures[against] *= -1.0
    if source == "CUSTOM":
        return Boundary(custom_normals(mesh)[fixed], curvatures, from_inside)
    if source == "AVERAGE":
        return Boundary(average_normals(mesh, fixed), curvatures, from_inside)
    normals, decided = np.zeros((len(fixed), 3)), np.zeros(len(fixed), dtype=bool)
    if fitted.fits is not None:
        normals[fitted.found] = np.where(against[fitted.found, None], -fitted.fits.normals, fitted.fits.normals)
        # A zero normal is one that even the average of the outside faces leaves open.
        decided = np.linalg.norm(normals, axis=1) > 0.5
    if not decided.all():
        normals[~decided] = average_normals(mesh, fixed)[~decided]
    return Boundary(normals, curvatures, from_inside, _notes(mesh, fixed, fitted.found, from_inside))


_SIDES = {"AUTOMATIC": "automatic", "INSIDE": "inside"}


def _fit(mesh: MeshArrays, patch: Patch, side: str, outside: Ints) -> _Fits:
    fixed = patch.vertices[patch.fixed]
    touched = np.zeros(len(mesh.positions), dtype=bool)
    touched[outside] = True
    found = touched[fixed]
    if not found.any():
        return _Fits(found, None)
    inside = patch.vertices[patch.triangles]
    used = np.unique(np.concatenate([inside.ravel(), outside.ravel()]))
    number = numbers_in(used, len(mesh.positions))
    fits = fairing.boundary_normals(
        mesh.positions[used], number[inside], number[fixed[found]], outside=number[outside], side=side,
        creases=hard_edges_of(mesh, used, number),
    )  # fmt: skip
    return _Fits(found, fits)


def hard_edges_of(mesh: MeshArrays, used: Ints, number: Ints) -> Ints:
    """Return (c, 2) edges between the vertices `used` that no fit looks across, in the numbers (n,).

    These are creases, and edges marked sharp unless that is said of most.
    """
    there = np.zeros(len(mesh.positions), dtype=bool)
    there[used] = True
    near = there[mesh.edges].all(axis=1)
    hard = np.zeros(len(mesh.edges), dtype=bool) if mesh.creases is None else near & mesh.creases
    if mesh.sharp is not None and np.count_nonzero(near & mesh.sharp) <= MOST_MARKED * np.count_nonzero(near):
        hard |= near & mesh.sharp
    numbered: Ints = number[mesh.edges[hard]]
    return numbered


def _notes(mesh: MeshArrays, fixed: Ints, found: Mask, from_inside: Mask) -> tuple[str, ...]:
    """Report where the slope is not that of the faces outside."""
    alone = int(np.count_nonzero(~found & ~mesh.pinned[fixed]))
    inward = int(np.count_nonzero(from_inside))
    notes = []
    if inward and inward == np.count_nonzero(found):
        notes.append(said("slope_from_selection"))
    elif inward:
        notes.append(said("slope_at_hard_edge", n=inward))
    if alone:
        notes.append(said("normal_from_patch", n=alone))
    return tuple(notes)
