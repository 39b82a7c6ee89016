"""Operator, menus, scripts and command as users meet them."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import pytest

import meshes

DEFAULTS = {
    "factor": 1.0,
    "shape": "AUTOMATIC",
    "bulge": 0.0,
    "continuity": "G1",
    "boundary_normals": "AUTOMATIC",
    "remesh": False,
    "inner_fairness": "AUTOMATIC",
    "spacing": 1.0,
    "quads": False,
    "detail": 0.0,
    "falloff": 0.0,
    "smooth_boundary": False,
    "vertex_group": "",
    "continuity_group": "",
    "use_mask": False,
    "all_keys": False,
    "pin_group": "",
    "pin_radius": 0.1,
    "pin_edges": "AUTOMATIC",
    "fair_pinned_edges": True,
    "pin_slope": "AUTOMATIC",
    "fair_open_borders": False,
    "fallback": True,
    "allow_folds": False,
}
CHOICES = {
    "shape": ["AUTOMATIC", "HARMONIC", "MINIMAL_ENERGY", "LEAST_VARIATION"],
    "inner_fairness": ["AUTOMATIC", "UNIFORM", "CONFORMAL", "INVERSE_DISTANCE", "SHAPE_PRESERVING"],
    "boundary_normals": ["AUTOMATIC", "SURROUNDING", "INSIDE", "AVERAGE", "CUSTOM"],
    "continuity": ["G0", "G1", "G2"],
    "pin_edges": ["AUTOMATIC", "NONE", "SHARP", "SEAM", "CREASE"],
    "pin_slope": ["AUTOMATIC", "CREASE", "SMOOTH", "AVERAGE"],
}


def properties() -> Any:
    return bpy.ops.mesh.fair_region.get_rna_type().properties


def test_operator_has_the_documented_properties() -> None:
    found = {p.identifier: p for p in properties() if p.identifier != "rna_type"}
    assert found.keys() == DEFAULTS.keys()
    for name, default in DEFAULTS.items():
        assert found[name].default == pytest.approx(default)
        assert found[name].description
        assert not found[name].is_hidden
        assert found[name].is_skip_save  # each click begins with the defaults
    for name, choices in CHOICES.items():
        assert [item.identifier for item in found[name].enum_items] == choices


def test_poll_says_why() -> None:
    meshes.grid()
    assert not bpy.ops.mesh.fair_region.poll()
    with pytest.raises(RuntimeError, match="edit mode"):
        bpy.ops.mesh.fair_region()
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.mesh.fair_region.poll()


@pytest.mark.parametrize(
    "name", ["fair_live_region", "fair_select", "fair_live_forget", "fair_compare", "fair_inspect"]
)
def test_every_button_says_that_it_needs_edit_mode(name: str) -> None:
    meshes.grid()
    operator = getattr(bpy.ops.mesh, name)
    assert not operator.poll()
    with pytest.raises(RuntimeError, match="edit mode"):
        operator()


def test_fair_mesh_is_the_operator() -> None:
    from bl_ext.user_default.intrinsic_fairing import fair_mesh

    obj, faces = meshes.domed_grid()
    obj.scale = (1.0, 2.0, 1.0)
    meshes.fair(obj, faces)
    scripted, _ = meshes.domed_grid()
    indices = np.flatnonzero(faces)
    result = fair_mesh(scripted.data, indices, matrix=obj.matrix_world)
    assert meshes.positions(scripted).tobytes() == meshes.positions(obj).tobytes()
    patch = np.unique([v for i in indices for v in obj.data.polygons[i].vertices])
    world = meshes.positions(obj)[patch] * (1.0, 2.0, 1.0)
    np.testing.assert_allclose(result.vertices, world, atol=1e-6)
    assert result.converged


def test_fair_mesh_keeps_every_other_bit() -> None:
    from bl_ext.user_default.intrinsic_fairing import fair_mesh

    obj, faces = meshes.domed_grid()
    for name in ("Basis", "Smile"):
        obj.shape_key_add(name=name)
    before = meshes.in_edit_mode_once(obj, faces)
    fair_mesh(obj.data, np.flatnonzero(faces))
    after = meshes.contents(obj)
    free = meshes.free_vertices(obj, faces)
    for name in ("POINT position", "key Basis", "key Smile"):
        old, new = (np.frombuffer(c[name], np.uint32).reshape(-1, 3) for c in (before, after))
        np.testing.assert_array_equal((old != new).any(axis=1), free)
    assert [k for k in before if k.startswith((".", "CORNER", "EDGE", "FACE")) and before[k] != after[k]] == []
    meshes.edit(obj)  # the positions survive edit mode, keys and all
    meshes.leave()
    assert meshes.contents(obj)["POINT position"] == after["POINT position"]


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


def test_fair_mesh_has_the_operators_defaults() -> None:
    from bl_ext.user_default.intrinsic_fairing.options import options

    assert options.FairOptions.named({}) == options.FairOptions()
    assert asdict(options.FairOptions()) == DEFAULTS


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
        "--object",
        "Grid",
        "--vertex-group",
        "Region",
        "--output",
        str(output),
        "--report",
        "json",
        "--factor",
        "0.5",
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
