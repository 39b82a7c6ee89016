"""What a surface over border loops is worth. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

import fairing

from ..arrays.places import unit
from ..arrays.region import MeshArrays, nothing
from ..arrays.types import Floats, Ints, Mask
from ..verdict.looks import STAND_INS, girth_reason, kink_reason, sunken_reason
from ..verdict.piercing import Sheet, crossing, near
from ..verdict.quality import Join
from ..verdict.verdict import GOOD, LOOK, UNUSABLE, Verdict
from ..words.words import said

ONWARD = 40.0  # degrees from an edge's direction within which a surface takes it up: as far as edges run on


@dataclass(frozen=True)
class Surface:
    """What was found over a boundary of r vertices, in world space."""

    points: Floats  # (r + k, 3), those of the boundary first
    triangles: Ints
    result: fairing.FillResult
    join: Join
    across: Ints = field(default_factory=nothing)  # (c, 2) edges of curves across it, in numbers of the points


def judge(world: MeshArrays, outline: Ints, surface: Surface, around: Ints) -> Verdict:
    """Return the verdict on a surface; world: the mesh, outline: (r,) vertices, around: (o, 3) triangles near them."""
    points, triangles, result = surface.points, surface.triangles, surface.result
    over = said("over_loop" if len(result.loops) == 1 else "over_loops", n=len(outline), loops=len(result.loops))
    if not result.converged and result.termination != "folded":
        return Verdict(UNUSABLE, said("none_over", over=over), np.unique(outline))
    held = np.union1d(np.arange(len(outline)), surface.across)
    folds = fairing.looks.flipped_triangles(points, triangles, fixed=held)
    if len(folds) or result.termination == "folded":
        return Verdict(UNUSABLE, said("folded_over", over=over), np.unique(outline))
    crossing = _crossing(world, outline, points, triangles)
    if crossing:
        return Verdict(UNUSABLE, said("new_face_crossings", n=crossing), np.unique(outline))
    if len(surface.join.seen) and result.equation != "soap_film":  # which meets its boundary with a crease
        return Verdict(LOOK, kink_reason(surface.join), surface.join.seen)
    joined = np.unique(surface.across)
    ends = np.setdiff1d(hard_ends(world, outline, around, surface), outline[joined[joined < len(outline)]])
    if len(ends):
        return Verdict(LOOK, said("edges_end_at_hole", n=len(ends)), ends)
    if result.equation in STAND_INS:
        return Verdict(LOOK, STAND_INS[result.equation], np.unique(outline))
    uneven = girth_reason(result)
    if uneven:
        if result.equation != "least_variation":
            uneven = said("choose_least_variation", reason=uneven)
        return Verdict(LOOK, uneven, np.unique(outline))
    depth = _depth(world, outline, around, surface)
    if depth > fairing.looks.LIMITS["sunken"] and result.equation != "soap_film":
        return Verdict(LOOK, sunken_reason(depth), np.unique(outline))
    return Verdict(GOOD)


def _depth(world: MeshArrays, outline: Ints, around: Ints, surface: Surface) -> float:
    """Return how far the surface sinks below the lines that run on across it from around."""
    if not len(around) or len(surface.across):  # edges that run on through it
        return 0.0
    vertices, numbers = np.unique(around, return_inverse=True)
    rim = np.searchsorted(vertices, outline)
    found = fairing.surrounding_normals(world.positions[vertices], numbers.reshape(-1, 3), np.unique(rim)).normals
    normals = np.zeros_like(surface.points)
    normals[: len(outline)] = found[np.searchsorted(np.unique(rim), rim)]
    return fairing.looks.sunken(surface.points, surface.triangles, normals, fixed=np.arange(len(outline)))[0]


def hard_ends(world: MeshArrays, outline: Ints, around: Ints, surface: Surface | None = None) -> Ints:
    """Return the vertices of the boundary at which hard edges of the mesh end, ascending.

    around: (o, 3) the triangles near the boundary. surface: only ends count from which edges of it lead on.
    """
    vertices, numbers = np.unique(around, return_inverse=True)
    hard = vertices[fairing.hard_edges(world.positions[vertices], numbers.reshape(-1, 3))]
    on_rim = np.isin(hard, outline)
    ending = on_rim.sum(axis=1) == 1
    ends = hard[ending][on_rim[ending]]
    if surface is not None and len(ends):
        ways = unit(world.positions[ends] - world.positions[hard[ending][~on_rim[ending]]])
        ends = ends[_leads_on(outline, surface, ends, ways)]
    found: Ints = np.unique(ends)
    return found


def _leads_on(outline: Ints, surface: Surface, ends: Ints, ways: Floats) -> Mask:
    """Return (k,) whether edges of the surface lead on from the ends (k,) of edges with these directions (k, 3)."""
    sides = surface.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    sides = np.concatenate([sides, sides[:, ::-1]])
    sides = sides[sides[:, 0] < len(outline)]
    onward = unit(surface.points[sides[:, 1]] - surface.points[sides[:, 0]])
    at = outline[sides[:, 0]]
    leads = [(onward[at == end] @ way).max(initial=-1.0) for end, way in zip(ends.tolist(), ways, strict=True)]
    found: Mask = np.array(leads) > np.cos(np.radians(ONWARD))
    return found


def _crossing(world: MeshArrays, outline: Ints, points: Floats, triangles: Ints) -> int:
    """Count the new triangles that pass through each other or through those of the mesh, wherever these are."""
    count = len(world.positions)
    number = np.concatenate([outline, count + np.arange(len(points) - len(outline))])
    sheet = Sheet(np.concatenate([world.positions, points[len(outline) :]]), number[triangles])
    return int(np.count_nonzero(crossing(sheet, near(sheet, world.triangles)) < len(triangles)))
