"""What can't be written to one object is written to none, whatever goes wrong on the way: every bit stays."""

from typing import Any

import bpy
import numpy as np
import pytest

import meshes
from extension import module


def two_domes() -> list[bpy.types.Object]:
    """In edit mode, the second with shape keys, custom attributes and a group."""
    made = [meshes.domed_grid() for _ in range(2)]
    obj = made[1][0]
    for name in ("Basis", "Smile"):
        obj.shape_key_add(name=name)
    obj.data.shape_keys.key_blocks["Smile"].data[3].co.z += 0.5
    obj.active_shape_key_index = 0
    obj.vertex_groups.new(name="Some").add([1, 2, 3], 0.5, "REPLACE")
    push = obj.data.attributes.new("push", "FLOAT_VECTOR", "POINT")
    push.data.foreach_set("vector", np.linspace(0.0, 1.0, 3 * len(obj.data.vertices)))
    for each, chosen in made:
        meshes.in_edit_mode_once(each, chosen)
    for each, chosen in made:
        meshes.select(each, chosen)
    return [each for each, _ in made]


@pytest.mark.parametrize("options", [{}, {"remesh": True}, {"all_keys": True}], ids=["moved", "new", "keys"])
@pytest.mark.parametrize("error", [ValueError("no room"), RuntimeError("a fault")], ids=["refusal", "fault"])
def test_a_write_that_fails_leaves_every_object_as_it_was(
    options: dict[str, Any], error: Exception, monkeypatch: pytest.MonkeyPatch
) -> None:
    objects = two_domes()
    before = [meshes.contents(obj) for obj in objects]
    meshes.edit(*objects)
    job = module("run.job")
    written: list[str] = []
    write = job.write_one

    def failing(obj: bpy.types.Object, outcome: Any) -> Any:
        found = write(obj, outcome)
        written.append(obj.name)
        if len(written) == 2:
            raise error
        return found

    monkeypatch.setattr(job, "write_one", failing)
    with pytest.raises(RuntimeError, match=str(error)):
        bpy.ops.mesh.fair_region("EXEC_DEFAULT", True, **options)
    assert len(written) == 2
    assert bpy.context.mode == "EDIT_MESH"
    meshes.leave()
    assert [meshes.contents(obj) for obj in objects] == before
