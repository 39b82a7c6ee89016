"""Rough surfaces with a swelling: a sphere, and patches of scans."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull

import fairing
import real_meshes
from engine import FloatArray
from meshing import IntArray

SWELLING = 0.12  # of D
SWOLLEN_FROM = 0.15  # of the way from the outline to the middle


@dataclass(frozen=True)
class Case:
    """A mesh (n, 3) with a swelling inside the patch, and `skin`, the same without; outline (k,) with normals."""

    name: str
    vertices: FloatArray
    skin: FloatArray
    inside: IntArray
    outside: IntArray
    outline: IntArray
    normals: FloatArray
    facing: FloatArray

    @property
    def free(self) -> IntArray:
        """Vertices that may move."""
        return np.setdiff1d(self.inside, self.outline)

    @property
    def diameter(self) -> float:
        """D."""
        rim = self.vertices[self.outline]
        return float(2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())

    def fair(self, **options: object) -> fairing.FairResult:
        """One run."""
        return fairing.fair(
            self.vertices, self.inside, fixed=self.outline, fixed_normals=self.normals, outside=self.outside, **options
        )


def sphere(count: int, noise: float, seed: int, *, along_normal: bool) -> Case:
    """Unit sphere of irregular triangles; noise: root mean square move in edges. The patch is z > 0.3."""
    rng = np.random.default_rng(seed)
    spacing = np.sqrt(8 * np.pi / (count * np.sqrt(3)))
    exact = _spread(count) + rng.normal(size=(count, 3)) * 0.15 * spacing
    exact /= np.linalg.norm(exact, axis=1)[:, None]
    triangles = _outward(exact, ConvexHull(exact).simplices)
    shift = exact * rng.normal(size=(count, 1)) if along_normal else rng.normal(size=(count, 3)) / np.sqrt(3)
    skin = exact + shift * noise * spacing
    rise = np.clip((exact[:, 2] - 0.4) / 0.6, 0, 1)
    swollen = skin + 0.35 * (rise**2 * (3 - 2 * rise))[:, None] * exact
    inside = (exact[:, 2] > 0.3)[triangles].all(axis=1)
    return _case("sphere", swollen, skin, (triangles[inside], triangles[~inside]), np.array([0.3, -1.0, 1.0]))


def _spread(count: int) -> FloatArray:
    k = np.arange(count) + 0.5
    height, angle = 1 - 2 * k / count, np.pi * (1 + np.sqrt(5)) * k
    return np.stack([*(np.sqrt(1 - height**2) * np.array([np.cos(angle), np.sin(angle)])), height], axis=1)


def _outward(points: FloatArray, triangles: IntArray) -> IntArray:
    a, b, c = (points[triangles[:, k]] for k in range(3))
    inward = (np.cross(b - a, c - a) * (a + b + c)).sum(axis=1) < 0
    return np.where(inward[:, None], triangles[:, ::-1], triangles)


def _case(
    name: str, vertices: FloatArray, skin: FloatArray, parts: tuple[IntArray, IntArray], facing: FloatArray
) -> Case:
    inside, outside = parts
    outline = np.unique(np.concatenate(fairing.boundary_loops(inside)))
    normals = fairing.surrounding_normals(vertices, outside, outline).normals
    return Case(name, vertices, skin, inside, outside, outline, normals, facing)


def scans() -> Iterator[Case]:
    """A cheek of the bust, the handle of the hammer, the brow of the skull: each with a swelling on it."""
    for name, seed, radius in (("demosthenes-low-res", 2500, 0.12), ("hammer", 9000, 0.09), ("penguin", 700, 0.15)):
        whole = real_meshes.mesh(name)
        patch = real_meshes.make_patch(name, name, seed, radius * float(np.ptp(whole.vertices, axis=0).max()))
        if patch is not None:
            yield swollen(patch)


def swollen(patch: real_meshes.RealPatch) -> Case:
    """The patch pushed out along its mean normal, by a smooth step of the distance from the outline."""
    whole, inside = patch.whole, patch.vertices_in_mesh[patch.triangles]
    outline = patch.vertices_in_mesh[patch.fixed]
    away = np.array([np.linalg.norm(whole[outline] - point, axis=1).min() for point in patch.vertices])
    step = np.clip((away / away.max() - SWOLLEN_FROM) / (1 - SWOLLEN_FROM), 0, 1)
    rim = whole[outline]
    size = 2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max()
    up = mean_normal(whole, inside)
    vertices = whole.copy()
    vertices[patch.vertices_in_mesh] += (SWELLING * size * step**2 * (3 - 2 * step))[:, None] * up
    return _case(patch.name, vertices, whole, (inside, patch.outside), up)


def mean_normal(points: FloatArray, triangles: IntArray) -> FloatArray:
    """The mean normal of some triangles."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    total = np.cross(b - a, c - a).sum(axis=0)
    return np.asarray(total / np.linalg.norm(total))
