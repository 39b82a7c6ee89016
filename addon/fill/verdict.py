"""What a surface over border loops is worth. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

import fairing

from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Ints
from ..verdict.looks import STAND_INS, girth_reason, kink_reason
from ..verdict.quality import Join
from ..verdict.verdict import GOOD, LOOK, UNUSABLE, Verdict
from ..words.words import said


def measured(world: MeshArrays, outline: Ints, points: Floats, triangles: Ints, held: Ints) -> fairing.looks.Judged:
    """Return what the engine sees of a surface over (r,) vertices of the mesh.

    points: (r + k, 3), the boundary's first, and triangles (m, 3) of these; held: those of them that stay.
    """
    count = len(world.positions)
    number = np.concatenate([outline, count + np.arange(len(points) - len(outline))])
    places = np.concatenate([world.positions, points[len(outline) :]])
    return fairing.looks.judged(
        places, number[triangles], world.triangles, held=np.unique(number[held]), rim=np.unique(outline)
    )


def judge(outline: Ints, result: fairing.FillResult, join: Join, seen: fairing.looks.Judged) -> Verdict:
    """Return the verdict on a surface over (r,) mesh vertices."""
    over = said("over_loop" if len(result.loops) == 1 else "over_loops", n=len(outline), loops=len(result.loops))
    if not result.converged and result.termination != "folded":
        return Verdict(UNUSABLE, said("none_over", over=over), np.unique(outline))
    if len(seen.now.folded) or result.termination == "folded":
        return Verdict(UNUSABLE, said("folded_over", over=over), np.unique(outline))
    crossing = np.union1d(seen.now.crossing, seen.pierced)
    if len(crossing):
        return Verdict(UNUSABLE, said("new_face_crossings", n=len(crossing)), np.unique(outline))
    if len(join.seen) and result.equation != "soap_film":  # which meets its boundary with a crease
        return Verdict(LOOK, kink_reason(join), join.seen)
    if result.equation in STAND_INS:
        return Verdict(LOOK, STAND_INS[result.equation], np.unique(outline))
    uneven = girth_reason(result)
    if uneven:
        if result.equation != "least_variation":
            uneven = said("choose_least_variation", reason=uneven)
        return Verdict(LOOK, uneven, np.unique(outline))
    return Verdict(GOOD)
