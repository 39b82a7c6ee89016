"""The places that are named where a surface between boundary loops is thin or thick."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from core.arrays import Floats, Ints
from core.waist import belly, waist

AROUND, ROWS = 16, 40


def tube(radius: Callable[[Floats], Floats]) -> tuple[Floats, Ints]:
    """A tube along z from 0 to 4, (ROWS + 1) circles of AROUND vertices."""
    z, turn = np.meshgrid(np.linspace(0.0, 4.0, ROWS + 1), 2.0 * np.pi * np.arange(AROUND) / AROUND, indexing="ij")
    points = np.stack([radius(z) * np.cos(turn), radius(z) * np.sin(turn), z], axis=-1).reshape(-1, 3)
    row, column = (index.ravel() for index in np.mgrid[:ROWS, :AROUND])
    a, b = AROUND * row + column, AROUND * row + (column + 1) % AROUND
    return points, np.concatenate([np.column_stack([a, b, b + AROUND]), np.column_stack([a, b + AROUND, a + AROUND])])


@pytest.mark.parametrize("at", [1.2, 2.0, 3.0])
@pytest.mark.parametrize(("find", "depth"), [(waist, -0.3), (belly, 0.6)])
def test_the_places_are_where_the_tube_is_thinnest_or_thickest(
    find: Callable[[Floats, Ints], Ints], depth: float, at: float
) -> None:
    points, triangles = tube(lambda z: 1.0 + depth * np.exp(-(((z - at) / 0.6) ** 2)))
    found = points[find(points, triangles), 2]
    assert len(found) >= AROUND
    assert np.abs(found - at).max() < 0.35


def test_a_cone_is_thinnest_at_its_thin_end() -> None:
    points, triangles = tube(lambda z: 1.0 + z)
    assert points[waist(points, triangles), 2].max() < 1.5
    assert points[belly(points, triangles), 2].min() > 2.5


def test_only_the_tube_counts_beside_a_disc() -> None:
    points, triangles = tube(lambda z: 1.0 - 0.3 * np.exp(-(((z - 2.0) / 0.6) ** 2)))
    disc = np.array([[9.0, 0.0, 0.0], [10.0, 0.0, 0.0], [9.0, 1.0, 0.0]])
    found = waist(np.concatenate([points, disc]), np.concatenate([triangles, [[656, 657, 658]]]))
    assert np.abs(points[found, 2] - 2.0).max() < 0.35
