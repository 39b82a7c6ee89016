"""Entries in Blender's own menus."""

from __future__ import annotations

from typing import Any

import bpy

from ..curves.operator import MESH_OT_fair_from_curves
from ..denoise.operator import MESH_OT_fair_denoise
from ..fair.masked import MESH_OT_fair_masked
from ..fair.operator import MESH_OT_fair_region
from ..fill.operator import MESH_OT_fair_fill
from ..fillet.operator import MESH_OT_fair_fillet
from ..live.start import MESH_OT_fair_live_region
from ..run.compare import MESH_OT_fair_compare


def draw_face_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add to the menu Face, which has Grid Fill."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_region.bl_idname)
    menu.layout.operator(MESH_OT_fair_fill.bl_idname)


def draw_edge_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add to the menu Edge, which has Bridge Edge Loops; the fillet is drawn by the mouse."""
    menu.layout.separator()
    menu.layout.operator_context = "INVOKE_DEFAULT"
    menu.layout.operator(MESH_OT_fair_fill.bl_idname, text="Fair Bridge").bridge = True
    menu.layout.operator(MESH_OT_fair_fill.bl_idname)
    menu.layout.operator(MESH_OT_fair_from_curves.bl_idname)
    menu.layout.operator(MESH_OT_fair_fillet.bl_idname)


def draw_vertex_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add to the menu Vertex: a vertex of a hole names it."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_fill.bl_idname)


def draw_clean_up_menu(menu: Any, _context: bpy.types.Context) -> None:
    """Add to Mesh, Clean Up, which has Fill Holes; roughness of a scan is cleaned up, too."""
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_fill.bl_idname, text="Fair Fill Holes")
    menu.layout.operator(MESH_OT_fair_denoise.bl_idname)


def draw_context_menu(menu: Any, context: bpy.types.Context) -> None:
    """Add to the context menu, which vertices, edges and faces share, what fits the selection."""
    _, edges, faces = context.tool_settings.mesh_select_mode
    menu.layout.separator()
    menu.layout.operator((MESH_OT_fair_region if faces else MESH_OT_fair_fill).bl_idname)
    if edges:
        menu.layout.operator_context = "INVOKE_DEFAULT"
        menu.layout.operator(MESH_OT_fair_fillet.bl_idname)


def draw_object_menu(menu: Any, context: bpy.types.Context) -> None:
    if context.active_object is not None and context.active_object.type == "MESH":
        menu.layout.separator()
        menu.layout.operator(MESH_OT_fair_masked.bl_idname, text="Fair Vertex Group").source = "VERTEX_GROUP"
        menu.layout.operator(MESH_OT_fair_masked.bl_idname, text="Fair Face Set").source = "FACE_SET"


def draw_mask_menu(menu: Any, _context: bpy.types.Context) -> None:
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_masked.bl_idname).source = "MASK"


def draw_face_set_menu(menu: Any, _context: bpy.types.Context) -> None:
    menu.layout.separator()
    menu.layout.operator(MESH_OT_fair_masked.bl_idname, text="Fair Face Set").source = "FACE_SET"


class VIEW3D_MT_fair_pie(bpy.types.Menu):
    """All of Intrinsic Fairing that fits the mode, to be bound to a key"""

    bl_label = "Fair"

    def draw(self, context: bpy.types.Context) -> None:
        pie = self.layout.menu_pie()
        if context.mode == "EDIT_MESH":
            pie.operator(MESH_OT_fair_region.bl_idname, icon="MOD_SMOOTH")
            pie.operator(MESH_OT_fair_fill.bl_idname, icon="MESH_ICOSPHERE")
            pie.operator(MESH_OT_fair_fill.bl_idname, text="Fair Bridge", icon="MOD_SKIN").bridge = True
            pie.operator(MESH_OT_fair_fillet.bl_idname, icon="MOD_BEVEL")
            pie.operator(MESH_OT_fair_live_region.bl_idname, icon="PLAY")
            pie.operator(MESH_OT_fair_compare.bl_idname, icon="ARROW_LEFTRIGHT")
            return
        sources = {"FACE_SET": "Fair Face Set", "MASK": "Fair Masked"}
        if context.mode != "SCULPT":
            sources = {"FACE_SET": "Fair Face Set", "VERTEX_GROUP": "Fair Vertex Group", "LIVE": "Fair Live Region"}
        for source, text in sources.items():
            pie.operator(MESH_OT_fair_masked.bl_idname, text=text, icon="MOD_SMOOTH").source = source


MENUS = (VIEW3D_MT_fair_pie,)
ENTRIES = (
    ("VIEW3D_MT_edit_mesh_faces", draw_face_menu),
    ("VIEW3D_MT_edit_mesh_edges", draw_edge_menu),
    ("VIEW3D_MT_edit_mesh_vertices", draw_vertex_menu),
    ("VIEW3D_MT_edit_mesh_clean", draw_clean_up_menu),
    ("VIEW3D_MT_edit_mesh_context_menu", draw_context_menu),
    ("VIEW3D_MT_object", draw_object_menu),
    ("VIEW3D_MT_mask", draw_mask_menu),
    ("VIEW3D_MT_face_sets", draw_face_set_menu),
)


# Entries of the keymap without a key, which Preferences, Keymap binds. Recommended: Alt Shift F.
_MODES = (("Mesh", "EMPTY"), ("Sculpt", "EMPTY"), ("Object Mode", "EMPTY"))
_entries: list[tuple[Any, Any]] = []


def register() -> None:
    for menu, draw in ENTRIES:
        getattr(bpy.types, menu).append(draw)
    configuration = bpy.context.window_manager.keyconfigs.addon
    for mode, space in _MODES if configuration is not None else ():  # Blender has no keymaps in the background
        keymap = configuration.keymaps.new(name=mode, space_type=space)
        entry = keymap.keymap_items.new("wm.call_menu_pie", "NONE", "PRESS")
        entry.properties.name = VIEW3D_MT_fair_pie.__name__
        _entries.append((keymap, entry))


def unregister() -> None:
    while _entries:
        keymap, entry = _entries.pop()
        keymap.keymap_items.remove(entry)
    for menu, draw in reversed(ENTRIES):
        getattr(bpy.types, menu).remove(draw)
