"""Means of turns, which keep their lengths, and how many vertex groups a new vertex is in."""

import numpy as np
from addon.arrays.harmonic import blended, columns, limited_like

HALF = np.array([[0.5, 0.5]])


def matrix(angle: float, scale: float, place: float) -> np.ndarray:  # type: ignore[type-arg]
    """Return a turn about z as Blender keeps it, column after column."""
    c, s = np.cos(angle), np.sin(angle)
    axes = scale * np.array([[c, s, 0.0], [-s, c, 0.0], [0.0, 0.0, 1.0]])
    return np.vstack([np.hstack([axes, np.zeros((3, 1))]), [[place, 0.0, 0.0, 1.0]]]).ravel()


def test_a_mean_of_turns_is_a_turn_whichever_sign_they_have() -> None:
    quarter = np.array([np.cos(np.pi / 4), 0.0, 0.0, np.sin(np.pi / 4)])
    turns = np.stack([np.array([1.0, 0.0, 0.0, 0.0]), -quarter])
    mean = blended("QUATERNION", HALF @ columns("QUATERNION", turns))
    np.testing.assert_allclose(mean[0], [np.cos(np.pi / 8), 0.0, 0.0, np.sin(np.pi / 8)], atol=1e-12)


def test_a_mean_of_matrices_does_not_shrink() -> None:
    both = np.stack([matrix(0.0, 2.0, 0.0), matrix(1.0, 4.0, 6.0)])
    mean = blended("FLOAT4X4", HALF @ columns("FLOAT4X4", both))[0].reshape(4, 4)
    np.testing.assert_allclose(np.linalg.norm(mean[:3, :3], axis=1), 3.0, rtol=1e-12)
    np.testing.assert_allclose(mean[3], [3.0, 0.0, 0.0, 1.0], atol=1e-12)


def test_plain_numbers_have_a_plain_mean_and_no_length_is_no_division() -> None:
    values = np.array([[1.0, 2.0], [3.0, 6.0]])
    np.testing.assert_allclose(blended("FLOAT2", HALF @ columns("FLOAT2", values)), [[2.0, 4.0]])
    nothing = columns("QUATERNION", np.zeros((2, 4)))
    assert np.array_equal(blended("QUATERNION", HALF @ nothing), np.zeros((1, 4)))


def test_no_vertex_is_in_more_groups_than_one_around_and_the_sum_stays() -> None:
    sources = np.array([[0.5, 0.5, 0.0, 0.0], [0.0, 0.0, 0.75, 0.25]])
    mean = HALF @ sources
    every = np.ones(4, dtype=bool)
    found = limited_like(mean, sources, every)
    np.testing.assert_allclose(found, [[0.4, 0.0, 0.6, 0.0]])  # .25 and .375 of 1, the first of two equal ones
    np.testing.assert_allclose(limited_like(mean, np.eye(4), every), [[0.0, 0.0, 1.0, 0.0]])
    assert np.array_equal(limited_like(mean, mean, every), mean)


def test_groups_that_are_of_no_bone_are_not_counted() -> None:
    sources = np.array([[1.0, 0.0, 0.9], [0.0, 1.0, 0.0]])
    bones = np.array([True, True, False])
    found = limited_like(HALF @ sources, sources, bones)
    np.testing.assert_allclose(found, [[1.0, 0.0, 0.45]])
