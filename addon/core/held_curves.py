"""Edges marked sharp that run through the selection, and become fair themselves. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask
from .outline import edges_inside
from .region import MeshArrays, nothing

ALONG = 5  # edges beyond the outline that tell where a hard edge goes


def _faired(mesh: MeshArrays, reference: Floats | None = None) -> tuple[Ints, fairing.FairEdges | None]:
    """Return which vertices of the mesh the marked edges have (q,), and these edges as fair curves."""
    if mesh.sharp is None:
        return nothing(), None
    inside = edges_inside(mesh)
    inner, onward = mesh.edges[mesh.sharp & inside], mesh.edges[mesh.sharp & ~inside]
    finite = np.isfinite(mesh.positions[onward]).all(axis=(1, 2))
    pairs = np.concatenate([inner, onward[finite]])
    used, numbered = np.unique(pairs, return_inverse=True)
    numbered = numbered.reshape(-1, 2)
    shares = None if reference is None else reference[used]
    return used, fairing.fair_edges(
        mesh.positions[used], numbered[: len(inner)], numbered[len(inner) :], reference=shares
    )  # fmt: skip


def faired_curves(mesh: MeshArrays, reference: Floats | None = None) -> tuple[Ints, Floats]:
    """Return which vertices (k,) of marked edges inside the patch move, ascending, and where to (k, 3).

    Those move that run through between marked edges outside. reference: (n, 3) positions, whose shares of an edge's
    length its vertices keep; None: the mesh's own.
    """
    used, result = _faired(mesh, reference)
    if result is None:
        return used, np.empty((0, 3))
    return used[result.moved].astype(np.int64), result.vertices[result.moved]


def running_through(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of the marked edges inside the patch that run through between marked edges outside."""
    found = np.zeros(len(mesh.edges), dtype=bool)
    used, result = _faired(mesh)
    if mesh.sharp is None or result is None or not result.curves:
        return found
    pairs = np.concatenate([np.column_stack([curve[:-1], curve[1:]]) for curve in result.curves])
    wanted = {tuple(pair) for pair in np.sort(used[pairs], axis=1).tolist()}
    marked = np.flatnonzero(mesh.sharp)
    ends = np.sort(mesh.edges[marked], axis=1).tolist()
    found[marked[[tuple(pair) in wanted for pair in ends]]] = True
    return found


def beyond(mesh: MeshArrays) -> Mask:
    """Return the (e,) mask of edges without a face of the patch."""
    outside = np.ones(len(mesh.edges), dtype=bool)
    outside[mesh.corner_edges[mesh.in_patch[mesh.corner_faces]]] = False
    return outside
