"""Exact surfaces with creases: whole, with a hole across their edges, with a dented part through which edges run."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay

import fairing
import measures
from curves import FloatArray
from grids import IntArray, halves, numbered

Distance = Callable[[FloatArray], FloatArray]


@dataclass(frozen=True)
class Creased:
    """A patch (n, 3), (m, 3) that is held along its boundary and along a curve inside.

    Exact surfaces: side k has `distances[k]`, and `side` (n,) tells which of them each vertex lies on.
    """

    vertices: FloatArray
    triangles: IntArray
    boundary: IntArray
    curve: IntArray  # inside, and its ends on the boundary
    normals: FloatArray  # (n, 3) of the exact sides; unimportant on the curve
    side: IntArray
    distances: tuple[Distance, ...] = field(default=())

    @property
    def fixed(self) -> IntArray:
        return np.union1d(self.boundary, self.curve)

    @property
    def free(self) -> IntArray:
        return np.setdiff1d(np.arange(len(self.vertices)), self.fixed)

    @property
    def size(self) -> float:
        """D."""
        held = self.vertices[self.fixed]
        return 2.0 * float(np.linalg.norm(held - held.mean(axis=0), axis=1).max())

    def noisy(self, amount: float, seed: int = 0) -> FloatArray:
        """Free vertices thrown by a share of the mean edge, in all directions."""
        ends = self.vertices[measures.edges(self.triangles)]
        edge = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean()
        result = self.vertices.copy()
        result[self.free] += amount * edge * np.random.default_rng(seed).normal(size=(len(self.free), 3))
        return result

    def error(self, vertices: FloatArray) -> float:
        """Largest distance of a free vertex to its own side, over D."""
        worst = 0.0
        for k, distance in enumerate(self.distances):
            own = self.free[self.side[self.free] == k]
            worst = max(worst, float(distance(vertices[own]).max(initial=0.0)))
        return worst / self.size


def _grid(st: FloatArray, shape: tuple[int, int], held: FloatArray, seed: int) -> tuple[FloatArray, IntArray]:
    """Parameters (n, 2) shaken where they aren't held, and triangles with random diagonals."""
    rng = np.random.default_rng([seed, 5])
    triangles = halves(numbered(*shape), rng)
    step = np.abs(st[1] - st[0]).max()
    return st + 0.25 * step * rng.uniform(-1, 1, st.shape) * ~held[:, None], triangles


def _plane(axis: int) -> Distance:
    return lambda points: np.abs(points[:, axis])


def fading_fold(n: int, seed: int = 0, *, steep: float = 0.6) -> Creased:
    """z = −steep |s| (1 − 2 t)² up to t = ½, flat beyond: the curve is the fold, which ends in the middle."""
    s, t = (x.ravel() for x in np.meshgrid(np.linspace(-1, 1, 2 * n + 1), np.linspace(0, 1, n + 1), indexing="ij"))
    boundary = (np.abs(s) > 1 - 1e-9) | (t < 1e-9) | (t > 1 - 1e-9)
    curve = (np.abs(s) < 1e-9) & (t <= 0.5 + 1e-9)
    st, triangles = _grid(np.column_stack([s, t]), (2 * n + 1, n + 1), boundary | curve, seed)
    s, t = st.T
    fold = np.maximum(1 - 2 * t, 0.0)
    vertices = np.column_stack([s, t, -steep * np.abs(s) * fold**2])
    slope = np.column_stack([steep * np.sign(s) * fold**2, -4 * steep * np.abs(s) * fold, np.ones_like(s)])
    normals = slope / np.linalg.norm(slope, axis=1)[:, None]
    return Creased(vertices, triangles, np.flatnonzero(boundary), np.flatnonzero(curve), normals, (s > 0).astype(int))


def box_edge(n: int, seed: int = 0, *, cut: float = 1.0) -> Creased:
    """Two squares of n × n cells at a right angle; the curve is their common edge, or the share `cut` of it."""
    s, t = (x.ravel() for x in np.meshgrid(np.linspace(-1, 1, 2 * n + 1), np.linspace(0, 1, n + 1), indexing="ij"))
    boundary = (np.abs(s) > 1 - 1e-9) | (t < 1e-9) | (t > 1 - 1e-9)
    st, triangles = _grid(np.column_stack([s, t]), (2 * n + 1, n + 1), boundary | (np.abs(s) < 1e-9), seed)
    s, t = st.T
    vertices = np.column_stack([np.minimum(s, 0.0), t, -np.maximum(s, 0.0)])
    normals = np.where((s < 0)[:, None], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0])
    curve = np.flatnonzero((np.abs(s) < 1e-9) & (t <= cut + 1e-9))
    side = np.where(s < 0, 0, 1)
    return Creased(vertices, triangles, np.flatnonzero(boundary), curve, normals, side, (_plane(2), _plane(0)))


