"""What is counted about triangles: turned over, flat, distorted; and when crossings are looked for."""

from collections.abc import Callable

import numpy as np
import pytest
from addon.arrays.around import numbered, outside_triangles
from addon.arrays.region import Patch, make_patch
from addon.arrays.types import Floats, Ints
from addon.fair.engine import Problem
from addon.verdict import quality

import fairing
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


LIFTED = grid_points(4) + np.array([0.0, 0.0, 1.0])


class Counter:
    """Names some triangles for each height of the first vertex, and remembers what it was asked."""

    def __init__(self, before: int, after: int) -> None:
        self.asked: list[str] = []
        self._answers = {"before": before, "after": after}

    def __call__(self, positions: Floats, _triangles: Ints) -> Ints:
        name = "after" if positions[0, 2] else "before"
        self.asked.append(name)
        return np.arange(self._answers[name])


def faces(found: Ints | None) -> int | None:
    return None if found is None else len(found)


def test_crossings_are_looked_for_on_both_sides(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(fairing, "self_intersections", Counter(5, 9))  # triangles: two of a face
    before, after = quality.compare(square_patch(), (grid_points(4), LIFTED), False)
    assert (faces(before.crossing), faces(after.crossing)) == (3, 5)


def test_a_result_that_is_known_to_be_clear_is_not_looked_at(monkeypatch: pytest.MonkeyPatch) -> None:
    counter = Counter(6, 10)
    monkeypatch.setattr(fairing, "self_intersections", counter)
    before, after = quality.compare(square_patch(), (grid_points(4), LIFTED), True)
    assert (faces(before.crossing), faces(after.crossing)) == (3, 0)
    assert counter.asked == ["before"]


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
