"""Measures of surfaces against closed forms: H, normals, the cotangent Laplacian, distortion, signed distances."""

from typing import Any

import numpy as np
import pytest
from scipy.sparse import coo_array

import fairing
import measures
import shapes
import solids
from meshing import face_normals
from shapes import Patch, Style

STYLES = {
    "jittered": Style(),
    "valence 3": Style(valence3=0.2),
    "flipped": Style(flips=0.2),
    "random": Style(layout="random"),
}


def curvature_error(patch: Patch) -> Any:
    """(n,) relative to the largest exact curvature, or 1."""
    found = fairing.mean_curvature(
        patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals
    )
    return np.abs(found - patch.mean_curvature) / (np.abs(patch.mean_curvature).max() or 1.0)


def angles(patch: Patch, kind: str = "fitted", rings: int = 0) -> Any:
    """To the exact normals further than this many rings from the border, radians."""
    normals = fairing.vertex_normals(patch.vertices, patch.triangles, normals=kind)
    assert (normals * patch.normals).sum(axis=1).min() > np.cos(np.radians(30))
    sines = np.linalg.norm(np.cross(normals, patch.normals), axis=1)
    return np.arcsin(np.minimum(sines, 1.0))[measures.beyond_rings(patch.triangles, patch.fixed, rings)]


@pytest.mark.parametrize("style", STYLES)
def test_spheres_have_exact_curvatures_and_normals(style: str) -> None:
    """H at every vertex; normals away from the border, whose own are one-sided fits that neighbours may use."""
    patch = shapes.cap(500, STYLES[style], radius=2.0)
    assert curvature_error(patch).max() < 2e-7
    assert angles(patch, rings=2).max() < 1e-8


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("name", ["cylinder", "unduloid", "linear_flux", "torus", "clothoid"])
def test_the_error_of_h_falls_with_the_edge_length(name: str, style: str) -> None:
    """First order, second where H is constant along a ruling; averaged normals: order 0. A few slivers don't shrink."""
    coarse, fine = (getattr(shapes, name)(n, STYLES[style]) for n in (500, 4000))
    errors = [float(np.quantile(curvature_error(patch)[patch.free], 0.9)) for patch in (coarse, fine)]
    order = measures.observed_order((len(coarse.free), len(fine.free)), (errors[0], errors[1]))
    assert order > (1.6 if name == "cylinder" else 0.8)
    assert errors[1] < 0.02


def test_averaged_normals_are_normalised_sums_of_cross_products() -> None:
    patch = shapes.torus(500)
    total = np.zeros_like(patch.vertices)
    for corner in range(3):
        np.add.at(total, patch.triangles[:, corner], face_normals(patch.vertices, patch.triangles))
    expected = total / np.linalg.norm(total, axis=1)[:, None]
    result = fairing.vertex_normals(patch.vertices, patch.triangles, normals="averaged")
    assert np.abs(result - expected).max() < 1e-12


def stiffness(vertices: Any, triangles: Any) -> Any:
    rows, columns, values = fairing.cotan_laplacian(vertices, triangles)
    return coo_array((values, (rows, columns)), shape=(len(vertices),) * 2).toarray()


@pytest.mark.parametrize("style", [Style(), Style(flips=0.3), Style(aspect=5.0)])
def test_entries_of_the_laplacian(style: Style) -> None:
    """−(cot α + cot β), no ½, corner by corner; S has no unit, also where squares of lengths are no numbers."""
    patch = shapes.catenoid(200, style)
    expected = np.zeros((len(patch.vertices),) * 2)
    for k in range(3):
        apex, i, j = (patch.triangles[:, (k + turn) % 3] for turn in range(3))
        a, b = (patch.vertices[end] - patch.vertices[apex] for end in (i, j))
        cot = (a * b).sum(axis=1) / np.linalg.norm(np.cross(a, b), axis=1)
        for p, q, sign in ((i, j, -1), (j, i, -1), (i, i, 1), (j, j, 1)):
            np.add.at(expected, (p, q), sign * cot)
    found = stiffness(patch.vertices, patch.triangles)
    assert np.abs(found - expected).max() < 1e-11 * np.abs(expected).max()
    both = np.vstack([patch.vertices, 2.0**1000 * patch.vertices])
    faces = np.vstack([patch.triangles, patch.triangles + len(patch.vertices)])
    assert np.array_equal(stiffness(both, faces), np.kron(np.eye(2), found))
    assert np.array_equal(stiffness(2.0**-1000 * patch.vertices, patch.triangles), found)


def test_distortion_is_the_ratio_of_the_stretches() -> None:
    """Of similar triangles 1; the square root in the singular values loses digits there, not at 2."""
    patch = shapes.plane(200)
    turn = np.linalg.qr(np.random.default_rng(0).standard_normal((3, 3)))[0]
    for stretch, tolerance in ((1.0, 1e-7), (2.0, 1e-9)):
        other = 3.0 * patch.vertices * [1.0, 1.0, stretch] @ turn + [1.0, 2.0, 3.0]
        for pair in ((patch.vertices, other), (other, patch.vertices)):
            assert np.abs(fairing.conformal_distortion(*pair, patch.triangles) - stretch).max() < tolerance


@pytest.mark.parametrize("n", [2, 9])
def test_distances_to_a_box_are_exact_with_their_signs(n: int) -> None:
    """At faces, edges and corners, outside and inside: the nearest feature's normal decides."""
    points = np.random.default_rng(5).uniform(-2, 2, (4000, 3))
    beyond = np.abs(points) - 1
    expected = np.linalg.norm(np.maximum(beyond, 0), axis=1) + np.minimum(beyond.max(axis=1), 0)
    assert np.abs(fairing.deviation(points, *solids.box(n)) - expected).max() < 1e-12


def test_a_sharp_fold_has_the_right_side_at_its_ridge() -> None:
    """A wedge of 20°: from beyond its tip one face's normal alone would say inside."""
    turn = np.radians(10)
    edge = np.array([[0.0, -1, 0], [0, 1, 0]])
    tail = np.array([[-np.cos(turn), y, sign * np.sin(turn)] for sign in (1, -1) for y in (-1, 1)])
    triangles = np.array([[0, 1, 3], [0, 3, 2], [0, 4, 5], [0, 5, 1]])
    for height in (-0.01, 0.01):
        found = fairing.deviation([[0.1, 0.0, height]], np.concatenate([edge, tail]), triangles)
        assert found == pytest.approx([np.hypot(0.1, height)])


def test_what_has_no_distance_is_left_out() -> None:
    """NaN; a triangle without area counts as its edges."""
    vertices, triangles = solids.box(4)
    spoilt = vertices.copy()
    spoilt[triangles[0, 0]] = np.nan
    found = fairing.deviation([[np.nan, 0, 0], [0, 0, -1.5]], spoilt, triangles)
    assert np.isnan(found[0]) and np.isfinite(found[1])
    with pytest.raises(ValueError, match="no triangle with finite corners"):
        fairing.deviation(vertices, np.full_like(vertices, np.inf), triangles)
    flat = fairing.deviation([[0.5, 3.0, 0]], [[0, 0, 0], [1, 0, 0], [2, 0, 0.0]], [[0, 1, 2]])
    assert np.abs(flat) == pytest.approx(3.0)
