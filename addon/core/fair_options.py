"""The options of *Fair Region*: names, labels, tooltips, ranges, and when they are shown. Plain Python, no bpy."""

from __future__ import annotations

from typing import Any

from .option_items import (
    DISTRIBUTIONS,
    FACTOR_MASKS,
    FAIRED,
    KEYS,
    MESHES,
    METHODS,
    OTHERWISE,
    OUTLINES,
    PINNED,
    PULLS,
    SLOPES,
    SLOPES_AT_PINS,
)
from .option_shared import (
    ALLOW_FOLDS,
    CONTINUITY,
    PARTS,
    PINS,
    SHAPE,
    SOLVER,
    SURFACE,
    TRANSITION,
    VERTICES,
    of_new_mesh,
)
from .option_table import Before, Option, Table


def _factor(name: str, label: str, text: str, default: float, group: str, **rest: Any) -> Option:
    return Option(name, label, text, default, group, bounds=(0.0, 1.0), kind="FACTOR", **rest)


def _can_fade(o: Any) -> bool:
    return not o.remesh and o.continuity != "G2" and not o.curvature_group and not o.smooth_boundary


def _can_continue_on_parts(o: Any) -> bool:
    return o.continuity == "G1" and o.shape in ("AUTOMATIC", "HARMONIC") and not (o.multigrid or o.bulge)


