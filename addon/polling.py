"""When an operator can run, and the reason that its button shows where it can't."""

from __future__ import annotations

from typing import Any

import bpy

SELECT_FACES = "Select faces of a mesh in edit mode"


def require(operator: Any, met: bool, otherwise: str) -> bool:
    """Return `met`; where it is False the operator says `otherwise`."""
    if not met:
        operator.poll_message_set(otherwise)
    return met


def require_edit_mode(operator: Any, context: bpy.types.Context, otherwise: str = "Only in edit mode") -> bool:
    """Tell whether a mesh is being edited."""
    return require(operator, context.mode == "EDIT_MESH", otherwise)
