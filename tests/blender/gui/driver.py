"""Drives a Blender with a window: steps of a story between redraws, events, screenshots.

Runs inside Blender (`--python`), not under pytest.
"""

import os
import subprocess
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy

OUT = Path(os.environ["FAIRING_GUI_OUT"])
Story = Iterator[float]  # yields the seconds to wait until the next step


def view() -> tuple[Any, Any, Any]:
    """Return window, area and main region of the 3D view."""
    window = bpy.context.window_manager.windows[0]
    area = next(a for a in window.screen.areas if a.type == "VIEW_3D")
    return window, area, next(r for r in area.regions if r.type == "WINDOW")


def in_view() -> Any:
    """Context of the 3D view, for operators called between events."""
    window, area, region = view()
    return bpy.context.temp_override(window=window, area=area, region=region)


_first = view()[1].spaces.active.region_3d.view_rotation.copy()


def look_as_first() -> None:
    """Turn the view as it was when Blender opened: drags along an axis depend on it."""
    view()[1].spaces.active.region_3d.view_rotation = _first


def move_mouse(x: int, y: int) -> None:
    """Put the pointer there, in pixels of the window from its lower left corner."""
    view()[0].event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)


def leave_popup() -> Story:
    """Move the pointer away from a report that has popped up under it, and back."""
    x, y = middle()
    for place in ((x + 300, y + 250), (x - 300, y - 250), (x, y)):
        move_mouse(*place)
        yield 0.3


def press(key: str, x: int, y: int, **modifiers: bool) -> None:
    """Press and release a key or mouse button at a place."""
    window = view()[0]
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type=key, value=value, x=x, y=y, **modifiers)


def click(x: int, y: int) -> Story:
    """Click the left button as a hand does: the interface wants to see the pointer arrive."""
    window = view()[0]
    for key, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(type=key, value=value, x=x, y=y)
        yield 0.15


def middle() -> tuple[int, int]:
    """The middle of the 3D view."""
    region = view()[2]
    return region.x + region.width // 2, region.y + region.height // 2


def screenshot(name: str, crop: str = "") -> None:
    """Write what is on the screen to OUT; crop: WIDTHxHEIGHT+X+Y, default all."""
    cut = ["-crop", crop, "+repage"] if crop else []
    subprocess.run(["import", "-window", "root", *cut, str(OUT / f"{name}.png")], check=True)


def tell(text: str) -> None:
    """Add a line to the record of the run."""
    with (OUT / "record.txt").open("a") as record:
        record.write(text + "\n")
    print(text, flush=True)


def play(story: Callable[[], Story]) -> None:
    """Start the story once Blender is up; its end, or an error in it, ends Blender."""
    steps = story()

    def step() -> float | None:
        try:
            return next(steps)
        except StopIteration:
            tell("done")
            os._exit(0)
        except BaseException:  # Blender would go on for ever without its story
            tell(traceback.format_exc())
            screenshot("failure")
            os._exit(1)

    bpy.app.timers.register(step, first_interval=1.0, persistent=True)  # in the next file, too
