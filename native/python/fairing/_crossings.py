"""Edges of a boundary that touch or cross each other, and vertices that lie on its edges or on each other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fairing._types import FloatArray, IntArray

_TOUCHING = 1e-9  # of the boundary's extent
_ON_EDGE = 1e-5  # of an edge: what single precision leaves where coordinates are as large as a hundred edges
_TINY = 1e-300


def crossing_edges(loops: Sequence[IntArray], vertices: FloatArray) -> IntArray:
    """(c, 4) vertices: the ends of two edges that meet, not at a vertex that both have."""
    return crossing(edges_around(loops), vertices)


def edges_around(loops: Sequence[IntArray]) -> IntArray:
    """(e, 2) the edges of loops, in their direction."""
    edges: IntArray = np.concatenate([np.column_stack([loop, np.roll(loop, -1)]) for loop in loops])
    return edges


def crossing(edges: IntArray, vertices: FloatArray) -> IntArray:
    """The same of edges (e, 2)."""
    slack = _TOUCHING * float(np.ptp(vertices[edges].reshape(-1, 3), axis=0).max())
    one, other = _near_pairs(vertices[edges], slack)
    apart = (edges[one][:, :, None] != edges[other][:, None]).all(axis=(1, 2))
    one, other = one[apart], other[apart]
    met = _distances(vertices[edges[one]], vertices[edges[other]]) <= slack
    found: IntArray = np.hstack([edges[one[met]], edges[other[met]]])
    return found


def are_clear(loops: Sequence[IntArray], vertices: FloatArray) -> bool:
    """Whether no loop by itself comes near itself: a quick look at many, which may say no where nothing is wrong."""
    edges = edges_around(loops)
    of = np.repeat(np.arange(len(loops)), [len(loop) for loop in loops])
    segments = vertices[edges]
    if not np.isfinite(segments).all():
        return False
    lengths = np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1)
    slack = max(_ON_EDGE * float(lengths.max()), _TOUCHING * float(np.ptp(segments.reshape(-1, 3), axis=0).max()))
    if not lengths.min() > slack:
        return False
    one, other = _near_pairs(segments, slack)
    same = of[one] == of[other]
    one, other = one[same], other[same]
    joined = (edges[one][:, :, None] == edges[other][:, None]).any(axis=(1, 2))
    if (_distances(segments[one[~joined]], segments[other[~joined]]) <= slack).any():
        return False
    beside = [(a, b, end) for a, b in ((one[joined], other[joined]), (other[joined], one[joined])) for end in (0, 1)]
    for at, of_ends, end in beside:  # the far end of the next edge
        ends = edges[of_ends, end]
        apart = (edges[at] != ends[:, None]).all(axis=1)
        if (_from_segment(vertices[ends[apart]], segments[at[apart]]) <= slack).any():
            return False
    return True


@dataclass(frozen=True)
class Touches:
    """Where vertices of a boundary lie on others of its edges or vertices."""

    on_edges: IntArray
    """(t, 3) the ends of an edge and a vertex that lies on it between them."""
    pairs: IntArray
    """(p, 2) vertices that lie on each other."""


def touches(loops: Sequence[IntArray], vertices: FloatArray) -> Touches:
    """Vertices nearer than 1e-5 of an edge to that edge, or to an end of it that no edge joins to them."""
    return touching(edges_around(loops), vertices)


def touching(edges: IntArray, vertices: FloatArray) -> Touches:
    """The same of edges (e, 2)."""
    segments = vertices[edges]
    slack = _ON_EDGE * float(np.linalg.norm(segments[:, 1] - segments[:, 0], axis=1).max())
    one, other = _near_pairs(segments, slack)
    at = np.concatenate([other, other, one, one])
    ends = np.concatenate([edges[one, 0], edges[one, 1], edges[other, 0], edges[other, 1]])
    apart = (edges[at] != ends[:, None]).all(axis=1)
    at, ends = at[apart], ends[apart]
    near = _ON_EDGE * np.linalg.norm(segments[at, 1] - segments[at, 0], axis=1)
    touching = _from_segment(vertices[ends], segments[at]) <= near
    ends, at, near = ends[touching], at[touching], near[touching]
    to_ends = np.linalg.norm(segments[at] - vertices[ends][:, None], axis=2)
    between = to_ends.min(axis=1) > 2.0 * near
    pairs = np.column_stack([ends, edges[at, to_ends.argmin(axis=1)]])[~between]
    on_edges = np.column_stack([np.sort(edges[at], axis=1), ends])[between]
    return Touches(np.unique(on_edges, axis=0), _not_joined(pairs, edges))


def _not_joined(pairs: IntArray, edges: IntArray) -> IntArray:
    """Pairs of vertices, each once, that are not the ends of one of the edges."""
    joined = {tuple(edge) for edge in np.sort(edges, axis=1).tolist()}
    found = [pair for pair in np.unique(np.sort(pairs, axis=1), axis=0).tolist() if tuple(pair) not in joined]
    return np.array(found, dtype=edges.dtype).reshape(-1, 2)


def _near_pairs(segments: FloatArray, slack: float) -> tuple[IntArray, IntArray]:
    """Pairs of segments (n, 2, 3) whose boxes meet."""
    low, high = segments.min(axis=1) - slack, segments.max(axis=1) + slack
    axis = int(np.argmax(np.ptp(low, axis=0)))
    order = np.argsort(low[:, axis], kind="stable")
    low, high = low[order], high[order]
    last = np.searchsorted(low[:, axis], high[:, axis], side="right")  # of those that begin before this one ends
    counts = last - np.arange(len(order)) - 1
    one = np.repeat(np.arange(len(order)), counts)
    other = one + 1 + np.arange(len(one)) - np.repeat(np.cumsum(counts) - counts, counts)
    meet = ((low[one] <= high[other]) & (low[other] <= high[one])).all(axis=1)
    return order[one[meet]], order[other[meet]]


def _distances(one: FloatArray, other: FloatArray) -> FloatArray:
    """Between segments (c, 2, 3) and (c, 2, 3): of inner points nearest to each other, and of ends from the other."""
    u, v, w = one[:, 1] - one[:, 0], other[:, 1] - other[:, 0], one[:, 0] - other[:, 0]
    uu, uv, vv = (u * u).sum(axis=1), (u * v).sum(axis=1), (v * v).sum(axis=1)
    uw, vw = (u * w).sum(axis=1), (v * w).sum(axis=1)
    size = uu * vv - uv * uv
    aslant = size > 1e-12 * uu * vv  # of parallel ones an end is among the nearest
    size = np.where(aslant, size, 1.0)
    s, t = (uv * vw - vv * uw) / size, (uu * vw - uv * uw) / size
    inner = aslant & (s >= 0) & (s <= 1) & (t >= 0) & (t <= 1)
    least = np.where(inner, np.linalg.norm(w + s[:, None] * u - t[:, None] * v, axis=1), np.inf)
    for points, segment in ((one, other), (other, one)):
        for end in (0, 1):
            least = np.minimum(least, _from_segment(points[:, end], segment))
    result: FloatArray = least
    return result


def _from_segment(points: FloatArray, segments: FloatArray) -> FloatArray:
    along = segments[:, 1] - segments[:, 0]
    share = ((points - segments[:, 0]) * along).sum(axis=1) / np.maximum((along * along).sum(axis=1), _TINY)
    feet = segments[:, 0] + np.clip(share, 0, 1)[:, None] * along
    result: FloatArray = np.linalg.norm(points - feet, axis=1)
    return result
