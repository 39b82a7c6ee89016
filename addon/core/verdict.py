"""Whether a result is good, worth a look, or nothing that should be written; with where and why."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace

import numpy as np

import fairing

from .arrays import Floats, Ints
from .bends import bends
from .eaten import Eaten
from .engine import Problem, Result, bad_outline
from .findings import Finding, Origin, found
from .flank import Flank
from .options import FairOptions
from .quality import Join, Quality
from .region import nothing
from .selection import LeftOut
from .vectors import area_vectors, unit
from .words import counted

GOOD, LOOK, UNUSABLE = "GOOD", "LOOK", "UNUSABLE"
GRADES = (GOOD, LOOK, UNUSABLE)
STEEP = 40.0  # degrees from which a kink at the outline is worse than a hard edge that was rounded off
TURNED = 90.0  # and from which it is no kink any more
FLAT = 1.0  # degrees between the neighbours of a needle, below which it is not seen
MANY_LEFT_OUT = 3  # faces that a careless lasso leaves out; one or two may be meant
MOST_BENT = 0.05  # part of the free vertices of a loft: they are its spots

# What may help, each a way to run once more.
GROW, SMOOTH_OUTLINE, AS_SELECTED, HOLD_BORDER = "GROW", "SMOOTH_OUTLINE", "AS_SELECTED", "HOLD_BORDER"
EVEN_CURVATURE, EVEN_SPREAD, WRITE, GROW_OVER = "EVEN_CURVATURE", "EVEN_SPREAD", "WRITE", "GROW_OVER"
ADD_LEFT_OUT = "ADD_LEFT_OUT"

_ROUGH_BORDER = ": a fair border may not exist where it is rough beside the selection; Open Border: Held needs none"
_KNOT = "Seams and marks inside, which stay, are squeezed to a knot at {}"
# What stands in for a surface that there is none of, by the engine's name for it.
SUBSTITUTES = {
    "loft": "No fair surface fits these outlines: the loft that joins them is a substitute, so look at its shape",
    "smoothed": "No fair surface fits these outlines: the old shape was smoothed as far as it goes, so look at it",
}


@dataclass(frozen=True)
class Verdict:
    """One grade, and for all but GOOD a sentence, the mesh vertices that it is about (worst kink first), what helps."""

    grade: str
    reason: str = ""
    spots: Ints = field(default_factory=nothing)
    remedies: tuple[str, ...] = ()
    rings: int = 1  # of faces by which GROW_OVER grows the selection


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
    eaten: Eaten = field(default_factory=Eaten)
    squeezed: Ints = field(default_factory=nothing)  # mesh vertices where lines that a new mesh keeps are a knot
    pierced: Ints = field(default_factory=nothing)  # mesh vertices where the surface passes through faces outside
    flank: Flank | None = None
    left_out: LeftOut = field(default_factory=LeftOut)
    seams: Ints = field(default_factory=nothing)  # mesh vertices of held seams of doubled vertices that show as crests
    points: Floats | None = None  # (q, 3) of problem.vertices after the run; None: problem.points
    origin: Origin | None = None  # what the engine's numbers stand for; None: problem.origin

    def told(self, code: str, *figures: str) -> Iterator[Finding]:
        """Find what the engine told of by a code, with any of the figures; all of that code without any."""
        origin = self.origin or self.problem.origin
        for warning in self.result.warnings:
            if warning.code == code and (not figures or any(name in warning.figures for name in figures)):
                yield found(warning, origin)

    def named(self, code: str, figure: str = "") -> Ints:
        """Return the mesh vertices that the engine names so."""
        told = (finding.named for finding in self.told(code, *filter(None, [figure])))
        vertices: Ints = np.concatenate([nothing(), *told])
        return vertices


def judge(evidence: Evidence, options: FairOptions) -> Verdict:
    """Return the verdict on what would be written."""
    rings = evidence.flank.rings if evidence.flank is not None else 1
    for look in (_no_answer, _folded, _crossing):
        reason, spots = look(evidence, options)
        if reason:
            bad = not _calms(evidence)
            remedies = _remedies(evidence, options, bad)
            return Verdict(UNUSABLE if bad else LOOK, reason, np.unique(spots), remedies, rings)
    reason, spots = _visible(evidence, options)
    if reason:
        return Verdict(LOOK, reason, _once(spots), _remedies(evidence, options, bad=False), rings)
    return Verdict(GOOD)


def because_of(verdict: Verdict, causes: tuple[str, ...]) -> Verdict:
    """Return the verdict, where nothing usable came out with the first of what must be the cause for its reason."""
    return replace(verdict, reason=causes[0]) if causes and verdict.grade == UNUSABLE else verdict


def _calms(evidence: Evidence) -> bool:
    """Tell whether a smooth surface lies beside a jagged outline, with fewer folds and crossings than there were.

    Those that are left hang on the outline, which has to stay.
    """
    eased = any(evidence.told("NO_SOLUTION", "distance"))
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
        GROW_OVER: not bad and evidence.flank is not None and judges_join(options),
        ADD_LEFT_OUT: _are_many(evidence.left_out),
        GROW: has_outside,
        SMOOTH_OUTLINE: has_outside and options.outline == "GIVEN" and options.mesh == "KEEP",
        EVEN_SPREAD: bad and _is_folded(evidence) and options.mesh == "KEEP" and options.inner_fairness != "UNIFORM",
        AS_SELECTED: len(evidence.rounded) > 0,
        HOLD_BORDER: bad and options.fairs_border,
        EVEN_CURVATURE: bad and not was_tried and options.equation in ("HARMONIC", "MINIMAL_ENERGY"),
        WRITE: bad and options.accept != "ALL",
    }
    return tuple(name for name, offer in offered.items() if offer)


def _is_folded(evidence: Evidence) -> bool:
    return evidence.result.termination == "folded" or len(evidence.after.folded) > 0


def _no_answer(evidence: Evidence, options: FairOptions) -> Found:
    result, patch = evidence.result, evidence.problem.patch
    if result.converged or result.termination == "folded":
        return _NOTHING
    reason = evidence.failures[0] if evidence.failures else "No fair surface was found"
    reason += _ROUGH_BORDER if options.fairs_border else _ending(evidence)
    return reason, _troubled(evidence.problem) if len(evidence.problem.outside) else patch.vertices[patch.outline]


def _ending(evidence: Evidence) -> str:
    """Return how the search ended, where the engine does not tell why, and what there is instead."""
    if any(evidence.told("NOT_CONVERGED", "load_share", "area", "from_behind")):
        return ""
    count = evidence.result.iterations
    text = ": the search came to a halt" if count else ": the search found no way to begin"
    if evidence.result.termination != "stalled":
        text = f": it was not there after the {counted(count, 'step', 'steps')} that Iterations allows"
    after = evidence.after
    if len(after.folded) or (after.crossing is not None and len(after.crossing)) or len(evidence.join.seen):
        return text
    return f"{text}. What it came to has no folds and no kinks"


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
    corners, patch = _corners(evidence.problem, after), evidence.problem.patch
    pins = np.intersect1d(corners, patch.vertices[np.setdiff1d(patch.fixed, patch.outline)])
    if len(pins):
        text += f", at {counted(len(pins), 'pinned vertex', 'pinned vertices')}"
    return text, corners


def _named_folds(evidence: Evidence) -> Found:
    """Tell what the engine tells of folds that show as crossings only."""
    reason = evidence.failures[0] if evidence.failures else "The surface can't be reached without folds"
    return reason, evidence.named("FOLDED")


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
    for look in _LOOKS:
        told = look(evidence, options)
        if told[0]:
            return told
    return _NOTHING


def _are_many(left_out: LeftOut) -> bool:
    return left_out.count >= MANY_LEFT_OUT


def _holed(evidence: Evidence, _options: FairOptions) -> Found:
    if not _are_many(evidence.left_out):
        return _NOTHING
    reason = (
        f"{evidence.left_out.count} faces inside are left out of the selection, so that their places stay: add them"
    )
    return reason, evidence.left_out.vertices


def _pierced(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.pierced):
        return _NOTHING
    text = counted(len(evidence.pierced), "vertex", "vertices")
    return f"The surface passes through faces outside the selection at {text}: select or move these", evidence.pierced


def _seamed(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.seams):
        return _NOTHING
    text = counted(len(evidence.seams), "vertex", "vertices")
    return f"A seam of doubled vertices holds the surface at {text}: undo, and use Merge by Distance", evidence.seams


def _kinked(evidence: Evidence, options: FairOptions) -> Found:
    if not judges_join(options):
        return _NOTHING
    seen = evidence.join.seen
    if len(seen):
        return kink_reason(evidence.join), seen
    kinks = evidence.named("NO_SOLUTION", "kinks")  # dihedral angles show these on fine meshes only
    if not len(kinks):
        return _NOTHING
    text = counted(len(kinks), "vertex", "vertices")
    return f"The surface does not continue the slope of its surroundings at {text} of the outline", kinks


def kink_reason(join: Join) -> str:
    """Return the sentence for a join that is seen."""
    text = counted(len(join.seen), "vertex", "vertices")
    if join.worst_seen >= TURNED:
        return f"The surface turns back from the slope around it at {text} of the outline, by {join.worst_seen:.0f}°"
    return f"A kink shows at {text} of the outline, of {join.worst_seen:.0f}° at worst"


def slope_reason(vertices: Ints) -> str:
    """Return the sentence for outline vertices where a curvature was asked for and is not continued."""
    text = counted(len(vertices), "vertex", "vertices")
    return f"The curvature outside is not continued at {text} of the outline, as was asked for"


def _pointed(evidence: Evidence, _options: FairOptions) -> Found:
    tips = evidence.named("PINS_NOT_SPREAD", "tips")
    if not len(tips):
        return _NOTHING
    return f"The surface comes to a point at {counted(len(tips), 'pinned vertex', 'pinned vertices')}", tips


def _rounded(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.rounded):
        return _NOTHING
    text = counted(len(evidence.rounded), "vertex", "vertices")
    return f"Outline: Smooth has rounded a hard edge outside at {text}: choose As Selected", evidence.rounded


def _eaten(evidence: Evidence, options: FairOptions) -> Found:
    if not judges_join(options):
        return _NOTHING
    marked, running = evidence.eaten.marked, evidence.eaten.running_on
    if len(marked):
        text = counted(len(marked), "vertex", "vertices")
        reason = f"Edges marked sharp were rounded off at {text}: undo, and Pin Edges: Sharp keeps them"
        return _with_kinks(evidence, reason, marked) if evidence.join.worst_seen >= STEEP else (reason, marked)
    if len(running):
        text = counted(len(running), "vertex", "vertices")
        reason = f"A hard edge runs on outside, but was rounded off at {text}: mark it sharp and pin it to keep it"
        return _with_kinks(evidence, reason, running)
    return _NOTHING


def _with_kinks(evidence: Evidence, reason: str, spots: Ints) -> Found:
    """Add the kinks at the outline, or begin with them where these are the worse of both.

    Another selection may be what helps then.
    """
    seen = evidence.join.seen
    if not len(seen):
        return reason, spots
    if evidence.join.worst_seen >= STEEP:
        edge = counted(len(spots), "vertex", "vertices")
        return f"{kink_reason(evidence.join)}, and hard edges were rounded off at {edge}", _both(seen, spots)
    kink = f"a kink of {evidence.join.worst_seen:.0f}° shows at the outline"
    return f"{reason}, or grow the selection: {kink}", _both(spots, seen)


def _both(spots: Ints, others: Ints) -> Ints:
    joined: Ints = np.concatenate([spots, others])
    return joined


def _swollen(evidence: Evidence, options: FairOptions) -> Found:
    if not len(evidence.swollen) or not judges_join(options) or _is_meant_to_swell(options):
        return _NOTHING
    text = counted(len(evidence.swollen), "vertex", "vertices")
    return f"The surface swells to a knob around {text}: another outline may avoid it", evidence.swollen


def _flanked(evidence: Evidence, options: FairOptions) -> Found:
    if evidence.flank is None or not judges_join(options) or _is_meant_to_swell(options):
        return _NOTHING
    kind = "bump" if evidence.flank.is_bump else "dent"
    reason = f"The outline is on the slope of a {kind}, so that the {kind} stays: grow the selection over it"
    return reason, evidence.problem.patch.vertices[evidence.flank.outline]


def _substituted(evidence: Evidence, _options: FairOptions) -> Found:
    """Tell of a loft, which may be as flat as a strap, and of the old shape smoothed, which may keep part of it."""
    for figure, reason in SUBSTITUTES.items():
        if any(evidence.told("NO_SOLUTION", figure)):
            return reason, _most_bent(evidence)
    return _NOTHING


def _most_bent(evidence: Evidence) -> Ints:
    """Return the mesh vertices of the free ones where edges bend most, the worst first."""
    patch = evidence.problem.patch
    edges = bends(_points(evidence), patch.triangles)
    sharpest = np.zeros(len(patch.vertices))
    for end in edges.edges.T:
        np.maximum.at(sharpest, end, np.abs(edges.degrees))
    order = patch.free[np.argsort(-sharpest[patch.free], kind="stable")]
    worst: Ints = patch.vertices[order[: int(np.ceil(MOST_BENT * len(order)))]]
    return worst


def _points(evidence: Evidence) -> Floats:
    """Return the places of the patch's vertices after the run."""
    points = evidence.problem.points if evidence.points is None else evidence.points
    own: Floats = points[: len(evidence.problem.patch.vertices)]
    return own


