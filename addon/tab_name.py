"""What Blender calls when the name of the sidebar's tab changes; like overlay/signals.py without it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

USUAL = "Fairing"
listeners: list[Callable[[], None]] = []


def changed(_preferences: object, _context: Any) -> None:
    """The panels belong into another tab."""
    for listener in listeners:
        listener()
