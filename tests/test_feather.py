"""`feather` and `weights`: the change fades out in a band outside the patch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import fairing
from curves import FloatArray
from rough_sphere import IntArray, RoughSphere, rough_sphere

WIDTH = 0.2  # of D


@dataclass(frozen=True)
class Limb:
    """A mesh, and its patch."""

    vertices: FloatArray
    inside: IntArray
    outside: IntArray

    def fair(self, **options: Any) -> fairing.FairResult:
        """With the normals of the surroundings."""
        rim = np.intersect1d(self.inside, self.outside)
        normals = fairing.surrounding_normals(self.vertices, self.outside, rim).normals
        chosen = {"fixed_normals": normals, "outside": self.outside, **options}
        return fairing.fair(self.vertices, self.inside, fixed=rim, **chosen)


@pytest.fixture(scope="module")
def sphere() -> RoughSphere:
    return rough_sphere(5000, seed=31)


@pytest.fixture(scope="module")
def clean() -> RoughSphere:
    return rough_sphere(3000, noise=0.0)


@pytest.fixture(scope="module")
def feathered(sphere: RoughSphere) -> fairing.FairResult:
    return sphere.fair(feather=WIDTH, detail=1.0)


def away(sphere: RoughSphere) -> FloatArray:
    """Chords (n,) to the nearest vertex of the outline, as shares of D."""
    gaps = sphere.exact[:, None] - sphere.exact[sphere.outline][None]
    return np.asarray(np.linalg.norm(gaps, axis=2).min(axis=1) / sphere.diameter)


def band_of(sphere: RoughSphere, result: fairing.FairResult, share: float) -> IntArray:
    """Vertices of the band within this part of its width."""
    return result.moved[away(sphere)[result.moved] < share * WIDTH]


def test_bits_outside_the_band_stay(sphere: RoughSphere, feathered: fairing.FairResult) -> None:
    changed = np.flatnonzero((feathered.vertices != sphere.vertices).any(axis=1))
    assert np.array_equal(changed, np.union1d(sphere.free, feathered.moved))
    assert np.isin(sphere.outline, feathered.moved).all()
    assert away(sphere)[feathered.moved].max() < WIDTH + 0.02
    beyond = np.setdiff1d(sphere.outside, feathered.moved)
    assert away(sphere)[beyond].min() > 0.9 * WIDTH


def test_the_noise_keeps_its_height_across_the_band(sphere: RoughSphere, feathered: fairing.FairResult) -> None:
    """Base included: inside, in the band and beyond it is one sphere with one noise."""
    for where in (sphere.free, feathered.moved, band_of(sphere, feathered, 0.5)):
        kept, wanted = (sphere.heights(points, where) for points in (feathered.vertices, sphere.skin))
        assert kept.std() == pytest.approx(wanted.std(), rel=0.15)
        assert np.corrcoef(kept, wanted)[0, 1] > 0.9
    assert np.abs(sphere.heights(feathered.base, sphere.free)).max() < 4e-3 * sphere.diameter


def limb(knuckles: float) -> tuple[Limb, FloatArray]:
    """A tube whose radius goes up and down by this much, with a swelling on its front, and its radii before that."""
    around, along = 64, 120
    turn = (np.arange(around) + 0.5 * (np.arange(along) % 2)[:, None]) * 2 * np.pi / around
    z = np.repeat(np.linspace(-2.5, 2.5, along), around)
    radii = 1 + knuckles * np.cos(2 * np.pi * z / 1.6)
    unit = np.stack([np.cos(turn.ravel()), np.sin(turn.ravel()), 0 * z], axis=1)
    row, k = (part.ravel() for part in np.meshgrid(np.arange(along - 1), np.arange(around), indexing="ij"))
    a, b = row * around + k, row * around + (k + 1) % around
    even = np.where(row[:, None] % 2 == 0, np.stack([a, b, a + around], 1), np.stack([a, b, b + around], 1))
    odd = np.where(
        row[:, None] % 2 == 0, np.stack([b, b + around, a + around], 1), np.stack([a, b + around, a + around], 1)
    )
    triangles = np.concatenate([even, odd])
    away = (np.arctan2(unit[:, 1], unit[:, 0]) / 1.2) ** 2 + z**2
    swollen = radii + 0.3 * np.clip(1 - 1.3 * away, 0, 1) ** 2
    inside = (away < 1)[triangles].all(axis=1)
    points = swollen[:, None] * unit + z[:, None] * [0, 0, 1]
    return Limb(points, triangles[inside], triangles[~inside]), radii


def test_a_limb_keeps_its_knuckles_in_the_band() -> None:
    """The fair surface of patch and band together would have none: waves of the shape, longer than two bands, stay."""
    finger, radii = limb(0.1)
    result = finger.fair(feather=0.15)
    band = result.moved
    change = np.linalg.norm(result.vertices[band, :2], axis=1) - radii[band]
    assert np.abs(change).max() < 0.015
    assert np.sqrt((change**2).mean()) < 0.005


def test_a_ridge_that_runs_into_the_patch_ends_softly() -> None:
    """Shorter than two bands: it is met by the fair surface, and fades on its way there."""
    count = 81
    x, y = (part.ravel() for part in np.meshgrid(*2 * [np.linspace(-1, 1, count)], indexing="ij"))
    ridge = 0.05 * np.exp(-((y / 0.08) ** 2) / 2)
    corner = np.arange(count * count).reshape(count, count)
    a, b, c, d = (part.ravel() for part in (corner[:-1, :-1], corner[1:, :-1], corner[:-1, 1:], corner[1:, 1:]))
    triangles = np.concatenate([np.stack([a, b, d], axis=1), np.stack([a, d, c], axis=1)])
    away = np.hypot(x, y)
    inside = (away < 0.4)[triangles].all(axis=1)
    plate = Limb(np.stack([x, y, ridge], axis=1), triangles[inside], triangles[~inside])
    plain, soft = (plate.fair(detail_size=0.1, **chosen) for chosen in ({}, {"feather": 0.3}))
    top = (np.abs(y) < 0.01) & np.isin(np.arange(len(x)), np.intersect1d(plate.inside, plate.outside))
    beyond = (np.abs(y) < 0.01) & (away > 0.4 + 0.3 * 0.8)
    assert np.array_equal(plain.vertices[top, 2], ridge[top])
    assert (soft.vertices[top, 2] < 0.8 * ridge[top]).all()
    assert np.array_equal(soft.vertices[beyond, 2], ridge[beyond])


def test_a_wide_band_on_a_closed_mesh(clean: RoughSphere) -> None:
    """What has no weight holds the rest; where nothing is left, the message says what to do."""
    wide = clean.fair(feather=0.7, detail=1.0)
    assert 0 < len(np.setdiff1d(np.arange(len(clean.vertices)), np.union1d(wide.moved, clean.free))) < 800
    assert np.abs(clean.heights(wide.vertices, wide.moved)).max() < 0.01
    with pytest.raises(fairing.MeshError, match="feather: the band covers all that lies around the patch"):
        clean.fair(feather=3.0)


def test_the_change_fades_without_slope_at_either_end(clean: RoughSphere) -> None:
    """Of waves all over the sphere what remains in the band is 1 − w, w = 1 − s² (3 − 2 s) of the distance."""
    waves = 0.01 * np.sin(30 * clean.exact[:, :1]) * clean.exact
    case = RoughSphere(clean.exact, clean.exact, clean.exact + waves, clean.inside, clean.outside, clean.outline)
    result = case.fair(feather=WIDTH, detail_size=0.6)
    share = np.clip(away(case)[result.moved] / WIDTH, 0, 1)
    kept, before = (case.heights(points, result.moved) for points in (result.vertices, case.vertices))
    for begin in (0.0, 0.2, 0.4, 0.6, 0.8):
        here = (share >= begin) & (share < begin + 0.2)
        wanted = (share**2 * (3 - 2 * share))[here].mean()
        assert np.polyfit(before[here], kept[here], 1)[0] == pytest.approx(wanted, abs=0.05)


def test_detail_is_linear_with_a_feather(sphere: RoughSphere, feathered: fairing.FairResult) -> None:
    """What a slider may answer from."""
    none, half = (sphere.fair(feather=WIDTH, detail=share) for share in (0.0, 0.5))
    assert none.vertices == pytest.approx(feathered.base, abs=1e-12)
    assert half.vertices == pytest.approx(0.5 * (feathered.base + feathered.vertices), abs=1e-12)
    assert np.array_equal(none.moved, feathered.moved)


def test_weights_instead(sphere: RoughSphere, feathered: fairing.FairResult) -> None:
    """Half of a weight goes half of the way from one base to the other, inside too."""
    whole = np.zeros(len(sphere.vertices))
    whole[np.union1d(sphere.free, feathered.moved)] = 1
    full, part = (sphere.fair(weights=share * whole, detail=1.0) for share in (1.0, 0.5))
    assert np.array_equal(full.moved, feathered.moved)
    kept = np.setdiff1d(np.arange(len(whole)), np.union1d(sphere.free, full.moved))
    assert np.array_equal(part.vertices[kept], sphere.vertices[kept])
    middle = sphere.free[sphere.exact[sphere.free, 2] > 0.8]
    heights = [sphere.heights(points, middle).mean() for points in (sphere.vertices, full.vertices, part.vertices)]
    assert heights[2] == pytest.approx((heights[0] + heights[1]) / 2, abs=0.01)


def test_a_patch_without_area_is_blended_without_its_detail(clean: RoughSphere) -> None:
    old = clean.vertices.copy()
    old[clean.free] = 0
    case = RoughSphere(clean.exact, clean.exact, old, clean.inside, clean.outside, clean.outline)
    result = case.fair(feather=WIDTH, detail=1.0)
    assert "REFERENCE_UNUSABLE" in {told.code for told in result.warnings}
    assert np.abs(case.heights(result.vertices, case.free)).max() < 3e-3


def test_the_mesh_border_stays(sphere: RoughSphere) -> None:
    """A feather wider than what there is ends at the border."""
    near = sphere.outside[(sphere.exact[sphere.outside, 2] > 0).all(axis=1)]
    result = sphere.fair(feather=3.0, outside=near)
    border = np.unique(np.concatenate(fairing.boundary_loops(np.concatenate([sphere.inside, near]))))
    assert np.array_equal(result.vertices[border], sphere.vertices[border])
    assert not np.isin(border, result.moved).any()


def test_warnings_name_the_callers_triangles() -> None:
    sphere = rough_sphere(2000, noise=0.9, seed=3)
    result = sphere.fair(feather=WIDTH, detail=1.0)
    named = [told.elements for told in result.warnings if told.kind == "triangle"]
    assert sum(map(len, named))
    assert np.concatenate(named).max() < len(sphere.inside)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"feather": -0.1}, "feather: 0 or a positive number"),
        ({"feather": float("nan")}, "feather: a finite number"),
        ({"weights": [0.5]}, "weights: 5000 numbers"),
        ({"weights": np.full(5000, 1.5)}, "weights: 5000 numbers"),
        ({"weights": np.ones(5000), "feather": 0.1}, "feather: is not accepted beside"),
        ({"feather": 0.1, "outline": "mended"}, "outline: this value is not accepted with"),
        ({"feather": 0.1, "reference": np.zeros((5000, 3))}, "reference: this value is not accepted with"),
        ({"feather": 0.1, "outside": None}, "feather: a band needs the triangles outside"),
    ],
)
def test_what_is_refused(sphere: RoughSphere, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        sphere.fair(**options)


def test_the_weights_of_a_width_are_to_be_had(clean: RoughSphere) -> None:
    """They stand for the width bit by bit; a patch of its own with nothing around it moves all the way."""
    outline = {"fixed": clean.outline}
    weights = fairing.feather_weights(clean.vertices, clean.inside, clean.outside, WIDTH, **outline)
    assert np.array_equal(clean.fair(weights=weights).vertices, clean.fair(feather=WIDTH).vertices)
    lone = np.concatenate([clean.vertices, [[9, 0, 0], [9, 1, 0], [9, 0, 1]]])
    count = len(clean.vertices)
    inside = np.concatenate([clean.inside, [[count, count + 1, count + 2]]])
    more = fairing.feather_weights(lone, inside, clean.outside, WIDTH, **outline)
    assert np.array_equal(more, [*weights, 1.0, 1.0, 1.0])
    with pytest.raises(ValueError, match="feather: a number above 0 is needed"):
        fairing.feather_weights(clean.vertices, clean.inside, clean.outside, 0.0)
