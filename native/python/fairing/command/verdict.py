"""Whether a result may be used without looking at it."""

from __future__ import annotations

from typing import Any

import numpy as np

GOOD, LOOK, UNUSABLE = "good", "look", "unusable"
VISIBLE = 12.0  # degrees at the join; docs/python.md, "What comes back"
_BROKEN = {"FOLDED", "FLIPPED_TRIANGLES", "SELF_INTERSECTION"}
_HARMLESS = {"PIN_NORMAL_IGNORED", "INCONSISTENT_WINDING", "DEGENERATE_FACE", "NOT_A_HOLE"}


def judged(result: Any) -> tuple[str, str]:
    """GOOD, LOOK or UNUSABLE, and why; of what `fair`, `fill` or `fillet` give back."""
    broken = [warning for warning in result.warnings if warning.code in _BROKEN]
    if not result.converged or broken:
        return UNUSABLE, broken[0].message if broken else f"no surface was found: {result.termination}"
    for warning in result.warnings:
        if warning.code not in _HARMLESS:
            return LOOK, warning.message
    for left in getattr(result, "left_because", ()):
        if left.code not in _HARMLESS:
            return LOOK, f"a loop stays open: {left.message}"
    worst = float(np.max(result.join, initial=0.0))
    return (LOOK, f"a kink of {worst:.0f}° at the join") if worst > VISIBLE else (GOOD, "")
