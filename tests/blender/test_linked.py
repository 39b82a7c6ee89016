"""Meshes linked from another file: what would be written there is lost, so that it is refused."""

from __future__ import annotations

from pathlib import Path

import bpy
import numpy as np
import pytest

import meshes
from extension import module


@pytest.fixture(params=["linked", "overridden"])
def linked(request: pytest.FixtureRequest, tmp_path: Path) -> tuple[bpy.types.Object, list[int]]:
    """Return an object whose mesh lies in another file, and faces to fair."""
    obj, faces = meshes.domed_grid()
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {obj})
    bpy.ops.wm.read_homefile(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.objects = ["Grid"]
    found = bpy.data.objects["Grid"]
    bpy.context.collection.objects.link(found)
    if request.param == "overridden":
        found = found.override_create(remap_local_usages=True)
        found.data.override_create(remap_local_usages=True)
    bpy.context.view_layer.objects.active = found
    return found, np.flatnonzero(faces).tolist()


def test_command_refuses_linked_data(
    linked: tuple[bpy.types.Object, list[int]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    output = tmp_path / "fair.blend"
    assert module("run.cli").execute(["--object", linked[0].name, "--output", str(output)]) == 2
    assert "linked from another file" in capsys.readouterr().err
    assert not output.exists()


def test_a_local_copy_is_fine(linked: tuple[bpy.types.Object, list[int]]) -> None:
    obj, faces = linked
    obj.data = obj.data.copy()
    obj.data.make_local(clear_liboverride=True)
    assert module().fair_mesh(obj.data, faces).converged
