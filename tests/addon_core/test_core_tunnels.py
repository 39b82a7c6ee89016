"""Tunnels in a selection: the genus of its pieces, and the sentence on it where a result is not good."""

import numpy as np
import pytest
from addon.arrays.types import Ints
from addon.selection.selection import tunnels

from polygon_mesh import grid_quads

AROUND, ACROSS = 12, 8


def split(quads: Ints) -> Ints:
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def torus_quads() -> Ints:
    i, j = (part.ravel() for part in np.mgrid[:AROUND, :ACROSS])
    right, up = (i + 1) % AROUND, (j + 1) % ACROSS
    return np.stack([i * ACROSS + j, right * ACROSS + j, right * ACROSS + up, i * ACROSS + up], axis=1)


def grid_without(*faces: int) -> Ints:
    quads = np.array(grid_quads(6))
    return split(np.delete(quads, faces, axis=0))


@pytest.mark.parametrize(
    ("triangles", "count"),
    [
        (grid_without(), 0),
        (grid_without(14), 0),  # a ring
        (grid_without(14, 21), 0),  # two holes that touch in a vertex
        (grid_without(14, 9), 0),
        (grid_without(0, 5), 0),
        (split(torus_quads()), 1),
        (split(np.delete(torus_quads(), [0], axis=0)), 1),
        (split(np.delete(torus_quads(), [0, 50], axis=0)), 1),
        (split(torus_quads()[: 7 * ACROSS]), 0),  # a tube
    ],
)
def test_tunnels_are_counted(triangles: Ints, count: int) -> None:
    assert tunnels(triangles) == count
