# mypy: disable-error-code="valid-type"
"""The options of filling as Blender properties.

No postponed annotations here: Blender reads them as property definitions.
"""

from bpy.props import BoolProperty, EnumProperty

from ..core.filling import SHAPES
from .properties import EQUATIONS, SurfaceProperties, continuity_property, equation_property


class FillProperties(SurfaceProperties):
    """The properties of `mesh.fair_fill`; names and defaults are those of filling.FillOptions."""

    equation: equation_property(tuple(item for item in EQUATIONS if item[0] in SHAPES))
    continuity: continuity_property()
    bridge: BoolProperty(
        name="Bridge",
        description="One surface joins all boundary loops of an object: a tube between two, a blend between more",
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
