"""The quality overlay: when to measure, when to draw.

Measured after each change of the mesh (a timer on the main thread), drawn at each redraw.
"""

from __future__ import annotations

from typing import Any

import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

import fairing

from ..arrays.region import MeshArrays
from ..arrays.types import Floats
from ..host.context import active_object, edited_objects
from ..host.handlers import call_later, call_off, is_edited, listen, unlisten
from ..host.status import redraw_views
from ..mesh import mesh_io
from ..options.options import FairOptions
from ..run import compare
from ..words.words import said
from . import legend, signals
from .data import Surface, make_surface, sense
from .shader import make_shader

DELAY = 0.02  # seconds from a change to the next measurement


class Overlay:
    """Surfaces measured, their batches on the GPU, and what is reported about them."""

    def __init__(self) -> None:
        self.surfaces: tuple[Surface, ...] = ()
        self.message = ""
        self.handle: Any = None
        self.legend: Any = None
        self._shader: Any = None
        self._batches: list[Any] = []

    def measure(self, context: bpy.types.Context) -> None:
        whole = context.mode != "EDIT_MESH" or context.window_manager.fairing_overlay.scope == "OBJECT"
        self.clear()
        self.surfaces = tuple(s for obj in _shown(context) if (s := self._surface(obj, whole)) is not None)

    def _surface(self, obj: bpy.types.Object, whole: bool) -> Surface | None:
        mesh = mesh_io.read_shown_mesh(obj, FairOptions())
        matrix = np.array(obj.matrix_world, dtype=np.float64)
        wanted = bpy.context.window_manager.fairing_overlay.mode == "DEVIATION"
        try:
            return make_surface(mesh, matrix, whole, _deviation(obj.name, mesh, matrix) if wanted else None)
        except ValueError as cause:  # no surface: a message instead of a wrong picture
            self.message = said("named", name=obj.name, text=str(cause))
            return None

    def draw(self, context: bpy.types.Context) -> None:
        if not self.surfaces:
            return
        if self._shader is None:
            self._shader = make_shader()
        settings = context.window_manager.fairing_overlay
        if not self._batches:
            self._batches = [_batch(self._shader, surface, settings.mode) for surface in self.surfaces]
        gpu.state.depth_test_set("LESS_EQUAL")
        gpu.state.blend_set("ALPHA")
        for surface, batch in zip(self.surfaces, self._batches, strict=True):
            self._shader.bind()
            _set_constants(self._shader, settings, context.region_data, surface)
            batch.draw(self._shader)
        gpu.state.blend_set("NONE")
        gpu.state.depth_test_set("NONE")

    def clear(self) -> None:
        self.surfaces, self._batches, self.message = (), [], ""

    @property
    def largest(self) -> float:
        """The largest value shown, with its sign."""
        mode = bpy.context.window_manager.fairing_overlay.mode
        return max((surface.largest(mode) for surface in self.surfaces), key=abs)


overlay = Overlay()


def _shown(context: bpy.types.Context) -> list[bpy.types.Object]:
    if context.mode == "EDIT_MESH":
        return edited_objects(context)
    obj = active_object(context)
    return [obj] if obj is not None and obj.type == "MESH" else []


def _batch(shader: Any, surface: Surface, mode: str) -> Any:
    content = {
        "position": surface.positions.astype(np.float32),
        "normal": surface.normals.astype(np.float32),
        "curvature": (sense(mode) * surface.values(mode)).astype(np.float32),
    }
    return batch_for_shader(shader, "TRIS", content, indices=surface.triangles.astype(np.int32))


def _set_constants(shader: Any, settings: Any, view: Any, surface: Surface) -> None:
    inverse = view.view_matrix.inverted()
    perspective = view.is_perspective
    shader.uniform_float("view_projection", view.perspective_matrix)
    # Where one looks from; without perspective the direction towards it, the same everywhere.
    eye = inverse.translation if perspective else inverse.col[2].xyz
    shader.uniform_float("eye", (*eye, float(perspective)))
    shader.uniform_float("lights", (*settings.axis.normalized(), float(settings.stripes)))
    shader.uniform_float("look", (float(settings.mode != "ZEBRA"), full_colour(settings), settings.opacity, 0.0))


def full_colour(settings: Any) -> float:
    """Return the value with full colour, the same for all that is shown: of a legend there is one."""
    if not settings.automatic:
        return float(settings.range)
    return max([1e-9, *(surface.usual(settings.mode) for surface in overlay.surfaces)])


def _deviation(name: str, mesh: MeshArrays, matrix: Floats) -> Floats | None:
    """Return how far each vertex (n,) is from the surface before the last run; None where there was none."""
    before = compare.positions_before(name, mesh.positions)
    if before is None:
        return None
    found = np.zeros(len(before))
    moved = np.flatnonzero((before != mesh.positions).any(axis=1))
    now, then = (places @ matrix[:3, :3].T + matrix[:3, 3] for places in (mesh.positions, before))
    if len(moved):
        found[moved] = fairing.deviation(now[moved], then, mesh.triangles)
    return found


def _draw() -> None:
    overlay.draw(bpy.context)


def _draw_legend() -> None:
    settings = bpy.context.window_manager.fairing_overlay
    if overlay.surfaces and settings.mode != "ZEBRA":
        legend.draw(bpy.context, settings.mode, full_colour(settings), overlay.largest)


def settings_changed(context: bpy.types.Context) -> None:
    if context.window_manager.fairing_overlay.show:
        overlay.measure(context)
        start()
    else:
        stop()
    redraw_views(context)


def start() -> None:
    if overlay.handle is None:
        add = bpy.types.SpaceView3D.draw_handler_add
        overlay.handle = add(_draw, (), "WINDOW", "POST_VIEW")
        overlay.legend = add(_draw_legend, (), "WINDOW", "POST_PIXEL")
        listen(bpy.app.handlers.depsgraph_update_post, _on_change)


def stop() -> None:
    if overlay.handle is not None:
        unlisten(bpy.app.handlers.depsgraph_update_post, _on_change)
        for handle in (overlay.handle, overlay.legend):
            bpy.types.SpaceView3D.draw_handler_remove(handle, "WINDOW")
        overlay.handle = overlay.legend = None
    call_off(_measure_later)
    overlay.clear()


def _on_change(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    if is_edited(depsgraph):
        call_later(_measure_later, DELAY)


def _measure_later() -> None:
    context = bpy.context
    if overlay.handle is not None and context.window_manager.fairing_overlay.show:
        overlay.measure(context)
        redraw_views(context)


def refresh() -> None:
    if bpy.context.window_manager.fairing_overlay.show:
        overlay.measure(bpy.context)


def register() -> None:
    signals.listeners.update(content=settings_changed, look=redraw_views)


def unregister() -> None:
    stop()
    for kind in ("content", "look"):
        signals.listeners.pop(kind, None)
