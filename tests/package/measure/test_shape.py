"""Figures of how a surface looks: where it is thin or thick, needles, seams that stay, shapes that are no texture."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest

import fairing

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]

AROUND, ROWS = 16, 40
QUAD = np.array([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
TWO = np.array([[0, 1, 2], [0, 2, 3]])


def tube(radius: Callable[[FloatArray], FloatArray]) -> tuple[FloatArray, IntArray]:
    """A tube along z from 0 to 4, (ROWS + 1) circles of AROUND vertices."""
    z, turn = np.meshgrid(np.linspace(0.0, 4.0, ROWS + 1), 2.0 * np.pi * np.arange(AROUND) / AROUND, indexing="ij")
    points = np.stack([radius(z) * np.cos(turn), radius(z) * np.sin(turn), z], axis=-1).reshape(-1, 3)
    row, column = (index.ravel() for index in np.mgrid[:ROWS, :AROUND])
    a, b = AROUND * row + column, AROUND * row + (column + 1) % AROUND
    return points, np.concatenate([np.column_stack([a, b, b + AROUND]), np.column_stack([a, b + AROUND, a + AROUND])])


@pytest.mark.parametrize("at", [1.2, 2.0, 3.0])
@pytest.mark.parametrize("depth", [-0.3, 0.6])
def test_a_girth_is_that_of_the_place_where_the_tube_is_thinnest_or_thickest(depth: float, at: float) -> None:
    points, triangles = tube(lambda z: 1.0 + depth * np.exp(-(((z - at) / 0.6) ** 2)))
    girth = fairing.looks.girth(points, triangles)
    assert girth is not None
    found, other = (girth.thinnest, girth.thickest) if depth < 0.0 else (girth.thickest, girth.thinnest)
    ends = [float(np.linalg.norm(points[row, :2])) for row in (0, -1)]
    expected = (1.0 + depth) / (min(ends) if depth < 0.0 else max(ends))
    assert (girth.least if depth < 0.0 else girth.largest) == pytest.approx(expected, abs=0.01)
    assert len(found) >= AROUND
    assert np.abs(points[found, 2] - at).max() < 0.35
    assert not len(other)


def test_a_cone_has_no_place_that_is_thin_or_thick() -> None:
    girth = fairing.looks.girth(*tube(lambda z: 1.0 + z))
    assert girth is not None
    assert girth[:2] == (1.0, 1.0)
    assert not len(girth.thinnest) and not len(girth.thickest)


def test_only_the_tube_counts_beside_a_disc() -> None:
    points, triangles = tube(lambda z: 1.0 - 0.3 * np.exp(-(((z - 2.0) / 0.6) ** 2)))
    disc = np.array([[9.0, 0.0, 0.0], [10.0, 0.0, 0.0], [9.0, 1.0, 0.0], [9.2, 0.2, 0.0]])
    fan = np.array([[0, 1, 3], [1, 2, 3], [2, 0, 3]])
    assert fairing.looks.girth(disc, fan) is None
    girth = fairing.looks.girth(np.concatenate([disc, points]), np.concatenate([fan, triangles + 4]))
    assert girth is not None
    assert np.abs(points[girth.thinnest - 4, 2] - 2.0).max() < 0.35


def test_triangles_without_a_height_are_needles() -> None:
    assert not len(fairing.looks.needles(QUAD, TWO).all)
    flat = QUAD.copy()
    flat[1] = (0.5, 0.5 - 1e-4, 0.0)  # next to the diagonal
    assert fairing.looks.needles(flat, TWO).all.tolist() == [0]
    flat[1] = np.nan
    assert 0 in fairing.looks.needles(flat, TWO).all


@pytest.mark.parametrize(("degrees", "seen"), [(0.0, False), (0.5, False), (2.0, True), (90.0, True)])
def test_a_needle_is_seen_where_its_neighbours_bend(degrees: float, seen: bool) -> None:
    """A needle along x between two triangles that turn down by half of the degrees each."""
    half = np.radians(degrees) / 2.0
    y, z = np.cos(half), -np.sin(half)
    points = np.array([[0, 0, 0], [1, 0, 0], [0.5, 1e-5, 0], [0.5, -y, z], [0.2, y, z], [0.8, y, z]], dtype=np.float64)
    triangles = np.array([[0, 1, 2], [1, 0, 3], [0, 2, 4], [2, 1, 5]])
    found = fairing.looks.needles(points, triangles)
    assert found.all.tolist() == [0]
    assert found.seen.tolist() == ([0] if seen else [])


def slit(degrees: float, length: int) -> tuple[FloatArray, IntArray, IntArray]:
    """Two slopes over a grid that meet at x = 0 by so many degrees; the ridge is doubled in its middle."""
    size = 12
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(-6.0, 7.0), np.arange(-6.0, 7.0), indexing="ij"))
    points = np.column_stack([x, y, -np.abs(x) * np.tan(np.radians(degrees) / 2.0)])
    here = (np.arange(size)[:, None] * 13 + np.arange(size)).ravel()
    triangles = np.concatenate(
        [np.column_stack([here, here + 13, here + 14]), np.column_stack([here, here + 14, here + 1])]
    )
    ridge = np.flatnonzero((x == 0.0) & (np.abs(y) < 0.5 * length))
    twin = np.arange(len(points))
    twin[ridge] = len(points) + np.arange(len(ridge))
    left = points[triangles].mean(axis=1)[:, 0] < 0.0
    triangles[left] = twin[triangles[left]]
    return np.concatenate([points, points[ridge]]), triangles, np.concatenate([ridge, twin[ridge]])


def test_a_seam_is_kinked_where_a_long_kink_shows_across_it() -> None:
    points, triangles, held = slit(40.0, 8)
    assert fairing.looks.seam_kinks(points, triangles, held).tolist() == sorted(held)
    assert not len(fairing.looks.seam_kinks(points, triangles, held[:0]))  # a hole in the mesh
    for degrees, length in ((5.0, 8), (40.0, 2)):
        assert not len(fairing.looks.seam_kinks(*slit(degrees, length)))


@pytest.mark.parametrize("sides", [4, 6, 9])
@pytest.mark.parametrize("size", [1e-3, 1.0, 40.0])
@pytest.mark.parametrize(("height", "spoilt"), [(1.5, False), (1.7, True)])
def test_a_vertex_is_pulled_out_by_its_height_in_edges(sides: int, size: float, height: float, spoilt: bool) -> None:
    turns = 2.0 * np.pi * np.arange(sides) / sides
    base = np.column_stack([np.cos(turns), np.sin(turns), np.zeros(sides)])
    apex, below = [[0.0, 0.0, 2.0 * height * np.sin(np.pi / sides)]], [[0.0, 0.0, -100.0]]
    points = size * np.concatenate([base, apex, below])
    fan = np.array([[k, (k + 1) % sides, sides] for k in range(sides)])
    outside = np.array([[(k + 1) % sides, k, sides + 1] for k in range(sides)])
    assert fairing.looks.is_spoilt(points, fan, outside) == spoilt


def plate_and_arc(rows: int, degrees: float, columns: int, kink: float = 0.0) -> tuple[FloatArray, IntArray, IntArray]:
    """A plate of `rows` rows of rectangles, and as many that turn by `degrees` each; triangles before and after.

    Rectangles are one long and far narrower along the line where both meet. The first row turns by half of that, and by
    `kink` more.
    """
    turn = np.radians(np.concatenate([[0.5 * degrees + kink], np.full(rows - 1, degrees)])).cumsum()
    x = np.concatenate([np.arange(-rows, 1.0), np.cos(turn).cumsum()])
    z = np.concatenate([np.zeros(rows + 1), np.sin(turn).cumsum()])
    y = 0.2 * np.arange(columns + 1.0)
    vertices = np.column_stack([np.repeat(x, len(y)), np.tile(y, len(x)), np.repeat(z, len(y))])
    number = np.arange(len(vertices)).reshape(len(x), len(y))
    a, b, c, d = (part.ravel() for part in (number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]))
    triangles = np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])])
    plate = vertices[triangles][:, :, 0].mean(axis=1) < 0
    return vertices, triangles[plate], triangles[~plate]


@pytest.mark.parametrize("degrees", [4.0, 12.0, 25.0])
def test_an_arc_that_begins_on_a_plate_is_no_kink(degrees: float) -> None:
    """The first row turns by half of what each other one does: tangent, though most edges around bend by nothing."""
    vertices, plate, arc = plate_and_arc(6, degrees, 30)
    line = np.intersect1d(plate, arc)
    join = fairing.looks.visible_join(vertices, arc, plate, line)
    assert join.degrees.max() < 1e-6
    assert len(join.seen) == 0


@pytest.mark.parametrize("kink", [3.0, 20.0])
def test_a_kink_before_an_arc_shows_beyond_its_rows(kink: float) -> None:
    """By what it bends more than they do, and between two plates by all of it."""
    vertices, plate, arc = plate_and_arc(6, 4.0, 30, kink)
    line = np.intersect1d(plate, arc)[3:-3]
    np.testing.assert_allclose(
        fairing.looks.visible_join(vertices, arc, plate, line).degrees, max(0.0, kink - 2.0), atol=1e-6
    )
    vertices, plate, other = plate_and_arc(6, 0.0, 30, kink)
    np.testing.assert_allclose(fairing.looks.visible_join(vertices, other, plate, line).degrees, kink, atol=1e-6)
