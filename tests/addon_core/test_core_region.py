"""From faces and a selection to the patch: counted by hand on small meshes."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import fins, free_vertices, make_patch

import fairing
from polygon_mesh import grid, grid_points, grid_quads, polygon_mesh


def test_free_are_the_vertices_whose_faces_are_all_selected() -> None:
    mesh = grid(6, 0.67)  # 4 × 4 of 6 × 6 quads
    free = np.flatnonzero(free_vertices(mesh))
    assert free.tolist() == [7 * row + column for row in (2, 3, 4) for column in (2, 3, 4)]


def test_an_open_border_and_a_pin_hold_vertices() -> None:
    everything = grid(4, 2.0)
    assert np.flatnonzero(free_vertices(everything)).tolist() == [6, 7, 8, 11, 12, 13, 16, 17, 18]
    pinned = everything.pinned.copy()
    pinned[12] = True
    assert np.flatnonzero(free_vertices(replace(everything, pinned=pinned))).tolist() == [6, 7, 8, 11, 13, 16, 17, 18]


def test_patch_of_a_grid() -> None:
    mesh = grid(6, 0.67)
    patch = make_patch(mesh)
    assert (len(patch.vertices), len(patch.triangles), len(patch.free), len(patch.fixed)) == (25, 32, 9, 16)
    assert np.array_equal(patch.outline, patch.fixed)  # all that is fixed lies on the outline
    assert patch.neighbours is not None
    assert len(patch.neighbours) == 40  # edges of the 4 × 4 quads, none of the diagonals
    assert np.array_equal(np.sort(np.concatenate([patch.free, patch.fixed])), np.arange(25))
    corners = np.sort(mesh.corner_vertices[mesh.in_patch[mesh.corner_faces]])
    assert np.array_equal(np.unique(corners), patch.vertices)


@pytest.mark.parametrize(
    ("size", "share", "map_scale", "area"),
    [(8, 0.8, 1.0, 1.5**2), (6, 0.67, -2.0, 2.0 * (4.0 / 3.0) ** 2)],  # 6 × 6 quads of a quarter; 4 × 4 of a third
)
def test_triangles_of_the_patch_cover_it_once_and_face_up(
    size: int, share: float, map_scale: float, area: float
) -> None:
    """Up was outside, and a map that mirrors leaves it there."""
    world = grid(size, share).transformed(np.diag([map_scale, 1.0, 1.0, 1.0]))
    patch = make_patch(world)
    a, b, c = (world.positions[patch.vertices[column]] for column in patch.triangles.T)
    areas = 0.5 * np.cross(b - a, c - a)[:, 2]
    assert areas.min() > 0.0
    assert areas.sum() == pytest.approx(area)


@pytest.mark.parametrize("scale", [0.0, np.inf, np.nan, 1e-9])
def test_a_flattening_map_is_refused(scale: float) -> None:
    with pytest.raises(ValueError, match="scale is zero or not finite"):
        grid(4, 0.6).transformed(np.diag([1.0, 1.0, scale, 1.0]))


def with_a_fin() -> list[list[int]]:
    """Two by two quads, and a triangle upright on the edge between the vertices 4 and 5."""
    return [*grid_quads(2), [4, 5, 9]]


def test_a_fin_is_left_out() -> None:
    """An upright triangle, selected too, on an edge of the outline of the middle 4 × 4 of 6 × 6 quads."""
    plain = grid(6, 0.67)
    points = np.vstack([plain.positions, [[-0.2, -0.7, 1.0]]])
    mesh = polygon_mesh(points, [*grid_quads(6), [9, 10, 49]], [*plain.in_patch, True])
    assert np.flatnonzero(fins(mesh)).tolist() == [36]
    assert np.array_equal(make_patch(mesh).triangles, make_patch(plain).triangles)


def test_three_selected_faces_at_an_edge_are_refused_by_name() -> None:
    points = np.vstack([grid_points(2), [[0.5, 0.0, 1.0]]])
    mesh = polygon_mesh(points, with_a_fin(), [True] * 5)
    with pytest.raises(fairing.MeshError, match="edge 4–5") as refusal:
        make_patch(mesh)
    assert refusal.value.diagnostic.elements.tolist() == [4, 5]
    pinned = mesh.pinned.copy()
    pinned[[4, 5]] = True
    make_patch(replace(mesh, pinned=pinned))  # does not raise
