"""`feather` and `weights`: the change fades out in a band outside the patch."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import fairing
import shapes
from curves import FloatArray
from shapes import IntArray
from solving import codes


@dataclass(frozen=True)
class Region:
    """Part of a sphere's cap: triangles inside and around; outline (k,) with exact normals."""

    vertices: FloatArray
    inside: IntArray
    outside: IntArray
    outline: IntArray
    normals: FloatArray

    @property
    def free(self) -> IntArray:
        return np.setdiff1d(self.inside, self.outline)

    @property
    def diameter(self) -> float:
        rim = self.vertices[self.outline]
        return float(2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())

    def fair(self, old: FloatArray, **options: Any) -> fairing.FairResult:
        return fairing.fair(
            old, self.inside, fixed=self.outline, fixed_normals=self.normals, outside=self.outside, **options
        )


@pytest.fixture(scope="module")
def region() -> Region:
    """Of 100° of the unit sphere the first 35°."""
    cap = shapes.cap(3000, half_angle=100.0)
    inside = (cap.vertices[:, 2] > np.cos(np.radians(35)))[cap.triangles].all(axis=1)
    outline = np.unique(np.concatenate(fairing.boundary_loops(cap.triangles[inside])))
    return Region(cap.vertices, cap.triangles[inside], cap.triangles[~inside], outline, cap.vertices[outline])


def away(region: Region) -> FloatArray:
    """Angles (n,) from the nearest vertex of the outline: from its edges it is at most this."""
    cosines = region.vertices @ region.vertices[region.outline].T
    return np.asarray(np.arccos(np.clip(cosines.max(axis=1), -1, 1)))


def noisy(region: Region, seed: int = 0, size: float = 0.01) -> FloatArray:
    return np.asarray(region.vertices * (1 + size * np.random.default_rng(seed).normal(size=(len(region.vertices), 1))))


def test_a_sphere_stays_a_sphere(region: Region) -> None:
    old = region.vertices.copy()
    old[region.free] = 0
    result = region.fair(old, feather=0.3)
    assert result.converged
    assert np.abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < 2e-3


def test_bits_outside_the_band_stay(region: Region) -> None:
    old = noisy(region)
    result = region.fair(old, feather=0.3)
    changed = np.flatnonzero((result.vertices != old).any(axis=1))
    assert np.array_equal(changed, np.union1d(region.free, result.moved))
    reach = away(region)[result.moved]
    assert reach.max() < 0.3 * region.diameter * 1.05 + 0.05
    outside = np.setdiff1d(region.outside, result.moved)
    assert away(region)[outside].min() > 0.3 * region.diameter * 0.85
    assert np.isin(region.outline, result.moved).all()


def test_the_change_fades_with_no_slope_at_either_end(region: Region) -> None:
    """What is left of the noise beside the outer edge is all of it, beside the old outline next to nothing."""
    old = noisy(region)
    width = 0.5
    plain = fairing.fair(old, region.inside, fixed=region.outline, fixed_normals=region.normals)
    result = region.fair(old, feather=width)
    share = away(region)[result.moved] / (width * region.diameter)
    wide = region.fair(old, weights=_all_or_nothing(region, result))
    step = np.linalg.norm((wide.vertices - old)[result.moved], axis=1)
    part = np.linalg.norm((result.vertices - old)[result.moved], axis=1) / np.maximum(step, 1e-12)
    told = step > 1e-3
    smooth = 1 - share**2 * (3 - 2 * share)
    assert np.abs(part - smooth)[told].max() < 0.12
    assert plain.converged


def _all_or_nothing(region: Region, result: fairing.FairResult) -> FloatArray:
    weights = np.zeros(len(region.vertices))
    weights[np.union1d(region.free, result.moved)] = 1
    return weights


def test_the_noisy_rim_is_data_no_more(region: Region) -> None:
    """An outline vertex far off spoils its surroundings; with a feather it hardly does."""
    old = region.vertices.copy()
    old[region.outline] *= 1 + 0.02 * np.random.default_rng(2).normal(size=(len(region.outline), 1))
    plain = fairing.fair(old, region.inside, fixed=region.outline, fixed_normals=region.normals)
    feathered = region.fair(old, feather=0.4)
    errors = [np.abs(np.linalg.norm(r.vertices[region.free], axis=1) - 1).max() for r in (plain, feathered)]
    assert errors[1] < 0.1 * errors[0]


