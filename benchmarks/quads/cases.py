"""Holes in real meshes: discs of faces that were deleted, and those that a mesh has."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

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
    """Random patches with one boundary loop, all around which faces are left."""
    found = 0
    for patch in real_meshes.random_patches(4 * count, seed):
        if patch.loops != 1:
            continue
        loops = fairing.boundary_loops(patch.triangles)
        if not _is_held(patch.vertices_in_mesh[loops[0]], patch.outside):
            continue
        yield Hole(patch.name, patch.whole, patch.outside, patch.vertices_in_mesh[loops[0]])
        found += 1
        if found == count:
            return


def _is_held(loop: IntArray, outside: IntArray) -> bool:
    sides = {(a, b) for a, b in outside[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).tolist()}
    return all((b, a) in sides for a, b in zip(loop.tolist(), np.roll(loop, -1).tolist(), strict=True))


def natural() -> Iterator[Hole]:
    """Those of a plane with holes."""
    whole = real_meshes.mesh("plane_holes")
    for k, loop in enumerate(fairing.hole_loops(whole.vertices, whole.triangles).loops):
        yield Hole(f"plane_holes, {k}", whole.vertices, whole.triangles, loop)


def subdivided(hole: Hole, level: int) -> Hole:
    """The same with each triangle parted into four, so many times over: the boundary keeps its shape."""
    points, outside, loop = hole.points, hole.outside.astype(np.int64), hole.loop.astype(np.int64)
    used = np.isin(outside, loop).any(axis=1)
    outside = outside[used | np.isin(outside, outside[used]).any(axis=1)]  # two rings are enough around
    for _ in range(level):
        sides = np.sort(outside[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        ends, which = np.unique(sides, axis=0, return_inverse=True)
        middle = len(points) + which.reshape(-1, 3)
        a, b, c = outside.T
        ab, bc, ca = middle.T
        around = np.sort(np.column_stack([loop, np.roll(loop, -1)]), axis=1)
        place = {tuple(pair): k for k, pair in enumerate(ends.tolist())}
        new = np.array([len(points) + place[tuple(pair)] for pair in around.tolist()])
        loop = np.column_stack([loop, new]).ravel()
        points = np.concatenate([points, points[ends].mean(axis=1)])
        outside = np.concatenate(
            [np.stack(each, axis=1) for each in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))]
        )
    return Hole(f"{hole.name} ×{2**level}", points, outside, loop)
