"""`Boundary.tension`: how far in a surface carries the slopes of its boundary, Δ_B (w (H − H₀)) = 0 (docs/joins.md)."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
import pytest

import fairing
import shapes
import tensed
from domains import Style
from rough_sphere import rough_sphere
from solving import codes


def faired(patch: shapes.Patch, tension: Any, **options: Any) -> fairing.FairResult:
    """From the boundary alone."""
    held = fairing.Boundary(patch.fixed, patch.fixed_normals, tension=tension)
    return fairing.fair(shapes.start_from_nothing(patch), patch.triangles, held, fairing.Options.of(**options))


def at_ends(patch: shapes.Patch, tensions: tuple[float, float]) -> Any:
    """Of each fixed vertex of a tube."""
    height = patch.vertices[patch.fixed][:, 2]
    return np.where(height < height.mean(), *tensions)


@pytest.mark.parametrize("tension", [0.5, 2.0, 4.0])
def test_domes_come_out_as_integrated_in_one_dimension_the_nearer_the_finer_the_mesh(tension: float) -> None:
    """Second order; the surface of tension 1 is another one."""
    errors = []
    for n_free in (250, 1000, 4000):
        patch = tensed.dome(n_free, tension, bend=0.5 * tension**0.8)
        result = faired(patch, tension)
        assert result.converged and not codes(result)
        errors.append(patch.error(result.vertices))
    assert errors[1] < 0.35 * errors[0] and errors[2] < 0.35 * errors[1]
    assert errors[2] < 5e-4 < 0.01 * patch.error(faired(patch, 1.0).vertices) + 5e-4
    assert patch.error(faired(patch, 1.0).vertices) > 0.05


@pytest.mark.parametrize("tensions", [(2.0, 2.0), (2.0, 1.0), (1.0, 1.5)])
def test_tubes_with_a_tension_at_each_end(tensions: tuple[float, float]) -> None:
    """As integrated; with the tensions of the ends exchanged it is another surface."""
    patch = tensed.tube(1500, tensions)
    result = faired(patch, at_ends(patch, tensions))
    assert result.converged and not codes(result)
    assert patch.error(result.vertices) < 2e-4
    assert patch.error(faired(patch, 1.0).vertices) > 1e-3
    if tensions[0] != tensions[1]:
        assert patch.error(faired(patch, at_ends(patch, tensions[::-1])).vertices) > 1e-3


STYLES = {
    "regular": Style(jitter=0.0), "jittered": Style(jitter=1.0, seed=3), "valence 3": Style(valence3=0.2, seed=1),
    "flipped": Style(flips=0.1, seed=2), "random": Style(layout="random", seed=5),
}  # fmt: skip


@pytest.mark.parametrize("name", STYLES)
def test_the_mesh_does_not_count(name: str) -> None:
    patch = tensed.dome(1000, 2.0, STYLES[name])
    assert patch.error(faired(patch, 2.0).vertices) < 6e-4


@lru_cache(maxsize=16)
def height(tension: float, scale: float = 1.0) -> float:
    """Of a dome over the rim of half a ball of radius `scale`, upright at its rim."""
    patch = shapes.cap(500, Style(jitter=0.6, seed=2), radius=scale)
    result = faired(patch, tension)
    assert result.converged and not codes(result)
    return float(result.vertices[:, 2].max()) / scale


def test_the_surface_leaves_its_tangent_planes_later_the_more_tension() -> None:
    heights = [height(tension) for tension in (0.25, 0.5, 0.7, 1.0, 1.4, 2.0, 4.0)]
    assert (np.diff(heights) > 0.1).all()
    assert heights[3] == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("scale", [1e-3, 1e4])
def test_the_unit_does_not_count(scale: float) -> None:
    assert height(2.0, scale) == pytest.approx(height(2.0), rel=1e-6)


def test_tension_one_is_the_tangent_join_to_the_bit() -> None:
    patch = shapes.cap(500, half_angle=60)
    plain = faired(patch, None)
    for one in (1.0, np.ones(len(patch.fixed))):
        assert np.array_equal(faired(patch, one).vertices, plain.vertices)


@pytest.mark.parametrize("make", [shapes.cylinder, lambda n: shapes.plane(n, shape="rectangle")])
def test_what_goes_straight_on_from_its_boundary_stays(make: Any) -> None:
    """A tube's generators, and planes, are straight: no tension changes them."""
    patch = make(600)
    for tension in (0.5, 3.0):
        result = faired(patch, tension)
        assert result.converged and not codes(result)
        assert patch.error(result.vertices) < 3e-4


