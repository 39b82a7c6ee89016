# mypy: disable-error-code="valid-type"
"""The options that several operators share, as Blender properties: one place for each.

No postponed annotations here: Blender reads them as property definitions.
"""

from typing import Any

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ..core.options import LEAST_SPACING

EQUATIONS = (
    (
        "AUTOMATIC",
        "Automatic",
        "Least Variation for a tube of more than two radii between two boundary loops, Harmonic for all else",
    ),
    (
        "HARMONIC",
        "Harmonic",
        "Curvature runs steadily across the patch. Restores spheres and pipes",
    ),
    (
        "CONSTANT",
        "Bulge",
        "Like Harmonic, with a constant pressure from inside or outside that lifts or sinks the middle",
    ),
    (
        "MINIMAL_ENERGY",
        "Minimal Energy",
        "Bends as little as possible: rounder near tight boundaries",
    ),
    (
        "MINIMAL",
        "Soap Film",
        "Least area: meets the boundary in position only, with a crease",
    ),
    (
        "LEAST_VARIATION",
        "Least Variation",
        "Curvature changes as little as it can. For tubes, elbows and limbs that Harmonic inflates. Slower",
    ),
)
_CONTINUITIES = (
    ("G1", "Tangent", "The surface leaves its boundary with the slope of the faces around it"),
    (
        "G2",
        "Curvature",
        "The surface takes up the curvature of the faces around it, too, and reflection lines don't break. "
        "For the shape Harmonic",
    ),
)
_ACCEPT = (
    (
        "USABLE",
        "Usable Results",
        "The mesh stays as it was where there is no result, or one that folds or crosses itself",
    ),
    ("ALL", "All Results", "Whatever comes out is written"),
)
_INNER = (
    ("OUTLINE", "Like the Boundary", "Short where the boundary's edges nearby are short, long where these are long"),
    ("EVEN", "Equal", "All of one length, but for those beside a boundary that is finer or coarser"),
)


def length_property(name: str, description: str, default: float = 0.0, least: float = 0.0, most: float = 10.0) -> Any:
    """Return the property of a length in world space; least: below it is none; most: the slider's end."""
    return FloatProperty(
        name=name,
        description=description,
        default=default,
        min=least,
        soft_max=most,
        precision=4,
        subtype="DISTANCE",
    )


class NewVertexProperties:
    """What all operators have that make vertices."""

    max_vertices: IntProperty(
        name="Vertex Limit",
        description="More new vertices than that are refused; 0: twenty times as many as a flat surface would have, "
        "for a new mesh as the old one would have, for a fillet as by default, and 50,000 at least",
        default=0,
        min=0,
    )
    limit_total: IntProperty(
        name="Limit Total",
        description="The most vertex groups of bones that a new vertex is in: those with the largest weights, "
        "with the same sum. 0: as many as one of the vertices around is in",
        default=0,
        min=0,
        soft_max=8,
    )


class SurfaceProperties(NewVertexProperties):
    """What both `mesh.fair_region` and `mesh.fair_fill` have, whose Shape lists EQUATIONS, too."""

    spacing: FloatProperty(
        name="Spacing",
        description="Length of the new edges away from the boundary, measured by the boundary's edges. "
        "The surface stays the same",
        default=1.0,
        min=LEAST_SPACING,
        soft_min=0.25,
        soft_max=4.0,
        step=5,
        precision=2,
    )
    inner: EnumProperty(
        name="New Edges",
        description="How the lengths of new edges vary",
        items=_INNER,
        default="OUTLINE",
    )
    subdivide_boundary: BoolProperty(
        name="Subdivide Boundary",
        description="Long edges of the boundary are subdivided, to be as long as the new edges; faces beside them "
        "become polygons with more corners",
        default=False,
    )
    quads: BoolProperty(
        name="Quads",
        description="Pairs of triangles become quads as far as possible, none across a border of materials or "
        "face sets",
        default=False,
    )
    accept: EnumProperty(
        name="Write",
        description="Which results are written",
        items=_ACCEPT,
        default="USABLE",
        options={"SKIP_SAVE"},
    )


def equation_property(items: tuple[tuple[str, str, str], ...]) -> Any:
    """Return the property of the shape; items: those of EQUATIONS that are to be had."""
    return EnumProperty(name="Shape", description="Which surface spans the boundary", items=items, default="AUTOMATIC")


def continuity_property() -> Any:
    """Return the property of the join."""
    return EnumProperty(
        name="Join",
        description="How smoothly the surface continues its surroundings",
        items=_CONTINUITIES,
        default="G1",
    )
