# mypy: disable-error-code="valid-type"
"""The add-on's preferences.

No postponed annotations here: Blender reads them as property definitions.
"""

import bpy
from bpy.props import IntProperty, StringProperty

from .tab_name import USUAL, changed

BACKGROUND_FROM = 4000  # free vertices: about a third of a second
INSPECT_UP_TO = 30_000  # faces: about 0.15 s


class FairPreferences(bpy.types.AddonPreferences):
    """What an artist may want to set once"""

    bl_idname = __package__

    background_from: IntProperty(
        name="In the Background From",
        description="Selections with so many free vertices are faired in the background from the start, with progress "
        "and Esc; smaller ones as soon as they take longer than a moment",
        default=BACKGROUND_FROM,
        min=0,
        soft_max=100_000,
    )
    inspect_up_to: IntProperty(
        name="Look at Selections Up To",
        description="Larger meshes are examined on demand only, so that selecting stays quick",
        default=INSPECT_UP_TO,
        min=0,
        soft_max=1_000_000,
    )

    tab: StringProperty(
        name="Sidebar Tab",
        description="The tab of the 3D view's sidebar that holds the panels; several add-ons can share one",
        default=USUAL,
        update=changed,
    )

    def draw(self, _context: bpy.types.Context) -> None:
        """Draw all three."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "background_from")
        layout.prop(self, "inspect_up_to")
        layout.prop(self, "tab")


def _chosen(context: bpy.types.Context) -> FairPreferences | None:
    addon = context.preferences.addons.get(__package__)
    return addon.preferences if addon is not None else None


def background_from(context: bpy.types.Context) -> int:
    """Return the number of free vertices from which a run goes to the background."""
    chosen = _chosen(context)
    return BACKGROUND_FROM if chosen is None else int(chosen.background_from)


def inspect_up_to(context: bpy.types.Context) -> int:
    """Return the number of faces up to which the panel looks by itself."""
    chosen = _chosen(context)
    return INSPECT_UP_TO if chosen is None else int(chosen.inspect_up_to)


def sidebar_tab(context: bpy.types.Context) -> str:
    """Return the name of the sidebar's tab."""
    chosen = _chosen(context)
    return (chosen.tab.strip() if chosen is not None else "") or USUAL
