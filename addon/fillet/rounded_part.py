"""The faces of a fillet and the pieces of those that it cuts, and where their values come from. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from ..arrays.places import edge_keys, no_pairs, numbers_in
from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Ints
from ..remesh.faces import Faces, faces_in_rows, faces_of
from ..remesh.new_part import Edge, NewPart, Stencil, corner_numbers, sides_of

FLAT = 1e-4  # of its size: how far the corners of a face may lie off its plane, or its pieces stay triangles
_ON_SIDE = 1e-6  # weights below are none: the place is on the side between the other two corners


@dataclass(frozen=True)
class RoundedPart:
    """What a fillet leaves: a part of the mesh with new faces, the first `outside` of which are pieces of old ones."""

    part: NewPart
    polygons: Faces
    outside: int


def rounded_part(mesh: MeshArrays, result: fairing.results.FilletResult) -> RoundedPart:
    """Make it of the engine's answer; mesh: as it was solved."""
    count = len(mesh.positions)
    gone_faces = np.unique(mesh.triangle_faces[result.gone])
    again = np.setdiff1d(np.flatnonzero(np.isin(mesh.triangle_faces, gone_faces)), result.gone)
    triangles = np.concatenate(
        [mesh.triangles[again], result.triangles[: result.outside], result.triangles[result.outside :]]
    ).astype(np.int64)
    parents = np.concatenate([again, result.parent]).astype(np.int64)
    outside = len(again) + result.outside
    stay = np.unique(triangles[triangles < count])
    new = count + np.arange(len(result.vertices))
    number = numbers_in(np.concatenate([stay, new]), count + len(new))
    places = _CornerPlaces(mesh, result).of(triangles, parents, outside)
    corner_of = corner_numbers(mesh, mesh.triangle_faces, mesh.triangles)
    touched = np.unique(mesh.triangles[np.isin(mesh.triangle_faces, gone_faces)])
    sources = mesh.triangles[result.origin[0]]
    numbered = number[triangles]
    cut, cut_from = _pieces_of_edges(mesh, result, triangles, outside)
    part = NewPart(
        stay=stay,
        fixed_count=len(stay),
        held_count=len(stay),
        triangles=numbered,
        lines=no_pairs(),
        vertices=Stencil(sources, result.origin[1]),
        corners=Stencil(corner_of[places[0]], places[1]),
        faces=mesh.triangle_faces[parents],
        gone_faces=gone_faces,
        gone_vertices=_without_faces(mesh, gone_faces, np.setdiff1d(touched, stay)),
        cut=number[cut],
        cut_from=cut_from,
    )
    polygons, first = _merged(mesh, numbered[:outside], parents, result.quads is not None)
    faces = _joined(polygons, _new_faces(numbered, result, outside))
    return RoundedPart(part, _wound(faces, mesh.mirrored), first)


def _pieces_of_edges(
    mesh: MeshArrays, result: fairing.results.FilletResult, triangles: Ints, outside: int
) -> tuple[Ints, Ints]:
    """Return the (c, 2) sides of triangles, but within the fillet, that are pieces of an edge, and (c, 2) its ends."""
    count = len(mesh.positions)
    corners, weights = mesh.triangles[result.origin[0]], result.origin[1]
    rows, opposite = np.arange(len(corners)), weights.argmin(axis=1)
    ends = np.column_stack([corners[rows, (opposite + 1) % 3], corners[rows, (opposite + 2) % 3]])
    ends[(weights <= _ON_SIDE).sum(axis=1) != 1] = -1
    ends = np.concatenate([np.column_stack([np.arange(count)] * 2), np.sort(ends, axis=1)])
    sides = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    first = np.unique(edge_keys(sides), return_index=True)[1]  # those outside come first
    first = first[sides[first, 1] >= count]
    sides, is_outside = sides[first], first < 3 * outside
    of = ends[sides[:, 1]]
    within = (ends[sides[:, 0]][:, :, None] == of[:, None]).any(axis=2).all(axis=1) & (of[:, 0] >= 0)
    keys = edge_keys(np.maximum(of, 0))
    at_end = np.isin(sides, result.fixed).all(axis=1)  # of the fillet: at walls, if it is not outside, too
    known = within & (is_outside | at_end) & np.isin(keys, edge_keys(mesh.edges))
    return sides[known], of[known]


def _without_faces(mesh: MeshArrays, gone_faces: Ints, vertices: Ints) -> Ints:
    """Return those of the vertices that have no other face."""
    others = np.ones(len(mesh.in_patch), dtype=bool)
    others[gone_faces] = False
    kept = np.unique(mesh.corner_vertices[others[mesh.corner_faces]])
    return np.setdiff1d(vertices, kept)


