"""What the eye would see of a result that is usable."""

from __future__ import annotations

import numpy as np

import fairing

from .arrays import Floats, Ints
from .engine import Result
from .evidence import NOTHING, Evidence, Found, corners_of
from .options import FairOptions
from .quality import Join
from .selection import LeftOut
from .words import counted

MANY_LEFT_OUT = 3  # faces that a careless lasso leaves out; one or two may be meant
MOST_BENT = 0.05  # part of the free vertices of a loft: they are its spots
_KNOT = "Seams and marks inside, which stay, are squeezed to a knot at {}"
# What stands in for a surface that there is none of, by the engine's name for it.
STAND_INS = {
    "loft": "No fair surface fits these boundary loops: the loft that joins them is a stand-in, so look at its shape",
    "bilaplacian": "No fair surface was found: a smooth one is kept instead, so look at its shape",
    "smoothed": "No fair surface fits these boundary loops: the old shape was smoothed, so look at it",
}


def visible(evidence: Evidence, options: FairOptions) -> Found:
    """Return the first reason to look at it, with its places, the worst first."""
    for look in _LOOKS:
        reason = look(evidence, options)
        if reason[0]:
            return reason
    return NOTHING


def are_many(left_out: LeftOut) -> bool:
    """Return whether so many faces are left out that it can't be meant."""
    return left_out.count >= MANY_LEFT_OUT


def _holed(evidence: Evidence, _options: FairOptions) -> Found:
    if not are_many(evidence.left_out):
        return NOTHING
    reason = (
        f"{evidence.left_out.count} faces inside are left out of the selection, so that their places stay: add them"
    )
    return reason, evidence.left_out.vertices


def _pierced(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.pierced):
        return NOTHING
    text = counted(len(evidence.pierced), "vertex", "vertices")
    return f"The surface passes through faces outside the selection at {text}: select or move these", evidence.pierced


def _seamed(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.seams):
        return NOTHING
    text = counted(len(evidence.seams), "vertex", "vertices")
    return f"A seam of doubled vertices holds the surface at {text}: undo, and use Merge by Distance", evidence.seams


def _kinked(evidence: Evidence, options: FairOptions) -> Found:
    if not judges_join(options):
        return NOTHING
    seen = evidence.join.seen
    if len(seen):
        return kink_reason(evidence.join), seen
    kinks = evidence.named("NO_SOLUTION", "kinks")  # dihedral angles show these on fine meshes only
    if not len(kinks):
        return NOTHING
    text = counted(len(kinks), "vertex", "vertices")
    return f"The surface does not continue the slope of its surroundings at {text} of the boundary", kinks


def kink_reason(join: Join) -> str:
    """Return the sentence for a join that is seen."""
    text = counted(len(join.seen), "vertex", "vertices")
    if join.worst_seen >= fairing.LIMITS["turned_back"]:
        return f"The surface turns back from the slope around it at {text} of the boundary, by {join.worst_seen:.0f}°"
    return f"A kink shows at {text} of the boundary, of {join.worst_seen:.0f}° at worst"


def slope_reason(vertices: Ints) -> str:
    """Return the sentence for boundary vertices where a curvature was asked for and is not continued."""
    text = counted(len(vertices), "vertex", "vertices")
    return f"The curvature outside is not continued at {text} of the boundary, as was asked for"


def _pointed(evidence: Evidence, _options: FairOptions) -> Found:
    tips = evidence.named("PINS_NOT_SPREAD", "tips")
    if not len(tips):
        return NOTHING
    return f"The surface forms a spike at {counted(len(tips), 'pinned vertex', 'pinned vertices')}", tips


def _rounded(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.rounded):
        return NOTHING
    text = counted(len(evidence.rounded), "vertex", "vertices")
    return f"Boundary: Smooth has rounded a hard edge outside at {text}: choose As Selected", evidence.rounded


def _eaten(evidence: Evidence, options: FairOptions) -> Found:
    if not judges_join(options):
        return NOTHING
    marked, running = evidence.eaten.marked, evidence.eaten.running_on
    if len(marked):
        text = counted(len(marked), "vertex", "vertices")
        reason = f"Edges marked sharp were rounded off at {text}: undo, and Pin Edges: Sharp keeps them"
        return _with_kinks(evidence, reason, marked)
    if len(running):
        text = counted(len(running), "vertex", "vertices")
        reason = f"A hard edge runs on outside, but was rounded off at {text}: mark it sharp and pin it to keep it"
        return _with_kinks(evidence, reason, running)
    return NOTHING


def _with_kinks(evidence: Evidence, reason: str, spots: Ints) -> Found:
    """Add the kinks at the boundary, or begin with them where these are the worse of both.

    Another selection may be what helps then.
    """
    seen = evidence.join.seen
    if not len(seen):
        return reason, spots
    if evidence.join.worst_seen >= fairing.LIMITS["steep_kink"]:
        edge = counted(len(spots), "vertex", "vertices")
        return f"{kink_reason(evidence.join)}, and hard edges were rounded off at {edge}", _both(seen, spots)
    kink = f"a kink of {evidence.join.worst_seen:.0f}° shows at the boundary"
    return f"{reason}, or grow the selection: {kink}", _both(spots, seen)


