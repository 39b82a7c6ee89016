"""`fairing.denoise`: what is shorter than a wavelength goes, what is longer stays."""

import numpy as np
import pytest

import fairing
import shapes
import solids
from rough_sphere import rough_sphere


def heights_kept(length: float, size: float) -> float:
    """Share of a low wave that is left in the middle of a flat square of edge .02."""
    x, y = (part.ravel() for part in np.meshgrid(np.arange(201) * 0.02, np.arange(201) * 0.02, indexing="ij"))
    corner = (np.arange(200)[:, None] * 201 + np.arange(200)).ravel()
    quads = corner[:, None] + (0, 201, 202, 1)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
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
    triangles = []
    for i in range(len(x) - 1):
        for j in range(len(y) - 1):
            a, b, c, d = i * 40 + j, (i + 1) * 40 + j, (i + 1) * 40 + j + 1, i * 40 + j + 1
            triangles += [[a, b, c], [a, c, d]]
    height = 1e-6 * np.repeat(np.cos(phase), 40)
    points = np.stack([np.repeat(x, 40), np.tile(y, len(x)), height], axis=1)
    middle = np.zeros(len(points), dtype=bool)
    middle.reshape(-1, 40)[24:-24, 15:25] = True
    kept = fairing.denoise(points, triangles)[:, 2]
    one = fairing.denoise(points, triangles, size=12 * 0.1)[:, 2]
    fine = middle & (np.repeat(x, 40) < 0.5)
    assert kept[fine] @ height[fine] > 0.95 * (height[fine] @ height[fine])
    assert one[fine] @ height[fine] < 0.5 * (height[fine] @ height[fine])
