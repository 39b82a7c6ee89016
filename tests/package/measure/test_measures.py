"""Measures of surfaces against closed forms: H, normals, the cotangent Laplacian, distortion, signed distances."""

from typing import Any

import numpy as np
import numpy.typing as npt
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


# What a surface loses: its girth, below the lines that run on across it, and the grain of its surroundings.
FloatArray = npt.NDArray[np.float64]


IntArray = npt.NDArray[np.int64]


SIZE = 40


HALF = 14  # of the patch, in cells


def sheet() -> tuple[FloatArray, FloatArray, IntArray, npt.NDArray[np.bool_]]:
    """x, y (n,) over [−1, 1]², the triangles of a grid (m, 3), and which of these are in a square in its middle."""
    steps = np.linspace(-1.0, 1.0, SIZE + 1)
    x, y = (places.ravel() for places in np.meshgrid(steps, steps))
    i, j = (index.ravel() for index in np.mgrid[:SIZE, :SIZE])
    a = i * (SIZE + 1) + j
    triangles = np.concatenate(
        [np.column_stack([a, a + 1, a + SIZE + 2]), np.column_stack([a, a + SIZE + 2, a + SIZE + 1])]
    )
    centre = np.stack([x, y], axis=1)[triangles].mean(axis=1)
    return x, y, triangles, np.abs(centre).max(axis=1) < 2.0 * HALF / SIZE


def on_cylinder(x: FloatArray, y: FloatArray, hollow: float) -> tuple[FloatArray, FloatArray]:
    """Points (n, 3) on a cylinder along y with a hollow in its middle, and the cylinder's normals."""
    lost = (
        hollow * np.cos(0.5 * np.pi * np.clip(x / 0.7, -1, 1)) ** 2 * np.cos(0.5 * np.pi * np.clip(y / 0.7, -1, 1)) ** 2
    )
    normals = np.column_stack([np.sin(x), 0.0 * x, np.cos(x)])
    return normals + np.column_stack([0.0 * x, y, 0.0 * x]) - lost[:, None] * normals, normals


def depth(hollow: float) -> float:
    x, y, triangles, inside = sheet()
    points, normals = on_cylinder(x, y, hollow)
    used = np.unique(triangles[inside])
    number = np.full(len(x), -1)
    number[used] = np.arange(len(used))
    return fairing.looks.sunken(points[used], number[triangles[inside]], normals[used])[0]


def test_a_cylinder_does_not_sink_and_a_hollow_one_does() -> None:
    assert abs(depth(0.0)) < 0.004
    found = [depth(hollow) for hollow in (0.05, 0.1, 0.2)]
    # At a line's middle it is as deep as the hollow; the median is over lines of 0.84 to 1.98 that run beside it, too.
    for share, hollow in zip(found, (0.05, 0.1, 0.2), strict=True):
        assert hollow / 1.98 / 2.0 < share < hollow / 0.84


def lost_grain(noise: float, where: str, kept: float = 0.0, ridges: bool = False) -> bool:
    """Whether grain of that many cells is lost where the patch is smoothed to a share of it."""
    x, y, triangles, inside = sheet()
    rng = np.random.default_rng(1)
    height = rng.normal(size=len(x)) * noise * 2.0 / SIZE
    if ridges:
        height = np.where(np.abs(np.round(4.0 * x) - 4.0 * x) < 0.06, 3.0 * noise * 2.0 / SIZE, 0.0)
    free = np.setdiff1d(triangles[inside], triangles[~inside])
    before, after = height.copy(), height.copy()
    after[free] *= kept
    if where == "around":  # the old patch was smooth already
        before[free] = 0.0
    points = [np.column_stack([x, y, 0.3 * np.cos(x) + z]) for z in (before, after)]
    return fairing.looks.has_lost_grain(*points, triangles[inside], triangles[~inside])


@pytest.mark.parametrize(
    ("noise", "where", "options", "is_lost"),
    [
        (0.15, "everywhere", {}, True),
        (0.1, "everywhere", {"kept": 0.8}, False),  # it was put back
        (0.005, "everywhere", {}, False),  # it is not seen
        (0.1, "around", {}, False),  # it was not there
        (0.1, "everywhere", {"ridges": True}, False),  # features are no grain
    ],
)
def test_grain_that_is_gone_is_lost(noise: float, where: str, options: dict[str, Any], is_lost: bool) -> None:
    assert lost_grain(noise, where, **options) == is_lost


def test_what_bends_as_nothing_around_is_rougher() -> None:
    x, y, triangles, inside = sheet()
    rng = np.random.default_rng(2)
    free = np.setdiff1d(triangles[inside], triangles[~inside])

    def rougher(around: float, within: float, share: float = 1.0) -> bool:
        height = rng.normal(size=len(x)) * around * 2.0 / SIZE
        height[free] = rng.normal(size=len(free)) * within * 2.0 / SIZE * (rng.random(len(free)) < share)
        return fairing.looks.is_rougher(np.column_stack([x, y, height]), triangles[inside], triangles[~inside])

    assert rougher(0.0, 0.2)
    assert not rougher(0.2, 0.2)  # as noisy as around
    assert not rougher(0.2, 0.0)
    assert not rougher(0.0, 0.2, share=0.005)  # single places are others' business
