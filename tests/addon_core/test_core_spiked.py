"""Which starts have a shape that is no texture to keep."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.region import MeshArrays
from core.spiked import SPIKED, heights, is_spiked
from polygon_mesh import grid, on_sphere

MESH = grid(12, 0.6, on_sphere)


@pytest.mark.parametrize("sides", [4, 6, 9])
@pytest.mark.parametrize("size", [1e-3, 1.0, 40.0])
def test_the_height_of_a_pyramid_is_measured_in_edges_of_its_base(sides: int, size: float) -> None:
    turns = 2.0 * np.pi * np.arange(sides) / sides
    base = np.column_stack([np.cos(turns), np.sin(turns), np.zeros(sides)])
    edge = 2.0 * np.sin(np.pi / sides)
    points = size * np.concatenate([base, [[0.0, 0.0, 2.5 * edge]], [[7.0, 7.0, 7.0]]])
    fan = np.array([[k, (k + 1) % sides, sides] for k in range(sides)])
    found = heights(points, fan)
    assert found[sides] == pytest.approx(2.5)
    assert found[sides + 1] == 0.0  # in no triangle


def lifted(vertex: int, by: float) -> MeshArrays:
    positions = MESH.positions.copy()
    positions[vertex] *= 1.0 + by
    return replace(MESH, positions=positions)


def test_a_spike_is_told_from_a_bump() -> None:
    inside = MESH.corner_vertices[MESH.in_patch[MESH.corner_faces]]
    outside = MESH.corner_vertices[~MESH.in_patch[MESH.corner_faces]]
    middle = int(np.setdiff1d(inside, outside)[10])
    edge = float(np.linalg.norm(np.subtract(*MESH.positions[MESH.edges[0]])))
    assert not is_spiked(MESH)
    assert not is_spiked(lifted(middle, 0.8 * edge))
    assert is_spiked(lifted(middle, 3.0 * SPIKED * edge))
    assert is_spiked(lifted(middle, -3.0 * SPIKED * edge))
    pinned = MESH.pinned.copy()
    pinned[middle] = True  # a pin that was pulled out
    assert is_spiked(replace(lifted(middle, 3.0 * SPIKED * edge), pinned=pinned))
    assert not is_spiked(lifted(int(np.intersect1d(inside, outside)[0]), 3.0 * SPIKED * edge))  # it stays
