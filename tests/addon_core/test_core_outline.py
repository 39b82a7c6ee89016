"""What is odd about an outline, and what the overlay draws."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.outline import (
    face_normals,
    outline_edges,
    outline_notes,
    precision_note,
    turned_over,
    turns,
    two_sided_edges,
)
from addon.arrays.types import Floats
from addon.overlay.data import Surface, make_surface

from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh


def bent_grid(degrees: float) -> Floats:
    """Six by six quads, bent up at the right side of the selected four by four."""
    points = grid_points(6)
    beyond = np.maximum(points[:, 0] - 2.0 / 3.0, 0.0)
    turn = np.radians(degrees)
    return points + beyond[:, None] * np.array([np.cos(turn) - 1.0, 0.0, np.sin(turn)])


@pytest.mark.parametrize("degrees", [10.0, 45.0, 89.0])
def test_turns_are_the_angle_between_two_faces(degrees: float) -> None:
    mesh = grid(6, 0.67, lambda _: bent_grid(degrees))
    sides = two_sided_edges(mesh, outline_edges(mesh))
    assert turns(mesh, sides).max() == pytest.approx(degrees)
    assert np.count_nonzero(turns(mesh, sides) > 1e-5) == 4
    assert not sides.alike.any()


@pytest.mark.parametrize(("degrees", "reported"), [(59.0, False), (61.0, True)])
def test_a_sharp_outline_is_reported(degrees: float, reported: bool) -> None:
    notes = outline_notes(grid(6, 0.67, lambda _: bent_grid(degrees)))
    assert [f"{degrees:.0f}°" in note and "runs along an edge" in note for note in notes] == [True] * reported


def test_faces_without_area_have_no_normal() -> None:
    mesh = grid(2, 2.0, lambda points: points * np.array([1.0, 0.0, 1.0]))
    assert not face_normals(mesh, np.arange(4)).any()
    sides = two_sided_edges(mesh, np.ones(len(mesh.edges), dtype=bool))
    assert not turns(mesh, sides).any()


def test_faces_outside_wound_the_other_way() -> None:
    quads = grid_quads(6)
    selected = grid(6, 0.67).in_patch
    quads = [loop if chosen else loop[::-1] for loop, chosen in zip(quads, selected, strict=True)]
    mesh = polygon_mesh(grid_points(6), quads, selected)
    assert outline_notes(mesh) == (
        "The faces on both sides of 16 boundary edges are wound against each other: recalculate normals",
    )
    rim = np.isclose(np.abs(mesh.positions).max(axis=1), 2.0 / 3.0)
    assert np.array_equal(turned_over(mesh), rim)
    assert turns(mesh, two_sided_edges(mesh, outline_edges(mesh))).max() == pytest.approx(0.0, abs=1e-5)


def test_faces_outside_folded_over() -> None:
    mesh = grid(6, 0.67)
    points = mesh.positions.copy()
    points[points[:, 0] > 0.99, 0] = 0.5  # the last column of faces turned back under the selection
    points[points[:, 0] == 0.5, 2] = -0.01
    notes = outline_notes(replace(mesh, positions=points))
    assert any("runs along an edge" in note for note in notes)
    second = grid(8, 0.45)  # room for a fold between two rings of outside faces
    points = second.positions.copy()
    points[np.isclose(points[:, 0], 0.75), 0] = 0.3
    points[np.isclose(points[:, 0], 0.3), 2] = 0.01
    assert any("folded over" in note for note in outline_notes(replace(second, positions=points)))


def test_an_open_seam() -> None:
    """The left and right halves of a grid, all selected, don't share the vertices between them."""
    points, quads = grid_points(2), grid_quads(2)
    copies = {1: 9, 4: 10, 7: 11}
    right = [[copies.get(v, v) for v in loop] if k % 2 else loop for k, loop in enumerate(quads)]
    mesh = polygon_mesh(np.vstack([points, points[[1, 4, 7]]]), right, [True] * 4)
    assert outline_notes(mesh) == (
        "3 vertices of an open seam lie on others and stay where they are: use Merge by Distance first",
    )


@pytest.mark.parametrize(("far", "reported"), [(0.0, False), (100.0, False), (1e4, True)])
def test_precision_far_from_the_origin(far: float, reported: bool) -> None:
    """float32 steps at 10⁴ are 9.8e-4 apart; the grid's edges 1/3, coarse where that ratio exceeds 1e-3."""
    mesh = grid(6, 0.67, lambda points: points + far)
    assert bool(precision_note(mesh)) == reported


# What the overlay draws: curvature and normals of a sphere, at its borders too.
EYE = np.eye(4)


def drawn(surface: Surface) -> np.ndarray:
    return np.unique(surface.triangles)


def test_curvature_of_a_selection_is_that_of_the_sphere_up_to_its_border() -> None:
    surface = make_surface(grid(24, 0.35, on_sphere), 2.0 * EYE + np.diag([0.0, 0.0, 0.0, -1.0]), whole=False)
    shown = drawn(surface)
    assert len(surface.triangles) == 2 * 8**2
    assert len(shown) == 9**2
    np.testing.assert_allclose(surface.curvature[shown], -0.5, rtol=2e-2)  # convex, radius 2
    np.testing.assert_allclose(surface.normals[shown], surface.positions[shown] / 2.0, atol=1e-2)
    assert surface.usual("CURVATURE") == pytest.approx(0.5, rel=2e-2)
    assert surface.boundary.shape == (4 * 8, 2, 3)
    np.testing.assert_allclose(np.linalg.norm(surface.boundary, axis=2), 2.0, rtol=1e-6)


def test_nothing_selected_draws_nothing() -> None:
    mesh = grid(6, 0.67)
    surface = make_surface(replace(mesh, in_patch=np.zeros(36, dtype=bool)), EYE, whole=False)
    assert len(surface.triangles) == 0
    assert surface.usual("CURVATURE") == 0.0
