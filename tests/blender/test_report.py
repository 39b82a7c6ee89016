"""The report, its figures, and runs over all shape keys."""

import re
from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from test_restoration import spoil, upper_half


def checks() -> dict[str, tuple[str, str]]:
    return {check.name: (check.value, check.state) for check in meshes.report().checks}


def details() -> dict[str, bool]:
    return {check.name: check.detail for check in meshes.report().checks}


def test_nothing_is_good_before_it_has_been_looked_at() -> None:
    report = meshes.report()
    report.property_unset("verdict")
    assert report.verdict == "UNUSABLE"


def test_options_that_nothing_looked_at_are_reported_by_their_labels(capfd: pytest.CaptureFixture[str]) -> None:
    obj, faces = meshes.domed_grid()
    meshes.fair(obj, faces, shape="MINIMAL_ENERGY", bulge=0.5)
    assert checks()["Without effect"] == ("Bulge", "TOLD")
    assert details()["Without effect"]
    assert "Without effect with these options: Bulge" in capfd.readouterr().out
    meshes.fair(obj, faces, bulge=0.1)
    assert "Without effect" not in checks()


def test_report_of_a_restored_hemisphere() -> None:
    obj = meshes.sphere(96)
    upper = upper_half(obj)
    spoil(obj, upper)
    meshes.fair(obj, upper)
    found = checks()
    assert meshes.report().verdict == "GOOD"
    assert [name for name in found if not details()[name]] == [
        "Shape",
        "Kink at the boundary",
        "Kink limit",
        "Folded faces",
        "Faces that cross",
        "Texture distortion",
    ]
    assert found["Shape"] == ("Harmonic", "TOLD")
    assert found["Surface found"] == ("yes", "TOLD")
    assert found["Kink at the boundary"][1] == "MET"
    # H = −1 inside and out: the maximum principle is met with equality
    inside, boundary = map(float, re.split(" [≤>] ", found["Curvature inside"][0]))
    assert inside == pytest.approx(1.0, abs=5e-3)
    assert boundary == pytest.approx(1.0, abs=5e-3)
    rough, solved = map(float, found["Residual"][0].split(" → "))
    assert solved < 1e-2 * rough
    before, after = found["Folded faces"][0].split(" → ")
    assert int(before) > 0
    assert int(after) == 0
    assert found["Faces that cross"][0].endswith("→ 0")
    assert 0.0 <= meshes.report().join_typical <= meshes.report().join_worst < 2.0
    assert meshes.report().seconds > 0.0


def test_what_was_edited_since_is_not_compared() -> None:
    obj, faces = meshes.domed_grid()
    meshes.enter(obj, faces)
    meshes.run()
    bpy.ops.transform.translate(value=(0.0, 0.0, 0.5))
    with pytest.raises(RuntimeError, match="changed after the run"):
        bpy.ops.mesh.fair_compare("EXEC_DEFAULT", True)


# Shape keys: all of them in one run, and a verdict on what is shown.
def hill(points: Any, x: float, height: float) -> Any:
    """Positions with a round hill at x."""
    raised = points.copy()
    raised[:, 2] += height * np.exp(-40.0 * ((points[:, 0] - x) ** 2 + points[:, 1] ** 2))
    return raised


def keyed() -> tuple[bpy.types.Object, Any]:
    """A plain with a hill; a key with a higher one, a key that tilts it all, and one that lifts it all."""
    obj = meshes.grid(32)
    flat = meshes.grid_points(32)
    basis = hill(flat, 0.0, 0.1)
    tilted, lifted = basis.copy(), basis + np.array([0.0, 0.0, 0.3])
    tilted[:, 2] += 0.4 * basis[:, 0]
    meshes.move(obj, basis)
    for name, points in (("Basis", basis), ("High", hill(basis, 0.1, 0.4)), ("Tilted", tilted), ("Lifted", lifted)):
        key = obj.shape_key_add(name=name)
        key.data.foreach_set("co", points.astype(np.float32).ravel())
        key.value = 0.0
    obj.active_shape_key_index = 0
    return obj, meshes.faces_where(obj, lambda c: c.xy.length < 0.6)


def heights(obj: bpy.types.Object, name: str) -> Any:
    flat = np.empty(3 * len(obj.data.vertices), dtype=np.float32)
    obj.data.shape_keys.key_blocks[name].data.foreach_get("co", flat)
    return flat.reshape(-1, 3)


def test_all_keys_are_faired_each_from_its_own_surroundings() -> None:
    obj, faces = keyed()
    meshes.fair(obj, faces, all_keys=True)
    assert meshes.report().verdict == "GOOD"
    for name in ("Basis", "High"):
        assert np.abs(heights(obj, name)[:, 2]).max() < 0.01, name
    tilted = heights(obj, "Tilted")
    assert np.abs(tilted[:, 2] - 0.4 * tilted[:, 0]).max() < 0.01
    assert np.abs(heights(obj, "Lifted") - heights(obj, "Basis") - [0.0, 0.0, 0.3]).max() < 1e-6


def test_a_key_that_is_active_moves_alone() -> None:
    obj, faces = keyed()
    obj.active_shape_key_index = 1
    before = {key.name: heights(obj, key.name) for key in obj.data.shape_keys.key_blocks}
    meshes.fair(obj, faces)
    moved = {name for name, there in before.items() if (heights(obj, name) != there).any()}
    assert moved == {"High"}


def test_a_key_that_is_shown_and_keeps_its_hill_deserves_a_look_and_all_keys_help() -> None:
    obj, faces = keyed()
    obj.data.shape_keys.key_blocks["High"].value = 1.0
    meshes.select(obj, faces)
    meshes.edit(obj)
    meshes.run()
    assert (meshes.report().verdict, meshes.report().remedies.split(",")[0]) == ("LOOK", "ALL_KEYS")
    assert "visible shape key" in meshes.report().reason
    assert bpy.ops.mesh.fair_again(remedy="ALL_KEYS") == {"FINISHED"}
    assert meshes.report().verdict == "GOOD"
    meshes.leave()
    assert np.abs(heights(bpy.data.objects[obj.name], "High")[:, 2]).max() < 0.01


def test_a_locked_key_refuses_them_all() -> None:
    obj, faces = keyed()
    obj.data.shape_keys.key_blocks["Tilted"].lock_shape = True
    before = meshes.in_edit_mode_once(obj, faces)
    with pytest.raises(RuntimeError, match=r"Unlock the .*'Tilted'"):
        meshes.fair(obj, faces, all_keys=True)
    assert meshes.contents(obj) == before
