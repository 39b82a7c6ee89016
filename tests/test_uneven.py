"""Uneven meshes of surfaces with several sheets: every vertex on its own sheet, nothing folded, one surface."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import blend
import fairing
import measures
import six_arms
import tetrathing
import uneven
from blend import Blend
from curves import FloatArray
from graded import Grading, regraded
from meshing import IntArray
from shapes import cylinder
from solving import codes

MAKE = {"cylinders": uneven.cylinder_blend, "tetrathing": uneven.tetrathing_corner, "arms": uneven.arms}


def solved(made: Blend, **options: object) -> fairing.FairResult:
    return fairing.fair(made.vertices, made.triangles, fixed=made.fixed, fixed_normals=made.fixed_normals, **options)


@cache
def surface(kind: str) -> tuple[FloatArray, IntArray]:
    """The same surface on a fine and even mesh."""
    even = {
        "cylinders": lambda: blend.cylinder_blend(9000, jitter=0.0),
        "tetrathing": lambda: uneven.bridged(9000, uneven.tetrathing_rims(), evenly=True),
        "arms": lambda: six_arms.six_arms(12000, jitter=0.0),
    }[kind]()
    result = solved(even)
    assert result.converged
    assert result.polished
    return result.vertices, even.triangles


def apart(made: Blend, vertices: FloatArray, kind: str) -> float:
    """Largest distance over D, either way: a double cover of one sheet is far from the other."""
    fine, triangles = surface(kind)
    free = np.setdiff1d(np.arange(len(vertices)), made.fixed)
    there = measures.distance_to_mesh(vertices[free], fine, triangles).max()
    back = measures.distance_to_mesh(fine[:: len(fine) // 1500], vertices, made.triangles).max()
    return float(max(there, back) / made.diameter)


@pytest.mark.parametrize(
    ("kind", "size", "seed", "limit"),
    [
        *((kind, 1000, seed, 0.02) for kind in MAKE for seed in range(5)),
        *(("tetrathing", 4000, seed, 0.007) for seed in range(3)),
    ],
)
def test_every_vertex_keeps_its_sheet(kind: str, size: int, seed: int, limit: float) -> None:
    """Within shares of D, of which chords of the coarse bridge are .5 %; a double cover would be 30 % off."""
    made = MAKE[kind](size, seed=seed)
    result = solved(made)
    assert result.converged
    assert not {"FLIPPED_TRIANGLES", "SELF_INTERSECTION"} & codes(result)
    assert apart(made, result.vertices, kind) < limit


def test_the_start_does_not_matter() -> None:
    made = uneven.tetrathing_corner(1000, seed=1)
    result = solved(made)
    inside = made.vertices.copy()
    free = np.setdiff1d(np.arange(len(inside)), made.fixed)
    inside[free] = np.random.default_rng(4).normal(size=(len(free), 3))
    again = fairing.fair(inside, made.triangles, fixed=made.fixed, fixed_normals=made.fixed_normals)
    assert np.array_equal(again.vertices, result.vertices)


@pytest.mark.parametrize("seed", range(3))
def test_pipes_graded_around(seed: int) -> None:
    """Edges four times as long on one side: the cylinder."""
    pipe = cylinder(1500, length=3.0)
    made = regraded(pipe, 1500, Grading(ratio=4.0, spot=(0.5, 0.25), seed=seed))
    result = fairing.fair(made.vertices, made.triangles, fixed=made.fixed, fixed_normals=made.fixed_normals)
    assert result.converged
    assert not codes(result)
    assert made.error(result.vertices) < 5e-4


def test_a_corner_of_the_tetrathing_is_found_in_any_order_of_its_vertices() -> None:
    """Of this order the coarse levels of one corner fold, and so do vertices placed on a mesh of the engine's own."""
    rng = np.random.default_rng(65)
    made = tetrathing.tetrathing(float(rng.uniform(0.25, 0.45)), 4)
    order = rng.permutation(len(made.vertices))
    number = np.argsort(order)
    triangles = number[made.triangles]
    triangles, fixed = triangles[rng.permutation(len(triangles))], number[made.fixed]
    vertices = made.vertices[order]
    free = np.setdiff1d(number, fixed)
    vertices[free] += 0.01 * rng.normal(size=(len(free), 3))
    result = fairing.fair(vertices, triangles, fixed=fixed, fixed_normals=made.fixed_normals)
    assert result.converged
    assert result.provenance == "equation"
    assert not result.warnings
