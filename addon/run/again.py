# mypy: disable-error-code="valid-type"
"""Buttons after a run: run once more with one change.

No postponed annotations here: Blender reads them as property definitions.
"""

from dataclasses import asdict, replace
from typing import Any

import bpy
import numpy as np
from bpy.props import EnumProperty

from ..host.polling import require, require_edit_mode
from ..options.options import FairOptions
from ..selection.selection import left_out_faces
from ..verdict.verdict import ADD_LEFT_OUT, ALL_KEYS, AS_SELECTED, EVEN_SPREAD, HOLD_BORDER, WRITE
from ..words.words import said
from . import job, last_run

# Each button, what helps most first: what it changes in the options, its name and its tooltip.
_REMEDIES: dict[str, tuple[dict[str, Any], str, str]] = {
    ALL_KEYS: ({"all_keys": True}, "All Keys", "Fair every shape key as well, each from its own surroundings"),
    ADD_LEFT_OUT: ({}, "Add Left-Out Faces", "Add gaps of up to four faces that the lasso missed, and fair again"),
    AS_SELECTED: (
        {"smooth_boundary": False},
        "Boundary As Selected",
        "Leave the boundary and what is around it where it is, and fair again",
    ),
    HOLD_BORDER: (
        {"fair_open_borders": False}, "Hold Open Border", "Leave open borders where they are, and fair again"
    ),
    EVEN_SPREAD: (
        {"inner_fairness": "UNIFORM"},
        "Spread Uniformly",
        "Fair again with edges of equal length, whatever the old mesh was like",
    ),
    WRITE: ({"allow_folds": True}, "Apply Anyway", "Write the result as it is, folds and all"),
}  # fmt: skip
_ITEMS = tuple((remedy, name, text) for remedy, (_, name, text) in _REMEDIES.items())
REMEDY_NAMES = {remedy: name for remedy, name, _ in _ITEMS}


def best_first(remedies: str) -> list[str]:
    """Return the remedies that a report names, what helps most first."""
    return [remedy for remedy in _REMEDIES if remedy in remedies.split(",")]


class MESH_OT_fair_again(bpy.types.Operator):
    """Fair the region of the last run once more"""

    bl_idname = "mesh.fair_again"
    bl_label = "Fair Again"
    # No UNDO of its own: the run that it starts has one, and the redo panel.

    remedy: EnumProperty(
        name="Change", description="What is changed in the options", items=_ITEMS, default=ADD_LEFT_OUT
    )

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: Any) -> str:
        return _REMEDIES[properties.remedy][2]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require_edit_mode(cls, context) and require(cls, last_run.has_regions(), said("nothing_faired"))

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Run on what the last run had, with one change; what is no better than before isn't written."""
        options = replace(last_run.options(), **{"allow_folds": False, **_REMEDIES[self.remedy][0]})
        status = {"CANCELLED"}
        try:
            faces = last_run.faces(context)
            if self.remedy == ADD_LEFT_OUT:
                read = {task.object_name: task.mesh for task in job.read(context, FairOptions(), faces)}
                faces = {name: np.flatnonzero(left_out_faces(mesh) | mesh.in_patch) for name, mesh in read.items()}
            last_run.try_remedy("" if self.remedy == WRITE else self.remedy, faces)
            how = "EXEC_DEFAULT" if bpy.app.background or context.window is None else "INVOKE_DEFAULT"
            status = bpy.ops.mesh.fair_region(how, True, **asdict(options))
        except (last_run.Changed, job.Refused, RuntimeError) as error:  # RuntimeError: what the run has reported
            self.report({"ERROR"}, str(error).removeprefix("Error: ").strip())
            return {"CANCELLED"}
        finally:
            last_run.take_remedy()  # cleared here, too, if no run has taken it
        return {"CANCELLED"} if "CANCELLED" in status else {"FINISHED"}
