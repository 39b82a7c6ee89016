"""What a result says, and that it says it honestly."""

import dataclasses

import numpy as np
import pytest

import fairing
import shapes
from solving import fair_patch, solved


def test_fixed_vertices_keep_their_bits_and_given_order() -> None:
    patch = shapes.catenoid(300)
    order = np.random.default_rng(0).permutation(patch.fixed)
    result = fairing.fair(patch.vertices, patch.triangles, fixed=order, fixed_normals=patch.normals[order])
    assert np.array_equal(result.fixed, order)
    assert np.array_equal(result.vertices[order], patch.vertices[order])


def test_results_are_immutable() -> None:
    _, result = solved("catenoid", 300)
    with pytest.raises((AttributeError, dataclasses.FrozenInstanceError)):
        result.converged = False  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        result.vertices[0, 0] = 1.0


def test_mean_curvature_is_that_of_the_public_function() -> None:
    patch, result = solved("catenoid", 300)
    again = fairing.mean_curvature(
        result.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals
    )
    assert np.abs(again - result.mean_curvature).max() < 1e-12


def test_default_tolerance_is_met() -> None:
    """1e-6 D per iteration leaves positions within about that of the tight solution."""
    patch, tight = solved("catenoid", 1000)
    default = fair_patch(patch, tolerance=1e-6)
    assert default.converged
    assert default.iterations < tight.iterations
    assert np.abs(default.vertices - tight.vertices).max() < 1e-5 * patch.diameter
