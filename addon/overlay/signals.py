"""What Blender calls when a setting of the overlay or Live changes, handed on to whoever listens.

Blender 4.2 never lets go of a property's callback, and its Python module crashes at exit where one
leads to bpy. So this module knows nothing of Blender.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

listeners: dict[str, Callable[[Any], None]] = {}


def content_changed(_settings: object, context: Any) -> None:
    _tell("content", context)


def look_changed(_settings: object, context: Any) -> None:
    _tell("look", context)


def live_changed(_settings: object, context: Any) -> None:
    _tell("live", context)


def _tell(kind: str, context: Any) -> None:
    if kind in listeners:
        listeners[kind](context)
