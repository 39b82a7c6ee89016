"""The blend of three cylinders (Figs. 1 and 2 of Schneider & Kobbelt 2001) as irregular meshes.

Three cylinders of radius 1 leave the origin in the plane z = 0, 120° apart; the patch ends in one
circle of each, `reach` from the origin: χ = −1. Its connectivity is the double cover of a flat Y:
triangulations of a sheet above and a sheet below, glued along the three sides of the Y. The arms of
the flat Y are as wide as half a circumference, so edges keep about their length.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import Delaunay, cKDTree

from curves import FloatArray
from domains import thinned
from shapes import membrane

IntArray = NDArray[np.int64]
HALF_WIDTH = 0.5 * np.pi
DIRECTIONS = np.radians([90.0, 210.0, 330.0])


@dataclass(frozen=True)
class Blend:
    """vertices (n, 3), exact on the rims and a uniform membrane inside; triangles (m, 3) outward.

    fixed (k,): the rims, with fixed_normals (k, 3) those of the cylinders. flat (n, 3): places in the flat Y,
    third coordinate 1 above, −1 below, 0 on its sides (three cylinders only, else empty).
    """

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    fixed_normals: FloatArray
    flat: FloatArray = field(default_factory=lambda: np.empty((0, 3)))

    @property
    def diameter(self) -> float:
        """D: twice the largest distance of the fixed vertices from their centroid."""
        rim = self.vertices[self.fixed]
        return float(2 * np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())


@dataclass(frozen=True)
class Rectangle:
    """A regular patch of the upper sheet: rows × columns vertices, `spacing` apart, round a centre (x, y)."""

    rows: int
    columns: int
    spacing: float
    centre: tuple[float, float]

    def points(self) -> FloatArray:
        """(rows · columns, 2), sheared by so little that Delaunay cuts all squares the same way."""
        i, j = np.divmod(np.arange(self.rows * self.columns), self.columns)
        x, y = j - 0.5 * (self.columns - 1), i - 0.5 * (self.rows - 1)
        return np.asarray(self.spacing * np.column_stack([x + 1e-4 * y, y]) + self.centre)


@dataclass(frozen=True)
class Boundary:
    """The flat Y, counter-clockwise: points (k, 2) and for each the rim it is on (−1: a side).

    `across` is the position along the rim in [−1, 1]; its ends lie on both rim and sides.
    """

    points: FloatArray
    rim: IntArray
    across: FloatArray


def _boundary(reach: float, h: float) -> Boundary:
    notch = HALF_WIDTH / np.sin(np.pi / 3)
    points, rims, across = [], [], []
    for k, direction in enumerate(DIRECTIONS):
        out = np.array([np.cos(direction), np.sin(direction)])
        side = np.array([-out[1], out[0]])
        share = np.linspace(-1, 1, max(4, round(2 * HALF_WIDTH / h)) + 1)
        rim = reach * out + HALF_WIDTH * share[:, None] * side
        corner = notch * np.array([np.cos(direction + np.pi / 3), np.sin(direction + np.pi / 3)])
        turn = DIRECTIONS[(k + 1) % 3]
        following = np.array([np.cos(turn), np.sin(turn)])
        landing = reach * following - HALF_WIDTH * np.array([-following[1], following[0]])
        sides = np.vstack([between(rim[-1], corner, h), corner, between(corner, landing, h)])
        points += [rim, sides]
        rims += [np.full(len(rim), k), np.full(len(sides), -1)]
        across += [share, np.zeros(len(sides))]
    return Boundary(np.vstack(points), np.concatenate(rims), np.concatenate(across))


def between(start: FloatArray, end: FloatArray, h: float) -> FloatArray:
    """Evenly spaced points strictly between."""
    count = max(2, round(float(np.linalg.norm(end - start)) / h))
    share = np.arange(1, count)[:, None] / count
    return start + share * (end - start)


def inside(boundary: FloatArray, points: FloatArray) -> NDArray[np.bool_]:
    """Even-odd test of points (k, 2) in a polygon."""
    x, y = points[:, 0], points[:, 1]
    inside = np.zeros(len(points), dtype=bool)
    for (ax, ay), (bx, by) in zip(boundary, np.roll(boundary, -1, axis=0), strict=True):
        if ay != by:
            inside ^= ((ay > y) != (by > y)) & (x < (bx - ax) * (y - ay) / (by - ay) + ax)
    return inside


def sheet(boundary: FloatArray, h: float, jitter: float, rng: np.random.Generator) -> FloatArray:
    """Jittered hexagonal points of random phase and direction, 0.6 h clear of the boundary."""
    reach = int(2 * np.abs(boundary).max() / h) + 2
    i, j = np.meshgrid(np.arange(-reach, reach + 1), np.arange(-reach, reach + 1))
    lattice = np.column_stack([(i + 0.5 * (j % 2)).ravel(), (0.5 * np.sqrt(3) * j).ravel()])
    turn = rng.random() * np.pi / 3
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    shaken = lattice + jitter * (rng.random(lattice.shape) - 0.5)
    points = h * (shaken + rng.random(2)) @ rotation.T
    refined = np.vstack([boundary + s * (np.roll(boundary, -1, 0) - boundary) for s in (0, 0.33, 0.67)])
    clear = cKDTree(refined).query(points)[0] > 0.6 * h
    points = points[clear]
    points = points[inside(boundary, points)]
    return np.asarray(points[thinned(points, np.full(len(points), 0.6 * h))])


def _with_rectangle(sheet: FloatArray, rectangle: Rectangle) -> FloatArray:
    """The rectangle's vertices and those of the sheet outside it."""
    regular = rectangle.points()
    margin = 0.8 * rectangle.spacing
    outside = ((sheet < regular.min(axis=0) - margin) | (sheet > regular.max(axis=0) + margin)).any(axis=1)
    return np.vstack([regular, sheet[outside]])


