"""When an operator can run, and the reason that its button shows where it can't."""

from __future__ import annotations

from typing import Any

import bpy

from ..translations import translated
from ..words.words import said

SELECT_FACES = said("select_faces")
IN_EDIT_MODE = said("in_edit_mode")
NO_FACE = said("no_face")
NO_FREE = said("no_free")


def require(operator: Any, met: bool, otherwise: str) -> bool:
    """Return `met`; where it is False the operator says `otherwise`."""
    if not met:
        operator.poll_message_set(translated(otherwise))
    return met


def require_idle(operator: Any, context: bpy.types.Context) -> bool:
    """Return whether no run is under way, which has the mesh to itself."""
    idle = not context.window_manager.fairing_progress.running
    return require(operator, idle, said("under_way"))


def require_edit_mode(operator: Any, context: bpy.types.Context, otherwise: str = IN_EDIT_MODE) -> bool:
    """Return whether a mesh is being edited."""
    return require(operator, context.mode == "EDIT_MESH", otherwise)
