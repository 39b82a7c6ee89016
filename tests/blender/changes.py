"""The redo panel of a run, whose changes are searched for in threads that wait at gates.

Blender's own operator takes the last run back and repeats it, as the panel does; looks are taken from here. Both are
called from a window, without `temp_override`, which these tests need. Then no other thread may run Python meanwhile, or
Blender crashes: a gate takes no lock of Python.
"""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import bmesh
import bpy
import numpy as np
import pytest

import meshes
from extension import module

STUCK = 5.0  # seconds by the wall: so long it waits for something, whatever else the machine does


def _dome() -> None:
    meshes.enter(*meshes.domed_grid())


@dataclass(frozen=True)
class Kind:
    """An operator that is run, and where its answers come from."""

    operator: str = "fair_region"
    home: str = "fair.finish"  # the module whose `Request` finds them
    enter: Callable[[], None] = _dome  # makes an object and edits it, with what is to be selected
    first: dict[str, Any] = field(default_factory=dict)  # options of the run
    second: dict[str, Any] = field(default_factory=lambda: {"shape": "LEAST_VARIATION"})  # of a change
    third: dict[str, Any] = field(default_factory=lambda: {"shape": "MINIMAL_ENERGY"})  # of another one
    refused: dict[str, Any] = field(default_factory=dict)  # of one of which nothing comes

    def run(self, **options: Any) -> set[str]:
        """Run it as a script does."""
        status: set[str] = getattr(bpy.ops.mesh, self.operator)("EXEC_DEFAULT", True, **{**self.first, **options})
        return status


def edited(name: str) -> bytes:
    """A mesh in edit mode: its places, edges and faces, UVs and other shape keys than the active one."""
    mesh, active = bpy.data.objects[name].data, bpy.data.objects[name].active_shape_key
    shape, bm = module("mesh.mesh_io").shape_of(mesh), bmesh.from_edit_mesh(mesh)
    layers = [layer for layer in bm.verts.layers.shape.values() if layer.name != active.name]
    keys = [vertex[layer][:] for layer in layers for vertex in bm.verts]
    uvs = [corner[layer].uv[:] for layer in bm.loops.layers.uv.values() for face in bm.faces for corner in face.loops]
    numbers = (shape.positions, shape.edges, shape.corner_vertices, np.array(keys), np.array(uvs))
    return b"|".join(each.tobytes() for each in numbers)


class Panel:
    """One."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch, kind: Kind) -> None:
        self.kind, self.redo, home = kind, module("run.redo"), module(kind.home)
        self.is_open = False
        self.waits = 0  # answers that were searched for in the main thread
        self.gates: list[threading.Event] = []
        self.given = threading.Event()
        solve = home.Request.work
        import fairing

        def slow(*arguments: Any, **rest: Any) -> Any:
            if threading.current_thread() is threading.main_thread():
                self.waits += 1
                return solve(*arguments, **rest)
            gate = threading.Event()
            if self.is_open:
                gate.set()
            self.gates.append(gate)
            try:
                found = solve(*arguments, **rest)
            finally:
                self.given.set()
                gate.wait()
            if not arguments[1](0.5, ""):
                raise fairing.Cancelled
            return found

        kind.enter()
        self.name = bpy.context.object.name
        self.before, self.original = self.positions(), edited(self.name)
        bpy.ops.ed.undo_push(message="Begin")
        assert kind.run() == {"FINISHED"}
        self.first_run, self.first = self.positions(), edited(self.name)
        monkeypatch.setattr(self.redo, "has_events", lambda _context: True)
        monkeypatch.setattr(self.redo.background, "LARGE", 0)
        monkeypatch.setattr(self.redo, "watch", lambda: None)
        monkeypatch.setattr(self.redo, "is_held", lambda: False)
        monkeypatch.setattr(home.Request, "work", slow)
        module("run.job").memory.clear()

    @staticmethod
    def threads() -> list[threading.Thread]:
        return [thread for thread in threading.enumerate() if thread.name == "fairing"]

    @property
    def report(self) -> Any:
        return bpy.context.window_manager.fairing_report

    @property
    def follows(self) -> bool:
        return bool(bpy.context.window_manager.fairing_progress.following)

    @property
    def now(self) -> bytes:
        """The mesh in edit mode: undo replaces the object."""
        return edited(self.name)

    def positions(self) -> Any:
        """Of the mesh in edit mode, float32 as Blender has them."""
        mesh = bpy.data.objects[self.name].data
        return module("mesh.mesh_io").edit_positions(mesh).astype(np.float32)

    def leave_panel(self, **options: Any) -> None:
        """Change options in the panel; Blender goes on before anything is searched for."""
        operator = bpy.context.window_manager.operators[-1]
        operator = operator.macros[0] if len(operator.macros) else operator
        for name, value in options.items():
            setattr(operator.properties, name, value)
        before = self.threads()
        with in_view():
            bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)
        assert set(self.threads()) <= set(before)  # none begins inside an operator

    def change(self, **options: Any) -> None:
        """Change options in the panel, and let the search come as far as it does alone."""
        self.leave_panel(**options)
        self.open()  # for those that were cancelled
        self.given.clear()
        self.is_open, kept = False, self.is_open
        self.look()
        assert not self.follows or self.given.wait(10.0)
        self.look()
        self.is_open = kept

    def look(self) -> bool:
        """Take a look, and return whether another is to come."""
        with in_view():
            return bool(self.redo.look(bpy.context))

    def open(self) -> None:
        for gate in self.gates:
            gate.set()

    def complete(self) -> None:
        """Let the answers come, and the timer look until none is awaited."""
        self.open()
        end = time.perf_counter() + STUCK
        while self.look():
            assert time.perf_counter() < end
            time.sleep(0.01)
        assert not self.follows

    def end(self) -> None:
        """Leave no thread behind."""
        self.open()
        module("run.background").stop_all()


def in_view() -> Any:
    """The context that an operator has in a 3D view."""
    area = next(area for area in bpy.context.window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return bpy.context.temp_override(area=area, region=region)
