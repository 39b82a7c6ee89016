"""`detail` with the triangles outside: both bases meet the outline that the surroundings have without their detail."""

import numpy as np
import pytest

import fairing
from rough_sphere import RoughSphere, rough_sphere


@pytest.fixture(scope="module")
def sphere() -> RoughSphere:
    return rough_sphere(6000, seed=21)


def test_the_base_is_the_sphere_though_its_outline_is_rough(sphere: RoughSphere) -> None:
    """Noise of a quarter edge on the outline, too: the base is within .003 D, and without the low-pass it is not."""
    smooth, rough = (sphere.fair(detail=1.0, **chosen) for chosen in ({}, {"outside": None}))
    off, before = (np.abs(sphere.heights(r.base, sphere.free)).max() / sphere.diameter for r in (smooth, rough))
    assert smooth.converged
    assert off < 3e-3
    assert before > 3 * off
    on_outline = sphere.heights(smooth.base, sphere.outline)
    assert on_outline.std() < 0.2 * sphere.heights(sphere.skin, sphere.outline).std()


def test_noise_inside_is_that_outside(sphere: RoughSphere) -> None:
    """Vertex by vertex the noise that was there, up to the outline."""
    result = sphere.fair(detail=1.0)
    kept, wanted = (sphere.heights(points, sphere.free) for points in (result.vertices, sphere.skin))
    assert kept.std() == pytest.approx(wanted.std(), rel=0.15)
    assert np.corrcoef(kept, wanted)[0, 1] > 0.9
    near = np.setdiff1d(sphere.inside[np.isin(sphere.inside, sphere.outline).any(axis=1)], sphere.outline)
    kept, wanted = (sphere.heights(points, near) for points in (result.vertices, sphere.skin))
    assert np.abs(kept - wanted).std() < 0.35 * wanted.std()


def test_the_outline_keeps_its_bits(sphere: RoughSphere) -> None:
    result = sphere.fair(detail=1.0)
    assert np.array_equal(result.vertices[sphere.outline], sphere.vertices[sphere.outline])
    assert not np.array_equal(result.base[sphere.outline], sphere.vertices[sphere.outline])
    beyond = np.setdiff1d(sphere.outside, sphere.outline)
    assert np.array_equal(result.vertices[beyond], sphere.vertices[beyond])
    assert np.array_equal(result.base[beyond], sphere.vertices[beyond])


def test_normals_that_were_chosen_stay(sphere: RoughSphere) -> None:
    """Leaning outwards by 25°: the base leans with them."""
    up = np.array([0.0, 0.0, 1.0])
    exact = sphere.exact[sphere.outline]
    along = up - exact * (exact @ up)[:, None]
    leaning = exact * np.cos(0.44) + along / np.linalg.norm(along, axis=1)[:, None] * np.sin(0.44)
    given, free = (sphere.fair(detail=1.0, **chosen) for chosen in ({"fixed_normals": leaning}, {}))
    top = sphere.free[sphere.exact[sphere.free, 2].argmax()]
    flat = fairing.fair(sphere.exact, sphere.inside, fixed=sphere.outline, fixed_normals=leaning).vertices[top, 2]
    assert given.base[top, 2] == pytest.approx(flat, abs=0.02)
    assert free.base[top, 2] > flat + 0.1


def test_a_reference_has_its_own_outline(sphere: RoughSphere) -> None:
    """The skin of a sphere turned and twice as large: the same noise in the end."""
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    own = sphere.fair(detail=1.0, tolerance=1e-9)
    other = sphere.fair(detail=1.0, tolerance=1e-9, reference=2 * sphere.vertices @ turn.T)
    assert other.base[sphere.outline] == pytest.approx(own.base[sphere.outline], abs=1e-12)
    kept, doubled = (sphere.heights(r.vertices, sphere.free) for r in (own, other))
    assert np.corrcoef(kept, doubled)[0, 1] > 0.95


def test_a_clean_mesh_has_no_detail() -> None:
    """Nothing to take away: the run is the one that knows the sphere."""
    clean = rough_sphere(2000, noise=0.0)
    result = clean.fair(detail=1.0)
    assert np.abs(clean.heights(result.base, clean.free)).max() < 1e-5 * clean.diameter
    assert np.abs(result.base[clean.outline] - clean.vertices[clean.outline]).max() < 1e-7
