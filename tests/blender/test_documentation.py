"""The examples of the documentation run as they stand there."""

import re
import subprocess
import sys
from pathlib import Path

import bpy
import numpy as np
import pytest

import meshes

DOCS = Path(__file__).parents[2] / "docs"
README = Path(__file__).parents[2] / "README.md"
EXAMPLES = [
    pytest.param(code, id=f"example {number}")
    for number, code in enumerate(re.findall(r"```python\n(.*?)```", (DOCS / "blender.md").read_text(), re.DOTALL))
]


def subdivided_monkey() -> meshes.Floats:
    """Return the positions of the head that the examples start from."""
    bpy.ops.mesh.primitive_monkey_add()
    monkey = bpy.context.object
    monkey.modifiers.new("Subdivision", "SUBSURF").levels = 2
    bpy.ops.object.modifier_apply(modifier="Subdivision")
    return meshes.positions(monkey)


@pytest.mark.parametrize("mode", [(True, False, False), (False, False, True)], ids=["vertex mode", "face mode"])
@pytest.mark.parametrize("code", EXAMPLES)
def test_example(code: str, mode: tuple[bool, bool, bool], capsys: pytest.CaptureFixture[str]) -> None:
    """As printed, on the file that Blender starts with: the ear is gone, and the rest of the head is as it was."""
    before = subdivided_monkey()
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    bpy.context.tool_settings.mesh_select_mode = mode
    capsys.readouterr()
    exec(compile(code, "example", "exec"), {})
    reported = capsys.readouterr().out.splitlines()
    assert any(line.startswith("True") for line in reported)  # each prints whether it converged
    if bpy.context.mode == "EDIT_MESH":
        meshes.leave()
        assert meshes.report().warnings == ""
    after = meshes.positions(bpy.context.object)
    assert before[:, 0].max() > 1.3
    assert after[:, 0].max() < 0.9
    moved = (before != after).any(axis=1)
    assert 0 < np.count_nonzero(moved) < 0.2 * len(moved)
    assert before[moved, 0].min() > 0.4


def test_example_of_the_readme(capsys: pytest.CaptureFixture[str]) -> None:
    """The cap that was cut off comes back: all of the sphere, as closely as Blender's own vertices lie on it."""
    (code,) = (c for c in re.findall(r"```python\n(.*?)```", README.read_text(), re.DOTALL) if "import bpy" in c)
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    capsys.readouterr()
    exec(compile(code, "README", "exec"), {})
    assert any(line.startswith("True") for line in capsys.readouterr().out.splitlines())
    assert np.abs(np.linalg.norm(meshes.positions(bpy.context.object), axis=1) - 1).max() < 1e-5


def test_page_of_options_is_that_of_the_list() -> None:
    """`python scripts/option_tables.py` renews it."""
    made = subprocess.run(
        [sys.executable, "-c", "import option_tables; print(option_tables.page(), end='')"],
        cwd=DOCS.parent / "scripts",
        capture_output=True,
        text=True,
        check=True,
        timeout=60,
    )
    assert made.stdout == (DOCS / "options.md").read_text()
