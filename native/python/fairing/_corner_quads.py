"""Quads over the places where several strips meet: blocks around one pole."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise

Quad = tuple[int, int, int, int]
Sides = list[list[int]]
"""Vertices of each side of a polygon, counter-clockwise; each begins with the last one of the side before."""


def blocks(sides: Sides, new: Callable[[], int]) -> list[Quad]:
    """Quads over a polygon of sides with an even number of edges, the same on all of them, around a middle vertex.

    A block of squares lies at each corner, and reaches to the middles of both sides there.
    """
    half = (len(sides[0]) - 1) // 2
    middle = new()
    spokes = [[side[half], *(new() for _ in range(half - 1)), middle] for side in sides]
    quads: list[Quad] = []
    for k, side in enumerate(sides):
        after = (k + 1) % len(sides)
        grid = [[-1] * (half + 1) for _ in range(half + 1)]
        for step in range(half + 1):
            grid[step][0] = sides[after][step]
            grid[0][step] = side[2 * half - step]
            grid[half][step] = spokes[after][step]
            grid[step][half] = spokes[k][step]
        for u in range(1, half):
            for v in range(1, half):
                grid[u][v] = new()
        quads += grid_quads(grid)
    return quads


def grid_quads(grid: list[list[int]]) -> list[Quad]:
    """Of vertices by place along and across, counter-clockwise where across is on the left of along."""
    return [(low[k], high[k], high[k + 1], low[k + 1]) for low, high in pairwise(grid) for k in range(len(low) - 1)]


def end_cap(column: list[int], around: list[int], new: Callable[[], int]) -> list[Quad]:
    """Quads over the half disc between a strip's last column and the line around its end, of as many edges.

    Outer rows lead around the end and back. The inner ones end at an edge whose corners are poles. ``column`` is
    counter-clockwise, the cap on its left; ``around`` runs from its end back to its begin.
    """
    count = len(column) - 1
    inner = 2 * max(1, count // 4)  # rows that end
    deep = (count - inner) // 2  # rows that lead around, and as many quads before the inner ones end
    rings = [around[::-1]]
    for level in range(1, deep + 1):
        rings.append([column[level], *(new() for _ in range(count - 1)), column[count - level]])
    quads: list[Quad] = []
    for outer, within in pairwise(rings):
        quads += grid_quads([outer, within])
    last = rings[-1]
    core = [last[deep : count - deep + 1]]
    for step in range(deep - 1, 0, -1):
        core.append([last[step], *(new() for _ in range(inner - 1)), last[count - step]])
    core.append(column[deep : count - deep + 1])
    return quads + grid_quads(core)
