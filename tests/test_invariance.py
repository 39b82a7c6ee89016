"""The result moves with the input and depends on nothing but the outline, normals and mesh."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import pytest

import fairing
import shapes
from curves import FloatArray

PATCH = shapes.linear_flux(500)
START = shapes.start_from_nothing(PATCH)
D = PATCH.diameter


def fair(vertices: FloatArray = START, normals: FloatArray = PATCH.fixed_normals, **changed: Any) -> fairing.FairResult:
    mesh = {"triangles": PATCH.triangles, "fixed": PATCH.fixed, **changed}
    return fairing.fair(vertices, fixed_normals=normals, tolerance=1e-12, **mesh)


@pytest.fixture(scope="module")
def control() -> fairing.FairResult:
    return fair()


def test_rigid_motion(control: fairing.FairResult) -> None:
    turn = np.linalg.qr(np.random.default_rng(5).standard_normal((3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    shift = np.array([3.0, -2.0, 5.0])
    moved = fair(START @ turn.T + shift, PATCH.fixed_normals @ turn.T)
    assert np.abs(moved.vertices - control.vertices @ turn.T - shift).max() < 1e-9 * D
    assert np.abs(moved.mean_curvature - control.mean_curvature).max() < 1e-6


@pytest.mark.parametrize("flip", [np.array([1.0, 1.0, -1.0]), np.ones(3)])
def test_reversed_winding(control: fairing.FairResult, flip: FloatArray) -> None:
    """A mirror keeps H when normals are mirrored along; normals turned round alone change its sign."""
    sign = -flip.prod()
    result = fair(START * flip, sign * PATCH.fixed_normals * flip, triangles=PATCH.triangles[:, ::-1])
    assert np.abs(result.vertices - control.vertices * flip).max() < 1e-9 * D
    assert np.abs(result.mean_curvature - sign * control.mean_curvature).max() < 1e-6


@pytest.mark.parametrize("scale", [1e-9, 1e-3, 1e9])
def test_scale(control: fairing.FairResult, scale: float) -> None:
    result = fair(scale * START)
    assert np.abs(result.vertices / scale - control.vertices).max() < 1e-9 * D
    assert np.abs(result.mean_curvature * scale - control.mean_curvature).max() < 1e-6


def test_renumbered_vertices_and_shuffled_triangles(control: fairing.FairResult) -> None:
    rng = np.random.default_rng(6)
    order = rng.permutation(len(START))
    place = np.argsort(order)
    triangles = place[PATCH.triangles][rng.permutation(len(PATCH.triangles))]
    triangles = np.stack([np.roll(t, rng.integers(3)) for t in triangles])
    result = fair(START[order], triangles=triangles, fixed=place[PATCH.fixed])
    assert np.abs(result.vertices - control.vertices[order]).max() < 1e-8 * D


@pytest.mark.parametrize("kind", ["exact", "point", "noise"])
def test_interior_does_not_matter(control: fairing.FairResult, kind: Literal["exact", "point", "noise"]) -> None:
    start = PATCH.vertices.copy()
    if kind == "point":
        start = shapes.start_from_nothing(PATCH, "point")
    if kind == "noise":
        noise = np.random.default_rng(7).standard_normal((len(PATCH.free), 3))
        start[PATCH.free] += 0.2 * noise
    assert np.abs(fair(start).vertices - control.vertices).max() < 1e-8 * D


def test_length_of_the_normals_does_not_matter(control: fairing.FairResult) -> None:
    lengths = np.random.default_rng(8).uniform(0.1, 10, (len(PATCH.fixed), 1))
    result = fair(normals=lengths * PATCH.fixed_normals)
    assert np.abs(result.vertices - control.vertices).max() < 1e-9 * D
