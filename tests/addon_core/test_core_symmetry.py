"""X mirror: the outline by position, the inside by connectivity."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import make_patch
from addon.mirror.symmetry import FLIP, NEAR, mirror_map, symmetrised

from polygon_mesh import grid, grid_points, grid_quads, polygon_mesh


def expected_images(size: int, vertices: np.ndarray) -> np.ndarray:
    row, column = np.divmod(vertices, size + 1)
    return np.searchsorted(vertices, row * (size + 1) + size - column)


def test_images_in_a_grid_whatever_lies_inside() -> None:
    mesh = grid(8, 0.8)
    patch = make_patch(mesh)
    crumpled = mesh.positions.copy()
    crumpled[patch.vertices[patch.free]] += np.random.default_rng(1).normal(size=(len(patch.free), 3))
    image = mirror_map(replace(mesh, positions=crumpled), patch)
    assert image is not None
    np.testing.assert_array_equal(image, expected_images(8, patch.vertices))


@pytest.mark.parametrize(("shift", "found"), [(0.9 * NEAR, True), (1.1 * NEAR, False), (-1.1 * NEAR, False)])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_the_outline_is_compared_as_far_as_blender_looks(shift: float, axis: int, found: bool) -> None:
    mesh = grid(8, 0.8)
    patch = make_patch(mesh)
    points = mesh.positions.copy()
    points[patch.vertices[patch.outline[1]], axis] += shift
    assert (mirror_map(replace(mesh, positions=points), patch) is not None) == found


def test_of_two_near_images_the_nearest_is_taken() -> None:
    """Two vertices of the boundary 0.5 NEAR apart: both lie near each other's mirror images."""
    points = grid_points(4)
    points[[10, 14], 1] = 0.5 * NEAR  # left and right ends of the middle row …
    points[[5, 9], 1] = 0.0  # … and of the row below it
    mesh = polygon_mesh(points, grid_quads(4), [True] * 16)
    image = mirror_map(mesh, make_patch(mesh))
    assert image is not None
    assert image[[10, 14, 5, 9]].tolist() == [14, 10, 9, 5]


@pytest.mark.parametrize("where", [0.5, 0.25])
def test_pins_must_be_symmetric_too(where: float) -> None:
    mesh = grid(8, 0.8)
    pinned = np.isclose(mesh.positions[:, 0], where) & np.isclose(mesh.positions[:, 1], 0.0)
    assert mirror_map(mesh, make_patch(replace(mesh, pinned=pinned))) is None
    both = pinned | (np.isclose(mesh.positions[:, 0], -where) & np.isclose(mesh.positions[:, 1], 0.0))
    assert mirror_map(mesh, make_patch(replace(mesh, pinned=both))) is not None


def test_connectivity_must_be_symmetric() -> None:
    quads = grid_quads(4)
    split = quads[5]  # inside, left of the middle: as two triangles
    mesh = polygon_mesh(grid_points(4), [*quads[:5], split[:3], [split[0], *split[2:]], *quads[6:]], [True] * 17)
    assert mirror_map(mesh, make_patch(mesh)) is None


def test_symmetrised_is_symmetric_to_the_last_bit() -> None:
    points = np.random.default_rng(2).normal(size=(25, 3))
    image = expected_images(4, np.arange(25))
    mean = symmetrised(points, image)
    np.testing.assert_array_equal(mean, FLIP * mean[image])
    assert np.array_equal(mean[2], [0.0, *points[2, 1:]])  # on the plane only x changes
    np.testing.assert_allclose(mean[0] - points[0], FLIP * points[4] - mean[0], atol=1e-15)
