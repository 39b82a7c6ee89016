"""What Blender has for each job, as scripts of a user would call it."""

from collections.abc import Callable
from typing import Any

import bmesh
import bpy
import numpy as np

Chosen = Callable[[Any], bool]
MODES = {"verts": (True, False, False), "edges": (False, True, False), "faces": (False, False, True)}


def select(kind: str, chosen: Chosen) -> None:
    """Enter edit mode with exactly these "verts", "edges" or "faces" selected; chosen: of an element of bmesh."""
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = MODES[kind]
    bpy.ops.mesh.select_all(action="DESELECT")
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    for element in [each for each in getattr(bm, kind) if chosen(each)]:
        element.select_set(True)
    bm.select_flush_mode()
    bmesh.update_edit_mesh(bpy.context.object.data)


def inner_vertices() -> None:
    """Of the selected faces keep only vertices all of whose faces are selected: what fairing may move."""
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    inside = {v for v in bm.verts if v.select and not v.is_boundary and all(face.select for face in v.link_faces)}
    select("verts", lambda v: v in inside)


def smooth_vertices(times: int) -> Callable[[], None]:
    """Smooth Vertices. Of 5 to 500 times, 100 are the best for limb and panel."""

    def run() -> None:
        inner_vertices()
        bpy.ops.mesh.vertices_smooth(factor=0.5, repeat=times)

    return run


def laplacian_smooth() -> None:
    """Smooth Laplacian, which keeps the volume. Of 72 settings the best for limb and panel."""
    inner_vertices()
    bpy.ops.mesh.vertices_smooth_laplacian(repeat=10, lambda_factor=0.5)


def fair_tangency() -> None:
    """Sculpt mode's Edit Face Set, Fair Tangency."""
    mesh = bpy.context.object.data
    bpy.ops.object.mode_set(mode="OBJECT")
    chosen = np.empty(len(mesh.polygons), dtype=bool)
    mesh.polygons.foreach_get("select", chosen)
    sets = mesh.attributes.new(".sculpt_face_set", "INT", "FACE")
    sets.data.foreach_set("value", np.where(chosen, 2, 1).astype(np.int32))
    bpy.ops.object.mode_set(mode="SCULPT")
    bpy.ops.ed.undo_push(
        message="Sculpt"
    )  # without a step to add to, the operator ends Blender when there is no window
    area = next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(area=area, region=region):
        bpy.ops.sculpt.face_set_edit(mode="FAIR_TANGENCY", active_face_set=2)


def fair_region(**options: Any) -> Callable[[], None]:
    """This extension's Fair Region."""

    def run() -> None:
        bpy.ops.mesh.fair_region("EXEC_DEFAULT", **options)

    return run


def fill() -> None:
    """F: one face over the loop."""
    bpy.ops.mesh.edge_face_add()


def grid_fill() -> None:
    """Grid Fill, or F where it refuses."""
    try:
        bpy.ops.mesh.fill_grid()
    except RuntimeError:
        fill()


def fair_fill() -> None:
    """This extension's Fair Fill."""
    bpy.ops.mesh.fair_fill("EXEC_DEFAULT")


def bridge_edge_loops() -> None:
    """Bridge Edge Loops, blended as smoothly as it can."""
    bpy.ops.mesh.bridge_edge_loops(number_cuts=24, interpolation="SURFACE", smoothness=1.0)


def fair_bridge() -> None:
    """This extension's Fair Fill between the loops."""
    bpy.ops.mesh.fair_fill("EXEC_DEFAULT", bridge=True)


def bevel(width: float) -> Callable[[], None]:
    """Bevel of the selected edges."""

    def run() -> None:
        bpy.ops.mesh.bevel(offset=width, offset_type="OFFSET", segments=8, profile=0.5)

    return run


def fair_fillet(width: float, **options: Any) -> Callable[[], None]:
    """This extension's Fair Fillet of the selected edges."""

    def run() -> None:
        bpy.ops.mesh.fair_fillet("EXEC_DEFAULT", width=width, **options)

    return run


def join(body: bpy.types.Object, boss: bpy.types.Object) -> None:
    """Add the boss to the body by a boolean, and remove it."""
    bpy.context.view_layer.objects.active = body
    joined = body.modifiers.new("Joined", "BOOLEAN")
    joined.operation, joined.object, joined.solver = "UNION", boss, "EXACT"
    bpy.ops.object.modifier_apply(modifier="Joined")
    bpy.data.objects.remove(boss)
