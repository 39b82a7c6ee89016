"""Two planes that meet in an edge, as closed solids; and profiles of rounded edges."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


def wedge(
    degrees: float, length: float = 4.0, rows: int = 1, turned: bool = False
) -> tuple[FloatArray, IntArray, IntArray]:
    """A prism over an isosceles triangle with sides of 1: vertices, triangles, and the edge of that angle along z.

    That edge is the z axis from −length / 2 to length / 2, in `rows` pieces; the material lies at negative y.
    ``turned``: quads are cut along their other diagonals.
    """
    half = np.radians(degrees) / 2
    profile = np.array([[0, 0], [-np.sin(half), -np.cos(half)], [np.sin(half), -np.cos(half)]])
    heights = np.linspace(-length / 2, length / 2, rows + 1)
    vertices = np.array([[*place, z] for z in heights for place in profile])
    faces = [[0, 2, 1], [3 * rows, 3 * rows + 1, 3 * rows + 2]]
    for row in range(rows):
        for k in range(3):
            a, b = 3 * row + k, 3 * row + (k + 1) % 3
            c, d = b + 3, a + 3
            faces += [[a, b, d], [b, c, d]] if turned else [[a, b, c], [a, c, d]]
    edge = 3 * np.arange(rows + 1)
    return vertices, np.array(faces), np.column_stack([edge[:-1], edge[1:]])


def arc(degrees: float, width: float) -> tuple[FloatArray, float]:
    """Centre and radius of the arc that touches both sides of such a wedge at that distance from the edge."""
    half = np.radians(degrees) / 2
    return np.array([0.0, -width / np.cos(half)]), width * np.tan(half)


def curvature_continuous(degrees: float, width: float, count: int = 4001) -> FloatArray:
    """(count, 2) points of the profile whose curvature is quadratic in its arc length and 0 at both sides."""
    turn = np.pi - np.radians(degrees)
    along = np.linspace(-1, 1, count)
    angle = -0.5 * turn * (1.5 * along - 0.5 * along**3)
    steps = np.column_stack([np.cos(angle), np.sin(angle)])
    profile = np.concatenate([[[0, 0]], np.cumsum(0.5 * (steps[1:] + steps[:-1]), axis=0)])
    profile -= profile[count // 2]
    half = np.radians(degrees) / 2
    profile *= width * np.sin(half) / profile[-1, 0]
    profile[:, 1] -= width * np.cos(half) + profile[-1, 1]
    return profile
