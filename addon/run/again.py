# mypy: disable-error-code="valid-type"
"""Buttons after a run: run once more with one change.

No postponed annotations here: Blender reads them as property definitions.
"""

from dataclasses import asdict, replace
from typing import Any

import bpy
from bpy.props import EnumProperty

from ..host.polling import require, require_edit_mode
from ..verdict.verdict import (
    ADD_LEFT_OUT,
    ALL_KEYS,
    AS_SELECTED,
    EVEN_CURVATURE,
    EVEN_SPREAD,
    GROW,
    GROW_OVER,
    HOLD_BORDER,
    KEEP_DETAIL,
    SMOOTH_OUTLINE,
    WRITE,
)
from ..words.words import said
from . import compare, last_run

# What each button changes in the options.
CHANGES: dict[str, dict[str, Any]] = {
    ALL_KEYS: {"all_keys": True},
    KEEP_DETAIL: {"detail": 1.0},
    ADD_LEFT_OUT: {},
    GROW: {},
    GROW_OVER: {},
    SMOOTH_OUTLINE: {"smooth_boundary": True},
    AS_SELECTED: {"smooth_boundary": False},
    HOLD_BORDER: {"fair_open_borders": False},
    EVEN_CURVATURE: {"shape": "LEAST_VARIATION"},
    EVEN_SPREAD: {"inner_fairness": "UNIFORM"},
    WRITE: {"allow_folds": True},
}
_WAYS = (
    (ALL_KEYS, "All Keys", "Fair every shape key as well, each from its own surroundings"),
    (KEEP_DETAIL, "Keep Detail", "Fair again, and put the old skin back on the new shape"),
    (ADD_LEFT_OUT, "Add Left-Out Faces", "Select the faces as well that were left out within, and fair again"),
    (GROW, "Grow by a Ring", "Select one ring of faces more and fair again"),
    (GROW_OVER, "Grow Past Bump", "Select as many rings of faces more as the slope is wide, and fair again"),
    (SMOOTH_OUTLINE, "Smooth Boundary", "Smooth the boundary and the two rings around it, and fair again"),
    (AS_SELECTED, "Boundary As Selected", "Leave the boundary and what is around it where it is, and fair again"),
    (HOLD_BORDER, "Hold Open Border", "Leave open borders where they are, and fair again"),
    (EVEN_CURVATURE, "Least Variation", "Fair again with the shape Least Variation, which exists more often"),
    (EVEN_SPREAD, "Spread Uniformly", "Fair again with edges of equal length, whatever the old mesh was like"),
    (WRITE, "Apply Anyway", "Write the result as it is, folds and all"),
)
# What helps most where several are offered.
_ORDER = (
    ALL_KEYS,
    ADD_LEFT_OUT,
    GROW_OVER,
    KEEP_DETAIL,
    AS_SELECTED,
    HOLD_BORDER,
    EVEN_SPREAD,
    EVEN_CURVATURE,
    GROW,
    SMOOTH_OUTLINE,
    WRITE,
)
WAY_NAMES = {identifier: name for identifier, name, _ in _WAYS}


def best_first(remedies: str) -> list[str]:
    """Return the ways that a report names, what helps most first."""
    known = {way: k for k, way in enumerate(_ORDER)}
    return sorted(filter(None, remedies.split(",")), key=lambda way: known.get(way, -1))


class MESH_OT_fair_again(bpy.types.Operator):
    """Fair the region of the last run once more"""

    bl_idname = "mesh.fair_again"
    bl_label = "Fair Again"
    # No UNDO of its own: the run that it starts has one, and the redo panel.

    way: EnumProperty(name="Change", description="What is changed in the options", items=_WAYS, default=GROW)

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: Any) -> str:
        return next(text for identifier, _, text in _WAYS if identifier == properties.way)

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return require_edit_mode(cls, context) and require(cls, last_run.has_regions(), said("nothing_faired"))

    def execute(self, context: bpy.types.Context) -> set[str]:
        """Select what the last run had, change one thing, run; what is no better than before isn't written."""
        options = replace(last_run.options(), **{"allow_folds": False, **CHANGES[self.way]})
        status, goes_back = {"CANCELLED"}, False
        try:
            goes_back = self.way == KEEP_DETAIL and compare.is_shown(context)  # the skin is gone from the result
            if goes_back:
                compare.show(context, result=False)
            last_run.select_region(context)
            if self.way == ADD_LEFT_OUT:
                bpy.ops.mesh.fair_select(what="LEFT_OUT")
            for _ in range({GROW: 1, GROW_OVER: last_run.rings()}.get(self.way, 0)):
                bpy.ops.mesh.select_more()
            bpy.ops.ed.undo_push(message="Select Region")  # what the redo panel goes back to
            last_run.try_way("" if self.way == WRITE else self.way)
            how = "EXEC_DEFAULT" if bpy.app.background or context.window is None else "INVOKE_DEFAULT"
            status = bpy.ops.mesh.fair_region(how, True, **asdict(options))
        except (last_run.Changed, compare.Changed, RuntimeError) as error:  # RuntimeError: what the run has reported
            self.report({"ERROR"}, str(error).removeprefix("Error: ").strip())
            return {"CANCELLED"}
        finally:
            last_run.try_way("")  # a run that did not begin has not taken it
            if goes_back and "CANCELLED" in status:
                compare.show(context, result=True)
        return {"CANCELLED"} if "CANCELLED" in status else {"FINISHED"}
