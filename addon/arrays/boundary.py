"""What is odd about a selection's boundary, reported before and after fairing. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..words.words import said
from .places import area_vectors, sum_at, unit
from .region import MeshArrays, fins
from .types import Floats, Ints, Mask

COARSE = 1e-3  # of an edge: steps between neighbouring coordinates that are reported


@dataclass(frozen=True)
class Sides:
    """Edges with exactly two faces: k of them."""

    edges: Ints  # (k,)
    faces: Ints  # (k, 2)
    alike: Mask  # (k,) both faces run along the edge in the same direction: one is turned over


def two_sided_edges(mesh: MeshArrays, wanted: Mask) -> Sides:
    """Return those of the (e,) mask of edges that have exactly two faces."""
    corners = np.flatnonzero(wanted[mesh.corner_edges])
    corners = corners[np.argsort(mesh.corner_edges[corners], kind="stable")]
    edges, starts, counts = np.unique(mesh.corner_edges[corners], return_index=True, return_counts=True)
    pairs = corners[starts[counts == 2][:, None] + np.arange(2)]
    origins = mesh.corner_vertices[pairs]
    return Sides(edges[counts == 2], mesh.corner_faces[pairs], origins[:, 0] == origins[:, 1])


def edges_inside(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of edges between two faces of the patch."""
    sides = two_sided_edges(mesh, np.ones(len(mesh.edges), dtype=bool))
    inside = np.zeros(len(mesh.edges), dtype=bool)
    inside[sides.edges] = mesh.in_patch[sides.faces].all(axis=1)
    return inside


def face_normals(mesh: MeshArrays, faces: Ints) -> Floats:
    """Return the (k, 3) unit normals of the faces (k,); zero where a face has no area."""
    used = np.isin(mesh.triangle_faces, faces)
    vectors = area_vectors(mesh.positions, mesh.triangles[used])
    return unit(sum_at(np.searchsorted(faces, mesh.triangle_faces[used]), vectors, len(faces)))


def edges_of(mesh: MeshArrays, faces: Mask) -> Mask:
    """Return the (e,) mask of the edges of the faces in a mask (f,)."""
    edges = np.zeros(len(mesh.edges), dtype=bool)
    edges[mesh.corner_edges[faces[mesh.corner_faces]]] = True
    return edges


def boundary_edges(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of the edges between the patch and faces outside it."""
    between: Mask = edges_of(mesh, mesh.in_patch) & edges_of(mesh, ~mesh.in_patch)
    return between


def boundary_notes(mesh: MeshArrays) -> tuple[str, ...]:
    """Return one sentence for each thing that may surprise about the boundary of the patch."""
    found = (_winding_note(two_sided_edges(mesh, boundary_edges(mesh))), _fin_note(mesh))
    return tuple(note for note in found if note)


def _winding_note(sides: Sides) -> str:
    count = int(np.count_nonzero(sides.alike))
    return said("wound_against", n=count) if count else ""


def _fin_note(mesh: MeshArrays) -> str:
    count = int(np.count_nonzero(fins(mesh)))
    return said("fins", n=count) if count else ""


def precision_note(mesh: MeshArrays) -> str:
    """Report where float32, in which Blender stores the mesh's own coordinates, is too coarse for the patch."""
    used = np.zeros(len(mesh.edges), dtype=bool)
    used[mesh.corner_edges[mesh.in_patch[mesh.corner_faces]]] = True
    ends = mesh.positions[mesh.edges[used]]
    spacing = float(np.spacing(np.abs(ends).max(initial=0.0).astype(np.float32)))
    edge = float(np.median(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1))) if len(ends) else 0.0
    if spacing <= COARSE * edge:
        return ""
    return said("coarse", spacing=spacing, edge=edge)


def turned_over(mesh: MeshArrays) -> Mask:
    """Return the (n,) mask of boundary vertices whose faces outside are wound against the patch."""
    boundary = boundary_edges(mesh)
    sides = two_sided_edges(mesh, boundary)
    wrong = np.zeros(len(mesh.positions), dtype=bool)
    right = wrong.copy()
    wrong[mesh.edges[sides.edges[sides.alike]]] = True
    right[mesh.edges[sides.edges[~sides.alike]]] = True
    return wrong & ~right
