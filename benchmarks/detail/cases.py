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
FOREHEAD = (0.2, -0.42, 0.9)  # of Suzanne
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
    """The patch of a scan, pushed out."""
    return pushed_out(patch.name, patch.whole, patch.vertices_in_mesh[patch.triangles], patch.outside)


def pushed_out(name: str, whole: FloatArray, inside: IntArray, outside: IntArray) -> Case:
    """The patch pushed out along its mean normal, by a smooth step of the distance from the outline."""
    outline, own = np.intersect1d(inside, outside), np.unique(inside)
    rim = whole[outline]
    away = np.array([np.linalg.norm(rim - point, axis=1).min() for point in whole[own]])
    step = np.clip((away / away.max() - SWOLLEN_FROM) / (1 - SWOLLEN_FROM), 0, 1)
    size = 2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max()
    up = mean_normal(whole, inside)
    vertices = whole.copy()
    vertices[own] += (SWELLING * size * step**2 * (3 - 2 * step))[:, None] * up
    return _case(name, vertices, whole, (inside, outside), up)


def orange_skin(points: FloatArray, triangles: IntArray, wavelength: float) -> FloatArray:
    """The surface with bumps of this size all over, a twentieth of it high, along its normals."""
    rng = np.random.default_rng(4)
    waves = rng.normal(size=(60, 3))
    waves *= 2 * np.pi / wavelength / np.linalg.norm(waves, axis=1)[:, None]
    heights = np.sin(points @ waves.T + rng.uniform(0, 2 * np.pi, 60)).mean(axis=1) * np.sqrt(120)
    normals = fairing.vertex_normals(points, triangles)
    return np.asarray(points + 0.05 * wavelength * heights[:, None] * normals)


def orange_skins() -> Iterator[Case]:
    """The hammer's head, and Suzanne's forehead (needs bpy), with orange skin and a swelling."""
    whole = real_meshes.mesh("hammer")
    patch = real_meshes.make_patch("orange", "hammer", 9000, 0.05 * float(np.ptp(whole.vertices, axis=0).max()))
    if patch is not None:
        inside = patch.vertices_in_mesh[patch.triangles]
        rough = orange_skin(patch.whole, np.concatenate([inside, patch.outside]), 0.008 * float(np.ptp(patch.whole)))
        yield pushed_out("orange", rough, inside, patch.outside)
    yield suzanne()


def suzanne() -> Case:
    """Her forehead, off its middle."""
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_monkey_add()
    monkey = bpy.context.object
    modifier = monkey.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = 4
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    points = np.array([vertex.co for vertex in monkey.data.vertices], dtype=np.float64)
    quads = np.array([tuple(polygon.vertices) for polygon in monkey.data.polygons])
    triangles = np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])
    rough = orange_skin(points, triangles, 0.09)
    away = np.linalg.norm(points - FOREHEAD, axis=1)[triangles].max(axis=1)
    return pushed_out("suzanne", rough, triangles[away < 0.26], triangles[(away >= 0.26) & (away < 0.7)])


def mean_normal(points: FloatArray, triangles: IntArray) -> FloatArray:
    """The mean normal of some triangles."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    total = np.cross(b - a, c - a).sum(axis=0)
    return np.asarray(total / np.linalg.norm(total))
