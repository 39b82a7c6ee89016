"""Every language is whole: what a person reads of the interface is there in German and in French, and nothing else."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import pytest

from extension import ID, module

SHOWS = re.compile(r"^([A-Z0-9]+_(OT|PT|MT)_\w+)$")  # classes whose label and tooltip Blender shows
REFUSES = {"ValueError", "BorderRefusal", "Verdict", "Changed"}
FOR_SCRIPTS = {
    "cli",
    "cli_parser",
    "fair_mesh",
    "fill_mesh",
    "fillet_mesh",
    "denoise_mesh",
    "checked",
    "options",
    "mesh_io",
}
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


def template(node: ast.JoinedStr) -> str:
    """Return a text put together at run time as the languages have it: its fields in braces."""
    parts = []
    for part in node.values:
        if isinstance(part, ast.Constant):
            parts.append(str(part.value))
        elif isinstance(part, ast.FormattedValue):
            form = ast.unparse(part.format_spec)[2:-1] if part.format_spec else ""
            parts.append("{" + ast.unparse(part.value) + (f":{form}" if form else "") + "}")
    return "".join(parts)


def phrases(node: ast.Call) -> Iterator[str]:
    """Yield what `counted` makes."""
    if getattr(node.func, "id", "") == "counted":
        for argument in node.args[1:]:
            for phrase in constants(argument):
                yield f"{{count}} {phrase}"


def sentences() -> set[str]:
    """Return the templates of the engine's errors and warnings."""
    cases = (words for of_code in module("core.words").WORDS.values() for words in of_code)
    return {text for words in cases for text in (words.one, words.many) if text}


def refusals(tree: ast.Module) -> Iterator[str]:
    """Yield what is refused or judged in words of the add-on's own; what only scripts meet names what it expected."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Call) and getattr(node.func, "id", "") in REFUSES:
            for argument in node.args:
                said = template(argument) if isinstance(argument, ast.JoinedStr) else next(constants(argument), "")
                if " " in said and ": expected " not in said:
                    yield said


def of_operators() -> Iterator[str]:
    """Yield labels and tooltips of all options and choices that are offered."""
    for room in (bpy.ops.mesh, bpy.ops.object):
        for name in dir(room):
            if name.startswith("fair") and not name.endswith("preset_add"):
                for option in getattr(room, name).get_rna_type().properties:
                    if option.identifier != "option" and option.type != "POINTER" and not option.is_hidden:
                        yield from (option.name, option.description)
                        for item in getattr(option, "enum_items", ()):
                            yield from (item.name, item.description)


def of_settings() -> Iterator[str]:
    """Yield the same of the settings that no operator has."""
    manager = bpy.context.window_manager
    for group in (manager.fairing_overlay, manager.fairing_live, bpy.context.preferences.addons[ID].preferences):
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
    found.update(
        of_operators(), of_settings(), module("core.option_shared").GROUPS, module("core.option_shared").FOLDED
    )
    found.add(module("core.fill_options").HOLES)
    found |= sentences()
    for path, tree in sources():
        if path.stem not in FOR_SCRIPTS:
            found.update(refusals(tree))
    return {text for text in found - NOT_SHOWN if any(letter.isalpha() for letter in re.sub(r"\{[^}]*\}", "", text))}


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_language_has_every_text(language: str) -> None:
    assert sorted(shown() - module("translations").languages()[language].keys()) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_language_has_nothing_that_is_not_said(language: str) -> None:
    said = sentences()
    for _, tree in sources():
        for node in ast.walk(tree):
            if isinstance(node, ast.JoinedStr):
                said.add(template(node))
            elif isinstance(node, ast.Call):
                said.update(phrases(node))
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                said.update((node.value, " ".join(node.value.split())))
    assert sorted(module("translations").languages()[language].keys() - said) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_no_translation_is_empty_or_has_lost_its_figures(language: str) -> None:
    for text, translation in module("translations").languages()[language].items():
        assert translation.strip()
        fields: Any = re.findall(r"\{[^}]*\}", text)
        assert sorted(fields) == sorted(re.findall(r"\{[^}]*\}", translation)), text


@pytest.mark.parametrize(
    ("said", "german"),
    [
        ("No vertex is free to move: all are on the boundary or pinned", "Kein Vertex kann sich bewegen"),
        ("3 faces have a part without area", "3 Flächen haben einen Teil ohne Inhalt"),
        ("A kink shows at 2 vertices of the boundary, of 31° at worst", "Ein Knick zeigt sich am Rand, an 2 Vertices,"),
        ("Cube: The tube narrows to 61% of its ends", "Cube: Die Röhre verengt sich auf 61% ihrer Enden"),
        (
            "The boundary is on the slope of a bump, so that the bump stays: grow the selection over it",
            "Der Rand liegt am",
        ),
        (
            "2 borders run around the outside of a sheet of faces and stay open (7 edges, one at vertex 3): to fill "
            "one all the same, select it alone",
            "2 Ränder laufen außen um ein Blatt von Flächen und bleiben offen (7 Kanten",
        ),
        ("No fair surface was found for a boundary of 8 edges", "Keine glatte Fläche gefunden, bei einem Rand von 8"),
        ("1 of 13 holes stays open, and is selected. The", "1 von 13 Löchern bleibt offen und ist ausgewählt"),
        ("No fair surface was found: the search came to a halt", "Keine glatte Fläche gefunden: Die Suche kam"),
        ("Nobody says this of 3 things", "Nobody says this of 3 things"),
    ],
)
def test_a_sentence_put_together_at_run_time_is_translated(said: str, german: str) -> None:
    texts = module("translations").languages()["de"]
    assert module("templates").Templates(texts).translated(said).startswith(german)


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_sentence_of_the_engine_finds_its_own_template(language: str) -> None:
    """Figures are put in; what comes out is the translation of this sentence and of no other."""
    texts = module("translations").languages()[language]
    made = module("templates").Templates(texts)
    for text in sentences():
        fields = re.findall(r"\{[^}]*\}", text)
        english, expected = text, texts[text]
        for k, field in enumerate(dict.fromkeys(fields)):
            english, expected = english.replace(field, str(7 + k)), expected.replace(field, str(7 + k))
        assert made.translated(english) == expected
