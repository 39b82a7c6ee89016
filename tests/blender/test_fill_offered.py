"""Where Fair Fill is offered, what its redo panel has, and what scripts and commands ask of it and of new meshes."""

from __future__ import annotations

from dataclasses import fields
from types import SimpleNamespace
from typing import Any

import bpy
import meshes
import pytest
from extension import module
from test_new_mesh import dented, fair_new
from test_panel import Layout

from test_fill import border_edges, open_sphere


class Rows(Layout):
    """Remembers which of its rows are greyed out."""

    def __init__(self) -> None:
        super().__init__()
        self.rows: list[Any] = []

    def row(self, **_rest: Any) -> Any:
        row = Layout(self.reported)
        self.rows.append(row)
        return row


def redo_panel(**chosen: Any) -> Rows:
    rows = Rows()
    options = module("core.filling").FillOptions(**chosen)
    values = {field.name: getattr(options, field.name) for field in fields(options)}
    module("run.fill").MESH_OT_fair_fill.draw(SimpleNamespace(layout=rows, **values), bpy.context)
    return rows


def test_the_redo_panel_has_every_option() -> None:
    names = [field.name for field in fields(module("core.filling").FillOptions)]
    assert sorted(redo_panel().reported) == sorted(names)


def test_the_join_is_greyed_out_for_shapes_that_have_none() -> None:
    for equation, active in (
        ("AUTOMATIC", True),
        ("HARMONIC", True),
        ("LEAST_VARIATION", False),
        ("MINIMAL_ENERGY", False),
    ):
        rows = redo_panel(equation=equation)
        states = dict(zip(rows.reported, (row.active for row in rows.rows), strict=True))
        assert states.pop("continuity") == active
        assert all(states.values())


def test_it_is_in_the_menu_face_and_in_the_context_menu_of_edges_and_vertices() -> None:
    ui = module("show.ui")
    assert ui.draw_face_menu in bpy.types.VIEW3D_MT_edit_mesh_faces.draw._draw_funcs
    assert ui.draw_context_menu in bpy.types.VIEW3D_MT_edit_mesh_context_menu.draw._draw_funcs
    face = SimpleNamespace(layout=Layout())
    ui.draw_face_menu(face, bpy.context)
    assert face.layout.reported == ["mesh.fair_region", "mesh.fair_fill"]
    for mode, offered in (("VERT", "mesh.fair_fill"), ("EDGE", "mesh.fair_fill"), ("FACE", "mesh.fair_region")):
        tools = SimpleNamespace(mesh_select_mode=tuple(mode == each for each in ("VERT", "EDGE", "FACE")))
        menu = SimpleNamespace(layout=Layout())
        ui.draw_context_menu(menu, SimpleNamespace(tool_settings=tools))
        assert menu.layout.reported == [offered]


def test_a_new_mesh_under_multiresolution_is_refused() -> None:
    obj, chosen = dented()
    obj.modifiers.new("Levels", "MULTIRES")
    count = len(obj.data.polygons)
    with pytest.raises(RuntimeError, match="Multiresolution modifier can't be kept"):
        fair_new(obj, chosen)
    assert len(obj.data.polygons) == count


def test_a_part_of_an_outline_stands_for_all_of_it_in_scripts_too() -> None:
    obj = open_sphere(lambda c: abs(c.z) > 0.8)
    module().fill_mesh(obj.data, [int(meshes.positions(obj)[:, 2].argmax())])
    assert border_edges(obj) == 40
