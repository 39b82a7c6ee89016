"""Tools of the toolbar: draw around faces and let go, drag on an edge, click a face set.

In edit mode each is a macro: Blender's own selection, then ours. One step of undo takes both back.
"""

from __future__ import annotations

from typing import Any

import bpy
from gpu_extras.presets import draw_circle_2d

from ..fair.brush import MESH_OT_fair_brush
from ..fair.masked import MESH_OT_fair_masked

# Of Fair Region, in the header of a tool.
_IN_HEADER = ("factor", "shape", "continuity", "detail", "falloff", "remesh")


class MESH_OT_fair_lasso(bpy.types.Macro):
    """Draw around the faces to be faired and let go"""

    bl_idname = "mesh.fair_lasso"
    bl_label = "Fair Lasso"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for
    steps = ("VIEW3D_OT_select_lasso", "MESH_OT_fair_region")


class MESH_OT_fair_fillet_edge(bpy.types.Macro):
    """Press on an edge and drag: its loop is rounded as far as the mouse goes"""

    bl_idname = "mesh.fair_fillet_edge"
    bl_label = "Fair Fillet Edge"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for
    steps = ("MESH_OT_loop_select", "MESH_OT_fair_fillet")


MACROS = (MESH_OT_fair_lasso, MESH_OT_fair_fillet_edge)


class _Tool:
    bl_space_type = "VIEW_3D"
    bl_widget = None


class FairLassoTool(_Tool, bpy.types.WorkSpaceTool):
    bl_context_mode = "EDIT_MESH"
    bl_idname = "intrinsic_fairing.lasso"
    bl_label = "Fair Lasso"
    bl_description = "Draw around the faces to be faired and let go"
    bl_icon = "ops.generic.select_lasso"
    bl_keymap = ((MESH_OT_fair_lasso.bl_idname, {"type": "LEFTMOUSE", "value": "CLICK_DRAG"}, None),)

    def draw_settings(_context: bpy.types.Context, layout: Any, tool: Any) -> None:
        properties = tool.operator_properties(MESH_OT_fair_lasso.bl_idname).MESH_OT_fair_region
        for name in _IN_HEADER:
            layout.prop(properties, name)


class FairFilletTool(_Tool, bpy.types.WorkSpaceTool):
    bl_context_mode = "EDIT_MESH"
    bl_idname = "intrinsic_fairing.fillet"
    bl_label = "Fair Fillet"
    bl_description = "Press on an edge and drag: its loop is rounded as far as the mouse goes"
    bl_icon = "ops.mesh.bevel"
    bl_keymap = (
        (
            MESH_OT_fair_fillet_edge.bl_idname,
            {"type": "LEFTMOUSE", "value": "PRESS"},
            {"properties": [("MESH_OT_fair_fillet", [("confirm_on_release", True)])]},
        ),
    )

    def draw_settings(_context: bpy.types.Context, layout: Any, tool: Any) -> None:
        properties = tool.operator_properties(MESH_OT_fair_fillet_edge.bl_idname).MESH_OT_fair_fillet
        for name in ("profile", "continuity", "spacing"):
            layout.prop(properties, name)


class FairBrushTool(_Tool, bpy.types.WorkSpaceTool):
    bl_context_mode = "SCULPT"
    bl_idname = "intrinsic_fairing.brush"
    bl_label = "Fair Brush"
    bl_description = "Paint over what is to become fair and let go. Masked vertices stay"
    bl_icon = "ops.sculpt.mesh_filter"
    bl_keymap = ((MESH_OT_fair_brush.bl_idname, {"type": "LEFTMOUSE", "value": "PRESS"}, None),)

    def draw_settings(_context: bpy.types.Context, layout: Any, tool: Any) -> None:
        properties = tool.operator_properties(MESH_OT_fair_brush.bl_idname)
        for name in ("radius", *_IN_HEADER[:-1]):
            layout.prop(properties, name)

    def draw_cursor(_context: bpy.types.Context, tool: Any, xy: tuple[int, int]) -> None:
        radius = tool.operator_properties(MESH_OT_fair_brush.bl_idname).radius
        draw_circle_2d(xy, (1.0, 1.0, 1.0, 0.8), radius, segments=32)


class _FaceSetTool(_Tool):
    bl_description = "Click a face set: it becomes the fair surface that continues its surroundings"
    bl_label = "Fair Face Set"
    bl_icon = "ops.sculpt.face_set_edit"
    bl_cursor = "EYEDROPPER"
    bl_keymap = (
        (
            MESH_OT_fair_masked.bl_idname,
            {"type": "LEFTMOUSE", "value": "PRESS"},
            {"properties": [("source", "FACE_SET"), ("under_mouse", True)]},
        ),
    )

    def draw_settings(_context: bpy.types.Context, layout: Any, tool: Any) -> None:
        properties = tool.operator_properties(MESH_OT_fair_masked.bl_idname)
        for name in _IN_HEADER:
            layout.prop(properties, name)


class FairFaceSetSculptTool(_FaceSetTool, bpy.types.WorkSpaceTool):
    bl_context_mode = "SCULPT"
    bl_idname = "intrinsic_fairing.face_set"


class FairFaceSetObjectTool(_FaceSetTool, bpy.types.WorkSpaceTool):
    bl_context_mode = "OBJECT"
    bl_idname = "intrinsic_fairing.face_set"


TOOLS: tuple[Any, ...] = (
    FairLassoTool,
    FairFilletTool,
    FairBrushTool,
    FairFaceSetSculptTool,
    FairFaceSetObjectTool,
)


def register() -> None:
    for macro in MACROS:
        for step in macro.steps:
            macro.define(step)
    for tool in TOOLS:
        bpy.utils.register_tool(tool, separator=tool in (FairLassoTool, FairBrushTool, FairFaceSetObjectTool))


def unregister() -> None:
    for tool in reversed(TOOLS):
        bpy.utils.unregister_tool(tool)
