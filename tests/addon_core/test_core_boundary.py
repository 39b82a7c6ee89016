"""What is odd about a boundary, and what the overlay draws."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.boundary import (
    boundary_notes,
    face_normals,
    precision_note,
    turned_over,
)
from addon.overlay.data import Surface, make_surface

from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh


def test_faces_without_area_have_no_normal() -> None:
    mesh = grid(2, 2.0, lambda points: points * np.array([1.0, 0.0, 1.0]))
    assert not face_normals(mesh, np.arange(4)).any()


def test_faces_outside_wound_the_other_way() -> None:
    quads = grid_quads(6)
    selected = grid(6, 0.67).in_patch
    quads = [loop if chosen else loop[::-1] for loop, chosen in zip(quads, selected, strict=True)]
    mesh = polygon_mesh(grid_points(6), quads, selected)
    assert boundary_notes(mesh) == ("The faces beside 16 boundary edges point opposite ways: recalculate normals",)
    rim = np.isclose(np.abs(mesh.positions).max(axis=1), 2.0 / 3.0)
    assert np.array_equal(turned_over(mesh), rim)


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


def test_nothing_selected_draws_nothing() -> None:
    mesh = grid(6, 0.67)
    surface = make_surface(replace(mesh, in_patch=np.zeros(36, dtype=bool)), EYE, whole=False)
    assert len(surface.triangles) == 0
    assert surface.usual("CURVATURE") == 0.0
