# mypy: disable-error-code="valid-type"
"""The options of fillets as Blender properties.

No postponed annotations here: Blender reads them as property definitions.
"""

from bpy.props import FloatProperty, StringProperty

from .surface_properties import NewVertexProperties, continuity_property, length_property


class FilletProperties(NewVertexProperties):
    """The properties of `mesh.fair_fillet`; names and defaults are those of rounding.FilletOptions."""

    width: length_property(
        "Width",
        "How far the fillet reaches along the surface, in world space, on the larger side of each seam",
        default=0.1,
        least=1e-6,
    )
    width_2: length_property("Width 2", "The same on the smaller side; 0: as wide")
    profile: FloatProperty(
        name="Profile",
        description="-1 is flat as a chamfer, 0 round, 1 as sharp as the edge was",
        default=0.0,
        min=-1.0,
        max=1.0,
        precision=2,
    )
    continuity: continuity_property()
    spacing: length_property(
        "Edge Length", "Length of the new edges, in world space; 0: a quarter of the least width", most=1.0
    )
    width_group: StringProperty(
        name="Width Group",
        description="The widths are multiplied by the weights of this vertex group along the seam",
    )
