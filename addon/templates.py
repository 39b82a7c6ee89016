"""Sentences put together at run time, in another language. Plain Python, no bpy.

A language's texts hold templates as the source has them, with fields in braces. A sentence is recognized by the
template that made it; what stood in the fields goes into the translation, itself translated where it is a phrase.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

_FIELD = re.compile(r"\{[^}]*\}")
# How sentences follow each other, and how a name precedes one.
_JOINTS = (". ", ": ", ", ")


class Templates:
    """The texts of one language, those with fields included."""

    def __init__(self, texts: Mapping[str, str]) -> None:
        """Take English texts with their translations."""
        self._texts = texts
        with_fields = [text for text in texts if _FIELD.search(text)]
        # The one that says most comes first: a field would take in the words of another template.
        with_fields.sort(key=lambda text: len(_FIELD.sub("", text)), reverse=True)
        self._patterns = [(_pattern(text), _FIELD.findall(text), texts[text]) for text in with_fields]

    def translated(self, text: str) -> str:
        """Return the sentence in the language; what no text and no template makes stays as it is."""
        return self._found(text) or self._in_parts(text) or text

    def _found(self, text: str) -> str:
        if text in self._texts:
            return self._texts[text]
        for pattern, fields, translation in self._patterns:
            met = pattern.fullmatch(text)
            if met:
                for field, value in zip(fields, met.groups(), strict=True):
                    translation = translation.replace(field, self.translated(value))
                return translation
        return ""

    def _in_parts(self, text: str) -> str:
        for joint in _JOINTS:
            places = [met.start() for met in re.finditer(re.escape(joint), text)]
            for place in places:
                head, rest = text[:place], text[place + len(joint) :]
                first, tail = self._found(head), self._found(joint + rest)  # what is only ever said after something
                if tail:
                    return f"{first or head}{tail}"
                second = self._found(rest) or self._in_parts(rest)
                if first or second:
                    return f"{first or head}{joint}{second or rest}"
        return ""


def _pattern(template: str) -> re.Pattern[str]:
    """Return what sentences made by the template look like; a field that comes twice holds the same."""
    seen: list[str] = []
    parts = []
    end = 0
    for field in _FIELD.finditer(template):
        parts.append(re.escape(template[end : field.start()]))
        parts.append("(.+?)" if field[0] not in seen else f"(\\{seen.index(field[0]) + 1})")
        seen.append(field[0])
        end = field.end()
    return re.compile("".join([*parts, re.escape(template[end:])]), re.DOTALL)
