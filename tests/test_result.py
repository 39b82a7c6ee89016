"""What a result says, and that it says it honestly."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

import fairing
import shapes
from solving import codes, fair_patch, solved


def test_fixed_vertices_keep_their_bits_and_given_order() -> None:
    patch = shapes.catenoid(300)
    order = np.random.default_rng(0).permutation(patch.fixed)
    result = fairing.fair(patch.vertices, patch.triangles, fixed=order, fixed_normals=patch.normals[order])
    assert np.array_equal(result.fixed, order)
    assert np.array_equal(result.vertices[order], patch.vertices[order])


def test_shapes_and_types() -> None:
    patch, result = solved("catenoid", 300)
    count = len(patch.vertices)
    assert result.vertices.shape == (count, 3)
    assert result.vertices.dtype == np.float64
    assert result.mean_curvature.shape == (count,)
    assert result.boundary_angle.shape == result.fixed.shape == (len(patch.fixed),)
    assert isinstance(result.converged, bool)
    assert isinstance(result.polished, bool)
    assert isinstance(result.iterations, int)
    assert isinstance(result.warnings, tuple)
    assert result.levels == (count,)


def test_a_converged_result() -> None:
    _, result = solved("catenoid", 300)
    assert result.converged
    assert result.polished
    assert result.termination == "converged"
    assert 0 < result.iterations < 200
    assert result.residual < 1e-4 * result.initial_residual


def test_results_are_immutable() -> None:
    _, result = solved("catenoid", 300)
    with pytest.raises((AttributeError, dataclasses.FrozenInstanceError)):
        result.converged = False  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        result.vertices[0, 0] = 1.0


def test_seconds_are_those_of_the_stages() -> None:
    _, result = solved("catenoid", 300)
    assert all(isinstance(name, str) and value >= 0 for name, value in result.seconds.items())
    assert result.seconds


def test_mean_curvature_is_that_of_the_public_function() -> None:
    patch, result = solved("catenoid", 300)
    again = fairing.mean_curvature(
        result.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals
    )
    assert np.abs(again - result.mean_curvature).max() < 1e-12


def test_residual_is_the_equation_in_units_of_the_diameter() -> None:
    """|Δ_B H| D³: the same for the same shape at another size."""
    patch = shapes.catenoid(300)
    one = fair_patch(patch, max_iterations=1)
    large = fairing.fair(
        1e3 * shapes.start_from_nothing(patch), patch.triangles,
        fixed=patch.fixed, fixed_normals=patch.fixed_normals, max_iterations=1, tolerance=1e-10,
    )  # fmt: skip
    assert large.initial_residual == pytest.approx(one.initial_residual, rel=1e-6)
    assert large.residual == pytest.approx(one.residual, rel=1e-6)


def test_running_out_of_iterations_is_said() -> None:
    result = fair_patch(shapes.catenoid(300), max_iterations=1)
    assert not result.converged
    assert result.termination == "iteration_limit"
    assert "NOT_CONVERGED" in codes(result)
    assert np.isfinite(result.vertices).all()


def test_default_tolerance_is_met() -> None:
    """1e-6 D per iteration leaves positions within about that of the tight solution."""
    patch, tight = solved("catenoid", 1000)
    default = fair_patch(patch, tolerance=1e-6)
    assert default.converged
    assert default.iterations < tight.iterations
    assert np.abs(default.vertices - tight.vertices).max() < 1e-5 * patch.diameter


def test_warnings_carry_code_message_and_elements() -> None:
    patch = shapes.cap(300)
    result = fairing.fair(patch.vertices, patch.triangles)
    warning = next(w for w in result.warnings if w.code == "NORMALS_FROM_PATCH")
    assert isinstance(warning, fairing.Diagnostic)
    assert warning.message
    assert np.asarray(warning.elements).ndim == 1
