"""Where a surface between boundary loops is thinnest or thickest. Plain numpy, no bpy."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask

LEVELS = np.linspace(0.1, 0.9, 17)  # where the engine measures result.girth


def waist(points: Floats, triangles: Ints) -> Ints:
    """Return the points beside the cross-section that is shortest beside the shorter of its ends, ascending.

    A cross-section is a level line of the harmonic function that is 1 on one boundary loop and 0 on the others.
    """
    return _beside(triangles, min(_sections(points, triangles), key=lambda section: section[0] / min(section[1])))


def belly(points: Floats, triangles: Ints) -> Ints:
    """Return the points beside the cross-section that is longest beside the longer of its ends, ascending."""
    return _beside(triangles, max(_sections(points, triangles), key=lambda section: section[0] / max(section[1])))


Section = tuple[float, tuple[float, float], Mask]  # its length, its ends' lengths, the triangles that it runs through


def _beside(triangles: Ints, section: Section) -> Ints:
    vertices: Ints = np.unique(triangles[section[2]])
    return vertices


def _sections(points: Floats, triangles: Ints) -> Iterator[Section]:
    loops = fairing.boundary_loops(triangles)
    around = [float(np.linalg.norm(points[np.roll(loop, -1)] - points[loop], axis=1).sum()) for loop in loops]
    rim = np.unique(np.concatenate(loops))
    held = np.stack([np.isin(rim, loop) for loop in loops], axis=1).astype(np.float64)
    for own, field in zip(around, fairing.interpolate(points, triangles, rim, held).T, strict=True):
        for level in LEVELS:
            length, through = _level_line(points, triangles, field - level)
            if length > 0.0:
                yield length, (own, sum(around) - own), through


def _level_line(points: Floats, triangles: Ints, field: Floats) -> tuple[float, Mask]:
    """Return the length of the line where the field is 0, and the mask of the triangles that it runs through."""
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1)
    crossed = np.logical_xor.reduce(field[ends] >= 0.0, axis=-1)  # two edges of a triangle, or none
    first, last = ends[crossed].T
    share = (field[first] / (field[first] - field[last]))[:, None]
    places = ((1.0 - share) * points[first] + share * points[last]).reshape(-1, 2, 3)
    through: Mask = crossed.any(axis=1)
    return float(np.linalg.norm(places[:, 1] - places[:, 0], axis=1).sum()), through
