# mypy: disable-error-code="valid-type"
"""Operators that follow the pointer from the press of a button to its release: places along the way, in steps.

No postponed annotations here: Blender reads them as property definitions.
"""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import CollectionProperty, IntProperty

from ..host.handlers import hear_events

STEP = 0.5  # of the radius, from one place to the next


class Stroke:
    """What such an operator needs besides `dab`, which does something at one place, and `let_go`."""

    if TYPE_CHECKING:
        dab: Callable[[bpy.types.Context, float, float], None]
        let_go: Callable[[bpy.types.Context], set[str]]
        cancel: Callable[[bpy.types.Context], None]

    radius: IntProperty(name="Radius", description="Of the circle", default=25, min=1, soft_max=300, subtype="PIXEL")

    _at: tuple[float, float] | None = None  # the last place, in pixels of the region

    def begin_stroke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self._go_to(context, event)
        hear_events(context, self)
        return {"RUNNING_MODAL"}

    def follow_stroke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE"}:
            self._go_to(context, event)
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE":
            return self.let_go(context)
        elif event.type in {"ESC", "RIGHTMOUSE"}:
            self.cancel(context)
            return {"CANCELLED"}
        return {"RUNNING_MODAL"}

    def _go_to(self, context: bpy.types.Context, event: bpy.types.Event) -> None:
        there = (float(event.mouse_region_x), float(event.mouse_region_y))
        for place in between(self._at or there, there, max(1.0, STEP * self.radius)):
            self.dab(context, *place)
        self._at = there


def between(before: Any, after: Any, step: float) -> Iterator[tuple[float, float]]:
    """Yield places from `before` to `after`, the last one included, no further apart than a step."""
    (x0, y0), (x1, y1) = before, after
    count = max(1, round(((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5 / step + 0.5))
    for k in range(1, count + 1):
        yield x0 + (x1 - x0) * k / count, y0 + (y1 - y0) * k / count


class MESH_OT_fair_stroke(Stroke, bpy.types.Operator):
    """Paint over vertices, edges or faces to select them"""

    bl_idname = "mesh.fair_stroke"
    bl_label = "Select by Stroke"
    bl_options = {"INTERNAL"}  # noqa: RUF012 - the form that Blender asks for

    path: CollectionProperty(type=bpy.types.OperatorMousePath, options={"HIDDEN", "SKIP_SAVE"})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.mode == "EDIT_MESH")

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        self.path.clear()
        return self.begin_stroke(context, event)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return self.follow_stroke(context, event)

    def execute(self, _context: bpy.types.Context) -> set[str]:
        """Go along the path again, as a change of an option asks for."""
        for k, point in enumerate(self.path):
            self._select(point.loc[0], point.loc[1], "ADD" if k else "SET")
        return {"FINISHED"}

    def dab(self, _context: bpy.types.Context, x: float, y: float) -> None:
        """Select what is under the circle, and nothing else at first."""
        self.path.add().loc = (x, y)
        self._select(x, y, "ADD" if len(self.path) > 1 else "SET")

    def let_go(self, _context: bpy.types.Context) -> set[str]:
        """Leave the selection to what comes next."""
        return {"FINISHED"}

    def cancel(self, _context: bpy.types.Context) -> None:
        """Leave what is selected."""

    def _select(self, x: float, y: float, mode: str) -> None:
        bpy.ops.view3d.select_circle(x=round(x), y=round(y), radius=self.radius, mode=mode, wait_for_input=False)
