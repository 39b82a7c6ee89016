"""The options of *Fair Region*, in the order in which they are shown. Plain Python, no bpy.

Where two exclude each other, the one that comes first counts.
"""

from __future__ import annotations

from dataclasses import dataclass

from . import shared
from .items import DISTRIBUTIONS, PINNED, SLOPES, SLOPES_AT_PINS
from .table import PARTS, PINS, SOLVER, SURFACE, TRANSITION, VERTICES, Chosen, option


@dataclass(frozen=True)
class FairTable(Chosen):
    """Each option once; what they mean together is in options.py."""

    factor: float = shared.factor(
        SURFACE,
        "Factor",
        "How far vertices go: 0 leaves the original shape, 1 is fair, between is a blend of both",
        1.0,
    )
    shape: str = shared.shape(counts=lambda o: not o.is_film)
    bulge: float = option(
        SURFACE,
        "Bulge",
        "Lifts (above 0) or sinks the middle of each island, measured by the island's size: 1 lifts a flat disc by a "
        "quarter of its radius",
        0.0,
        bounds=(-1e6, 1e6),
        slider=(-1.0, 1.0),
        digits=2,
        step=5,
        counts=lambda o: o.continuity == "G1" and shared.is_harmonic(o),
    )
    continuity: str = shared.continuity(counts=lambda o: o.continuity != "G2" or shared.is_harmonic(o))
    continuity_group: str = shared.group(
        SURFACE,
        "Continuity Group",
        "Continuity counts only where the boundary is in this vertex group; elsewhere it is Tangent. Position leaves "
        "the slope free",
        counts=lambda o: o.continuity != "G1",
    )
    boundary_normals: str = option(
        SURFACE,
        "Tangent To",
        "The slope with which the surface leaves its boundary",
        "AUTOMATIC",
        items=SLOPES,
        counts=lambda o: not o.is_film,
    )
    remesh: bool = option(
        VERTICES,
        "Remesh",
        "Regular triangles take the place of the selected faces. Seams of UVs and colours, borders of materials and "
        "marked edges stay; UVs, colours, weights and shape keys are carried over",
        False,
        counts=lambda o: not o.is_film,
    )
    inner_fairness: str = option(
        VERTICES,
        "Distribution",
        "How vertices spread over the surface. The surface itself stays the same",
        "AUTOMATIC",
        items=DISTRIBUTIONS,
        counts=lambda o: not o.remesh,
    )
    spacing: float = shared.spacing(counts=lambda o: o.remesh)
    quads: bool = shared.quads(counts=lambda o: o.remesh)
    detail: float = shared.factor(
        TRANSITION,
        "Keep Detail",
        "How much of the old skin is put back on the new shape: grain, pores and scales stay, and what is larger than "
        "twelve edges goes. 0: the surface is smooth",
        0.0,
        counts=lambda o: not o.remesh,
    )
    falloff: float = option(
        TRANSITION,
        "Falloff",
        "Width of a band around the selection in which the change fades out, as a part of the selection's size. The "
        "faces there move too. 0: nothing outside moves",
        0.0,
        bounds=(0.0, 1e6),
        slider=(0.0, 0.5),
        step=1,
        counts=lambda o: o.can_fade,
    )
    vertex_group: str = shared.group(
        PARTS,
        "Vertex Group",
        "Each vertex's weight in this group scales its Factor, also outside the selection as far as paint reaches "
        "without a gap. Paint to fade the change out",
        counts=lambda o: o.can_fade,
    )
    use_mask: bool = option(
        PARTS,
        "Use Mask",
        "Sculpt mode's mask scales the Factor of each vertex, also outside the selection: masked vertices move fully, "
        "half-masked ones half",
        False,
        counts=lambda o: o.can_fade,
    )
    smooth_boundary: bool = option(
        TRANSITION,
        "Smooth Boundary",
        "A noisy boundary and two rings of faces around it are smoothed first, by a quarter of an edge at most",
        False,
        counts=lambda o: not (o.remesh or o.moves_band or o.frees_slopes),
    )
    all_keys: bool = option(
        PARTS,
        "All Keys",
        "With the Basis active, every shape key that bends the selection is faired, too. Off: only the active key, and "
        "keys relative to it follow",
        False,
        counts=lambda o: not o.remesh,
    )
    pin_group: str = shared.group(
        PINS,
        "Pin Group",
        "The surface passes through the vertices of this vertex group; closed loops of them divide it. Lone ones lift "
        "what is around them",
    )
    pin_radius: float = shared.factor(
        PINS,
        "Pin Radius",
        "How far a single pinned vertex lifts the surface, relative to the selection's size; 0: in a point, which "
        "leaves a dent",
        0.1,
        slider=(0.0, 0.3),
        counts=lambda o: bool(o.pin_group),
    )
    pin_edges: str = option(PINS, "Pin Edges", "Inner edges that the surface keeps", "AUTOMATIC", items=PINNED)
    fair_pinned_edges: bool = option(
        PINS,
        "Fair Pinned Edges",
        "Hard edges that run through the selection become fair curves. Otherwise they stay where they are",
        True,
        counts=lambda o: o.pins_sharp,
    )
    pin_slope: str = option(
        PINS,
        "At Pinned Edges",
        "With which slope the surface meets the pinned edges",
        "AUTOMATIC",
        items=SLOPES_AT_PINS,
        counts=lambda o: o.pin_edges != "NONE",
    )
    fair_open_borders: bool = option(
        PINS,
        "Fair Open Borders",
        "Open borders inside the selection become fair curves, with a free slope. Otherwise they stay where they are",
        False,
        counts=lambda o: not o.remesh,
    )
    fallback: bool = option(
        SOLVER,
        "Fallback",
        "Where no surface of that shape fits the boundary, Least Variation is used instead. Otherwise the best that "
        "was found is kept, and the report says so",
        True,
        counts=lambda o: not o.is_film and o.shape != "LEAST_VARIATION",
    )
    allow_folds: bool = shared.allow_folds()
