"""Whether a result is good, worth a look, or nothing that should be written; with where and why."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np

import fairing

from ..arrays.region import nothing
from ..arrays.types import Ints
from ..fair.engine import Result
from ..options.options import FairOptions
from .evidence import Evidence
from .failings import failing, is_usable
from .looks import visible

GOOD, LOOK, UNUSABLE = "GOOD", "LOOK", "UNUSABLE"
GRADES = (GOOD, LOOK, UNUSABLE)

# What may help, each a change for another run.
AS_SELECTED, HOLD_BORDER, EVEN_SPREAD, WRITE = "AS_SELECTED", "HOLD_BORDER", "EVEN_SPREAD", "WRITE"
ADD_LEFT_OUT, ALL_KEYS = "ADD_LEFT_OUT", "ALL_KEYS"


@dataclass(frozen=True)
class Verdict:
    """One grade, and for all but GOOD a sentence, the mesh vertices that it is about (worst kink first), what helps."""

    grade: str
    reason: str = ""
    spots: Ints = field(default_factory=nothing)
    remedies: tuple[str, ...] = ()


class NotUsable(fairing.SolverError):
    """The result was not written: it folds, crosses itself, or is none. `result` has it, `elements` the vertices."""

    def __init__(self, verdict: Verdict, result: Result) -> None:
        super().__init__(verdict.reason)
        self.elements = verdict.spots
        self.result = result


def judge(evidence: Evidence, options: FairOptions) -> Verdict:
    """Return the verdict on what would be written."""
    reason, spots = failing(evidence, options)
    if reason:
        bad = not (_calms(evidence) or is_usable(evidence, options))
        remedies = _remedies(evidence, options, bad)
        return Verdict(UNUSABLE if bad else LOOK, reason, np.unique(spots), remedies)
    reason, spots = visible(evidence, options)
    if reason:
        return Verdict(LOOK, reason, _once(spots), _remedies(evidence, options, bad=False))
    return Verdict(GOOD)


def worst(verdicts: Iterable[Verdict]) -> Verdict:
    """Return the first of the worst."""
    return max(verdicts, key=lambda verdict: GRADES.index(verdict.grade))


def because_of(verdict: Verdict, causes: tuple[str, ...]) -> Verdict:
    """Return the verdict, where nothing usable came out with the first of what must be the cause for its reason."""
    return replace(verdict, reason=causes[0]) if causes and verdict.grade == UNUSABLE else verdict


def _calms(evidence: Evidence) -> bool:
    """Return whether a smooth surface lies next to a jagged boundary, with fewer folds and crossings than there were.

    Those that are left hang on the boundary, which has to stay.
    """
    low_passed = any(evidence.reported("NO_SOLUTION", "distance"))
    before, after = evidence.seen.before, evidence.seen.after
    if not (evidence.result.converged and low_passed and len(after.folded) < len(before.folded)):
        return False
    return before.crossing is None or after.crossing is None or len(after.crossing) < len(before.crossing)


def _once(spots: Ints) -> Ints:
    """Return each of them once, in the order of their first."""
    first: Ints = spots[np.sort(np.unique(spots, return_index=True)[1])]
    return first


def _remedies(evidence: Evidence, options: FairOptions, bad: bool) -> tuple[str, ...]:
    offered = {
        ALL_KEYS: len(evidence.lost.key) > 0,
        ADD_LEFT_OUT: evidence.left_out.count > 0,
        EVEN_SPREAD: bad and _is_folded(evidence) and not options.remesh and options.inner_fairness != "UNIFORM",
        AS_SELECTED: len(evidence.seen.rounded) > 0 and options.smooth_boundary,
        HOLD_BORDER: (bad or len(evidence.lost.border) > 0) and options.fair_open_borders,
        WRITE: bad and not options.allow_folds,
    }
    return tuple(name for name, offer in offered.items() if offer)


def _is_folded(evidence: Evidence) -> bool:
    return evidence.result.termination == "folded" or len(evidence.seen.after.folded) > 0
