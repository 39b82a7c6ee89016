"""The operator that makes the selection the live region: its first answer is sought like that of any long run.

Nothing is marked, and nothing moves, before the surface is there.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import bpy

import fairing

from ..fair.engine import Progress
from ..host.context import edited_objects
from ..host.polling import NO_FACE, SELECT_FACES, require_edit_mode, require_idle
from ..mesh import mesh_io
from ..options.options import FairOptions
from ..run.background import Watched
from ..run.job import each_of, objects_in_mode, refusing
from ..run.request import Request, Say
from ..selection.inspection import last_options
from ..translations import translated
from ..words.words import said
from .live import live
from .region import Found, sought
from .session import Session, candidate, is_current


def enclosing(obj: bpy.types.Object) -> bool:
    """Return whether selected edges of an object in edit mode enclose faces."""
    return bool(obj.data.total_edge_sel and mesh_io.read_edit_mesh(obj, FairOptions()).in_patch.any())


def read(context: bpy.types.Context, options: FairOptions) -> list[Session]:
    """Read every object in edit mode that has a selection; raises Refused."""
    edited = edited_objects(context)
    chosen = [obj for obj in edited if obj.data.total_face_sel] or [obj for obj in edited if enclosing(obj)]
    found = []
    for obj in chosen:
        with refusing(obj.name):
            found.append(candidate(obj, options))
    return found


def first(session: Session, progress: Progress | None) -> Found:
    """Find a new region's surface, however long that takes; raises what engine.REFUSALS lists where there is none."""
    found = sought(session.region, session.positions, session.matrix, progress, inf)
    if found.positions is None:
        raise fairing.SolverError(said("no_surface_for_region"))
    return found


@dataclass
class LiveRequest(Request):
    candidates: list[Session]
    options: FairOptions

    @property
    def size(self) -> int:
        return sum(len(session.region.free) for session in self.candidates)

    def work(self, progress: Progress) -> list[Found]:
        return each_of(self.candidates, first, progress)

    def is_as_read(self, context: bpy.types.Context) -> bool:
        objects = objects_in_mode(context)
        return context.mode == "EDIT_MESH" and all(
            each.object_name in objects and is_current(objects[each.object_name], each) for each in self.candidates
        )

    def finish(self, context: bpy.types.Context, answers: list[Found], _say: Say) -> set[str]:
        objects = objects_in_mode(context)
        for session, found in zip(self.candidates, answers, strict=True):
            live.take(objects[session.object_name], session, self.options, found)
        context.window_manager.fairing_live.on = True
        return {"FINISHED"}


class MESH_OT_fair_live_region(Watched, bpy.types.Operator):
    """Make the selected faces the live region of their mesh, fair now and after every change around them.
    The options are those of the last Fair Region; the region is saved with the mesh"""

    bl_idname = "mesh.fair_live_region"
    bl_label = "Live Region"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 - the form that Blender asks for

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require_edit_mode(cls, context, SELECT_FACES) and require_idle(cls, context)

    def _read(self, context: bpy.types.Context) -> LiveRequest | None:
        options = last_options(context)
        candidates = read(context, options)
        if not candidates:
            self.report({"ERROR"}, translated(NO_FACE))
            return None
        return LiveRequest(candidates, options)
