"""Whether a result may be used without looking at it."""

from __future__ import annotations

from typing import Any

import numpy as np

from fairing import looks
from fairing.results import FOLDS, FillResult, Hole

GOOD, LOOK, UNUSABLE = "good", "look", "unusable"


def judged(result: Any) -> tuple[str, str]:
    """GOOD, LOOK or UNUSABLE, and why; of what `fair`, `fill` or `fillet` give back."""
    broken = [each for each in result.warnings if each.code in FOLDS and "others" not in each.figures]
    share = np.count_nonzero(result.join > looks.LIMITS["visible_kink"]) / max(len(result.join), 1)
    kinked = share > looks.LIMITS["kink_share"]
    name = looks.fault(result, folded=bool(broken), crossing=False, kinked=kinked)
    if name in looks.UNUSABLE:
        return UNUSABLE, broken[0].message if broken else f"no surface was found: {result.termination}"
    return (LOOK if name else GOOD), name.replace("_", " ")


def judged_holes(result: FillResult) -> tuple[str, str, list[tuple[str, str]]]:
    """The same of all holes together, and of each."""
    each = [_of_hole(hole) for hole in result.holes]
    bad, odd = ([reason for grade, reason in each if grade == wanted] for wanted in (UNUSABLE, LOOK))
    odd += [warning.message for warning in result.warnings if "others" in warning.figures]
    notes = [reason for grade, reason in each if grade == GOOD and reason]
    reasons = [f"{len(bad)} of {len(each)} holes can't be filled: {bad[0]}"] if bad else []
    grade = UNUSABLE if bad and len(bad) + len(notes) == len(each) else LOOK if bad or odd else GOOD
    return grade, "; ".join(reasons + odd[:1] + notes[:1]), each


def _of_hole(hole: Hole) -> tuple[str, str]:
    if hole.surface is not None:
        return judged(hole.surface)
    because = hole.left_because
    assert because is not None
    return (GOOD if because.code in ("NOT_A_HOLE", "DEGENERATE_FACE") else UNUSABLE), because.message
