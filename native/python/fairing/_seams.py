"""Seams, walls and widths of fillets: checked."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._hard_edges import hard_edges
from fairing._types import Diagnostic, FloatArray, IntArray, MeshError

LARGE = 2**31  # above all vertices


def check_finite(points: FloatArray, faces: IntArray) -> None:
    used = np.unique(faces)
    bad = used[~np.isfinite(points[used]).all(axis=1)]
    if len(bad):
        text = f"vertices: {len(bad)} of them are NaN or infinite, first {bad[0]}"
        raise MeshError(Diagnostic("NONFINITE", text, bad.astype(np.int32), "vertex", {"vertices": float(len(bad))}))


def seams_and_walls(points: FloatArray, faces: IntArray, seam: Any, walls: Any) -> tuple[IntArray, IntArray]:
    """Both (e, 2), checked."""
    needs_hard = seam is None or walls is None
    hard = hard_edges(points, faces) if needs_hard else _arguments.NO_EDGES
    seams = hard if seam is None else _arguments.edges_of("seam", seam, faces)
    if not len(seams):
        what = "the mesh has no hard edges" if seam is None else "it has no edges"
        text = f"seam: {what}: select the edges that are to be rounded"
        raise MeshError(Diagnostic("NO_SEAM", text, np.empty(0, np.int32), "vertex", {}))
    _check_sides(seams, faces)
    ends = hard if walls is None else _arguments.edges_of("walls", walls, faces)
    return seams, ends[~np.isin(keys_of(ends), keys_of(seams))]


def keys_of(edges: IntArray) -> npt.NDArray[np.int64]:
    ends = np.sort(edges.astype(np.int64).reshape(-1, 2), axis=1)
    keys: npt.NDArray[np.int64] = ends[:, 0] * LARGE + ends[:, 1]
    return keys


def refuse_vertices_on_edges(points: FloatArray, faces: IntArray, parent: IntArray) -> None:
    """MeshError where border vertices of triangles that a cut changes lie on the border's edges."""
    edges, uses = np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0, return_counts=True)
    border = edges[uses == 1]
    on_edges = _core.touching_edges(border, points)[0] if len(border) else border
    changed = faces[np.bincount(parent, minlength=len(faces)) > 1]
    found = on_edges[np.isin(on_edges, changed).any(axis=1)]
    if len(found):
        a, b, vertex = found[0].tolist()
        text = f"vertex {vertex} lies on the border edge {a}-{b}: dissolve it, or split that edge there and merge"
        figures = {"on_edge" if len(found) == 1 else "on_edges": float(len(found))}
        raise MeshError(Diagnostic("NONMANIFOLD_VERTEX", text, found.ravel().astype(np.int32), "vertex", figures))


def _check_sides(seams: IntArray, faces: IntArray) -> None:
    """MeshError where a seam has not one triangle on either side."""
    tails = np.concatenate([faces[:, k] for k in range(3)]).astype(np.int64)
    heads = np.concatenate([faces[:, (k + 1) % 3] for k in range(3)]).astype(np.int64)
    wanted = keys_of(seams)
    sides = np.minimum(tails, heads) * LARGE + np.maximum(tails, heads)
    known, place = np.unique(wanted, return_inverse=True)
    at = np.searchsorted(known, sides)
    hit = known[np.minimum(at, len(known) - 1)] == sides
    both = np.bincount(at[hit], minlength=len(known))[place]
    upward = np.bincount(at[hit & (tails < heads)], minlength=len(known))[place]
    cases = (
        (both > 2, "NONMANIFOLD_EDGE", "have three triangles and more: take the seam apart, or leave these edges out"),
        (both < 2, "SEAM_ON_BORDER", "lie on an open border, with nothing to round on the other side: leave them out"),
        (
            upward != 1,
            "INCONSISTENT_WINDING",
            "lie between triangles wound against each other: recalculate the normals",
        ),
    )
    for bad, code, what in cases:
        if bad.any():
            where = np.unique(seams[bad]).astype(np.int32)
            text = f"seam: {int(bad.sum())} of its edges {what}"
            raise MeshError(Diagnostic(code, text, where, "vertex", {"edges": float(bad.sum())}))


def width_of(name: str, value: Any, seams: IntArray, count: int) -> FloatArray:
    """(n,) positive at the seams."""
    if value is None:
        return np.zeros(count)
    if np.ndim(value) == 0:
        return np.full(count, _arguments.positive(name, value))
    array = np.asarray(value, dtype=np.float64)
    if array.shape != (count,):
        raise ValueError(
            f"{name}: a length, or one for each of the {count} vertices, is needed, not shape {array.shape}"
        )
    at = array[seams]
    if not (np.isfinite(at) & (at > 0)).all():
        raise ValueError(f"{name}: a positive length is needed at each vertex of the seams")
    return np.where(np.isfinite(array), array, 0.0)
