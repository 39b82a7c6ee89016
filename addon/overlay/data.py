"""Triangles, normals and mean curvature of what an overlay shows. Arrays in, arrays out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from ..arrays.places import numbers_in
from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Ints, Mask
from ..words.findings import Origin
from ..words.sentences import in_mesh_words

RINGS = 2  # around what is shown, so that its border is measured from both sides


def sense(mode: str) -> float:
    """Return by what values are multiplied before they are coloured: H is positive where the surface caves in."""
    return 1.0 if mode == "DEVIATION" else -1.0


@dataclass(frozen=True)
class Surface:
    """What is drawn: n vertices in world space."""

    positions: Floats  # (n, 3)
    triangles: Ints  # (t, 3)
    normals: Floats  # (n, 3) unit, fitted
    curvature: Floats  # (n,) H in 1/length, negative where it is convex from outside
    deviation: Floats  # (n,) from the surface before the last run, in world space

    def values(self, mode: str) -> Floats:
        """Return what is drawn in colours (n,): CURVATURE or DEVIATION."""
        return self.deviation if mode == "DEVIATION" else self.curvature

    def usual(self, mode: str) -> float:
        """The 90th percentile of the values' sizes, so that a few spikes don't wash the colours out.

        Of deviations the largest: most are 0.
        """
        used = np.unique(self.triangles)
        sizes = np.abs(self.values(mode)[used])
        return float(np.percentile(sizes, 100 if mode == "DEVIATION" else 90)) if len(used) else 0.0

    def largest(self, mode: str) -> float:
        """The value of the largest size, with its sign."""
        shown = self.values(mode)[np.unique(self.triangles)]
        return float(shown[np.abs(shown).argmax()]) if len(shown) else 0.0


def make_surface(mesh: MeshArrays, matrix: Floats, whole: bool, deviation: Floats | None = None) -> Surface:
    """Measure the patch of the mesh, or the whole of it, in world space; deviation: (n,) of all its vertices.

    Raises MeshRefusal where the triangles are no surface, and ValueError for a flat object.
    """
    world = mesh.transformed(matrix)
    shown = np.ones(len(world.triangles), dtype=bool) if whole else world.in_patch[world.triangle_faces]
    grown = _grown(world.triangles, shown)
    near = world.triangles[grown]
    used, triangles = np.unique(near, return_inverse=True)
    triangles = triangles.reshape(-1, 3).astype(np.int64)
    positions = world.positions[used]
    number = numbers_in(used, len(world.positions))
    with in_mesh_words(Origin(used, triangles, world.triangle_faces[grown])):
        return Surface(
            positions=positions,
            triangles=number[world.triangles[shown]],
            normals=fairing.vertex_normals(positions, triangles),
            curvature=fairing.mean_curvature(positions, triangles),
            deviation=np.zeros(len(used)) if deviation is None else deviation[used],
        )


def _grown(triangles: Ints, shown: Mask) -> Mask:
    """Return the mask of the triangles within RINGS of those in `shown`."""
    near: Mask = shown
    reached = np.zeros(int(triangles.max(initial=-1)) + 1, dtype=bool)
    for _ in range(RINGS):
        reached[triangles[near]] = True
        near = reached[triangles].any(axis=1)
    return near
