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


def measured(world: MeshArrays, boundary: Ints, points: Floats, triangles: Ints, held: Ints) -> fairing.looks.Judged:
    """Return what the engine sees of a surface over (r,) vertices of the mesh.

    points: (r + k, 3), the boundary's first, and triangles (m, 3) of these; held: those of them that stay.
    """
    count = len(world.positions)
    number = np.concatenate([boundary, count + np.arange(len(points) - len(boundary))])
    places = np.concatenate([world.positions, points[len(boundary) :]])
    return fairing.looks.judged(
        places, number[triangles], world.triangles, held=np.unique(number[held]), rim=np.unique(boundary)
    )


def judge(boundary: Ints, result: fairing.FillResult, join: Join, seen: fairing.looks.Judged) -> Verdict:
    """Return the verdict on a surface over (r,) mesh vertices."""
    over = said("over_loop" if len(result.loops) == 1 else "over_loops", n=len(boundary), loops=len(result.loops))
    crossing, around = np.union1d(seen.now.crossing, seen.pierced), np.unique(boundary)
    name = fairing.looks.fault(
        result, folded=len(seen.now.folded) > 0, crossing=len(crossing) > 0, kinked=len(join.seen) > 0
    )
    if name in fairing.looks.UNUSABLE:
        key = {"no_surface": "none_over", "folded": "folded_over", "crossing": "new_face_crossings"}[name]
        return Verdict(UNUSABLE, said(key, over=over, n=len(crossing)), around)
    if name == "kink":
        return Verdict(LOOK, kink_reason(join), join.seen)
    if name in STAND_INS:
        return Verdict(LOOK, STAND_INS[name], around)
    uneven = girth_reason(result)
    if uneven and result.equation != "least_variation":
        uneven = said("choose_least_variation", reason=uneven)
    return Verdict(LOOK, uneven, around) if uneven else Verdict(GOOD)
