"""What Blender shows where the native module doesn't load: in a process of its own, as nobody can load it again."""

from __future__ import annotations

import platform
from pathlib import Path

import own_process
import pytest

DRAW = """
from extension import ID, module
from test_panel import Layout

assert ID in bpy.context.preferences.addons
assert hasattr(bpy.types, "VIEW3D_PT_fairing_loading")
assert not hasattr(bpy.types, "VIEW3D_PT_fairing")


class Shown:
    layout = Layout()


shown = Shown()
module("loading_panel").VIEW3D_PT_fairing_loading.draw(shown, bpy.context)
print("DRAWN", *shown.layout.reported)
print("WHEEL", module("loading").manifest()["wheels"][0].removeprefix("./wheels/"))
"""


def printed(before: str, scratch: Path) -> tuple[str, str, str]:
    """Enable the extension after these lines; return what the console, the panel and the manifest say."""
    console, rest = own_process.run(DRAW, scratch, "import sys\n" + before).stdout.split("DRAWN ")
    drawn, wheel = rest.split("WHEEL ")
    return console, drawn, wheel.strip()


def test_module_is_missing(tmp_path: Path) -> None:
    """No traceback: a panel, and lines in the console, with platform, Python and wheel."""
    console, drawn, wheel = printed('sys.modules["fairing"] = None', tmp_path)
    for text in ("fairing", platform.machine(), platform.python_version(), "linux-x64", wheel):
        assert text in drawn
    assert wheel in console


def test_native_part_cannot_be_loaded(tmp_path: Path) -> None:
    """The package is there, its compiled part isn't: what a wheel for another system does."""
    assert "fairing._core" in printed('sys.modules["fairing._core"] = None', tmp_path)[1]


@pytest.mark.parametrize("version", ["0.0.9", "99.0"])
def test_module_of_another_version(version: str, tmp_path: Path) -> None:
    """After an update without a restart Blender still holds the old module."""
    held = f"""
from types import ModuleType

sys.modules["fairing"] = ModuleType("fairing")
sys.modules["fairing"].__version__ = "{version}"
"""
    drawn = printed(held, tmp_path)[1]
    assert version in drawn
    assert "Restart Blender" in drawn
