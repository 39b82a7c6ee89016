"""Selections as people make them: loops that enclose, faces left out, outlines to grow, one side of two."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays, make_patch
from addon.arrays.types import Floats, Mask
from addon.mirror.symmetry import mirror_map, with_image
from addon.selection.selection import enclosed_faces, left_out_faces

from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh, tube

SIZE = 12
FLAT = grid(SIZE, 0.0)
CENTRES = grid_points(SIZE)[np.array(grid_quads(SIZE))].mean(axis=1)


def chosen(mask: Mask, mesh: MeshArrays = FLAT) -> MeshArrays:
    return replace(mesh, in_patch=mask)


def where(test: Callable[[Floats], Mask]) -> Mask:
    return np.array(test(CENTRES.T))


def outline_of(mesh: MeshArrays, faces: Mask) -> Mask:
    """The edges between the faces and the others."""
    uses = np.bincount(mesh.corner_edges[faces[mesh.corner_faces]], minlength=len(mesh.edges))
    rest = np.bincount(mesh.corner_edges[~faces[mesh.corner_faces]], minlength=len(mesh.edges))
    between: Mask = (uses > 0) & (rest > 0)
    return between


def test_a_loop_of_edges_encloses_the_smaller_side() -> None:
    inside = where(lambda c: np.abs(c).max(axis=0) < 0.5)
    assert np.array_equal(enclosed_faces(FLAT, outline_of(FLAT, inside)), inside)


@pytest.mark.parametrize(("low", "high"), [(3, 6), (12, 19), (5, 15), (2, 18)])
def test_two_loops_round_a_limb_enclose_what_is_between(low: int, high: int) -> None:
    points, quads = tube(10, range(21))  # face 10 · row + column
    mesh = polygon_mesh(points, quads, [False] * len(quads))
    row = np.arange(len(mesh.in_patch)) // 10
    between = (row >= low) & (row < high)
    assert np.array_equal(enclosed_faces(mesh, outline_of(mesh, between)), between)


def test_a_loop_that_does_not_close_encloses_nothing() -> None:
    walls = outline_of(FLAT, where(lambda c: np.abs(c).max(axis=0) < 0.5))
    walls[np.flatnonzero(walls)[0]] = False
    assert not enclosed_faces(FLAT, walls).any()
    assert not enclosed_faces(FLAT, np.zeros_like(walls)).any()


def test_a_lasso_that_left_faces_out() -> None:
    inside = where(lambda c: np.abs(c).max(axis=0) < 0.7)
    hole = np.zeros_like(inside)
    hole[[SIZE * 5 + 5, SIZE * 5 + 6, SIZE * 7 + 7]] = True
    assert np.array_equal(left_out_faces(chosen(inside & ~hole)), hole)
    cross = np.zeros_like(inside)
    cross[[SIZE * 5 + 5, SIZE * 4 + 5, SIZE * 6 + 5, SIZE * 5 + 4, SIZE * 5 + 6]] = True
    assert not left_out_faces(chosen(inside & ~cross)).any()  # one more than an oversight has
    long = np.zeros_like(inside)
    long[SIZE * 5 + 4 : SIZE * 5 + 8] = True
    assert np.array_equal(left_out_faces(chosen(inside & ~long)), long)
    large = where(lambda c: np.abs(c).max(axis=0) < 0.3)  # a hole on purpose
    assert not left_out_faces(chosen(inside & ~large)).any()
    corner = np.ones_like(inside)
    corner[0] = False  # at the mesh's own border
    assert not left_out_faces(chosen(corner)).any()
    assert not left_out_faces(replace(chosen(inside), hidden=hole)).any()


def test_a_selection_on_one_side_gets_its_image() -> None:
    one = where(lambda c: (np.abs(c[0] - 0.5) < 0.3) & (np.abs(c[1]) < 0.5))
    mesh = replace(chosen(one, grid(SIZE, 0.0, on_sphere)), mirror_x=True)
    points = mesh.positions.copy()
    patch = make_patch(mesh)
    points[patch.vertices[patch.free]] *= 1.3  # inside anything may be
    both = with_image(replace(mesh, positions=points))
    assert np.array_equal(both.in_patch, one | where(lambda c: (np.abs(c[0] + 0.5) < 0.3) & (np.abs(c[1]) < 0.5)))
    assert mirror_map(both, make_patch(both)) is not None
    assert np.array_equal(with_image(replace(mesh, mirror_x=False)).in_patch, one)


def test_no_image_where_there_is_none() -> None:
    one = where(lambda c: (np.abs(c[0] - 0.5) < 0.3) & (np.abs(c[1]) < 0.5))
    bent = FLAT.positions.copy()
    bent[bent[:, 0] < 0.0, 2] = 0.1
    mesh = replace(chosen(one), mirror_x=True)
    assert np.array_equal(with_image(replace(mesh, positions=bent)).in_patch, one)
    across = where(lambda c: (np.abs(c[0] - 0.1) < 0.3) & (np.abs(c[1]) < 0.5))  # meets its own image
    assert np.array_equal(with_image(replace(mesh, in_patch=across)).in_patch, across)
