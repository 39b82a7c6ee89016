"""What makes a result unusable: no answer, folds, crossings."""

from __future__ import annotations

import numpy as np

from .arrays import Ints
from .engine import Problem, bad_outline
from .evidence import NOTHING, Evidence, Found, corners_of
from .options import FairOptions
from .words import counted

_ROUGH_BORDER = ": a fair border may not exist where it is rough beside the selection; turn Fair Open Borders off"
# It uses up its steps on most real meshes.
_MULTIGRID = ": Method: Multigrid did not get there. Method: Global finds it more often, and at once"


def failing(evidence: Evidence, options: FairOptions) -> Found:
    """Return the first reason, with its places."""
    for look in (_no_answer, _folded, _crossing):
        reason = look(evidence, options)
        if reason[0]:
            return reason
    return NOTHING


def _no_answer(evidence: Evidence, options: FairOptions) -> Found:
    result, patch = evidence.result, evidence.problem.patch
    if result.converged or result.termination == "folded":
        return NOTHING
    reason = evidence.failures[0] if evidence.failures else "No fair surface was found"
    reason += _ending(evidence, options)
    return reason, _troubled(evidence.problem) if len(evidence.problem.outside) else patch.vertices[patch.outline]


def _ending(evidence: Evidence, options: FairOptions) -> str:
    """Return how the search ended, where the engine does not say why, and what there is instead."""
    if options.fairs_border:
        return _ROUGH_BORDER
    if options.method == "PAPER":
        return _MULTIGRID
    if any(evidence.reported("NOT_CONVERGED", "load_share", "area", "from_behind")):
        return ""
    count = evidence.result.iterations
    text = ": the search came to a halt" if count else ": no initial surface was found"
    if evidence.result.termination != "stalled":
        text = f": it was not there after the {counted(count, 'step', 'steps')} that Iterations allows"
    after = evidence.after
    if len(after.folded) or (after.crossing is not None and len(after.crossing)) or len(evidence.join.seen):
        return text
    return f"{text}. What it came to has no folds and no kinks"


def _troubled(problem: Problem) -> Ints:
    """Return the bad vertices of the boundary, or all of it where none stands out."""
    outline = problem.patch.vertices[np.intersect1d(problem.patch.outline, problem.outside)]
    bad = bad_outline(problem)
    return bad if len(bad) else outline


def _folded(evidence: Evidence, options: FairOptions) -> Found:
    after = evidence.after.folded
    if options.detail > 0.0:
        after = np.setdiff1d(after, evidence.before.folded)  # the skin's own folds come back with it
    if options.factor < 1.0 and len(after) <= len(evidence.before.folded):
        return NOTHING  # half-way to a fair surface something of the old one is left
    if evidence.result.termination == "folded" and not len(after):
        return _named_folds(evidence)
    if not len(after):
        return NOTHING
    text = counted(len(after), "face of the result is folded over", "faces of the result are folded over")
    corners, patch = corners_of(evidence.problem, after), evidence.problem.patch
    pins = np.intersect1d(corners, patch.vertices[np.setdiff1d(patch.fixed, patch.outline)])
    if len(pins):
        text += f", at {counted(len(pins), 'pinned vertex', 'pinned vertices')}"
    return text, corners


def _named_folds(evidence: Evidence) -> Found:
    """Return the engine's sentence on folds that show as crossings only."""
    reason = evidence.failures[0] if evidence.failures else "The surface can't be reached without folds"
    return reason, evidence.named("FOLDED")


def _crossing(evidence: Evidence, options: FairOptions) -> Found:
    before, after = evidence.before.crossing, evidence.after.crossing
    if after is None or not len(after):
        return NOTHING
    new = after if before is None else np.setdiff1d(after, before)
    if options.factor < 1.0 and before is not None and len(after) <= len(before):
        return NOTHING
    if not len(new):
        return NOTHING
    text = counted(
        len(new),
        "face of the result passes through others, which it did not before",
        "faces of the result pass through others, which they did not before",
    )
    return text, corners_of(evidence.problem, new)