FAIR: Table = (
    _factor(
        "factor",
        "Factor",
        "How far vertices go: 0 leaves the original shape, 1 is fair, between is a blend of both",
        1.0,
        SURFACE,
    ),
    SHAPE,
    Option(
        "bulge",
        "Bulge",
        "Lifts (above 0) or sinks the middle of each island, measured by the island's size: 1 lifts a flat disc by a "
        "quarter of its radius",
        0.0,
        SURFACE,
        bounds=(-1e6, 1e6),
        slider=(-1.0, 1.0),
        digits=2,
        step=5,
        shown=lambda o: o.continuity == "G1" and o.shape in ("AUTOMATIC", "HARMONIC"),
    ),
    CONTINUITY,
    Option(
        "boundary_normals",
        "Tangent To",
        "The slope with which the surface leaves its boundary",
        "AUTOMATIC",
        SURFACE,
        items=SLOPES,
        shown=lambda o: o.continuity != "G0",
    ),
    Option(
        "remesh",
        "Remesh",
        "Regular triangles take the place of the selected faces. Seams of UVs and colours, borders of materials and "
        "marked edges stay; UVs, colours, weights and shape keys are carried over",
        False,
        VERTICES,
        field="mesh",
        values=MESHES,
        before=(Before("mesh", MESHES),),
    ),
    Option(
        "inner_fairness",
        "Distribution",
        "How vertices spread over the surface. The surface itself stays the same",
        "AUTOMATIC",
        VERTICES,
        items=DISTRIBUTIONS,
        shown=lambda o: not o.remesh,
    ),
    *of_new_mesh(lambda o: o.remesh),
    _factor(
        "detail",
        "Keep Detail",
        "How much of the old skin is put back on the new shape: grain, pores and scales stay, and what is larger than "
        "Detail Size goes. 0: the surface is smooth",
        0.0,
        TRANSITION,
        shown=lambda o: not o.remesh or o.detail > 0.0,  # which is refused: it has to be in sight
    ),
    _factor(
        "detail_size",
        "Detail Size",
        "What repeats within less than this counts as detail: a part of the selection's size; 0: twelve edges",
        0.0,
        TRANSITION,
        shown=lambda o: o.detail > 0.0,
    ),
    Option(
        "falloff",
        "Falloff",
        "Width of a band around the selection in which the change fades out, as a part of the selection's size. The "
        "faces there move too. 0: nothing outside moves",
        0.0,
        TRANSITION,
        bounds=(0.0, 1e6),
        slider=(0.0, 0.5),
        step=1,
        shown=lambda o: _can_fade(o) or o.falloff > 0.0,
        field="feather",
        before=(Before("feather"),),
    ),
    Option(
        "smooth_boundary",
        "Smooth Boundary",
        "A noisy boundary and two rings of faces around it are smoothed first, by a quarter of an edge at most",
        False,
        TRANSITION,
        shown=lambda o: o.smooth_boundary or not (o.falloff or o.vertex_group or o.use_mask or o.remesh),
        field="outline",
        values=OUTLINES,
        before=(Before("outline", OUTLINES),),
    ),
    Option(
        "vertex_group",
        "Vertex Group",
        "The weights of this vertex group scale the Factor of each vertex, outside the selection too, as far as "
        "weights lead on from it. Paint them to fade the change out",
        "",
        PARTS,
        kind="VERTEX_GROUP",
        shown=lambda o: _can_fade(o) or bool(o.vertex_group),
        field="factor_group",
        before=(Before("factor_group"),),
    ),
    Option(
        "position_group",
        "Position Group",
        "Where the selection's boundary is in this vertex group the surface keeps its position alone and finds its "
        "slope, as a soap film does; elsewhere it continues the surroundings smoothly",
        "",
        PARTS,
        kind="VERTEX_GROUP",
        shown=lambda o: not (o.multigrid or o.smooth_boundary) or bool(o.position_group),
    ),
    Option(
        "curvature_group",
        "Curvature Group",
        "Where the selection's boundary is in this vertex group the surface continues the curvature of its "
        "surroundings, too; elsewhere their slope alone",
        "",
        PARTS,
        kind="VERTEX_GROUP",
        shown=lambda o: _can_continue_on_parts(o) or bool(o.curvature_group),
    ),
    Option(
        "tension",
        "Tension",
        "How far in the surface carries the slopes of its boundary: above 1 it stays near them longer and is fuller, "
        "below 1 it leaves them sooner",
        1.0,
        PARTS,
        bounds=(0.1, 10.0),
        slider=(0.5, 2.0),
        digits=2,
        step=5,
        shown=lambda o: (
            (_can_continue_on_parts(o) and not o.position_group and not o.curvature_group) or o.tension != 1.0
        ),
    ),
    Option(
        "tension_group",
        "Tension Group",
        "Only where the boundary is in this vertex group it has that Tension, with half the weight its square root; "
        "elsewhere 1",
        "",
        PARTS,
        kind="VERTEX_GROUP",
        shown=lambda o: o.tension != 1.0,
    ),
    Option(
        "use_mask",
        "Use Mask",
        "The mask of sculpt mode scales the Factor of each vertex, outside the selection too: masked vertices have "
        "all of it, half-masked ones half",
        False,
        PARTS,
        shown=lambda o: _can_fade(o) or o.use_mask,
        field="factor_mask",
        values=FACTOR_MASKS,
        before=(Before("factor_mask", FACTOR_MASKS),),
    ),
    Option(
        "all_keys",
        "All Keys",
        "With the Basis every shape key that bends the selection is faired, each from its own surroundings. Otherwise "
        "only the active one, and keys relative to it follow",
        False,
        PARTS,
        shown=lambda o: not o.remesh,
        field="keys",
        values=KEYS,
    ),
    Option(
        "pin_group",
        "Pin Group",
        "The surface passes through the vertices of this vertex group; closed loops of them divide it",
        "",
        PINS,
        kind="VERTEX_GROUP",
    ),
    _factor(
        "pin_radius",
        "Pin Radius",
        "Over which part of the patch's size a single pinned vertex lifts or holds the surface; 0: in a point, which "
        "leaves a dent",
        0.1,
        PINS,
        slider=(0.0, 0.3),
        shown=lambda o: bool(o.pin_group),
    ),
    Option(
        "pull_locally",
        "Pull Locally",
        "Lone pinned vertices lift what is within three times Pin Radius, and the rest is as without them. Otherwise "
        "the surface passes through all of them as a whole, and bends everywhere for them",
        False,
        PINS,
        shown=lambda o: bool(o.pin_group) and o.pin_radius > 0.0 and not o.remesh,
        field="pin_pull",
        values=PULLS,
    ),
    Option(
        "pin_edges",
        "Pin Edges",
        "Marked edges that the surface passes through",
        "AUTOMATIC",
        PINS,
        items=PINNED,
    ),
    Option(
        "fair_pinned_edges",
        "Fair Pinned Edges",
        "Hard edges that run through the selection become fair curves, with what is around them. Otherwise they stay "
        "where they are",
        True,
        PINS,
        shown=lambda o: o.pin_edges in ("AUTOMATIC", "SHARP") and not o.multigrid,
        field="pin_curve",
        values=FAIRED,
        before=(Before("pin_curve", FAIRED), Before("pinned_as", ("AS_IS", "FAIR"))),
    ),
    Option(
        "pin_slope",
        "At Pinned Edges",
        "With which slope the surface meets the pinned edges",
        "AUTOMATIC",
        PINS,
        items=SLOPES_AT_PINS,
        shown=lambda o: o.pin_edges != "NONE",
    ),
    Option(
        "fair_open_borders",
        "Fair Open Borders",
        "Open borders inside the selection become fair curves, with a free slope. Otherwise they stay where they are",
        False,
        PINS,
        shown=lambda o: not o.remesh,
        field="open_border",
        values=FAIRED,
        before=(Before("open_border", FAIRED),),
    ),
    Option(
        "fallback",
        "Fallback",
        "Where no surface of that shape fits the boundary, Least Variation is used instead. Otherwise the best that "
        "was found is kept, and the report says so",
        True,
        SOLVER,
        shown=lambda o: not o.multigrid and o.continuity != "G0" and o.shape != "LEAST_VARIATION",
        field="otherwise",
        values=OTHERWISE,
        before=(Before("otherwise", OTHERWISE),),
    ),
    Option(
        "multigrid",
        "Multigrid",
        "Use the published iteration, step by step: slow, for comparison",
        False,
        SOLVER,
        field="method",
        values=METHODS,
        before=(Before("method", METHODS),),
    ),
    Option(
        "levels",
        "Levels",
        "Steps from coarse to fine of Multigrid; 0: chosen for you",
        0,
        SOLVER,
        bounds=(0, 20),
        shown=lambda o: o.multigrid,
    ),
    Option(
        "tolerance",
        "Tolerance",
        "Done when no vertex moves by more than this part of the patch's size; smaller is more exact and slower",
        1e-6,
        SOLVER,
        bounds=(1e-14, 1e-2),
        digits=8,
    ),
    Option(
        "max_iterations",
        "Iterations",
        "Give up after so many steps, and report it",
        200,
        SOLVER,
        bounds=(1, 2**31 - 1),
    ),
    ALLOW_FOLDS,
)
