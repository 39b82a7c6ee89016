"""Sentences in panels."""

from typing import Any


def draw_text(layout: Any, text: str, icon: str, width: int = 38) -> None:
    """Draw a sentence over as many lines as it needs: labels don't wrap."""
    column = layout.column(align=True)
    column.scale_y = 0.8
    line = ""
    for word in text.split():
        if line and len(line) + len(word) >= width:
            column.label(text=line, icon=icon, translate=False)
            line, icon = "", "BLANK1"
        line = f"{line} {word}".strip()
    column.label(text=line, icon=icon, translate=False)
