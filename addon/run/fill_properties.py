# mypy: disable-error-code="valid-type"
"""The options of filling as Blender properties.

No postponed annotations here: Blender reads them as property definitions.
"""

from bpy.props import BoolProperty, EnumProperty, FloatProperty

from ..core.filling import SHAPES
from ..core.options import LEAST_SPACING
from .properties import ACCEPT, EQUATIONS, SPACING


class FillProperties:
    """The properties of `mesh.fair_fill`; names and defaults are those of filling.FillOptions."""

    equation: EnumProperty(
        name="Shape",
        description="Which surface spans the outline",
        items=tuple(item for item in EQUATIONS if item[0] in SHAPES),
        default="HARMONIC",
    )
    bridge: BoolProperty(
        name="Bridge",
        description="One surface joins all outlines of an object: a tube between two, a blend between more",
        default=False,
    )
    spacing: FloatProperty(
        name="Spacing",
        description=SPACING,
        default=1.0,
        min=LEAST_SPACING,
        soft_min=0.25,
        soft_max=4.0,
        step=5,
        precision=2,
    )
    accept: EnumProperty(
        name="Write",
        description="Which results are written",
        items=ACCEPT,
        default="USABLE",
        options={"SKIP_SAVE"},
    )
