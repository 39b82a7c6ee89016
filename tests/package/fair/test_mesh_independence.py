"""Figs. 1 and 2: different meshes of the same three-cylinder blend give the same surface."""

from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest

import blend
import measures
from connectivity import shuffled
from solving import fair_blend


@lru_cache(maxsize=8)
def faired(jitter: float, seed: int, n_free: int, flips: float = 0.0) -> tuple[blend.Blend, np.ndarray, bool]:
    """`flips`: share of the edges that are tried for a flip, whatever it makes of the shape."""
    patch = blend.cylinder_blend(n_free, jitter=jitter, seed=seed)
    patch = replace(patch, triangles=shuffled(patch.triangles, patch.fixed, flips, seed))
    result = fair_blend(patch)
    return patch, result.vertices, result.converged


PAIRS = [
    pytest.param((0.0, 0, 4000), (0.0, 1, 3700), id="regular"),
    pytest.param((0.6, 2, 4000), (0.6, 3, 3700), id="mildly irregular"),
    pytest.param((0.0, 0, 4000), (0.6, 2, 4000), id="regular and irregular"),
    pytest.param((0.0, 0, 4000), (0.6, 2, 4000, 0.25), id="regular and shuffled"),
]


@pytest.mark.parametrize(("one", "other"), PAIRS)
def test_two_meshes_of_the_blend_agree(one: tuple[float, ...], other: tuple[float, ...]) -> None:
    """0.3 % of D is the goal. The best linear fairing differs by 15 %; membranes by 1 %."""
    first, first_vertices, first_converged = faired(*one)
    second, second_vertices, second_converged = faired(*other)
    assert first_converged
    assert second_converged
    distance = measures.two_sided_distance((first_vertices, first.triangles), (second_vertices, second.triangles))
    assert distance <= 0.003 * first.diameter
