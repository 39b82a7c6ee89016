"""Whole hands over a short outline: nothing near to where the vertices lie tells where they belong on the dome."""

import numpy as np
import pytest

import fairing
import measures
import shapes
from limbs import with_limbs
from shapes import Style
from solving import codes

FOLDED = {"FLIPPED_TRIANGLES", "SELF_INTERSECTION"}


def _faired(size: int, count: int, rows: int, style: Style) -> fairing.FairResult:
    base = shapes.cap(size, style)
    triangles, number = with_limbs(base, count, rows)
    assert measures.euler_number(triangles) == 1
    vertices = np.zeros((number, 3))
    vertices[base.fixed] = base.vertices[base.fixed]
    return fairing.fair(vertices, triangles, fixed=base.fixed, fixed_normals=base.fixed_normals, otherwise="stop")


def _off_the_sphere(result: fairing.FairResult) -> float:
    return float(np.abs(np.linalg.norm(result.vertices, axis=1) - 1.0).max())


@pytest.mark.parametrize(("size", "count", "rows", "jitter"), [(600, 4, 42, 0.3), (300, 7, 42, 0.0)])
def test_a_hand_becomes_a_hemisphere_without_folds(size: int, count: int, rows: int, jitter: float) -> None:
    """3,600 free vertices at most, most of them in limbs of 42 rows, are placed without a fold."""
    result = _faired(size, count, rows, Style(jitter=jitter))
    assert result.converged
    assert not codes(result) & FOLDED
    assert _off_the_sphere(result) < 1e-3


def test_no_hand_over_a_short_outline_says_that_it_converged_where_it_is_folded() -> None:
    """2,600 free vertices, of which a dome of 80 has room for few. Of six the last digits decide on a half."""
    spheres = 0
    for seed in range(6):
        result = _faired(80, 7, 38, Style(seed=seed))
        if not result.converged:
            continue
        assert not codes(result) & FOLDED
        assert _off_the_sphere(result) < 1e-3
        spheres += 1
    assert spheres >= 1