def box_corner(n: int, seed: int = 0) -> Creased:
    """Three squares of n × n cells that meet in a corner of a box; the curve are its three edges."""
    parts, faces, count = [], [], 0
    for axis in range(3):
        u, v = (x.ravel() for x in np.meshgrid(np.linspace(-1, 0, n + 1), np.linspace(-1, 0, n + 1), indexing="ij"))
        held = (u < -1 + 1e-9) | (v < -1 + 1e-9) | (u > -1e-9) | (v > -1e-9)
        st, triangles = _grid(np.column_stack([u, v]), (n + 1, n + 1), held, seed + axis)
        points = np.zeros((len(u), 3))
        points[:, (axis + 1) % 3], points[:, (axis + 2) % 3] = st.T
        parts.append(points)
        faces.append(triangles + count)
        count += len(u)
    points = np.concatenate(parts)
    _, first, number = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    points, triangles = points[first], number.ravel()[np.concatenate(faces)]
    zero = np.abs(points) < 1e-9
    side = np.argmax(zero, axis=1)
    boundary = (points < -1 + 1e-9).any(axis=1)
    curve = zero.sum(axis=1) >= 2
    return Creased(
        points, triangles, np.flatnonzero(boundary), np.flatnonzero(curve), np.eye(3)[side], side,
        tuple(_plane(axis) for axis in range(3)),
    )  # fmt: skip


def lid(rings: int, seed: int = 0, *, depth: float = 0.8) -> Creased:
    """A disc of radius 1 on a cylinder; the curve is the rim, the boundary the circle at −depth."""
    rng = np.random.default_rng([seed, 6])
    places = [np.zeros((1, 2))]
    for k in range(1, rings + 1):
        angle = 2 * np.pi * np.arange(6 * k) / (6 * k)
        ring = k / rings * np.column_stack([np.cos(angle), np.sin(angle)])
        places.append(ring + (k < rings) * 0.2 / rings * rng.uniform(-1, 1, ring.shape))
    disc = np.concatenate(places)
    around = 6 * rings
    triangles = _delaunay(disc)
    rows = max(2, round(depth * around / (2 * np.pi)))
    angle = np.tile(2 * np.pi * np.arange(around) / around, rows)
    row = np.repeat(np.arange(1, rows + 1), around)
    inside = row < rows
    angle = angle + inside * 0.25 * 2 * np.pi / around * rng.uniform(-1, 1, len(angle))
    z = -depth * (row + inside * 0.25 * rng.uniform(-1, 1, len(row))) / rows
    side_points = np.column_stack([np.cos(angle), np.sin(angle), z])
    rim = np.arange(len(disc) - around, len(disc))
    number = np.vstack([rim, len(disc) + np.arange(rows * around).reshape(rows, around)])
    walls = halves(np.column_stack([number, number[:, 0]]), rng)
    vertices = np.vstack([np.column_stack([disc, np.zeros(len(disc))]), side_points])
    normals = np.vstack([np.tile([0.0, 0.0, 1.0], (len(disc), 1)), side_points * [1.0, 1.0, 0.0]])
    side = np.concatenate([np.zeros(len(disc), int), np.ones(len(side_points), int)])
    return Creased(
        vertices, np.vstack([triangles, walls]), np.arange(len(vertices) - around, len(vertices)), rim, normals, side,
        (_plane(2), lambda points: np.abs(np.linalg.norm(points[:, :2], axis=1) - 1.0)),
    )  # fmt: skip


def _delaunay(points: FloatArray) -> IntArray:
    triangles = Delaunay(points).simplices.astype(np.int64)
    a, b, c = points[triangles].transpose(1, 0, 2)
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    triangles[area < 0] = triangles[area < 0][:, ::-1]
    return triangles[np.abs(area) > 1e-12]


@dataclass(frozen=True)
class Hole:
    """A mesh with a hole."""

    vertices: FloatArray
    triangles: IntArray
    loop: IntArray
    sides: tuple[Callable[[FloatArray], FloatArray], ...]
    """Distances of points (k, 3) to the surfaces that meet."""

    @property
    def size(self) -> float:
        """The length of the box around the hole's boundary."""
        return float(np.linalg.norm(np.ptp(self.vertices[self.loop], axis=0)))

    def error(self, points: FloatArray) -> float:
        """The largest distance to the nearest side, over the hole's size."""
        return float(np.min([side(points) for side in self.sides], axis=0).max() / self.size)

    def edge_error(self, points: FloatArray) -> float:
        """The largest distance to any two sides' common edge, over the hole's size."""
        distances = np.sort([side(points) for side in self.sides], axis=0)
        return float(distances[1].max() / self.size)


