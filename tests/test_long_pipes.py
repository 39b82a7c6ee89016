"""Straight pipes beyond 2π radii, where several harmonic surfaces fit: the straight one, on large meshes too.

The coarse levels of such meshes may have none, or another one.
"""

from __future__ import annotations

import pytest

import fairing
import graded
import shapes
from shapes import Patch, Style


def solved(pipe: Patch) -> fairing.FairResult:
    """From its outlines, one way and no other equation. On some processors 12 radii, near 4π, stall below 1e-9."""
    return fairing.fair(
        shapes.start_from_nothing(pipe), pipe.triangles, fixed=pipe.fixed, fixed_normals=pipe.fixed_normals,
        reference=pipe.vertices, tolerance=1e-8, otherwise="stop",
    )  # fmt: skip


def even(length: float) -> Patch:
    """250 vertices for each radius of length."""
    return shapes.cylinder(int(250 * length), Style(jitter=0.0), length=length)


def test_a_large_pipe_of_eight_radii_is_straight_on_its_own_levels() -> None:
    """Its coarse levels have a surface, since tangential steps are Newton's."""
    pipe = even(8.0)
    result = solved(pipe)
    assert result.converged
    assert pipe.error(result.vertices) < 1e-4


@pytest.mark.parametrize("length", [10.0, 12.0])
def test_large_pipes_are_straight_where_a_coarse_level_has_no_surface(length: float) -> None:
    """The straight surface to 1e-4 D, though longer pipes have others."""
    pipe = even(length)
    result = solved(pipe)
    assert result.converged
    assert result.equation == "harmonic"
    assert pipe.error(result.vertices) < 1e-4


@pytest.mark.parametrize("length", [8.0, 9.0])
def test_large_graded_pipes_are_straight(length: float) -> None:
    """Edges of 40 : 1, 24 around the coarser rim; bulbs of .06 and .09 D fit the same outlines."""
    pipe = graded.regraded(even(length), int(500 * length))
    result = solved(pipe)
    assert result.converged
    assert result.equation == "harmonic"
    assert pipe.error(result.vertices) < 2e-3
    assert not len(fairing.flipped_triangles(result.vertices, pipe.triangles))


@pytest.mark.parametrize("size", [4257, 4264])
def test_graded_pipes_of_eight_and_a_half_radii_keep_to_the_straight_surface(size: int) -> None:
    """Bulbs of .08 D fit the same outlines."""
    pipe = graded.regraded(even(8.5), size)
    result = solved(pipe)
    assert result.converged
    assert pipe.error(result.vertices) < 2e-3
