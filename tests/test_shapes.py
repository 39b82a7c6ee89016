"""The exact surfaces are exact and the meshes are what they claim: checked without the engine."""

from __future__ import annotations

import numpy as np
import pytest

import measures
import shapes
from shapes import Style
from surfaces import Surface

SURFACES = {
    "sphere": shapes.cap(60).surface,
    "cylinder": shapes.cylinder(60).surface,
    "catenoid": shapes.catenoid(60).surface,
    "unduloid": shapes.unduloid(60).surface,
    "linear_flux": shapes.linear_flux(60).surface,
    "torus": shapes.torus(60).surface,
    "clothoid": shapes.clothoid(60).surface,
}
STYLES = {
    "jittered": Style(),
    "even": Style(jitter=0.0),
    "strong": Style(jitter=1.0, seed=2),
    "valence 3": Style(valence3=0.2),
    "flipped": Style(flips=0.2),
    "random": Style(layout="random"),
    "graded": Style(grading=10.0),
    "anisotropic": Style(aspect=4.0),
    "grid": Style(layout="grid"),
}


def inner_points(surface: Surface) -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(1)
    start, stop = surface.curve.start, surface.curve.stop
    return start + (stop - start) * (0.1 + 0.8 * rng.random(50)), rng.random(50)


@pytest.mark.parametrize("name", SURFACES)
def test_normals_are_the_cross_product_of_the_tangents(name: str) -> None:
    surface = SURFACES[name]
    s, t = inner_points(surface)
    step = 1e-5
    along = surface.point(s + step, t) - surface.point(s - step, t)
    across = surface.point(s, t + step) - surface.point(s, t - step)
    cross = np.cross(along, across)
    cross /= np.linalg.norm(cross, axis=1)[:, None]
    cosine = (cross * surface.normal(s, t)).sum(axis=1)
    assert np.abs(np.abs(cosine) - 1).max() < 1e-9
    assert np.abs(np.linalg.norm(surface.normal(s, t), axis=1) - 1).max() < 1e-14


@pytest.mark.parametrize("name", SURFACES)
def test_mean_curvature_is_that_of_finite_differences(name: str) -> None:
    """Eq. 8 along both principal directions, steps of 1e-3: second order, so 1e-5 is fair."""
    surface = SURFACES[name]
    s, t = inner_points(surface)
    here, normal, step = surface.point(s, t), surface.normal(s, t), 1e-3
    turn = step / surface.width(s)
    rings = [
        surface.point(s + step, t), surface.point(s - step, t),
        surface.point(s, t + turn), surface.point(s, t - turn),
    ]  # fmt: skip
    kappa = [2 * ((q - here) * normal).sum(1) / ((q - here) ** 2).sum(1) for q in rings]
    assert np.abs(np.mean(kappa, axis=0) - surface.mean_curvature(s)).max() < 1e-5


@pytest.mark.parametrize("name", SURFACES)
def test_distance_along_the_normal_is_exact(name: str) -> None:
    surface = SURFACES[name]
    s, t = inner_points(surface)
    for offset in (0.0, 1e-9, 1e-4, -0.05):
        points = surface.point(s, t) + offset * surface.normal(s, t)
        assert np.abs(surface.distance(points) - abs(offset)).max() < 2e-13


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("family", shapes.FAMILIES)
def test_meshes_are_manifold_oriented_and_exact(family: str, style: str) -> None:
    if style == "grid" and family in ("hemisphere", "clothoid", "plane"):
        pytest.skip("grids are made on tubes and rectangles")
    patch = shapes.FAMILIES[family](500, STYLES[style])
    assert measures.is_oriented_manifold(patch.triangles)
    border = np.unique(measures.border_edges(patch.triangles))
    assert np.array_equal(border, np.sort(patch.fixed))
    assert measures.euler_number(patch.triangles) == (len(patch.fixed) > 0) - is_tube(patch)
    assert abs(len(patch.free) - 500) <= 40
    assert patch.error(patch.vertices) < 1e-13
    assert faces_agree_with_normals(patch)


def is_tube(patch: shapes.Patch) -> bool:
    starts = measures.border_edges(patch.triangles)
    follow = dict(starts.tolist())
    first = at = int(starts[0, 0])
    length = 0
    while length == 0 or at != first:
        at, length = follow[at], length + 1
    return length < len(starts)


def faces_agree_with_normals(patch: shapes.Patch) -> bool:
    a, b, c = (patch.vertices[patch.triangles[:, k]] for k in range(3))
    mean = patch.normals[patch.triangles].mean(axis=1)
    return bool(((np.cross(b - a, c - a) * mean).sum(axis=1) > 0).all())


def test_two_sided_distance_of_parallel_and_shifted_planes() -> None:
    flat = shapes.plane(300)
    moved = flat.vertices + np.array([0.01, 0.0, 0.0])
    same = (flat.vertices, flat.triangles)
    assert measures.two_sided_distance(same, (moved, flat.triangles)) == pytest.approx(0.01)
    wider = flat.vertices * np.array([1.0, 1.0, 1.1])
    assert measures.two_sided_distance(same, (wider, flat.triangles)) == pytest.approx(0.16, rel=0.05)
