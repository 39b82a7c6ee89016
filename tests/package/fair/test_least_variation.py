"""equation="least_variation": the surface whose normal curvatures vary least."""

import numpy as np
import pytest

import blend
import fairing
import measures
import shapes
import tubes
from shapes import Patch, Style
from tubes import radii


def faired(patch: Patch, **options: object) -> fairing.FairResult:
    """A patch from its outline alone."""
    return fairing.fair(
        shapes.start_from_nothing(patch), patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals,
        equation="least_variation", **options,
    )  # type: ignore[arg-type]  # fmt: skip


@pytest.mark.parametrize("family", ["hemisphere", "short_cylinder", "cylinder", "cylinder_patch", "plane"])
def test_surfaces_without_variation_are_exact_on_irregular_meshes(family: str) -> None:
    patch = shapes.FAMILIES[family](400, Style(jitter=0.8, seed=2))
    result = faired(patch)
    assert result.converged
    assert patch.error(result.vertices) < 1e-6


@pytest.mark.parametrize(("length", "lean"), [(3.0, 10.0), (5.0, 5.0), (5.0, -10.0), (10.0, 10.0), (10.0, -10.0)])
def test_pipes_with_leaning_ends_keep_their_radius(length: float, lean: float) -> None:
    result = tubes.pipe(length, lean, seed=1).faired()
    assert result.converged
    assert not result.warnings
    assert 0.8 < radii(result).min() <= radii(result).max() < 1.2


def test_the_error_against_the_profile_of_one_dimension_falls_with_the_mesh() -> None:
    exact = 0.86814182  # by 20 Legendre polynomials for the slope of the profile, minimised to 1e-13

    def error(around: int) -> float:
        """The mean of three meshes."""
        pipes = [tubes.pipe(5.0, 10.0, around=around, seed=seed).faired() for seed in (1, 2, 3)]
        return float(np.mean([abs(radii(result).min() - exact) for result in pipes]))

    coarse, fine = error(12), error(32)  # 4.0e-3 and 4e-4; inside, fine ones are solved on 24 edges around
    assert fine < 2e-3
    assert fine < 0.5 * coarse


def test_three_cylinders_are_joined_whatever_the_mesh() -> None:
    made = [blend.cylinder_blend(900, jitter=jitter, seed=seed) for jitter, seed in ((0.3, 1), (0.6, 2))]
    found = []
    for each in made:
        result = fairing.fair(
            each.vertices, each.triangles, fixed=each.fixed, fixed_normals=each.fixed_normals,
            equation="least_variation",
        )  # fmt: skip
        assert result.converged and not result.warnings
        assert len(fairing.self_intersections(result.vertices, each.triangles)) == 0
        found.append((result.vertices, each.triangles))
    assert measures.two_sided_distance(*found) < 0.01 * made[0].diameter


def test_the_interior_given_is_not_looked_at() -> None:
    tube = tubes.pipe(4.0, 5.0, seed=3)
    first = tube.faired().vertices
    for options in ({"seed": 1}, {"seed": 2}):
        assert (tube.faired(**options).vertices == first).all()


def test_an_outline_that_makes_no_sense_is_reported_not_refused() -> None:
    """Normals that point to and fro on a flat tube of seven columns: the energy of coarse meshes is NaN there."""
    tube = tubes.pipe(2.0, seed=3, around=7)
    flat = np.array([1.0, 0.05, 1.0])
    normals = tube.normals / flat * np.where(np.arange(len(tube.fixed)) % 2 == 0, 1, -1)[:, None]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    result = tubes.Tube(tube.vertices * flat, tube.triangles, tube.fixed, normals).faired()
    assert not result.converged
    assert np.isfinite(result.vertices).all()
