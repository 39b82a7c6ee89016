"""H = 0: a catenoid from its rims' positions alone, whatever normals are given."""

from typing import Any

import pytest

import fairing
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
