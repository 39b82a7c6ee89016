# mypy: disable-error-code="valid-type"
"""Fairing outside edit mode: what is masked or a face set in sculpt mode, a vertex group or the live region else.

No postponed annotations here: Blender reads them as property definitions.
"""

import bpy
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from ..arrays.types import Ints
from ..host.context import active_object
from ..host.picking import face_under_mouse
from ..mesh import painted
from ..options.options import FairOptions
from ..options.redo_panel import draw_options
from ..translations import translated
from ..words.words import said
from .outside import FairsOutside, as_read

_SOURCES = (
    ("MASK", "Mask", "The faces that are masked"),
    ("FACE_SET", "Face Set", "The faces of one face set"),
    ("VERTEX_GROUP", "Vertex Group", "The faces inside a vertex group"),
    ("LIVE", "Live Region", "The faces of the live region"),
)
# What is wrong where a source has no face.
_NOTHING = {
    "MASK": said("nothing_masked"),
    "FACE_SET": said("several_face_sets"),
    "VERTEX_GROUP": said("nothing_in_group"),
    "LIVE": said("no_live_region"),
}


class MESH_OT_fair_masked(FairsOutside, bpy.types.Operator):
    """Replace what is masked, a face set, a vertex group or the live region by the fair surface that continues
    its surroundings"""

    bl_idname = "mesh.fair_masked"
    bl_label = "Fair Masked"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    source: EnumProperty(name="What", description="Which faces are faired", items=_SOURCES, default="MASK")
    face_set: IntProperty(
        name="Face Set",
        description="Number of the face set, as it was clicked; 0: the only visible one",
        default=0,
        min=0,
        options={"HIDDEN", "SKIP_SAVE"},  # or the next run would not ask
    )
    under_mouse: BoolProperty(
        name="Under the Mouse",
        description="Take the face set that the mouse is over, as a tool of the toolbar does",
        default=False,
        options={"HIDDEN", "SKIP_SAVE"},
    )
    group: StringProperty(name="Group", description="Name of the vertex group; empty: the active one")

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.prop(self, "source")
        draw_options(self.layout, self, context.object, context.window_manager)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Take the face set under the mouse where that is asked for; fair in the background where it takes a while."""
        if self.under_mouse:
            with as_read(active_object(context)) as shown:
                face = face_under_mouse(context, event, shown)
                self.face_set = 0 if face is None else painted.face_set_at(shown.data, face)
            if face is None:
                self.report({"INFO"}, translated(said("no_face_there")))
                return {"CANCELLED"}
        return self._begin_with(context, self._start)

    def _check_level(self, level: int, options: FairOptions) -> None:
        FairsOutside._check_level(self, level, options)
        if level and self.source == "MASK":
            raise ValueError(said("no_level_mask"))

    def _faces(self, obj: bpy.types.Object) -> Ints:
        faces = self._named(obj)
        if not len(faces):
            raise ValueError(_nothing(self.source, self.face_set))
        return faces

    def _named(self, obj: bpy.types.Object) -> Ints:
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
    return said("empty_face_set", face_set=face_set) if face_set else _NOTHING[source]
