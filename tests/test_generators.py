"""The further generators keep their promises: checked without the engine."""

from __future__ import annotations

import numpy as np

import graded
import measures
import shapes

BASES = {"hemisphere": shapes.cap(60), "cylinder": shapes.cylinder(60, length=3.0), "catenoid": shapes.catenoid(60)}


def test_distance_to_a_mesh_of_all_sizes() -> None:
    """By octaves the same as by trying every triangle."""
    patch = graded.regraded(BASES["hemisphere"], 300)
    points = np.random.default_rng(3).standard_normal((200, 3))
    fast = measures.distance_to_mesh(points, patch.vertices, patch.triangles)
    slow = [
        min(measures.distance_to_mesh(point[None], patch.vertices, triangle[None])[0] for triangle in patch.triangles)
        for point in points[:20]
    ]
    assert np.abs(fast[:20] - slow).max() < 1e-14
