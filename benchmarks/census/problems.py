"""The problems that a census counts: patches of real meshes and exact surfaces, with and without options.

Names say what a problem is, and a seed makes all of them; seeds of 100 and more were used while rules were chosen up to
0.1.0, so that a report takes others.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

import real_meshes
import shapes
from engine import FloatArray
from meshing import IntArray
from shapes import Style

LARGEST = 20_000  # vertices of a patch
STYLES = {
    "even": Style(),
    "graded": Style(grading=12.0),
    "valence 3": Style(valence3=0.1, clusters=4),
    "flipped": Style(flips=0.2),
    "irregular": Style(layout="random", stretch=2.5, jitter=0.0),
}


@dataclass(frozen=True)
class Problem:
    """A call of `fairing.fair`.

    kind: row of the table; vertices (n, 3), triangles (m, 3), fixed (k,) with normals (k, 3); free: vertices that move;
    surface: of `tests/meshes/surfaces.py`, where the answer is known.
    """

    name: str
    kind: str
    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray
    options: dict[str, Any] = field(default_factory=dict)
    surface: Any = None

    @property
    def diameter(self) -> float:
        """D: twice the largest distance of the fixed vertices from their centroid."""
        boundary = self.vertices[self.fixed]
        return 2 * float(np.linalg.norm(boundary - boundary.mean(axis=0), axis=1).max())


def random_patches(count: int, seed: int, largest: int) -> Iterator[tuple[real_meshes.RealPatch, np.random.Generator]]:
    """Random patches of the real meshes, radii of 3 to 18 % of a mesh's extent, and the generator that made them."""
    rng = np.random.default_rng(seed)
    names = rng.permutation(real_meshes.RANDOM_MESHES)
    found = tried = 0
    while found < count:
        name = str(names[tried % len(names)])
        vertices = real_meshes.mesh(name).vertices
        start = int(rng.integers(len(vertices)))
        radius = float(np.ptp(vertices, axis=0).max() * rng.uniform(0.03, 0.18))
        tried += 1
        made = real_meshes.make_patch(f"{name}:{start}:{radius:.6g}", name, start, radius)
        if made is None or made.free < 8 or len(made.vertices) > largest or not len(made.fixed):
            continue
        found += 1
        yield made, rng


def patches(count: int, seed: int) -> Iterator[Problem]:
    """Random patches, some with other options."""
    for number, (made, rng) in enumerate(random_patches(count, seed, LARGEST), 1):
        yield _asked(made, number, rng)


def _asked(patch: real_meshes.RealPatch, number: int, rng: np.random.Generator) -> Problem:
    """Three of four as it is; the others in turn with noise, pins and conformal weights."""
    kind = "one loop" if patch.loops == 1 else "several loops"
    vertices, fixed, normals, options = patch.vertices, patch.fixed, patch.normals, dict[str, Any]()
    if number % 12 == 0:
        kind, options = f"{kind}, conformal weights", {"inner_fairness": "conformal"}
    elif number % 12 == 4:
        kind = f"{kind}, noise"
        edge = np.linalg.norm(vertices[patch.triangles[:, 0]] - vertices[patch.triangles[:, 1]], axis=1).mean()
        vertices = vertices + rng.normal(scale=0.1 * edge, size=vertices.shape)
        normals = normals + rng.normal(scale=0.1, size=normals.shape)
        normals /= np.linalg.norm(normals, axis=1)[:, None]
    elif number % 12 == 8:
        beside = patch.triangles[np.isin(patch.triangles, fixed).any(axis=1)]  # no pins: their normals count
        inside = np.setdiff1d(np.arange(len(vertices)), np.union1d(fixed, beside))
        if len(inside):
            kind = f"{kind}, pin"
            fixed = np.append(fixed, rng.choice(inside))
            normals = np.vstack([normals, [[0.0, 0.0, 1.0]]])
    return Problem(patch.name, kind, vertices, patch.triangles, fixed, normals, options)


def exact(seed: int, sizes: tuple[int, ...] = (300, 1000, 4000)) -> Iterator[Problem]:
    """Closed forms on meshes of all styles."""
    makers = {
        "cap": shapes.cap,
        "cylinder": shapes.cylinder,
        "catenoid": shapes.catenoid,
        "r H′ = c": shapes.linear_flux,
    }
    for name, make in makers.items():
        for style_name, style in STYLES.items():
            for size in sizes:
                patch = make(size, style=Style(**{**vars(style), "seed": seed}))
                yield Problem(
                    f"{name}, {style_name}, {size}", f"exact, {style_name}", shapes.membrane(patch.vertices,
                    patch.triangles, patch.fixed), patch.triangles, patch.fixed, patch.fixed_normals, {}, patch.surface,
                )  # fmt: skip


def problems(count: int, seed: int) -> Iterator[Problem]:
    """All of them."""
    yield from exact(seed)
    yield from patches(count, seed)
