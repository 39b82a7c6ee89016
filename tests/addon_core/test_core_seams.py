"""Doubled vertices inside a selection are an open border that stays: what it holds up must not count as good."""

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.arrays.types import Floats
from addon.fair.solve import solve
from addon.options.options import FairOptions
from addon.verdict.outcome import Fairing, outcome

from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh

SIZE = 16
EYE = np.eye(4)


def slit_sphere(height: float, split: bool = True) -> MeshArrays:
    """A side of a cubic sphere with a bump in its selected middle, whose middle row is doubled inside."""
    points, quads = grid_points(SIZE), np.array(grid_quads(SIZE))
    selected = grid(SIZE, 0.6).in_patch
    row = np.flatnonzero((points[:, 1] == 0.0) & (np.abs(points[:, 0]) < 0.4))
    doubles = len(points) + np.arange(len(row))
    above = quads[:, 0] >= (SIZE // 2) * (SIZE + 1)
    if split:
        twin = np.arange(len(points))
        twin[row] = doubles
        quads[above] = twin[quads[above]]
        points = np.concatenate([points, points[row]])
    bump = 1.0 + height * np.exp(-((points**2).sum(axis=1)) / 0.05)
    return polygon_mesh(on_sphere(points) * bump[:, None], quads.tolist(), selected)


def fair(mesh: MeshArrays, matrix: Floats = EYE) -> Fairing:
    options = FairOptions()
    return outcome(mesh, matrix, options, solve(mesh, matrix, options))


def test_a_crest_on_a_doubled_seam_is_not_good() -> None:
    done = fair(slit_sphere(0.3))
    assert done.verdict.grade == "LOOK"
    assert "seam of doubled vertices" in done.verdict.reason
    mesh = slit_sphere(0.3)
    on_row = np.flatnonzero((np.abs(mesh.positions[:, 1]) < 1e-9) & (np.abs(mesh.positions[:, 0]) < 0.45))
    assert set(done.verdict.spots) <= set(on_row)
    assert len(done.verdict.spots) > 6


@pytest.mark.parametrize("mesh", [slit_sphere(0.0), slit_sphere(0.3, split=False)])
def test_a_seam_that_holds_nothing_up_is_fine(mesh: MeshArrays) -> None:
    assert fair(mesh).verdict.grade == "GOOD"
