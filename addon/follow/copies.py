"""Fair copies: objects that show another one, modifiers and animation included, with a region of it fair.

The original stays as it is, which a modifier of our own could do as well, but Blender lets nobody write one; nor can
geometry nodes call Python. So the copy's mesh is filled anew at each frame and on demand. What ties it to the original
is a Data Transfer modifier that transfers nothing: with it Blender evaluates the original for renders too, where that
is hidden. Without it, the copy is a mesh like any other.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import asdict

import bpy
import numpy as np

from ..core.engine import REFUSALS
from ..core.options import FairOptions
from ..core.verdict import UNUSABLE
from ..host.context import active_object
from ..host.handlers import listen, unlisten
from ..host.polling import require
from ..mesh import live_mesh, painted
from ..mesh.copied import refill
from ..run.fair_mesh import fair_faces
from ..translations import translated
from .inspection import last_options

TIE = "Fair Source"  # the modifier
OPTIONS = "fair_copy_options"  # custom property of the copy: FairOptions as JSON
GROUP = "fair_copy_group"  # custom property of the copy: the vertex group; empty for the live region


def copies(scene: bpy.types.Scene) -> Iterator[tuple[bpy.types.Object, bpy.types.Object]]:
    """Yield the copies of a scene, each with its original."""
    for obj in scene.objects:
        tie = obj.modifiers.get(TIE) if obj.type == "MESH" else None
        if tie is not None and OPTIONS in obj and tie.object is not None and obj.mode == "OBJECT":
            yield obj, tie.object


def rebuild(copy: bpy.types.Object, source: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> str:
    """Show what the original shows, the region fair; return why it is not, where it isn't."""
    refill(copy.data, source, depsgraph)
    copy.matrix_world = source.matrix_world
    try:
        options = FairOptions.parsed(copy[OPTIONS])
        faces = painted.group_faces(copy, copy[GROUP]) if copy[GROUP] else painted.live_faces(copy.data)
        outcome = fair_faces(copy.data, faces.tolist(), np.array(source.matrix_world, dtype=np.float64), options)
    except (TypeError, *REFUSALS) as cause:  # TypeError: options that can't be read
        return str(cause)
    return outcome.verdict.reason if outcome.verdict.grade == UNUSABLE else ""


def add_copy(context: bpy.types.Context, source: bpy.types.Object, group: str) -> bpy.types.Object:
    """Add an object that shows the source; it is filled by `rebuild`."""
    copy = bpy.data.objects.new(f"{source.name} fair", bpy.data.meshes.new(f"{source.name} fair"))
    context.collection.objects.link(copy)
    for slot in source.material_slots:
        copy.data.materials.append(slot.material)
    for layer in source.vertex_groups:
        copy.vertex_groups.new(name=layer.name)
    copy.modifiers.new(TIE, "DATA_TRANSFER").object = source
    options = last_options(context) if group else live_mesh.region_options(source.data)
    copy[OPTIONS], copy[GROUP] = json.dumps(asdict(options)), group
    return copy


class OBJECT_OT_fair_copy(bpy.types.Operator):
    """Add a copy that shows the object with its live region, or else its active vertex group, fair.
    The object stays as it is; the copy follows its modifiers, shape keys and animation, frame by frame"""

    bl_idname = "object.fair_copy"
    bl_label = "Fair Copy"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Needs a mesh in object mode."""
        obj = active_object(context)
        return require(cls, obj is not None and obj.type == "MESH" and obj.mode == "OBJECT", "Only in object mode")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Make the copy the active object, and hide the original."""
        source = active_object(context)
        active = source.vertex_groups.active
        group = "" if len(painted.live_faces(source.data)) or active is None else active.name
        copy = add_copy(context, source, group)
        reason = rebuild(copy, source, context.evaluated_depsgraph_get())
        if reason:
            bpy.data.meshes.remove(copy.data)
            self.report({"ERROR"}, translated(f"{source.name}: {reason}"))
            return {"CANCELLED"}
        source.select_set(False)
        source.hide_render = True
        source.hide_set(True)
        copy.select_set(True)
        context.view_layer.objects.active = copy
        return {"FINISHED"}


class OBJECT_OT_fair_copies_update(bpy.types.Operator):
    """Have all fair copies of the scene follow their originals now; changes of the frame do that by themselves"""

    bl_idname = "object.fair_copies_update"
    bl_label = "Update Fair Copies"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """There must be one."""
        return require(cls, any(True for _ in copies(context.scene)), "There is no fair copy")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Rebuild all; a copy without a usable surface shows its original."""
        for copy, source in copies(context.scene):
            reason = rebuild(copy, source, context.evaluated_depsgraph_get())
            if reason:
                self.report({"WARNING"}, translated(f"{copy.name}: {reason}"))
        return {"FINISHED"}


def _on_frame(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    for copy, source in copies(scene):
        rebuild(copy, source, depsgraph)


def register() -> None:
    """Follow the frame."""
    listen(bpy.app.handlers.frame_change_post, _on_frame)


def unregister() -> None:
    """Follow no more; copies stay as they are."""
    unlisten(bpy.app.handlers.frame_change_post, _on_frame)
