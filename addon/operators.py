"""The operator: properties, poll, reports. What it does is in solve.py."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np

import fairing

from . import mesh_io
from .options import FairOptions
from .properties import FairProperties
from .region import free_vertices
from .solve import Fairing, Progress, fair_arrays

Done = list[tuple[bpy.types.Object, Fairing]]


class Refused(Exception):
    """One object can't be faired; nothing has been written yet."""

    def __init__(self, obj: bpy.types.Object, cause: Exception) -> None:
        super().__init__(f"{obj.name}: {cause}")
        self.object = obj
        self.cause = cause


class MESH_OT_fair_region(FairProperties, bpy.types.Operator):
    """Replace the selected faces by the fair surface that continues their surroundings"""

    bl_idname = "mesh.fair_region"
    bl_label = "Fair Region"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        """Edit mode of a mesh is all it takes; an empty selection is answered by a report."""
        if context.mode != "EDIT_MESH":
            cls.poll_message_set("Select faces of a mesh in edit mode")
            return False
        return True

    def draw(self, context: bpy.types.Context) -> None:
        """Lay the options out: shape, inside, outline, solver."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "factor")
        layout.prop(self, "equation")
        row = layout.row()
        row.active = self.equation == "CONSTANT"
        row.prop(self, "bulge")
        layout.prop(self, "inner_fairness")
        layout.separator()
        layout.prop(self, "boundary_normals")
        layout.prop_search(self, "pin_group", context.object, "vertex_groups")
        layout.prop(self, "pin_edges")
        layout.separator()
        for name in ("method", "levels", "tolerance", "max_iterations"):
            layout.prop(self, name)

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Fair every object in edit mode, or none of them where one is refused."""
        context.view_layer.update()  # a script may just have changed an object's matrix
        start = time.perf_counter()
        try:
            with _progress(context.window_manager) as progress:
                done = fair_selections(context, FairOptions.of(self), progress)
        except Refused as refusal:
            return self._refuse(context, refusal)
        except fairing.Cancelled:
            return {"CANCELLED"}
        if not done:
            self.report({"INFO"}, "No vertex inside the selection is free to move")
            return {"CANCELLED"}
        for obj, outcome in done:
            mesh_io.write_edit_mesh(obj.data, outcome.vertices, outcome.positions)
        self._tell(context, done, time.perf_counter() - start)
        return {"FINISHED"}

    def _refuse(self, context: bpy.types.Context, refusal: Refused) -> set[str]:
        elements = np.asarray(getattr(refusal.cause, "elements", ()), dtype=np.int64)
        if elements.size:
            context.tool_settings.mesh_select_mode = (True, False, False)
            mesh_io.select_vertices(refusal.object.data, elements)
        self.report({"ERROR"}, str(refusal))
        return {"CANCELLED"}

    def _tell(self, context: bpy.types.Context, done: Done, seconds: float) -> None:
        report = context.window_manager.fairing_report
        fill_report(report, done, seconds)
        for warning in report.warnings.splitlines():
            self.report({"WARNING"}, warning)
        self.report({"INFO"}, summary(report))


def fair_selections(context: bpy.types.Context, options: FairOptions, progress: Progress) -> Done:
    """Solve for every object in edit mode that has free vertices; nothing is written.

    Raises Refused for the first object that can't be faired, and fairing.Cancelled.
    """
    done = []
    for obj in context.objects_in_mode_unique_data:
        try:
            outcome = _fair_selection(obj, options, progress)
        except (ValueError, fairing.SolverError) as cause:
            raise Refused(obj, cause) from cause
        if outcome is not None:
            done.append((obj, outcome))
    return done


def _fair_selection(obj: bpy.types.Object, options: FairOptions, progress: Progress) -> Fairing | None:
    key = obj.active_shape_key
    if key is not None and key.lock_shape:
        raise ValueError(f"The active shape key {key.name!r} is locked")
    arrays = mesh_io.read_edit_mesh(obj, options)
    if not free_vertices(arrays).any():
        return None
    return fair_arrays(arrays, np.array(obj.matrix_world, dtype=np.float64), options, progress)


@contextmanager
def _progress(manager: bpy.types.WindowManager) -> Iterator[Callable[[float, str], None]]:
    """Show the engine's progress at the mouse pointer."""
    manager.progress_begin(0.0, 1.0)
    try:
        yield lambda fraction, _stage: manager.progress_update(fraction)
    finally:
        manager.progress_end()


def fill_report(report: Any, done: Done, seconds: float) -> None:
    """Write the worst of several outcomes into a FairReport; `seconds` as the user waited."""
    results = [outcome.result for _, outcome in done]
    report.objects = ", ".join(obj.name for obj, _ in done)
    report.free_vertices = sum(len(outcome.vertices) for _, outcome in done)
    report.seconds = seconds
    report.residual = max(result.residual for result in results)
    report.boundary_angle = max(result.boundary_angle.max(initial=0.0) for result in results)
    report.converged = all(result.converged for result in results)
    report.warnings = "\n".join(_warnings(done))


def _warnings(done: Done) -> list[str]:
    texts = []
    for obj, outcome in done:
        prefix = f"{obj.name}: " if len(done) > 1 else ""
        texts += [prefix + text for text in outcome.warnings]
        if obj.data.use_mirror_x:
            texts.append(prefix + "X mirror is on: only the selected side was faired")
    return texts


def summary(report: Any) -> str:
    """Return the one line that the status bar shows."""
    state = "Faired" if report.converged else "Not converged:"
    return (
        f"{state} {report.free_vertices} vertices in {report.seconds:.2f} s, "
        f"largest angle at the outline {report.boundary_angle:.2g}°"
    )
