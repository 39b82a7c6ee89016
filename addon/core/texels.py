"""Triangles on the texels of an image. Plain numpy, no bpy.

Places are in texels: the first one's centre is (½, ½), and rows go up.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask, Pixels

MARGIN = 4  # texels around new faces that get colours, too: two levels of a renderer's smaller copies need no more


@dataclass(frozen=True)
class Window:
    """A rectangle of an image."""

    x: int
    y: int
    width: int
    height: int

    @classmethod
    def around(cls, corners: Floats, margin: int) -> Window:
        """Return the texels that (t, 3, 2) touch, and as many around."""
        low = np.floor(corners.min(axis=(0, 1))).astype(np.int64) - margin
        high = np.ceil(corners.max(axis=(0, 1))).astype(np.int64) + margin
        return cls(int(low[0]), int(low[1]), int(high[0] - low[0]), int(high[1] - low[1]))

    def owners(self, corners: Floats) -> tuple[Ints, int]:
        """Return (height, width): the triangle of (t, 3, 2) at each texel, −1: none; how many lie over others."""
        found, count = fairing.texel_owners(corners - [self.x, self.y], self.width, self.height)
        return found.astype(np.int64), int(count - np.count_nonzero(found >= 0))

    def of(self, image: Mask | Pixels) -> tuple[Ints, Ints]:
        """Return rows and columns to index an image (h, w, …) with; what lies beyond comes in on its other side."""
        height, width = image.shape[:2]
        rows = (self.y + np.arange(self.height)) % height
        columns = (self.x + np.arange(self.width)) % width
        return rows[:, None], columns[None]

    def values(self, corners: Floats, values: Floats) -> Pixels:
        """Return (height, width, c): values (t, 3, c) of corners (t, 3, 2), NaN where no triangle is."""
        return fairing.texel_values(corners - [self.x, self.y], values, self.width, self.height)


def grown(mask: Mask, steps: int = 1) -> Mask:
    """Return the mask with all texels that are at most so many steps away, along rows, columns or diagonals."""
    found = np.pad(mask, steps)
    for axis in (0, 1):
        part = found.copy()
        for step in range(1, steps + 1):
            part |= np.roll(found, step, axis) | np.roll(found, -step, axis)
        found = part
    inside: Mask = found[steps:-steps, steps:-steps]
    return inside


def spread(colours: Pixels, known: Mask, taken: Mask) -> Mask:
    """Give colours (h, w, 4) around those that are known the mean of these, in place; return what is known then.

    MARGIN steps far, but not beyond half of the way to what is taken.
    """
    known, taken = known.copy(), taken.copy()
    for _ in range(MARGIN):
        taken |= grown(taken) & ~known
        reached = grown(known) & ~known & ~taken
        y, x = np.nonzero(reached)
        total, count = np.zeros((len(y), 4)), np.zeros((len(y), 1))
        for i, j in ((i, j) for i in (-1, 0, 1) for j in (-1, 0, 1)):
            at = np.clip(y + i, 0, len(known) - 1), np.clip(x + j, 0, known.shape[1] - 1)
            total += np.where(known[at][:, None], colours[at], 0.0)
            count += known[at][:, None]
        colours[y, x] = total / count
        known |= reached
    return known
