"""Equations besides Δ_B H = 0 with G1 data: constant load and minimal energy (§7.5)."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import fairing
import shapes
from curves import FloatArray


def flat_disc(n_free: int) -> tuple[FloatArray, shapes.IntArray, shapes.IntArray]:
    """Vertices, triangles and rim of a flat unit disc: the parameter mesh of a cap."""
    cap = shapes.cap(n_free)
    out = np.linalg.norm(cap.vertices[:, :2], axis=1)
    polar = np.arctan2(out, cap.vertices[:, 2]) / (np.pi / 2)
    flat = cap.vertices * np.array([1.0, 1.0, 0.0])
    flat[:, :2] *= (polar / np.maximum(out, 1e-300))[:, None]
    return flat, cap.triangles, cap.fixed


@cache
def loaded_profile(load: float) -> tuple[FloatArray, FloatArray]:
    """Radii and heights of Δ_B H = load over the unit disc, flat at its rim; the branch next to the disc.

    With arc length s, slope angle φ and normals up: φ′ = 2H − sin φ / r, (r H′)′ = load · r.
    """

    def profile(start: float) -> FloatArray:
        def slope(_: float, y: FloatArray) -> list[float]:
            r, _, phi, h, flux = y
            return [np.cos(phi), np.sin(phi), 2 * h - np.sin(phi) / r, flux / r, load * r]

        def rim(_: float, y: FloatArray) -> float:
            return float(y[0] - 1)

        rim.terminal = True  # type: ignore[attr-defined]
        tiny = 1e-6
        begin = [tiny, 0.0, start * tiny, start, load * tiny**2 / 2]
        return solve_ivp(slope, (0, 4), begin, events=rim, rtol=1e-11, atol=1e-13, max_step=0.02).y

    linear = -load / 8  # H at the centre to first order
    start = brentq(lambda h: profile(h)[2, -1], 1.4 * linear, 0.9 * linear)
    found = profile(start)
    return found[0], found[1] - found[1, -1]


def disc_error(n_free: int, bulge: float) -> float:
    """Largest height error of a loaded unit disc against the radial equation."""
    vertices, triangles, rim = flat_disc(n_free)
    up = np.tile([0.0, 0.0, 1.0], (len(rim), 1))
    load = 8 * bulge
    result = fairing.fair(
        vertices, triangles, fixed=rim, fixed_normals=up, equation="constant", load=load, tolerance=1e-9
    )
    assert result.converged
    radius, height = loaded_profile(abs(load))
    expected = np.interp(np.linalg.norm(result.vertices[:, :2], axis=1), radius, height)
    return float(np.abs(result.vertices[:, 2] - np.sign(bulge) * expected).max())


def test_a_loaded_disc_converges_to_second_order() -> None:
    """At 500, 2000 and 8000 vertices."""
    assert disc_error(500, 1.0) > 3.4 * disc_error(2000, 1.0)


@pytest.mark.parametrize("bulge", [1.3, 2.0, 4.0])
def test_a_load_that_is_too_much_keeps_the_surface_of_the_last_one(bulge: float) -> None:
    """Not the unloaded one: it is higher than that of the largest bulges that are surely solved, and its own H tells
    the load that it solves."""
    vertices, triangles, rim = flat_disc(700)
    up = np.tile([0.0, 0.0, 1.0], (len(rim), 1))

    def bulged(by: float) -> fairing.FairResult:
        return fairing.fair(vertices, triangles, fixed=rim, fixed_normals=up, equation="constant", load=8 * by)

    result = bulged(bulge)
    assert not result.converged
    (text,) = (w.message for w in result.warnings if w.code == "NOT_CONVERGED")
    share = float(text.split(" % of the load")[0].split()[-1]) / 100
    assert 0.9 < share * bulge < 1.25
    reached = bulged(round(share * 32) / 32 * bulge)
    assert reached.converged
    # Stages of the load are solved to 1e-4 D.
    assert np.abs(result.vertices - reached.vertices).max() < 2e-3


def solve(patch: shapes.Patch, equation: str) -> fairing.FairResult:
    result = fairing.fair(
        shapes.start_from_nothing(patch, "point"),
        patch.triangles,
        fixed=patch.fixed,
        fixed_normals=patch.fixed_normals,
        equation=equation,
        tolerance=1e-10,
    )
    assert result.converged
    return result


def test_minimal_energy_reproduces_spheres_but_not_cylinders() -> None:
    assert shapes.cap(500).error(solve(shapes.cap(500), "minimal_energy").vertices) < 1e-8
    tube = shapes.cylinder(500)
    assert tube.error(solve(tube, "minimal_energy").vertices) > 1e-3
