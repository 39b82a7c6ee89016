# mypy: disable-error-code="valid-type"
"""The options of filling as Blender properties.

No postponed annotations here: Blender reads them as property definitions.
"""

from bpy.props import BoolProperty, EnumProperty, IntProperty

from ..core.fill_pieces import SHAPES
from .surface_properties import EQUATIONS, SurfaceProperties, continuity_property, equation_property, length_property


class FillProperties(SurfaceProperties):
    """The properties of `mesh.fair_fill`; names and defaults are those of filling.FillOptions."""

    equation: equation_property(tuple(item for item in EQUATIONS if item[0] in SHAPES))
    continuity: continuity_property()
    bridge: BoolProperty(
        name="Bridge",
        description="One surface joins all boundary loops of an object: a tube between two, a blend between more",
        default=False,
    )
    islands: BoolProperty(
        name="Join Islands",
        description="Loose pieces of faces inside a hole are joined with it by one surface; "
        "otherwise the hole is closed over them",
        default=False,
    )
    hard_edges: EnumProperty(
        name="Hard Edges",
        description="What becomes of hard edges, marked sharp or by their angle, that end at a hole, and of edges that "
        "were drawn across it",
        items=(
            ("RUN_ON", "Run On", "They are joined by fair curves, or drawn edges are taken, and stay hard"),
            ("IGNORED", "Round Off", "The surface is smooth"),
        ),
        default="RUN_ON",
    )
    longest: IntProperty(
        name="Most Edges",
        description="Borders with more edges than that stay open; 0: any number",
        default=0,
        min=0,
        soft_max=100,
    )
    longest_length: length_property("Longest Border", "Borders that are longer than that stay open; 0: any length")
