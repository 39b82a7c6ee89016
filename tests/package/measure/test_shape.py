"""Looks and maps: girth, seams, rounded edges, conformal maps."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pytest

import fairing
import holes
import shapes
from grids import halves, numbered
from holes import FloatArray, IntArray

AROUND, ROWS = 16, 40
NOTHING = np.empty((0, 3), dtype=np.int64)


def tube(radius: Callable[[FloatArray], FloatArray]) -> tuple[FloatArray, IntArray]:
    """A tube along z from 0 to 4, (ROWS + 1) circles of AROUND vertices."""
    z, turn = np.meshgrid(np.linspace(0.0, 4.0, ROWS + 1), 2.0 * np.pi * np.arange(AROUND) / AROUND, indexing="ij")
    points = np.stack([radius(z) * np.cos(turn), radius(z) * np.sin(turn), z], axis=-1).reshape(-1, 3)
    number = numbered(ROWS + 1, AROUND)
    return points, halves(np.column_stack([number, number[:, 0]]))[:, ::-1]


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


def slit(degrees: float, length: int) -> tuple[FloatArray, IntArray, IntArray]:
    """Two slopes over a grid that meet at x = 0 by so many degrees; the ridge is doubled in its middle."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(-6.0, 7.0), np.arange(-6.0, 7.0), indexing="ij"))
    points = np.column_stack([x, y, -np.abs(x) * np.tan(np.radians(degrees) / 2.0)])
    triangles = halves(numbered(13, 13))
    ridge = np.flatnonzero((x == 0.0) & (np.abs(y) < 0.5 * length))
    twin = np.arange(len(points))
    twin[ridge] = len(points) + np.arange(len(ridge))
    left = points[triangles].mean(axis=1)[:, 0] < 0.0
    triangles[left] = twin[triangles[left]]
    return np.concatenate([points, points[ridge]]), triangles, np.concatenate([ridge, twin[ridge]])


def kinks(points: FloatArray, triangles: IntArray, held: IntArray) -> list[int]:
    return fairing.looks.judged(points, triangles, NOTHING, held=held, rim=()).seams.tolist()


def test_a_seam_is_kinked_where_a_long_kink_shows_across_it() -> None:
    points, triangles, held = slit(40.0, 8)
    assert kinks(points, triangles, held) == sorted(held)
    assert not kinks(points, triangles, held[:0])  # a hole in the mesh
    for degrees, length in ((5.0, 8), (40.0, 2)):
        assert not kinks(*slit(degrees, length))


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
    triangles = halves(numbered(len(x), len(y)))
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


@pytest.mark.parametrize(("columns", "is_seen"), [(3, False), (12, True)])
def test_a_kink_is_seen_along_more_than_an_eighth_of_the_boundary(columns: int, is_seen: bool) -> None:
    vertices, plate, other = plate_and_arc(6, 0.0, 40, 30.0)
    vertices[vertices[:, 1] < 0.2 * (40 - columns), 2] = 0.0
    join = fairing.looks.visible_join(vertices, other, plate, np.intersect1d(plate, other))
    assert join.degrees.max() > join.limit
    assert bool(len(join.seen)) == is_seen


# Hard edges that a smoothed boundary rounds are distinguished from noise.
Floats = npt.NDArray[np.float64]


Ints = npt.NDArray[np.int64]


ROWS_ROUNDED = 12


def roof(degrees: float) -> tuple[Floats, Ints]:
    """Two slopes that meet in a ridge along x, by so many degrees; vertices row by row along y."""
    half = np.radians(degrees) / 2.0
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(ROWS_ROUNDED + 1.0), np.arange(-3.0, 4.0), indexing="ij"))
    points = np.stack([x, y * np.cos(half), -np.abs(y) * np.sin(half)], axis=1)
    return points, halves(numbered(ROWS_ROUNDED + 1, 7))


def flattened(points: Floats, rows: int, by: float) -> tuple[Floats, Ints]:
    """Lower the ridge's first vertices: those of so many rows."""
    moved = np.arange(rows) * 7 + 3
    after = points.copy()
    after[moved, 2] -= by
    return after, moved


