"""The operator that gives new faces colours on the image around."""

from __future__ import annotations

import bpy
import numpy as np

import fairing

from ..core.texturing import Textured, TextureOptions, textured
from ..host.context import edited_objects
from ..host.polling import SELECT_FACES, require_edit_mode, require_idle
from ..mesh import textured as textured_mesh
from ..mesh.textured import Read
from ..translations import translated
from .labels import reason_of
from .option_properties import TextureProperties
from .redo_panel import draw_options

NO_NEW_FACE = "No face is selected: select the faces that are to get the colours around, as Fair Fill leaves them"


class MESH_OT_fair_texture(TextureProperties, bpy.types.Operator):
    """Continue the texture around the selected faces over them, on a copy of the image that is packed into the file"""

    bl_idname = "mesh.fair_texture"
    bl_label = "Fair Texture"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Edit mode has a selection; while a run is under way, the mesh is its own."""
        return require_edit_mode(cls, context, SELECT_FACES) and require_idle(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        """Lay the options out."""
        draw_options(self.layout, self, context.object, context.window_manager)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Find all colours first; write only where there are some for all objects."""
        context.view_layer.update()
        options = TextureOptions.of(self)
        found: list[tuple[bpy.types.Object, Read, Textured]] = []
        for obj in edited_objects(context):
            try:
                before = textured_mesh.read(obj, options)
                if before is not None:
                    found.append((obj, before, textured(before.mesh, before.pictures, options.detail)))
            except (ValueError, MemoryError, fairing.SolverError) as cause:
                self.report({"ERROR"}, translated(f"{obj.name}: {reason_of(cause)}"))
                return {"CANCELLED"}
        if not found:
            self.report({"INFO"}, translated(NO_NEW_FACE))
            return {"CANCELLED"}
        for obj, before, after in found:
            self._write(obj, before, after)
        return {"FINISHED"}

    def _write(self, obj: bpy.types.Object, before: Read, after: Textured) -> None:
        copies = textured_mesh.write(obj, before, after)
        left, moved = (len(np.unique(before.faces[rows])) for rows in (after.left, after.moved))
        if left:
            text = f"{left} faces were left: no textured ones are near"
            self.report({"WARNING"}, translated(text))
        if moved:
            text = f"{moved} faces have new places on the image"
            self.report({"INFO"}, translated(text))
        for copy in copies:
            self.report({"INFO"}, translated(f"New colours on the copy {copy.name!r}, which is packed into the file"))
