"""The examples of the documentation run as they stand there."""

from __future__ import annotations

import re
from pathlib import Path

import bpy
import meshes
import numpy as np
import pytest
from extension import module

DOCS = Path(__file__).parents[2] / "docs"
PAGES = ("blender.md", "user_guide.md")
EXAMPLES = [
    pytest.param(code, id=f"{page} {number}")
    for page in PAGES
    for number, code in enumerate(re.findall(r"```python\n(.*?)```", (DOCS / page).read_text(), re.DOTALL))
]


@pytest.mark.parametrize("code", EXAMPLES)
def test_example(code: str, capsys: pytest.CaptureFixture[str]) -> None:
    bpy.ops.mesh.primitive_monkey_add()
    monkey = bpy.context.object
    monkey.name = monkey.data.name = "Suzanne"
    monkey.modifiers.new("Subdivision", "SUBSURF").levels = 2
    bpy.ops.object.modifier_apply(modifier="Subdivision")
    before = meshes.positions(monkey)
    exec(compile(code, "example", "exec"), {})
    if bpy.context.mode == "EDIT_MESH":
        meshes.leave()
    assert np.abs(meshes.positions(monkey) - before).max() > 0.01
    assert "True" in capsys.readouterr().out  # each prints whether it converged


def test_every_option_is_explained() -> None:
    guide = (DOCS / "user_guide.md").read_text()
    labels = [p.name for p in bpy.ops.mesh.fair_region.get_rna_type().properties if p.identifier != "rna_type"]
    assert [label for label in labels if f"**{label}**" not in guide] == []


def test_every_choice_is_explained() -> None:
    guide = (DOCS / "user_guide.md").read_text()
    for option in bpy.ops.mesh.fair_region.get_rna_type().properties:
        if option.type == "ENUM":
            assert [i.name for i in option.enum_items if f"*{i.name}*" not in guide] == []


def test_command_is_documented() -> None:
    text = (DOCS / "blender.md").read_text()
    names = module("options").option_names()
    assert "--command fair" in text
    assert "--report json" in text
    assert all(f"`{name}`" in text for name in names)
