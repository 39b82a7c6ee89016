"""Half-edge collapses that thin a mesh out to a given size, and Delaunay flips afterwards.

Vertices stay where they are, so a thinned mesh has its vertices on the surface it came from. The
vertices of closed curves, the border among them, only move along these.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterable, Sequence

import numpy as np

from polygon_mesh import FloatArray, IntArray

MOST_NEIGHBOURS = 9
LEAST_ROUNDNESS = 0.15
SLIVER = 0.02
LEAST_COSINE = 0.5  # between a triangle's normals before and after a collapse or flip


class Thinner:
    """A triangle mesh that shrinks; triangles that are gone are empty."""

    def __init__(self, vertices: FloatArray, triangles: IntArray, curves: list[IntArray]) -> None:
        self.points = vertices.tolist()
        self.faces: list[tuple[int, int, int] | None] = [tuple(t) for t in triangles.tolist()]
        self.around: list[set[int]] = [set() for _ in self.points]
        for k, face in enumerate(self.faces):
            for corner in face or ():
                self.around[corner].add(k)
        self.version = [0] * len(self.points)
        self.along: dict[int, list[int]] = {}
        for loop in (curve.tolist() for curve in curves):
            self.along |= {v: [loop[k - 1], loop[(k + 1) % len(loop)]] for k, v in enumerate(loop)}

    def neighbours(self, vertex: int) -> set[int]:
        """Vertices joined to one by an edge."""
        found = {v for k in self.around[vertex] for v in self.faces[k] or ()}
        found.discard(vertex)
        return found

    def length(self, a: int, b: int) -> float:
        """Length of the edge."""
        p, q = self.points[a], self.points[b]
        return float(((p[0] - q[0]) ** 2 + (p[1] - q[1]) ** 2 + (p[2] - q[2]) ** 2) ** 0.5)

    def collapse(self, gone: int, kept: int) -> bool:
        """Moves the vertex `gone` into its neighbour; False, and nothing done, where that would spoil the mesh."""
        if gone in self.along and kept not in self.along[gone]:
            return False
        ring, other = self.neighbours(gone), self.neighbours(kept)
        if len(ring & other) != len(self.around[gone] & self.around[kept]):
            return False
        if gone not in self.along and len(ring | other) - 2 > max(MOST_NEIGHBOURS, len(other)):
            return False
        changed = [k for k in self.around[gone] if kept not in (self.faces[k] or ())]
        if any(self._turned(self.faces[k], gone, kept) for k in changed):
            return False
        self._replace(gone, kept, changed)
        for v in ring:
            self.version[v] += 1
        return True

    def _replace(self, gone: int, kept: int, changed: list[int]) -> None:
        for k in self.around[gone] - set(changed):
            for corner in self.faces[k] or ():
                if corner != gone:
                    self.around[corner].discard(k)
            self.faces[k] = None
        for k in changed:
            face = self.faces[k]
            assert face is not None
            a, b, c = (kept if v == gone else v for v in face)
            self.faces[k] = (a, b, c)
            self.around[kept].add(k)
        self.around[gone] = set()
        if gone in self.along:
            before, after = self.along.pop(gone)
            self.along[before] = [after if v == gone else v for v in self.along[before]]
            self.along[after] = [before if v == gone else v for v in self.along[after]]

    def _turned(self, face: tuple[int, int, int] | None, gone: int, kept: int) -> bool:
        """Whether a triangle turns over, or nearly, or ends up a needle, when a corner moves."""
        assert face is not None
        moved = [kept if v == gone else v for v in face]
        before, after = self.cross(*face), self.cross(*moved)
        old, new = self.roundness(face, before), self.roundness(moved, after)
        if old < SLIVER:
            return False  # nothing to spoil; a flip will end it
        if new < (0.01 if gone in self.along else LEAST_ROUNDNESS) and new < old:
            return True
        return _dot(before, after) < LEAST_COSINE * _norm(before) * _norm(after)

    def roundness(self, face: Sequence[int], cross: tuple[float, float, float]) -> float:
        """Twice the area over the square of the longest edge: 0.87 if equilateral, 0 if flat."""
        a, b, c = face
        longest = max(self.length(a, b), self.length(b, c), self.length(c, a))
        return _norm(cross) / max(longest**2, 1e-300)

    def cross(self, a: int, b: int, c: int) -> tuple[float, float, float]:
        """Twice the area vector of a triangle."""
        p, q, r = self.points[a], self.points[b], self.points[c]
        ux, uy, uz = q[0] - p[0], q[1] - p[1], q[2] - p[2]
        vx, vy, vz = r[0] - p[0], r[1] - p[1], r[2] - p[2]
        return uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx


def _dot(a: tuple[float, ...], b: tuple[float, ...]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _norm(a: tuple[float, ...]) -> float:
    return float(_dot(a, a) ** 0.5)


def thin_curve(mesh: Thinner, keep: set[int]) -> None:
    """Takes the curves' other vertices out; one that can't go takes the place of a neighbour in `keep`."""
    for _ in range(4):
        for vertex in [v for v in mesh.along if v not in keep]:
            ends = sorted(mesh.along[vertex], key=lambda v: mesh.length(vertex, v))
            if any(mesh.collapse(vertex, end) for end in ends):
                continue
            if ends[0] in keep and mesh.collapse(ends[0], vertex):
                keep.remove(ends[0])
                keep.add(vertex)


def thin(mesh: Thinner, removable: Iterable[int], size: FloatArray, count: int) -> int:
    """Collapses the edges that are shortest for their place until `count` vertices are gone.

    `removable` are the vertices that may go; size (n,) is the length wanted at each. Returns how many went.
    """
    allowed = set(removable)
    heap = [_entry(mesh, v, size) for v in allowed]
    heapq.heapify(heap)
    gone = 0
    while heap and gone < count:
        _, vertex, stamp = heapq.heappop(heap)
        if not mesh.around[vertex] or stamp != mesh.version[vertex]:
            continue
        ring = mesh.neighbours(vertex)
        ends = sorted(ring, key=lambda v: mesh.length(vertex, v))[:3]
        if any(mesh.collapse(vertex, end) for end in ends):
            gone += 1
            for v in ring & allowed:
                heapq.heappush(heap, _entry(mesh, v, size))
    return gone


def _entry(mesh: Thinner, vertex: int, size: FloatArray) -> tuple[float, int, int]:
    shortest = min((mesh.length(vertex, v) for v in mesh.neighbours(vertex)), default=np.inf)
    return shortest / float(size[vertex]), vertex, mesh.version[vertex]


def flip_to_delaunay(mesh: Thinner, places: set[int], rounds: int = 6) -> None:
    """Flips edges between `places` whose opposite angles exceed 180° together, unless that creases the surface.

    The edges of the curves stay.
    """
    for _ in range(rounds):
        edges = {(v, w) for v in places for w in mesh.neighbours(v) & places if v < w}
        edges = {(v, w) for v, w in edges if w not in mesh.along.get(v, ())}
        if not sum(_flip(mesh, a, b) for a, b in sorted(edges)):
            return


def _flip(mesh: Thinner, a: int, b: int) -> bool:
    pair = mesh.around[a] & mesh.around[b]
    if len(pair) != 2:
        return False
    one, two = pair
    c, d = (next(v for v in mesh.faces[k] or () if v not in (a, b)) for k in (one, two))
    if d in mesh.neighbours(c) or _cotangent(mesh, c, a, b) + _cotangent(mesh, d, a, b) > -1e-9:
        return False
    face = mesh.faces[one]
    assert face is not None
    if face[(face.index(a) + 1) % 3] != b:
        a, b = b, a
    new = (a, d, c), (d, b, c)
    old = mesh.cross(a, b, c), mesh.cross(b, a, d)
    mean = tuple(x / max(_norm(old[0]), 1e-300) + y / max(_norm(old[1]), 1e-300) for x, y in zip(*old, strict=True))
    crosses = [mesh.cross(*f) for f in new]
    if any(_dot(n, mean) < 0.8 * _norm(n) * _norm(mean) for n in crosses):
        return False
    mesh.faces[one], mesh.faces[two] = new
    mesh.around[b].discard(one)
    mesh.around[a].discard(two)
    mesh.around[d].add(one)
    mesh.around[c].add(two)
    return True


def _cotangent(mesh: Thinner, apex: int, a: int, b: int) -> float:
    """Of the angle at a triangle's apex."""
    p, q, r = mesh.points[apex], mesh.points[a], mesh.points[b]
    dot = sum((y - x) * (z - x) for x, y, z in zip(p, q, r, strict=True))
    return float(dot) / max(_norm(mesh.cross(apex, a, b)), 1e-300)