def _both(spots: Ints, others: Ints) -> Ints:
    joined: Ints = np.concatenate([spots, others])
    return joined


def _swollen(evidence: Evidence, options: FairOptions) -> Found:
    if not len(evidence.swollen) or not judges_join(options) or _is_meant_to_swell(options):
        return NOTHING
    text = counted(len(evidence.swollen), "vertex", "vertices")
    return f"The surface swells to a knob around {text}: another boundary may avoid it", evidence.swollen


def _flanked(evidence: Evidence, options: FairOptions) -> Found:
    if evidence.flank is None or not judges_join(options) or _is_meant_to_swell(options):
        return NOTHING
    kind = "bump" if evidence.flank.is_bump else "dent"
    reason = f"The boundary is on the slope of a {kind}, so that the {kind} stays: grow the selection over it"
    return reason, evidence.problem.patch.vertices[evidence.flank.outline]


def _substituted(evidence: Evidence, _options: FairOptions) -> Found:
    """Report a loft, which may be as flat as a strap, and of the old shape smoothed, which may keep part of it."""
    for figure, reason in STAND_INS.items():
        if any(evidence.reported("NO_SOLUTION", figure)):
            return reason, _most_bent(evidence)
    return NOTHING


def _uneven(evidence: Evidence, options: FairOptions) -> Found:
    reason = girth_reason(evidence.result)
    if not reason or not judges_join(options) or _is_meant_to_swell(options):
        return NOTHING
    patch = evidence.problem.patch
    girth = fairing.girth(_points(evidence), patch.triangles, fixed=patch.fixed)
    if girth is None:  # curves that stay part it
        return reason, patch.vertices[patch.outline]
    return reason, patch.vertices[girth.thinnest if _is_thin(evidence.result) else girth.thickest]


def girth_reason(result: Result) -> str:
    """Return the sentence for a tube that is too thin or too thick; empty where it is neither."""
    least, largest = result.girth or (1.0, 1.0)
    if _is_thin(result):
        return f"The tube narrows to {least:.0%} of its ends"
    return f"The tube swells to {largest:.0%} of its ends" if largest > fairing.LIMITS["balloon"] else ""


def _is_thin(result: Result) -> bool:
    return bool(result.girth and result.girth[0] < fairing.LIMITS["waist"])


def _most_bent(evidence: Evidence) -> Ints:
    """Return the mesh vertices of the free ones where the surface bends most, the worst first."""
    patch = evidence.problem.patch
    bent = np.abs(fairing.mean_curvature(_points(evidence), patch.triangles, fixed=patch.fixed))
    order = patch.free[np.argsort(-bent[patch.free], kind="stable")]
    worst: Ints = patch.vertices[order[: int(np.ceil(MOST_BENT * len(order)))]]
    return worst


def _points(evidence: Evidence) -> Floats:
    """Return the places of the patch's vertices after the run."""
    points = evidence.problem.points if evidence.points is None else evidence.points
    own: Floats = points[: len(evidence.problem.patch.vertices)]
    return own


def _refused(evidence: Evidence, _options: FairOptions) -> Found:
    """Report what was asked for and not given: curvature that is continued, the old skin."""
    curvature = evidence.named("G2_NOT_MET")
    if len(curvature):
        return slope_reason(np.unique(curvature)), curvature
    if any(evidence.reported("REFERENCE_UNUSABLE", "old_skin", "sample_skin")):
        outline = evidence.problem.patch.vertices[evidence.problem.patch.outline]
        return "The detail asked for could not be put back: the result is smooth", outline
    return NOTHING


def _squeezed(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.squeezed):
        return NOTHING
    text = counted(len(evidence.squeezed), "vertex", "vertices")
    return f"{_KNOT.format(text)}: to be rid of them, delete the faces and use Fair Fill", evidence.squeezed


def _needles(evidence: Evidence, _options: FairOptions) -> Found:
    needles = np.setdiff1d(evidence.after.shown, evidence.before.needles)
    if not len(needles):
        return NOTHING
    return counted(len(needles), "face is a needle", "faces are needles"), corners_of(evidence.problem, needles)


# The first that finds something gives the reason.
_LOOKS = (
    *(_holed, _pierced, _seamed, _rounded, _eaten, _kinked, _pointed, _swollen, _flanked),
    *(_substituted, _uneven, _refused, _squeezed, _needles),
)


def _is_meant_to_swell(options: FairOptions) -> bool:
    return options.detail > 0.0 or (options.equation == "CONSTANT" and options.bulge != 0.0)


def judges_join(options: FairOptions) -> bool:
    """Return whether the result is meant to continue its surroundings: a soap film and a blend are not."""
    return options.factor == 1.0 and options.equation != "MINIMAL"
