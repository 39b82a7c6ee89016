"""All that is registered where the engine's module doesn't load: a panel that says so."""

from typing import Any

import bpy

from . import loading
from .host.text import draw_text

ADVICE = (
    "Remove the extension, restart Blender, and install the zip for this platform.",
    "If that does not help, send these lines to its authors.",
)


class VIEW3D_PT_fairing_loading(bpy.types.Panel):
    """Why there is nothing else here"""

    bl_label = "Intrinsic Fairing"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fairing"

    def draw(self, _context: bpy.types.Context) -> None:
        draw_text(self.layout, "The add-on's binary doesn't load.", "ERROR")
        for label, value in loading.details():
            draw_text(self.layout, f"{label}: {value}", "BLANK1")
        for sentence in ADVICE:
            draw_text(self.layout, sentence, "INFO")


def _report() -> None:
    print("Intrinsic Fairing: the engine's module doesn't load.")
    for label, value in loading.details():
        print(f"  {label}: {value}")


_register_classes: Any
_register_classes, _unregister_classes = bpy.utils.register_classes_factory((VIEW3D_PT_fairing_loading,))


def register() -> None:
    """Show the panel; say the same in the console, where background jobs look."""
    _register_classes()
    _report()


def unregister() -> None:
    _unregister_classes()
