"""Outlines on the slope of a bump: on a plane, a ball and a pipe, whose own surfaces bend on as they should."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.arrays.types import Floats
from addon.fair.solve import pose, solve
from addon.options.options import FairOptions
from addon.verdict.evidence import Flank
from addon.verdict.outcome import flank_of

from polygon_mesh import grid, on_sphere

SIZE = 60  # quads from side to side, on 2 units
SIGMA = 0.15

Ground = Callable[[Floats], Floats]


def plane(points: Floats) -> Floats:
    return points


def pipe(points: Floats) -> Floats:
    """The plane bent around an axis along y, with radius 1."""
    return np.column_stack([np.sin(points[:, 0]), points[:, 1], np.cos(points[:, 0])])


def bumped(height: float, ground: Ground) -> Ground:
    """A bump of a Gauss curve in the middle, SIGMA wide, seen from above."""

    def shape(points: Floats) -> Floats:
        lift = height * np.exp(-(points**2).sum(axis=1) / (2.0 * SIGMA**2))
        return ground(points) + np.outer(lift, [0.0, 0.0, 1.0])

    return shape


def scene(half: float, shape: Ground, middle: Floats | float = 0.0) -> MeshArrays:
    """A grid of which a disc of radius `half` is selected."""
    mesh = grid(SIZE, 1.0)
    flat = mesh.positions
    centres = np.stack([flat[mesh.corner_vertices[mesh.corner_faces == face]].mean(axis=0) for face in range(SIZE**2)])
    return replace(mesh, positions=shape(flat), in_patch=np.linalg.norm(centres - middle, axis=1) < half)


def found(mesh: MeshArrays) -> Flank | None:
    problem, _ = pose(mesh, np.eye(4), FairOptions())
    after = problem.points.copy()
    solved = solve(mesh, np.eye(4), FairOptions())
    after[solved.problem.patch.free] = solved.result.vertices[solved.problem.patch.free]
    return flank_of(mesh, np.eye(4), problem, after)


@pytest.mark.parametrize("ground", [plane, on_sphere, pipe])
@pytest.mark.parametrize("height", [0.2, -0.2])
def test_a_tight_selection_is_reported_with_the_way_over_it(ground: Ground, height: float) -> None:
    for half in (1.2 * SIGMA, 1.5 * SIGMA):
        reported = found(scene(half, bumped(height, ground)))
        assert reported is not None, half
        assert reported.is_bump == (height > 0.0)
        end = half + reported.rings * 2.0 / SIZE
        assert 2.2 * SIGMA < end < 4.5 * SIGMA


@pytest.mark.parametrize("ground", [plane, on_sphere, pipe])
@pytest.mark.parametrize("height", [0.2, -0.2])
def test_a_selection_around_all_of_it_is_not(ground: Ground, height: float) -> None:
    assert found(scene(3.2 * SIGMA, bumped(height, ground))) is None


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_the_floor_of_a_bowl_is_no_flank(sign: float) -> None:
    def bowl(points: Floats) -> Floats:
        radii = np.linalg.norm(points, axis=1)
        return points + np.outer(sign * (2.0 * np.maximum(radii - 0.3, 0.0) ** 2 - 0.04 * radii**2), [0.0, 0.0, 1.0])

    assert found(scene(0.25, bowl)) is None


def test_an_open_border_has_nothing_outside_to_tell_by() -> None:
    at_the_border = np.array([1.0, 0.0, 0.0])
    shape = bumped(0.2, plane)

    def aside(points: Floats) -> Floats:
        return shape(points - at_the_border) + at_the_border

    assert found(scene(1.5 * SIGMA, aside, at_the_border)) is None
