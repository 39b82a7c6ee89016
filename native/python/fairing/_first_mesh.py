"""The mesh that a fillet's new one begins with: the pieces of the old one, without what booleans leave.

Triangles of nearly no area stop all moves of a mesh that is made even, and places that no shortest way enters look as
if they were outside.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _seams
from fairing._measure import boundary_loops
from fairing._types import FloatArray, IntArray

_TINY = 0.02  # of the spacing: edges that short are closed
_SLIVER = 0.1  # of the spacing: lower triangles would stay as low between edges that stay
_SHORT = 0.5  # of the spacing: edges of seams that short are closed; the new mesh would be as fine
_MOST = 200  # triangles of a speck

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class FirstMesh:
    """p triangles within the fillet."""

    triangles: IntArray
    """(p, 3)"""
    parents: IntArray
    """(p,) old triangles that they lie on,"""
    weights: FloatArray
    """(p, 3, 3) and where their corners lie there."""
    lines: IntArray
    """(l, 2) edges of seams that the new mesh begins with."""


def without_specks(cut: dict[str, Any], placed: FloatArray, spacing: float) -> Mask:
    """Which triangles are within the fillet, with those outside that one new edge would span in all directions."""
    inside: Mask = cut["inside"].copy()
    triangles = cut["triangles"]
    small = [loop for loop in boundary_loops(triangles[inside]) if np.ptp(placed[loop], axis=0).max() < spacing]
    if not small:
        return inside
    sides = {pair: row for row in np.flatnonzero(~inside).tolist() for pair in _sides(triangles[row].tolist())}
    for loop in small:
        ends = np.roll(loop, -1).tolist()
        found = {
            sides[pair] for a, b in zip(loop.tolist(), ends, strict=True) for pair in ((a, b), (b, a)) if pair in sides
        }
        waiting = list(found)
        while waiting and len(found) <= _MOST:
            row = waiting.pop()
            beside = [sides[b, a] for a, b in _sides(triangles[row].tolist()) if (b, a) in sides]
            waiting += [other for other in beside if other not in found]
            found.update(beside)
        rows = sorted(found)
        if len(rows) <= _MOST and rows and np.ptp(placed[triangles[rows].ravel()], axis=0).max() < spacing:
            inside[rows] = True
    return inside


def _sides(corners: list[int]) -> list[tuple[int, int]]:
    a, b, c = corners
    return [(a, b), (b, c), (c, a)]


def first_mesh(cut: dict[str, Any], placed: FloatArray, spacing: float) -> FirstMesh:
    """Make it; the boundary's edges stay."""
    whole = np.flatnonzero(cut["inside"])
    triangles = np.ascontiguousarray(cut["triangles"][whole])
    weights, parents = cut["weights"].reshape(-1, 3, 3)[whole], cut["parent"][whole]
    lines = cut["seams"]
    edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    tiny = edges[np.linalg.norm(placed[edges[:, 0]] - placed[edges[:, 1]], axis=1) < _TINY * spacing]
    rim = np.concatenate(boundary_loops(triangles))
    for short in (np.concatenate([tiny, lines]), tiny):
        merged = _merged(short, placed, (rim, lines), _SHORT * spacing)
        closed = merged[triangles]
        stays = (closed != np.roll(closed, 1, axis=1)).all(axis=1)
        closed = np.ascontiguousarray(closed[stays], dtype=np.int32)
        if _is_like(closed, triangles):
            ends = merged[lines]
            lines = np.unique(np.sort(ends[ends[:, 0] != ends[:, 1]], axis=1), axis=0).astype(np.int32)
            triangles, weights, parents = closed, weights[stays], parents[stays]
            break
    return FirstMesh(triangles, parents, weights, _between(lines, triangles, placed, _SLIVER * spacing))


def _merged(
    lines: IntArray, placed: FloatArray, held: tuple[IntArray, IntArray], least: float
) -> npt.NDArray[np.int64]:
    """(n,) the vertex that each becomes where edges shorter than that are closed.

    ``held``: the boundary's vertices, and edges of seams. Those of the boundary stay, and where seams branch.
    """
    stays = np.zeros(len(placed), dtype=bool)
    stays[held[0]] = True
    stays[np.bincount(held[1].ravel(), minlength=len(placed)) > 2] = True
    merged = np.arange(len(placed))

    def top(vertex: int) -> int:
        while merged[vertex] != vertex:
            vertex = int(merged[vertex])
        return vertex

    lengths = np.linalg.norm(placed[lines[:, 0]] - placed[lines[:, 1]], axis=1)
    short = np.flatnonzero(lengths < least)
    for k in short[np.argsort(lengths[short], kind="stable")].tolist():
        a, b = top(int(lines[k, 0])), top(int(lines[k, 1]))
        if a == b or (stays[a] and stays[b]) or np.linalg.norm(placed[a] - placed[b]) >= least:
            continue
        merged[a if stays[b] else b] = b if stays[b] else a
    return np.array([top(vertex) for vertex in range(len(placed))]) if len(short) else merged


def _is_like(closed: IntArray, triangles: IntArray) -> bool:
    """Whether no side is there twice, and the boundary loops and Euler's number are still those of all triangles."""
    sides = closed[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    keys = np.sort(sides[:, 0] * _seams.LARGE + sides[:, 1])
    if (keys[1:] == keys[:-1]).any():
        return False
    return _euler(closed) == _euler(triangles) and len(boundary_loops(closed)) == len(boundary_loops(triangles))


def _euler(triangles: IntArray) -> int:
    sides = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    return len(np.unique(triangles)) - len(np.unique(_seams.keys_of(sides))) + len(triangles)


def _between(lines: IntArray, triangles: IntArray, placed: FloatArray, least: float) -> IntArray:
    """Those that are edges of two triangles, both of them higher than ``least``."""
    corners = placed[triangles]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    sides = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    lengths = np.linalg.norm(placed[sides[:, 0]] - placed[sides[:, 1]], axis=1)
    high = np.repeat(areas, 3) > least * lengths
    known, uses = np.unique(_seams.keys_of(sides[high]), return_counts=True)
    inner: IntArray = np.ascontiguousarray(lines[np.isin(_seams.keys_of(lines), known[uses == 2])], dtype=np.int32)
    return inner
