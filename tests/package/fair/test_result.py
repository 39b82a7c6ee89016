"""What a result says, and that it says it honestly."""

import dataclasses

import numpy as np
import pytest

import fairing
import shapes
from solving import solved


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
