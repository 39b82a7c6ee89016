"""`detail`: the skin of the old patch put back on the fair surface."""

from typing import Any

import numpy as np
import pytest

import fairing
import shapes
import solids
from curves import FloatArray
from grids import halves, numbered
from rough_sphere import rough_sphere
from shapes import Patch
from solving import codes

Rotation = FloatArray


def mean_edge(patch: Patch) -> float:
    corners = patch.vertices[patch.triangles]
    return float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())


def rough(patch: Patch, edges: float = 0.25, seed: int = 0) -> FloatArray:
    """Free vertices moved along the normals by noise of this standard deviation."""
    heights = np.random.default_rng(seed).normal(size=len(patch.vertices)) * edges * mean_edge(patch)
    heights[patch.fixed] = 0
    return patch.vertices + heights[:, None] * patch.normals


def fair(patch: Patch, old: FloatArray, **options: Any) -> fairing.FairResult:
    return fairing.fair(old, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals, **options)


def heights(patch: Patch, vertices: FloatArray, over: FloatArray) -> FloatArray:
    """Along the normals, of free vertices over another surface."""
    return np.asarray(((vertices - over) * patch.normals).sum(axis=1)[patch.free])


def some_rotation() -> Rotation:
    q, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    return np.asarray(q * np.sign(np.linalg.det(q)))


@pytest.fixture(scope="module")
def cap() -> Patch:
    return shapes.cap(1500, half_angle=60.0)


def test_a_rough_swelling_turns_into_a_rough_sphere(cap: Patch) -> None:
    """The swelling goes, the noise stays: its amplitude within 15 %, and the same noise vertex by vertex."""
    noisy = rough(cap)
    above = np.clip(cap.vertices[:, 2] - cap.vertices[cap.fixed, 2].max(), 0, None) ** 2
    swollen = noisy * (1 + 0.4 * above)[:, None]
    result = fair(cap, swollen, detail=1.0)
    assert result.converged
    assert cap.distance(result.base).max() < 1e-5 * cap.diameter
    kept = heights(cap, result.vertices, result.base)
    wanted = heights(cap, noisy, cap.vertices)
    assert kept.std() == pytest.approx(wanted.std(), rel=0.15)
    assert np.corrcoef(kept, wanted)[0, 1] > 0.9


def test_a_crease_along_the_boundary_is_no_detail() -> None:
    """A sphere's cap lies flat before: what stays of it is the fair sphere."""
    whole = shapes.cap(800, half_angle=60.0)
    flat = whole.vertices.copy()
    flat[:, 2] = whole.vertices[whole.fixed, 2].mean()
    result = fair(whole, flat, detail=1.0)
    assert whole.distance(result.vertices).max() < 1e-3 * whole.diameter


def test_a_solver_keeps_the_skin_while_the_boundary_moves(cap: Patch) -> None:
    old = rough(cap)
    turn = some_rotation()
    solver = fairing.Solver(cap.triangles, fixed=cap.fixed, detail=1.0, tolerance=1e-9)
    first = solver.solve(old, cap.fixed_normals, reference=old)
    assert np.array_equal(first.vertices, fair(cap, old, detail=1.0, tolerance=1e-9).vertices)
    moved = solver.solve(old @ turn.T, cap.fixed_normals @ turn.T, reference=old)
    assert moved.vertices == pytest.approx(first.vertices @ turn.T, abs=1e-6)
    solver.change(detail=0.0)
    without = solver.solve(old, cap.fixed_normals, reference=old)
    assert np.array_equal(without.base, without.vertices)


def test_a_collapsed_patch_has_no_detail(cap: Patch) -> None:
    old = cap.vertices.copy()
    old[cap.free] = 0
    result = fair(cap, old, detail=1.0)
    assert ("REFERENCE_UNUSABLE", {"old_skin": 1.0}) in [
        (reported.code, reported.figures) for reported in result.warnings
    ]
    assert np.array_equal(result.base, result.vertices)
    assert result.converged


def test_detail_without_room_is_reported() -> None:
    """Deep folds of a wide skin, on a base of half its size."""
    patch = shapes.plane(2000)
    old = rough(patch, 0.9)
    shrunk = 0.3 * patch.vertices
    result = fairing.fair(
        shrunk, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals, reference=old, detail=1.0
    )
    assert "FLIPPED_TRIANGLES" in codes(result)
    same = fairing.fair(
        patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals, reference=old, detail=1.0
    )
    assert "FLIPPED_TRIANGLES" not in codes(same)


