"""The exact surfaces are exact, and the meshes on them are what they claim: checked without the engine."""

import numpy as np
import pytest

import graded
import measures
import shapes
from shapes import Patch, Style

MADE = {"sphere": shapes.cap, "torus": shapes.torus, **shapes.FAMILIES}
STYLES = {
    "jittered": Style(),
    "strong": Style(jitter=1.0, seed=2),
    "valence 3": Style(valence3=0.2),
    "flipped": Style(flips=0.2),
    "random": Style(layout="random"),
    "graded": Style(grading=10.0),
    "anisotropic": Style(aspect=4.0),
    "grid": Style(layout="grid"),
}


@pytest.mark.parametrize("name", MADE)
def test_normals_curvature_and_distance_are_those_of_differences(name: str) -> None:
    """Eq. 8 along both principal directions, steps of 1e-3: second order, so 1e-5 is fair."""
    surface, rng = MADE[name](60).surface, np.random.default_rng(1)
    start, stop = surface.curve.start, surface.curve.stop
    s, t = start + (stop - start) * (0.1 + 0.8 * rng.random(50)), rng.random(50)
    here, normal, step = surface.point(s, t), surface.normal(s, t), 1e-3
    turn = step / surface.width(s)
    rings = [surface.point(s + step, t), surface.point(s - step, t)]
    rings += [surface.point(s, t + turn), surface.point(s, t - turn)]
    cross = np.cross(rings[0] - rings[1], rings[2] - rings[3])
    cosine = (cross * normal).sum(axis=1) / np.linalg.norm(cross, axis=1)
    assert np.abs(np.abs(cosine) - 1).max() < 1e-9
    kappa = [2 * ((q - here) * normal).sum(1) / ((q - here) ** 2).sum(1) for q in rings]
    assert np.abs(np.mean(kappa, axis=0) - surface.mean_curvature(s)).max() < 1e-5
    for offset in (0.0, 1e-9, 1e-4, -0.05):
        assert np.abs(surface.distance(here + offset * normal) - abs(offset)).max() < 2e-13


def check(patch: Patch, loops: int) -> None:
    """A manifold that hugs its surface, whose border is what is fixed."""
    assert measures.is_oriented_manifold(patch.triangles)
    assert np.array_equal(np.unique(measures.border_edges(patch.triangles)), np.sort(patch.fixed))
    assert measures.euler_number(patch.triangles) == 2 - loops
    assert patch.error(patch.vertices) < 1e-13
    a, b, c = (patch.vertices[patch.triangles[:, k]] for k in range(3))
    mean = patch.normals[patch.triangles].mean(axis=1)
    assert ((np.cross(b - a, c - a) * mean).sum(axis=1) > 0).all()


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("family", shapes.FAMILIES)
def test_meshes_are_manifold_oriented_and_exact(family: str, style: str) -> None:
    if style == "grid" and family in ("hemisphere", "clothoid", "plane"):
        pytest.skip("grids are made on tubes and rectangles")
    patch = shapes.FAMILIES[family](500, STYLES[style])
    assert abs(len(patch.free) - 500) <= 40
    check(patch, 2 if patch.domain.shape == "tube" else 1)


def test_distances_between_meshes() -> None:
    """Of shifted planes; and by octaves of triangles the same as by trying each."""
    flat = shapes.plane(300)
    moved = flat.vertices + np.array([0.01, 0.0, 0.0])
    same = (flat.vertices, flat.triangles)
    assert measures.two_sided_distance(same, (moved, flat.triangles)) == pytest.approx(0.01)
    patch = graded.regraded(shapes.cap(60), 300)
    check(patch, 1)
    points = np.random.default_rng(3).standard_normal((20, 3))
    fast = measures.distance_to_mesh(points, patch.vertices, patch.triangles)
    each = [measures.distance_to_mesh(points, patch.vertices, triangle[None]) for triangle in patch.triangles]
    assert np.abs(fast - np.min(each, axis=0)).max() < 1e-14
