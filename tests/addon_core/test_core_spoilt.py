"""Which starts have a shape that is no texture to keep."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.verdict.quality import is_spoilt

from polygon_mesh import grid, on_sphere

MESH = grid(12, 0.6, on_sphere)
SPIKE = 1.6  # edges over its neighbours, from which a vertex is pulled out


def lifted(vertex: int, by: float) -> MeshArrays:
    positions = MESH.positions.copy()
    positions[vertex] *= 1.0 + by
    return replace(MESH, positions=positions)


def test_a_spike_is_distinguished_from_a_bump() -> None:
    inside = MESH.corner_vertices[MESH.in_patch[MESH.corner_faces]]
    outside = MESH.corner_vertices[~MESH.in_patch[MESH.corner_faces]]
    middle = int(np.setdiff1d(inside, outside)[10])
    edge = float(np.linalg.norm(np.subtract(*MESH.positions[MESH.edges[0]])))
    assert not is_spoilt(MESH)
    assert not is_spoilt(lifted(middle, 0.8 * edge))
    assert is_spoilt(lifted(middle, 3.0 * SPIKE * edge))
    assert is_spoilt(lifted(middle, -3.0 * SPIKE * edge))
    pinned = MESH.pinned.copy()
    pinned[middle] = True  # a pin that was pulled out
    assert is_spoilt(replace(lifted(middle, 3.0 * SPIKE * edge), pinned=pinned))
    assert not is_spoilt(lifted(int(np.intersect1d(inside, outside)[0]), 3.0 * SPIKE * edge))  # it stays


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_crumpled_patch_is_distinguished_from_a_rough_mesh(seed: int) -> None:
    """By noise in edges of the mesh, of the patch alone and of all of it."""
    inside = np.setdiff1d(
        MESH.corner_vertices[MESH.in_patch[MESH.corner_faces]], MESH.corner_vertices[~MESH.in_patch[MESH.corner_faces]]
    )
    edge = float(np.linalg.norm(np.subtract(*MESH.positions[MESH.edges[0]])))
    noise = edge * np.random.default_rng(seed).normal(size=MESH.positions.shape)
    patch_only = np.zeros_like(noise)
    patch_only[inside] = noise[inside]
    assert not is_spoilt(replace(MESH, positions=MESH.positions + 0.1 * patch_only))
    assert is_spoilt(replace(MESH, positions=MESH.positions + 0.5 * patch_only))
    rough = MESH.positions + 0.5 * noise
    assert not is_spoilt(replace(MESH, positions=rough))
    rough[0] = np.nan  # far away
    assert not is_spoilt(replace(MESH, positions=rough))
