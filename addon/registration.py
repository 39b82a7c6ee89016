"""Makes everything known to Blender, and takes it back."""

from typing import Any

import bpy

from . import file_owned, translations
from .curves.operator import MESH_OT_fair_from_curves
from .denoise.operator import MESH_OT_fair_denoise
from .fair.brush import FairDab, MESH_OT_fair_brush
from .fair.masked import MESH_OT_fair_masked
from .fair.operator import MESH_OT_fair_region
from .fill.operator import MESH_OT_fair_fill
from .fillet.operator import MESH_OT_fair_fillet
from .host import handlers
from .live import live
from .live.operators import FairLive, MESH_OT_fair_live_forget
from .live.start import MESH_OT_fair_live_region
from .options import preset_operators, redo_panel
from .overlay import overlay
from .overlay.settings import FairOverlay
from .run import cli, compare, redo
from .run.again import MESH_OT_fair_again
from .run.background import MESH_OT_fair_cancel
from .run.redo import MESH_OT_fair_follow
from .selection import watch
from .selection.tools import MESH_OT_fair_select
from .show import marks, menus, preview, tools, ui
from .verdict.properties import FairCheck, FairProgress, FairReport

_CLASSES: tuple[Any, ...] = (
    FairCheck,
    FairReport,
    FairProgress,
    FairOverlay,
    FairLive,
    MESH_OT_fair_region,
    MESH_OT_fair_masked,
    FairDab,
    MESH_OT_fair_brush,
    MESH_OT_fair_fill,
    MESH_OT_fair_fillet,
    MESH_OT_fair_denoise,
    MESH_OT_fair_from_curves,
    MESH_OT_fair_live_region,
    MESH_OT_fair_live_forget,
    compare.MESH_OT_fair_compare,
    MESH_OT_fair_cancel,
    MESH_OT_fair_follow,
    preset_operators.MESH_MT_fair_region_runs,
    preset_operators.MESH_MT_fair_fill_runs,
    *menus.MENUS,
    *tools.MACROS,
    MESH_OT_fair_select,
    MESH_OT_fair_again,
    watch.MESH_OT_fair_inspect,
    *ui.PANELS,
)
for _class in _CLASSES:  # tooltips break their lines by themselves
    _class.bl_description = " ".join((_class.__doc__ or "").split())
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(_CLASSES)
_SETTINGS = {
    "fairing_report": FairReport,
    "fairing_progress": FairProgress,
    "fairing_overlay": FairOverlay,
    "fairing_live": FairLive,
}  # of the window manager
_MODULES: tuple[Any, ...] = (
    redo_panel,
    menus,
    handlers,
    watch,
    overlay,
    preview,
    live,
    marks,
    tools,
    compare,
    redo,
    file_owned,
    translations,
)
_commands: list[Any] = []  # handles that Blender wants back at unregistering


def register() -> None:
    _register_classes()
    for name, kind in _SETTINGS.items():
        setattr(bpy.types.WindowManager, name, bpy.props.PointerProperty(type=kind))
    for module in _MODULES:
        module.register()
    _commands.append(bpy.utils.register_cli_command("fair", cli.execute))


def unregister() -> None:
    bpy.utils.unregister_cli_command(_commands.pop())
    for module in reversed(_MODULES):
        module.unregister()
    for name in reversed(_SETTINGS):
        delattr(bpy.types.WindowManager, name)
    _unregister_classes()
