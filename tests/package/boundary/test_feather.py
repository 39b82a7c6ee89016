"""`feather`, `weights` and `detail`: what fades outside the patch, and the boundary without its noise."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

import fairing
import solids
from curves import FloatArray
from grids import halves, numbered
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
    """Chords (n,) to the nearest vertex of the boundary, as shares of D."""
    gaps = sphere.exact[:, None] - sphere.exact[sphere.boundary][None]
    return np.asarray(np.linalg.norm(gaps, axis=2).min(axis=1) / sphere.diameter)


def test_bits_outside_the_band_stay(sphere: RoughSphere, feathered: fairing.FairResult) -> None:
    changed = np.flatnonzero((feathered.vertices != sphere.vertices).any(axis=1))
    assert np.array_equal(changed, np.union1d(sphere.free, feathered.moved))
    assert np.isin(sphere.boundary, feathered.moved).all()
    assert away(sphere)[feathered.moved].max() < WIDTH + 0.02
    beyond = np.setdiff1d(sphere.outside, feathered.moved)
    assert away(sphere)[beyond].min() > 0.9 * WIDTH


def test_a_ridge_that_runs_into_the_patch_ends_softly() -> None:
    """Shorter than two bands: it is met by the fair surface, and fades on its way there."""
    count = 81
    x, y = (part.ravel() for part in np.meshgrid(*2 * [np.linspace(-1, 1, count)], indexing="ij"))
    ridge = 0.05 * np.exp(-((y / 0.08) ** 2) / 2)
    triangles = halves(numbered(count, count))
    away = np.hypot(x, y)
    inside = (away < 0.4)[triangles].all(axis=1)
    plate = Limb(np.stack([x, y, ridge], axis=1), triangles[inside], triangles[~inside])
    plain, soft = (plate.fair(detail_size=0.1, **chosen) for chosen in ({}, {"feather": 0.3}))
    top = (np.abs(y) < 0.01) & np.isin(np.arange(len(x)), np.intersect1d(plate.inside, plate.outside))
    beyond = (np.abs(y) < 0.01) & (away > 0.4 + 0.3 * 0.8)
    assert np.array_equal(plain.vertices[top, 2], ridge[top])
    assert (soft.vertices[top, 2] < 0.8 * ridge[top]).all()
    assert np.array_equal(soft.vertices[beyond, 2], ridge[beyond])


def test_the_change_fades_without_slope_at_either_end(clean: RoughSphere) -> None:
    """Of waves all over the sphere what remains in the band is 1 − w, w = 1 − s² (3 − 2 s) of the distance."""
    waves = 0.01 * np.sin(30 * clean.exact[:, :1]) * clean.exact
    case = RoughSphere(clean.exact, clean.exact, clean.exact + waves, clean.inside, clean.outside, clean.boundary)
    result = case.fair(feather=WIDTH, detail_size=0.6)
    share = np.clip(away(case)[result.moved] / WIDTH, 0, 1)
    kept, before = (case.heights(points, result.moved) for points in (result.vertices, case.vertices))
    for begin in (0.0, 0.2, 0.4, 0.6, 0.8):
        here = (share >= begin) & (share < begin + 0.2)
        wanted = (share**2 * (3 - 2 * share))[here].mean()
        assert np.polyfit(before[here], kept[here], 1)[0] == pytest.approx(wanted, abs=0.05)


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


def test_the_mesh_border_stays(sphere: RoughSphere) -> None:
    """A feather wider than what there is ends at the border."""
    near = sphere.outside[(sphere.exact[sphere.outside, 2] > 0).all(axis=1)]
    result = sphere.fair(feather=3.0, outside=near)
    border = np.unique(np.concatenate(fairing.boundary_loops(np.concatenate([sphere.inside, near]))))
    assert np.array_equal(result.vertices[border], sphere.vertices[border])
    assert not np.isin(border, result.moved).any()


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


@pytest.mark.parametrize("rings", [0, 1, 3])
def test_a_band_ends_at_a_hard_edge(rings: int) -> None:
    """A crease beside the patch is not rounded, and what lies beyond keeps its bits, as do faces at a hard boundary."""
    panel = solids.panel(rings)
    found = fairing.boundary_normals(panel.vertices, panel.inside, panel.rim, outside=panel.outside)
    crease = 0.3 + 0.05 * rings
    result = fairing.fair(
        panel.vertices, panel.inside, fixed=panel.rim, fixed_normals=found.normals, outside=panel.outside, feather=0.3
    )
    moved = panel.clean[result.moved, 1]
    assert moved.max() < crease - 0.01
    assert moved.min() < -0.4  # on the other side the band is as wide as ever
    assert panel.error(result.vertices) < 1e-3
    near = np.setdiff1d(result.moved, panel.inside)
    assert np.abs(result.vertices[near, 2] - panel.clean[near, 2]).max() < 1e-3


# `detail` with the triangles outside: both bases meet the boundary that the surroundings have without their detail.
@pytest.fixture(scope="module")
def sphere_boundary() -> RoughSphere:
    return rough_sphere(6000, seed=21)


def test_the_base_is_the_sphere_though_its_boundary_is_rough(sphere_boundary: RoughSphere) -> None:
    """Noise of a quarter edge on the boundary, too: the base is within .003 D, and without the low-pass it is not."""
    smooth, rough = (sphere_boundary.fair(detail=1.0, **chosen) for chosen in ({}, {"outside": None}))
    off, before = (
        np.abs(sphere_boundary.heights(r.base, sphere_boundary.free)).max() / sphere_boundary.diameter
        for r in (smooth, rough)
    )
    assert smooth.converged
    assert off < 3e-3
    assert before > 3 * off
    on_boundary = sphere_boundary.heights(smooth.base, sphere_boundary.boundary)
    assert on_boundary.std() < 0.2 * sphere_boundary.heights(sphere_boundary.skin, sphere_boundary.boundary).std()


def test_normals_that_were_chosen_stay(sphere_boundary: RoughSphere) -> None:
    """Leaning outwards by 25°: the base leans with them."""
    up = np.array([0.0, 0.0, 1.0])
    exact = sphere_boundary.exact[sphere_boundary.boundary]
    along = up - exact * (exact @ up)[:, None]
    leaning = exact * np.cos(0.44) + along / np.linalg.norm(along, axis=1)[:, None] * np.sin(0.44)
    given, free = (sphere_boundary.fair(detail=1.0, **chosen) for chosen in ({"fixed_normals": leaning}, {}))
    top = sphere_boundary.free[sphere_boundary.exact[sphere_boundary.free, 2].argmax()]
    flat = fairing.fair(
        sphere_boundary.exact, sphere_boundary.inside, fixed=sphere_boundary.boundary, fixed_normals=leaning
    ).vertices[top, 2]
    assert given.base[top, 2] == pytest.approx(flat, abs=0.02)
    assert free.base[top, 2] > flat + 0.1


def test_a_reference_has_its_own_boundary(sphere_boundary: RoughSphere) -> None:
    """The skin of a sphere turned and twice as large: the same noise in the end."""
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    own = sphere_boundary.fair(detail=1.0, tolerance=1e-9)
    other = sphere_boundary.fair(detail=1.0, tolerance=1e-9, reference=2 * sphere_boundary.vertices @ turn.T)
    assert other.base[sphere_boundary.boundary] == pytest.approx(own.base[sphere_boundary.boundary], abs=1e-12)
    kept, doubled = (sphere_boundary.heights(r.vertices, sphere_boundary.free) for r in (own, other))
    assert np.corrcoef(kept, doubled)[0, 1] > 0.95
