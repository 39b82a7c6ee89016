"""The exact surfaces are exact and the meshes are what they claim: checked without the engine."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest

import blend
import curves
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


def test_known_mean_curvatures() -> None:
    assert np.allclose(shapes.cap(60, radius=2.0).mean_curvature, -0.5, atol=1e-14)
    assert np.allclose(shapes.cylinder(60).mean_curvature, -0.5, atol=1e-14)
    assert np.allclose(shapes.catenoid(60).mean_curvature, 0.0, atol=1e-14)
    assert np.allclose(shapes.unduloid(60).mean_curvature, -0.5, atol=1e-12)


def test_unduloid_conserves_its_force() -> None:
    at = curves.delaunay_profile(-0.8, 2.0, 0.6, 1.4).frame(np.linspace(-0.8, 2.0, 301))
    force = at.x * np.sin(at.angle) - 0.5 * at.x**2
    assert np.abs(force - force[0]).max() < 1e-12


def test_linear_flux_has_a_constant_flux_of_mean_curvature() -> None:
    """r H′ = c by central differences of the H that the surface reports (step 1e-4: 1e-7)."""
    surface = shapes.linear_flux(60, flux=0.35).surface
    s = np.linspace(0.1, 1.3, 40)
    slope = (surface.mean_curvature(s + 1e-4) - surface.mean_curvature(s - 1e-4)) / 2e-4
    assert np.abs(surface.width(s) * slope + 0.35).max() < 1e-6
    assert np.ptp(surface.mean_curvature(s)) > 0.2


def test_clothoid_has_a_linear_curvature() -> None:
    surface = shapes.clothoid(60, a=0.4, b=0.8).surface
    s = np.linspace(-1, 1, 40)
    assert np.allclose(surface.mean_curvature(s), 0.2 + 0.4 * s, atol=1e-14)


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


@pytest.mark.parametrize("shape", ["rectangle", "oval"])
@pytest.mark.parametrize("name", ["cylinder", "catenoid", "unduloid", "linear_flux", "clothoid"])
def test_open_patches_have_a_free_neighbour_everywhere(name: str, shape: str) -> None:
    patch = getattr(shapes, name)(500, shape=shape)
    assert measures.is_oriented_manifold(patch.triangles)
    inner = np.isin(measures.edges(patch.triangles), patch.fixed).all(axis=1).sum()
    assert inner == len(measures.border_edges(patch.triangles))


def test_irregular_meshes_are_irregular() -> None:
    def share_of_six(style: Style) -> float:
        patch = shapes.catenoid(1000, style)
        valence = measures.valences(patch.triangles, len(patch.vertices))[patch.free]
        return float((valence == 6).mean())

    assert share_of_six(STYLES["even"]) > 0.9
    assert share_of_six(STYLES["jittered"]) < 0.65
    assert share_of_six(STYLES["random"]) < 0.45
    inserted = shapes.catenoid(1000, STYLES["valence 3"])
    assert (measures.valences(inserted.triangles, len(inserted.vertices)) == 3).sum() >= 200


def test_grading_and_aspect_are_met() -> None:
    graded = shapes.cylinder(2000, Style(grading=10.0, jitter=0.2))
    ends = graded.vertices[measures.edges(graded.triangles)]
    length = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    height = ends[:, :, 2].mean(axis=1)
    ratio = np.median(length[height > 0.9]) / np.median(length[height < -0.9])
    assert 6 < ratio < 12
    flat = shapes.plane(1000, Style(aspect=4.0, jitter=0.2))
    edge = np.abs(np.diff(flat.vertices[measures.edges(flat.triangles)], axis=1)[:, 0])
    assert 2.5 < edge[:, 1].mean() / edge[:, 2].mean() < 6


def test_same_seed_same_mesh_other_seed_other_mesh() -> None:
    one, two, other = (shapes.cap(300, Style(seed=seed)) for seed in (3, 3, 4))
    assert np.array_equal(one.vertices, two.vertices)
    assert not np.array_equal(one.triangles, other.triangles)


@pytest.mark.parametrize("kind", ["membrane", "point"])
def test_start_from_nothing_forgets_the_surface(kind: Literal["membrane", "point"]) -> None:
    patch = shapes.cap(300)
    start = shapes.start_from_nothing(patch, kind)
    assert np.array_equal(start[patch.fixed], patch.vertices[patch.fixed])
    assert patch.error(start) > 0.3
    assert np.isfinite(start).all()


@pytest.mark.parametrize("jitter", [0.0, 0.6])
def test_cylinder_blend(jitter: float) -> None:
    made = blend.cylinder_blend(820, jitter=jitter)
    assert measures.is_oriented_manifold(made.triangles)
    assert measures.euler_number(made.triangles) == -1
    assert np.array_equal(np.unique(measures.border_edges(made.triangles)), np.sort(made.fixed))
    assert measures.volume(made.vertices, made.triangles) > 0
    rim = made.vertices[made.fixed]
    axis = rim - made.fixed_normals
    assert np.allclose(np.linalg.norm(axis, axis=1), 2.0, atol=1e-14)
    assert np.abs((made.fixed_normals * axis).sum(axis=1)).max() < 1e-14


def test_blend_with_a_regular_rectangle_has_the_size_of_the_paper() -> None:
    """Fig. 1a and Table 1: 920 vertices, 1746 triangles, hence 96 on the rims; the rectangle's valences are 6."""
    rectangle = blend.Rectangle(17, 17, np.pi / 32, (0.0, 0.5))
    made = blend.blend_with_rectangle(824, rectangle, rim=32)
    assert (len(made.vertices), len(made.triangles), len(made.fixed)) == (920, 1746, 96)
    assert measures.is_oriented_manifold(made.triangles)
    assert measures.euler_number(made.triangles) == -1
    offset = np.abs(made.flat[:, :2] - rectangle.centre).max(axis=1)
    inner = (offset < 7.5 * rectangle.spacing) & (made.flat[:, 2] > 0)
    assert inner.sum() == 15 * 15
    assert (measures.valences(made.triangles, 920)[inner] == 6).all()


def test_two_sided_distance_of_parallel_and_shifted_planes() -> None:
    flat = shapes.plane(300)
    moved = flat.vertices + np.array([0.01, 0.0, 0.0])
    same = (flat.vertices, flat.triangles)
    assert measures.two_sided_distance(same, (moved, flat.triangles)) == pytest.approx(0.01)
    wider = flat.vertices * np.array([1.0, 1.0, 1.1])
    assert measures.two_sided_distance(same, (wider, flat.triangles)) == pytest.approx(0.16, rel=0.05)


def test_observed_order() -> None:
    assert measures.observed_order((1000, 4000), (4e-3, 1e-3)) == pytest.approx(2.0)
