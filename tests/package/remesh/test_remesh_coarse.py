"""New meshes for patches of few large faces, none of whose vertices is free."""

from typing import Any

import numpy as np
import pytest

import fairing
import holes
from holes import FloatArray

SQUARE = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])
HEXAGON = np.array([[np.cos(t), np.sin(t), 0.0] for t in np.pi / 3 * np.arange(6)])


@pytest.mark.parametrize(
    ("points", "triangles"),
    [
        (SQUARE[:3], [[0, 1, 2]]),
        (SQUARE, [[0, 1, 2], [0, 2, 3]]),
        (HEXAGON, [[0, 1, 2], [0, 2, 4], [2, 3, 4], [4, 5, 0]]),
        (HEXAGON, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]),
    ],
)
@pytest.mark.parametrize("spacing", [0.0, 0.1])
def test_a_patch_without_free_vertices_gets_some(points: FloatArray, triangles: Any, spacing: float) -> None:
    """A plane stays a plane; the boundary's edges stay; places on the old triangles are where the vertices are."""
    up = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    fixed = np.arange(len(points))
    before = points.copy()
    result = fairing.remesh(points, triangles, fixed=fixed, fixed_normals=up, spacing=spacing)
    np.testing.assert_array_equal(points, before)
    assert result.converged
    assert len(result.vertices) > (0 if spacing == 0.0 else 10)
    assert abs(result.vertices[:, 2]).max() < 1e-9
    both = np.concatenate([points, result.vertices])
    corners = both[result.triangles]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2]
    old = points[np.array(triangles)]
    whole = np.cross(old[:, 1] - old[:, 0], old[:, 2] - old[:, 0])[:, 2].sum()
    assert (areas > 0.0).all()
    assert areas.sum() == pytest.approx(whole)
    outline = {tuple(sorted(pair)) for pair in zip(fixed.tolist(), np.roll(fixed, -1).tolist(), strict=True)}
    assert outline <= set(map(tuple, holes.edges_of(result.triangles).tolist()))
    rows, weights = result.origin
    assert set(rows.tolist()) <= set(range(len(triangles)))
    np.testing.assert_allclose(weights.sum(axis=1), 1.0)
    there = (old[rows] * weights[:, :, None]).sum(axis=1)
    assert np.linalg.norm(there - result.vertices, axis=1).max() < 0.5  # fair on the way from there


def test_a_kept_edge_inside_stays_one() -> None:
    up = np.tile([0.0, 0.0, 1.0], (4, 1))
    given = {"fixed": np.arange(4), "fixed_normals": up, "spacing": 0.4}
    result = fairing.remesh(SQUARE, [[0, 1, 2], [0, 2, 3]], kept=[[0, 2]], **given)
    assert (0, 2) in set(map(tuple, holes.edges_of(result.triangles).tolist()))
    without = fairing.remesh(SQUARE, [[0, 1, 2], [0, 2, 3]], **given)
    assert (0, 2) not in set(map(tuple, holes.edges_of(without.triangles).tolist()))
