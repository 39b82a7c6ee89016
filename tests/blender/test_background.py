"""Objects faired in a thread, and what the redo panel answers from. The events around it are for the GUI tests."""

from typing import Any

import bpy
import numpy as np

import meshes
from extension import module


def tasks_of(obj: Any, faces: Any) -> tuple[Any, Any]:
    options = module("options.options").FairOptions()
    meshes.enter(obj, faces)
    return module("run.job").read(bpy.context, options), options


def test_another_shape_key_is_noticed() -> None:
    """Of the same shape even: what was computed for the Basis must not end up in a key."""
    job = module("run.job")
    obj, faces = meshes.domed_grid()
    for name in ("Basis", "Smile"):
        obj.shape_key_add(name=name, from_mix=False)
    obj.active_shape_key_index = 0
    tasks, _ = tasks_of(obj, faces)
    assert job.is_current(bpy.context, tasks)
    obj.data.shape_keys.key_blocks["Basis"].lock_shape = True
    assert not job.is_current(bpy.context, tasks)
    obj.data.shape_keys.key_blocks["Basis"].lock_shape = False
    obj.active_shape_key_index = 1
    assert not job.is_current(bpy.context, tasks)


def test_factor_is_answered_from_memory_with_the_same_bits() -> None:
    job = module("run.job")
    obj, faces = meshes.domed_grid()
    start = meshes.positions(obj)
    tasks, options = tasks_of(obj, faces)
    job.memory.clear()
    asked: list[str] = []

    def progress(_fraction: float, stage: str) -> None:
        if stage != "measurement":  # which is the add-on's own
            asked.append(stage)

    half = type(options)(factor=0.5)
    whole = job.solve(tasks, options, progress)[0]
    assert asked
    asked.clear()
    blended = job.solve(tasks, half, progress)[0]
    assert not asked  # the engine was not called
    free = whole.vertices
    np.testing.assert_allclose(blended.positions, 0.5 * (start[free] + whole.positions), atol=1e-12)
    job.memory.clear()
    again = job.solve(tasks, half, progress)[0]
    assert asked
    assert again.positions.tobytes() == blended.positions.tobytes()
    moved = [type(tasks[0])(**{**vars(tasks[0]), "matrix": np.diag([1.0, 2.0, 1.0, 1.0])})]
    asked.clear()
    job.solve(moved, half, progress)
    assert asked  # another space is another problem
