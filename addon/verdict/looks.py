"""What the eye would see of a result that is usable."""

from __future__ import annotations

import numpy as np

import fairing

from ..arrays.types import Floats, Ints
from ..fair.engine import Result
from ..options.options import FairOptions
from ..words.words import said
from .evidence import NOTHING, Evidence, Found
from .quality import Join

LEAST_MOVED = 1e-5  # part of the selection's size: less is nothing that one sees
MOST_BENT = 0.05  # part of the free vertices of a loft: they are its spots
# What stands in for a surface that there is none of, by the engine's name for it.
STAND_INS = {
    "loft": said("loft_stands_in"),
    "bilaplacian": said("bilaplacian_stands_in"),
    "smoothed": said("smoothed_stands_in"),
}


def visible(evidence: Evidence, options: FairOptions) -> Found:
    """Return the first reason to look at it, with its places, the worst first."""
    for look in _LOOKS:
        reason = look(evidence, options)
        if reason[0]:
            return reason
    return NOTHING


def _pierced(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.seen.pierced):
        return NOTHING
    return said("passes_outside", n=len(evidence.seen.pierced)), evidence.seen.pierced


def _seamed(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.seen.seams):
        return NOTHING
    return said("held_by_seam", n=len(evidence.seen.seams)), evidence.seen.seams


def _kinked(evidence: Evidence, options: FairOptions) -> Found:
    if not judges_join(options):
        return NOTHING
    seen = evidence.seen.join.seen
    return (kink_reason(evidence.seen.join), seen) if len(seen) else NOTHING


def kink_reason(join: Join) -> str:
    """Return the sentence for a join that is seen."""
    return said("kink", n=len(join.seen), degrees=join.worst_seen)


def _pointed(evidence: Evidence, _options: FairOptions) -> Found:
    tips = evidence.named("PINS_NOT_SPREAD", "tips")
    if not len(tips):
        return NOTHING
    return said("spike", n=len(tips)), tips


def _rounded(evidence: Evidence, options: FairOptions) -> Found:
    if not len(evidence.seen.rounded):
        return NOTHING
    key = "smooth_boundary_rounded" if options.smooth_boundary else "falloff_rounded"
    return said(key, n=len(evidence.seen.rounded)), evidence.seen.rounded


def _eaten(evidence: Evidence, options: FairOptions) -> Found:
    if not judges_join(options):
        return NOTHING
    marked, running = evidence.seen.marked, evidence.seen.running_on
    if len(marked):
        return said("sharp_rounded", n=len(marked)), marked
    if len(running):
        return said("edge_rounded", n=len(running)), running
    return NOTHING


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
    girth = fairing.looks.girth(_points(evidence), patch.triangles, fixed=patch.fixed)
    if girth is None:  # curves that stay part it
        return reason, patch.vertices[patch.boundary]
    return reason, patch.vertices[girth.thinnest if _is_thin(evidence.result) else girth.thickest]


def girth_reason(result: Result) -> str:
    """Return the sentence for a tube that is too thin or too thick; empty where it is neither."""
    least, largest = result.girth or (1.0, 1.0)
    if _is_thin(result):
        return said("thin_tube", share=least)
    return said("thick_tube", share=largest) if largest > fairing.looks.LIMITS["balloon"] else ""


def _is_thin(result: Result) -> bool:
    return bool(result.girth and result.girth[0] < fairing.looks.LIMITS["waist"])


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


def _unmoved(evidence: Evidence, options: FairOptions) -> Found:
    """Report a run that gives back what was there: what was to go was not selected, or counts as boundary."""
    free, before = evidence.problem.patch.free, evidence.problem.own_points
    if evidence.points is None or options.remesh or options.all_keys or options.factor == 0.0:
        return NOTHING
    moved = np.abs(_points(evidence)[free] - before[free]).max(initial=0.0)
    if moved > LEAST_MOVED * np.ptp(before, axis=0).max():
        return NOTHING
    return said("unmoved"), _boundary(evidence)


def _refused(evidence: Evidence, _options: FairOptions) -> Found:
    """Report the old skin where it was asked for and not given."""
    if any(evidence.reported("REFERENCE_UNUSABLE", "old_skin")):
        return said("no_detail"), _boundary(evidence)
    return NOTHING


def _squeezed(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.squeezed):
        return NOTHING
    return said("knot", n=len(evidence.squeezed)), evidence.squeezed


def _boundary(evidence: Evidence) -> Ints:
    patch = evidence.problem.patch
    found: Ints = patch.vertices[patch.boundary]
    return found


def _moved_border(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.lost.border):
        return NOTHING
    return said("border_moved"), evidence.lost.border


def _kept_key(evidence: Evidence, _options: FairOptions) -> Found:
    if not len(evidence.lost.key):
        return NOTHING
    return said("key_kept"), evidence.lost.key


# The first that finds something gives the reason.
_LOOKS = (
    *(_pierced, _seamed, _kept_key, _moved_border, _rounded, _eaten, _kinked, _pointed),
    *(_substituted, _uneven, _refused, _squeezed, _unmoved),
)


def _is_meant_to_swell(options: FairOptions) -> bool:
    return options.detail > 0.0 or options.pulls_locally or options.bulge != 0.0


def judges_join(options: FairOptions) -> bool:
    """Return whether the result is meant to continue its surroundings: a soap film and a blend are not."""
    return options.factor == 1.0 and options.equation != "soap_film"
