"""Triangles, normals and mean curvature of what an overlay shows. Arrays in, arrays out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask
from .findings import Origin
from .region import MeshArrays
from .sentences import in_mesh_words

RINGS = 2  # around what is shown, so that its border is measured from both sides


@dataclass(frozen=True)
class Surface:
    """What is drawn: n vertices in world space."""

    positions: Floats  # (n, 3)
    triangles: Ints  # (t, 3)
    normals: Floats  # (n, 3) unit, fitted
    curvature: Floats  # (n,) H in 1/length, negative where it is convex from outside

    @property
    def largest_curvature(self) -> float:
        """The 90th percentile of |H|, so that a few spikes don't wash the colours out."""
        used = np.unique(self.triangles)
        return float(np.percentile(np.abs(self.curvature[used]), 90)) if len(used) else 0.0


def make_surface(mesh: MeshArrays, matrix: Floats, whole: bool) -> Surface:
    """Measure the patch of the mesh, or the whole of it, in world space.

    Raises MeshRefusal where the triangles are no surface, and ValueError for a flat object.
    """
    world = mesh.transformed(matrix)
    shown = np.ones(len(world.triangles), dtype=bool) if whole else world.in_patch[world.triangle_faces]
    grown = _grown(world.triangles, shown)
    near = world.triangles[grown]
    used, triangles = np.unique(near, return_inverse=True)
    triangles = triangles.reshape(-1, 3).astype(np.int64)
    positions = world.positions[used]
    number = np.zeros(len(world.positions), dtype=np.int64)
    number[used] = np.arange(len(used))
    with in_mesh_words(Origin(used, triangles, world.triangle_faces[grown])):
        return Surface(
            positions=positions,
            triangles=number[world.triangles[shown]],
            normals=fairing.vertex_normals(positions, triangles),
            curvature=fairing.mean_curvature(positions, triangles),
        )


def _grown(triangles: Ints, shown: Mask) -> Mask:
    """Return the mask of the triangles within RINGS of those in `shown`."""
    near: Mask = shown
    reached = np.zeros(int(triangles.max(initial=-1)) + 1, dtype=bool)
    for _ in range(RINGS):
        reached[triangles[near]] = True
        near = reached[triangles].any(axis=1)
    return near
