# mypy: disable-error-code="valid-type"
"""The options of fillets as Blender properties.

No postponed annotations here: Blender reads them as property definitions.
"""

from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

from .properties import CONTINUITY_ITEMS


class FilletProperties:
    """The properties of `mesh.fair_fillet`; names and defaults are those of rounding.FilletOptions."""

    width: FloatProperty(
        name="Width",
        description="How far the fillet reaches along the surface, in world space, on the larger side of each seam",
        default=0.1,
        min=1e-6,
        soft_max=10.0,
        precision=4,
        subtype="DISTANCE",
    )
    width_2: FloatProperty(
        name="Width 2",
        description="The same on the smaller side; 0: as wide",
        default=0.0,
        min=0.0,
        soft_max=10.0,
        precision=4,
        subtype="DISTANCE",
    )
    profile: FloatProperty(
        name="Profile",
        description="-1 is flat as a chamfer, 0 round, 1 as sharp as the edge was",
        default=0.0,
        min=-1.0,
        max=1.0,
        precision=2,
    )
    continuity: EnumProperty(
        name="Join",
        description="How the fillet continues both sides",
        items=CONTINUITY_ITEMS,
        default="G1",
    )
    spacing: FloatProperty(
        name="Edge Length",
        description="Length of the new edges, in world space; 0: a quarter of the least width",
        default=0.0,
        min=0.0,
        soft_max=1.0,
        precision=4,
        subtype="DISTANCE",
    )
    width_group: StringProperty(
        name="Width Group",
        description="The widths are multiplied by the weights of this vertex group along the seam",
    )
    max_vertices: IntProperty(
        name="Vertex Limit",
        description="More new vertices than that are refused; 0: twenty times as many as by default, "
        "and 50,000 at least",
        default=0,
        min=0,
    )
    limit_total: IntProperty(
        name="Limit Total",
        description="The most vertex groups of bones that a new vertex is in: those with the largest weights, "
        "with the same sum. 0: as many as one of the vertices around is in",
        default=0,
        min=0,
    )
