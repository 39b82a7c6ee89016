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

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass, field

import bpy
import numpy as np

import fairing

from ..core import signals
from ..core.arrays import Floats, Ints
from ..core.engine import REFUSALS
from ..core.live_region import LiveRegion
from ..core.options import FairOptions
from ..core.region import free_vertices
from ..host.handlers import call_later, call_off, listen, unlisten
from ..host.status import redraw_sidebars
from ..mesh import live_mesh, mesh_io

SLOW = 0.25  # seconds of the last answer from which the next one waits for the end of the changes
PATIENCE = 0.5  # seconds after which an answer in the middle of changes is given up, to be asked for at their end
PAUSE = 0.3  # seconds without a change that count as their end
NO_REGION = "No live region: select faces, then Live Region"


@dataclass
class Session:
    """One mesh with a region, as it was last seen."""

    faces: Ints
    corners: Ints
    counts: tuple[int, int, int]
    region: LiveRegion
    positions: Floats = field(default_factory=lambda: np.empty((0, 3)))  # of region.vertices
    matrix: Floats = field(default_factory=lambda: np.zeros((4, 4)))
    seconds: float = 0.0  # of the last answer
    checked: bool = True  # an undo may have brought back another region


class Live:
    """The regions being followed, by the names of their meshes: undo replaces objects, so that only names last."""

    def __init__(self) -> None:
        self.sessions: dict[str, Session] = {}
        self.message = ""
        self.updates = 0  # answers written since the switch was turned on
        self.changed_at = 0.0  # the last change that waits for an answer, by time.monotonic
        self.on = False

    def take(self, obj: bpy.types.Object, options: FairOptions) -> None:
        """Make the selection the region of an object in edit mode, fair now.

        Raises what engine.REFUSALS lists where it can't be; nothing has changed then.
        """
        region = _read(obj, options, None)
        matrix = _matrix(obj)
        answer = region.answer(live_mesh.positions(obj.data, region.vertices), matrix)
        if answer is None:
            raise fairing.SolverError("The region's surface did not converge")
        live_mesh.mark_selection(obj.data, options, mesh_io.writable_key(obj))
        session = self.sessions[obj.data.name] = _session(obj, region)
        self._write(obj, session, answer)

    def follow(self, obj: bpy.types.Object, patience: float = math.inf) -> bool:
        """Make the region fair again where something has changed around it; tell whether it was written.

        patience: seconds after which to give up; the region is slow then.
        """
        session = self._current(obj)
        if session is None:
            return False
        positions, matrix = live_mesh.positions(obj.data, session.region.vertices), _matrix(obj)
        if np.array_equal(positions, session.positions) and np.array_equal(matrix, session.matrix):
            return False
        session.positions, session.matrix = positions, matrix
        begin = time.perf_counter()
        try:
            answer = session.region.answer(positions, matrix, lambda *_: time.perf_counter() < begin + patience)
        except fairing.Cancelled:
            session.positions = np.empty((0, 3))  # this change still waits for its answer
            session.seconds = patience
            return False
        session.seconds = time.perf_counter() - begin
        if answer is None:
            self.message = "The surface did not converge: the region stays as it is until the next change"
            return False
        self.message = ""
        self._write(obj, session, answer)
        return True

    def is_slow(self, obj: bpy.types.Object) -> bool:
        """Tell whether an answer would be felt as a jolt."""
        session = self.sessions.get(obj.data.name)
        return session is not None and session.seconds > SLOW

    def _current(self, obj: bpy.types.Object) -> Session | None:
        """Return the session of the mesh, opened anew where its connectivity or its region has changed.

        Raises ValueError, and closes the session, while the region's shape key is not the one to be written.
        """
        mesh = obj.data
        if not live_mesh.has_region(mesh):
            self.sessions.pop(mesh.name, None)
            return None
        try:
            _check_key(obj)
        except ValueError:
            self.sessions.pop(mesh.name, None)
            raise
        session = self.sessions.get(mesh.name)
        if session is None or not _fits(session, mesh):
            session = self.sessions[mesh.name] = _session(obj, _read(obj, live_mesh.region_options(mesh), mesh))
        return session

    def _write(self, obj: bpy.types.Object, session: Session, answer: Floats) -> None:
        mesh_io.write_edit_mesh(obj.data, session.region.free, answer)
        session.positions, session.matrix = live_mesh.positions(obj.data, session.region.vertices), _matrix(obj)
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


def _matrix(obj: bpy.types.Object) -> Floats:
    matrix: Floats = np.array(obj.matrix_world, dtype=np.float64)
    return matrix


def _read(obj: bpy.types.Object, options: FairOptions, marked: bpy.types.Mesh | None) -> LiveRegion:
    """Read the object's mesh with its selection, or the region that is marked, as the patch."""
    mesh_io.writable_key(obj)
    if options.boundary_normals == "CUSTOM":
        raise ValueError("Custom normals along the outline can't be followed: choose Surroundings or Average")
    mesh = mesh_io.read_edit_mesh(obj, options, live_mesh.LAYER if marked is not None else "")
    if not free_vertices(mesh).any():
        raise ValueError("No vertex inside the region is free to move")
    return LiveRegion(mesh, _matrix(obj), options)


def _check_key(obj: bpy.types.Object) -> None:
    """Raise ValueError while another shape key is active than the one that the region was made in, or it is locked."""
    active, own = mesh_io.writable_key(obj), live_mesh.region_key(obj.data)
    if active != own:
        own = f"the shape key {own!r}" if own else "the Basis"
        raise ValueError(
            f"Live rests while another shape key is active: its region belongs to {own}. "
            "Go back there, or make the region anew here"
        )


def _session(obj: bpy.types.Object, region: LiveRegion) -> Session:
    faces = live_mesh.region_faces(obj.data)
    assert faces is not None
    return Session(faces, live_mesh.corners(obj.data, faces), live_mesh.counts(obj.data), region)


def _fits(session: Session, mesh: bpy.types.Mesh) -> bool:
    if live_mesh.counts(mesh) != session.counts:
        return False
    if not session.checked:
        faces = live_mesh.region_faces(mesh)
        session.checked = faces is not None and np.array_equal(faces, session.faces)
    return session.checked and np.array_equal(live_mesh.corners(mesh, session.faces), session.corners)


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


def follow(obj: bpy.types.Object, patience: float = math.inf) -> bool:
    """Follow one object; what goes wrong is told in the panel, and the mesh is left as it is."""
    try:
        return live.follow(obj, patience)
    except REFUSALS as cause:
        live.message = f"{obj.name}: {cause}"
        return False


def _on_change(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    for obj in _edited(depsgraph):
        if not live.is_slow(obj):
            follow(obj, PATIENCE)
        if live.is_slow(obj):
            live.changed_at = time.monotonic()
            call_later(_follow_later, PAUSE)


def _follow_later() -> float | None:
    """Follow, or return the seconds to wait until the changes may have ended."""
    wait = live.changed_at + PAUSE - time.monotonic()
    if wait > 0.0:
        return wait
    for obj in edited_objects():
        follow(obj)
    return None


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
