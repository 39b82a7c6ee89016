"""Shape keys: all of them in one run, and a verdict on what is shown."""

from typing import Any

import bpy
import numpy as np
import pytest

import meshes


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


def test_without_it_keys_follow_the_basis() -> None:
    obj, faces = keyed()
    before = heights(obj, "High") - heights(obj, "Basis")
    meshes.fair(obj, faces)
    assert meshes.report().verdict == "GOOD"  # no other key is shown
    assert np.abs(heights(obj, "High") - heights(obj, "Basis") - before).max() < 1e-6


def test_a_key_that_is_shown_and_keeps_its_hill_deserves_a_look_and_all_keys_help() -> None:
    obj, faces = keyed()
    obj.data.shape_keys.key_blocks["High"].value = 1.0
    meshes.select(obj, faces)
    meshes.edit(obj)
    meshes.run()
    assert (meshes.report().verdict, meshes.report().remedies.split(",")[0]) == ("LOOK", "ALL_KEYS")
    assert "shape key that is shown" in meshes.report().reason
    assert bpy.ops.mesh.fair_again(way="ALL_KEYS") == {"FINISHED"}
    assert meshes.report().verdict == "GOOD"
    meshes.leave()
    assert np.abs(heights(bpy.data.objects[obj.name], "High")[:, 2]).max() < 0.01


def test_a_locked_key_refuses_them_all() -> None:
    obj, faces = keyed()
    obj.data.shape_keys.key_blocks["Tilted"].lock_shape = True
    before = meshes.in_edit_mode_once(obj, faces)
    with pytest.raises(RuntimeError, match="'Tilted' is locked"):
        meshes.fair(obj, faces, all_keys=True)
    assert meshes.contents(obj) == before
