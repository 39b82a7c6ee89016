"""The fine part of a texture, copied from one place of an image to another. Plain numpy, no bpy.

Pieces of it lie on the corners of a grid of triangles, each from a place of its own, and blend in between so that the
variance stays (Heitz & Neyret 2018).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Ints, Mask, Pixels
from .texels import Window

EDGES = (32, 16, 8, 4)  # texels of the grid's edges, the longest that fits: what has longer waves is no grain
SHARP = 4  # power of the weights: pieces blend in narrow strips, and are whole elsewhere
TOO_NARROW = "Detail From: the faces whose fine texture is to be copied have no square of 11 × 11 texels of the image"


@dataclass(frozen=True)
class Grain:
    """Of one image, as it stores colours."""

    fine: Floats  # (h, w, 3)
    middles: Ints  # (c, 2) columns and rows from which pieces as wide as two edges can be cut
    edge: int

    @classmethod
    def of(cls, pixels: Pixels, mask: Mask) -> Grain | None:
        """Cut the grain out of an image (h, w, 4) where the mask is; None where that is too narrow."""
        rows, columns = (np.flatnonzero(mask.any(axis=axis)) for axis in (1, 0))
        part = np.s_[rows.min(initial=0) : rows.max(initial=0) + 1, columns.min(initial=0) : columns.max(initial=0) + 1]
        pixels, mask = pixels[part], mask[part]
        for edge in EDGES:
            whole = _sums(mask.astype(np.float64), edge + 1) > (2 * edge + 3) ** 2 - 0.5
            if np.count_nonzero(whole) >= edge**2:
                return cls(_fine(pixels, mask, edge), np.argwhere(whole)[:, ::-1], edge)
        return None

    def on(self, window: Window, coarser: int) -> Floats:
        """Return (height, width, 3) for a window of an image with so many times longer texels on the surface."""
        edge = self.edge / coarser
        y, x = np.mgrid[: window.height, : window.width].astype(np.float64)
        second = y / (edge * np.sqrt(0.75))
        first = x / edge - 0.5 * second
        i, j = np.floor(first).astype(np.int64), np.floor(second).astype(np.int64)
        across, up = first - i, second - j
        over = across + up > 1.0
        rng = np.random.default_rng([abs(window.x), abs(window.y)])
        chosen = rng.integers(len(self.middles), size=(int(np.ptp(i)) + 2, int(j.max()) + 2))
        total, squares = np.zeros((*x.shape, 3)), np.zeros(x.shape)
        for column, row, weight in (
            (i + over, j + over, np.abs(1.0 - across - up)),
            (i + 1, j, np.where(over, 1.0 - up, across)),
            (i, j + 1, np.where(over, 1.0 - across, up)),
        ):
            away = np.stack([x - edge * (column + 0.5 * row), y - edge * np.sqrt(0.75) * row], axis=-1)
            at = self.middles[chosen[column - i.min(), row]] + np.rint(coarser * away).astype(np.int64)
            total += (weight**SHARP)[..., None] * self.fine[at[..., 1], at[..., 0]]
            squares += weight ** (2 * SHARP)
        found: Floats = total / np.sqrt(squares)[..., None]
        return found


def _fine(pixels: Pixels, mask: Mask, edge: int) -> Floats:
    """Return what is left of colours (h, w, 3) without their mean around, that of the mask alone."""
    inside = mask.astype(np.float64)
    colours = pixels[..., :3] * inside[..., None]
    part = inside
    for _ in range(2):
        part = _sums(part, edge // 4)
        colours = _sums(colours, edge // 4)
    smooth = np.divide(colours, part[..., None], out=np.zeros_like(colours), where=part[..., None] > 0.0)
    return np.where(mask[..., None], pixels[..., :3] - smooth, 0.0)


def _sums(values: Floats, reach: int) -> Floats:
    """Return the sums over squares of so many texels to each side of (h, w, …)."""
    for axis in (0, 1):
        padding = [(0, 0)] * values.ndim
        padding[axis] = (reach + 1, reach)
        total = np.cumsum(np.pad(values, padding), axis=axis)
        width = values.shape[axis]
        high, low = np.s_[2 * reach + 1 :], np.s_[:width]
        values = total[high] - total[low] if axis == 0 else total[:, high] - total[:, low]
    return values