def test_weights_instead(region: Region) -> None:
    """Half a weight goes half of the way, inside too; without any a vertex keeps its bits."""
    old = noisy(region)
    weights = np.clip(1.5 - away(region) / 0.2, 0, 1)
    weights[region.free] = 1
    whole = region.fair(old, weights=(weights > 0).astype(float))
    part = region.fair(old, weights=weights)
    wanted = old + weights[:, None] * (whole.vertices - old)
    assert part.vertices == pytest.approx(wanted, abs=1e-12)
    assert np.array_equal(part.vertices[weights == 0], old[weights == 0])
    half = np.zeros(len(old))
    half[region.free] = 0.5
    inside_only = region.fair(old, weights=half)
    plain = fairing.fair(old, region.inside, fixed=region.outline, fixed_normals=region.normals)
    assert len(inside_only.moved) == 0
    assert inside_only.vertices[region.free] == pytest.approx(0.5 * (old + plain.vertices)[region.free], abs=2e-3)


def test_the_whole_mesh_with_all_but_the_free_vertices_fixed(region: Region) -> None:
    """Triangles outside may stand among the others; the answer is the same."""
    old = noisy(region)
    triangles = np.concatenate([region.outside, region.inside])
    fixed = np.setdiff1d(np.arange(len(old)), region.free)
    idle = fairing.fair(old, triangles, fixed=fixed, fixed_normals=region.vertices[fixed], feather=0.3)
    moving = np.isin(triangles, region.free).any(axis=1)
    rim = np.intersect1d(triangles[moving], fixed)
    named = fairing.fair(
        old, triangles[moving], fixed=rim, fixed_normals=region.vertices[rim], outside=triangles[~moving], feather=0.3
    )
    assert np.array_equal(idle.moved, named.moved)
    inner = np.union1d(region.free, region.outline)
    assert idle.vertices[inner] == pytest.approx(named.vertices[inner], abs=5e-3)


def test_with_detail_the_noise_goes_on_across_the_outline(region: Region) -> None:
    old = noisy(region)
    result = region.fair(old, feather=0.4, detail=1.0)
    kept = ((result.vertices - result.base) * region.vertices).sum(axis=1)[region.free]
    wanted = (np.linalg.norm(old, axis=1) - 1)[region.free]
    assert kept.std() == pytest.approx(wanted.std(), rel=0.15)
    assert np.corrcoef(kept, wanted)[0, 1] > 0.9


def test_the_mesh_border_stays(region: Region) -> None:
    """A feather wider than what there is ends at the border."""
    old = noisy(region)
    result = region.fair(old, feather=3.0)
    border = np.unique(np.concatenate(fairing.boundary_loops(np.concatenate([region.inside, region.outside]))))
    assert np.array_equal(result.vertices[border], old[border])
    assert not np.isin(border, result.moved).any()


def test_warnings_name_the_callers_triangles(region: Region) -> None:
    old = noisy(region, size=0.3)
    result = region.fair(old, feather=0.3, detail=1.0)
    rows = [w.elements for w in result.warnings if w.kind == "triangle"]
    assert "FLIPPED_TRIANGLES" in codes(result)
    both = np.concatenate([region.inside, region.outside])
    moving = np.isin(both, np.union1d(region.free, result.moved)).any(axis=1)
    assert moving[np.concatenate(rows)].all()


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"feather": -0.1}, "feather: 0 or a positive number"),
        ({"feather": float("nan")}, "feather: a finite number"),
        ({"weights": [0.5]}, "weights: shape"),
        ({"weights": "all"}, "weights: numbers"),
        ({"feather": 0.1, "outline": "mended"}, "outline: 'mended' is not accepted with"),
        ({"feather": 0.1, "continuity": "G2"}, "continuity: 'G2' is not accepted with"),
    ],
)
def test_what_is_refused(region: Region, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        region.fair(region.vertices, **options)


def test_weights_are_from_0_to_1_and_stand_alone(region: Region) -> None:
    ones = np.ones(len(region.vertices))
    with pytest.raises(ValueError, match="weights: numbers from 0 to 1"):
        region.fair(region.vertices, weights=1.5 * ones)
    with pytest.raises(ValueError, match="feather: is not accepted beside"):
        region.fair(region.vertices, weights=ones, feather=0.1)


def test_a_band_needs_something_outside(region: Region) -> None:
    with pytest.raises(ValueError, match="feather: a band needs the triangles outside"):
        fairing.fair(region.vertices, region.inside, fixed=region.outline, fixed_normals=region.normals, feather=0.2)
