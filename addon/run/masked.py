# mypy: disable-error-code="valid-type"
"""Fairing outside edit mode: what is masked or a face set in sculpt mode, a vertex group or the live region else.

No postponed annotations here: Blender reads them as property definitions.
"""

import time
from typing import Any

import bpy
import numpy as np
from bpy.props import EnumProperty, IntProperty, StringProperty

from ..core.arrays import Ints
from ..core.engine import REFUSALS
from ..core.options import FairOptions
from ..core.report import make_report, summary
from ..host.context import active_object
from ..host.picking import Picks, face_under_mouse
from ..host.polling import require
from ..mesh import painted
from ..mesh.free_normals import free_normals
from . import compare, last_run
from .fair_mesh import fair_faces
from .labels import reason_of, with_idle
from .option_properties import FairProperties
from .redo_panel import draw_options
from .report_properties import store, store_refusal

_SOURCES = (
    ("MASK", "Mask", "The faces that are masked"),
    ("FACE_SET", "Face Set", "The faces of one face set"),
    ("VERTEX_GROUP", "Vertex Group", "The faces inside a vertex group"),
    ("LIVE", "Live Region", "The faces of the live region"),
)
# What is wrong where a source has no face.
_NOTHING = {
    "MASK": "Nothing is masked by half or more: paint a mask over whole faces",
    "FACE_SET": "Several face sets are in sight: click one with Face Sets, Fair Face Set",
    "VERTEX_GROUP": "No face has all its vertices in the vertex group",
    "LIVE": "There is no live region: make one in edit mode",
}
MODES = ("SCULPT", "OBJECT", "WEIGHT_PAINT")


class MESH_OT_fair_masked(FairProperties, Picks, bpy.types.Operator):
    """Replace what is masked, a face set, a vertex group or the live region by the fair surface that continues
    its surroundings"""

    bl_idname = "mesh.fair_masked"
    bl_label = "Fair Masked"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    source: EnumProperty(name="What", description="What says which faces are faired", items=_SOURCES, default="MASK")
    face_set: IntProperty(
        name="Face Set",
        description="Number of the face set, as it was clicked; 0: the only visible one",
        default=0,
        min=0,
        options={"HIDDEN"},
    )
    group: StringProperty(name="Faces Of", description="Name of the vertex group; empty: the active one")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Needs a mesh outside edit mode."""
        obj = active_object(context)
        return require(cls, obj is not None and obj.type == "MESH", "Make a mesh object active") and require(
            cls, obj.mode in MODES, "In sculpt or object mode; in edit mode use Fair Region"
        )

    def draw(self, context: bpy.types.Context) -> None:
        """Lay the options out as those of Fair Region."""
        self.layout.prop(self, "source")
        draw_options(self.layout, self, context.object, context.window_manager)

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        """Let a face set be clicked, where several are in sight."""
        mesh = active_object(context).data
        if self.source != "FACE_SET" or self.face_set or painted.only_visible_face_set(mesh):
            return self.execute(context)
        return self.pick(context, "Click the face set to fair")

    def _picked(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        obj = active_object(context)
        face = face_under_mouse(context, event, obj)
        if face is None:
            self.report({"INFO"}, "There is no face under the mouse")
            return {"CANCELLED"}
        self.face_set = painted.face_set_at(obj.data, face)
        return self.execute(context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Go to object mode and back, as sculpt mode keeps the mesh for itself."""
        obj = active_object(context)
        mode = obj.mode
        if mode == "SCULPT":
            bpy.ops.ed.undo_push(message="Before Fair Masked")  # strokes are steps of another kind
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        try:
            return self._fair(context, obj)
        except REFUSALS as cause:
            store_refusal(context.window_manager.fairing_report, obj.name, reason_of(cause))
            last_run.forget()
            self.report({"ERROR"}, f"{obj.name}: {reason_of(cause)}")
            return {"CANCELLED"}
        finally:
            if mode != "OBJECT":
                bpy.ops.object.mode_set(mode=mode)

    def _fair(self, context: bpy.types.Context, obj: bpy.types.Object) -> set[str]:
        begin = time.perf_counter()
        _check(obj)
        faces = self._faces(obj)
        if not len(faces):
            raise ValueError(_nothing(self.source, self.face_set))
        self.take_names_before()
        options, before = FairOptions.of(self), painted.positions(obj.data)
        normals = free_normals(obj.data)
        outcome = fair_faces(obj.data, faces.tolist(), np.array(obj.matrix_world, dtype=np.float64), options)
        report = with_idle(make_report([(obj.name, outcome)], options, time.perf_counter() - begin), options)
        store(context.window_manager.fairing_report, report)
        last_run.forget()  # buttons for the next run belong to edit mode
        if not report.written:
            self.report({"ERROR"}, summary(report))
            return {"CANCELLED"}
        compare.remember_one(obj.name, before, outcome, normals)
        self.report({"INFO"}, summary(report))
        return {"FINISHED"}

    def _faces(self, obj: bpy.types.Object) -> Ints:
        if self.source == "MASK":
            return painted.masked_faces(obj.data)
        if self.source == "LIVE":
            return painted.live_faces(obj.data)
        if self.source == "FACE_SET":
            return painted.face_set(obj.data, self.face_set or painted.only_visible_face_set(obj.data))
        active = obj.vertex_groups.active
        return painted.group_faces(obj, self.group or (active.name if active is not None else ""))


def _nothing(source: str, face_set: int) -> str:
    """Say why no face was found."""
    return f"No face is in the face set {face_set}: choose another" if face_set else _NOTHING[source]


def _check(obj: bpy.types.Object) -> None:
    """Raise ValueError where what is seen is not the mesh's own shape."""
    if getattr(obj, "use_dynamic_topology_sculpting", False):
        raise ValueError("Dynamic topology is on: turn it off first")
    if any(modifier.type == "MULTIRES" and modifier.sculpt_levels for modifier in obj.modifiers):
        raise ValueError("The multiresolution levels hide the base mesh: go to level 0, or apply them")
    key: Any = obj.active_shape_key
    if key is not None and key != obj.data.shape_keys.reference_key:
        raise ValueError(f"The shape key {key.name!r} is active: fair it in edit mode, or choose the Basis")
