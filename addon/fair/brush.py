# mypy: disable-error-code="valid-type"
"""The brush of sculpt mode: what is painted over becomes fair when the button is let go, with the brush's falloff.

No postponed annotations here: Blender reads them as property definitions.
"""

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import bpy
import numpy as np
from bpy.props import CollectionProperty, FloatProperty, FloatVectorProperty, IntProperty

from ..arrays.types import Floats, Ints
from ..host.context import active_object
from ..host.dragging import pixel_size
from ..host.handlers import hear_events
from ..host.picking import place_at
from ..host.polling import require
from ..mesh import levels, painted
from ..options.options import FairOptions
from ..run.background import Watched
from ..show.preview import show
from ..translations import translated
from ..words.words import said
from .outside import FairsOutside, Task, check_shown

STEP = 0.5  # of the radius, from one place to the next
FULL = 0.6  # opacity where all is painted


class FairDab(bpy.types.PropertyGroup):
    """One place of the brush on the surface"""

    place: FloatVectorProperty(size=3)
    reach: FloatProperty()


class MESH_OT_fair_brush(FairsOutside, bpy.types.Operator):
    """Paint over what is to become fair and let go. Masked vertices stay"""

    bl_idname = "mesh.fair_brush"
    bl_label = "Fair Brush"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    dabs: CollectionProperty(type=FairDab, options={"HIDDEN", "SKIP_SAVE"})

    radius: IntProperty(name="Radius", description="Brush radius", default=25, min=1, soft_max=300, subtype="PIXEL")

    _at: tuple[float, float] | None = None  # the last place, in pixels of the region
    _positions: Floats  # (n, 3), while the stroke is painted
    _triangles: Ints
    _weights: Floats

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require(cls, context.mode == "SCULPT", said("in_sculpt_mode")) and super().poll(context)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Begin to paint; what can't be faired is refused before."""
        obj = active_object(context)
        try:
            check_shown(obj)
            self._check_level(levels.shown_level(obj), FairOptions())
        except ValueError as cause:
            self.report({"ERROR"}, translated(said("named", name=obj.name, text=str(cause))))
            return {"CANCELLED"}
        self.dabs.clear()
        self._positions = painted.positions(obj.data)
        self._triangles = painted.triangles(obj.data)
        self._weights = np.zeros(len(self._positions))
        self._go_to(context, event)
        hear_events(context, self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Follow the pointer until the button is let go, then the run."""
        if self._run is not None:
            return Watched.modal(self, context, event)
        if event.type in {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE"}:
            self._go_to(context, event)
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE":
            return self.let_go(context)
        elif event.type in {"ESC", "RIGHTMOUSE"}:
            self.cancel(context)
            return {"CANCELLED"}
        return {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        show([])
        Watched.cancel(self, context)

    def _go_to(self, context: bpy.types.Context, event: bpy.types.Event) -> None:
        there = (float(event.mouse_region_x), float(event.mouse_region_y))
        for place in between(self._at or there, there, max(1.0, STEP * self.radius)):
            self.dab(context, *place)
        self._at = there

    def dab(self, context: bpy.types.Context, x: float, y: float) -> None:
        """Paint at a place on the surface; off it nothing happens."""
        obj = active_object(context)
        place = place_at(context, (x, y), obj)
        if place is None:
            return
        matrix = np.array(obj.matrix_world)
        there = matrix[:3, :3] @ np.array(place) + matrix[:3, 3]
        reach = self.radius * pixel_size(context, there) / float(np.cbrt(abs(np.linalg.det(matrix[:3, :3]))))
        dab = self.dabs.add()
        dab.place, dab.reach = place, reach
        paint(self._weights, self._positions, np.array(place), reach)
        places = self._positions @ matrix[:3, :3].T + matrix[:3, 3]
        over = self._triangles[self._weights[self._triangles].any(axis=1)]
        show([(places, over if np.linalg.det(matrix[:3, :3]) > 0.0 else over[:, ::-1], FULL * self._weights)])

    def let_go(self, context: bpy.types.Context) -> set[str]:
        """Fair, in the background where that takes a while."""
        show([])
        if not len(self.dabs):
            self.report({"INFO"}, translated(said("no_face_there")))
            return {"CANCELLED"}
        return self._begin_with(context, self._start)

    def _check_level(self, level: int, options: FairOptions) -> None:
        FairsOutside._check_level(self, level, options)
        if level:
            raise ValueError(said("brush_levels"))

    def _read_object(self, obj: bpy.types.Object, options: FairOptions, level: int) -> Task:
        """Read the mesh with what was painted as its mask, which each vertex goes by."""
        positions = painted.positions(obj.data)
        weights = np.zeros(len(positions))
        for dab in self.dabs:
            paint(weights, positions, np.array(dab.place), dab.reach)
        with painted.masked_by(obj.data, weights * painted.protected(obj.data)):
            return super()._read_object(obj, replace(options, use_mask=True), level)

    def _faces(self, obj: bpy.types.Object) -> Ints:
        faces = painted.masked_faces(obj.data)
        if not len(faces):
            raise ValueError(said("brush_nothing"))
        return faces


INNER = 0.5  # of the radius, within which all is painted


def falloff(shares: Floats) -> Floats:
    """Return weights (k,) for distances (k,) as shares of the radius: 1 within INNER, 0 from 1 on, smooth between."""
    left = np.clip((1.0 - shares) / (1.0 - INNER), 0.0, 1.0)
    weights: Floats = left * left * (3.0 - 2.0 * left)
    return weights


def paint(weights: Floats, positions: Floats, place: Floats, radius: float) -> None:
    """Raise the weights (n,) of the vertices at `positions` (n, 3) within the radius of a place (3,)."""
    near = np.flatnonzero(np.abs(positions[:, 0] - place[0]) < radius)
    shares = np.linalg.norm(positions[near] - place, axis=1) / radius
    weights[near] = np.maximum(weights[near], falloff(shares))


def between(before: Any, after: Any, step: float) -> Iterator[tuple[float, float]]:
    """Yield places from `before` to `after`, the last one included, no further apart than a step."""
    (x0, y0), (x1, y1) = before, after
    count = max(1, round(((x1 - x0) ** 2 + (y1 - y0) ** 2) ** 0.5 / step + 0.5))
    for k in range(1, count + 1):
        yield x0 + (x1 - x0) * k / count, y0 + (y1 - y0) * k / count
