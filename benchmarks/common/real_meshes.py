"""Patches of scanned and modelled meshes: grown round a seed vertex, with normals from outside.

The meshes and `patches.json`, which also states the rule of growth, lie beside the checkout in
`shared/data`; they are not part of the project.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array
from scipy.sparse.csgraph import connected_components, dijkstra

import fairing
import measures
from engine import FloatArray
from meshing import IntArray
from polygons import edges_of, read_polygons, triangles_of

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"
RANDOM_MESHES = (
    "ict_head", "mh_body", "demosthenes-low-res", "wingnut", "plane_holes", "skull_low_resolution",
    "hand_lowres", "hammer", "spot_low_resolution", "spot_control_mesh", "cat-low-resolution",
    "fish_low_resolution", "goathead", "penguin",
)  # fmt: skip
Polygons = list[list[int]]


@dataclass(frozen=True)
class RealPatch:
    """A patch of a mesh, its vertices numbered 0 … p − 1.

    radius: of growth, along edges; fixed (k,) with normals (k, 3) fitted to the faces outside, fitted (k,)
    where that was possible; neighbours (e, 2) the polygons' edges; whole, outside: the mesh around, for
    pictures, and `vertices_in_mesh` the numbers there.
    """

    name: str
    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray
    fitted: NDArray[np.bool_]
    neighbours: IntArray
    radius: float
    whole: FloatArray
    outside: IntArray
    vertices_in_mesh: IntArray

    @property
    def free(self) -> int:
        """The number of free vertices."""
        return len(self.vertices) - len(self.fixed)

    @property
    def loops(self) -> int:
        """The number of boundaries."""
        return len(fairing.boundary_loops(self.triangles))

    @property
    def turn(self) -> float:
        """Largest angle between the normals at the ends of a boundary edge, degrees."""
        place = np.full(len(self.vertices), -1)
        place[self.fixed] = np.arange(len(self.fixed))
        ends = place[measures.border_edges(self.triangles)]
        first, second = self.normals[ends[:, 0]], self.normals[ends[:, 1]]
        return float(np.degrees(np.arccos(np.clip((first * second).sum(axis=1), -1, 1))).max())


@dataclass(frozen=True)
class Mesh:
    """A polygon mesh: vertices (n, 3); polygons and, as an array padded with their first corner, corners (f, w).

    triangles (m, 3) with owners (m,), the polygons they belong to; border (n,) mask; graph: edge lengths.
    """

    vertices: FloatArray
    polygons: Polygons
    corners: IntArray
    triangles: IntArray
    owners: IntArray
    border: NDArray[np.bool_]
    graph: csr_array


@lru_cache(maxsize=16)
def mesh(name: str) -> Mesh:
    """One of the meshes."""
    vertices, polygons = read_polygons(DATA / f"{name}.obj")
    width = max(map(len, polygons))
    triangles = triangles_of(polygons)
    border = np.zeros(len(vertices), dtype=bool)
    border[measures.border_edges(triangles)] = True
    ends = edges_of(polygons)
    lengths = np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1)
    return Mesh(
        vertices, polygons, np.array([p + p[:1] * (width - len(p)) for p in polygons]), triangles,
        np.repeat(np.arange(len(polygons)), [len(p) - 2 for p in polygons]), border,
        coo_array((lengths, (ends[:, 0], ends[:, 1])), shape=(len(vertices),) * 2).tocsr(),
    )  # fmt: skip


def grown(whole: Mesh, seed: int, radius: float) -> NDArray[np.bool_]:
    """Mask of the polygons of the patch, by the rule of `patches.json`."""
    away = dijkstra(whole.graph, directed=False, indices=seed, limit=radius)
    chosen = np.flatnonzero(np.isfinite(away)[whole.corners].all(axis=1))
    label = _pieces([whole.polygons[k] for k in chosen])
    at_seed = (whole.corners[chosen] == seed).any(axis=1)
    result = np.zeros(len(whole.polygons), dtype=bool)
    if at_seed.any():
        labels = np.unique(label[at_seed])
        best = labels[np.argmax([(label == piece).sum() for piece in labels])]
        result[chosen[label == best]] = True
    return result


def _pieces(polygons: Polygons) -> IntArray:
    """(k,) number of the piece that each polygon belongs to, pieces being joined by edges."""
    owner = np.repeat(np.arange(len(polygons)), [len(p) for p in polygons])
    ends = edges_of(polygons, unique=False)
    _, edge = np.unique(ends, axis=0, return_inverse=True)
    count = len(polygons)
    joined = coo_array((np.ones(len(owner)), (owner, count + edge.ravel())), shape=(count + len(owner),) * 2)
    return np.asarray(connected_components(joined, directed=False)[1][:count])


def make_patch(label: str, name: str, seed: int, radius: float) -> RealPatch | None:
    """The patch, or None where there is none or the whole mesh is taken."""
    whole = mesh(name)
    mask = grown(whole, seed, radius)
    inside, outside = whole.triangles[mask[whole.owners]], whole.triangles[~mask[whole.owners]]
    if not len(inside) or not len(outside):
        return None
    held = whole.border.copy()
    held[outside] = True
    used = np.unique(inside)
    number = np.full(len(whole.vertices), -1)
    number[used] = np.arange(len(used))
    fixed = number[used[held[used]]]
    normals, fitted = boundary_normals(whole, outside, used[fixed])
    edges = edges_of([polygon for polygon, taken in zip(whole.polygons, mask, strict=True) if taken])
    return RealPatch(
        label, whole.vertices[used], number[inside], fixed, normals, fitted, number[edges],
        radius, whole.vertices, outside, used,
    )  # fmt: skip


def boundary_normals(whole: Mesh, outside: IntArray, at: IntArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Normals fitted to the outside; averages of all faces where no outside face is adjacent."""
    found = fairing.surrounding_normals(whole.vertices, outside, at)
    missing = np.linalg.norm(found.normals, axis=1) < 0.5
    result = np.array(found.normals)
    if missing.any():
        result[missing] = fairing.vertex_normals(whole.vertices, whole.triangles, normals="averaged")[at[missing]]
    return result, found.fitted


def listed_patches() -> Iterator[RealPatch]:
    """Those of `patches.json`."""
    for entry in json.loads((DATA / "patches.json").read_text())["patches"]:
        name = Path(entry["mesh"]).stem
        made = make_patch(f"{name}:{entry['patch']}", name, entry["seed"], entry["radius"])
        if made is not None:
            yield made


def random_patches(count: int, seed: int = 0) -> Iterator[RealPatch]:
    """Seeds anywhere, radii of 4 to 15 % of the mesh's extent; 8 free vertices at least, 6000 in all at most."""
    rng: Any = np.random.default_rng(seed)
    found = tried = 0
    while found < count:
        name = RANDOM_MESHES[tried % len(RANDOM_MESHES)]
        vertices = mesh(name).vertices
        start = int(rng.integers(len(vertices)))
        radius = float(np.ptp(vertices, axis=0).max() * rng.uniform(0.04, 0.15))
        tried += 1
        made = make_patch(f"{name}:{start}:{radius:.3g}", name, start, radius)
        if made is not None and made.free >= 8 and len(made.vertices) <= 6000:
            found += 1
            yield made
