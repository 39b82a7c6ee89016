"""Bevels and rolled edges that end at a hole run on through it with their width and their profile."""

import numpy as np
import pytest

import creased
import fairing
from creased import Hole

TENTH = 0.1  # of the radius


def off(hole: Hole, radius: float, **options: object) -> float:
    """Largest distance of a new vertex to the exact surface, over the radius of the edge."""
    result = fairing.fill(hole.vertices, hole.triangles, [hole.loop], **options)  # type: ignore[arg-type]
    assert result.converged
    assert len(result.bands) == ("edges" not in options)
    assert len(result.curves) == 0
    points = np.concatenate([hole.vertices, result.vertices])
    for row in (row for band in result.bands for row in band):
        assert np.isin(row[[0, -1]], hole.loop).all()
        assert hole.sides[0](points[row]).max() < TENTH * radius
    assert result.join.max() < 15
    return float(hole.sides[0](result.vertices).max() / radius)


@pytest.mark.parametrize(
    ("n", "options", "bound"),
    [
        (20, {}, 0.05),
        (30, {}, 0.01),
        (24, {"rows": 3}, 0.05),
        (40, {"radius": 0.06}, 0.05),
        (24, {"taper": 0.3}, 0.05),
        (24, {"bend": 1.0}, TENTH),
        (24, {"bend": -0.7}, TENTH),
    ],
    ids=["coarse", "fine", "three rows", "narrow", "tapering", "a lid's rim", "a bore's rim"],
)
def test_a_rolled_edge_runs_on(n: int, options: dict[str, float], bound: float) -> None:
    hole = creased.in_bevel(n, 1, **options)  # type: ignore[arg-type]
    radius = options.get("radius", 0.12)
    assert off(hole, radius) < bound


def test_without_the_rule_it_swells() -> None:
    assert off(creased.in_bevel(20, 1), 0.12, edges="ignored") > 0.4


def test_a_band_that_ends_in_the_hole_is_no_band_through_it() -> None:
    """Its other side is flat: nothing is held inside."""
    hole = creased.in_bevel(20, 1)
    fade = np.clip((hole.vertices[:, 1] + 0.35) / 0.3, 0, 1)[:, None]
    onto = np.column_stack([hole.vertices[:, 0] - hole.vertices[:, 2], hole.vertices[:, 1], np.zeros(len(fade))])
    vertices = (1 - fade) * hole.vertices + fade * onto
    result = fairing.fill(vertices, hole.triangles, [hole.loop])
    assert result.converged
    assert set(result.fixed.tolist()) == set(hole.loop.tolist())
