"""Blender's properties for a table of options, those with names of before among them, hidden.

No postponed annotations here: Blender reads them as property definitions.
"""

from typing import Any

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ..core.fair_options import FAIR
from ..core.fill_options import CURVES, DENOISE, FILL, FILLET
from ..core.option_table import Before, Option, Table, from_names_before, names_before, warn_of_names_before

_HIDDEN = {"HIDDEN", "SKIP_SAVE"}
_FRESH = {"SKIP_SAVE"}  # each click begins with the defaults


def properties_of(table: Table) -> dict[str, Any]:
    """Return what a class of properties is annotated with."""
    made = {option.name: _property(option) for option in table}
    made.update({name: _old_property(option, before) for name, (option, before) in names_before(table).items()})
    return made


def _property(option: Option) -> Any:
    texts = {"name": option.label, "description": option.description, "default": option.default, "options": _FRESH}
    if option.items:
        return EnumProperty(items=option.items, **texts)
    if isinstance(option.default, bool):
        return BoolProperty(**texts)
    if isinstance(option.default, str):
        return StringProperty(**texts)
    ranges = _ranges(option)
    if isinstance(option.default, int):
        return IntProperty(**texts, **{name: int(value) for name, value in ranges.items()})
    subtype = option.kind or "NONE"
    return FloatProperty(**texts, **ranges, step=option.step, precision=option.digits, subtype=subtype)


def _ranges(option: Option) -> dict[str, float]:
    limits: dict[str, float] = {}
    if option.bounds is not None:
        limits.update(min=option.bounds[0], max=option.bounds[1])
    if option.slider is not None:
        limits.update(soft_min=option.slider[0], soft_max=option.slider[1])
    return limits


def _old_property(option: Option, before: Before) -> Any:
    texts = {"name": option.label, "description": f"Now called {option.name}", "options": _HIDDEN}
    if before.values:
        items = tuple((value, value, "") for value in before.values)
        default = before.values[int(option.default)] if option.values else option.default
        return EnumProperty(items=items, default=default, **texts)
    kind: Any = StringProperty if isinstance(option.default, str) else FloatProperty
    return kind(default=option.default, **texts)


class _Chosen:
    """What operators with such properties share."""

    table: Table = ()
    bl_idname: str
    preset_menu = ""
    preset_add = ""

    def take_names_before(self) -> None:
        """Move what a script has set by names of before to the options of now, with a warning."""
        given = self.properties  # type: ignore[attr-defined]
        old = names_before(self.table)
        used = {name: getattr(given, name) for name in old if given.is_property_set(name)}
        for name, value in from_names_before(self.table, used).items():
            setattr(given, name, value)
        for name in used:
            given.property_unset(name)
        warn_of_names_before(self.table, used, f"bpy.ops.{self.bl_idname.replace('_OT_', '.').lower()}")


class FairProperties(_Chosen):
    """The options of `mesh.fair_region`."""

    table = FAIR
    __annotations__ = properties_of(FAIR)


class FillProperties(_Chosen):
    """The options of `mesh.fair_fill`."""

    table = FILL
    __annotations__ = properties_of(FILL)


class DenoiseProperties(_Chosen):
    """The options of `mesh.fair_denoise`."""

    table = DENOISE
    __annotations__ = properties_of(DENOISE)


class CurvesProperties(_Chosen):
    """The options of `mesh.fair_from_curves`."""

    table = CURVES
    __annotations__ = properties_of(CURVES)


class FilletProperties(_Chosen):
    """The options of `mesh.fair_fillet`."""

    table = FILLET
    __annotations__ = {
        **properties_of(FILLET),
        "confirm_on_release": BoolProperty(
            name="Confirm on Release",
            description="Accept when the button of the mouse is let go, as a tool of the toolbar does",
            default=False,
            options=_HIDDEN,
        ),
    }
