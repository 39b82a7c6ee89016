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
from collections.abc import Callable, Iterable, Iterator
from functools import partial

import bpy

import fairing

from ..arrays.types import Floats
from ..fair.engine import REFUSALS
from ..host.handlers import call_later, call_off, listen, unlisten
from ..host.status import redraw_sidebars, redraw_views
from ..mesh import live_mesh, mesh_io
from ..options.options import FairOptions
from ..overlay import signals
from ..run.runner import Run, is_free
from ..words.words import said
from .region import Found, sought
from .session import Session, check_key, fits, is_of, session_of, where

PATIENCE = 0.15  # seconds for an answer in the middle of changes: with reading and writing a step stays below 0.3
PAUSE = 0.3  # seconds without a change that count as their end
TICK = 0.05  # seconds between two looks at a search
STAND_IN = said("live_stand_in")
SEARCHING = said("live_searching")
KEPT = said("live_kept")


class Live:
    """The regions being followed, by the names of their meshes: undo replaces objects, so that only names last."""

    def __init__(self) -> None:
        self.sessions: dict[str, Session] = {}
        self._aside: dict[str, Session] = {}  # the last of each mesh that was closed: a redo brings it back
        self.message = ""
        self.updates = 0  # answers written since the switch was turned on
        self.changed_at = 0.0  # the last change, by time.monotonic
        self.on = False
        self.rested = False  # changes were left alone, as somebody else had the meshes

    def take(self, obj: bpy.types.Object, session: Session, options: FairOptions, found: Found) -> None:
        """Make a candidate the region of its object in edit mode, with these options and its first surface."""
        assert found.positions is not None
        live_mesh.mark_faces(obj.data, session.faces, options, mesh_io.writable_key(obj))
        self._open(obj.data.name, session)
        self.message = STAND_IN if found.stands_in else ""
        self._write(obj, session, found.positions)

    def follow(self, obj: bpy.types.Object) -> bool:
        """Make the region fair again where something has changed around it; return whether it was written.

        Where there is no answer so soon the first surface stands in, and the region waits for `complete`.
        """
        session = self._current(obj)
        if session is None:
            return False
        if not session.moved(*where(obj, session.region)):
            return False
        # After an answer that took too long, or while a search has its solver, the changes until their end do without.
        answer = None if session.lost or session.search is not None else _asked(session)
        session.lost = answer is None
        self.message = ""
        if answer is None:
            answer = session.region.first(session.positions, session.matrix)
        self._write(obj, session, answer)
        return True

    def complete(self, obj: bpy.types.Object) -> bool:
        session = self._current(obj)
        if session is None or not session.lost or session.given_up:
            return False
        if session.search is None:
            session.search = Run(partial(sought, session.region, session.positions, session.matrix))
            self.message = SEARCHING
        if not session.search.wait(moment()):
            return True
        search, session.search = session.search, None
        if search.cancelled or self._has_moved(obj, session):
            return True
        self._end(obj, session, search)
        return False

    def _end(self, obj: bpy.types.Object, session: Session, search: Run[Found]) -> None:
        """Write what was found, or leave the region with its first surface; raises what went wrong."""
        session.given_up = True
        found = search.result()
        self.message = KEPT if found.positions is None else STAND_IN if found.stands_in else ""
        if found.positions is not None:
            session.lost = False
            self._write(obj, session, found.positions)

    def _has_moved(self, obj: bpy.types.Object, session: Session) -> bool:
        """Return whether the surroundings have moved since the last look; the handler of changes will take it up."""
        return not session.is_at(*where(obj, session.region))

    def waits(self, obj: bpy.types.Object) -> bool:
        """Return whether the region waits for a search, or for the end of one."""
        session = self.sessions.get(obj.data.name)
        return session is not None and session.lost and not session.given_up

    def stands_in(self) -> bool:
        """Return whether a region has no fair surface now, but the one that there always is."""
        return any(session.lost for session in self.sessions.values())

    def _current(self, obj: bpy.types.Object) -> Session | None:
        """Return the session of the mesh, opened anew where its connectivity or its region has changed.

        Raises ValueError, and closes the session, while the region's shape key is not the one to be written.
        """
        mesh = obj.data
        if not live_mesh.has_region(mesh):
            self._close(mesh.name)
            return None
        try:
            check_key(obj)
        except ValueError:
            self._close(mesh.name)
            raise
        session = self.sessions.get(mesh.name)
        if session is None or not fits(session, mesh):
            session = self._woken(mesh) or session_of(obj)
            self._open(mesh.name, session)
        return session

    def _woken(self, mesh: bpy.types.Mesh) -> Session | None:
        """Return the session that was put aside where its region is back: it knows the spacing before the fairing."""
        session = self._aside.get(mesh.name)
        return session if session is not None and is_of(session, mesh) else None

    def _open(self, name: str, session: Session) -> None:
        self._close(name)
        self.sessions[name] = session

    def _close(self, name: str) -> None:
        session = self.sessions.pop(name, None)
        if session is not None:
            session.call_off()
            self._aside[name] = session

    def _write(self, obj: bpy.types.Object, session: Session, answer: Floats) -> None:
        mesh_io.write_edit_mesh(obj.data, session.region.free, answer)
        session.wrote(answer)
        self.updates += 1

    def doubt(self) -> None:
        """Have the regions compared at the next change."""
        for session in self.sessions.values():
            session.checked = False

    def rest(self, edited: set[str]) -> None:
        """Stop the searches for meshes that are no longer edited; they begin anew when these are."""
        for name, session in self.sessions.items():
            if name not in edited:
                session.call_off()

    def forget(self) -> None:
        """Drop everything that was kept; regions stay in their meshes."""
        self.rest(set())
        self.sessions.clear()
        self._aside.clear()
        self.message = ""


