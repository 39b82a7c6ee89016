"""Every sentence for a person: a message knows its key and its fields, and each language has a sentence for the key.

The English ones are words/en.json, where a pair is for one and for several. Plain Python, no bpy.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

Sentence = str | list[str]  # with fields in braces; [for one, for several]
Sentences = Mapping[str, Sentence]

FOLDER = Path(__file__).parent


def sentences_of(code: str) -> dict[str, Sentence]:
    """Return those of a language by their keys; none where it has none."""
    path = FOLDER / f"{code}.json"
    return dict(json.loads(path.read_text(encoding="utf-8"))) if path.is_file() else {}


ENGLISH = sentences_of("en")


class Message(str):
    """A sentence in English that can be worded in other languages. Plain text for all that doesn't ask."""

    __slots__ = ("fields", "key")
    key: str
    fields: Mapping[str, Any]

    def __str__(self) -> str:
        """Return the message itself: an exception's text is one, too."""
        return self


def said(key: str, /, **fields: Any) -> Message:
    """Return the message of a key of words/en.json; fields that are messages are worded with it."""
    message = Message(_formed(ENGLISH[key], fields))
    message.key, message.fields = key, fields
    return message


def joined(messages: Sequence[str]) -> str:
    """Return messages as a list."""
    first, *others = messages or [""]
    return said("list", first=first, others=joined(others)) if others else first


def worded(message: Message, sentences: Sentences) -> str:
    """Return a message in a language; in English where that has no sentence for its key."""
    fields = dict(message.fields)
    fields |= {name: worded(each, sentences) for name, each in fields.items() if isinstance(each, Message)}
    return _formed(sentences.get(message.key, ENGLISH[message.key]), fields)


def case_of(code: str, figures: Mapping[str, float]) -> str:
    """Return the key of a diagnostic's sentence: CODE.figure for the first case whose figure is there, else CODE."""
    cases = [key for key in ENGLISH if key.startswith(f"{code}.")]
    return next((key for key in cases if key.partition(".")[2] in figures), code)


def names_islands(key: str) -> bool:
    """Return whether the sentence for several is about islands, not about elements."""
    return "{islands}" in ENGLISH[key][1]


def _formed(sentence: Sentence, fields: Mapping[str, Any]) -> str:
    if isinstance(sentence, str):
        return sentence.format(**fields)
    one, many = sentence
    return (one if fields["islands" if "{islands}" in many else "n"] == 1 else many).format(**fields)
