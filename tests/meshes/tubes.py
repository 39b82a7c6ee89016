"""Tubes round plane curves with irregular meshes, as problems with a boundary and normals only."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CloughTocher2DInterpolator
from scipy.spatial import Delaunay

import fairing

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Tube:
    """vertices (n, 3), of which only `fixed` (k,) mean anything; normals (k, 3) there; triangles (m, 3)."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray

    @property
    def diameter(self) -> float:
        """D."""
        rim = self.vertices[self.fixed]
        return float(2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())

    def faired(self, **options: Any) -> fairing.FairResult:
        """The surface of least variation from the boundary alone; `seed` scatters the interior."""
        start = self.vertices.copy()
        free = np.setdiff1d(np.arange(len(start)), self.fixed)
        start[free] = np.random.default_rng(options.pop("seed", 0)).normal(size=(len(free), 3))
        settings: dict[str, Any] = {"equation": "least_variation", "threads": 1, **options}
        return fairing.fair(start, self.triangles, fixed=self.fixed, fixed_normals=self.normals, **settings)


def _chart(around: int, length: float, seed: int) -> tuple[FloatArray, IntArray, int]:
    """Points (u, v) in edges, u of period `around`; triangles; the number of free ones, which come first."""
    rng = np.random.default_rng(seed)
    rows = max(2, round(length / np.sqrt(0.75)))
    column = np.arange(around)
    inner = [
        np.column_stack(
            [
                column + 0.5 * (k % 2) + rng.uniform(-0.35, 0.35, around),
                k * length / rows + rng.uniform(-0.3, 0.3, around),
            ]
        )
        for k in range(1, rows)
    ]
    rims = [np.column_stack([column + shift, np.full(around, v)]) for shift, v in ((0.0, 0.0), (0.4, length))]
    points = np.concatenate([*inner, *rims])
    points[:, 0] %= around
    copies = np.concatenate([points + np.array([k * around, 0.0]) for k in (-1, 0, 1)])
    simplices = Delaunay(copies).simplices
    corners = copies[simplices]
    twice = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    middle = corners.mean(axis=1)[:, 0]
    kept = (middle >= 0) & (middle < around) & (np.abs(twice) > 1e-9)
    simplices[twice < 0] = simplices[twice < 0][:, ::-1]
    return points, (simplices[kept] % len(points)).astype(np.int64), (rows - 1) * around


def tube(curve: FloatArray, radii: tuple[float, float], lean: float = 0.0, around: int = 24, seed: int = 0) -> Tube:
    """Round a plane curve (m, 3) in y = 0; the ends lean inwards by `lean` degrees."""
    steps = np.linalg.norm(np.diff(curve, axis=0), axis=1)
    arc = np.concatenate([[0.0], np.cumsum(steps)])
    tangents = np.gradient(curve, arc, axis=0, edge_order=2)
    points, triangles, free = _chart(around, arc[-1] * around / (np.pi * sum(radii)), seed)
    t = points[:, 1] / points[:, 1].max()

    def along(values: FloatArray) -> FloatArray:
        return np.column_stack([np.interp(t, arc / arc[-1], values[:, k]) for k in range(3)])

    tangent = along(tangents)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    across = np.cross([0.0, 1.0, 0.0], tangent)
    angle = 2 * np.pi * points[:, 0] / around
    outward = np.cos(angle)[:, None] * across + np.sin(angle)[:, None] * [0.0, 1.0, 0.0]
    vertices = along(curve) + ((1 - t) * radii[0] + t * radii[1])[:, None] * outward
    fixed = np.arange(free, len(points))
    sign = np.where(t[fixed] < 0.5, 1.0, -1.0)[:, None]
    normals = np.cos(np.radians(lean)) * outward[fixed] + sign * np.sin(np.radians(lean)) * tangent[fixed]
    corners = vertices[triangles]
    facing = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    if (facing * outward[triangles[:, 0]]).sum() < 0:
        triangles = triangles[:, ::-1].copy()
    return Tube(vertices, triangles, fixed, normals)


def pipe(length: float, lean: float = 0.0, radii: tuple[float, float] = (1.0, 1.0), **style: int) -> Tube:
    """Along z."""
    z = np.linspace(0.0, length, 50)
    return tube(np.column_stack([0 * z, 0 * z, z]), radii, lean, **style)


def elbow(bend: float, degrees: float, **style: int) -> Tube:
    """Part of a torus of radii `bend` and 1, round the axis x = bend, z = 0."""
    angle = np.linspace(0.0, np.radians(degrees), 200)
    return tube(bend * np.column_stack([1 - np.cos(angle), 0 * angle, np.sin(angle)]), (1.0, 1.0), **style)


def s_bend(bend: float, degrees: float, **style: int) -> Tube:
    """One elbow and another one back."""
    angle = np.linspace(0.0, np.radians(degrees), 200)
    half = bend * np.column_stack([1 - np.cos(angle), 0 * angle, np.sin(angle)])
    return tube(np.concatenate([half, 2 * half[-1] - half[-2::-1]]), (1.0, 1.0), **style)


def radii(result: fairing.FairResult) -> FloatArray:
    """Distances (n,) from the axis of a straight tube."""
    return np.asarray(np.hypot(result.vertices[:, 0], result.vertices[:, 1]))


def off_torus(vertices: FloatArray, bend: float) -> float:
    """Largest distance from the elbow's torus."""
    axis = np.hypot(vertices[:, 0] - bend, vertices[:, 2]) - bend
    return float(np.abs(np.hypot(axis, vertices[:, 1]) - 1).max())


def _around_torus(vertices: FloatArray, bend: float) -> tuple[FloatArray, FloatArray]:
    """(n, 2) lengths along and around an elbow's torus; (n,) distances from its circle."""
    along = bend * np.arctan2(vertices[:, 2], bend - vertices[:, 0])
    out = np.hypot(vertices[:, 0] - bend, vertices[:, 2]) - bend
    return np.column_stack([along, np.arctan2(vertices[:, 1], out)]), np.hypot(out, vertices[:, 1])


def apart(tube: Tube, first: FloatArray, second: FloatArray, bend: float) -> float:
    """How far the first surface's free vertices are from the second one, along the torus' normals.

    Between vertices the distance from the torus' circle is interpolated, so that chords don't count.
    """
    places, distances = _around_torus(second, bend)
    turned = np.concatenate([places + np.array([0.0, 2 * np.pi * k]) for k in (-1, 0, 1)])
    free = np.setdiff1d(np.arange(len(first)), tube.fixed)
    at, expected = _around_torus(first[free], bend)
    return float(np.nanmax(np.abs(CloughTocher2DInterpolator(turned, np.tile(distances, 3))(at) - expected)))
