"""The extension's place in the window: its tab, its report, running it, and a drag with the mouse."""

import os
import sys
import time
from typing import Any, ClassVar

import bpy

from driver import Story, click, in_view, middle, move_mouse, press, screenshot, view

ID = "bl_ext.user_default.intrinsic_fairing"
_options: dict[str, Any] = {}  # that Fair Region is run with


def extension() -> None:
    """Install the zip and open the sidebar's tab."""
    bpy.ops.extensions.package_install_files(
        repo="user_default", filepath=os.environ["FAIRING_ZIP"], enable_on_install=True, overwrite=True
    )
    bpy.context.preferences.view.show_splash = False
    # Else the sidebar's redraws take the whole 3D view along, eight times each: slow without a GPU.
    bpy.context.preferences.system.viewport_aa = "OFF"
    bpy.context.preferences.system.use_region_overlap = False
    _, area, _ = view()
    area.spaces.active.show_region_ui = True


def open_tab() -> None:
    area = view()[1]
    next(r for r in area.regions if r.type == "UI").active_panel_category = "Fairing"
    area.tag_redraw()


def report() -> Any:
    return bpy.context.window_manager.fairing_report


def module(name: str) -> Any:
    return sys.modules[f"{ID}.{name}"]


def wait_until(condition: Any, seconds: float) -> Story:
    begin = time.perf_counter()
    while not condition():
        if time.perf_counter() - begin > seconds:
            raise TimeoutError(f"{condition.__name__} did not come true in {seconds} s")
        yield 0.05


def run_operator(operator: str = "mesh.fair_region") -> None:
    """Run it as a button does, Fair Region with what set_options has set."""
    run_with(operator.partition(".")[2], **(_options if operator == "mesh.fair_region" else {}))


def run_with(operator: str, **properties: Any) -> None:
    """Run an operator of meshes as a button with these properties does."""
    with in_view():
        getattr(bpy.ops.mesh, operator)("INVOKE_DEFAULT", True, **properties)


def set_options(**options: Any) -> None:
    """Have Fair Region run with its defaults, apart from these, and Live, which goes by the last run, too."""
    _options.clear()
    _options.update(options)
    last = bpy.context.window_manager.operator_properties_last("mesh.fair_region")
    for option in module("options.table").table(module("options.options").FairOptions):
        last.property_unset(option.name)
    for name, value in options.items():
        setattr(last, name, value)


def solve_to(tolerance: float | None) -> None:
    """Have every solve end at that tolerance, so that it takes long; None: as usual."""
    options = module("options.options").FairOptions
    usual = vars(solve_to).setdefault("usual", options.engine_arguments)
    options.engine_arguments = usual if tolerance is None else (lambda o: {**usual(o), "tolerance": tolerance})


def redo_panel() -> Any:
    """The region of the panel at the lower left."""
    return next(r for r in view()[1].regions if r.type == "HUD")


def open_redo_panel() -> Story:
    """Open it with a click on its header, unless it is open."""
    hud = redo_panel()
    if hud.height < 100:
        yield from click(hud.x + hud.width // 2, hud.y + hud.height // 2)
        yield 1.0
    assert redo_panel().height > 100, "the redo panel is closed"


class WM_OT_story_redo(bpy.types.Operator):
    """Runs the last operator again as its redo panel does, from an event.

    Not from a timer inside `temp_override`: a search that is under way may run Python meanwhile (run/repeat.py).
    """

    bl_idname = "wm.story_redo"
    bl_label = "Redo"
    bl_options = {"INTERNAL"}  # noqa: RUF012 - the form that Blender asks for

    runs: ClassVar[int] = 0

    def execute(self, _context: bpy.types.Context) -> set[str]:
        bpy.ops.ed.undo_redo("EXEC_DEFAULT", True)
        WM_OT_story_redo.runs += 1
        return {"FINISHED"}


def change_with(**properties: Any) -> Story:
    """Change options of the last operator and run it again: what its redo panel does when a field is left."""
    operator = bpy.context.window_manager.operators[-1]
    for name, value in properties.items():
        setattr(operator.properties, name, value)
    if not hasattr(bpy.types, "WM_OT_story_redo"):
        bpy.utils.register_class(WM_OT_story_redo)
        keys = bpy.context.window_manager.keyconfigs.addon.keymaps.new(name="3D View", space_type="VIEW_3D")
        keys.keymap_items.new(WM_OT_story_redo.bl_idname, "F19", "PRESS")
    count = WM_OT_story_redo.runs
    press("F19", *middle())

    def is_done() -> bool:
        return WM_OT_story_redo.runs > count

    yield from wait_until(is_done, 20.0)


def redo_with(**properties: Any) -> Story:
    """Do so, and wait for the answer."""
    yield from change_with(**properties)

    def is_answered() -> bool:
        return not bpy.context.window_manager.fairing_progress.following

    yield from wait_until(is_answered, 120.0)
    yield 0.5


def drag(steps: int, by: tuple[int, int], axis: str = "") -> Story:
    """Grab what is selected (G) and move the mouse by so many pixels; the caller confirms or cancels."""
    x, y = middle()
    move_mouse(x, y)
    yield 0.1
    press("G", x, y)
    yield 0.1
    if axis:
        press(axis, x, y)
        yield 0.1
    for step in range(1, steps + 1):
        move_mouse(x + by[0] * step // steps, y + by[1] * step // steps)
        yield 0.0


def drag_over(places: list[tuple[int, int]], picture: str = "") -> Story:
    """Go over these places, in pixels from the middle of the view, with the button held; a picture just before the end.

    Each move between two places takes eight moves.
    """
    x, y = middle()
    window = view()[0]
    (x0, y0), *rest = [(x + dx, y + dy) for dx, dy in places]
    move_mouse(x0, y0)
    yield 0.2
    window.event_simulate(type="LEFTMOUSE", value="PRESS", x=x0, y=y0)
    for x1, y1 in rest:
        for k in range(1, 9):
            yield 0.03
            move_mouse(x0 + (x1 - x0) * k // 8, y0 + (y1 - y0) * k // 8)
        x0, y0 = x1, y1
    yield 0.5
    if picture:
        screenshot(picture)
    window.event_simulate(type="LEFTMOUSE", value="RELEASE", x=x0, y=y0)
    yield 0.1
