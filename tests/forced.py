"""Which small angles of a new mesh its outline forces."""

import numpy as np
from numpy.typing import NDArray

import holes
import measures
from holes import FloatArray, IntArray

SMALL = 25.0


def unforced_angles(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Degrees of all angles but those that two outline edges force.

    These are the angle between two outline edges itself, and those of triangles at a corner or over an outline edge
    where no triangle with angles from 25° on would find room: at a corner below 50° whose own triangle has a smaller
    angle, at one between a short and a long edge (`fan_angle`), and over an edge before which other edges of the
    outline lie too near.
    """
    border = {tuple(sorted(edge)) for edge in measures.border_edges(triangles).tolist()}
    angles = holes.angles(points, triangles)
    stays = np.array([[tuple(sorted((t[k], t[(k + 1) % 3]))) in border for k in range(3)] for t in triangles.tolist()])
    between_two = stays & np.roll(stays, 1, axis=1)
    suspects = np.flatnonzero(((angles < SMALL) & ~between_two).any(axis=1))
    room = _Room(points, triangles, border)
    forced = between_two.copy()
    for t in suspects:
        corners = triangles[t]
        edges = [(corners[k], corners[(k + 1) % 3]) for k in range(3) if stays[t, k]]
        if any(room.is_tight_corner(v) for v in corners) or any(room.is_tight_edge(a, b) for a, b in edges):
            forced[t] = True
    result: FloatArray = angles[~forced]
    return result


def fan_angle(corner: float, ratio: float) -> float:
    """The largest least angle (degrees) of flat triangles around a corner whose edges' lengths have this ratio ≥ 1.

    A triangle of angle φ there, and of m and more at its other corners, has sides of a ratio up to
    sin(m + φ) / sin m; of k triangles those of equal angles reach most, as log sin is concave.
    """
    best = 0.0
    for count in range(1, 9):
        phi, low, high = corner / count, 0.0, min(corner / count, 90.0 - corner / count / 2)
        for _ in range(40):
            m = 0.5 * (low + high)
            reached = (np.sin(np.radians(m + phi)) / np.sin(np.radians(m))) ** count
            low, high = (m, high) if reached >= ratio else (low, m)
        best = max(best, low)
    return best


class _Room:
    """What an outline leaves for triangles. `border`: its edges."""

    def __init__(self, points: FloatArray, triangles: IntArray, border: set[tuple[int, ...]]) -> None:
        self._points = points
        self._triangles = triangles
        self._edges = np.array(sorted(border))
        self._angles = holes.angles(points, triangles)

    def is_tight_corner(self, v: int) -> bool:
        """Whether a corner below 50° can't be cut off by one good triangle, or another one be filled with good ones."""
        ends = self._edges[(self._edges == v).any(axis=1)]
        if len(ends) != 2:
            return False
        a, b = ends[ends != v]
        corner = self._angles[self._triangles == v].sum()
        if corner < 2 * SMALL:
            return bool(holes.angles(self._points, np.array([[v, a, b]])).min() < SMALL)
        lengths = np.linalg.norm(self._points[[a, b]] - self._points[v], axis=1)
        return fan_angle(corner, lengths.max() / lengths.min()) < SMALL

    def is_tight_edge(self, a: int, b: int) -> bool:
        """Whether each good triangle over the edge from a to b, in the mesh's plane there, meets the outline."""
        apex = next(t for t in self._triangles if a in t and b in t)
        along = self._points[b] - self._points[a]
        length = np.linalg.norm(along)
        along = along / length
        inward = self._points[apex].sum(axis=0) - self._points[a] - self._points[b] - self._points[a]
        inward -= (inward @ along) * along
        frame = np.array([along, inward / np.linalg.norm(inward), np.cross(along, inward / np.linalg.norm(inward))])
        local = (self._points[self._edges] - self._points[a]) @ frame.T / length
        near = (np.abs(local[:, :, 2]) < 0.5).all(axis=1) & ~np.isin(self._edges, [a, b]).all(axis=1)
        others = local[near][:, :, :2]
        return all(_is_met(place, others) for place in _APEXES)


def _good_apexes() -> FloatArray:
    """Apexes over the edge from (0, 0) to (1, 0) of triangles with angles from 25° on."""
    grid = [np.array([x, y]) for x in np.linspace(-0.7, 1.7, 37) for y in np.linspace(0.05, 1.2, 24)]
    fits = [holes.angles(np.array([[0.0, 0, 0], [1, 0, 0], [x, y, 0]]), np.array([[0, 1, 2]])).min() for x, y in grid]
    return np.array(grid)[np.array(fits) >= SMALL]


def _cross(a: FloatArray, b: FloatArray) -> FloatArray:
    result: FloatArray = a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
    return result


def _is_met(apex: FloatArray, edges: FloatArray) -> bool:
    """Whether an edge (e, 2, 2) runs into the triangle over (0, 0) and (1, 0) with this apex, shrunk a little."""
    corners = np.array([[0.0, 0.0], [1.0, 0.0], apex])
    corners = corners + 1e-3 * (corners.mean(axis=0) - corners)
    inside: NDArray[np.bool_] = np.ones(edges.shape[:2], dtype=bool)
    met = np.zeros(len(edges), dtype=bool)
    for p, q in zip(corners, np.roll(corners, -1, axis=0), strict=True):
        inside &= _cross(q - p, edges - p) > 0
        ends = _cross(q - p, edges - p)
        sides = _cross(edges[:, 1] - edges[:, 0], p - edges[:, 0]), _cross(edges[:, 1] - edges[:, 0], q - edges[:, 0])
        met |= (ends[:, 0] * ends[:, 1] < 0) & (sides[0] * sides[1] < 0)
    return bool((met | inside.any(axis=1)).any())


_APEXES = _good_apexes()
