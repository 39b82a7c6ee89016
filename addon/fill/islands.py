"""Which loose pieces of faces lie inside which hole. Plain numpy, no bpy."""

from __future__ import annotations

import numpy as np

import fairing

from ..arrays.region import MeshArrays
from ..arrays.types import Floats, Ints, Mask


def with_islands(world: MeshArrays, loops: list[Ints]) -> list[list[int]]:
    """Return the numbers of the loops in groups that one surface joins each: a hole with the islands inside it.

    world: in the space in which they are filled. An outer border that lies in no hole is a group of its own.
    """
    outer = fairing.borders.outer_borders(world.positions, world.triangles, loops) if loops else np.empty(0, dtype=bool)
    inside = islands_inside(world, loops, outer)
    groups = {k: [k] for k in range(len(loops)) if k not in inside}
    for island, hole in sorted(inside.items()):
        groups[hole].append(island)
    return list(groups.values())


def islands_inside(world: MeshArrays, loops: list[Ints], outer: Mask) -> dict[int, int]:
    """Return the hole around each island, by their numbers; outer: (l,) which loops run around pieces of faces.

    The smallest hole around whose own plane's axis the island lies, no further from the plane than the hole is wide.
    """
    points = [world.positions[loop] for loop in loops]
    holes = np.flatnonzero(~outer).tolist()
    holes.sort(key=lambda k: float(np.ptp(points[k], axis=0).max()))
    found = {}
    for island in np.flatnonzero(outer).tolist():
        for hole in holes:
            if _surrounds(points[hole], points[island]):
                found[island] = hole
                break
    return found


def _surrounds(hole: Floats, island: Floats) -> bool:
    """Return whether a loop (k, 3) runs around all points of another one, seen along its axis."""
    out = hole - hole.mean(axis=0)
    axis = np.cross(out, np.roll(out, -1, axis=0)).sum(axis=0)
    size = float(np.linalg.norm(axis))
    width = float(np.linalg.norm(out, axis=1).max())
    if not size > 0.0:
        return False
    axis /= size
    first = np.cross(axis, np.eye(3)[int(np.abs(axis).argmin())])
    first /= np.linalg.norm(first)
    plane = np.stack([first, np.cross(axis, first)], axis=1)
    away = island - hole.mean(axis=0)
    if not np.abs(away @ axis).max() < width:
        return False
    to_rim = (out @ plane)[None] - (away @ plane)[:, None]
    after = np.roll(to_rim, -1, axis=1)
    turn = np.arctan2(
        to_rim[..., 0] * after[..., 1] - to_rim[..., 1] * after[..., 0], (to_rim * after).sum(axis=2)
    ).sum(axis=1)
    return bool((np.abs(turn) > np.pi).all())
