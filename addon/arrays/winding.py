"""Faces of a patch that are wound against the others: they are turned on a copy, before anything reads a normal off."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import fairing

from ..words.words import said
from .region import MeshArrays, reversed_corners
from .types import Ints, Mask


def with_one_winding(mesh: MeshArrays) -> tuple[MeshArrays, int]:
    """Return the mesh with all faces of each connected part of the patch wound as most of them, and how many turned."""
    turned = _against_most(mesh)
    count = int(np.count_nonzero(turned))
    return (_turned(mesh, turned), count) if count else (mesh, 0)


def winding_note(turned: int) -> tuple[str, ...]:
    """Return the sentence on faces that were turned."""
    return (said("INCONSISTENT_WINDING", n=turned),) if turned else ()


def _against_most(mesh: MeshArrays) -> Mask:
    """Return the (f,) mask of faces wound against most of those that edges connect them with."""
    own = np.flatnonzero(mesh.in_patch[mesh.triangle_faces])
    corners = mesh.triangles[own]
    whole = own[(corners != np.roll(corners, 1, axis=1)).all(axis=1)]
    turned = whole[fairing._core.turned_triangles(mesh.triangles[whole], len(mesh.positions))]
    against = np.zeros(len(mesh.in_patch), dtype=bool)
    against[mesh.triangle_faces[turned]] = True
    return against


def _turned(mesh: MeshArrays, faces: Mask) -> MeshArrays:
    """Return the mesh with the faces in the (f,) mask wound the other way round."""
    backwards, along = reversed_corners(mesh.corner_faces)
    corners = np.arange(len(backwards))
    turned = faces[mesh.corner_faces]
    order: Ints = np.where(turned, backwards, corners)
    edges: Ints = np.where(turned, along, corners)
    triangles = mesh.triangles.copy()
    rows = faces[mesh.triangle_faces]
    triangles[rows] = triangles[rows, ::-1]
    normals = mesh.corner_normals
    return replace(
        mesh,
        corner_vertices=mesh.corner_vertices[order],
        corner_edges=mesh.corner_edges[edges],
        triangles=triangles,
        corner_normals=None if normals is None else np.where(turned[:, None], -normals, normals)[order],
    )
