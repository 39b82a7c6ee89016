"""Where a new surface passes through faces that are no part of it."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.fair.solve import solve
from addon.options.options import FairOptions
from addon.remesh.remeshing import remesh_arrays
from addon.verdict.outcome import outcome
from addon.verdict.verdict import LOOK

from polygon_mesh import grid_points, grid_quads, polygon_mesh

SIZE = 12


def dent_below_a_plate(height: float, slope: float = 0.0) -> MeshArrays:
    """A plain with a dent, which is selected, and a plate over its middle, at heights around this one."""
    points = grid_points(SIZE)
    selected = np.abs(points[np.array(grid_quads(SIZE))].mean(axis=1)).max(axis=1) < 0.6
    points[:, 2] = -0.8 * np.clip(0.5 - np.hypot(points[:, 0], points[:, 1]), 0.0, None)
    plate = np.array([[-0.1, -0.1, 0.0], [0.1, -0.1, 0.0], [0.1, 0.1, 0.0], [-0.1, 0.1, 0.0]])
    plate[:, 2] = height + slope * plate[:, 0]
    quads = [*grid_quads(SIZE), [len(points) + k for k in range(4)]]
    return polygon_mesh(np.concatenate([points, plate]), quads, [*selected, False])


def reason(mesh: MeshArrays, anew: bool = False) -> str:
    if anew:
        verdict = remesh_arrays(mesh, np.eye(4), FairOptions(remesh=True)).verdict
    else:
        verdict = outcome(mesh, np.eye(4), FairOptions(), solve(mesh, np.eye(4), FairOptions())).verdict
    if "passes through faces outside" not in verdict.reason:
        return ""
    assert verdict.grade == LOOK
    near = np.abs(mesh.positions[verdict.spots, :2]).max(axis=1)
    assert near.max() < 0.35  # beside the plate
    return verdict.reason


def test_a_surface_that_rises_through_a_plate_is_worth_a_look() -> None:
    assert reason(dent_below_a_plate(0.01, slope=1.0))


def test_a_new_mesh_that_rises_through_a_plate_is_worth_a_look() -> None:
    assert reason(dent_below_a_plate(0.01, slope=1.0), anew=True)


@pytest.mark.parametrize("anew", [False, True])
def test_a_plate_above_is_no_matter(anew: bool) -> None:
    assert not reason(dent_below_a_plate(0.2), anew)


@pytest.mark.parametrize("anew", [False, True])
def test_what_passed_through_before_is_no_news(anew: bool) -> None:
    mesh = dent_below_a_plate(0.0, slope=1.0)
    lower = mesh.positions.copy()
    lower[-4:, 2] = [-0.9, 0.1, 0.1, -0.9]  # through the dent's floor and through the plain
    assert not reason(replace(mesh, positions=lower), anew)
