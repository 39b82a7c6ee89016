"""Long edges in several: the vertices between, and the triangles beside them in pieces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fairing import _arguments
from fairing._new_mesh import read_only
from fairing._types import FloatArray, IntArray

Edge = tuple[int, int]


@dataclass(frozen=True, eq=False)
class SubdividedEdges:
    """A mesh some of whose edges are parted. All arrays are read-only."""

    vertices: FloatArray
    """(n + s, 3) the given ones come first, then those on the edges."""
    triangles: IntArray
    """(m', 3) those that no parted edge has keep their order and come first."""
    parent: IntArray
    """(m',) the given triangle that each is a piece of, or is."""
    ends: IntArray
    """(s, 2) the ends of the given edge that each new vertex lies on."""
    shares: FloatArray
    """(s,) and how far it lies on the way from the first to the second."""

    def along(self, loop: npt.ArrayLike) -> IntArray:
        """A closed loop of given vertices with the new ones on its edges."""
        given = _arguments.integers("loop", loop, None)
        between: dict[Edge, list[int]] = {}
        for k, (a, b) in enumerate(self.ends.tolist()):
            between.setdefault((a, b), []).append(len(self.vertices) - len(self.ends) + k)
        whole: list[int] = []
        for a, b in zip(given.tolist(), np.roll(given, -1).tolist(), strict=True):
            whole += [a, *between.get((a, b), between.get((b, a), [])[::-1])]
        return np.array(whole, dtype=np.int32)


def subdivide_edges(
    vertices: npt.ArrayLike, triangles: npt.ArrayLike, edges: npt.ArrayLike, length: npt.ArrayLike
) -> SubdividedEdges:
    """Part long edges in equal pieces, each about as long as wanted, so that new meshes may have that length there.

    vertices: (n, 3); triangles: (m, 3), those beside the edges are cut into pieces in their planes; edges: (e, 2), of
    any number of triangles; those shorter than one and a half times the ``length``, a number or (e,), stay whole.
    Nothing moves.
    """
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.triangles_within(triangles, len(points))
    pairs = _arguments.indices_within("edges", _arguments.integers("edges", edges, 2), len(points))
    wanted = np.broadcast_to(np.asarray(length, dtype=np.float64), (len(pairs),))
    if not (np.isfinite(wanted) & (wanted > 0.0)).all():
        raise ValueError(f"length: positive numbers are needed, not {length!r}")
    pairs, chosen = np.unique(np.sort(pairs, axis=1), axis=0, return_index=True)
    lengths = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    counts = np.maximum(1, np.floor(lengths / wanted[chosen] + 0.5).astype(np.int64))
    ends = np.repeat(pairs, counts - 1, axis=0)
    shares = np.concatenate([np.empty(0), *(np.arange(1, count) / count for count in counts.tolist())])
    places = points[ends[:, 0]] + shares[:, None] * (points[ends[:, 1]] - points[ends[:, 0]])
    cut = _Cut(faces, pairs[counts > 1])
    first = len(points)
    for (a, b), count in zip(pairs.tolist(), counts.tolist(), strict=True):
        cut.part(a, b, list(range(first, first + count - 1)))
        first += count - 1
    whole, parent = cut.result()
    return SubdividedEdges(
        *(read_only(each) for each in (np.concatenate([points, places]), whole, parent, ends, shares))
    )


class _Cut:
    """Triangles on their way into pieces."""

    def __init__(self, triangles: IntArray, edges: IntArray) -> None:
        at_edge = np.isin(triangles, edges).sum(axis=1) > 1
        self._rest = np.flatnonzero(~at_edge)
        self._triangles = triangles
        self._pieces = [tuple(row) for row in triangles[at_edge].tolist()]
        self._parents = np.flatnonzero(at_edge).tolist()
        self._at: dict[Edge, set[int]] = {}
        for k in range(len(self._pieces)):
            self._add(k)

    def _sides(self, k: int) -> list[Edge]:
        a, b, c = self._pieces[k]
        return [(min(p, q), max(p, q)) for p, q in ((a, b), (b, c), (c, a))]

    def _add(self, k: int) -> None:
        for side in self._sides(k):
            self._at.setdefault(side, set()).add(k)

    def part(self, a: int, b: int, between: list[int]) -> None:
        """Cut the triangles at an edge through the vertices on the way from a to b, one after the other."""
        for vertex in between:
            for k in sorted(self._at.get((min(a, b), max(a, b)), ())):
                piece = self._pieces[k]
                for side in self._sides(k):
                    self._at[side].discard(k)
                self._pieces[k] = tuple(vertex if corner == b else corner for corner in piece)
                self._pieces.append(tuple(vertex if corner == a else corner for corner in piece))
                self._parents.append(self._parents[k])
                self._add(k)
                self._add(len(self._pieces) - 1)
            a = vertex

    def result(self) -> tuple[IntArray, IntArray]:
        """All triangles, and which given ones they are pieces of."""
        pieces = np.array(self._pieces, dtype=np.int32).reshape(-1, 3)
        parents = np.array([*self._rest.tolist(), *self._parents], dtype=np.int32)
        return np.concatenate([self._triangles[self._rest], pieces]), parents