# `fairing.denoise`: what is shorter than a wavelength goes, what is longer stays.
def heights_kept(length: float, size: float) -> float:
    """Share of a low wave that is left in the middle of a flat square of edge .02."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(201) * 0.02, np.arange(201) * 0.02, indexing="ij"))
    triangles = halves(numbered(201, 201))
    wave = np.cos(2 * np.pi * (x - 2) / length)
    smooth = fairing.denoise(np.stack([x, y, 1e-6 * wave], axis=1), triangles, size=size)[:, 2] / 1e-6
    middle = (np.abs(x - 2) < 0.8) & (np.abs(y - 2) < 0.8)
    return float(smooth[middle] @ wave[middle] / (wave[middle] @ wave[middle]))


@pytest.mark.parametrize("share", [0.25, 0.463, 0.7, 1.0, 1.5])
def test_a_wave_loses_what_the_filter_says(share: float) -> None:
    """Of 1 − (q/(1 + q))², q = (size/length)⁴/9: 1 % at the size itself, one half at .463 of it."""
    q = share**-4 / 9
    assert heights_kept(0.8 * share, 0.8) == pytest.approx(1 - (q / (1 + q)) ** 2, abs=0.006)


@pytest.mark.parametrize("seed", range(4))
def test_a_rough_sphere_keeps_its_radius(seed: int) -> None:
    """To 1e-4, as the mean of the vertices has it, while less than three tenths of the roughness are left."""
    rough = rough_sphere(10_000, seed=seed)
    triangles = np.concatenate([rough.inside, rough.outside])
    before = np.linalg.norm(rough.skin, axis=1)
    after = np.linalg.norm(fairing.denoise(rough.skin, triangles, size=16 * rough.edge), axis=1)
    assert after.mean() == pytest.approx(before.mean(), abs=1e-4)
    assert after.std() < 0.3 * before.std()


def test_a_region_passes_smoothly_into_what_stays() -> None:
    """The free part of a smooth sphere moves by less than a thousandth of its height, its border most of all."""
    rough = rough_sphere(4_000, noise=0.0, swelling=0.0)
    triangles = np.concatenate([rough.inside, rough.outside])
    fixed = np.setdiff1d(np.arange(len(rough.exact)), rough.free)
    smooth = fairing.denoise(rough.exact, triangles, fixed=fixed, size=8 * rough.edge)
    assert np.array_equal(smooth[fixed], rough.exact[fixed])
    assert np.abs(np.linalg.norm(smooth, axis=1) - 1).max() < 1e-3


def test_edges_stay_and_keep_their_angle() -> None:
    """A rough box: its edges keep their bits, and its sides become flat without being rounded beside them."""
    exact, triangles = solids.box(20)
    edges = fairing.hard_edges(exact, triangles)
    on_edge = np.unique(edges)
    rng = np.random.default_rng(3)
    rough = exact + 0.02 * rng.normal(size=exact.shape)
    rough[on_edge] = exact[on_edge]
    smooth = fairing.denoise(rough, triangles, edges=edges, size=1.0)
    assert np.array_equal(smooth[on_edge], exact[on_edge])
    off = np.abs(np.abs(smooth).max(axis=1) - 1)
    assert off.std() < 0.5 * np.abs(np.abs(rough).max(axis=1) - 1).std()
    rounded = fairing.denoise(rough, triangles, size=1.0)
    assert np.linalg.norm(rounded[on_edge] - exact[on_edge], axis=1).max() > 0.02


def test_an_open_border_stays_and_the_surface_bends_freely_at_it() -> None:
    patch = shapes.plane(900)
    rough = patch.vertices + 0.01 * np.random.default_rng(1).normal(size=patch.vertices.shape)
    border = np.unique(np.concatenate(fairing.boundary_loops(patch.triangles)))
    smooth = fairing.denoise(rough, patch.triangles)
    assert np.array_equal(smooth[border], rough[border])
    assert np.abs(smooth - rough).max() > 0.005


def test_bad_input_is_refused_with_a_word_on_what_is_needed() -> None:
    vertices, triangles = solids.box(2)
    for wrong in ({"size": -1.0}, {"amount": 2.0}, {"edges": [[0, len(vertices) - 1]]}, {"threads": -1}):
        with pytest.raises(ValueError, match=next(iter(wrong))):
            fairing.denoise(vertices, triangles, **wrong)
    with pytest.raises(fairing.MeshError, match="fixed"):
        fairing.denoise(vertices, triangles, fixed=[len(vertices)])
    holed = vertices.copy()
    holed[3] = np.nan
    with pytest.raises(fairing.MeshError, match="NaN"):
        fairing.denoise(holed, triangles)


def test_triangles_without_area_and_loose_ones_do_no_harm() -> None:
    """Every vertex stays finite; one that only a fold without area has stays where it is."""
    vertices, triangles = solids.box(4)
    extra = np.concatenate([vertices, vertices[:1]])
    folded = np.concatenate([triangles, [[0, len(vertices), 0]]])
    smooth = fairing.denoise(extra, folded)
    assert np.isfinite(smooth).all()
    assert np.array_equal(smooth[-1], extra[-1])


def test_without_a_size_fine_parts_keep_finer_shapes() -> None:
    """A flat sheet whose edges grow tenfold, with waves of 20 edges everywhere: one size would flatten the finest."""
    x = np.concatenate([[0.0], np.cumsum(np.geomspace(0.01, 0.1, 120))])
    phase = 2 * np.pi * np.arange(len(x)) / 20
    y = np.arange(40) * 0.03
    triangles = halves(numbered(len(x), 40))
    height = 1e-6 * np.repeat(np.cos(phase), 40)
    points = np.stack([np.repeat(x, 40), np.tile(y, len(x)), height], axis=1)
    middle = np.zeros(len(points), dtype=bool)
    middle.reshape(-1, 40)[24:-24, 15:25] = True
    kept = fairing.denoise(points, triangles)[:, 2]
    one = fairing.denoise(points, triangles, size=12 * 0.1)[:, 2]
    fine = middle & (np.repeat(x, 40) < 0.5)
    assert kept[fine] @ height[fine] > 0.95 * (height[fine] @ height[fine])
    assert one[fine] @ height[fine] < 0.5 * (height[fine] @ height[fine])
