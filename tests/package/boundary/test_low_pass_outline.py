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
