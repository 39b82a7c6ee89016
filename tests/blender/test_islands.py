"""Several pieces in one selection, each with an outline of its own."""

from __future__ import annotations

from typing import Any

import bpy
import meshes
import numpy as np
import pytest
from extension import inspect
from test_bulge import LIFT, disc


def joined(objects: list[bpy.types.Object]) -> bpy.types.Object:
    for obj in bpy.context.view_layer.objects:
        obj.select_set(obj in objects)
    bpy.context.view_layer.objects.active = objects[0]
    bpy.ops.object.join()
    return bpy.context.view_layer.objects.active


def test_each_island_bulges_by_its_own_size() -> None:
    first, inside = disc(1.0)
    second, _ = disc(3.0)
    second.location.x = 10.0
    bpy.context.view_layer.update()
    both = joined([first, second])
    assert meshes.fair(both, np.concatenate([inside, inside]), equation="CONSTANT", bulge=1.0) == {"FINISHED"}
    assert meshes.report().converged
    points = meshes.positions(both)
    for middle, size in ((0.0, 1.0), (10.0, 3.0)):
        around = np.linalg.norm(points[:, :2] - (middle, 0.0), axis=1) < 1.5 * size
        assert points[around, 2].max() / size == pytest.approx(LIFT, abs=0.025)  # as in test_bulge


def ring_of(obj: bpy.types.Object, half: float) -> Any:
    """The closed loop of grid vertices on the square of that half width."""
    points = meshes.positions(obj)
    return np.isclose(np.abs(points[:, :2]).max(axis=1), half, atol=1e-6)


@pytest.mark.parametrize("equation", ["HARMONIC", "CONSTANT"])
def test_pinned_loop_divides_the_selection(equation: str) -> None:
    obj = meshes.grid(16)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.8)
    loop = ring_of(obj, 0.375)
    points = meshes.positions(obj)
    points[loop, 2] = 0.25
    meshes.move(obj, points)
    obj.vertex_groups.new(name="Pin").add(np.flatnonzero(loop).tolist(), 1.0, "REPLACE")
    meshes.fair(obj, faces, pin_group="Pin", equation=equation, bulge=0.2 if equation == "CONSTANT" else 0.0)
    result = meshes.positions(obj)
    assert result[loop].tobytes() == points[loop].tobytes()
    inspection = inspect(obj, faces, pin_group="Pin")
    assert (inspection.islands, inspection.loops) == (2, 1)
