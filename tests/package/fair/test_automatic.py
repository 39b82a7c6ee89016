"""equation="automatic": between two loops the cheapest surface that keeps the girth of its ends."""

import numpy as np
import pytest

import fairing
import tubes


def solved(tube: tubes.Tube, equation: str = "automatic") -> fairing.FairResult:
    return tube.faired(equation=equation)


@pytest.mark.parametrize("length", [1.0, 3.0, 8.0])
def test_pipes_are_harmonic_whatever_their_length(length: float) -> None:
    result = solved(tubes.pipe(length))
    assert result.equation == "harmonic"
    assert np.abs(tubes.radii(result) - 1).max() < 1e-2


@pytest.mark.parametrize(
    ("bend", "degrees", "equation"),
    [(2, 90, "least_variation"), (3, 90, "least_variation"), (1.3, 120, "minimal_energy")],
)
def test_elbows_keep_their_girth(bend: float, degrees: float, equation: str) -> None:
    """The harmonic surface has .87 of it, none, and .82; the girth of the one taken is the best of all three."""
    tube = tubes.elbow(bend, degrees)
    result = solved(tube)
    assert (result.equation, result.provenance, result.converged) == (equation, "equation", True)
    assert result.girth is not None
    assert 0.97 <= result.girth[0] <= result.girth[1] <= 1.01
    single = solved(tube, equation)
    assert np.array_equal(result.vertices, single.vertices)


@pytest.mark.parametrize(("bend", "degrees"), [(2, 90), (1.3, 120)])
def test_a_bridge_keeps_the_girth_as_well(bend: float, degrees: float) -> None:
    """It begins with the harmonic surface of a coarse mesh, which has .87 and .83 of it."""
    tube = tubes.elbow(bend, degrees)
    normals = np.zeros_like(tube.vertices)
    normals[tube.fixed] = tube.normals
    loops = fairing.boundary_loops(tube.triangles)
    result = fairing.fill(
        tube.vertices, np.empty((0, 3), int), loops, normals=normals, bridge=True, equation="automatic"
    )
    assert result.converged
    assert result.girth is not None
    assert result.girth[0] >= 0.97
