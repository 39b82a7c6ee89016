"""Holes in real meshes: discs of faces that were deleted, and those that a mesh has."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import fairing
import real_meshes
from holes import FloatArray, IntArray


@dataclass(frozen=True)
class Hole:
    """A boundary loop, the hole on its left."""

    name: str
    points: FloatArray
    outside: IntArray
    loop: IntArray


def random_discs(count: int, seed: int) -> Iterator[Hole]:
    """Random patches with one boundary loop."""
    found = 0
    for patch in real_meshes.random_patches(4 * count, seed):
        if patch.loops != 1:
            continue
        loops = fairing.boundary_loops(patch.triangles)
        yield Hole(patch.name, patch.whole, patch.outside, patch.vertices_in_mesh[loops[0]])
        found += 1
        if found == count:
            return


def natural() -> Iterator[Hole]:
    """Those of a plane with holes."""
    whole = real_meshes.mesh("plane_holes")
    for k, loop in enumerate(fairing.hole_loops(whole.vertices, whole.triangles).loops):
        yield Hole(f"plane_holes, {k}", whole.vertices, whole.triangles, loop)