def test_it_acts_on_the_part_that_has_it() -> None:
    """A dome with tension along one side of its rim is fuller there, and nearly as before on the other."""
    patch = shapes.cap(1500, half_angle=60)
    x = patch.vertices[patch.fixed][:, 0]
    plain, parted, whole = (faired(patch, t).vertices for t in (1.0, np.where(x > 0, 2.0, 1.0), 2.0))
    rise = [np.linalg.norm(v, axis=1) - np.linalg.norm(plain, axis=1) for v in (parted, whole)]
    there, beyond = (patch.vertices[:, 0] > 0.4), (patch.vertices[:, 0] < -0.4)
    assert rise[0][there].mean() > 0.5 * rise[1][there].mean() > 0.01
    assert rise[0][beyond].mean() < 0.5 * rise[0][there].mean()


@pytest.mark.parametrize("tension", [0.4, 2.5])
@pytest.mark.parametrize("seed", range(4))
def test_jagged_boundaries_have_it_too(seed: int, tension: float) -> None:
    ball = rough_sphere(900, noise=0.0, seed=seed, swelling=0.0)
    held = fairing.Boundary(ball.outline, ball.exact[ball.outline], tension=tension)
    result = fairing.fair(ball.exact, ball.inside, held)
    assert result.converged and not codes(result)
    rise = float(ball.heights(result.vertices, ball.free).mean())
    assert (rise > 0.05) if tension > 1.0 else (rise < -0.05)


def test_a_solver_and_a_new_mesh_have_it_and_threads_give_the_same_bits() -> None:
    patch = tensed.dome(1000, 2.0)
    one = faired(patch, 2.0)
    held = fairing.Boundary(patch.fixed, patch.fixed_normals, tension=2.0)
    start = shapes.start_from_nothing(patch)
    for threads in (1, 3):
        assert np.array_equal(fairing.fair(start, patch.triangles, held, threads=threads).vertices, one.vertices)
    solver = fairing.Solver(patch.triangles, fixed=patch.fixed)
    again = solver.solve(start, patch.fixed_normals, tension=2.0)
    assert np.array_equal(again.vertices, one.vertices)
    assert patch.error(fairing.remesh(start, patch.triangles, held).vertices) < 1e-3


def test_where_it_can_not_be_had_the_surface_is_that_of_tension_one_and_says_so() -> None:
    """A lone pin in a cap, a crease, and a rim that leads apart so fast that no dome closes it."""
    patch = shapes.cap(400, half_angle=60)
    pin = patch.free[np.linalg.norm(patch.vertices[patch.free] - [0.0, 0.0, 1.0], axis=1).argmin()]
    fixed = np.append(patch.fixed, pin)
    for held, options in (
        (fairing.Boundary(fixed, patch.normals[fixed], tension=2.0), None),
        (fairing.Boundary(patch.fixed, patch.fixed_normals, tension=2.0),
         fairing.Options(curves=fairing.Curves(creases=patch.fixed[:9]))),
    ):  # fmt: skip
        plain = fairing.Boundary(held.vertices, held.normals)
        result = fairing.fair(patch.vertices, patch.triangles, held, options)
        assert "TENSION_NOT_MET" in codes(result)
        assert np.array_equal(result.vertices, fairing.fair(patch.vertices, patch.triangles, plain, options).vertices)
    wide = shapes.cap(600, half_angle=120)
    result = faired(wide, 10.0)
    assert codes(result) == {"TENSION_NOT_MET"} and result.converged
    assert np.array_equal(result.vertices, faired(wide, None).vertices)


def test_wrong_tensions_are_refused() -> None:
    patch = shapes.cap(100)
    count = len(patch.fixed)
    for wrong in (0.0, -1.0, np.nan, np.inf, [1.0, 2.0], "2"):
        with pytest.raises(ValueError, match="tension"):
            faired(patch, wrong)
    with pytest.raises(ValueError, match="vertices"):
        fairing.fair(patch.vertices, patch.triangles, fairing.Boundary(tension=2.0))
    for options in (
        {"equation": "soap_film"}, {"equation": "least_variation"}, {"equation": "constant", "load": 1.0},
        {"method": "paper"}, {"continuity": "G2"}, {"feather": 0.1},
    ):  # fmt: skip
        with pytest.raises(ValueError, match="tension"):
            faired(patch, 2.0, **options)
    for kind in ("G0", "G2"):
        held = fairing.Boundary(patch.fixed, patch.fixed_normals, continuity=[kind] + ["G1"] * (count - 1), tension=2.0)
        with pytest.raises(ValueError, match="tension"):
            fairing.fair(patch.vertices, patch.triangles, held)
