"""Δ_B H = load as `bulge` sweeps from −3 to 3 (load = 8 bulge / a³), by both methods (§7.5).

On surfaces of revolution the radial equation (r H′)′ = load r can be solved by shooting from the pole: the branch that
begins at the flat disc of radius a ends at a bulge of 1.15 on either side; the one that begins at the spherical cap
of 60° reaches from −2.0 … −2.5 to 0.2 … 0.3. Where there is a solution it has to be found, elsewhere nothing is.
"""

from __future__ import annotations

from functools import lru_cache, partial
from typing import Any

import numpy as np
import pytest

import blend
import fairing
import shapes
from curves import FloatArray
from test_paper import MILD

BULGES = (-3.0, -2.0, -1.0, -0.5, 0.5, 1.0, 2.0, 3.0)
SURFACES = {
    "flat disc": partial(shapes.cap, 150, MILD, half_angle=0.01),
    "spherical cap": partial(shapes.cap, 150, MILD, half_angle=60.0),
    "cylinder blend": partial(blend.cylinder_blend, 150),
}
SOLVABLE = {"flat disc": (-1.1, 1.1), "spherical cap": (-2.0, 0.2)}


@lru_cache(maxsize=3)
def surface(name: str) -> Any:
    return SURFACES[name]()


def radius(patch: Any) -> float:
    """a: root mean square distance of the outline from its centroid."""
    outline = patch.vertices[patch.fixed]
    return float(np.sqrt(((outline - outline.mean(axis=0)) ** 2).sum(axis=1).mean()))


@lru_cache(maxsize=64)
def bulged(name: str, method: str, bulge: float) -> fairing.FairResult:
    patch = surface(name)
    return fairing.fair(
        patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals,
        equation="constant", load=8 * bulge / radius(patch) ** 3, method=method,
    )  # fmt: skip


@pytest.mark.parametrize("bulge", BULGES)
@pytest.mark.parametrize("method", ["paper", "global"])
@pytest.mark.parametrize("name", list(SURFACES))
def test_every_step_of_the_sweep_converges_or_says_that_it_does_not(name: str, method: str, bulge: float) -> None:
    patch, result = surface(name), bulged(name, method, bulge)
    load = abs(8 * bulge / radius(patch) ** 3) * patch.diameter**3
    assert np.isfinite(result.vertices).all()
    assert result.converged == ("NOT_CONVERGED" not in {w.code for w in result.warnings})
    assert not result.converged or result.residual < 0.05 * load
    # What comes back is a surface that less of the load belongs to.
    assert extent(patch, result.vertices) < 2 * extent(patch, patch.vertices) + 0.5 * patch.diameter


def extent(patch: Any, points: FloatArray) -> float:
    return float(np.linalg.norm(points - patch.vertices[patch.fixed].mean(axis=0), axis=1).max())


@pytest.mark.parametrize("bulge", [*BULGES, -0.2, 0.2])
@pytest.mark.parametrize("method", ["paper", "global"])
@pytest.mark.parametrize("name", list(SOLVABLE))
def test_solutions_are_found_where_the_radial_equation_has_them(name: str, method: str, bulge: float) -> None:
    least, greatest = SOLVABLE[name]
    assert bulged(name, method, bulge).converged == (least <= bulge <= greatest)


@pytest.mark.parametrize(("bulge", "exists"), [(0.03, True), (0.06, True), (0.07, False), (0.15, False), (0.5, False)])
def test_half_a_sphere_bulges_as_far_as_the_radial_equation(bulge: float, exists: bool) -> None:
    """Shot from the pole, the branch that begins at the sphere ends at 0.065: H a = −1.12 and 1.43 a high there."""
    patch = shapes.cap(300)
    result = fairing.fair(
        patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals,
        equation="constant", load=8 * bulge / radius(patch) ** 3,
    )  # fmt: skip
    assert result.converged == exists