class _CornerPlaces:
    """Where the corners of new triangles lie on old ones, on their own side of the seam."""

    def __init__(self, mesh: MeshArrays, result: fairing.results.FilletResult) -> None:
        self._mesh, self._result = mesh, result
        self._twin: dict[Edge, int] = {}
        for t in np.flatnonzero(np.isin(mesh.triangle_faces, mesh.triangle_faces[result.gone])).tolist():
            a, b, c = mesh.triangles[t].tolist()
            self._twin[a, b] = self._twin[b, c] = self._twin[c, a] = t
        parting = np.concatenate([result.seam, result.walls])
        self._side = _sides(self._twin, {frozenset(pair) for pair in parting.tolist()})

    def of(self, triangles: Ints, parents: Ints, outside: int) -> tuple[Ints, Floats]:
        """Return (3 m, 3) corners of old triangles, 3 · the triangle + the corner, and weights."""
        count = len(self._mesh.positions)
        old, weights = np.empty(triangles.size, dtype=np.int64), np.empty((triangles.size, 3))
        parent = np.repeat(parents, 3)
        corners = triangles.ravel()
        new = corners >= count
        old[new] = self._result.origin[0][corners[new] - count]
        weights[new] = self._result.origin[1][corners[new] - count]
        pieces = np.arange(triangles.size) < 3 * outside
        old[pieces], weights[pieces] = self._in_faces(parent[pieces], corners[pieces])
        for k in np.flatnonzero(~new & ~pieces).tolist():
            old[k], weights[k] = self._at_vertex(int(corners[k]), int(parent[k]))
        for k in np.flatnonzero(new & ~pieces).tolist():
            if self._side.get(int(old[k])) != self._side.get(int(parent[k])):
                old[k], weights[k] = self._across(int(old[k]), weights[k], int(parent[k]))
        return 3 * old[:, None] + np.arange(3), weights

    def _in_faces(self, parents: Ints, corners: Ints) -> tuple[Ints, Floats]:
        """Return triangles of the parents' faces that vertices lie on, and barycentric weights (k, 3) there."""
        old, weights = parents.copy(), self._weights_in(parents, corners)
        faces = self._mesh.triangle_faces
        for k in np.flatnonzero(weights.min(axis=1) < -_ON_SIDE).tolist():  # a piece of several triangles of its face
            own = np.flatnonzero(faces == faces[parents[k]])
            found = self._weights_in(own, np.full(len(own), corners[k]))
            best = int(found.min(axis=1).argmax())
            old[k], weights[k] = own[best], found[best]
        weights = np.clip(weights, 0.0, 1.0)
        return old, weights / weights.sum(axis=1, keepdims=True)

    def _weights_in(self, parents: Ints, corners: Ints) -> Floats:
        """Return barycentric weights (k, 3) of vertices in the planes of triangles."""
        places = np.concatenate([self._mesh.positions, self._result.vertices])[corners]
        a, b, c = (self._mesh.positions[self._mesh.triangles[parents, k]] for k in range(3))
        normal = np.cross(b - a, c - a)
        squared = np.maximum((normal * normal).sum(axis=1), 1e-300)
        u = (normal * np.cross(c - b, places - b)).sum(axis=1) / squared
        v = (normal * np.cross(a - c, places - c)).sum(axis=1) / squared
        return np.column_stack([u, v, 1.0 - u - v])

    def _at_vertex(self, vertex: int, parent: int) -> tuple[int, Floats]:
        """Return a triangle at an old vertex, on the parent's side if there is one."""
        corners = self._mesh.triangles[parent].tolist()
        best = parent
        if vertex not in corners:
            around = [t for (a, _), t in self._twin.items() if a == vertex]
            alike = [t for t in around if self._side.get(t) == self._side.get(parent)]
            best = min(alike or around)
        weights = np.zeros(3)
        weights[self._mesh.triangles[best].tolist().index(vertex)] = 1.0
        return best, weights

    def _across(self, triangle: int, weights: Floats, parent: int) -> tuple[int, Floats]:
        """Return the same place on a seam or a wall in the triangle on its other side; elsewhere as it was."""
        corners = self._mesh.triangles[triangle].tolist()
        if (weights > _ON_SIDE).sum() == 1:
            return self._at_vertex(corners[int(weights.argmax())], parent)
        for k in range(3):
            if weights[k] > _ON_SIDE:
                continue
            a, b = corners[(k + 1) % 3], corners[(k + 2) % 3]
            other = self._twin.get((b, a))
            if other is None or self._side[other] == self._side[triangle]:
                continue
            there = self._mesh.triangles[other].tolist()
            turned = np.zeros(3)
            turned[there.index(a)], turned[there.index(b)] = weights[(k + 1) % 3], weights[(k + 2) % 3]
            return other, turned / turned.sum()
        return triangle, weights


