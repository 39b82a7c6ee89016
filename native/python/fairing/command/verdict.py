"""Whether a result may be used without looking at it."""

from __future__ import annotations

from typing import Any

import numpy as np

from fairing import looks
from fairing.results import FOLDS, FillResult, Hole

GOOD, LOOK, UNUSABLE = "good", "look", "unusable"
_HARMLESS = ("NOT_A_HOLE", "DEGENERATE_FACE")


def judged(result: Any) -> tuple[str, str]:
    """GOOD, LOOK or UNUSABLE, and why; of what `fair`, `fill` or `fillet` give back."""
    broken = [each for each in result.warnings if each.code in FOLDS and "others" not in each.figures]
    bent = result.join > looks.LIMITS["visible_kink"]
    name = looks.fault(
        result, folded=bool(broken), crossing=False, kinked=bool(bent.sum() > looks.LIMITS["kink_share"] * len(bent))
    )
    if name in looks.UNUSABLE:
        return UNUSABLE, broken[0].message if broken else f"no surface was found: {result.termination}"
    degrees = f" of {np.max(result.join, initial=0.0):.0f}° at the join" if name == "kink" else ""
    return (LOOK if name else GOOD), name.replace("_", " ") + degrees


def judged_holes(result: FillResult) -> tuple[str, str, list[tuple[str, str]]]:
    """The same of all holes together, and of each."""
    each = [_of_hole(hole) for hole in result.holes]
    bad, odd = ([reason for grade, reason in each if grade == wanted] for wanted in (UNUSABLE, LOOK))
    odd += [warning.message for warning in result.warnings if "others" in warning.figures]
    notes = [reason for grade, reason in each if grade == GOOD and reason]
    reasons = [f"{len(bad)} of {len(each)} holes can't be filled: {bad[0]}"] if bad else []
    reasons += [f"{odd[0]} ({len(odd)} times)" if len(odd) > 1 else odd[0]] if odd else []
    if len(bad) + len(notes) == len(each):
        return (UNUSABLE if bad else GOOD), "; ".join(reasons + notes[:1]), each
    return (LOOK if reasons else GOOD), "; ".join(reasons or notes[:1]), each


def _of_hole(hole: Hole) -> tuple[str, str]:
    if hole.surface is not None:
        return judged(hole.surface)
    assert hole.left_because is not None
    return (GOOD if hole.left_because.code in _HARMLESS else UNUSABLE), hole.left_because.message
