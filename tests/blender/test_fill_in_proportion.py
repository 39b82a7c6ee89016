"""Which borders Fair Fill takes for holes, and what it refuses before it is made."""

from __future__ import annotations

from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes

SIZE = 12


def sheet(degrees: float, holes: tuple[tuple[int, int], ...] = ((5, 5),)) -> bpy.types.Object:
    """A square bent along one direction, with holes of four faces that begin at these."""
    whole = np.radians(degrees)
    turns = (np.arange(SIZE + 1) / SIZE - 0.5) * whole
    points = [(np.sin(t) / whole, k / SIZE, np.cos(t) / whole) for t in turns for k in range(SIZE + 1)]
    gone = {(i + a, j + b) for i, j in holes for a in (0, 1) for b in (0, 1)}
    faces = [
        [a, a + SIZE + 1, a + SIZE + 2, a + 1]
        for i in range(SIZE)
        for j in range(SIZE)
        if (i, j) not in gone
        for a in (i * (SIZE + 1) + j,)
    ]
    return meshes.add(points, faces, "Sheet")


def select_all(obj: bpy.types.Object) -> None:
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    meshes.edit(obj)
    bpy.ops.mesh.select_all(action="SELECT")


def select_loop(obj: bpy.types.Object, at: int) -> None:
    """One border vertex alone, which stands for its loop."""
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    meshes.enter(obj, np.zeros(len(obj.data.polygons), dtype=bool))
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    bm.verts[at].select = True
    bmesh.update_edit_mesh(obj.data)


def open_edges(obj: bpy.types.Object) -> int:
    bpy.ops.object.mode_set(mode="OBJECT")
    with meshes.rebuilt(obj, write=False) as bm:
        return sum(edge.is_boundary for edge in bm.edges)


def fill(**properties: Any) -> set[str]:
    status: set[str] = bpy.ops.mesh.fair_fill("EXEC_DEFAULT", True, **properties)
    return status


def warnings() -> list[str]:
    reported: list[str] = bpy.context.window_manager.fairing_report.warnings.splitlines()
    return reported


@pytest.mark.parametrize("degrees", [10.0, 180.0])
def test_with_everything_selected_holes_are_filled_and_the_outer_border_is_named(degrees: float) -> None:
    obj = sheet(degrees, ((2, 2), (8, 7)))
    select_all(obj)
    assert fill() == {"FINISHED"}
    (reported,) = warnings()
    assert reported.startswith("1 border runs around the outside of a sheet of faces and stays open (48 edges")
    assert open_edges(obj) == 4 * SIZE
