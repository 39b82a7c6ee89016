"""The inputs that all tools get: patches of known surfaces inside a mesh that reaches one ring beyond them.

Meshes are kept in a folder, since a million Delaunay points take a while.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache, partial
from pathlib import Path

import numpy as np
import peers_driver
from numpy.typing import NDArray

import blend
import measures
import shapes
from graded_disc import graded_disc
from shapes import Patch, Style

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]
Distance = Callable[[FloatArray], FloatArray]

PATCHES: dict[str, Callable[[int, Style], Patch]] = {
    "cap of 20°": partial(shapes.cap, half_angle=20.0),
    "cap of 60°": partial(shapes.cap, half_angle=60.0),
    "hemisphere": shapes.cap,
    "cylinder": shapes.cylinder,
    "clothoid cylinder": shapes.clothoid,
    "catenoid": shapes.catenoid,
    "r H′ = c": shapes.linear_flux,
    "graded hemisphere": graded_disc,
}
BLEND = "three-cylinder blend"
CAPS = ("cap of 20°", "cap of 60°", "hemisphere")
REGULAR, JITTERED = Style(jitter=0.0), Style()
# Random points, Delaunay in a stretched plane: valences 2 to 12, half of the least angles below 27°, edges 10 : 1.
IRREGULAR = Style(layout="random", stretch=2.5, jitter=0.0)
KINDS = {REGULAR: "regular", IRREGULAR: "irregular"}


@dataclass(frozen=True)
class Problem:
    """A patch and what surrounds it.

    vertices (n, 3): membrane inside, exact at `fixed` (k,), with exact unit normals (k, 3) there; triangles (m, 3);
    reference (n, 3): the mesh as it lies on the right surface (for the blend a membrane); ghosts (g, 3): the
    surface's vertices beyond the boundary, numbered from n on, strip (s, 3): the triangles between.
    """

    name: str
    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray
    reference: FloatArray
    ghosts: FloatArray
    strip: IntArray

    @cached_property
    def diameter(self) -> float:
        """D: twice the largest distance of the fixed vertices from their centroid."""
        boundary = self.vertices[self.fixed]
        return 2 * float(np.linalg.norm(boundary - boundary.mean(axis=0), axis=1).max())

    @cached_property
    def all_vertices(self) -> FloatArray:
        """With the ring outside, (n + g, 3)."""
        return np.vstack([self.vertices, self.ghosts])

    @cached_property
    def all_triangles(self) -> IntArray:
        """With the strip outside, (m + s, 3)."""
        return np.vstack([self.triangles, self.strip])

    @cached_property
    def free(self) -> IntArray:
        """Indices of the vertices that move."""
        return np.setdiff1d(np.arange(len(self.vertices)), self.fixed)

    @cached_property
    def held(self) -> IntArray:
        """The vertices of both outlines: those of the patch, then the ghosts."""
        return np.concatenate([self.fixed, np.arange(len(self.vertices), len(self.all_vertices))])

    def distance(self, points: FloatArray) -> FloatArray | None:
        """Distances (k,) to the exact surface over D; None where no closed form is known."""
        if self.name == BLEND:
            return None
        return _surface(self.name).distance(points) / self.diameter


@lru_cache
def _surface(name: str) -> Patch:
    return PATCHES[name](300, JITTERED)


def problem(folder: Path, name: str, size: int, style: Style = JITTERED) -> Problem:
    """Of about `size` free vertices, from the folder or made now."""
    kind = KINDS.get(style, f"seed {style.seed}")
    path = folder / f"{name}, {size}, {kind}.npz".replace(" ", "_").replace("/", "")
    if not path.exists():
        path.parent.mkdir(parents=True, exist_ok=True)
        made = _blend(size, style) if name == BLEND else _patch(name, size, style)
        np.savez(path, **{key: value for key, value in vars(made).items() if isinstance(value, np.ndarray)})
    with np.load(path) as arrays:
        return Problem(name, **{key: arrays[key] for key in arrays.files})


def _patch(name: str, size: int, style: Style) -> Problem:
    patch = PATCHES[name](size, style)
    ghosts, strip = _continued(patch.vertices, patch.triangles, patch.normals)
    ghosts = patch.surface.point(*patch.surface.locate(ghosts))
    start = patch.vertices.copy()
    start[patch.free] = _membrane(patch.vertices, patch.triangles, patch.free)
    return Problem(
        name, start, patch.triangles, patch.fixed, patch.fixed_normals, patch.vertices, ghosts, strip
    )  # fmt: skip


def _membrane(vertices: FloatArray, triangles: IntArray, free: IntArray) -> FloatArray:
    system = peers_driver.membrane_system(vertices, triangles, free)
    return np.asarray(system.factorised(peers_driver.Method.cholmod).solve(system.load))


def _blend(size: int, style: Style) -> Problem:
    made = blend.cylinder_blend(size, seed=style.seed)
    normals = np.zeros_like(made.vertices)
    normals[made.fixed] = made.fixed_normals
    ghosts, strip = _continued(made.vertices, made.triangles, normals)
    angles = blend.DIRECTIONS
    arms = np.column_stack([np.cos(angles), np.sin(angles), 0 * angles])
    axis = arms[(ghosts @ arms.T).argmax(axis=1)]
    along = (ghosts * axis).sum(axis=1)[:, None] * axis
    around = ghosts - along
    ghosts = along + around / np.linalg.norm(around, axis=1)[:, None]
    return Problem(
        BLEND, made.vertices, made.triangles, made.fixed, made.fixed_normals, made.vertices, ghosts, strip
    )  # fmt: skip


def _continued(vertices: FloatArray, triangles: IntArray, normals: FloatArray) -> tuple[FloatArray, IntArray]:
    """An equilateral triangle on every border edge, in the tangent planes, and those between them."""
    edges = measures.border_edges(triangles)
    start, end = edges.T
    edge = vertices[end] - vertices[start]
    outward = np.cross(edge, normals[start] + normals[end])
    outward *= (np.linalg.norm(edge, axis=1) / np.linalg.norm(outward, axis=1))[:, None]
    ghosts = 0.5 * (vertices[start] + vertices[end]) + 0.5 * np.sqrt(3) * outward
    number = len(vertices) + np.arange(len(edges))
    following = np.empty(len(vertices), dtype=np.int64)
    following[start] = number
    strip = np.vstack([np.column_stack([end, start, number]), np.column_stack([end, number, following[end]])])
    return ghosts, strip
