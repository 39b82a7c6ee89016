"""Whole hands over a short outline: nothing near to where the vertices lie tells where they belong on the dome."""

from __future__ import annotations

import numpy as np
import pytest

import fairing
import measures
import shapes
from limbs import with_limbs
from shapes import Style
from solving import codes


@pytest.mark.parametrize(("size", "count", "rows", "jitter"), [(600, 4, 42, 0.3), (300, 7, 42, 0.0), (80, 7, 38, 0.3)])
def test_a_hand_becomes_a_hemisphere_without_folds(size: int, count: int, rows: int, jitter: float) -> None:
    """2,600 to 3,600 free vertices, most of them in limbs of 42 rows: all three were folded, 48 to 600 times."""
    base = shapes.cap(size, Style(jitter=jitter))
    triangles, number = with_limbs(base, count, rows)
    vertices = np.zeros((number, 3))
    vertices[base.fixed] = base.vertices[base.fixed]
    result = fairing.fair(vertices, triangles, fixed=base.fixed, fixed_normals=base.fixed_normals, otherwise="stop")
    assert result.converged
    assert not codes(result) & {"FLIPPED_TRIANGLES", "SELF_INTERSECTION"}
    assert np.abs(np.linalg.norm(result.vertices, axis=1) - 1.0).max() < 1e-3
    assert measures.euler_number(triangles) == 1
