"""Hard edges that a smoothed outline rounds are distinguished from noise."""

import numpy as np
import numpy.typing as npt
import pytest

import fairing

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

ROWS = 12


def roof(degrees: float) -> tuple[Floats, Ints]:
    """Two slopes that meet in a ridge along x, by so many degrees; vertices row by row along y."""
    half = np.radians(degrees) / 2.0
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(ROWS + 1.0), np.arange(-3.0, 4.0), indexing="ij"))
    points = np.stack([x, y * np.cos(half), -np.abs(y) * np.sin(half)], axis=1)
    here = (np.arange(ROWS)[:, None] * 7 + np.arange(6)).ravel()
    halves = [np.stack([here, here + 7, here + 8], axis=1), np.stack([here, here + 8, here + 1], axis=1)]
    return points, np.concatenate(halves)


def flattened(points: Floats, rows: int, by: float) -> tuple[Floats, Ints]:
    """Lower the ridge's first vertices: those of so many rows."""
    moved = np.arange(rows) * 7 + 3
    after = points.copy()
    after[moved, 2] -= by
    return after, moved


@pytest.mark.parametrize("degrees", [90.0, 60.0, 45.0])
@pytest.mark.parametrize("turned", [False, True])
def test_a_ridge_that_was_lowered_at_its_end_is_found(turned: bool, degrees: float) -> None:
    points, triangles = roof(degrees)
    after, moved = flattened(points, 3, 0.4)
    triangles = triangles[:, ::-1] if turned else triangles  # a valley
    assert fairing.looks.rounded_edges(points, after, triangles, moved).tolist() == moved.tolist()


def test_what_keeps_its_edge_is_none() -> None:
    for degrees, rows, by in ((90.0, 3, 0.01), (30.0, 3, 0.4), (90.0, 1, 0.05)):
        points, triangles = roof(degrees)
        after, moved = flattened(points, rows, by)
        assert not len(fairing.looks.rounded_edges(points, after, triangles, moved)), (degrees, rows, by)


def test_a_whole_ridge_that_moves_is_a_change_of_shape() -> None:
    """A row of noise lies within the band that is smoothed; a hard edge runs on out of it."""
    points, triangles = roof(90.0)
    after, moved = flattened(points, ROWS + 1, 0.4)
    assert not len(fairing.looks.rounded_edges(points, after, triangles, moved))


@pytest.mark.parametrize("seed", range(6))
def test_noise_that_is_smoothed_is_no_hard_edge(seed: int) -> None:
    points, triangles = roof(0.0)
    rough = points + np.random.default_rng(seed).normal(scale=0.3, size=points.shape)
    inner = np.flatnonzero((points[:, 0] < 6.0) & (np.abs(points[:, 1]) < 3.0))
    after = rough.copy()
    after[inner] = points[inner]
    assert not len(fairing.looks.rounded_edges(rough, after, triangles, inner))
