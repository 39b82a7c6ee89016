"""Blender ends as it should after everything that listens has been used: a process of its own, and its exit status."""

from pathlib import Path

import pytest

import own_process

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
