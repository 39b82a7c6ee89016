"""Intrinsic Fairing: selected faces become the fair surface that continues their surroundings."""

from typing import Any

import bpy

from . import cli, ui
from .fair_mesh import fair_mesh
from .operators import MESH_OT_fair_region
from .properties import FairReport

__all__ = ["fair_mesh", "register", "unregister"]

_register_classes, _unregister_classes = bpy.utils.register_classes_factory(
    (FairReport, MESH_OT_fair_region, ui.VIEW3D_PT_fairing)
)
_commands: list[Any] = []  # handles that Blender wants back at unregistering


def register() -> None:
    """Make operator, panel, menu entries and command known to Blender."""
    _register_classes()
    bpy.types.WindowManager.fairing_report = bpy.props.PointerProperty(type=FairReport)
    bpy.types.VIEW3D_MT_edit_mesh_faces.append(ui.draw_menu)
    bpy.types.VIEW3D_MT_edit_mesh_context_menu.append(ui.draw_context_menu)
    _commands.append(bpy.utils.register_cli_command("fair", cli.execute))


def unregister() -> None:
    """Take back everything that register() did, in reverse."""
    bpy.utils.unregister_cli_command(_commands.pop())
    bpy.types.VIEW3D_MT_edit_mesh_context_menu.remove(ui.draw_context_menu)
    bpy.types.VIEW3D_MT_edit_mesh_faces.remove(ui.draw_menu)
    del bpy.types.WindowManager.fairing_report
    _unregister_classes()
