"""Holes at which hard edges of the mesh end."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.border import border_loops
from addon.arrays.region import MeshArrays
from addon.arrays.types import Ints
from addon.fill.across import reported
from addon.fill.filling import fill
from addon.fill.verdict import hard_ends
from addon.options.other_options import FillOptions
from addon.verdict.verdict import GOOD, LOOK

from polygon_mesh import grid_points, grid_quads, polygon_mesh

SIZE = 24  # faces along each side of [−1, 1]²


def roof(degrees: float, hole_at: float) -> MeshArrays:
    """Two slopes that meet in a ridge along x, with a square hole of 6 × 6 faces around (0, hole_at)."""
    flat = grid_points(SIZE)
    points = flat.copy()
    points[:, 2] = -np.tan(np.radians(degrees) / 2.0) * np.abs(flat[:, 1])
    quads = np.array(grid_quads(SIZE))
    away = np.abs(flat[quads].mean(axis=1) - [0.0, hole_at, 0.0])[:, :2].max(axis=1)
    left = quads[away > 0.26]
    return polygon_mesh(points, left.tolist(), np.zeros(len(left), dtype=bool))


def rim(mesh: MeshArrays, hole_at: float) -> Ints:
    chosen = np.abs(grid_points(SIZE)[:, :2] - [0.0, hole_at]).max(axis=1) < 0.3
    ((loop,), _) = border_loops(mesh, chosen)
    return loop


@pytest.mark.parametrize("degrees", [90.0, 50.0])
def test_a_ridge_ends_on_both_sides_of_a_hole(degrees: float) -> None:
    mesh = roof(degrees, 0.0)
    loop = rim(mesh, 0.0)
    ends = mesh.positions[hard_ends(mesh, loop, mesh.triangles)]
    np.testing.assert_allclose(ends, [[-0.25, 0.0, 0.0], [0.25, 0.0, 0.0]], atol=1e-12)
    (piece,) = fill(mesh, np.eye(4), [loop], FillOptions(allow_folds=True, run_on=False)).pieces
    assert piece.verdict.grade != GOOD


@pytest.mark.parametrize("degrees", [90.0, 50.0])
def test_a_ridge_runs_on_through_a_hole(degrees: float) -> None:
    """The two slopes come back, the report says why, and no quad lies over the ridge."""
    mesh = roof(degrees, 0.0)
    (piece,) = fill(mesh, np.eye(4), [rim(mesh, 0.0)], FillOptions(quads=True)).pieces
    assert piece.verdict.grade == GOOD
    assert reported([piece.across, piece.across]) == "2 run on"
    slope = np.tan(np.radians(degrees) / 2.0)
    np.testing.assert_allclose(piece.points[:, 2], -slope * np.abs(piece.points[:, 1]), atol=1e-9)
    on_ridge = np.unique(piece.across.edges)
    np.testing.assert_allclose(piece.points[on_ridge, 1:], 0.0, atol=1e-9)
    lines = np.empty((0, 2), dtype=np.int64)
    polygons = piece.faces(np.zeros(len(piece.triangles), dtype=np.int64), lines).polygons
    assert max(map(len, polygons)) == 4
    for polygon in polygons:
        sides = np.sign(np.round(piece.points[polygon, 1], 9))
        assert not {-1.0, 1.0} <= set(sides.tolist())
    assert not len(piece.across.sharp)


def test_the_surface_over_it_is_worth_a_look_though_no_kink_is_seen() -> None:
    """A ridge of 36° leaves kinks that the mesh's own bends hide."""
    mesh = roof(36.0, 0.0)
    (piece,) = fill(mesh, np.eye(4), [rim(mesh, 0.0)], FillOptions(run_on=False)).pieces
    assert (piece.verdict.grade, len(piece.join.seen)) == (LOOK, 0)
    assert "Hard edges end at the hole, at 2 vertices" in piece.verdict.reason


@pytest.mark.parametrize(("degrees", "hole_at"), [(20.0, 0.0), (90.0, 0.5)])
def test_soft_ridges_and_those_beside_the_hole_don_t_count(degrees: float, hole_at: float) -> None:
    mesh = roof(degrees, hole_at)
    assert len(hard_ends(mesh, rim(mesh, hole_at), mesh.triangles)) == 0


@pytest.mark.parametrize("noise", [0.02, 0.04])
def test_noise_around_a_hole_has_no_hard_edges(noise: float) -> None:
    mesh = roof(0.0, 0.0)
    rough = mesh.positions + np.random.default_rng(3).normal(scale=noise, size=mesh.positions.shape)
    assert len(hard_ends(replace(mesh, positions=rough), rim(mesh, 0.0), mesh.triangles)) == 0
