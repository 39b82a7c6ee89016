"""What makes a result unusable: no answer, folds, crossings."""

from __future__ import annotations

import numpy as np

from ..arrays.types import Ints
from ..fair.engine import Problem, bad_outline
from ..options.options import FairOptions
from ..words.words import said
from .evidence import NOTHING, Evidence, Found, corners_of


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
    reason = evidence.failures[0] if evidence.failures else said("no_fair_surface")
    reason = _ended(reason, evidence, options)
    return reason, _troubled(evidence.problem) if len(evidence.problem.outside) else patch.vertices[patch.boundary]


def _ended(reason: str, evidence: Evidence, options: FairOptions) -> str:
    """Add how the search ended, where the engine does not say why, and what there is instead."""
    if options.fair_open_borders:
        return said("rough_border", reason=reason)
    if _tells_why(evidence):
        return reason
    count = evidence.result.iterations
    text = said("halted" if count else "no_initial_surface", reason=reason)
    if evidence.result.termination != "stalled":
        text = said("steps_ran_out", reason=reason, n=count)
    return said("usable_so_far", reason=text) if is_usable(evidence, options) else text


def _tells_why(evidence: Evidence) -> bool:
    """Return whether the engine knows why there is no such surface."""
    return any(evidence.reported("NOT_CONVERGED", "load_share", "area", "from_behind"))


def is_usable(evidence: Evidence, options: FairOptions) -> bool:
    """Return whether what a search without an answer came to shows nothing that is wrong: it is written, and named."""
    result, after = evidence.result, evidence.seen.after
    if result.converged or result.termination == "folded" or options.fair_open_borders or _tells_why(evidence):
        return False
    return not (
        len(after.folded) or (after.crossing is not None and len(after.crossing)) or len(evidence.seen.join.seen)
    )


def _troubled(problem: Problem) -> Ints:
    """Return the bad vertices of the boundary, or all of it where none stands out."""
    boundary = problem.patch.vertices[np.intersect1d(problem.patch.boundary, problem.outside)]
    bad = bad_outline(problem)
    return bad if len(bad) else boundary


def _folded(evidence: Evidence, options: FairOptions) -> Found:
    after = evidence.seen.after.folded
    if options.detail > 0.0:
        after = np.setdiff1d(after, evidence.seen.before.folded)  # the skin's own folds come back with it
    if options.factor < 1.0 and len(after) <= len(evidence.seen.before.folded):
        return NOTHING  # half-way to a fair surface something of the old one is left
    if evidence.result.termination == "folded" and not len(after):
        return _named_folds(evidence)
    if not len(after):
        return NOTHING
    text = said("folded_faces", n=len(after))
    corners, patch = corners_of(evidence.problem, after), evidence.problem.patch
    pins = np.intersect1d(corners, patch.vertices[np.setdiff1d(patch.fixed, patch.boundary)])
    if len(pins):
        text = said("at_pins", reason=text, n=len(pins))
    return text, corners


def _named_folds(evidence: Evidence) -> Found:
    """Return the engine's sentence on folds that show as crossings only."""
    reason = evidence.failures[0] if evidence.failures else said("only_with_folds")
    return reason, evidence.named("FOLDED")


def _crossing(evidence: Evidence, options: FairOptions) -> Found:
    before, after = evidence.seen.before.crossing, evidence.seen.after.crossing
    if after is None or not len(after):
        return NOTHING
    new = after if before is None else np.setdiff1d(after, before)
    if options.factor < 1.0 and before is not None and len(after) <= len(before):
        return NOTHING
    if not len(new):
        return NOTHING
    return said("new_crossings", n=len(new)), corners_of(evidence.problem, new)
