"""Stored values of images to colours that may be added up, and back. Plain numpy, no bpy.

That is light (linear, not as sRGB stores it), which renderers filter, too: from afar the new part is as bright as the
mean of what is around. Colours count by how opaque they are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Pixels


@dataclass(frozen=True)
class Coding:
    """How an image stores colours."""

    srgb: bool  # else light, or numbers that are no colours
    straight: bool  # colours are not yet multiplied by their alpha
    clipped: bool  # bytes, between 0 and 1

    def decoded(self, stored: Pixels) -> Floats:
        """Return (…, 4) in double precision."""
        found: Floats = stored.astype(np.float64)
        if self.srgb:
            found[..., :3] = _to_light(found[..., :3])
        if self.straight:
            found[..., :3] *= found[..., 3:]
        return found

    def encoded(self, colours: Floats | Pixels) -> Pixels:
        """Return (…, 4) as the image stores them, of single precision."""
        found = colours.astype(np.float32)
        if self.straight:
            alpha = found[..., 3:]
            found[..., :3] = np.divide(found[..., :3], alpha, out=np.zeros_like(found[..., :3]), where=alpha > 0.0)
        found = self.clip(found)
        if self.srgb:
            found[..., :3] = _from_light(found[..., :3])
        return found

    def clip(self, stored: Pixels) -> Pixels:
        """Return what can be stored."""
        return np.clip(stored, 0.0, 1.0) if self.clipped else stored


def _to_light(stored: Floats) -> Floats:
    """IEC 61966-2-1."""
    curved = ((np.maximum(stored, 0.04045) + 0.055) / 1.055) ** 2.4
    return np.where(stored <= 0.04045, stored / 12.92, curved)


def _from_light(light: Pixels) -> Pixels:
    curved = 1.055 * np.maximum(light, 0.0031308) ** (1.0 / 2.4) - 0.055
    return np.where(light <= 0.0031308, 12.92 * light, curved)
