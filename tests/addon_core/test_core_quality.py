"""What is counted about triangles: turned over, flat, distorted; and when crossings are looked for."""

from collections.abc import Callable

import numpy as np
import pytest
from addon.arrays.around import numbered, outside_triangles
from addon.arrays.region import Patch, make_patch
from addon.arrays.types import Floats
from addon.fair.engine import Problem
from addon.verdict import quality

from polygon_mesh import grid, grid_points

QUAD = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
TWO = np.array([[0, 1, 2], [0, 2, 3]])


@pytest.mark.parametrize(("stretch", "distortion"), [(1.0, 0.0), (2.0, 1.0), (0.5, 1.0), (1.5, 0.5)])
def test_texture_distortion_of_a_stretched_square(stretch: float, distortion: float) -> None:
    stretched = QUAD * (stretch, 1.0, 1.0)  # singular values 1 and stretch: ratio max/min − 1
    assert quality.texture_distortion(QUAD, stretched, TWO) == pytest.approx(distortion, abs=1e-12)
    turned = 3.0 * QUAD[:, [1, 2, 0]] + 7.0  # a similarity
    assert quality.texture_distortion(QUAD, turned, TWO) == pytest.approx(0.0, abs=1e-12)


def test_what_shrinks_to_nothing_counts_for_nothing() -> None:
    """Two squares: one keeps its shape, the other is stretched threefold and a thousandth as large."""
    squares = np.concatenate([QUAD, QUAD + np.array([5.0, 0.0, 0.0])])
    both = np.concatenate([TWO, TWO + len(QUAD)])
    after = np.concatenate([QUAD, 1e-3 * QUAD * [3.0, 1.0, 1.0]])
    assert quality.texture_distortion(squares, after, both) < 1e-5
    assert quality.texture_distortion(after, squares, both) > 0.1


def square_patch() -> Patch:
    """The grid of 4 × 4 quads, all of it selected."""
    return make_patch(grid(4, 2.0))


def test_folded_faces_are_those_that_a_free_vertex_has_turned() -> None:
    patch = square_patch()
    points = grid_points(4)
    assert len(quality.folded(patch, points)) == 0
    points[12, :2] = (0.9, 0.9)  # the middle, across the corner of the quad above to the right
    found = quality.folded(patch, points)
    assert len(found) > 0
    assert set(found) <= {5, 6, 9, 10}


def bent_problem(degrees: float, shape: Callable[[Floats], Floats] = lambda p: p) -> Problem:
    """A plane of quads whose selected middle is turned down along its outline."""
    mesh = grid(16, 0.3)
    patch = make_patch(mesh)
    points = shape(mesh.positions)
    slope = np.tan(np.radians(degrees))
    inside = np.abs(points[:, :2]).max(axis=1) < 0.3
    points[inside, 2] -= slope * np.minimum(points[inside, 0] + 0.25, 0.125)
    vertices, outside = numbered(patch, outside_triangles(mesh, patch))
    return Problem(patch, points[vertices], np.empty((0, 3)), vertices, outside)


def test_the_join_is_seen_where_the_bend_is() -> None:
    problem = bent_problem(30.0)
    join = quality.join(problem, problem.points)
    assert join.worst == pytest.approx(30.0)
    flat = bent_problem(0.0)
    assert quality.join(flat, flat.points).worst == pytest.approx(0.0, abs=1e-9)