def triangulated(boundary: FloatArray, inner: FloatArray) -> IntArray:
    """Delaunay triangles inside the Y, boundary vertices first, counter-clockwise."""
    points = np.vstack([boundary, inner])
    triangles = Delaunay(points).simplices.astype(np.int64)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    doubled = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    triangles[doubled < 0] = triangles[doubled < 0][:, [0, 2, 1]]
    keep = inside(boundary, points[triangles].mean(axis=1)) & (np.abs(doubled) > 1e-9)
    return np.asarray(triangles[keep])


def _on_circle(boundary: Boundary, which: IntArray, up: int) -> FloatArray:
    """Unit normals (k, 3) of the cylinders at rim points of the upper (1) or lower (−1) sheet."""
    angle = 0.5 * np.pi * boundary.across[which]
    direction = DIRECTIONS[boundary.rim[which]]
    side = np.column_stack([-np.sin(direction), np.cos(direction)])
    return np.column_stack([np.sin(angle)[:, None] * side, up * np.cos(angle)])


def cylinder_blend(n_free: int, *, jitter: float = 0.6, seed: int = 0, reach: float = 2.0) -> Blend:
    """An irregular mesh with about n_free free vertices; jitter 0 gives the regular kind."""
    h = np.sqrt(2 * (9.0 * reach - 8.0) / (0.5 * np.sqrt(3) * n_free))
    for _ in range(8):
        blend = _blend(h, jitter, seed, reach)
        count = len(blend.vertices) - len(blend.fixed)
        if abs(count - n_free) < 0.005 * n_free:
            break
        h *= np.sqrt(count / n_free)
    return blend


def blend_with_rectangle(n_free: int, rectangle: Rectangle, *, rim: int, seed: int = 0) -> Blend:
    """Fig. 1a: an irregular mesh with a regular patch in it, `rim` vertices on each circle.

    The irregular part is as coarse as the circles; what it has beyond n_free is left out here and there.
    """
    return _blend(4 * HALF_WIDTH / rim, 0.8, seed, 2.0, (rectangle, n_free))


def _blend(h: float, jitter: float, seed: int, reach: float, regular: tuple[Rectangle, int] | None = None) -> Blend:
    rng = np.random.default_rng(seed)

    def sheets_of(flat: Boundary) -> list[FloatArray]:
        sheets = [sheet(flat.points, h, jitter, rng) for _ in range(2)]
        if regular is None:
            return sheets
        sheets[0] = _with_rectangle(sheets[0], regular[0])
        free = np.flatnonzero(flat.rim < 0)
        surplus = len(free) + len(sheets[0]) + len(sheets[1]) - regular[1]
        if surplus < 0:
            raise ValueError(f"{-surplus} vertices short: the regular patch has to have more")
        sheets[1] = np.delete(sheets[1], rng.choice(len(sheets[1]), surplus, replace=False), axis=0)
        return sheets

    return of_sheets(h, reach, sheets_of)


def of_sheets(h: float, reach: float, make: Callable[[Boundary], list[FloatArray]]) -> Blend:
    """The blend whose boundary has edges of about h, with the points inside that `make` gives for each sheet."""
    flat = _boundary(reach, h)
    sheets = make(flat)
    upper, lower = (triangulated(flat.points, inner) for inner in sheets)
    corners = len(flat.points)
    blend = _glued(flat, upper, lower, (corners, len(sheets[0]), len(sheets[1])), reach)
    doubled = (flat.rim >= 0) & (np.abs(flat.across) < 1 - 1e-9)
    above = np.column_stack([flat.points, doubled])
    below = np.column_stack([flat.points, -1.0 * doubled])[doubled]
    inside = [np.column_stack([sheet, np.full(len(sheet), side)]) for sheet, side in zip(sheets, (1, -1), strict=True)]
    return replace(blend, flat=np.vstack([above, inside[0], below, inside[1]]))


def _glued(flat: Boundary, upper: IntArray, lower: IntArray, sizes: tuple[int, int, int], reach: float) -> Blend:
    """Both sheets in one mesh: the sides are shared, the open rim points exist twice."""
    corners, above, below = sizes
    doubled = np.flatnonzero((flat.rim >= 0) & (np.abs(flat.across) < 1 - 1e-9))
    lower_index = np.arange(corners + below)
    lower_index[doubled] = corners + above + np.arange(len(doubled))
    lower_index[corners:] = corners + above + len(doubled) + np.arange(below)
    triangles = np.vstack([upper, lower_index[lower][:, ::-1]])
    rim = np.flatnonzero(flat.rim >= 0)
    fixed = np.concatenate([rim, lower_index[doubled]])
    normals = np.vstack([_on_circle(flat, rim, 1), _on_circle(flat, doubled, -1)])
    direction = DIRECTIONS[np.concatenate([flat.rim[rim], flat.rim[doubled]])]
    axis = np.column_stack([np.cos(direction), np.sin(direction), 0 * direction])
    vertices = np.zeros((corners + above + len(doubled) + below, 3))
    vertices[fixed] = normals + reach * axis
    return Blend(membrane(vertices, triangles, fixed), triangles, fixed, normals, np.zeros_like(vertices))
