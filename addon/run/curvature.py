"""The mean curvature as an attribute of the mesh, for shaders, geometry nodes and painting."""

from __future__ import annotations

import bpy
import numpy as np

import fairing

from ..core.findings import Origin
from ..core.options import FairOptions
from ..core.sentences import in_mesh_words
from ..core.words import said
from ..host.context import active_object
from ..host.polling import require
from ..mesh import mesh_io
from ..mesh.attributes import write_attribute
from ..translations import translated

NAME = "mean_curvature"


class MESH_OT_fair_curvature(bpy.types.Operator):
    """Write the mean curvature of the mesh to the vertex attribute "mean_curvature".
    In 1 / length of world space; negative where it bulges out, −1 / radius on a sphere"""

    bl_idname = "mesh.fair_curvature"
    bl_label = "Write Curvature Attribute"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Needs a mesh that can be changed, in object or edit mode."""
        obj = active_object(context)
        return (
            require(cls, obj is not None and obj.type == "MESH", "Make a mesh object active")
            and require(cls, context.mode in ("OBJECT", "EDIT_MESH"), "In object or edit mode")
            and require(cls, mesh_io.is_editable(obj.data), "The mesh is linked from another file: make it local first")
        )

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Measure and write; positions and all other layers stay."""
        obj = active_object(context)
        context.view_layer.update()
        try:
            mesh = mesh_io.read_own_mesh(obj, FairOptions())
            world = mesh.transformed(np.array(obj.matrix_world, dtype=np.float64))
            with in_mesh_words(Origin(np.arange(len(world.positions)), world.triangles, world.triangle_faces)):
                values = fairing.mean_curvature(world.positions, world.triangles)
            write_attribute(obj.data, NAME, values)
        except ValueError as cause:
            self.report({"ERROR"}, translated(said("named", name=obj.name, text=str(cause))))
            return {"CANCELLED"}
        return {"FINISHED"}
