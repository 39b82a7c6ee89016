"""The surface that every run begins with: always there, finite, between its boundary, near the one that follows."""

import numpy as np
import pytest

import fairing
import shapes
import tubes
from shapes import Style


def shown_and_found(vertices, triangles, **options):  # type: ignore[no-untyped-def]
    """The first surface and the result; it is shown once, before the result is there."""
    shown: list[np.ndarray] = []
    result = fairing.fair(vertices, triangles, preview=shown.append, **options)
    assert len(shown) == 1
    return shown[0], result


@pytest.mark.parametrize("make", [shapes.cap, shapes.cylinder, shapes.catenoid])
@pytest.mark.parametrize("size", [300, 3000])
def test_the_first_surface_is_near_the_fair_one(make, size: int) -> None:  # type: ignore[no-untyped-def]
    """Half a sphere, a pipe and a catenoid: 2 % of D off at most, where linear fills are 5 to 25 % off."""
    patch = make(size, style=Style(seed=5))
    start = shapes.membrane(patch.vertices, patch.triangles, patch.fixed)
    before = start.copy()
    first, result = shown_and_found(start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals)
    outline = start[patch.fixed]
    diameter = 2 * np.linalg.norm(outline - outline.mean(axis=0), axis=1).max()
    assert np.abs(patch.surface.distance(first)).max() < 0.02 * diameter
    assert np.array_equal(first[patch.fixed], start[patch.fixed])
    assert np.array_equal(start, before)
    without = fairing.fair(start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals)
    assert np.array_equal(result.vertices, without.vertices)  # to look changes nothing


def test_a_limb_is_not_drawn_to_a_thread() -> None:
    """A rough pipe of eight radii: the fill between its ends has a waist, the old shape low-passed has not."""
    pipe = tubes.pipe(8.0)
    rng = np.random.default_rng(4)
    inside = np.setdiff1d(np.arange(len(pipe.vertices)), pipe.fixed)
    rough = pipe.vertices.copy()
    rough[inside] += rng.normal(scale=0.02, size=(len(inside), 3))
    first, _ = shown_and_found(rough, pipe.triangles, fixed=pipe.fixed, fixed_normals=pipe.normals, otherwise="stop")
    girth = fairing.looks.girth(first, pipe.triangles, fixed=pipe.fixed)
    assert girth is not None
    assert girth.least > fairing.looks.LIMITS["waist"]


def test_what_the_receiver_raises_comes_out() -> None:
    """And ends the run: a caller that wants the first surface alone needs no search."""

    class Enough(Exception):
        pass

    def receive(vertices: np.ndarray) -> None:
        raise Enough

    patch = shapes.cap(400, style=Style(seed=5))
    with pytest.raises(Enough):
        fairing.fair(patch.vertices, patch.triangles, fixed=patch.fixed, preview=receive)
