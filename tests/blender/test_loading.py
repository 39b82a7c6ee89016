"""Blender in a process of its own: where the native module doesn't load, and how it ends after all was used."""

import platform
from pathlib import Path

import pytest

import own_process
from extension import module

PLATFORM = {"Linux": "linux-x64", "Windows": "windows-x64"}[platform.system()]  # the zip's

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


def engine_name() -> str:
    """The name that the engine has in this extension, and in no other."""
    return f"intrinsic_fairing_{module('loading').manifest()['version'].replace('.', '_')}"


def test_module_is_missing(tmp_path: Path) -> None:
    """No traceback: a panel, and lines in the console, with platform, Python and wheel."""
    console, drawn, wheel = printed(f'sys.modules["{engine_name()}"] = None', tmp_path)
    for text in (engine_name(), platform.machine(), platform.python_version(), PLATFORM, wheel):
        assert text in drawn
    assert wheel in console


def test_native_part_cannot_be_loaded(tmp_path: Path) -> None:
    """The package is there, its compiled part isn't: what a wheel for another system does."""
    native = f"{engine_name()}._core"
    assert native in printed(f'sys.modules["{native}"] = None', tmp_path)[1]


def test_another_extensions_module_of_the_usual_name(tmp_path: Path) -> None:
    """Blender has one folder for the wheels of all extensions; the engine's name in there is this version's own."""
    foreign = "import sys, types\nsys.modules['fairing'] = types.ModuleType('fairing')\n"
    lines = 'from extension import module\nprint("ENGINE", module().fairing.__name__, module("loading").problem())'
    printed = own_process.run(lines, tmp_path, foreign).stdout
    assert printed.partition("ENGINE ")[2].strip() == engine_name()


# Blender ends as it should after everything that listens has been used: a process of its own, and its exit status.
USE = """
import addon_utils
import meshes

manager = bpy.context.window_manager
obj, faces = meshes.domed_grid()
meshes.fair(obj, faces)
manager.fairing_overlay.show = True
meshes.edit(obj)
bpy.ops.mesh.fair_live_region()
assert manager.fairing_live.on
"""


ENDINGS = {
    "in use": "",
    "disabled": "addon_utils.disable('bl_ext.user_default.intrinsic_fairing')",
    "disabled and enabled": """
for _ in range(20):
    addon_utils.disable('bl_ext.user_default.intrinsic_fairing')
    addon_utils.enable('bl_ext.user_default.intrinsic_fairing')
""",
}


@pytest.mark.parametrize("ending", ENDINGS)
def test_blender_ends_well(ending: str, tmp_path: Path) -> None:
    ended = own_process.run(USE + ENDINGS[ending], tmp_path)
    assert "Error" not in ended.stderr
