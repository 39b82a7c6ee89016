# mypy: disable-error-code="valid-type"
"""Fairing outside edit mode: what is masked or a face set in sculpt mode, a vertex group or the live region else.

No postponed annotations here: Blender reads them as property definitions.
"""

import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from typing import Any

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from ..core.arrays import Floats, Ints
from ..core.engine import REFUSALS, Progress
from ..core.options import FairOptions
from ..core.outcome import Fairing
from ..core.region import MeshArrays, free_vertices
from ..core.report import make_report, summary
from ..host.context import active_object
from ..host.picking import Picks, face_under_mouse
from ..host.polling import require, require_idle
from ..mesh import painted
from ..mesh.free_normals import free_normals
from ..preferences import background_from
from ..translations import translated
from . import compare, last_run
from .background import Watched, at_once
from .fair_arrays import fair_arrays
from .fair_mesh import read, write
from .job import Refused
from .labels import with_idle
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


@dataclass(frozen=True)
class Task:
    """The object's mesh, as it was read."""

    object_name: str
    mesh: MeshArrays
    matrix: Floats  # (4, 4) to world space
    options: FairOptions
    before: Floats  # (n, 3) positions


def solve(task: Task, progress: Progress) -> Fairing:
    """Solve on arrays alone; raises Refused and fairing.Cancelled."""
    try:
        return fair_arrays(task.mesh, task.matrix, task.options, progress)
    except REFUSALS as cause:
        raise Refused(task.object_name, cause) from cause


@contextmanager
def _in_object_mode(obj: bpy.types.Object) -> Iterator[None]:
    """Go to object mode and back: sculpt mode keeps the mesh for itself."""
    mode = obj.mode
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode=mode)


class MESH_OT_fair_masked(FairProperties, Picks, Watched, bpy.types.Operator):
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
        options={"HIDDEN", "SKIP_SAVE"},  # or the next run would not ask
    )
    under_mouse: BoolProperty(
        name="Under the Mouse",
        description="Take the face set that the mouse is over, as a tool of the toolbar does",
        default=False,
        options={"HIDDEN", "SKIP_SAVE"},
    )
    group: StringProperty(name="Faces Of", description="Name of the vertex group; empty: the active one")

    _task: Task
    _begin: float

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Needs a mesh outside edit mode."""
        obj = active_object(context)
        return (
            require(cls, obj is not None and obj.type == "MESH", "Make a mesh object active")
            and require(cls, obj.mode in MODES, "In sculpt or object mode; in edit mode use Fair Region")
            and require_idle(cls, context)
        )

    def draw(self, context: bpy.types.Context) -> None:
        """Lay the options out as those of Fair Region."""
        self.layout.prop(self, "source")
        draw_options(self.layout, self, context.object, context.window_manager)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Let a face set be clicked, where several are in sight; fair in the background where that takes a while."""
        if self.under_mouse:
            return self._picked(context, event)
        mesh = active_object(context).data
        if self.source != "FACE_SET" or self.face_set or painted.only_visible_face_set(mesh):
            return self._begin_with(context, self._solve_or_start)
        return self.pick(context, "Click the face set to fair")

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Wait for the click, then for the result."""
        return Picks.modal(self, context, event) if self._run is None else Watched.modal(self, context, event)

    def _picked(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        obj = active_object(context)
        face = face_under_mouse(context, event, obj)
        if face is None:
            self.report({"INFO"}, "There is no face under the mouse")
            return {"CANCELLED"}
        self.face_set = painted.face_set_at(obj.data, face)
        return self._begin_with(context, self._solve_or_start)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Fair at once, and return when done."""
        return self._begin_with(context, self._solve_at_once)

    def _read(self, context: bpy.types.Context) -> bool:
        self._begin = time.perf_counter()
        obj = active_object(context)
        if obj.mode == "SCULPT":
            bpy.ops.ed.undo_push(message="Before Fair Masked")  # strokes are steps of another kind
        self.take_names_before()
        try:
            options = FairOptions.of(self)
            with _in_object_mode(obj):
                self._task = self._read_object(obj, options)
        except REFUSALS as cause:
            raise Refused(obj.name, cause) from cause
        return True

    def _read_object(self, obj: bpy.types.Object, options: FairOptions) -> Task:
        _check(obj)
        faces = self._faces(obj)
        if not len(faces):
            raise ValueError(_nothing(self.source, self.face_set))
        mesh, matrix = read(obj.data, faces.tolist(), np.array(obj.matrix_world, dtype=np.float64), options)
        return Task(obj.name, mesh, matrix, options, painted.positions(obj.data))

    def _solve_at_once(self, context: bpy.types.Context) -> set[str]:
        return self._apply(context, at_once(context, partial(solve, self._task)))

    def _solve_or_start(self, context: bpy.types.Context) -> set[str]:
        large = int(np.count_nonzero(free_vertices(self._task.mesh))) >= background_from(context)
        return self._start(context, partial(solve, self._task), large)

    def _is_current(self, context: bpy.types.Context) -> bool:
        obj = active_object(context)
        if obj is None or obj.name != self._task.object_name or obj.mode not in MODES:
            return False
        with _in_object_mode(obj):
            return np.array_equal(painted.positions(obj.data), self._task.before)

    def _apply(self, context: bpy.types.Context, outcome: Fairing) -> set[str]:
        task, obj = self._task, active_object(context)
        report = make_report([(task.object_name, outcome)], task.options, time.perf_counter() - self._begin)
        report = with_idle(report, task.options)
        store(context.window_manager.fairing_report, report)
        last_run.forget()  # buttons for the next run belong to edit mode
        if not report.written:
            self.report({"ERROR"}, translated(summary(report)))
            return {"CANCELLED"}
        with _in_object_mode(obj):
            normals = free_normals(obj.data)
            write(obj.data, outcome)
        compare.remember_one(obj.name, task.before, outcome, normals)
        self.report({"INFO"}, translated(summary(report)))
        return {"FINISHED"}

    def _refuse(self, context: bpy.types.Context, refusal: Refused) -> set[str]:
        store_refusal(context.window_manager.fairing_report, refusal.object_name, refusal.reason)
        last_run.forget()
        self.report({"ERROR"}, translated(str(refusal)))
        return {"CANCELLED"}

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
