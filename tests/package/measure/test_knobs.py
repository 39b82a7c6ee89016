"""Knobs against what a surface must do: by Gauss and Bonnet a round bump of slope θ turns by 2π (1 − cos θ)."""

import numpy as np
import numpy.typing as npt
import pytest

import fairing

Floats = npt.NDArray[np.float64]
RINGS, COLUMNS = 40, 48


def disc() -> npt.NDArray[np.int64]:
    """Triangles between rings of vertices around vertex 0, which is the middle."""
    rings = 1 + np.arange(RINGS * COLUMNS).reshape(RINGS, COLUMNS)
    ahead = np.roll(rings, -1, axis=1)
    middle = np.stack([np.zeros(COLUMNS, dtype=np.int64), rings[0], ahead[0]], axis=1)
    inside, outside, beside, beyond = (part.ravel() for part in (rings[:-1], rings[1:], ahead[:-1], ahead[1:]))
    bands = [np.stack([inside, outside, beyond], axis=1), np.stack([inside, beyond, beside], axis=1)]
    return np.concatenate([middle, *bands])


def tops(points: Floats, before: float = 0.0) -> npt.NDArray[np.int32]:
    """Where the disc swells."""
    return fairing.looks.knobs(points, disc(), before=before)[1]


def turned(radii: Floats, heights: Floats) -> Floats:
    """The disc's vertices on a surface of revolution: a profile of RINGS + 1 points, the first on the axis."""
    around = 2.0 * np.pi * np.arange(COLUMNS) / COLUMNS
    x, y = np.outer(radii[1:], np.cos(around)), np.outer(radii[1:], np.sin(around))
    z = np.repeat(heights[1:], COLUMNS)
    return np.concatenate([[[0.0, 0.0, heights[0]]], np.stack([x.ravel(), y.ravel(), z], axis=1)])


def bump(degrees: float) -> Floats:
    """A bump on a plane that is steepest, by so much, half-way down."""
    radii = np.linspace(0.0, 1.0, RINGS + 1)
    return turned(radii, np.tan(np.radians(degrees)) / np.pi * (1.0 + np.cos(np.pi * radii)))


def test_a_bump_counts_from_a_quarter_of_a_turn_on() -> None:
    limit = np.degrees(np.arccos(1.0 - 0.25))
    assert not len(tops(bump(limit - 3.0)))
    found = tops(bump(limit + 3.0))
    assert 0 in found
    assert np.linalg.norm(bump(limit)[found, :2], axis=1).max() < 0.5  # the ball, not the neck
    assert not len(tops(bump(0.0)))


def test_a_round_end_is_no_knob_and_a_ball_on_a_neck_is_one() -> None:
    angles = np.linspace(0.0, 0.5 * np.pi, RINGS + 1)
    half_ball = turned(np.sin(angles), np.cos(angles))
    assert not len(tops(half_ball))
    half = RINGS // 2
    angles = np.linspace(0.0, 2.5, half + 1)
    radii = np.concatenate([np.sin(angles), np.linspace(np.sin(2.5), 2.0, RINGS - half + 1)[1:]])
    ball = turned(radii, np.concatenate([np.cos(angles), np.full(RINGS - half, np.cos(2.5))]))
    found = tops(ball)
    assert len(found)
    assert ball[found, 2].min() > np.cos(2.5)  # on the ball alone


def test_what_became_calmer_is_none() -> None:
    old = fairing.looks.knobs(bump(75.0), disc())[0]
    assert old == pytest.approx(1.0 - np.cos(np.radians(75.0)), abs=0.02)
    limit = np.degrees(np.arccos(1.0 - 0.8 * old))
    assert not len(tops(bump(limit - 3.0), old))
    assert len(tops(bump(limit + 3.0), old))


@pytest.mark.parametrize(("degrees", "count"), [(37.0, 0), (60.0, 2)])
def test_pieces_count_each_on_its_own(degrees: float, count: int) -> None:
    """Two of .2 turns are none of .4."""
    points = bump(degrees)
    both = np.concatenate([points, points + 3.0])
    _, found = fairing.looks.knobs(both, np.concatenate([disc(), disc() + len(points)]))
    assert np.count_nonzero(np.isin(found, [0, len(points)])) == count
