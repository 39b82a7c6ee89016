"""Entries in Blender's own menus."""

from __future__ import annotations

from typing import Any

import bpy

from ..run.fill import MESH_OT_fair_fill
from ..run.fillet import MESH_OT_fair_fillet
from ..run.masked import MESH_OT_fair_masked
from ..run.operators import MESH_OT_fair_region


def draw_face_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add the operators to the menu Face."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_region.bl_idname)
    menu.layout.operator(MESH_OT_fair_fill.bl_idname)


def draw_edge_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add Fair Fillet to the menu Edge, to be drawn by the mouse."""
    menu.layout.separator()
    menu.layout.operator_context = "INVOKE_DEFAULT"
    menu.layout.operator(MESH_OT_fair_fillet.bl_idname)


def draw_context_menu(menu: Any, context: bpy.types.Context) -> None:
    """Add to the context menu, which vertices, edges and faces share, what fits the selection."""
    faces = context.tool_settings.mesh_select_mode[2]
    menu.layout.separator()
    menu.layout.operator((MESH_OT_fair_region if faces else MESH_OT_fair_fill).bl_idname)


def draw_mask_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add Fair Masked to the menu Mask of sculpt mode."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_masked.bl_idname).source = "MASK"


def draw_face_set_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add the same for a face set to the menu Face Sets."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_masked.bl_idname, text="Fair Face Set").source = "FACE_SET"


ENTRIES = (
    ("VIEW3D_MT_edit_mesh_faces", draw_face_menu),
    ("VIEW3D_MT_edit_mesh_edges", draw_edge_menu),
    ("VIEW3D_MT_edit_mesh_context_menu", draw_context_menu),
    ("VIEW3D_MT_mask", draw_mask_menu),
    ("VIEW3D_MT_face_sets", draw_face_set_menu),
)


def register() -> None:
    """Add them."""
    for menu, draw in ENTRIES:
        getattr(bpy.types, menu).append(draw)


def unregister() -> None:
    """Take them back."""
    for menu, draw in reversed(ENTRIES):
        getattr(bpy.types, menu).remove(draw)
