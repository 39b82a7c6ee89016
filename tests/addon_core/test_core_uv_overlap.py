"""New faces that lie over others in the texture are reported."""

from __future__ import annotations

import numpy as np
from addon.arrays.types import Floats
from addon.remesh.uv_overlap import covering


def sheet(cells: int, low: tuple[float, float] = (0.0, 0.0), size: float = 1.0) -> Floats:
    """A square of 2 · cells² triangles: (m, 3, 2)."""
    x, y = (size / cells * index.ravel() for index in np.mgrid[:cells, :cells])
    step = size / cells
    corners = np.stack([np.stack([x, y], 1), np.stack([x + step, y], 1), np.stack([x + step, y + step], 1)], 1)
    others = np.stack([np.stack([x, y], 1), np.stack([x + step, y + step], 1), np.stack([x, y + step], 1)], 1)
    found: Floats = np.concatenate([corners, others]) + low
    return found


def test_neighbours_are_beside_each_other() -> None:
    assert not covering(sheet(8), np.concatenate([sheet(5, (1.0, 0.0)), sheet(3, (-1.0, 0.3))])).any()


def test_what_lies_over_an_island_is_reported_whichever_is_finer() -> None:
    new = sheet(8)
    middles = new.mean(axis=1)
    for cells in (1, 5, 40):
        found = covering(new, sheet(cells, (0.5, 0.5), 0.5))
        inside = (middles > 0.5).all(axis=1)
        assert found[inside].all()
        assert not found[(middles < 0.5).any(axis=1)].any()


def test_the_winding_of_either_makes_no_difference() -> None:
    new, other = sheet(4), sheet(3, (0.3, 0.2), 0.4)
    for a, b in ((new[:, ::-1], other), (new, other[:, ::-1])):
        np.testing.assert_array_equal(covering(a, b), covering(new, other))


def test_new_faces_over_each_other_are_reported() -> None:
    both = np.concatenate([sheet(4), sheet(3, (0.1, 0.1), 0.3), sheet(3, (5.0, 0.0))])
    found = covering(both, both[:0])
    assert found[32:50].all()
    assert not found[50:].any()


def test_what_is_not_finite_or_has_no_size_lies_nowhere() -> None:
    odd = np.concatenate([np.full((2, 3, 2), np.nan), np.full((2, 3, 2), np.inf), sheet(1) * 0.0, sheet(1)])
    odd[-2:, 0] = np.inf
    assert not covering(odd, sheet(3)).any()
    assert not covering(sheet(3), odd).any()