def rounded(points: Floats, after: Floats, triangles: Ints, moved: Ints) -> list[int]:
    """The vertices at hard edges that are rounded where these have moved, of a surface of all their triangles."""
    inside = np.isin(triangles, moved).any(axis=1)
    held = np.setdiff1d(triangles[inside], moved)
    surface, others = triangles[inside], triangles[~inside]
    found = fairing.looks.judged(after, surface, others, held=held, rim=held, before=points, moved=moved)
    return found.rounded.tolist()


@pytest.mark.parametrize("degrees", [90.0, 60.0, 45.0])
@pytest.mark.parametrize("turned", [False, True])
def test_a_ridge_that_was_lowered_at_its_end_is_found(turned: bool, degrees: float) -> None:
    points, triangles = roof(degrees)
    after, moved = flattened(points, 3, 0.4)
    triangles = triangles[:, ::-1] if turned else triangles  # a valley
    assert rounded(points, after, triangles, moved) == moved.tolist()


def test_what_keeps_its_edge_is_none() -> None:
    for degrees, rows, by in ((90.0, 3, 0.01), (30.0, 3, 0.4), (90.0, 1, 0.05)):
        points, triangles = roof(degrees)
        after, moved = flattened(points, rows, by)
        assert not rounded(points, after, triangles, moved), (degrees, rows, by)


@pytest.mark.parametrize("seed", range(6))
def test_noise_that_is_smoothed_is_no_hard_edge(seed: int) -> None:
    points, triangles = roof(0.0)
    rough = points + np.random.default_rng(seed).normal(scale=0.3, size=points.shape)
    inner = np.flatnonzero((points[:, 0] < 6.0) & (np.abs(points[:, 1]) < 3.0))
    after = rough.copy()
    after[inner] = points[inner]
    assert not rounded(rough, after, triangles, inner)


# fairing.maps.conformal_map: exact maps come back; a border that is fixed all around makes it harmonic.
def tilted_sheet(cells: int = 8) -> tuple[FloatArray, FloatArray, IntArray]:
    """(n, 2) a jittered square, (n, 3) the same somewhere in space, and its triangles."""
    flat, triangles = holes.sheet(lambda u, v: (u, v, 0 * u), (cells, cells), lambda u, v: np.zeros(len(u), bool))
    turned, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    return flat[:, :2], flat @ turned.T * np.sign(np.linalg.det(turned)) + [3.0, -1.0, 2.0], triangles


def test_a_flat_piece_is_laid_out_from_two_neighbours() -> None:
    """The map is a similarity there, whatever lies between."""
    flat, points, triangles = tilted_sheet()
    scale, turn = 0.3, np.exp(0.7j)
    wanted = (flat @ [1, 1j]) * scale * turn
    places = np.column_stack([wanted.real, wanted.imag])
    found = fairing.maps.conformal_map(points, triangles, [3, 12], places[[3, 12]])
    np.testing.assert_allclose(found, places, atol=1e-9)


def test_a_sphere_is_projected_from_half_of_its_boundary() -> None:
    """The stereographic projection from the south pole keeps angles; the other half of the boundary is free."""
    errors = []
    for n_free in (200, 800, 3200):
        patch = shapes.cap(n_free)
        x, y, z = patch.vertices.T
        exact = np.column_stack([x, y]) / (1 + z)[:, None]
        half = patch.fixed[y[patch.fixed] > 0]
        found = fairing.maps.conformal_map(patch.vertices, patch.triangles, half, exact[half])
        errors.append(np.abs(found - exact).max())  # at the far end of the free border
    assert errors[0] > 1.3 * errors[1] > 1.9 * errors[2]
    assert errors[2] < 2.5e-2


def test_what_is_not_determined_is_refused() -> None:
    flat, points, triangles = tilted_sheet()
    twice = np.concatenate([points, points + 5.0]), np.concatenate([triangles, triangles + len(points)])
    with pytest.raises(fairing.SolverError, match="fewer than two fixed vertices"):
        fairing.maps.conformal_map(*twice, [0, 1, len(points)], flat[[0, 1, 0]])