live = Live()


def moment() -> float | None:
    """Return the seconds that Blender may stand still for a search; None: a script waits for the end of it."""
    return None if bpy.app.background else 0.0


def _asked(session: Session) -> Floats | None:
    """Ask for an answer at once; None where there is none, or not in time."""
    begin = time.perf_counter()
    end = begin + PATIENCE
    try:
        return session.region.answer(session.positions, session.matrix, lambda *_: time.perf_counter() < end)
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
    """Yield one object for each mesh in edit mode; a handler has no context that lists them."""
    seen = set()
    for obj in bpy.context.view_layer.objects:
        # None stands for an object that a script has removed since the scene was updated.
        if obj is not None and obj.mode == "EDIT" and obj.type == "MESH" and obj.data.name not in seen:
            seen.add(obj.data.name)
            yield obj


def follow(obj: bpy.types.Object) -> bool:
    return _told(live.follow, obj)


def complete(obj: bpy.types.Object) -> bool:
    return _told(live.complete, obj)


def _told(act: Callable[[bpy.types.Object], bool], obj: bpy.types.Object) -> bool:
    """Do it; the panel shows what goes wrong, and the mesh is left as it is."""
    try:
        return act(obj)
    except REFUSALS as cause:
        live.message = said("named", name=obj.name, text=str(cause))
        return False


def _on_change(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    _follow_all(_edited(depsgraph))


def _follow_all(changed: Iterable[bpy.types.Object]) -> None:
    """Follow them, or later, where somebody else has the meshes now: what a run shows meanwhile is no change."""
    if live.rested or not is_free():
        rest()
        return
    for obj in changed:
        if follow(obj):
            live.changed_at = time.monotonic()
        if live.waits(obj):
            call_later(_complete_later, PAUSE)


def _complete_later() -> float | None:
    """Search, look whether a search has ended, or return the seconds to wait until the changes may have ended."""
    if not is_free():
        return TICK
    if live.rested:
        live.rested = False
        _follow_all(edited_objects())
    wait = live.changed_at + PAUSE - time.monotonic()
    if wait > 0.0:
        return wait
    return TICK if complete_all() else None


def complete_all() -> bool:
    """Search for the surfaces of all lost regions that are being edited; return whether a search goes on."""
    said, edited = live.message, list(edited_objects())
    live.rest({obj.data.name for obj in edited})
    going_on = [complete(obj) for obj in edited]
    if live.message != said or not any(going_on):
        redraw_views(bpy.context)
    return any(going_on)


def _on_step(*_arguments: object) -> None:
    """Follow an undo or a redo, but not before the operator that may be repeated after it has read the mesh."""
    live.doubt()
    rest()


def rest() -> None:
    """Leave the meshes alone until the next look, and look at all of them then."""
    live.rested = True
    call_later(_complete_later, TICK)


def switched(context: bpy.types.Context) -> None:
    """Start or stop following, as the switch says."""
    if context.window_manager.fairing_live.on:
        start()
        _follow_all(edited_objects())
        if is_free() and complete_all():
            call_later(_complete_later, TICK)
    else:
        stop()
    redraw_sidebars(context)


def start() -> None:
    if live.on:
        return
    live.on = True
    live.updates = 0
    listen(bpy.app.handlers.depsgraph_update_post, _on_change)
    listen(bpy.app.handlers.undo_post, _on_step)
    listen(bpy.app.handlers.redo_post, _on_step)


def stop() -> None:
    if live.on:
        unlisten(bpy.app.handlers.redo_post, _on_step)
        unlisten(bpy.app.handlers.undo_post, _on_step)
        unlisten(bpy.app.handlers.depsgraph_update_post, _on_change)
    live.on = live.rested = False
    call_off(_complete_later)
    live.forget()


def register() -> None:
    signals.listeners["live"] = switched


def unregister() -> None:
    stop()
    signals.listeners.pop("live", None)
