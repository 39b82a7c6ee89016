"""Where Fair Fill is offered, what its redo panel has, and what scripts and commands ask of it and of new meshes."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import bpy
import meshes
import pytest
from extension import module
from test_new_mesh import dented, fair_new
from test_panel import Layout

from test_fill import border_edges, open_sphere


def redo_panel(**chosen: Any) -> list[str]:
    """Return the options that are in sight."""
    layout = Layout()
    values = {**module("core.option_table").defaults(fill_table()), **chosen}
    shown = SimpleNamespace(layout=layout, table=fill_table(), preset_menu="", **values)
    module("run.fill").MESH_OT_fair_fill.draw(shown, bpy.context)
    return layout.reported


def fill_table() -> Any:
    return module("core.fill_options").FILL


def test_the_shape_is_hidden_where_positions_alone_are_met() -> None:
    assert "shape" in redo_panel()
    assert "shape" not in redo_panel(continuity="G0")


def test_a_bridge_has_no_islands_nor_hard_edges_to_ask_for() -> None:
    assert {"islands", "run_on"} <= {*redo_panel()}
    assert not {"islands", "run_on"} & {*redo_panel(bridge=True)}


def test_it_is_in_the_menu_face_and_in_the_context_menu_of_edges_and_vertices() -> None:
    ui = module("show.menus")
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
