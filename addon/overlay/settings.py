# mypy: disable-error-code="valid-type"
"""What the quality overlay shows, as properties of the window manager: undo leaves them alone.

No postponed annotations here: Blender reads them as property definitions.
"""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, FloatVectorProperty, IntProperty

from .signals import content_changed, look_changed

_MODES = (
    ("ZEBRA", "Reflection Lines", "Stripes of light mirrored in the surface: they break at creases, bend at bad joins"),
    ("CURVATURE", "Mean Curvature", "Red bulges out, blue caves in, white is flat on average; fair means no spots"),
    ("DEVIATION", "Deviation", "How far the last run has moved the surface: red outwards, blue inwards"),
)
_SCOPES = (
    ("SELECTION", "Selection", "The selected faces; in object mode the object"),
    ("OBJECT", "Object", "All faces of the edited objects"),
)


class FairOverlay(bpy.types.PropertyGroup):
    """Settings of the quality overlay"""

    show: BoolProperty(
        name="Show Quality",
        description="Draw reflection lines or curvature over the surface, while it is edited too",
        default=False,
        update=content_changed,
    )
    mode: EnumProperty(name="Show", description="What is drawn", items=_MODES, default="ZEBRA", update=content_changed)
    scope: EnumProperty(
        name="On", description="Where it is drawn", items=_SCOPES, default="SELECTION", update=content_changed
    )
    stripes: IntProperty(
        name="Stripes",
        description="Number of lights: more of them show finer faults",
        default=16,
        min=2,
        soft_max=80,
        update=look_changed,
    )
    axis: FloatVectorProperty(
        name="Direction",
        description="The axis that the rings of light lie around: turn it to make the stripes run another way",
        default=(0.0, 0.0, 1.0),
        subtype="DIRECTION",
        update=look_changed,
    )
    automatic: BoolProperty(
        name="Automatic Range",
        description="Full colour at the largest value, peaks of curvature left out",
        default=True,
        update=look_changed,
    )
    range: FloatProperty(
        name="Range",
        description="Value shown in full colour: curvature in 1 / length, deviation as a length",
        default=1.0,
        min=1e-6,
        update=look_changed,
    )
    opacity: FloatProperty(
        name="Opacity",
        description="1 hides the material below",
        default=1.0,
        min=0.05,
        max=1.0,
        subtype="FACTOR",
        update=look_changed,
    )
