"""Whether a result is good, worth a look, or nothing that should be written; with where and why."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

import fairing

from .arrays import Ints
from .engine import Problem, Result, bad_outline
from .options import FairOptions
from .quality import Join, Quality
from .region import nothing
from .words import counted

GOOD, LOOK, UNUSABLE = "GOOD", "LOOK", "UNUSABLE"
GRADES = (GOOD, LOOK, UNUSABLE)

# What may help, each a way to run once more.
GROW, SMOOTH_OUTLINE, AS_SELECTED, HOLD_BORDER = "GROW", "SMOOTH_OUTLINE", "AS_SELECTED", "HOLD_BORDER"
EVEN_CURVATURE, WRITE = "EVEN_CURVATURE", "WRITE"


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


@dataclass(frozen=True)
class Evidence:
    """What a verdict follows from."""

    problem: Problem
    result: Result
    failures: tuple[str, ...]  # the engine's own words for why there is no answer
    before: Quality
    after: Quality
    join: Join
    rounded: Ints = field(default_factory=nothing)  # mesh vertices of hard edges outside that were rounded
    swollen: Ints = field(default_factory=nothing)  # mesh vertices at the tops of knobs


def judge(evidence: Evidence, options: FairOptions) -> Verdict:
    """Return the verdict on what would be written."""
    for found in (_no_answer, _folded, _crossing):
        reason, spots = found(evidence, options)
        if reason:
            bad = not _calms(evidence)
            return Verdict(UNUSABLE if bad else LOOK, reason, np.unique(spots), _remedies(evidence, options, bad))
    reason, spots = _visible(evidence, options)
    if reason:
        return Verdict(LOOK, reason, _once(spots), _remedies(evidence, options, bad=False))
    return Verdict(GOOD)


def _calms(evidence: Evidence) -> bool:
    """Tell whether a smooth surface lies beside a jagged outline, with fewer folds and crossings than there were.

    Those that are left hang on the outline, which has to stay.
    """
    eased = any(told.code == "NO_SOLUTION" and "distance" in told.figures for told in evidence.result.warnings)
    before, after = evidence.before, evidence.after
    if not (evidence.result.converged and eased and len(after.folded) < len(before.folded)):
        return False
    return before.crossing is None or after.crossing is None or len(after.crossing) < len(before.crossing)


def _once(spots: Ints) -> Ints:
    """Return each of them once, in the order of their first."""
    first: Ints = spots[np.sort(np.unique(spots, return_index=True)[1])]
    return first


Found = tuple[str, Ints]
_NOTHING: Found = ("", nothing())


def _remedies(evidence: Evidence, options: FairOptions, bad: bool) -> tuple[str, ...]:
    has_outside = len(evidence.problem.outside) > 0
    was_tried = any(name == "variation" for name, _ in evidence.result.way)
    offered = {
        GROW: has_outside,
        SMOOTH_OUTLINE: has_outside and options.outline == "GIVEN" and options.mesh == "KEEP",
        AS_SELECTED: len(evidence.rounded) > 0,
        HOLD_BORDER: bad and options.fairs_border,
        EVEN_CURVATURE: bad and not was_tried and options.equation in ("HARMONIC", "MINIMAL_ENERGY"),
        WRITE: bad and options.accept != "ALL",
    }
    return tuple(name for name, offer in offered.items() if offer)


def _no_answer(evidence: Evidence, _options: FairOptions) -> Found:
    result, patch = evidence.result, evidence.problem.patch
    if result.converged or result.termination == "folded":
        return _NOTHING
    reason = evidence.failures[0] if evidence.failures else "No fair surface was found"
    return reason, _troubled(evidence.problem) if len(evidence.problem.outside) else patch.vertices[patch.outline]


def _troubled(problem: Problem) -> Ints:
    """Return the bad vertices of the outline, or all of it where none stands out."""
    outline = problem.patch.vertices[np.intersect1d(problem.patch.outline, problem.outside)]
    bad = bad_outline(problem)
    return bad if len(bad) else outline


def _corners(problem: Problem, faces: Ints) -> Ints:
    patch = problem.patch
    corners: Ints = np.unique(patch.vertices[patch.triangles[np.isin(patch.faces, faces)]])
    return corners


def _folded(evidence: Evidence, options: FairOptions) -> Found:
    after = evidence.after.folded
    if options.detail > 0.0:
        after = np.setdiff1d(after, evidence.before.folded)  # the skin's own folds come back with it
    if options.factor < 1.0 and len(after) <= len(evidence.before.folded):
        return _NOTHING  # half-way to a fair surface something of the old one is left
    if evidence.result.termination == "folded" and not len(after):
        return _named_folds(evidence)
    if not len(after):
        return _NOTHING
    text = counted(len(after), "face of the result is folded over", "faces of the result are folded over")
    return text, _corners(evidence.problem, after)


def _named_folds(evidence: Evidence) -> Found:
    """Tell what the engine tells of folds that show as crossings only."""
    patch = evidence.problem.patch
    named = [warning.elements for warning in evidence.result.warnings if warning.code == "FOLDED"]
    triangles = np.concatenate([np.empty(0, np.int32), *named])
    reason = evidence.failures[0] if evidence.failures else "The surface can't be reached without folds"
    return reason, patch.vertices[patch.triangles[triangles].ravel()]


def _crossing(evidence: Evidence, options: FairOptions) -> Found:
    before, after = evidence.before.crossing, evidence.after.crossing
    if after is None or not len(after):
        return _NOTHING
    new = after if before is None else np.setdiff1d(after, before)
    if options.factor < 1.0 and before is not None and len(after) <= len(before):
        return _NOTHING
    if not len(new):
        return _NOTHING
    text = counted(
        len(new),
        "face of the result passes through others, which it did not before",
        "faces of the result pass through others, which they did not before",
    )
    return text, _corners(evidence.problem, new)


def _visible(evidence: Evidence, options: FairOptions) -> Found:
    problem, join = evidence.problem, evidence.join
    seen = join.seen
    if len(seen) and judges_join(options):
        text = counted(len(seen), "vertex", "vertices")
        return f"A kink shows at {text} of the outline, of {join.worst:.0f}° at worst", seen
    kinks = _kinks_of_loft(evidence)
    if len(kinks) and judges_join(options):
        text = counted(len(kinks), "vertex", "vertices")
        return f"The loft does not continue the slope of its surroundings at {text} of the outline", kinks
    tips = _told_of(evidence, "PINS_NOT_SPREAD", "tips")
    if len(tips):
        return f"The surface comes to a point at {counted(len(tips), 'pinned vertex', 'pinned vertices')}", tips
    if len(evidence.rounded):
        text = counted(len(evidence.rounded), "vertex", "vertices")
        return f"Outline: Smooth has rounded a hard edge outside at {text}: choose As Selected", evidence.rounded
    if len(evidence.swollen) and judges_join(options) and not _is_meant_to_swell(options):
        text = counted(len(evidence.swollen), "vertex", "vertices")
        return f"The surface swells to a knob around {text}: another outline may avoid it", evidence.swollen
    needles = np.setdiff1d(evidence.after.needles, evidence.before.needles)
    if len(needles):
        return counted(len(needles), "face is a needle", "faces are needles"), _corners(problem, needles)
    return _NOTHING


def _kinks_of_loft(evidence: Evidence) -> Ints:
    """Return the mesh vertices where a loft leaves the tangent planes; dihedral angles show it on fine meshes only."""
    return _told_of(evidence, "NO_SOLUTION", "kinks")


def _told_of(evidence: Evidence, code: str, figure: str) -> Ints:
    """Return the mesh vertices that the engine names with a code and a figure."""
    told = [w.elements for w in evidence.result.warnings if w.code == code and figure in w.figures]
    found: Ints = evidence.problem.vertices[np.concatenate([np.empty(0, np.int32), *told])]
    return found


def _is_meant_to_swell(options: FairOptions) -> bool:
    return options.detail > 0.0 or (options.equation == "CONSTANT" and options.bulge != 0.0)


def judges_join(options: FairOptions) -> bool:
    """Tell whether the result is meant to continue its surroundings: a soap film and a blend are not."""
    return options.factor == 1.0 and options.equation != "MINIMAL"
