"""Arrows that pull the last run: the middle of the region up or down, a fillet wider or narrower.

Each belongs to tools of the toolbar and shows while their run is the last operator. Pulling changes its option and
runs it again, as its redo panel does, so that all of it is one step of undo.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from ..arrays.types import Floats
from ..fair.operator import MESH_OT_fair_region
from ..fillet import operator as fillet
from ..fillet.operator import MESH_OT_fair_fillet
from ..host.context import in_view
from ..host.handlers import call_later
from ..options.options import FairOptions
from ..options.table import named
from ..run import last_run, runner
from .tools import FairFilletTool, FairLassoTool, FairPaintTool

LIFT = 0.25  # of the radius of a flat disc that a bulge of 1 lifts it by
COLOUR, LIT = (0.95, 0.62, 0.25), (1.0, 0.85, 0.6)


def options_of(operator: Any, name: str) -> Any:
    """Return the properties of the operator with this name, also as a step of a macro; None of another.

    A macro's own properties of a step are those that it was begun with: a run again asks the step itself.
    """
    steps = (operator, *operator.macros) if operator is not None else ()
    return next((step.properties for step in steps if step.bl_idname == name), None)


def _name(operator: Any) -> str:
    room, _, rest = operator.bl_idname.partition(".")
    return f"{room.upper()}_OT_{rest}"


def _tool(context: bpy.types.Context) -> str:
    tool = context.workspace.tools.from_space_view3d_mode(context.mode)
    return tool.idname if tool is not None else ""


_wanted: list[int] = []  # pointers of windows in which the last run is to be run again
SOON = 0.01  # seconds until the threads in the way are looked at again


def _run_again() -> float | None:
    """Run the last operator again, outside of the arrow's own events: undo would take the arrow away under them.

    Beside none of our threads: while Python calls an operator inside `temp_override`, and a timer has no other context,
    Blender reads the override without Python's lock as soon as another thread has it, and crashes.
    """
    if not runner.call_off_all():
        return SOON
    view = in_view(_wanted[-1], "WINDOW")
    _wanted.clear()
    if view is not None:
        with bpy.context.temp_override(**view):
            bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)  # True: a step of undo for the next one to go back by
    return None


class _Arrow:
    """An arrow whose way from its foot is an option of the last run, in some unit."""

    if TYPE_CHECKING:
        gizmos: Any
        place: Callable[[bpy.types.Context], None]

    bl_space_type = "VIEW_3D"
    bl_region_type = "WINDOW"
    # No tool's own: Blender makes a tool's gizmos anew after each undo, also under the hand that pulls them.
    bl_options = {"3D", "PERSISTENT"}  # noqa: RUF012 - the form that Blender asks for

    tools: tuple[str, ...]
    operator: str
    option: str
    unit = 1.0  # length of the arrow's way where the option is 1

    @classmethod
    def chosen(cls, context: bpy.types.Context) -> Any:
        """Return the options of the last run; None where it was another's, or the tool is."""
        if context.mode != "EDIT_MESH" or _tool(context) not in cls.tools:
            return None
        return options_of(context.active_operator, cls.operator)

    def setup(self, _context: bpy.types.Context) -> None:
        self.arrow = self.gizmos.new("GIZMO_GT_arrow_3d")
        self.arrow.target_set_handler("offset", get=self._way, set=self._pull)
        self.arrow.color, self.arrow.color_highlight = COLOUR, LIT
        self.arrow.alpha = self.arrow.alpha_highlight = 1.0
        self.arrow.line_width = 3.0

    def draw_prepare(self, context: bpy.types.Context) -> None:
        """Put its foot where it belongs, but not while it is pulled."""
        if not self.arrow.is_modal:
            self.place(context)

    def stand(self, foot: Floats, direction: Floats) -> None:
        """Let it stand there (3,), in this unit direction (3,)."""
        across = np.cross(direction, np.eye(3)[np.abs(direction).argmin()])
        across /= np.linalg.norm(across)
        matrix = np.eye(4)
        matrix[:3] = np.column_stack([across, np.cross(direction, across), direction, foot])
        self.arrow.matrix_basis = matrix.T.tolist()  # Blender has it by columns

    def _way(self) -> float:
        options = self.chosen(bpy.context)
        return 0.0 if options is None else self.unit * float(getattr(options, self.option))

    def _pull(self, way: float) -> None:
        options = self.chosen(bpy.context)
        if options is not None:
            setattr(options, self.option, way / self.unit)
            _wanted.append(bpy.context.window.as_pointer())
            call_later(_run_again, 0.0)


class VIEW3D_GGT_fair_bulge(_Arrow, bpy.types.GizmoGroup):
    """Pull the middle of the faired region"""

    bl_idname = "VIEW3D_GGT_fair_bulge"
    bl_label = "Fair Bulge"
    tools = (FairLassoTool.bl_idname, FairPaintTool.bl_idname)
    operator = _name(MESH_OT_fair_region)
    option = "bulge"

    _seen: Any = None  # the regions that the arrow stands on

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        options, bulge = cls.chosen(context), named(FairOptions, cls.option)
        return (
            options is not None
            and last_run.has_regions()
            and bulge is not None
            and bulge.counts(FairOptions.of(options))
        )

    def place(self, context: bpy.types.Context) -> None:
        """Stand on the middle of the surface: the foot is where it would be without a bulge."""
        if self._seen is last_run.regions():
            return
        try:
            place, normal, radius = last_run.middle(context)
        except last_run.Changed:
            return
        self._seen, self.unit = last_run.regions(), LIFT * radius
        self.stand(place - self._way() * normal, normal)


class VIEW3D_GGT_fair_width(_Arrow, bpy.types.GizmoGroup):
    """Pull the fillet wider or narrower"""

    bl_idname = "VIEW3D_GGT_fair_width"
    bl_label = "Fair Width"
    tools = (FairFilletTool.bl_idname,)
    operator = _name(MESH_OT_fair_fillet)
    option = "width"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return cls.chosen(context) is not None and fillet.handle.flank is not None

    def place(self, _context: bpy.types.Context) -> None:
        """Stand at the seam, and point along a face to where the fillet begins."""
        assert fillet.handle.flank is not None
        self.stand(*fillet.handle.flank)


GROUPS = (VIEW3D_GGT_fair_bulge, VIEW3D_GGT_fair_width)
