"""Progress where the user looks: mouse pointer, status bar, sidebar."""

import bpy


def show_progress(context: bpy.types.Context, fraction: float, stage: str) -> None:
    """Tell how far a run is; the pointer's counter must have begun."""
    progress = context.window_manager.fairing_progress
    progress.running, progress.fraction, progress.stage = True, fraction, stage
    context.window_manager.progress_update(fraction)
    context.workspace.status_text_set(f"Fairing: {fraction:.0%}  {stage}    [Esc] Cancel")
    redraw_sidebars(context)


def hide_progress(context: bpy.types.Context) -> None:
    """Take the signs away again."""
    context.window_manager.fairing_progress.running = False
    if context.workspace is not None:
        context.workspace.status_text_set(None)
    redraw_sidebars(context)


def redraw_sidebars(context: bpy.types.Context) -> None:
    """Ask for a redraw of every 3D view's sidebar."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type == "UI":
                        region.tag_redraw()


def redraw_views(context: bpy.types.Context) -> None:
    """Ask for a redraw of every 3D view, sidebars included."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def view_selected(context: bpy.types.Context) -> None:
    """Turn the 3D view to what is selected: the one in use, or else the first one of the window."""
    window = context.window
    if window is None or bpy.app.background:
        return
    areas = [area for area in window.screen.areas if area.type == "VIEW_3D"]
    area = context.area if context.area in areas else next(iter(areas), None)
    if area is None:
        return
    region = next(region for region in area.regions if region.type == "WINDOW")
    with context.temp_override(window=window, area=area, region=region):
        bpy.ops.view3d.view_selected()
