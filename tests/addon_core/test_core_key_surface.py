"""Shape keys over a new surface: one of their own where they bend its outline, otherwise what was carried over."""

import numpy as np
from addon.arrays.types import Floats
from addon.remesh.key_surface import NewSurface, Surroundings, key_surfaces

import fairing
import holes

RIM = 32


def filled(half_angle: float = 60.0) -> tuple[NewSurface, Surroundings, Floats]:
    """A cap over a hole in the unit sphere; what is around it, its rim first, and its new vertices."""
    vertices, triangles = holes.bowl(RIM, half_angle)
    result = fairing.fill(vertices, triangles, [np.arange(RIM)])
    number = np.arange(len(vertices) + len(result.vertices))
    number[len(vertices) :] += RIM - len(vertices)
    surface = NewSurface(np.concatenate([vertices[:RIM], result.vertices]), number[result.triangles], result.equation)
    return surface, Surroundings(np.arange(len(vertices)), triangles, np.eye(4)), vertices


def larger(surface: NewSurface, factor: float = 1.5) -> Floats:
    """Where offsets that are carried over lead for a key of another size: too flat."""
    flat = factor * surface.points[RIM:]
    flat[:, 2] -= 0.04 * factor * (1 - np.hypot(flat[:, 0], flat[:, 1]) / factor)
    return flat


def test_a_larger_ball_comes_back_from_offsets_that_are_too_flat() -> None:
    surface, around, places = filled()
    carried = larger(surface)
    (found,) = key_surfaces(surface, around, [1.5 * places], [carried])
    assert found is not None
    assert np.abs(np.linalg.norm(carried, axis=1) - 1.5).max() > 0.02
    assert np.abs(np.linalg.norm(found, axis=1) - 1.5).max() < 2e-4


def test_keys_that_move_the_outline_as_a_whole_keep_their_offsets() -> None:
    surface, around, places = filled()
    shift = np.array([0.1, 0.2, 0.3])
    still, aside = surface.points[RIM:], surface.points[RIM:] + shift
    assert key_surfaces(surface, around, [places, places + shift], [still, aside]) == [None, None]


def test_a_key_without_a_surface_keeps_its_offsets() -> None:
    surface, around, places = filled()
    broken = 1.5 * places
    broken[3] = np.nan
    point = np.zeros_like(places)
    carried = larger(surface)
    assert key_surfaces(surface, around, [broken, point], [carried, carried]) == [None, None]
    loft = NewSurface(surface.points, surface.triangles, "loft")
    assert key_surfaces(loft, around, [1.5 * places], [carried]) == [None]


def test_a_surface_through_itself_is_not_taken() -> None:
    """The rim as a figure eight: whatever comes out, it is no better than what was carried over."""
    surface, around, places = filled()
    turn = np.arctan2(places[:, 1], places[:, 0])
    eight = np.column_stack([np.sin(turn), np.sin(2 * turn), 0.1 * places[:, 2]]) * np.hypot(*places[:, :2].T)[:, None]
    assert key_surfaces(surface, around, [eight], [larger(surface)]) == [None]
