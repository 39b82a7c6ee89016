"""Makes everything known to Blender, and takes it back."""

from typing import Any

import bpy

from . import file_owned, translations
from .curves.operator import MESH_OT_fair_from_curves
from .denoise.operator import MESH_OT_fair_denoise
from .fair import brush_preview
from .fair.brush import FairDab, MESH_OT_fair_brush
from .fair.masked import MESH_OT_fair_masked
from .fair.operator import MESH_OT_fair_region
from .fair.strokes import MESH_OT_fair_stroke
from .fill.operator import MESH_OT_fair_fill
from .fillet import preview as fillet_preview
from .fillet.operator import MESH_OT_fair_fillet
from .host import handlers
from .live import live
from .live.operators import FairLive, MESH_OT_fair_live_forget
from .live.start import MESH_OT_fair_live_region
from .options import preset_operators, redo_panel
from .options.chosen import MESH_OT_fair_reset
from .overlay import overlay
from .overlay.settings import FairOverlay
from .run import cli, compare, redo
from .run.again import MESH_OT_fair_again
from .run.background import MESH_OT_fair_cancel
from .run.redo import MESH_OT_fair_follow
from .selection import watch
from .selection.tools import MESH_OT_fair_select
from .show import gizmos, marks, menus, tools, ui
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
    MESH_OT_fair_reset,
    preset_operators.MESH_MT_fair_region_runs,
    preset_operators.MESH_MT_fair_fill_runs,
    *menus.MENUS,
    MESH_OT_fair_stroke,
    *tools.MACROS,
    *gizmos.GROUPS,
    MESH_OT_fair_select,
    MESH_OT_fair_again,
    watch.MESH_OT_fair_inspect,
    *ui.PANELS,
)
for _class in _CLASSES:  # tooltips break their lines by themselves
    _class.bl_description = " ".join((_class.__doc__ or "").split())
_register_classes, _unregister_classes = bpy.utils.register_classes_factory(_CLASSES)
_commands: list[Any] = []  # handles that Blender wants back at unregistering


def register() -> None:
    _register_classes()
    bpy.types.WindowManager.fairing_report = bpy.props.PointerProperty(type=FairReport)
    bpy.types.WindowManager.fairing_progress = bpy.props.PointerProperty(type=FairProgress)
    bpy.types.WindowManager.fairing_overlay = bpy.props.PointerProperty(type=FairOverlay)
    bpy.types.WindowManager.fairing_live = bpy.props.PointerProperty(type=FairLive)
    redo_panel.register()
    menus.register()
    handlers.register()
    watch.register()
    overlay.register()
    fillet_preview.register()
    brush_preview.register()
    live.register()
    marks.register()
    tools.register()
    compare.register()
    redo.register()
    file_owned.register()
    translations.register()
    _commands.append(bpy.utils.register_cli_command("fair", cli.execute))


def unregister() -> None:
    bpy.utils.unregister_cli_command(_commands.pop())
    translations.unregister()
    file_owned.unregister()
    redo.unregister()
    compare.unregister()
    tools.unregister()
    marks.unregister()
    live.unregister()
    brush_preview.unregister()
    fillet_preview.unregister()
    overlay.unregister()
    watch.unregister()
    handlers.unregister()
    menus.unregister()
    redo_panel.unregister()
    del bpy.types.WindowManager.fairing_live
    del bpy.types.WindowManager.fairing_overlay
    del bpy.types.WindowManager.fairing_progress
    del bpy.types.WindowManager.fairing_report
    _unregister_classes()
