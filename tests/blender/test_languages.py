"""Every language is whole: what a person reads of the interface is there in German and in French, and nothing else."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import bpy
import pytest

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
