"""A number that is typed while the mouse is followed. Plain Python, no bpy."""

from __future__ import annotations

_POINTS = {".": ".", ",": "."}


class Typed:
    """The digits so far."""

    def __init__(self) -> None:
        self.text = ""

    def take(self, key: str, character: str) -> bool:
        """Add a character, or take the last one away; returns whether the key was meant for the number."""
        if key == "BACK_SPACE":
            self.text = self.text[:-1]
            return True
        character = _POINTS.get(character, character)
        if character.isdecimal() or (character == "." and "." not in self.text):
            self.text += character
            return True
        return False

    @property
    def value(self) -> float:
        """The number; 0 without digits."""
        return float(self.text) if any(map(str.isdecimal, self.text)) else 0.0
