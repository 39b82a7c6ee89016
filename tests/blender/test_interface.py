"""Operator, menus, scripts and command as users meet them."""

import json
from dataclasses import asdict
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import module
from test_fill import border_edges, open_sphere
from test_panel import Layout


def properties(operator: str) -> Any:
    return getattr(bpy.ops.mesh, operator).get_rna_type().properties


@pytest.mark.parametrize(
    ("operator", "home", "options"),
    [
        ("fair_region", "options", "FairOptions"),
        ("fair_fill", "other_options", "FillOptions"),
        ("fair_fillet", "other_options", "FilletOptions"),
    ],
)
def test_operators_and_scripts_have_the_same_options(operator: str, home: str, options: str) -> None:
    """With the same defaults; docs/options.md, which test_languages.py compares, has them as people read them."""
    of = getattr(module(f"options.{home}"), options)
    found = {p.identifier: p for p in properties(operator) if p.identifier in asdict(of())}
    for name, default in asdict(of()).items():
        assert found[name].default == pytest.approx(default)
        assert found[name].description
        assert not found[name].is_hidden
        assert found[name].is_skip_save  # each click begins with the defaults
    assert of.named({}) == of()


@pytest.mark.parametrize(
    "name", ["fair_region", "fair_live_region", "fair_select", "fair_live_forget", "fair_compare", "fair_inspect"]
)
def test_every_button_says_that_it_needs_edit_mode(name: str) -> None:
    meshes.grid()
    operator = getattr(bpy.ops.mesh, name)
    assert not operator.poll()
    with pytest.raises(RuntimeError, match="edit mode"):
        operator()


@pytest.mark.parametrize("named", [False, True])
def test_operator_without_a_window(named: bool) -> None:
    """In a context that a script has put together; Blender names no objects there by itself."""
    expected, faces = meshes.domed_grid()
    other, _ = meshes.domed_grid()
    obj, _ = meshes.domed_grid()
    twin = bpy.data.objects.new("Twin", obj.data)
    bpy.context.collection.objects.link(twin)
    meshes.fair(expected, faces)
    for chosen in (obj, other):
        meshes.select(chosen, faces)
    before = meshes.positions(other)
    meshes.edit(obj, other, twin)
    keywords = {"objects_in_mode": [obj, twin]} if named else {}
    with bpy.context.temp_override(window=None, area=None, region=None, edit_object=obj, **keywords):
        assert bpy.ops.mesh.fair_region.poll()
        assert bpy.ops.mesh.fair_region() == {"FINISHED"}
        with pytest.raises(RuntimeError, match="Pin Group"):
            bpy.ops.mesh.fair_region(pin_group="Missing")
    meshes.leave()
    assert meshes.positions(obj).tobytes() == meshes.positions(expected).tobytes()
    assert meshes.positions(other).tobytes() == before.tobytes()


def test_fair_mesh_refuses() -> None:
    from bl_ext.user_default.intrinsic_fairing import fair_mesh

    obj, faces = meshes.domed_grid()
    indices = np.flatnonzero(faces)
    before = meshes.contents(obj)
    with pytest.raises(IndexError):
        fair_mesh(obj.data, [len(faces)])
    with pytest.raises(TypeError):
        fair_mesh(obj.data, indices, fator=1.0)
    with pytest.raises(ValueError, match="shape: expected one of"):
        fair_mesh(obj.data, indices, shape="round")
    with pytest.raises(ValueError, match="matrix"):
        fair_mesh(obj.data, indices, matrix=np.eye(3))
    with pytest.raises(ValueError):
        fair_mesh(obj.data, indices[:1])
    assert meshes.contents(obj) == before
    meshes.edit(obj)
    with pytest.raises(ValueError, match="edit mode"):
        fair_mesh(obj.data, indices)


def command(*arguments: str) -> int:
    from bl_ext.user_default.intrinsic_fairing.run import cli

    status: int = cli.execute(list(arguments))
    return status


def test_command(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    obj, faces = meshes.domed_grid()
    inside = {v for i in np.flatnonzero(faces) for v in obj.data.polygons[i].vertices}
    obj.vertex_groups.new(name="Region").add(sorted(inside), 1.0, "REPLACE")
    output = tmp_path / "fair.blend"
    status = command(
        "--object", "Grid", "--vertex-group", "Region", "--output", str(output), "--report", "json", "--factor", "0.5"
    )
    assert status == 0
    lines = capsys.readouterr().out.splitlines()
    figures = json.loads(next(line for line in lines if line.startswith("{")))
    assert figures["free_vertices"] == int(meshes.free_vertices(obj, faces).sum())
    expected = meshes.positions(obj)
    bpy.ops.wm.open_mainfile(filepath=str(output))
    assert meshes.positions(bpy.data.objects["Grid"]).tobytes() == expected.tobytes()


def test_command_refuses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    meshes.domed_grid()
    output = tmp_path / "fair.blend"
    assert command("--object", "Nobody", "--output", str(output)) == 2
    assert "Nobody" in capsys.readouterr().err
    assert command("--object", "Grid", "--vertex-group", "No", "--output", str(output)) == 2
    assert not output.exists()


# The pie, and what scripts ask of a part of a boundary.


@pytest.mark.parametrize("mode", ["EDIT", "SCULPT", "OBJECT"])
def test_every_entry_of_the_pie_exists(mode: str) -> None:
    """Eight at most, as a pie has; each an operator that is registered."""
    meshes.grid()
    bpy.ops.object.mode_set(mode=mode)
    layout = Layout()
    layout.menu_pie = lambda: layout  # type: ignore[attr-defined]
    bpy.types.VIEW3D_MT_fair_pie.draw(SimpleNamespace(layout=layout), bpy.context)
    assert 2 <= len(layout.reported) <= 8
    assert len(set(layout.reported)) == len(layout.reported)
    bpy.ops.object.mode_set(mode="OBJECT")


def test_a_part_of_a_boundary_stands_for_all_of_it_in_scripts_too() -> None:
    obj = open_sphere(lambda c: abs(c.z) > 0.8)
    module().fill_mesh(obj.data, [int(meshes.positions(obj)[:, 2].argmax())])
    assert border_edges(obj) == 40
