"""A mesh with its places on images: the new part of it, and what is around. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .arrays import Floats, Ints, Mask

RINGS = 4  # of triangles around the new part: as far as colours are read there


@dataclass(frozen=True)
class TexturedMesh:
    """Triangles with corners on images; what has none of its own is of no use here."""

    points: Floats  # (n, 3) in world space
    triangles: Ints  # (t, 3)
    places: Floats  # (t, 3, 2) of their corners, in texels of their image
    image: Ints  # (t,) number of it, −1 for none
    new: Mask  # (t,)
    sample: Mask | None = None  # (t,) those whose detail is copied; None: those around the new part

    @cached_property
    def chosen(self) -> Ints:
        """The numbers of the m new triangles."""
        return np.flatnonzero(self.new)

    @cached_property
    def sides_around(self) -> Ints:
        """(m, 3): for each side of a new triangle the old side 3 t + k with an image across; −1 where there is none."""
        keys = _side_keys(self.triangles, len(self.points))
        old = np.flatnonzero(np.repeat(~self.new & (self.image >= 0), 3))
        order = np.argsort(keys[old], kind="stable")
        old = old[order]
        wanted = keys.reshape(-1, 3)[self.chosen].ravel()
        alone = np.bincount(np.unique(wanted, return_inverse=True)[1])  # what two new triangles share is inside
        inside = alone[np.unique(wanted, return_inverse=True)[1]] > 1
        if not len(old):
            return np.full((len(self.chosen), 3), -1)
        at = np.minimum(np.searchsorted(keys[old], wanted), len(old) - 1)
        found = np.where((keys[old[at]] == wanted) & ~inside, old[at], -1)
        return found.reshape(-1, 3)

    @cached_property
    def near(self) -> Ints:
        """The numbers of the old triangles with an image that are near the new part."""
        reached = np.zeros(len(self.points), dtype=bool)
        reached[self.triangles[self.chosen]] = True
        for _ in range(RINGS):
            touched = reached[self.triangles].any(axis=1)
            reached[self.triangles[touched]] = True
        return np.flatnonzero(touched & ~self.new & (self.image >= 0))

    def samples(self) -> Iterator[Mask]:
        """Yield (t,) masks of old triangles whose detail is copied: those named, else what is around, ever further."""
        if self.sample is not None:
            yield self.sample & ~self.new
            return
        middles = self.points[self.triangles].mean(axis=1)
        away = np.linalg.norm(middles - middles[self.chosen].mean(axis=0), axis=1)
        reach = 1.5 * away[self.chosen].max()
        while True:
            yield (away <= reach) & ~self.new
            if reach >= away.max():
                return
            reach = 2.0 * reach if reach > 0.0 else away.max()

    def texel_length(self) -> float:
        """Return how long a texel is on the surface around; 0 where nothing around has an area on its image."""
        around = np.unique(self.sides_around[self.sides_around >= 0] // 3)
        on_surface, on_image = self.areas(around)
        area = float(on_image.sum())
        return float(np.sqrt(on_surface.sum() / area)) if area > 0.0 else 0.0

    def areas(self, of: Ints) -> tuple[Floats, Floats]:
        """Return (k,) and (k,): the areas of triangles on the surface and on their images."""
        a, b, c = np.moveaxis(self.points[self.triangles[of]], 1, 0)
        return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1), np.abs(flat_areas(self.places[of]))


def flat_areas(corners: Floats) -> Floats:
    """Return (t,): the areas of triangles (t, 3, 2), negative where they are turned over."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    areas: Floats = 0.5 * (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])
    return areas


def pieces(triangles: Ints, places: Floats | None = None) -> Ints:
    """Return (t,): equal numbers for triangles that hang together by vertices, at equal places (t, 3, 2)."""
    rows = triangles.reshape(-1, 1).astype(np.float64)
    if places is not None:
        rows = np.concatenate([rows, places.reshape(-1, 2)], axis=1)
    _, corners = np.unique(rows, axis=0, return_inverse=True)
    corners = corners.reshape(-1, 3)
    label = np.arange(corners.max(initial=-1) + 1)
    while True:
        least = label[corners].min(axis=1)
        before = label.copy()
        np.minimum.at(label, corners.ravel(), np.repeat(least, 3))
        label = label[label]
        if (label == before).all():
            break
    found: Ints = np.unique(label[corners[:, 0]], return_inverse=True)[1].ravel()
    return found


def _side_keys(triangles: Ints, count: int) -> Ints:
    """Return (3 t,): equal numbers for sides with the same ends; side k runs from corner k to the next."""
    tails, heads = triangles.astype(np.int64), np.roll(triangles, -1, axis=1).astype(np.int64)
    keys: Ints = (np.minimum(tails, heads) * count + np.maximum(tails, heads)).ravel()
    return keys
