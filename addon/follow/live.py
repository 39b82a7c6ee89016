"""Live: a region of the mesh that is made fair again after every change around it.

The region lies in the mesh (live_mesh.py), the switch on the window manager. A depsgraph handler looks at what
changed, O(region), solves from the last answer and writes the free vertices. Blender updates the scene
once more after a handler that changed something, without calling handlers again; and what is written is
remembered, so that seeing it again is no change.

A region belongs to the shape key that it was made in: while another one is active, nothing is followed.

Undo needs nothing of its own: the region is a function of its surroundings, so that after a step back it is
made fair for those.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator

import bpy
import numpy as np

import fairing

from ..core import signals
from ..core.arrays import Floats
from ..core.engine import REFUSALS
from ..core.options import FairOptions
from ..host.context import is_dragging
from ..host.handlers import call_later, call_off, listen, unlisten
from ..host.status import redraw_sidebars, redraw_views
from ..mesh import live_mesh, mesh_io
from .session import Session, check_key, fits, matrix_of, read, session_of

PATIENCE = 0.15  # seconds for an answer in the middle of changes: with reading and writing a step stays below 0.3
LEISURE = 3.0  # seconds of the processor for each of the three ways to an answer at their end: other work is no reason
REST = 0.2  # and for the first way alone where the mouse rests, but has not let go
MOST_SKIPPED = 15  # changes in a row that are carried along without asking for an answer
PAUSE = 0.3  # seconds without a change that count as their end
STAND_IN = "No fair surface leads here: Even Curvature stands in for it"
CARRIED = "No fair surface leads here: the region is carried along, and mends when it is dragged back"
NO_REGION = "No live region: select faces, then Live Region"


class Live:
    """The regions being followed, by the names of their meshes: undo replaces objects, so that only names last."""

    def __init__(self) -> None:
        self.sessions: dict[str, Session] = {}
        self.message = ""
        self.updates = 0  # answers written since the switch was turned on
        self.changed_at = 0.0  # the last change that waits for an answer, by time.monotonic
        self.rested_at = 0.0  # the last of these that was looked at while all was quiet
        self.on = False

    def take(self, obj: bpy.types.Object, options: FairOptions) -> None:
        """Make the selection the region of an object in edit mode, fair now.

        Raises what engine.REFUSALS lists where it can't be; nothing has changed then.
        """
        region = read(obj, options, None)
        matrix = matrix_of(obj)
        answer = region.answer(live_mesh.positions(obj.data, region.vertices), matrix)
        if answer is None:
            raise fairing.SolverError("No fair surface was found for the region")
        live_mesh.mark_faces(obj.data, region.faces, options, mesh_io.writable_key(obj))
        session = self.sessions[obj.data.name] = session_of(obj, region)
        self._write(obj, session, answer)

    def follow(self, obj: bpy.types.Object, hurried: bool = False) -> bool:
        """Make the region fair again where something has changed around it; tell whether it was written.

        hurried: in the middle of changes; the region is carried along where there is no answer so soon.
        """
        session = self._current(obj)
        if session is None:
            return False
        positions, matrix = live_mesh.positions(obj.data, session.region.vertices), matrix_of(obj)
        same = np.array_equal(positions, session.positions) and np.array_equal(matrix, session.matrix)
        if same and (hurried or not session.lost):
            return False
        session.positions, session.matrix = positions, matrix
        answer = self._hurried(session) if hurried else self._at_leisure(session)
        session.lost = answer is None
        if answer is None:
            session.mark_outline()
            answer = session.region.carried(positions)
            self.message = "" if hurried else CARRIED
        self._write(obj, session, answer)
        return True

    def _hurried(self, session: Session) -> Floats | None:
        """Answer in the middle of changes, or not: after an answer that took too long some changes do without."""
        if session.waited < session.skip:
            session.waited += 1
            return None
        answer = _asked(session, session.region.answer, PATIENCE, time.perf_counter)
        failed = answer is None
        session.skip = min(2 * session.skip + 1, MOST_SKIPPED) if failed else 0
        session.waited = 0
        if not failed:
            self.message = ""
        return answer

    def _at_leisure(self, session: Session) -> Floats | None:
        """Answer at the end of changes: the surface itself, or the one that stands in for it."""
        self.message = ""
        if is_dragging():
            return _asked(session, session.region.answer, REST, time.process_time)
        for ask in (session.region.answer, session.region.afresh):
            answer = _asked(session, ask, LEISURE, time.process_time)
            if answer is not None:
                return answer
        self.message = STAND_IN
        return _asked(session, session.region.stand_in, LEISURE, time.process_time)

    def is_lost(self, obj: bpy.types.Object) -> bool:
        """Tell whether the region still waits for an answer."""
        session = self.sessions.get(obj.data.name)
        return session is not None and session.lost

    def lost_points(self) -> Floats:
        """Return the outlines (k, 3) in world space of all regions that have no fair surface now."""
        points = [session.points for session in self.sessions.values() if session.lost]
        return np.concatenate([np.empty((0, 3)), *points])

    def _current(self, obj: bpy.types.Object) -> Session | None:
        """Return the session of the mesh, opened anew where its connectivity or its region has changed.

        Raises ValueError, and closes the session, while the region's shape key is not the one to be written.
        """
        mesh = obj.data
        if not live_mesh.has_region(mesh):
            self.sessions.pop(mesh.name, None)
            return None
        try:
            check_key(obj)
        except ValueError:
            self.sessions.pop(mesh.name, None)
            raise
        session = self.sessions.get(mesh.name)
        if session is None or not fits(session, mesh):
            session = self.sessions[mesh.name] = session_of(obj, read(obj, live_mesh.region_options(mesh), mesh))
        return session

    def _write(self, obj: bpy.types.Object, session: Session, answer: Floats) -> None:
        mesh_io.write_edit_mesh(obj.data, session.region.free, answer)
        session.positions, session.matrix = live_mesh.positions(obj.data, session.region.vertices), matrix_of(obj)
        self.updates += 1

    def doubt(self) -> None:
        """Have the regions compared at the next change."""
        for session in self.sessions.values():
            session.checked = False

    def forget(self) -> None:
        """Drop everything that was kept; regions stay in their meshes."""
        self.sessions.clear()
        self.message = ""


live = Live()


def _asked(
    session: Session, ask: Callable[..., Floats | None], patience: float, clock: Callable[[], float]
) -> Floats | None:
    """Ask for an answer, for so many seconds by the clock; None where there is none, or not in time."""
    begin, end = time.perf_counter(), clock() + patience
    try:
        return ask(session.positions, session.matrix, lambda *_: clock() < end)
    except (fairing.Cancelled, fairing.SolverError):
        return None
    finally:
        session.seconds = time.perf_counter() - begin


def _edited(depsgraph: bpy.types.Depsgraph) -> Iterator[bpy.types.Object]:
    """Yield the objects in edit mode whose mesh or transform was changed."""
    changed = {update.id.original.name for update in depsgraph.updates if isinstance(update.id, bpy.types.Mesh)}
    moved = {
        update.id.original.name
        for update in depsgraph.updates
        if isinstance(update.id, bpy.types.Object) and (update.is_updated_transform or update.is_updated_geometry)
    }
    if changed or moved:
        for obj in edited_objects():
            if obj.data.name in changed or obj.name in moved:
                yield obj


def edited_objects() -> Iterator[bpy.types.Object]:
    """Yield one object for each mesh in edit mode; a handler has no context that would tell them."""
    seen = set()
    for obj in bpy.context.view_layer.objects:
        if obj.mode == "EDIT" and obj.type == "MESH" and obj.data.name not in seen:
            seen.add(obj.data.name)
            yield obj


def follow(obj: bpy.types.Object, hurried: bool = False) -> bool:
    """Follow one object; what goes wrong is told in the panel, and the mesh is left as it is."""
    try:
        return live.follow(obj, hurried)
    except REFUSALS as cause:
        live.message = f"{obj.name}: {cause}"
        return False


def _on_change(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    for obj in _edited(depsgraph):
        if follow(obj, hurried=True) and live.is_lost(obj):
            live.changed_at = time.monotonic()
            call_later(_follow_later, PAUSE)


def _follow_later() -> float | None:
    """Follow, or return the seconds to wait until the changes may have ended.

    A drag that rests is answered once, in a moment or not at all: the rest of the time belongs to the mouse.
    """
    wait = live.changed_at + PAUSE - time.monotonic()
    if wait > 0.0:
        return wait
    if is_dragging() and live.rested_at == live.changed_at:
        return PAUSE
    live.rested_at = live.changed_at
    for obj in edited_objects():
        follow(obj)
    redraw_views(bpy.context)
    return PAUSE if is_dragging() and any(session.lost for session in live.sessions.values()) else None


def _on_step(*_arguments: object) -> None:
    """Follow an undo or a redo."""
    live.doubt()


def _on_load(_path: str) -> None:
    live.forget()


def switched(context: bpy.types.Context) -> None:
    """Start or stop following, as the switch says."""
    if context.window_manager.fairing_live.on:
        start()
        for obj in edited_objects():
            follow(obj)
    else:
        stop()
    redraw_sidebars(context)


def start() -> None:
    """Follow changes from now on."""
    if live.on:
        return
    live.on = True
    live.updates = 0
    listen(bpy.app.handlers.depsgraph_update_post, _on_change)
    listen(bpy.app.handlers.undo_post, _on_step)
    listen(bpy.app.handlers.redo_post, _on_step)


def stop() -> None:
    """Follow no more."""
    if live.on:
        unlisten(bpy.app.handlers.redo_post, _on_step)
        unlisten(bpy.app.handlers.undo_post, _on_step)
        unlisten(bpy.app.handlers.depsgraph_update_post, _on_change)
    live.on = False
    call_off(_follow_later)
    live.forget()


def register() -> None:
    """Follow the switch and the opening of files."""
    signals.listeners["live"] = switched
    listen(bpy.app.handlers.load_post, _on_load)


def unregister() -> None:
    """Leave nothing behind."""
    stop()
    signals.listeners.pop("live", None)
    unlisten(bpy.app.handlers.load_post, _on_load)
