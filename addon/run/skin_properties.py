# mypy: disable-error-code="valid-type"
"""The options of the group *Skin* as Blender properties.

No postponed annotations here: Blender reads them as property definitions.
"""

from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

_FACTOR_MASKS = (
    ("IGNORED", "Ignored", "The mask of sculpt mode has no effect"),
    ("USED", "Used", "Masked vertices have the whole Factor, half-masked ones half of it, others stay"),
)


class SkinProperties:
    """What stays of the old skin, and how the change fades out; names and defaults are those of options.FairOptions."""

    detail: FloatProperty(
        name="Keep Detail",
        description="How much of the old skin is put back on the new shape: grain, pores and scales stay, and what is "
        "larger than Size goes. 0: the surface is smooth",
        default=0.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    detail_size: FloatProperty(
        name="Size",
        description="What repeats within less than this counts as detail: a part of the selection's size; "
        "0: twelve edges",
        default=0.0,
        min=0.0,
        max=1.0,
        precision=3,
        subtype="FACTOR",
    )
    detail_from: StringProperty(
        name="Detail From",
        description="The skin of the faces inside this vertex group is copied onto the new shape, for a selection that "
        "has none of its own, like a filled hole. Empty: the selection's own",
    )
    detail_face_set: IntProperty(
        name="Detail Face Set",
        description="The same with the skin of this face set, by its number; 0: none",
        default=0,
        min=0,
    )
    feather: FloatProperty(
        name="Feather",
        description="Width of a band around the selection in which the change fades out, as a part of the selection's "
        "size. The faces there move too. 0: nothing outside moves",
        default=0.0,
        min=0.0,
        soft_max=0.5,
        step=1,
        precision=3,
    )
    factor_group: StringProperty(
        name="Factor Group",
        description="The weights of this vertex group scale the Factor of each vertex, outside the selection too, "
        "as far as weights lead on from it. Paint them to fade the change out",
    )
    factor_mask: EnumProperty(
        name="Sculpt Mask",
        description="Whether the mask of sculpt mode scales the Factor of each vertex, outside the selection too",
        items=_FACTOR_MASKS,
        default="IGNORED",
    )
