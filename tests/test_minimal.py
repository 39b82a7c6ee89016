"""H = 0: a catenoid from its rims' positions alone, whatever normals are given."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import fairing
import measures
import shapes


def minimal(patch: shapes.Patch, **options: Any) -> fairing.FairResult:
    start = shapes.start_from_nothing(patch)
    return fairing.fair(start, patch.triangles, fixed=patch.fixed, equation="soap_film", tolerance=1e-10, **options)


@pytest.mark.parametrize(("n_free", "goal"), [(1000, 2e-5), (4000, 4e-6)])
def test_catenoid_from_positions_only(n_free: int, goal: float) -> None:
    patch = shapes.catenoid(n_free)
    result = minimal(patch)
    assert result.converged
    assert patch.error(result.vertices) <= goal


def test_error_falls_with_the_edge_length() -> None:
    patches = shapes.catenoid(500), shapes.catenoid(2000)
    errors = [patch.error(minimal(patch).vertices) for patch in patches]
    counts = len(patches[0].free), len(patches[1].free)
    assert measures.observed_order(counts, (errors[0], errors[1])) >= 1.5


def test_mean_curvature_vanishes() -> None:
    """At free vertices the discrete H itself is the equation; residual is |H| D."""
    patch = shapes.catenoid(500)
    result = minimal(patch)
    assert np.abs(result.mean_curvature[patch.free]).max() * patch.diameter < 1e-6
    assert result.residual < 1e-6


def test_flat_outline_gives_a_plane() -> None:
    patch = shapes.plane(300)
    assert patch.error(minimal(patch).vertices) < 1e-9


def test_prescribed_normals_do_not_matter() -> None:
    patch = shapes.catenoid(500)
    tilted = minimal(patch, fixed_normals=np.tile([0.0, 0.0, 1.0], (len(patch.fixed), 1)))
    assert np.abs(tilted.vertices - minimal(patch).vertices).max() < 1e-7 * patch.diameter
