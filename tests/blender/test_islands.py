"""Several pieces in one selection, each with an outline of its own."""

from __future__ import annotations

from typing import Any

import bpy
import meshes
import numpy as np
import pytest
from extension import inspect


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
