"""The cells of wires: loops that a surface is to fill, and those that stay open."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from fairing._arguments import listed
from fairing._network import Network, carried, parts, refuse
from fairing._types import FloatArray, IntArray

_LEAST_TURN = 0.5 * np.pi
"""By how much a cell's outline turns to the left within the surface, at least. By Gauss and Bonnet it is 2π − ∫K: 2π
if it is flat, π in each quarter of a sphere, and 0 around a half sphere, at the end of a tube or at the rim of a hull,
where the wires go around an opening; −2π around the outside of a sheet."""
_MOST_OUTSIDE = -np.pi  # the outline of a sheet turns by less: on its other side is no opening that could be closed
_STRAIGHT = np.radians(150.0)  # corners from which on other wires end at the outline, rather than that it turns there


@dataclass(frozen=True, eq=False)
class Cells:
    """Loops with their surface on the left, all of a network wound alike."""

    loops: tuple[IntArray, ...]
    normals: FloatArray
    """One for each loop."""
    left_open: tuple[IntArray, ...]
    rims: IntArray
    """(r, 2) edges around openings that are closed."""

    @property
    def edges(self) -> tuple[IntArray, IntArray]:
        """(e, 2) all edges, and how many cells meet there."""
        sides = np.concatenate([np.column_stack([loop, np.roll(loop, -1)]) for loop in self.loops])
        edges, uses = np.unique(np.sort(sides, axis=1), axis=0, return_counts=True)
        return edges, uses


def cells_of(edges: IntArray, points: FloatArray, closed: bool) -> Cells:
    """All cells of the wires (e, 2), openings among them where ``closed``. MeshError where they can't be told."""
    networks, lone = parts(edges, points)
    loops, normals = list(lone), [_area(points[loop]) for loop in lone]
    left: list[IntArray] = []
    rims = [np.empty((0, 2), dtype=np.int32)]
    for network in networks:
        found = [_Face(network, darts) for darts in _faces(network)]
        _refuse_one_sided(network, found)
        inside = [face for face in found if face.is_cell(points)]
        lids = [face for face in found if closed and face not in inside and face.turn(points) > _MOST_OUTSIDE]
        outside = [face for face in found if face not in inside and face not in lids]
        _refuse_loose(network, outside)
        rims += [np.column_stack([face.loop, np.roll(face.loop, -1)]) for face in lids]
        turned = sum(face.volume(points) for face in inside) < 0.0
        for face in inside + lids:
            loop = face.loop[::-1].copy() if turned else face.loop
            _refuse_pinched(loop)
            loops.append(loop)
            normals.append(-face.normal if turned else face.normal)
        left += [face.loop for face in outside]
    return Cells(tuple(loops), np.array(normals).reshape(-1, 3), tuple(left), np.concatenate(rims))


def _faces(network: Network) -> list[list[int]]:
    """The darts around each, the face on their left: at a node the next one clockwise leads on."""
    after = {}
    for darts, _ in network.order.values():
        for k, dart in enumerate(darts):
            after[dart ^ 1] = darts[k - 1]
    faces, seen = [], set()
    for begin in sorted(after):
        face = []
        dart = begin
        while dart not in seen:
            seen.add(dart)
            face.append(dart)
            dart = after[dart]
        if face:
            faces.append(face)
    return faces


