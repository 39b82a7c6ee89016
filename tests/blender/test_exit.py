"""Blender ends as it should after everything that listens has been used: a process of its own, and its exit status."""

from __future__ import annotations

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
    "disabled during a search": """
import sys
import bmesh
home = sys.modules['bl_ext.user_default.intrinsic_fairing.live.live']
region = sys.modules['bl_ext.user_default.intrinsic_fairing.live.region'].LiveRegion
answer = region.answer


def searching(self, positions, matrix, progress):
    while progress(0.0, ''):  # until told to end: once would be over before anyone looks, now and then
        answer(self, positions, matrix, progress)


region.answer = searching
home.PATIENCE, home.moment = -1.0, lambda: 0.0  # nothing is found at once, and nobody waits
for vertex in bmesh.from_edit_mesh(bpy.context.object.data).verts:
    vertex.co.z += 0.3 * vertex.co.x**2
bmesh.update_edit_mesh(bpy.context.object.data)
bpy.context.view_layer.update()
assert home.settle_all() and home.live.sessions['Grid'].search is not None
addon_utils.disable('bl_ext.user_default.intrinsic_fairing')
""",
    "another file": "bpy.ops.wm.read_homefile(use_empty=True)",
}


@pytest.mark.parametrize("ending", ENDINGS)
def test_blender_ends_well(ending: str, tmp_path: Path) -> None:
    ended = own_process.run(USE + ENDINGS[ending], tmp_path)
    assert "Error" not in ended.stderr
