"""Blender's properties for the options of an operator.

No postponed annotations here: Blender reads them as property definitions.
"""

from typing import Any

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from .options import FairOptions
from .other_options import CurvesOptions, DenoiseOptions, FilletOptions, FillOptions
from .table import Chosen, Option, table

_FRESH = {"SKIP_SAVE"}  # each click begins with the defaults


def properties_of(of: type[Chosen]) -> dict[str, Any]:
    """Return what a class of properties is annotated with."""
    return {option.name: _property(option) for option in table(of)}


def _property(option: Option) -> Any:
    texts = {"name": option.label, "description": option.description, "default": option.default, "options": _FRESH}
    if option.items:
        return EnumProperty(items=option.items, **texts)
    if isinstance(option.default, bool):
        return BoolProperty(**texts)
    if isinstance(option.default, str):
        return StringProperty(**texts)
    least, most = option.bounds
    low, high = option.slider or option.bounds
    ranges = {"min": least, "max": most, "soft_min": low, "soft_max": high}
    if isinstance(option.default, int):
        return IntProperty(**texts, **{name: int(value) for name, value in ranges.items()})
    subtype = option.kind or "NONE"
    return FloatProperty(**texts, **ranges, step=option.step, precision=option.digits, subtype=subtype)


class FairProperties:
    """The options of `mesh.fair_region`; `chosen` is the class that they come to."""

    chosen = FairOptions
    __annotations__ = properties_of(FairOptions)


class FillProperties:
    chosen = FillOptions
    __annotations__ = properties_of(FillOptions)


class DenoiseProperties:
    chosen = DenoiseOptions
    __annotations__ = properties_of(DenoiseOptions)


class CurvesProperties:
    chosen = CurvesOptions
    __annotations__ = properties_of(CurvesOptions)


class FilletProperties:
    chosen = FilletOptions
    __annotations__ = {
        **properties_of(FilletOptions),
        "confirm_on_release": BoolProperty(
            name="Confirm on Release",
            description="Accept when the button of the mouse is let go, as a tool of the toolbar does",
            default=False,
            options={"HIDDEN", "SKIP_SAVE"},
        ),
    }