@dataclass(frozen=True, eq=False)
class _Face:
    network: Network
    darts: list[int]

    @property
    def loop(self) -> IntArray:
        return np.concatenate([self.network.path(dart)[:-1] for dart in self.darts])

    @property
    def normal(self) -> FloatArray:
        mean = np.sum([self.network.normals[int(self.network.path(dart)[0])] for dart in self.darts], axis=0)
        size = float(np.linalg.norm(mean))
        unit: FloatArray = mean / size if size > 1e-6 else self.network.normals[int(self.loop[0])]
        return unit

    def is_cell(self, points: FloatArray) -> bool:
        """Whether a surface is wanted there: around an opening most wires end, or it lies outside."""
        corners = self._corners()
        return 2 * int((corners < _STRAIGHT).sum()) > len(corners) and self.turn(points) > _LEAST_TURN

    def turn(self, points: FloatArray) -> float:
        """By how much the outline turns to the left within the surface, corners included."""
        along = [self._turn_along(self.network.path(dart), points) for dart in self.darts]
        return float(sum(along) + (np.pi - self._corners()).sum())

    def _corners(self) -> FloatArray:
        """(k,) angles within the face at the end of each dart, above 0."""
        found = []
        for dart, following in zip(self.darts, self.darts[1:] + self.darts[:1], strict=True):
            darts, angles = self.network.order[int(self.network.path(dart)[-1])]
            corner = angles[darts.index(dart ^ 1)] - angles[darts.index(following)]
            found.append(corner % (2 * np.pi) or 2 * np.pi)
        return np.array(found)

    def _turn_along(self, path: IntArray, points: FloatArray) -> float:
        return _turn(points[path], self._normals(path, points))

    def _normals(self, path: IntArray, points: FloatArray) -> FloatArray:
        """(k − 1, 3) of the surface along the edges of an arc, from those at both of its ends."""
        here = carried(self.network.normals[int(path[0])], points[path])
        there = carried(self.network.normals[int(path[-1])], points[path[::-1]])[::-1]
        share = (np.arange(len(here)) + 0.5)[:, None] / len(here)
        return (1.0 - share) * here + share * there

    def volume(self, points: FloatArray) -> float:
        """Which way most of the normals look, seen from the middle of the network."""
        middle = points[np.unique(np.concatenate(self.network.arcs))].mean(axis=0)
        corners = [int(self.network.path(dart)[0]) for dart in self.darts]
        return float(sum(self.network.normals[v] @ (points[v] - middle) for v in corners))


def _turn(path: FloatArray, normals: FloatArray) -> float:
    ways = np.diff(path, axis=0)
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    at = normals[1:] + normals[:-1]
    at /= np.maximum(np.linalg.norm(at, axis=1), 1e-300)[:, None]
    left = (np.cross(ways[:-1], ways[1:]) * at).sum(axis=1)
    return float(np.arctan2(left, (ways[:-1] * ways[1:]).sum(axis=1)).sum())


def _area(loop: FloatArray) -> FloatArray:
    """The unit normal of a polygon's vector area, or of the plane nearest to it where it has none."""
    middle = loop - loop.mean(axis=0)
    area = np.cross(middle, np.roll(middle, -1, axis=0)).sum(axis=0)
    size = float(np.linalg.norm(area))
    if size < 1e-6 * float((middle**2).sum()):
        flat: FloatArray = np.linalg.svd(middle)[2][2]
        return flat
    unit: FloatArray = area / size
    return unit


def _refuse_one_sided(network: Network, faces: list[_Face]) -> None:
    """MeshError where a wire has one and the same cell on both sides."""
    for face in faces:
        twice = [dart // 2 for dart in face.darts if dart % 2 == 0 and dart ^ 1 in face.darts]
        if twice:
            where = np.unique(np.concatenate([network.arcs[arc] for arc in twice]))
            text = f"the wires at {listed(where)} divide nothing, as one cell lies on both of their sides: "
            refuse("NO_CELL", text + "remove them, or add wires that divide it", where, "both_sides")


def _refuse_loose(network: Network, outside: list[_Face]) -> None:
    """MeshError where a wire has an opening on both sides."""
    darts = {dart for face in outside for dart in face.darts}
    loose = [dart // 2 for dart in darts if dart % 2 == 0 and dart ^ 1 in darts]
    if loose:
        where = np.unique(np.concatenate([network.arcs[arc] for arc in loose]))
        text = f"the wires at {listed(where)} bound no cell: on both sides is an opening; add wires across these, "
        refuse("NO_CELL", text + "or have them closed", where, "openings")


def _refuse_pinched(loop: IntArray) -> None:
    names, uses = np.unique(loop, return_counts=True)
    if (uses > 1).any():
        where = names[uses > 1]
        text = f"the outline of a cell passes {listed(where)} twice: add a wire that divides it"
        refuse("NO_CELL", text, where, "pinched")
