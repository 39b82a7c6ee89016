"""Hard edges that run through the selection, and become fair themselves. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import fairing

from ..arrays.around import nearby
from ..arrays.boundary import edges_inside
from ..arrays.places import numbers_in
from ..arrays.region import MeshArrays, free_vertices, nothing
from ..arrays.types import Floats, Ints, Mask
from ..options.options import FairOptions
from .memory import EDGES, digest, memory

ALONG = 5  # edges beyond the boundary that tell where a hard edge goes
_COMPARED = 3  # rings around an edge that tell what the mesh bends there anyway


def with_pinned_edges(mesh: MeshArrays, options: FairOptions, marked: Mask) -> MeshArrays:
    """Return the mesh with the edges that the options hold; marked: the (e,) mask of those that `pin_edges` names."""
    if not options.pins_running_through:
        return _pinned(replace(mesh, hard=mesh.sharp if options.pins_sharp else None), options, marked, none(mesh))
    hard = _known_by_angle(mesh) if options.finds_edges else none(mesh)
    sharp = none(mesh) if mesh.sharp is None else mesh.sharp
    found = replace(mesh, hard=hard | sharp if (hard | sharp).any() else None)
    held = _pinned(found, options, running_through(found), sharp)
    return held if held.held_by_angle is None or free_vertices(held).any() else released(held)


def released(mesh: MeshArrays) -> MeshArrays:
    """Return the mesh without edges that are held for their angle alone."""
    if mesh.held_by_angle is None:
        return mesh
    creases, curves = (
        None if edges is None or mesh.sharp is None else edges & mesh.sharp
        for edges in (mesh.creases, mesh.smooth_curves)
    )
    pinned = mesh.pinned & ~mesh.held_by_angle
    return replace(mesh, pinned=pinned, creases=creases, smooth_curves=curves, hard=mesh.sharp, held_by_angle=None)


def _pinned(mesh: MeshArrays, options: FairOptions, edges: Mask, sharp: Mask) -> MeshArrays:
    """Return the mesh with these edges held; sharp: (e,) those that are held whatever becomes of the others."""
    pinned, by_angle = mesh.pinned.copy(), np.zeros(len(mesh.pinned), dtype=bool)
    pinned[mesh.edges[edges]] = True
    curves = edges
    if options.pins_running_through and mesh.hard is not None:
        by_angle[mesh.edges[edges & ~sharp]] = True
        by_angle[mesh.edges[edges & sharp]] = False
        curves = edges | (mesh.hard & _beyond(mesh))  # no fit looks across them
    slope = options.slope_at_pinned_edges
    return replace(
        mesh,
        pinned=pinned,
        creases=curves if slope == "CREASE" and curves.any() else None,
        smooth_curves=curves if slope == "SMOOTH" and curves.any() else None,
        held_by_angle=by_angle & ~mesh.pinned if by_angle.any() else None,
    )


def none(mesh: MeshArrays) -> Mask:
    """Return an (e,) mask of no edge."""
    return np.zeros(len(mesh.edges), dtype=bool)


def _known_by_angle(mesh: MeshArrays) -> Mask:
    """Return what `_hard_by_angle` does, at once for a mesh that was asked about just before."""
    key = digest(mesh.positions, mesh.edges, mesh.triangles, mesh.triangle_faces, mesh.in_patch)
    known: Mask | None = memory.get(EDGES, key)  # every change in the redo panel reads the same meshes again
    if known is None:
        known = _hard_by_angle(mesh)
        memory.put(EDGES, key, known)
    return known


def _hard_by_angle(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of edges that are hard by their angle: near the patch, and of it those where they run on.

    None where they don't.
    """
    if not mesh.in_patch.any():
        return none(mesh)
    own = mesh.in_patch[mesh.triangle_faces]
    finite = np.isfinite(mesh.positions)
    known = np.ones(len(own), dtype=bool) if finite.all() else finite.all(axis=1)[mesh.triangles].all(axis=1)
    start = np.zeros(len(mesh.positions), dtype=bool)
    start[mesh.triangles[own]] = True
    outside = nearby(mesh.triangles[known & ~own], start, ALONG + _COMPARED)
    triangles = np.concatenate([mesh.triangles[own & known], outside])
    used = np.flatnonzero(np.bincount(triangles.ravel()))
    number = numbers_in(used, len(mesh.positions))
    numbered, inside = number[triangles], len(triangles) - len(outside)
    first, second = number[mesh.edges].T
    edges = np.flatnonzero((first >= 0) & (second >= 0))
    ends = np.column_stack([np.minimum(first, second)[edges], np.maximum(first, second)[edges]])
    hard = none(mesh)
    try:
        found = fairing.edges_through(mesh.positions[used], numbered[:inside], numbered[inside:], neighbours=ends)
    except fairing.MeshError:  # the patch has no boundary loop: its solve says why, with the mesh's own numbers
        return hard
    if len(found.edges):
        wanted = {tuple(pair) for pair in np.concatenate([found.edges, found.onward]).tolist()}
        hard[edges] = [tuple(pair) in wanted for pair in ends.tolist()]
    return hard


def _faired(mesh: MeshArrays, reference: Floats | None = None) -> tuple[Ints, fairing.results.FairEdges | None]:
    """Return which vertices of the mesh the hard edges have (q,), and these edges as fair curves."""
    if mesh.hard is None:
        return nothing(), None
    inside = edges_inside(mesh)
    inner, onward = mesh.edges[mesh.hard & inside], mesh.edges[mesh.hard & ~inside]
    finite = np.isfinite(mesh.positions[onward]).all(axis=(1, 2))
    pairs = np.concatenate([inner, onward[finite]])
    used, numbered = np.unique(pairs, return_inverse=True)
    numbered = numbered.reshape(-1, 2)
    shares = None if reference is None else reference[used]
    return used, fairing.fair_edges(
        mesh.positions[used], numbered[: len(inner)], numbered[len(inner) :], reference=shares
    )  # fmt: skip


def faired_curves(mesh: MeshArrays, reference: Floats | None = None) -> tuple[Ints, Floats]:
    """Return which vertices (k,) of hard edges inside the patch move, ascending, and where to (k, 3).

    Those move that run through between hard edges outside. reference: (n, 3) positions, whose shares of an edge's
    length its vertices keep; None: the mesh's own.
    """
    used, result = _faired(mesh, reference)
    if result is None:
        return used, np.empty((0, 3))
    return used[result.moved].astype(np.int64), result.vertices[result.moved]


def running_through(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of the hard edges inside the patch that run through between hard edges outside."""
    found = none(mesh)
    used, result = _faired(mesh)
    if mesh.hard is None or result is None or not result.curves:
        return found
    pairs = np.concatenate([np.column_stack([curve[:-1], curve[1:]]) for curve in result.curves])
    wanted = {tuple(pair) for pair in np.sort(used[pairs], axis=1).tolist()}
    hard = np.flatnonzero(mesh.hard)
    ends = np.sort(mesh.edges[hard], axis=1).tolist()
    found[hard[[tuple(pair) in wanted for pair in ends]]] = True
    return found


def _beyond(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of edges without a face of the patch."""
    outside = np.ones(len(mesh.edges), dtype=bool)
    outside[mesh.corner_edges[mesh.in_patch[mesh.corner_faces]]] = False
    return outside
