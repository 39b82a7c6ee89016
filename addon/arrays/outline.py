"""What is odd about a selection's boundary, reported before and after fairing. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..words.words import said
from .places import area_vectors, sum_at, unit
from .region import MeshArrays, fins, vertices_of
from .types import Floats, Ints, Mask

SHARP = 60.0  # degrees between two faces at the boundary that are reported
COARSE = 1e-3  # of an edge: steps between neighbouring coordinates that are reported
FOLDED = 150.0  # degrees between two faces around the boundary that lie on each other


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


def turns(mesh: MeshArrays, sides: Sides) -> Floats:
    """Return (k,): degrees between the two faces' normals, windings made alike; 0 without area."""
    faces, at = np.unique(sides.faces, return_inverse=True)
    normals = face_normals(mesh, faces)[at.reshape(-1, 2)]
    normals[sides.alike, 1] *= -1.0
    cosines = (normals[:, 0] * normals[:, 1]).sum(axis=1)
    known = (np.abs(normals).sum(axis=2) > 0.0).all(axis=1)
    angles: Floats = np.where(known, np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0))), 0.0)
    return angles


def edges_of(mesh: MeshArrays, faces: Mask) -> Mask:
    """Return the (e,) mask of the edges of the faces in a mask (f,)."""
    edges = np.zeros(len(mesh.edges), dtype=bool)
    edges[mesh.corner_edges[faces[mesh.corner_faces]]] = True
    return edges


def outline_edges(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of the edges between the patch and faces outside it."""
    between: Mask = edges_of(mesh, mesh.in_patch) & edges_of(mesh, ~mesh.in_patch)
    return between


def outline_notes(mesh: MeshArrays, inward: Ints | None = None) -> tuple[str, ...]:
    """Return one sentence for each thing that may surprise about the boundary of the patch.

    mesh: in world space, as angles there are what counts; inward: vertices with the slope of the selected faces, None
    where there are none.
    """
    outline = outline_edges(mesh)
    sides = two_sided_edges(mesh, outline)
    found = (
        _sharp_note(mesh, sides, inward),
        _winding_note(sides),
        _folded_note(mesh, outline),
        _lone_face_note(mesh, outline),
        _seam_note(mesh),
        _fin_note(mesh),
    )
    return tuple(note for note in found if note)


def _sharp_note(mesh: MeshArrays, sides: Sides, inward: Ints | None) -> str:
    outward = ~np.isin(mesh.edges[sides.edges], [] if inward is None else inward).any(axis=1)
    widest = turns(mesh, sides)[outward].max(initial=0.0)
    if widest < SHARP:
        return ""
    return said("along_edge", degrees=widest)


def _winding_note(sides: Sides) -> str:
    count = int(np.count_nonzero(sides.alike))
    return said("wound_against", n=count) if count else ""


def _folded_note(mesh: MeshArrays, outline: Mask) -> str:
    """Report outside faces at the boundary that lie on each other."""
    ends = np.zeros(len(mesh.positions), dtype=bool)
    ends[mesh.edges[outline]] = True
    sides = two_sided_edges(mesh, ends[mesh.edges].any(axis=1))
    outside = ~mesh.in_patch[sides.faces].any(axis=1)
    widest = turns(mesh, sides)[outside].max(initial=0.0)
    if widest < FOLDED:
        return ""
    return said("folded_around", degrees=widest)


def _lone_face_note(mesh: MeshArrays, outline: Mask) -> str:
    """Report single unselected faces: a boundary of one face has one face's normal all around."""
    outer = ~mesh.in_patch[mesh.corner_faces]
    beside = np.zeros(len(mesh.in_patch), dtype=bool)
    beside[mesh.corner_faces[outer]] = True
    beside[mesh.corner_faces[outer & ~outline[mesh.corner_edges]]] = False
    alone = int(np.count_nonzero(beside))
    return said("lone_faces", n=alone) if alone else ""


def _seam_note(mesh: MeshArrays) -> str:
    """Report open borders inside the patch that lie on each other: the surface is held there."""
    single = np.bincount(mesh.corner_edges, minlength=len(mesh.edges)) == 1
    if not single.any():
        return ""
    border = np.zeros(len(mesh.positions), dtype=bool)
    border[mesh.edges[single]] = True
    places = mesh.positions[border & vertices_of(mesh, mesh.in_patch)]
    doubled = len(places) - len(np.unique(places, axis=0))
    return said("open_seam", n=doubled) if doubled else ""


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
    outline = outline_edges(mesh)
    sides = two_sided_edges(mesh, outline)
    wrong = np.zeros(len(mesh.positions), dtype=bool)
    right = wrong.copy()
    wrong[mesh.edges[sides.edges[sides.alike]]] = True
    right[mesh.edges[sides.edges[~sides.alike]]] = True
    return wrong & ~right
