"""Straight pipes beyond 2π radii, where several harmonic surfaces fit: the straight one, on large meshes too.

The coarse levels of such meshes may have none, or another one.
"""

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


@pytest.mark.parametrize(
    ("length", "size", "limit"),
    [
        *((length, None, 1e-4) for length in (8.0, 10.0, 12.0)),
        *((length, int(500 * length), 2e-3) for length in (8.0, 9.0)),
        *((8.5, size, 2e-3) for size in (4257, 4264)),
    ],
)
def test_long_pipes_are_straight(length: float, size: int | None, limit: float) -> None:
    """With a size: edges of 40 : 1, 24 around the coarser rim; bulbs of .06 to .09 D fit the same outlines."""
    pipe = even(length) if size is None else graded.regraded(even(length), size)
    result = solved(pipe)
    assert result.converged
    assert result.equation == "harmonic"
    assert pipe.error(result.vertices) < limit
    assert not len(fairing.looks.flipped_triangles(result.vertices, pipe.triangles))
