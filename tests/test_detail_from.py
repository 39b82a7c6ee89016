"""`detail_from`: the skin of another place, copied onto a surface that has none."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

import fairing
from rough_sphere import IntArray, RoughSphere, rough_sphere

COUNT = 6000


def bare(seed: int, count: int = COUNT) -> RoughSphere:
    """A rough sphere whose patch is smooth: a hole that was filled."""
    sphere = rough_sphere(count, seed=seed, swelling=0.0)
    vertices = sphere.skin.copy()
    vertices[sphere.free] = sphere.exact[sphere.free]
    return replace(sphere, vertices=vertices)


def lower_half(sphere: RoughSphere) -> IntArray:
    return np.asarray(sphere.outside[(sphere.exact[sphere.outside, 2] < 0.1).all(axis=1)])


def dressed(sphere: RoughSphere, **options: Any) -> fairing.FairResult:
    return sphere.fair(**{"detail": 1.0, "detail_from": lower_half(sphere), **options})


@pytest.fixture(scope="module")
def sphere() -> RoughSphere:
    return bare(11)


@pytest.fixture(scope="module")
def grown(sphere: RoughSphere) -> fairing.FairResult:
    return dressed(sphere)


def test_the_surface_beneath_is_fair(sphere: RoughSphere, grown: fairing.FairResult) -> None:
    assert np.abs(sphere.heights(grown.base, sphere.free)).max() < 4e-3 * sphere.diameter
    assert grown.converged


def test_nothing_outside_moves(sphere: RoughSphere, grown: fairing.FairResult) -> None:
    kept = np.setdiff1d(np.arange(COUNT), sphere.free)
    assert np.array_equal(grown.vertices[kept], sphere.vertices[kept])


def test_the_skin_meets_the_outline() -> None:
    """Waves of seven edges: across the outline the surface is no steeper than within, where noise would hide it."""
    sphere = bare(11)
    waves = (
        0.01 * np.sin(25 * sphere.exact[:, 0] + 1) * np.sin(25 * sphere.exact[:, 1]) * np.sin(25 * sphere.exact[:, 2])
    )
    waves[sphere.free] = 0
    result = dressed(replace(sphere, vertices=sphere.exact * (1 + waves)[:, None]))
    heights = sphere.heights(result.vertices, np.arange(COUNT))
    ends = np.unique(np.sort(np.concatenate([sphere.inside[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1), axis=0)
    steps = np.abs(heights[ends[:, 0]] - heights[ends[:, 1]])
    at_rim = np.isin(ends, sphere.outline).sum(axis=1) == 1
    inner = ~np.isin(ends, sphere.outline).any(axis=1)
    assert np.sqrt((steps[at_rim] ** 2).mean()) < 1.3 * np.sqrt((steps[inner] ** 2).mean())


def test_the_old_patch_does_not_matter(sphere: RoughSphere, grown: fairing.FairResult) -> None:
    dented = sphere.vertices.copy()
    dented[sphere.free] *= 0.8
    other = dressed(replace(sphere, vertices=dented))
    assert np.abs(other.vertices - grown.vertices).max() < 1e-3


def test_skin_on_a_turned_and_scaled_mesh(sphere: RoughSphere, grown: fairing.FairResult) -> None:
    turn, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    turn *= np.sign(np.linalg.det(turn))
    there = replace(sphere, vertices=30 * sphere.vertices @ turn.T + [5, -3, 8])
    result = dressed(there)
    assert result.vertices == pytest.approx(30 * grown.vertices @ turn.T + [5, -3, 8], abs=30 * 1e-4)


def test_the_patch_is_no_sample(sphere: RoughSphere, grown: fairing.FairResult) -> None:
    """A sample that is the whole mesh is what lies around the patch; the patch alone is none."""
    whole = np.concatenate([sphere.inside, sphere.outside])
    around = whole[~np.isin(whole, sphere.free).any(axis=1)]
    skinned = sphere.fair(detail=1.0, detail_from=around)
    assert np.array_equal(sphere.fair(detail=1.0, detail_from=whole).vertices, skinned.vertices)
    middle = sphere.inside[np.isin(sphere.inside, sphere.free).all(axis=1)]
    assert np.array_equal(dressed(sphere, detail_from=[*lower_half(sphere), *middle]).vertices, grown.vertices)
    with pytest.raises(ValueError, match="detail_from: all of the sample lies in the patch itself"):
        sphere.fair(detail=1.0, detail_from=middle)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"detail": 0.0}, "detail_from: is accepted with `detail` above 0 only"),
        ({"detail_from": np.empty((0, 3), dtype=int)}, "detail_from: one triangle at least"),
        ({"detail_from": [[0, 1, COUNT]]}, f"detail_from: .*{COUNT}"),
        ({"feather": 0.1}, "detail_from: this value is not accepted with `feather`"),
        ({"weights": np.ones(COUNT)}, "detail_from: this value is not accepted with `feather`"),
    ],
)
def test_what_is_refused(sphere: RoughSphere, options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        dressed(sphere, **options)


def test_cancelled_while_skin_is_copied(sphere: RoughSphere) -> None:
    with pytest.raises(fairing.Cancelled):
        dressed(sphere, progress=lambda fraction, stage: stage != "detail")
