"""Texts in other languages, for `bpy.app.translations`.

A language is a file languages/CODE.json: English texts with their translations. To add one, copy de.json, translate its
right-hand sides, and give Blender's names of it to _LOCALES; tests/blender/test_languages.py says what is missing.
Labels, tooltips and menu entries are looked up by Blender itself. Sentences put together at run time are English until
they are shown: `translated` recognizes them by their templates, which have fields in braces.
"""

from __future__ import annotations

import json
from functools import cache, lru_cache
from pathlib import Path

import bpy

from .templates import Templates

_FOLDER = Path(__file__).parent / "languages"
# Blender's names of a language: older versions know some by country only.
_LOCALES = {"de": ("de", "de_DE"), "fr": ("fr", "fr_FR")}
_CONTEXTS = ("*", "Operator")


def languages() -> dict[str, dict[str, str]]:
    """Return the texts of each language by its code."""
    return {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(_FOLDER.glob("*.json"))}


def table() -> dict[str, dict[tuple[str, str], str]]:
    """Return the texts in the form that Blender asks for."""
    return {
        locale: {(context, text): translation for text, translation in texts.items() for context in _CONTEXTS}
        for code, texts in languages().items()
        for locale in _LOCALES.get(code, (code,))
    }


def translated(text: str) -> str:
    """Return a text, or a sentence put together at run time, in the language of the interface."""
    found: str = bpy.app.translations.pgettext_iface(text)
    if found != text or not bpy.context.preferences.view.use_translate_interface:
        return found
    return _sentence(bpy.app.translations.locale.partition("_")[0], text)


@lru_cache(maxsize=1024)  # panels ask for the same sentences at every redraw; figures make new ones
def _sentence(code: str, text: str) -> str:
    return _templates(code).translated(text)


@cache
def _templates(code: str) -> Templates:
    return Templates(languages().get(code, {}))


def register() -> None:
    """Hand the texts to Blender."""
    bpy.app.translations.register(__package__, table())


def unregister() -> None:
    """Take them back."""
    bpy.app.translations.unregister(__package__)
