"""Curves and borders of a patch: which vertices hold with a slope that the surface finds."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core import solve
from core.options import FairOptions
from core.region import MeshArrays, make_patch
from polygon_mesh import grid, grid_points

SIZE = 8


def marked(mesh: MeshArrays) -> np.ndarray:  # type: ignore[type-arg]
    """(e,) edges of the middle column x = 0."""
    return np.abs(mesh.positions[mesh.edges][:, :, 0]).max(axis=1) < 1e-9


def with_curve(mesh: MeshArrays, kind: str) -> MeshArrays:
    edges = marked(mesh)
    pinned = mesh.pinned.copy()
    pinned[mesh.edges[edges]] = True
    return replace(mesh, pinned=pinned, **{kind: edges})


def test_a_crease_reaches_the_outline_and_a_smooth_curve_stops_before_it() -> None:
    mesh = grid(SIZE, 0.6)  # 4 × 4 quads: rows from −0.5 to 0.5
    sharp = make_patch(with_curve(mesh, "creases"))
    rounded = make_patch(with_curve(mesh, "smooth_curves"))
    heights = mesh.positions[sharp.vertices[sharp.creases], 1]
    assert np.allclose(np.sort(heights), [-0.5, -0.25, 0.0, 0.25, 0.5])
    inner = mesh.positions[rounded.vertices[rounded.smooth_curves], 1]
    assert np.allclose(np.sort(inner), [-0.25, 0.0, 0.25])
    assert len(sharp.smooth_curves) == len(rounded.creases) == 0
    assert np.isin(sharp.creases, sharp.fixed).all()


def test_a_border_that_becomes_fair_is_free_but_where_the_selection_ends() -> None:
    mesh = grid(SIZE, 2.0)
    mesh = replace(mesh, in_patch=mesh.positions[mesh.corner_vertices.reshape(-1, 4)][:, :, 0].mean(axis=1) > 0)
    held, faired = make_patch(mesh), make_patch(replace(mesh, fair_border=True))
    more = held.vertices[np.setdiff1d(faired.free, held.free)]
    points = mesh.positions[more]
    assert (np.abs(points[:, :2]).max(axis=1) > 1 - 1e-9).all()
    assert (points[:, 0] > 1e-9).all()
    assert len(more) == 2 * (SIZE // 2) + SIZE - 1


@pytest.mark.parametrize(
    ("options", "slope"),
    [
        ({}, "CREASE"),
        ({"pin_edges": "SHARP"}, "CREASE"),
        ({"method": "PAPER"}, "AVERAGE"),
        ({"pin_edges": "SEAM"}, "AVERAGE"),
        ({"pin_edges": "SEAM", "pin_slope": "SMOOTH"}, "SMOOTH"),
        ({"pin_edges": "SHARP", "pin_slope": "AVERAGE"}, "AVERAGE"),
        ({"pin_edges": "SHARP", "method": "PAPER"}, "AVERAGE"),
    ],
)
def test_what_automatic_stands_for(options: dict[str, str], slope: str) -> None:
    assert FairOptions(**options).slope_at_pinned_edges == slope  # type: ignore[arg-type]


def folded(points: np.ndarray) -> np.ndarray:  # type: ignore[type-arg]
    """A grid folded by a right angle along x = 0."""
    x, y, _ = points.T
    return np.column_stack([np.minimum(x, 0.0), y, -np.maximum(x, 0.0)])


def test_both_sides_of_a_fold_come_back_and_no_fit_looks_across_it() -> None:
    mesh = with_curve(grid(16, 0.55, folded), "creases")
    noisy = mesh.positions.copy()
    patch = make_patch(mesh)
    inside = patch.vertices[patch.free]
    noisy[inside] += 0.03 * np.random.default_rng(2).normal(size=(len(inside), 3))
    solved = solve.solve(replace(mesh, positions=noisy), np.eye(4), FairOptions(pin_edges="SHARP"))
    result = solved.result.vertices[patch.free]
    flat = np.where(grid_points(16)[inside, 0] < 0, np.abs(result[:, 2]), np.abs(result[:, 0]))
    assert solved.result.converged
    assert flat.max() < 1e-9


def test_a_crease_that_runs_out_of_the_selection_does_not_go_with_a_smoothed_outline() -> None:
    mesh = with_curve(grid(16, 0.55, folded), "creases")
    options = FairOptions(pin_edges="SHARP", outline="MENDED")
    with pytest.raises(ValueError, match="Boundary: Smooth would round off the creases"):
        solve.solve(mesh, np.eye(4), options)
    assert solve.solve(replace(mesh, creases=None), np.eye(4), options).result.converged
