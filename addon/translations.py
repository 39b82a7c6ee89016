"""Texts in other languages.

Labels, tooltips and menu entries are looked up by Blender itself (`bpy.app.translations`): languages/CODE.json has
English ones with their translations. Sentences have keys: words/CODE.json. To add a language, copy both files of
another one, translate their right-hand sides, and give Blender's names of it to _LOCALES;
tests/blender/test_languages.py says what is missing.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import bpy

from .words.words import Message, sentences_of, worded

_FOLDER = Path(__file__).parent / "languages"
# Blender's names of a language: older versions know some by country only.
_LOCALES = {"de": ("de", "de_DE"), "fr": ("fr", "fr_FR")}
_CONTEXTS = ("*", "Operator")


def languages() -> dict[str, dict[str, str]]:
    return {path.stem: json.loads(path.read_text(encoding="utf-8")) for path in sorted(_FOLDER.glob("*.json"))}


def table() -> dict[str, dict[tuple[str, str], str]]:
    """Return the texts in the form that Blender asks for."""
    return {
        locale: {(context, text): translation for text, translation in texts.items() for context in _CONTEXTS}
        for code, texts in languages().items()
        for locale in _LOCALES.get(code, (code,))
    }


def translated(text: str) -> str:
    """Return a label, or a message, in the language of the interface."""
    if not isinstance(text, Message):
        found: str = bpy.app.translations.pgettext_iface(text)
        return found
    if not bpy.context.preferences.view.use_translate_interface:
        return text
    return worded(text, _sentences(bpy.app.translations.locale.partition("_")[0]))


_sentences = cache(sentences_of)


def register() -> None:
    bpy.app.translations.register(__package__, table())


def unregister() -> None:
    bpy.app.translations.unregister(__package__)