def cut_out(
    vertices: FloatArray, triangles: IntArray, inside: NDArray[np.bool_], sides: tuple[Callable[..., FloatArray], ...]
) -> Hole:
    """Without the triangles all of whose corners are in the mask, and without vertices that are left over."""
    kept = triangles[~inside[triangles].all(axis=1)]
    used, numbered = np.unique(kept, return_inverse=True)
    kept = numbered.reshape(-1, 3)
    gone = np.searchsorted(used, np.intersect1d(used, triangles[inside[triangles].all(axis=1)]))
    loops = [np.asarray(loop, np.int64) for loop in fairing.boundary_loops(kept)]
    return Hole(vertices[used], kept, next(loop for loop in loops if np.isin(loop, gone).all()), sides)


def in_box_edge(n: int, seed: int = 0, radius: float = 0.3) -> Hole:
    patch = box_edge(n, seed)
    return _around(patch, np.array([0.0, 0.5, 0.0]), radius)


def in_box_corner(n: int, seed: int = 0, radius: float = 0.5) -> Hole:
    return _around(box_corner(n, seed), np.zeros(3), radius)


def in_lid(rings: int, seed: int = 0, radius: float = 0.45) -> Hole:
    return _around(lid(rings, seed), np.array([1.0, 0.0, 0.0]), radius)


def _bent_sheet(n: int, seed: int, bend: float) -> tuple[Creased, tuple[Distance, ...]]:
    """The box edge with z shifted by bend · (y − ½)²: a sheet bent to a parabola, and a flat side below it."""
    patch = box_edge(n, seed)

    def height(points: FloatArray) -> FloatArray:
        return bend * (points[:, 1] - 0.5) ** 2

    def above(points: FloatArray) -> FloatArray:
        slope = 2 * bend * (points[:, 1] - 0.5)
        return np.abs(points[:, 2] - height(points)) / np.sqrt(1 + slope**2)

    bent = patch.vertices + height(patch.vertices)[:, None] * [0.0, 0.0, 1.0]
    return replace(patch, vertices=bent), (above, _plane(0))


def in_bent_sheet(n: int, seed: int = 0, radius: float = 0.3, bend: float = 0.5) -> Hole:
    patch, sides = _bent_sheet(n, seed, bend)
    inside = np.linalg.norm(patch.vertices - [0.0, 0.5, 0.0], axis=1) < radius
    return cut_out(patch.vertices, patch.triangles, inside, sides)


def _around(patch: Creased, centre: FloatArray, radius: float) -> Hole:
    inside = np.linalg.norm(patch.vertices - centre, axis=1) < radius
    return cut_out(patch.vertices, patch.triangles, inside, patch.distances)


def in_bevel(
    n: int, seed: int = 0, *, radius: float = 0.12, rows: int = 0, taper: float = 0.0, bend: float = 0.0
) -> Hole:
    """A plane and a wall that meet in a quarter circle of the radius, with a hole over it; jittered, n edges a unit.

    rows: across it; 0: as long as the other edges. taper: the radius grows by as much to one end and shrinks to the
    other. bend: curvature of the wall, which is a cylinder then, and the edge rolled around it.
    """
    rng = np.random.default_rng([seed, 3])
    rows = rows or max(2, round(radius * np.pi / 2 * n))
    at = np.concatenate([np.arange(-n, 0) / n, np.arange(rows) / rows, 1 + np.arange(n + 1) / n])
    u, y = (a.ravel() for a in np.meshgrid(at, np.arange(n + 1) / n, indexing="ij"))
    inner = (u > -1) & (u < 2) & (y > 0) & (y < 1)
    step = np.where((u > 0) & (u < 1), 1 / rows, 1 / n) * (np.abs(u * (u - 1)) > 1e-9)
    u = u + 0.25 * step * rng.uniform(-1, 1, len(u)) * inner
    y = y + 0.25 / n * rng.uniform(-1, 1, len(y)) * inner

    def radius_at(y: FloatArray) -> FloatArray:
        return radius * (1 + taper * (2 * y - 1))

    r, angle = radius_at(y), np.clip(u, 0, 1) * np.pi / 2
    x = r * (np.sin(angle) - 1) + np.minimum(u, 0)
    z = r * (np.cos(angle) - 1) - np.maximum(u - 1, 0)
    triangles = halves(numbered(len(at), n + 1), rng)
    flat = np.column_stack([x, y - 0.5, z])
    vertices = _bent(flat, bend) if bend else flat

    def distance(points: FloatArray) -> FloatArray:
        out, along, high = (_unbent(points, bend) if bend else points).T
        r = radius_at(along + 0.5)
        rolled = np.abs(np.hypot(out + r, high + r) - r)
        return np.where((out > -r) & (high > -r), rolled, np.minimum(np.abs(out), np.abs(high)))

    inside = np.linalg.norm(vertices - [-0.3 * radius, 0.0, -0.3 * radius], axis=1) < 0.4
    return cut_out(vertices, triangles, inside, (distance,))


