"""Where Fair Fill is offered, what its redo panel has, and what scripts and commands ask of it and of new meshes."""

from dataclasses import asdict
from types import SimpleNamespace
from typing import Any

import bpy
import pytest

import meshes
from extension import module
from test_fill import border_edges, open_sphere
from test_panel import Layout


def redo_panel(**chosen: Any) -> list[str]:
    """Return the options that are in sight."""
    layout = Layout()
    of = module("options.other_options").FillOptions
    shown = SimpleNamespace(layout=layout, chosen=of, **{**asdict(of()), **chosen})
    module("fill.operator").MESH_OT_fair_fill.draw(shown, bpy.context)
    return layout.reported


def test_the_shape_is_hidden_where_positions_alone_are_met() -> None:
    assert "shape" in redo_panel()
    assert "shape" not in redo_panel(continuity="G0")


def test_a_bridge_has_no_islands_nor_hard_edges_to_ask_for() -> None:
    assert {"islands", "run_on"} <= {*redo_panel()}
    assert not {"islands", "run_on"} & {*redo_panel(bridge=True)}


def offered(draw: str, context: Any = None) -> list[str]:
    """Return what an entry adds to its menu."""
    menu = SimpleNamespace(layout=Layout())
    getattr(module("show.menus"), draw)(menu, bpy.context if context is None else context)
    reported: list[str] = menu.layout.reported
    return reported


def test_it_is_in_the_menus_where_one_looks_for_it() -> None:
    menus = module("show.menus")
    for name, draw in menus.ENTRIES:
        assert draw in getattr(bpy.types, name).draw._draw_funcs, name
    assert offered("draw_face_menu") == ["mesh.fair_region", "mesh.fair_fill"]
    assert offered("draw_edge_menu") == ["Fair Bridge", "mesh.fair_fill", "mesh.fair_from_curves", "mesh.fair_fillet"]
    assert offered("draw_vertex_menu") == ["mesh.fair_fill"]
    assert offered("draw_clean_up_menu") == ["Fair Fill Holes", "mesh.fair_denoise"]
    for mode, what in (
        ("VERT", ["mesh.fair_fill"]),
        ("EDGE", ["mesh.fair_fill", "mesh.fair_fillet"]),
        ("FACE", ["mesh.fair_region"]),
    ):
        tools = SimpleNamespace(mesh_select_mode=tuple(mode == each for each in ("VERT", "EDGE", "FACE")))
        assert offered("draw_context_menu", SimpleNamespace(tool_settings=tools)) == what


def test_object_mode_offers_it_for_meshes_only() -> None:
    assert offered("draw_object_menu", SimpleNamespace(active_object=None)) == []
    meshes.grid()
    assert offered("draw_object_menu") == ["Fair Vertex Group", "Fair Face Set"]


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "OBJECT"])
def test_every_entry_of_the_pie_exists(mode: str) -> None:
    """Eight at most, as a pie has; each an operator that is registered."""
    meshes.grid()
    bpy.ops.object.mode_set(mode=mode)
    layout = Layout()
    layout.menu_pie = lambda: layout  # type: ignore[attr-defined]
    bpy.types.VIEW3D_MT_fair_pie.draw(SimpleNamespace(layout=layout), bpy.context)
    assert 2 <= len(layout.reported) <= 8
    assert len(set(layout.reported)) == len(layout.reported)
    bpy.ops.object.mode_set(mode="OBJECT")


def test_a_part_of_an_outline_stands_for_all_of_it_in_scripts_too() -> None:
    obj = open_sphere(lambda c: abs(c.z) > 0.8)
    module().fill_mesh(obj.data, [int(meshes.positions(obj)[:, 2].argmax())])
    assert border_edges(obj) == 40
