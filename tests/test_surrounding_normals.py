"""`fairing.surrounding_normals`: the tangent planes in which the outside meets a patch."""

from __future__ import annotations

import numpy as np
import pytest

import bad_inputs
import fairing
import shapes
from curves import FloatArray
from meshing import IntArray, face_normals


def outside_of_a_hemisphere(n_free: int) -> tuple[FloatArray, IntArray, IntArray]:
    """The sphere's vertices, the triangles below the equator, and the equator."""
    vertices, triangles, equator = bad_inputs.closed_ball(n_free)
    below = vertices[triangles].mean(axis=1)[:, 2] < 0
    return vertices, triangles[below], equator


def angles(one: FloatArray, other: FloatArray) -> FloatArray:
    """Degrees between unit vectors (k, 3)."""
    return np.asarray(np.degrees(np.arccos(np.clip((one * other).sum(axis=1), -1, 1))))


@pytest.mark.parametrize("n_free", [60, 200, 2000])
def test_rim_of_a_hemisphere(n_free: int) -> None:
    """Spheres are met exactly on any rim (20 to 104 edges); one-sided averages are 10 to 2 degrees off."""
    vertices, triangles, equator = outside_of_a_hemisphere(n_free)
    normals, fitted = fairing.surrounding_normals(vertices, triangles, equator)
    assert fitted.all()
    assert np.abs(normals - vertices[equator]).max() < 1e-9
    averaged = fairing.vertex_normals(vertices, triangles, normals="averaged")[equator]
    assert angles(averaged, vertices[equator]).max() > 1.0


def test_a_hemisphere_comes_back_from_its_surroundings() -> None:
    """The product's promise in one line: cut it out, fill it in, and the sphere is there again."""
    vertices, triangles, equator = bad_inputs.closed_ball(300)
    above = vertices[triangles].mean(axis=1)[:, 2] > 0
    normals, _ = fairing.surrounding_normals(vertices, triangles[~above], equator)
    flattened = vertices * [1.0, 1.0, 0.0]
    result = fairing.fair(flattened, triangles[above], fixed=equator, fixed_normals=normals, tolerance=1e-10)
    used = np.unique(triangles[above])
    assert np.abs(np.linalg.norm(result.vertices[used], axis=1) - 1.0).max() < 1e-8


def test_other_families() -> None:
    """Rims of smooth patches, seen from the patch: at 2000 vertices 0.05° were measured."""
    for name in ("cylinder", "catenoid", "linear_flux", "clothoid"):
        patch = getattr(shapes, name)(2000)
        normals, _ = fairing.surrounding_normals(patch.vertices, patch.triangles, patch.fixed)
        assert angles(normals, patch.fixed_normals).max() < 0.1


def test_follows_the_winding() -> None:
    vertices, triangles, equator = outside_of_a_hemisphere(200)
    normals, _ = fairing.surrounding_normals(vertices, triangles, equator)
    turned, _ = fairing.surrounding_normals(vertices, triangles[:, ::-1], equator)
    assert np.abs(normals + turned).max() < 1e-9


@pytest.mark.parametrize("size", [1e-300, 1e-160, 3e-162, 1e160, 1e300])
def test_size_does_not_matter(size: float) -> None:
    """Products of such edges are denormal, zero or infinite: found by the fuzzer."""
    vertices, triangles, equator = outside_of_a_hemisphere(60)
    normals, fitted = fairing.surrounding_normals(size * vertices, triangles, equator)
    assert fitted.all()
    assert np.abs(normals - vertices[equator]).max() < 1e-9


def test_a_sliver_has_a_unit_normal() -> None:
    """Its area is denormal beside the largest coordinate: found by the fuzzer."""
    vertices = np.array([[0, 0, 0], [1e-160, 0, 0], [0, 1e-162, 0], [1, 1, 1], [1, 2, 1], [2, 1, 1]])
    normals, _ = fairing.surrounding_normals(vertices, np.array([[0, 1, 2], [3, 5, 4]]), np.arange(6))
    assert np.abs(np.linalg.norm(normals, axis=1) - 1).max() < 1e-12


def test_too_few_points_give_the_average() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    triangles = np.array([[0, 1, 2]])
    normals, fitted = fairing.surrounding_normals(vertices, triangles, np.array([0, 3]))
    assert not fitted.any()
    assert np.allclose(normals[0], face_normals(vertices, triangles)[0])
    assert np.array_equal(normals[1], np.zeros(3))


def test_a_vertex_may_be_named_twice() -> None:
    """As a pinch is by boundary_loops; its own second copy must not count as a neighbour."""
    vertices, triangles, equator = outside_of_a_hemisphere(200)
    normals, fitted = fairing.surrounding_normals(vertices, triangles, np.concatenate([equator, equator[::-1]]))
    once, _ = fairing.surrounding_normals(vertices, triangles, equator)
    assert fitted.all()
    assert np.abs(normals[: len(equator)] - once).max() < 1e-9
    assert np.array_equal(normals[len(equator) :], normals[: len(equator)][::-1])
    assert not normals.flags.writeable
