"""Where new faces lie on their image: where they are, as long as nothing else is there, or in free space. No bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Ints, Mask
from .texels import MARGIN, Window, grown
from .textured_mesh import pieces

CELL = 2 * MARGIN  # texels: free space is looked for in such squares
COARSER = (1, 2, 4)  # a harmonic colour looks the same with fewer texels
# Of a chart's texels that may lie in one place with others of it, or be taken by its own neighbours. It decides five of
# 520 charts (98 holes in nine meshes); those would move, or be cut in pieces, for some texels.
DOUBLED = 0.01

NO_SPACE = (
    "The image has no free part for the new faces, not even with a quarter of the texels along each side: enlarge it, "
    "or lay them out by hand in the UV editor"
)


@dataclass
class Chart:
    """New triangles that hang together on their image."""

    rows: Ints  # (k,) of the new triangles
    corners: Floats  # (k, 3, 2) in texels
    moved: bool = False
    coarser: int = 1  # how many times longer its texels are on the surface than those around


@dataclass(frozen=True)
class Taken:
    """What old faces cover of an image; both (h, w)."""

    all: Mask
    others: Mask  # what is not near the new faces

    def accepts(self, chart: Chart) -> bool:
        """Return whether a chart may stay: inside the image, nearly nowhere over old faces, not next to others."""
        height, width = self.all.shape
        if chart.corners.min() < 0.0 or (chart.corners.max(axis=(0, 1)) > [width, height]).any():
            return False
        window = Window.around(chart.corners, 1)
        covered = window.owners(chart.corners)[0] >= 0
        over = np.count_nonzero(covered & self.all[window.of(self.all)])
        beside = grown(covered) & self.others[window.of(self.others)]
        return bool(over <= DOUBLED * np.count_nonzero(covered) and not beside.any())

    def add(self, chart: Chart) -> None:
        """Count a chart as taken."""
        window = Window.around(chart.corners, 1)
        owners, _ = window.owners(chart.corners)
        for mask in (self.all, self.others):
            mask[window.of(mask)] |= owners >= 0


def charts_of(triangles: Ints, places: Floats) -> list[Chart]:
    """Return the charts of new triangles (m, 3) with places (m, 3, 2)."""
    label = pieces(triangles, places)
    return [Chart(rows, places[rows]) for rows in _rows_of(label)]


def flattened(points: Floats, triangles: Ints, chart: Chart, texel: float) -> list[Chart]:
    """Return a chart in pieces, each as seen along one of the six directions of the axes; texel: its length."""
    a, b, c = np.moveaxis(points[triangles[chart.rows]], 1, 0)
    normals = np.cross(b - a, c - a)
    axis = np.abs(normals).argmax(axis=1)
    sign = np.sign(normals[np.arange(len(axis)), axis])
    found = []
    for k, side in ((k, side) for k in range(3) for side in (1.0, -1.0)):
        facing = chart.rows[(axis == k) & ((sign >= 0.0) == (side > 0.0))]
        if not len(facing):
            continue
        flat = points[triangles[facing]][..., [(k + 1) % 3, (k + 2) % 3]] * [side, 1.0] / texel
        found += [Chart(facing[rows], flat[rows], moved=True) for rows in _rows_of(pieces(triangles[facing]))]
    return found


def lies_over_itself(chart: Chart, expected: float) -> bool:
    """Return whether a chart is folded, or has no area where it should have some texels: no use wherever it lies."""
    owners, doubled = Window.around(chart.corners, 1).owners(chart.corners)
    count = np.count_nonzero(owners >= 0)
    return bool(doubled > DOUBLED * count or (not count and expected >= 1.0))


def move_to_free_space(charts: list[Chart], taken: Mask) -> bool:
    """Give charts places with a margin around each, with fewer texels if they must; return whether there was room.

    taken: (h, w) texels of the image. Without room charts are unchanged.
    """
    height, width = taken.shape
    rows, columns = -(-height // CELL), -(-width // CELL)
    cells = np.pad(taken, ((0, rows * CELL - height), (0, columns * CELL - width)), constant_values=True)
    free = ~grown(cells, MARGIN).reshape(rows, CELL, columns, CELL).any(axis=(1, 3))
    for coarser in COARSER:
        placed = _placed([chart.corners / coarser for chart in charts], free.copy())
        if placed is not None:
            for chart, corners in zip(charts, placed, strict=True):
                chart.corners, chart.moved, chart.coarser = corners, True, coarser
            return True
    return False


def _placed(charts: list[Floats], free: Mask) -> list[Floats] | None:
    """Return charts (·, 3, 2) in free cells, the largest first, or None; marks cells as taken."""
    found: list[Floats] = list(charts)
    order = sorted(range(len(charts)), key=lambda k: -float(np.ptp(charts[k], axis=(0, 1)).prod()))
    for k in order:
        window = Window.around(charts[k], MARGIN)
        high, wide = -(-window.height // CELL), -(-window.width // CELL)
        corner = _free_rectangle(free, high, wide)
        if corner is None:
            return None
        y, x = corner
        free[y : y + high, x : x + wide] = False
        found[k] = charts[k] + [CELL * x - window.x, CELL * y - window.y]
    return found


def _free_rectangle(free: Mask, high: int, wide: int) -> tuple[int, int] | None:
    """Return the row and the column of the first free rectangle of so many cells; None where there is none."""
    if high > free.shape[0] or wide > free.shape[1]:
        return None
    total = np.pad(np.cumsum(np.cumsum(~free, axis=0), axis=1), ((1, 0), (1, 0)))
    inside = total[high:, wide:] - total[:-high, wide:] - total[high:, :-wide] + total[:-high, :-wide]
    at = int((inside == 0).argmax())
    y, x = divmod(at, inside.shape[1])
    return (y, x) if inside[y, x] == 0 else None


def _rows_of(label: Ints) -> list[Ints]:
    """Return the rows of each number, those with most rows first."""
    order = np.argsort(label, kind="stable")
    parts = np.split(order, np.flatnonzero(np.diff(label[order])) + 1)
    return sorted(parts, key=len, reverse=True)
