"""What the overlay draws: curvature and normals of a sphere, at its borders too."""

from dataclasses import replace

import numpy as np
import pytest
from addon.overlay.data import Surface, make_surface

from polygon_mesh import grid, on_sphere

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
