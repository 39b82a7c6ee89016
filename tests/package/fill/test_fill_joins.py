"""fairing.fill with continuity="G2": surfaces over holes that continue the curvature around them."""

from functools import lru_cache
from typing import Any

import numpy as np
import pytest

import curves
import fairing
import holes
from holes import FloatArray, IntArray

# H is a cubic function of the arc length: Δ_B² H = 0 but Δ_B H ≠ 0.
CUBIC = curves.OdeCurve(-1.6, 1.6, (0.0, 0.0, 0.0), lambda s, _: 0.4 + 0.5 * s + 0.6 * s**2 - 2.0 * s**3)


def cubic(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    profile = CUBIC.frame(2.4 * u - 1.2)
    return profile.x, profile.y, 2.4 * v - 1.2


def off_cubic(points: FloatArray) -> FloatArray:
    profile = CUBIC.frame(CUBIC.nearest(points[:, 0], points[:, 1]))
    return np.hypot(profile.x - points[:, 0], profile.y - points[:, 1])


def curvature_of_cubic(points: FloatArray) -> FloatArray:
    """Of the sheet that `holed` makes, whose normals point away from the profile's left."""
    return -0.5 * CUBIC.frame(CUBIC.nearest(points[:, 0], points[:, 1])).curvature


def torus(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    around, across = 2.8 * u - 1.4, 2.4 * v - 1.2
    return (2 + np.cos(across)) * np.cos(around), (2 + np.cos(across)) * np.sin(around), np.sin(across)


def off_torus(points: FloatArray) -> FloatArray:
    return np.abs(np.hypot(np.hypot(points[:, 0], points[:, 1]) - 2, points[:, 2]) - 1)


SURFACES = {"cubic": (cubic, off_cubic), "torus": (torus, off_torus)}


@lru_cache
def holed(name: str, cells: int) -> tuple[FloatArray, IntArray, IntArray]:
    vertices, triangles = holes.sheet(SURFACES[name][0], (cells, cells), holes.disc)
    return vertices, triangles, min(fairing.boundary_loops(triangles), key=len)


def filled(name: str, cells: int, **options: Any) -> fairing.FillResult:
    vertices, triangles, loop = holed(name, cells)
    return fairing.fill(vertices, triangles, [loop], **options)


def error(name: str, cells: int, result: fairing.FillResult) -> float:
    """The largest distance from the surface over D."""
    vertices, _, loop = holed(name, cells)
    size = 2 * np.linalg.norm(vertices[loop] - vertices[loop].mean(axis=0), axis=1).max()
    return float(SURFACES[name][1](result.vertices).max() / size)


@pytest.mark.parametrize(("name", "bounds"), [("cubic", (1.5e-3, 1e-4)), ("torus", (3e-4, 8e-5))])
def test_the_curvature_around_is_continued(name: str, bounds: tuple[float, float]) -> None:
    """It is fitted to the faces around. Tangent joins stay 4e-3 and 5e-4 off, however fine the mesh is."""
    for cells, bound in zip((40, 80), bounds, strict=True):
        tangent, curved = (filled(name, cells, continuity=continuity) for continuity in ("G1", "G2"))
        assert (tangent.continuity, curved.continuity) == ("G1", "G2")
        assert (curved.converged, curved.warnings) == (True, ())
        assert error(name, cells, curved) < bound < error(name, cells, tangent)
    assert error(name, 80, curved) < 0.15 * error(name, 80, tangent)


def test_curvatures_are_given_in_the_order_of_the_loops_or_of_the_vertices() -> None:
    vertices, triangles, loop = holed("cubic", 40)
    exact = curvature_of_cubic(vertices)
    fits = fairing.surrounding_normals(vertices, triangles, loop).curvatures
    assert np.corrcoef(fits, exact[loop])[0, 1] > 0.9  # of the same sign
    given = [filled("cubic", 40, continuity="G2", fixed_curvatures=values) for values in (exact, [exact[loop]])]
    turned = fairing.fill(vertices, triangles, [loop[::-1]], continuity="G2", fixed_curvatures=exact[loop[::-1]])
    for result in (*given, turned):
        assert error("cubic", 40, result) < 3e-4
    wrong = filled("cubic", 40, continuity="G2", fixed_curvatures=exact[loop[::-1]])
    assert error("cubic", 40, wrong) > 1e-3


def test_a_rough_outline_keeps_the_tangent_join_and_says_so() -> None:
    vertices, triangles, loop = holed("torus", 40)
    rough = vertices + np.random.default_rng(0).normal(0.0, 2e-3, vertices.shape)
    tangent = fairing.fill(rough, triangles, [loop])
    curved = fairing.fill(rough, triangles, [loop], continuity="G2")
    assert curved.continuity == "G1"
    (warning,) = curved.warnings
    assert (warning.code, "smooth_share" in warning.figures) == ("G2_NOT_MET", True)
    np.testing.assert_array_equal(np.sort(warning.elements), np.sort(loop))
    np.testing.assert_array_equal(curved.vertices, tangent.vertices)


def test_a_bridge_continues_curvature_too() -> None:
    """Between two parts of an ellipsoid's side, which no harmonic surface is."""

    def ellipsoid(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        polar = (0.15 + 0.7 * v) * np.pi
        return np.sin(polar) * np.cos(2 * np.pi * u), np.sin(polar) * np.sin(2 * np.pi * u), -1.5 * np.cos(polar)

    vertices, triangles = holes.sheet(ellipsoid, (60, 40), holes.band, closed=True)
    loops = sorted(fairing.boundary_loops(triangles), key=lambda loop: abs(vertices[loop, 2].mean()))[:2]
    off = []
    for continuity in ("G1", "G2"):
        result = fairing.fill(vertices, triangles, loops, bridge=True, continuity=continuity)
        assert (result.continuity, result.converged) == (continuity, True)
        off.append(abs(np.linalg.norm(result.vertices / [1.0, 1.0, 1.5], axis=1) - 1).max())
    assert off[1] < 0.3 * off[0]