def _refused(evidence: Evidence, _options: FairOptions) -> Found:
    """Tell what was asked for and not given: curvature that is continued, the old skin."""
    curvature = evidence.named("G2_NOT_MET")
    if len(curvature):
        return slope_reason(np.unique(curvature)), curvature
    if any(evidence.told("REFERENCE_UNUSABLE", "old_skin", "sample_skin")):
        outline = evidence.problem.patch.vertices[evidence.problem.patch.outline]
        return "The detail asked for could not be put back: the result is smooth", outline
    return _NOTHING


def _squeezed(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.squeezed):
        return _NOTHING
    text = counted(len(evidence.squeezed), "vertex", "vertices")
    return f"{_KNOT.format(text)}: to be rid of them, delete the faces and use Fair Fill", evidence.squeezed


def _needles(evidence: Evidence, _options: FairOptions) -> Found:
    needles = _that_show(evidence, np.setdiff1d(evidence.after.needles, evidence.before.needles))
    if not len(needles):
        return _NOTHING
    return counted(len(needles), "face is a needle", "faces are needles"), _corners(evidence.problem, needles)


def _that_show(evidence: Evidence, needles: Ints) -> Ints:
    """Return those of the needles whose neighbours bend: on a plane no one sees them."""
    patch, points = evidence.problem.patch, _points(evidence)
    sides = bends(points, patch.triangles).sides
    normals = unit(area_vectors(points, patch.triangles))
    shown = []
    for row in np.flatnonzero(np.isin(patch.faces, needles)):
        beside = normals[np.setdiff1d(sides[(sides == row).any(axis=1)], row)]
        if len(beside) and (beside @ beside.T).min() < np.cos(np.radians(FLAT)):
            shown.append(patch.faces[row])
    found: Ints = np.unique(np.array(shown, dtype=np.int64))
    return found


# The first that finds something gives the reason.
_LOOKS = (
    *(_holed, _pierced, _seamed, _rounded, _eaten, _kinked, _pointed, _swollen, _flanked),
    *(_substituted, _refused, _squeezed, _needles),
)


def _is_meant_to_swell(options: FairOptions) -> bool:
    return options.detail > 0.0 or (options.equation == "CONSTANT" and options.bulge != 0.0)


def judges_join(options: FairOptions) -> bool:
    """Tell whether the result is meant to continue its surroundings: a soap film and a blend are not."""
    return options.factor == 1.0 and options.equation != "MINIMAL"
