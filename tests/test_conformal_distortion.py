"""`fairing.conformal_distortion`: ratio of the singular values of the map, per triangle."""

from __future__ import annotations

import numpy as np

import fairing
import shapes
from solving import fair_patch


def test_similar_triangles_have_one() -> None:
    patch = shapes.cap(200)
    turn = np.linalg.qr(np.random.default_rng(0).standard_normal((3, 3)))[0]
    moved = 3.0 * patch.vertices @ turn + [1.0, 2.0, 3.0]
    result = fairing.conformal_distortion(patch.vertices, moved, patch.triangles)
    assert result.shape == (len(patch.triangles),)
    assert np.abs(result - 1).max() < 1e-7


def test_stretching_gives_its_factor() -> None:
    """The square root in the singular values loses digits at 1, not at 2."""
    patch = shapes.plane(200)
    stretched = patch.vertices * np.array([1.0, 1.0, 2.0])
    for one, other in ((patch.vertices, stretched), (stretched, patch.vertices)):
        result = fairing.conformal_distortion(one, other, patch.triangles)
        assert np.abs(result - 2).max() < 1e-9


def test_conformal_weights_keep_the_angles_of_the_reference() -> None:
    """From the exact mesh of the hemisphere to its own fair surface, against uniform weights."""
    patch = shapes.cap(500)
    median = {}
    for kind in ("conformal", "uniform"):
        result = fair_patch(patch, inner_fairness=kind, reference=patch.vertices)
        distortion = fairing.conformal_distortion(patch.vertices, result.vertices, patch.triangles)
        median[kind] = float(np.median(distortion)) - 1
    assert median["conformal"] < 0.03
    assert median["conformal"] < 0.2 * median["uniform"]
