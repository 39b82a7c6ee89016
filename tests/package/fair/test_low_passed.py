"""Large patches whose outline is too jagged to be met: the surface follows the smoothed outline."""

from dataclasses import replace

import numpy as np
import pytest

import fairing
import measures
import shapes

ROWS = 3  # of free vertices that follow the outline


def rough_cap(edges: float, radians: float, seed: int, free: int = 2500) -> shapes.Patch:
    """A half sphere whose outline is moved by so many edges at random and whose normals turn."""
    cap = shapes.cap(free)
    rng = np.random.default_rng(seed)
    vertices, count = cap.vertices.copy(), len(cap.fixed)
    edge = 2 * np.pi / count
    vertices[cap.fixed] += edges * edge * rng.normal(size=(count, 3)) / np.sqrt(3)
    normals = cap.normals.copy()
    normals[cap.fixed] += radians * rng.normal(size=(count, 3)) / np.sqrt(3)
    return replace(cap, vertices=vertices, normals=normals / np.linalg.norm(normals, axis=1)[:, None])


def faired(cap: shapes.Patch) -> fairing.FairResult:
    return fairing.fair(cap.vertices, cap.triangles, fixed=cap.fixed, fixed_normals=cap.fixed_normals, threads=1)


def rows_from_outline(cap: shapes.Patch) -> np.ndarray:
    """Edges to the next fixed vertex, at most ROWS + 1."""
    return np.asarray(sum(measures.beyond_rings(cap.triangles, cap.fixed, k).astype(int) for k in range(ROWS + 1)))


@pytest.mark.parametrize(
    ("edges", "radians", "seed", "free"),
    [(0.25, 0.3, 0, 2500), (0.25, 0.3, 0, 8000), (0.25, 0.3, 1, 3000), (0.4, 0.5, 0, 8000)],
)
def test_a_rough_outline_that_can_be_met_is(edges: float, radians: float, seed: int, free: int) -> None:
    """Coarse levels have the outline without its noise; the surface is found on the mesh itself."""
    result = faired(rough_cap(edges, radians, seed, free=free))
    assert result.converged
    assert result.polished
    assert result.provenance == "equation"


@pytest.mark.parametrize("seed", [0, 2, 3, 4, 5, 8])  # of 1, 6 and 7 the last digits decide
def test_noise_that_no_surface_meets_is_passed_by(seed: int) -> None:
    cap = rough_cap(0.8, 1.0, seed)
    result = faired(cap)
    assert result.converged
    assert not result.polished
    assert result.provenance == "low_passed"
    assert (result.vertices[cap.fixed] == cap.vertices[cap.fixed]).all()
    (warning,) = (reported for reported in result.warnings if reported.code == "NO_SOLUTION")
    assert result.equation == "harmonic"
    edge = 2 * np.pi / len(cap.fixed)
    assert 0.25 * edge < warning.figures["distance"] < 1.5 * edge  # in diameters
    inside = result.vertices[rows_from_outline(cap) > ROWS]
    assert np.abs(np.linalg.norm(inside, axis=1) - 1).max() < 0.2  # normals are off by a radian
    flipped = fairing.looks.flipped_triangles(result.vertices, cap.triangles, fixed=cap.fixed)
    assert (rows_from_outline(cap)[cap.triangles[flipped]].min(axis=1) == 0).all()
    assert len(flipped) <= 3  # folds that the outline itself forces


def test_what_folds_beside_a_rough_outline_is_put_right() -> None:
    """Few of 2,500 triangles with a free corner are turned over or pass through others."""
    left = 0
    for seed in range(6):
        cap = rough_cap(1.0, 0.6, seed)
        result = faired(cap)
        assert result.converged
        flipped = fairing.looks.flipped_triangles(result.vertices, cap.triangles, fixed=cap.fixed)
        left += len(flipped) + len(fairing.self_intersections(result.vertices, cap.triangles))
    assert left <= 10
