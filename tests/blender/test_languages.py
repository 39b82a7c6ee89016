"""What people read: every language is whole, and the examples and tables of the documentation hold."""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import bpy
import numpy as np
import pytest

import meshes
from extension import module

SHOWS = re.compile(r"^([A-Z0-9]+_(OT|PT|MT)_\w+)$")  # classes whose label and tooltip Blender shows
REFUSES = {"ValueError", "BorderRefusal", "Verdict", "Changed"}
FOR_SCRIPTS = {"cli", "cli_parser", "script", "checked", "options", "mesh_io"}
SAYS = {"report", "require", "require_edit_mode", "translated", "pick"}
LANGUAGES = ["de", "fr"]
# Blender shows nothing of these, or has them in its own language files.
NOT_SHOWN = {"", "Undo", "Before Fair Masked", "Select Region", "*"}


def sources() -> Iterator[tuple[Path, ast.Module]]:
    """Yield the add-on's modules, as they are installed."""
    folder = Path(module().__file__).parent
    for path in folder.rglob("*.py"):
        if "presets" not in path.relative_to(folder).parts:
            yield path, ast.parse(path.read_text(encoding="utf-8"))


def constants(node: ast.AST) -> Iterator[str]:
    """Yield the texts that an argument may be: both of an `if`."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.value
    elif isinstance(node, ast.IfExp):
        yield from constants(node.body)
        yield from constants(node.orelse)


def of_call(node: ast.Call) -> Iterator[str]:
    name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
    for keyword in node.keywords:
        if keyword.arg == "text" or (keyword.arg in ("name", "description") and name.endswith("Property")):
            yield from constants(keyword.value)
    if name in SAYS:
        for argument in node.args:
            yield from constants(argument)


def of_class(node: ast.ClassDef) -> Iterator[str]:
    if SHOWS.match(node.name):
        yield " ".join((ast.get_docstring(node) or "").split())
        for line in node.body:
            if isinstance(line, ast.Assign) and getattr(line.targets[0], "id", "") == "bl_label":
                yield from constants(line.value)


def refusals(tree: ast.Module) -> Iterator[str]:
    """Yield what is refused or judged in words of the add-on's own; what only scripts meet names what it expected."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") in REFUSES:
            for argument in node.args:
                said = next(constants(argument), "")
                if " " in said and ": expected " not in said:
                    yield said


def of_operators() -> Iterator[str]:
    """Yield labels and tooltips of all options and choices that are offered."""
    for room in (bpy.ops.mesh, bpy.ops.object):
        for name in dir(room):
            if name.startswith("fair"):
                for option in getattr(room, name).get_rna_type().properties:
                    if option.identifier != "option" and option.type != "POINTER" and not option.is_hidden:
                        yield from (option.name, option.description)
                        for item in getattr(option, "enum_items", ()):
                            yield from (item.name, item.description)


def of_settings() -> Iterator[str]:
    """Yield the same of the settings that no operator has."""
    manager = bpy.context.window_manager
    for group in (manager.fairing_overlay, manager.fairing_live):
        for option in group.bl_rna.properties:
            if option.identifier not in ("rna_type", "name", "bl_idname"):
                yield from (option.name, option.description)
                for item in getattr(option, "enum_items", ()):
                    yield from (item.name, item.description)


def shown() -> set[str]:
    found: set[str] = set()
    for _, tree in sources():
        for node in ast.walk(tree):
            if isinstance(node, ast.Call):
                found.update(of_call(node))
            elif isinstance(node, ast.ClassDef):
                found.update(of_class(node))
    found.update(of_operators(), of_settings(), module("options.table").GROUPS, module("options.table").FOLDED)
    found.add(module("options.other_options").HOLES)
    for path, tree in sources():
        if path.stem not in FOR_SCRIPTS:
            found.update(refusals(tree))
    return {text for text in found - NOT_SHOWN if any(letter.isalpha() for letter in re.sub(r"\{[^}]*\}", "", text))}


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_language_has_every_text(language: str) -> None:
    assert sorted(shown() - module("translations").languages()[language].keys()) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_language_has_nothing_that_is_not_shown(language: str) -> None:
    said = set()
    for _, tree in sources():
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                said.update((node.value, " ".join(node.value.split())))
    assert sorted(module("translations").languages()[language].keys() - said) == []


def test_a_message_of_a_report_is_worded_though_blender_keeps_its_letters_alone() -> None:
    said = module("words.words").said("kink", n=2, degrees=31.0)
    report = bpy.context.window_manager.fairing_report
    module("verdict.properties").store_refusal(report, "Cube", said)
    assert module("verdict.properties").message(report.reason) is said


# The examples of the documentation run as they stand there.
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
