"""`detail`: the skin of the old patch put back on the fair surface."""

from typing import Any

import numpy as np
import pytest

import fairing
import shapes
from curves import FloatArray
from shapes import Patch
from solving import codes

Rotation = FloatArray


def mean_edge(patch: Patch) -> float:
    corners = patch.vertices[patch.triangles]
    return float(np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).mean())


def rough(patch: Patch, edges: float = 0.25, seed: int = 0) -> FloatArray:
    """Free vertices moved along the normals by noise of this standard deviation."""
    heights = np.random.default_rng(seed).normal(size=len(patch.vertices)) * edges * mean_edge(patch)
    heights[patch.fixed] = 0
    return patch.vertices + heights[:, None] * patch.normals


def fair(patch: Patch, old: FloatArray, **options: Any) -> fairing.FairResult:
    return fairing.fair(old, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals, **options)


def heights(patch: Patch, vertices: FloatArray, over: FloatArray) -> FloatArray:
    """Along the normals, of free vertices over another surface."""
    return np.asarray(((vertices - over) * patch.normals).sum(axis=1)[patch.free])


def some_rotation() -> Rotation:
    q, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    return np.asarray(q * np.sign(np.linalg.det(q)))


@pytest.fixture(scope="module")
def cap() -> Patch:
    return shapes.cap(1500, half_angle=60.0)


def test_a_rough_swelling_turns_into_a_rough_sphere(cap: Patch) -> None:
    """The swelling goes, the noise stays: its amplitude within 15 %, and the same noise vertex by vertex."""
    noisy = rough(cap)
    above = np.clip(cap.vertices[:, 2] - cap.vertices[cap.fixed, 2].max(), 0, None) ** 2
    swollen = noisy * (1 + 0.4 * above)[:, None]
    result = fair(cap, swollen, detail=1.0)
    assert result.converged
    assert cap.distance(result.base).max() < 1e-5 * cap.diameter
    kept = heights(cap, result.vertices, result.base)
    wanted = heights(cap, noisy, cap.vertices)
    assert kept.std() == pytest.approx(wanted.std(), rel=0.15)
    assert np.corrcoef(kept, wanted)[0, 1] > 0.9


def test_a_crease_along_the_outline_is_no_detail() -> None:
    """A sphere's cap lies flat before: what stays of it is the fair sphere."""
    whole = shapes.cap(800, half_angle=60.0)
    flat = whole.vertices.copy()
    flat[:, 2] = whole.vertices[whole.fixed, 2].mean()
    result = fair(whole, flat, detail=1.0)
    assert whole.distance(result.vertices).max() < 1e-3 * whole.diameter


def test_a_solver_keeps_the_skin_while_the_outline_moves(cap: Patch) -> None:
    old = rough(cap)
    turn = some_rotation()
    solver = fairing.Solver(cap.triangles, fixed=cap.fixed, detail=1.0, tolerance=1e-9)
    first = solver.solve(old, cap.fixed_normals, reference=old)
    assert np.array_equal(first.vertices, fair(cap, old, detail=1.0, tolerance=1e-9).vertices)
    moved = solver.solve(old @ turn.T, cap.fixed_normals @ turn.T, reference=old)
    assert moved.vertices == pytest.approx(first.vertices @ turn.T, abs=1e-6)
    solver.change(detail=0.0)
    without = solver.solve(old, cap.fixed_normals, reference=old)
    assert np.array_equal(without.base, without.vertices)


def test_a_collapsed_patch_has_no_detail(cap: Patch) -> None:
    old = cap.vertices.copy()
    old[cap.free] = 0
    result = fair(cap, old, detail=1.0)
    assert ("REFERENCE_UNUSABLE", {"old_skin": 1.0}) in [
        (reported.code, reported.figures) for reported in result.warnings
    ]
    assert np.array_equal(result.base, result.vertices)
    assert result.converged


def test_detail_without_room_is_reported() -> None:
    """Deep folds of a wide skin, on a base of half its size."""
    patch = shapes.plane(2000)
    old = rough(patch, 0.9)
    shrunk = 0.3 * patch.vertices
    result = fairing.fair(
        shrunk, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals, reference=old, detail=1.0
    )
    assert "FLIPPED_TRIANGLES" in codes(result)
    same = fairing.fair(
        patch.vertices, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals, reference=old, detail=1.0
    )
    assert "FLIPPED_TRIANGLES" not in codes(same)
