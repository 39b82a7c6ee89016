"""Reads docs/tutorial.md: the steps of each lesson, as they are written. Needs no Blender."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

PAGE = Path(__file__).resolve().parents[2] / "docs" / "tutorial.md"
LESSON = re.compile(r"^## \d+\. (?P<title>[^\n]+)\n`(?P<file>\w+)\.blend`\n\n(?P<text>.*?)(?=^## |\Z)", re.M | re.S)
STEP = re.compile(r"^\d+\. (.+?)(?=^\d+\. |^$|\Z)", re.M | re.S)
# *Label*: `0.2`, *Label*: *Choice*, *Label*: on; or *word* alone; or `text` that is typed.
TOKEN = re.compile(r"\*(?P<option>[^*\n]+)\*: (?:`(?P<number>[^`]+)`|\*(?P<choice>[^*]+)\*|(?P<switch>on|off)\b)|"
                   r"\*(?P<word>[^*]+)\*|`(?P<typed>[^`]+)`")  # fmt: skip
Value = float | bool | str


class Step(NamedTuple):
    """One thing that is done: kind "word" (a key, a menu's entry, a button), "typed", or "option" with its value."""

    kind: str
    name: str
    value: Value | None = None


class Lesson(NamedTuple):
    """A section of the page."""

    title: str
    file: str
    steps: list[Step]


def lessons(text: str | None = None) -> list[Lesson]:
    """All of the page."""
    page = PAGE.read_text(encoding="utf-8") if text is None else text
    return [Lesson(found["title"], found["file"], steps(found["text"])) for found in LESSON.finditer(page)]


def steps(text: str) -> list[Step]:
    """What the numbered lines of a section say."""
    joined = " ".join(" ".join(line.split()) for line in STEP.findall(text))
    return [_step(found) for found in TOKEN.finditer(joined)]


def _step(found: re.Match[str]) -> Step:
    if found["option"] is None:
        return Step("typed", found["typed"]) if found["typed"] else Step("word", found["word"])
    if found["number"]:
        return Step("option", found["option"], float(found["number"]))
    return Step("option", found["option"], found["choice"] or found["switch"] == "on")
