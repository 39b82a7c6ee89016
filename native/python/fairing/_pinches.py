"""Vertices that the boundary passes several times: split while a surface is made, and welded again."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from fairing._joined import once
from fairing._loops import Outline
from fairing._new_mesh import read_only
from fairing._types import FloatArray, IntArray

_AWAY = 0.1  # of the shorter edge there: enough to tell two passes apart, and too little to reach another edge


@dataclass(frozen=True)
class Split:
    """A boundary that passes each vertex once: copies of n vertices come after these."""

    outline: Outline
    points: FloatArray
    """(n + c, 3) as they are."""
    parted: FloatArray
    """(n + c, 3): vertices that one surface's boundary passes several times are moved a little into that surface, so
    that its first mesh has room between them."""
    source: IntArray
    """(n + c,) the vertex that each is."""

    @property
    def count(self) -> int:
        """n + c."""
        return len(self.source)

    @property
    def added(self) -> int:
        """c."""
        return int((self.source != np.arange(len(self.source))).sum())

    def welded(self, values: dict[str, Any]) -> dict[str, Any]:
        """The fields of a result, in the caller's numbers."""
        if not self.added:
            return values
        triangles = self._named(values["triangles"])
        warnings = tuple(
            replace(each, elements=self._named(each.elements)) if each.kind == "vertex" else each
            for each in values["warnings"]
        )
        return once(
            {
                **values,
                "triangles": read_only(triangles),
                "fixed": read_only(self._named(values["fixed"])),
                "warnings": warnings,
            }
        )

    def _named(self, elements: IntArray) -> IntArray:
        of_old = elements < self.count
        named: IntArray = np.where(of_old, self.source[np.where(of_old, elements, 0)], elements - self.added)
        return named.astype(np.int32)


def split(outline: Outline, points: FloatArray, normals: FloatArray, joined: bool) -> Split:
    """Give each pass but the first of a vertex a copy; normals: (Σ k, 3) unit, joined: one surface has all loops."""
    passes = outline.vertices
    surface = np.repeat(np.arange(len(outline.loops)), [len(loop) for loop in outline.loops]) * (not joined)
    _, first, of = np.unique(passes, return_index=True, return_inverse=True)
    again = np.flatnonzero(first[of] != np.arange(len(passes)))
    own = passes.astype(np.int64)
    own[again] = len(points) + np.arange(len(again))
    loops = [part.astype(np.int32) for part in np.split(own, np.cumsum([len(loop) for loop in outline.loops])[:-1])]
    source = np.concatenate([np.arange(len(points)), passes[again]]).astype(np.int32)
    placed = np.ascontiguousarray(points[source])
    parted = placed.copy()
    pairs = np.stack([of, surface], axis=1)
    _, kind, counts = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    crowded = np.flatnonzero(counts[kind.ravel()] > 1)
    if len(crowded):
        parted[own[crowded]] += _into(outline, points, normals)[crowded]
    return Split(replace(outline, loops=tuple(loops)), placed, parted, source)


def _into(outline: Outline, points: FloatArray, normals: FloatArray) -> FloatArray:
    """(Σ k, 3) a short way into the surface at each pass, half way between the edges there."""
    after = np.concatenate([points[np.roll(loop, -1)] - points[loop] for loop in outline.loops])
    before = np.concatenate([points[np.roll(loop, 1)] - points[loop] for loop in outline.loops])
    size = np.minimum(np.linalg.norm(after, axis=1), np.linalg.norm(before, axis=1))
    flat = after - (after * normals).sum(axis=1)[:, None] * normals
    along = flat / np.maximum(np.linalg.norm(flat, axis=1), 1e-300)[:, None]
    left = np.cross(normals, along)
    angle = 0.5 * _whole_turn(np.arctan2((before * left).sum(axis=1), (before * along).sum(axis=1)))
    way = np.cos(angle)[:, None] * along + np.sin(angle)[:, None] * left
    moved: FloatArray = _AWAY * size[:, None] * way
    return moved


def _whole_turn(angles: FloatArray) -> FloatArray:
    """In (0, 2π]."""
    turned: FloatArray = np.where(angles > 0.0, angles, angles + 2.0 * np.pi)
    return turned
