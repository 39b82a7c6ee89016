"""What the eye would see of a result that is usable."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

import fairing

from .arrays import Floats, Ints
from .engine import Result
from .evidence import NOTHING, Evidence, Found
from .options import FairOptions
from .quality import Join
from .words import counted

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


def _pointed(evidence: Evidence, _options: FairOptions) -> Found:
    tips = evidence.named("PINS_NOT_SPREAD", "tips")
    if not len(tips):
        return NOTHING
    return f"The surface forms a spike at {counted(len(tips), 'pinned vertex', 'pinned vertices')}", tips


def _rounded(evidence: Evidence, options: FairOptions) -> Found:
    if not len(evidence.rounded):
        return NOTHING
    text = counted(len(evidence.rounded), "vertex", "vertices")
    if options.outline == "MENDED":
        return f"Smooth Boundary has rounded a hard edge outside at {text}: turn it off", evidence.rounded
    return f"A hard edge outside was rounded off at {text}: Falloff, or the weights, end short of it", evidence.rounded


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
    """Report the old skin where it was asked for and not given."""
    if any(evidence.reported("REFERENCE_UNUSABLE", "old_skin", "sample_skin")):
        return "The detail asked for could not be put back: the result is smooth", _outline(evidence)
    return NOTHING


def _squeezed(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.squeezed):
        return NOTHING
    text = counted(len(evidence.squeezed), "vertex", "vertices")
    return f"{_KNOT.format(text)}: to be rid of them, delete the faces and use Fair Fill", evidence.squeezed


def _sunken(evidence: Evidence, options: FairOptions) -> Found:
    lost = evidence.lost
    if len(evidence.problem.patch.free_slopes):  # a bend there is asked for, so that what is around says less
        return NOTHING
    # Detail is skin; what it is put on sinks all the same.
    if not len(lost.deepest) or not judges_join(options) or _is_meant_to_swell(replace(options, detail=0.0)):
        return NOTHING
    return sunken_reason(lost.depth), lost.deepest


def sunken_reason(depth: float) -> str:
    """Return the sentence for a surface that sinks by a share of its width below the lines that run on across it."""
    return f"The surface sinks by {depth:.0%} of its width: a ridge, a bevel or a girth is lost"


def _smoother(evidence: Evidence, options: FairOptions) -> Found:
    if not evidence.lost.is_smoother or options.detail > 0.0 or options.factor < 1.0:
        return NOTHING
    return "The surface is smoother than around: its skin is gone", _outline(evidence)


def _rougher(evidence: Evidence, options: FairOptions) -> Found:
    if not evidence.lost.is_rougher or not judges_join(options):
        return NOTHING
    return "The surface is crumpled: it bends as nothing does around it", _most_bent(evidence)


def _outline(evidence: Evidence) -> Ints:
    patch = evidence.problem.patch
    found: Ints = patch.vertices[patch.outline]
    return found


def _moved_border(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.lost.border):
        return NOTHING
    return "The open border has moved far into the surface, or off it", evidence.lost.border


def _kept_key(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.lost.key):
        return NOTHING
    return "A shape key that is shown keeps a shape of its own here: fair that key, too", evidence.lost.key


# The first that finds something gives the reason.
_LOOKS = (
    *(_pierced, _seamed, _kept_key, _moved_border, _rounded, _eaten, _kinked, _pointed, _swollen, _flanked),
    *(_substituted, _uneven, _rougher, _sunken, _refused, _squeezed, _smoother),
)


def _is_meant_to_swell(options: FairOptions) -> bool:
    return options.detail > 0.0 or options.pulls_locally or (options.equation == "CONSTANT" and options.bulge != 0.0)


def judges_join(options: FairOptions) -> bool:
    """Return whether the result is meant to continue its surroundings: a soap film and a blend are not."""
    return options.factor == 1.0 and options.equation != "MINIMAL"
