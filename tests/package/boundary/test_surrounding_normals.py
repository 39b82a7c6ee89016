"""`fairing.surrounding_normals`: the tangent planes in which the outside meets a patch."""

import numpy as np
import pytest

import bad_inputs
import fairing
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


@pytest.mark.parametrize("n_free", [30, 60, 200, 2000])
def test_rim_of_a_hemisphere(n_free: int) -> None:
    """Spheres are met exactly on any rim (15 to 104 edges); one-sided averages are 10 to 2 degrees off."""
    vertices, triangles, equator = outside_of_a_hemisphere(n_free)
    found = fairing.surrounding_normals(vertices, triangles, equator)
    assert found.fitted.all()
    assert np.abs(found.normals - vertices[equator]).max() < 1e-9
    averaged = fairing.vertex_normals(vertices, triangles, normals="averaged")[equator]
    assert angles(averaged, vertices[equator]).max() > 1.0


def grid_sphere(segments: int, rings: int, axis: int) -> tuple[FloatArray, IntArray, IntArray]:
    """A sphere of meridians and parallels, the triangles on one side of a plane across an axis, and its rim."""
    vertices, faces = bad_inputs.ball_of_meridians(segments, rings)
    outside = vertices[faces].mean(axis=1)[:, axis] < 0
    return vertices, faces[outside], np.intersect1d(faces[outside], faces[~outside])


@pytest.mark.parametrize("axis", [0, 2])
@pytest.mark.parametrize("segments", [6, 8, 12, 16, 24, 64])
def test_spheres_of_meridians(segments: int, axis: int) -> None:
    """The nearest points of long or wide quads lie on two or three lines and leave cubic terms open.

    Six meridians with 32 parallels and more make a hexagonal cup, whose edges near the poles are hard.
    """
    for rings in (6, 8, 12, 16, 32, 64) if segments > 6 else (6, 8, 12, 16):
        vertices, outside, rim = grid_sphere(segments, rings, axis)
        found = fairing.surrounding_normals(vertices, outside, rim)
        assert found.fitted.all()
        assert np.abs(found.normals - vertices[rim]).max() < 1e-9, rings


@pytest.mark.parametrize(("around", "across", "bound"), [(48, 12, 2.0), (48, 24, 2.0), (96, 24, 0.5), (96, 48, 0.3)])
def test_bands_and_windows_of_a_torus(around: int, across: int, bound: float) -> None:
    """Blender's own torus is the first of these; a cubic of the 22 nearest points is 11 to 55 degrees off."""
    angle = 2 * np.pi * np.arange(around)[:, None] / around
    turn = 2 * np.pi * np.arange(across)[None, :] / across
    outward = np.stack(
        np.broadcast_arrays(np.cos(angle) * np.cos(turn), np.sin(angle) * np.cos(turn), np.sin(turn)), -1
    )
    centres = np.stack(np.broadcast_arrays(np.cos(angle), np.sin(angle), 0 * turn + 0 * angle), -1)
    vertices = (centres + 0.25 * outward).reshape(-1, 3)
    number = np.arange(around * across).reshape(around, across)
    along, beside = np.roll(number, -1, axis=0), np.roll(number, -1, axis=1)
    opposite = np.roll(along, -1, axis=1)
    triangles = np.r_[
        np.stack([number, along, opposite], -1).reshape(-1, 3), np.stack([number, opposite, beside], -1).reshape(-1, 3)
    ]
    middle = vertices[triangles].mean(axis=1)
    for inside in (np.hypot(middle[:, 0], middle[:, 1]) > 1.1, (middle > 0).all(axis=1)):
        rim = np.intersect1d(triangles[inside], triangles[~inside])
        normals = fairing.surrounding_normals(vertices, triangles[~inside], rim).normals
        assert angles(normals, outward.reshape(-1, 3)[rim]).max() < bound


def test_too_few_points_give_the_average() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    triangles = np.array([[0, 1, 2]])
    found = fairing.surrounding_normals(vertices, triangles, np.array([0, 3]))
    assert not found.fitted.any()
    assert np.allclose(found.normals[0], face_normals(vertices, triangles)[0])
    assert np.array_equal(found.normals[1], np.zeros(3))