def _bent(points: FloatArray, bend: float) -> FloatArray:
    """The plane x = 0 becomes a cylinder around the z axis through (−1 / bend, 0), y the length along it."""
    out, along, high = points.T
    reach, turn = 1 / bend + out, along * bend
    return np.column_stack([reach * np.cos(turn) - 1 / bend, reach * np.sin(turn), high])


def _unbent(points: FloatArray, bend: float) -> FloatArray:
    x, y, high = points.T
    sign = np.sign(bend)
    out = sign * np.hypot(x + 1 / bend, y) - 1 / bend
    return np.column_stack([out, np.arctan2(sign * y, sign * (x + 1 / bend)) / bend, high])


@dataclass(frozen=True)
class Dented:
    """All but the patch's inner vertices and edges are exact; the vertices of `curve` are where fair_edges has them."""

    vertices: FloatArray
    patch: IntArray
    fixed: IntArray  # ascending: its boundary, and the curve
    normals: FloatArray  # at these
    curve: IntArray  # the vertices of hard edges within, with those where they enter
    edges: IntArray  # (h, 2) the hard edges between them
    sides: tuple[Distance, ...]
    """Distances of points (k, 3) to the surfaces that meet."""

    @property
    def edge(self) -> float:
        """The mean length of the patch's edges."""
        ends = self.vertices[measures.edges(self.patch)]
        return float(np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean())

    def error(self, points: FloatArray) -> float:
        """The largest distance to the nearest side, over the size of the box around the boundary."""
        boundary = np.setdiff1d(self.fixed, self.curve)
        size = np.linalg.norm(np.ptp(self.vertices[boundary], axis=0))
        return float(np.min([side(points) for side in self.sides], axis=0).max() / size)


def dented(
    vertices: FloatArray, triangles: IntArray, sides: tuple[Distance, ...], centre: tuple[float, ...], radius: float
) -> Dented:
    """The patch within a ball, thrown about by a twentieth of its edges."""
    inside = (np.linalg.norm(vertices - centre, axis=1) < radius)[triangles].all(axis=1)
    patch, outside = triangles[inside], triangles[~inside]
    boundary = np.unique(np.concatenate(fairing.boundary_loops(patch)))
    moving = np.setdiff1d(patch, boundary)
    on = np.array([side(vertices) < 1e-9 for side in sides])
    edges = measures.edges(triangles)
    edges = edges[np.count_nonzero(on[:, edges].all(axis=2), axis=0) > 1]
    within = np.isin(edges, moving).any(axis=1)
    normals = fairing.boundary_normals(vertices, patch, boundary, outside=outside, creases=edges).normals
    ends = vertices[measures.edges(patch)]
    thrown = vertices.copy()
    size = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean()
    thrown[moving] += 0.2 * size * np.random.default_rng(0).normal(size=(len(moving), 3))
    faired = fairing.fair_edges(thrown, edges[within], edges[~within])
    curve = np.unique(np.concatenate(faired.curves))
    fixed = np.union1d(boundary, curve)
    at_fixed = np.tile([0.0, 0.0, 1.0], (len(fixed), 1))
    at_fixed[np.isin(fixed, boundary)] = normals
    return Dented(faired.vertices, patch, fixed, at_fixed, curve, edges[within], sides)


def dented_edge(n: int, seed: int) -> Dented:
    exact = box_edge(n, seed)
    return dented(exact.vertices, exact.triangles, exact.distances, (0.0, 0.5, 0.0), 0.35)


def dented_corner(n: int, seed: int) -> Dented:
    exact = box_corner(n, seed)
    return dented(exact.vertices, exact.triangles, exact.distances, (0.0, 0.0, 0.0), 0.6)


def dented_rim(rings: int, seed: int) -> Dented:
    exact = lid(rings, seed)
    return dented(exact.vertices, exact.triangles, exact.distances, (1.0, 0.0, 0.0), 0.5)


def dented_sheet(n: int, seed: int, bend: float = 0.5) -> Dented:
    exact, sides = _bent_sheet(n, seed, bend)
    return dented(exact.vertices, exact.triangles, sides, (0.0, 0.5, 0.0), 0.3)
