"""Outline vertices that nearly coincide, as voxel remeshing and booleans leave them: their edges tell nothing."""

import numpy as np
import pytest
from numpy.typing import NDArray

import fairing
import shapes
from tubes import Tube as Region

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


def with_twins(vertices: FloatArray, triangles: IntArray, ends: IntArray, share: float, degrees: float) -> Region:
    """A part of the unit ball: its outline's edges from ends[:, 0] to ends[:, 1] are split at `share` of their length,
    and the new vertices' normals turned at random."""
    rng = np.random.default_rng(0)
    points, corners = list(vertices), triangles.tolist()
    normals = {int(v): vertices[v] for loop in fairing.boundary_loops(triangles) for v in loop}
    for a, b in ends.tolist():
        k = next(k for k, triple in enumerate(corners) if a in triple and b in triple)
        twin = len(points)
        points.append(vertices[a] + share * (vertices[b] - vertices[a]))
        turned = vertices[a] + np.radians(degrees) * rng.normal(size=3)
        normals[twin] = turned / np.linalg.norm(turned)
        triple = corners[k]
        corners[k] = [twin if v == b else v for v in triple]
        corners.append([twin if v == a else v for v in triple])
    fixed = np.array(sorted(normals))
    return Region(np.array(points), np.array(corners), fixed, np.array([normals[v] for v in fixed]))


def half_ball(share: float, degrees: float) -> Region:
    """Every sixth edge of its outline is split."""
    cap = shapes.cap(700)
    loop = fairing.boundary_loops(cap.triangles)[0]
    return with_twins(cap.vertices, cap.triangles, np.column_stack([loop, np.roll(loop, -1)])[::6], share, degrees)


def square(share: float, degrees: float) -> Region:
    """A square part with a twin beside each corner, 12 × 12."""
    n = 12
    x, y = (axis.ravel() for axis in np.meshgrid(*[np.linspace(-0.4, 0.4, n + 1)] * 2))
    column, row = (axis.ravel() for axis in np.meshgrid(np.arange(n), np.arange(n)))
    a = row * (n + 1) + column
    triangles = np.concatenate([np.column_stack([a, a + 1, a + n + 2]), np.column_stack([a, a + n + 2, a + n + 1])])
    last = n * (n + 1)
    ends = np.array([[0, 1], [n, 2 * n + 1], [last + n, last + n - 1], [last, last - n - 1]])
    return with_twins(np.column_stack([x, y, np.sqrt(1 - x * x - y * y)]), triangles, ends, share, degrees)


def faired(region: Region) -> fairing.FairResult:
    return fairing.fair(region.vertices, region.triangles, fixed=region.fixed, fixed_normals=region.normals, threads=1)


def off_ball(region: Region, result: fairing.FairResult) -> float:
    free = np.setdiff1d(np.arange(len(region.vertices)), region.fixed)
    return float(np.abs(np.linalg.norm(result.vertices[free], axis=1) - 1).max())


@pytest.mark.parametrize(
    ("region", "limit", "curvature"),
    [
        *((half_ball(share, 0.0), 1e-4, 0.05) for share in (1e-2, 1e-3, 1e-5, 1e-9)),
        (half_ball(1e-5, 3.0), 5e-3, 4.0),  # nor do their normals
        (square(1e-5, 1.0), 2e-3, np.inf),  # at corners normals turn along the outline, and nothing tells H there
    ],
)
def test_twins_on_the_outline_do_not_matter(region: Region, limit: float, curvature: float) -> None:
    """The ball comes back, with its H of −1."""
    result = faired(region)
    assert result.converged
    assert result.polished
    assert off_ball(region, result) < limit
    assert np.abs(result.mean_curvature + 1).max() < curvature
