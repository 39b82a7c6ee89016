"""Whether a result may be used without looking at it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from fairing._types import Diagnostic

GOOD, LOOK, UNUSABLE = "good", "look", "unusable"
VISIBLE = 12.0  # degrees at the join; docs/python.md, "What comes back"
_BROKEN = {"FOLDED", "FLIPPED_TRIANGLES", "SELF_INTERSECTION"}
_HARMLESS = {"PIN_NORMAL_IGNORED", "INCONSISTENT_WINDING", "DEGENERATE_FACE", "NOT_A_HOLE"}


def judged(result: Any) -> tuple[str, str]:
    """GOOD, LOOK or UNUSABLE, and why; of what `fair`, `fill` or `fillet` give back."""
    broken = [each for each in result.warnings if each.code in _BROKEN and "others" not in each.figures]
    if not result.converged or broken:
        return UNUSABLE, broken[0].message if broken else f"no surface was found: {result.termination}"
    for warning in _serious(result.warnings):
        return LOOK, warning.message
    for left in _serious(getattr(result, "left_because", ())):
        return LOOK, f"a loop stays open: {left.message}"
    worst = float(np.max(result.join, initial=0.0))
    if worst > VISIBLE:
        return LOOK, f"a kink of {worst:.0f}° at the join"
    return GOOD, "; ".join(dict.fromkeys(each.message for each in result.warnings if each.code == "NOT_A_HOLE"))


def _serious(found: Iterable[Diagnostic]) -> list[Diagnostic]:
    return [each for each in found if each.code not in _HARMLESS]