def _sides(twin: dict[Edge, int], parting: set[frozenset[int]]) -> dict[int, int]:
    """Return a number for each triangle: equal where no seam and no wall parts them."""
    adjacent: dict[int, list[int]] = {}
    for (a, b), t in twin.items():
        other = twin.get((b, a))
        adjacent.setdefault(t, [])
        if other is not None and frozenset((a, b)) not in parting:
            adjacent[t].append(other)
    side: dict[int, int] = {}
    for first in adjacent:
        waiting = [] if first in side else [first]
        while waiting:
            t = waiting.pop()
            if t not in side:
                side[t] = first
                waiting += adjacent[t]
    return side


def _merged(mesh: MeshArrays, triangles: Ints, parents: Ints, bent: bool) -> tuple[Faces, int]:
    """Return the faces of the pieces, and how many there are: those of one face become polygons again.

    bent: whether of faces that are not flat, too.
    """
    polygons: list[list[int]] = []
    examples: list[int] = []
    corners: list[int] = []

    def add(polygon: list[int], places: list[int]) -> None:
        polygons.append(polygon)
        examples.append(places[0] // 3)
        corners.extend(places)

    faces = mesh.triangle_faces[parents[: len(triangles)]]
    for face in np.unique(faces).tolist():
        rows = np.flatnonzero(faces == face)
        whole = bent or _is_flat(mesh, face)
        for piece in _pieces(triangles, rows):
            loop = _boundary(triangles, piece) if whole else None
            if loop is None:
                for row in piece:
                    add(triangles[row].tolist(), [3 * row, 3 * row + 1, 3 * row + 2])
            else:
                add([int(triangles[corner // 3, corner % 3]) for corner in loop], loop)
    return Faces(polygons, np.array(examples, dtype=np.int64), np.array(corners, dtype=np.int64)), len(polygons)


def _new_faces(triangles: Ints, result: fairing.results.FilletResult, outside: int) -> Faces:
    """Return those of the fillet; their triangles are the last of all."""
    if result.quads is None:
        own = faces_of(triangles[outside:])
    else:
        own = faces_in_rows(triangles[outside:], result.quads.pairs - result.outside, no_pairs())
    return Faces(own.polygons, own.triangles + outside, own.corners + 3 * outside)


def _joined(first: Faces, second: Faces) -> Faces:
    return Faces(
        first.polygons + second.polygons,
        np.concatenate([first.triangles, second.triangles]),
        np.concatenate([first.corners, second.corners]),
    )


def _is_flat(mesh: MeshArrays, face: int) -> bool:
    places = mesh.positions[mesh.corner_vertices[mesh.corner_faces == face]]
    off = places - places.mean(axis=0)
    spread = np.linalg.svd(off, compute_uv=False)
    return bool(spread[-1] <= FLAT * spread[0])


def _pieces(triangles: Ints, rows: Ints) -> list[list[int]]:
    """Return the rows in lists that hang together across sides."""
    sides = dict(sides_of(triangles, rows.tolist()))
    left, found = set(rows.tolist()), []
    while left:
        waiting, piece = [min(left)], []
        while waiting:
            row = waiting.pop()
            if row not in left:
                continue
            left.discard(row)
            piece.append(row)
            waiting += [sides[b, a] // 3 for (a, b), _ in sides_of(triangles, [row]) if (b, a) in sides]
        found.append(sorted(piece))
    return found


def _boundary(triangles: Ints, piece: list[int]) -> list[int] | None:
    """Return the corners around a piece, None where it has a hole, touches or covers itself: no polygon then."""
    sides = dict(sides_of(triangles, piece))
    around = {a: (b, corner) for (a, b), corner in sides.items() if (b, a) not in sides}
    once = len(sides) == 3 * len(piece) and len(around) == sum((b, a) not in sides for a, b in sides)
    if not once or not around:
        return None
    first = at = min(around)
    loop: list[int] = []
    while not loop or at != first:
        at, corner = around[at]
        loop.append(corner)
    return loop if len(loop) == len(around) else None


def _wound(faces: Faces, mirrored: bool) -> Faces:
    """Return the faces as the mesh's own are wound."""
    if not mirrored:
        return faces
    ends = np.cumsum([len(polygon) for polygon in faces.polygons])
    parts = np.split(faces.corners, ends[:-1])
    return Faces(
        [polygon[::-1] for polygon in faces.polygons], faces.triangles, np.concatenate([p[::-1] for p in parts])
    )
