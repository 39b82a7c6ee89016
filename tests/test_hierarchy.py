"""`fairing.hierarchy`: levels of a progressive mesh by half-edge collapses (§7.4)."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

import bad_inputs
import blend
import fairing
import measures
import shapes
from measures import FloatArray, IntArray
from shapes import Style
from test_fixed_curves import make_capsule


def roundness(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """Inner radius over longest edge, 1 for an equilateral triangle."""
    corners = vertices[triangles]
    lengths = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)
    double = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return np.asarray(2 * np.sqrt(3) * double / lengths.sum(axis=1) / lengths.max(axis=1))


def shortest(vertices: FloatArray, triangles: IntArray) -> float:
    ends = measures.edges(triangles)
    return float(np.linalg.norm(vertices[ends[:, 0]] - vertices[ends[:, 1]], axis=1).min())


@pytest.mark.parametrize("levels", [1, 2, 3, 5])
def test_the_number_of_levels_is_the_callers(levels: int) -> None:
    patch = shapes.cap(2000)
    result = fairing.hierarchy(patch.vertices, patch.triangles, levels=levels)
    assert len(result) == levels


def test_sizes_grow_exponentially() -> None:
    patch = shapes.cap(4000)
    levels = fairing.hierarchy(patch.vertices, patch.triangles)
    sizes = [len(vertices) - len(patch.fixed) for vertices, _ in levels]
    growth = np.array(sizes[1:]) / sizes[:-1]
    assert len(sizes) >= 3
    assert growth.max() / growth.min() < 1.1
    assert sizes[0] >= len(patch.fixed)


def test_the_last_level_is_the_mesh_itself() -> None:
    patch = shapes.cap(500)
    vertices, triangles = fairing.hierarchy(patch.vertices, patch.triangles)[-1]
    assert np.array_equal(vertices, np.arange(len(patch.vertices)))
    assert {tuple(np.roll(t, -t.argmin())) for t in triangles} == {
        tuple(np.roll(t, -t.argmin())) for t in patch.triangles
    }


@pytest.mark.parametrize("make", ["disk", "blend"])
def test_every_level_has_the_topology_and_the_outline_of_the_mesh(make: str) -> None:
    patch = shapes.cap(2000) if make == "disk" else blend.cylinder_blend(2000)
    for vertices, triangles in fairing.hierarchy(patch.vertices, patch.triangles):
        assert np.isin(patch.fixed, vertices).all()
        assert np.array_equal(np.unique(triangles), vertices)
        assert measures.is_oriented_manifold(triangles)
        assert measures.euler_number(triangles) == measures.euler_number(patch.triangles)


def test_levels_are_nested() -> None:
    patch = shapes.cylinder(2000)
    result = fairing.hierarchy(patch.vertices, patch.triangles, levels=4)
    for (coarse, _), (fine, _) in pairwise(result):
        assert np.isin(coarse, fine).all()


@pytest.mark.parametrize("style", [Style(), Style(valence3=0.2), Style(layout="random")])
def test_coarse_triangles_are_well_shaped(style: Style) -> None:
    patch = shapes.cylinder(2000, style)
    result = fairing.hierarchy(patch.vertices, patch.triangles)
    finest = roundness(patch.vertices, patch.triangles).min()
    for _, triangles in result:
        assert roundness(patch.vertices, triangles).min() >= min(0.24, 0.99 * finest)


def test_the_smallest_edge_is_kept_long() -> None:
    """Collapses take about the shortest edge left: away from the outline it grows as the spacing."""
    patch = shapes.cap(4000)
    result = fairing.hierarchy(patch.vertices, patch.triangles)
    base_vertices, base = result[0]
    inner = base[~np.isin(base, patch.fixed).any(axis=1)]
    area_share = np.sqrt(len(patch.vertices) / len(base_vertices))
    before = shortest(patch.vertices, patch.triangles)
    assert shortest(patch.vertices, inner) > 0.3 * area_share * before


def test_no_edge_becomes_a_chord_between_fixed_vertices() -> None:
    patch = shapes.cap(1000)
    before = {tuple(e) for e in measures.edges(patch.triangles).tolist()}
    for _, triangles in fairing.hierarchy(patch.vertices, patch.triangles):
        ends = measures.edges(triangles)
        joined = ends[np.isin(ends, patch.fixed).all(axis=1)]
        assert {tuple(e) for e in joined.tolist()} <= before


def test_fixed_curves_inside_the_mesh_stay() -> None:
    capsule = make_capsule(500)
    fixed = np.concatenate([capsule.rim, capsule.circle])
    base_vertices, base = fairing.hierarchy(capsule.vertices, capsule.triangles, fixed=fixed)[0]
    assert len(base_vertices) < 0.6 * len(capsule.vertices)
    assert np.isin(fixed, base_vertices).all()
    ends = {tuple(e) for e in measures.edges(base).tolist()}
    on_circle = measures.edges(capsule.triangles)
    on_circle = on_circle[np.isin(on_circle, capsule.circle).all(axis=1)]
    assert {tuple(e) for e in on_circle.tolist()} <= ends


def test_a_closed_mesh_without_fixed_vertices_has_levels_too() -> None:
    vertices, triangles, _ = bad_inputs.closed_ball(500)
    for _, level in fairing.hierarchy(vertices, triangles):
        assert measures.euler_number(level) == 2


def test_a_tiny_mesh_has_one_level() -> None:
    patch = shapes.cap(20)
    assert len(fairing.hierarchy(patch.vertices, patch.triangles)) == 1


def test_same_bits_every_time() -> None:
    patch = shapes.cap(800)
    one, other = (fairing.hierarchy(patch.vertices, patch.triangles) for _ in range(2))
    assert all(np.array_equal(a[1], b[1]) for a, b in zip(one, other, strict=True))


def test_a_large_mesh_comes_down_to_its_outline() -> None:
    """Vetoes stop no collapse early: each level has the size that exponential growth gives it."""
    n = 120
    u, v = (a.ravel() for a in np.meshgrid(np.linspace(-1, 1, n), np.linspace(-1, 1, n)))
    jitter = np.random.default_rng(0).uniform(-0.3, 0.3, (2, n * n)) * 2 / n
    points = np.column_stack([u + jitter[0], v + jitter[1], 0.2 * np.cos(3 * u) * v])
    corner = (np.arange(n - 1)[:, None] * n + np.arange(n - 1)).ravel()
    triangles = np.vstack([corner + shifts for shifts in ([[0], [1], [n + 1]], [[0], [n + 1], [n]])]).T
    triangles = np.vstack([triangles[:, :3], triangles[:, 3:]])
    levels = fairing.hierarchy(points, triangles)
    free = [len(vertices) - 4 * (n - 1) for vertices, _ in levels]
    assert free[0] == 4 * (n - 1)
    assert free[-1] == (n - 2) ** 2
    growth = np.array(free[1:]) / free[:-1]
    assert growth.max() / growth.min() < 1.05


@pytest.mark.parametrize("levels", [-1, 1.5, "two"])
def test_wrong_numbers_of_levels_are_named(levels: object) -> None:
    patch = shapes.cap(60)
    with pytest.raises(ValueError, match="levels"):
        fairing.hierarchy(patch.vertices, patch.triangles, levels=levels)  # type: ignore[arg-type]
