"""Holes: which border a selection stands for, what is carried over new faces, and which surface is refused."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from addon.arrays.border import BorderRefusal, border_loops
from addon.arrays.region import MeshArrays, nothing
from addon.arrays.types import Floats, Ints, Mask
from addon.fill.across import reported
from addon.fill.filling import fill
from addon.fill.pieces import Piece
from addon.fill.report import make_fill_report
from addon.fill.verdict import judge, measured
from addon.options.other_options import FillOptions
from addon.remesh.key_surface import NewSurface, Surroundings, key_surfaces
from addon.verdict.quality import Join
from addon.verdict.verdict import GOOD, LOOK, UNUSABLE, Verdict
from addon.words.sentences import MeshRefusal

import fairing
import holes
from polygon_mesh import grid_points, grid_quads, hexagon, on_sphere, polygon_mesh, tube

SIZE = 8


def holed(*holes: tuple[int, int], half: int = 1) -> MeshArrays:
    """A grid of quads on a sphere without the 2 half × 2 half quads around each of the vertices (row, column)."""
    rows, columns = np.divmod(np.arange(SIZE * SIZE), SIZE)
    gone = np.zeros(SIZE * SIZE, dtype=bool)
    for row, column in holes:
        gone |= (np.abs(rows + 0.5 - row) < half) & (np.abs(columns + 0.5 - column) < half)
    quads = [quad for quad, left_out in zip(grid_quads(SIZE), gone, strict=True) if not left_out]
    return polygon_mesh(on_sphere(grid_points(SIZE)), quads, np.zeros(len(quads), dtype=bool))


def only(mesh: MeshArrays, *vertices: int) -> Mask:
    seeds = np.zeros(len(mesh.positions), dtype=bool)
    seeds[list(vertices)] = True
    return seeds


def vertex(row: int, column: int) -> int:
    return row * (SIZE + 1) + column


def test_one_vertex_stands_for_its_whole_loop() -> None:
    mesh = holed((2, 2), (6, 6))
    ((loop,), left) = border_loops(mesh, only(mesh, vertex(1, 1)))
    assert not left
    # Seen from above the hole is on the left: counter-clockwise.
    around = [(1, 1), (1, 2), (1, 3), (2, 3), (3, 3), (3, 2), (3, 1), (2, 1)]
    assert loop.tolist() == [vertex(*place) for place in around]


@pytest.mark.parametrize(("value", "text"), [(np.nan, "NaN"), (None, "without length")])
def test_borders_without_a_shape_are_left(value: float | None, text: str) -> None:
    mesh = holed((4, 4))
    points = mesh.positions.copy()
    points[vertex(3, 3)] = points[vertex(3, 4)] if value is None else value
    loops, (left,) = border_loops(replace(mesh, positions=points), only(mesh, vertex(3, 4)))
    assert not loops
    assert text in left.reason
    assert len(left.vertices) == 8


def test_what_is_wrong_with_one_hole_stops_no_other() -> None:
    """A blade through one surface, and another hole that is no loop of border edges."""
    mesh = holed((2, 2), (6, 6))
    apex = len(mesh.positions)
    normal = mesh.positions[vertex(2, 2)]
    blade = np.array([0.8 * normal, 1.3 * normal + 0.01, 1.3 * normal - [0.01, 0.0, 0.0]])
    quads = [*mesh.corner_vertices.reshape(-1, 4).tolist(), [apex, apex + 1, apex + 2]]
    pierced = polygon_mesh(np.concatenate([mesh.positions, blade]), quads, np.zeros(len(quads), dtype=bool))
    loops, _ = border_loops(pierced, only(pierced, vertex(1, 1), vertex(5, 5)))
    inner = np.array([vertex(3, 3), vertex(3, 4), vertex(4, 4), vertex(4, 3)])
    done = fill(pierced, np.eye(4), [*loops, inner], FillOptions())
    (piece,), reasons = done.pieces, [each.reason for each in done.left]
    assert set(piece.boundary.tolist()) == set(loops[1].tolist())
    assert "not one closed loop" in reasons[0]
    assert "pass" in reasons[1]
    assert set(done.left_vertices.tolist()) == {*loops[0].tolist(), *inner.tolist()}
    report = make_fill_report([("Ball", done)], FillOptions(), 1.0)
    assert (report.verdict.grade, report.written) == (LOOK, True)
    assert "2 of 3 holes stay open" in report.verdict.reason
    np.testing.assert_array_equal(report.verdict.spots, done.left_vertices)
    every = fill(pierced, np.eye(4), loops, FillOptions(allow_folds=True))
    assert (len(every.pieces), every.left) == (2, ())


def filled(mesh: MeshArrays, *seeds: int, matrix: Floats | None = None, **options: object) -> list[Piece]:
    matrix = np.eye(4) if matrix is None else matrix
    loops, _ = border_loops(mesh, only(mesh, *seeds))
    return fill(mesh, matrix, loops, FillOptions(**options)).pieces  # type: ignore[arg-type]


def two_tubes(*, turned_over: bool = False) -> MeshArrays:
    """Along z with a gap between the vertices from 48 and those from 72 on; the upper one inside out if wanted."""
    points, rows = tube(24, (-1.6, -1.3, -1.0, 1.0, 1.3, 1.6))
    quads = rows[:48] + rows[72:]
    quads = [quad[::-1] if turned_over and quad[0] >= 72 else quad for quad in quads]
    return polygon_mesh(points, quads, np.zeros(len(quads), dtype=bool))


def test_a_tube_turned_over_is_reported_and_four_boundaries_are_too_many() -> None:
    with pytest.raises(MeshRefusal, match=r"faces around the boundary through vertex .* point the other way") as error:
        filled(two_tubes(turned_over=True), 48, 72, bridge=True)
    assert set(error.value.elements.tolist()) == set(range(72, 96))
    with pytest.raises(BorderRefusal, match=r"all 4 selected boundary loops.*belong together") as too_many:
        filled(two_tubes(), 0, 48, 72, 120, bridge=True)
    assert len(too_many.value.elements) == 96


def test_a_surface_through_the_mesh_is_unusable() -> None:
    mesh = holed((4, 4), half=2)
    apex = len(mesh.positions)
    blade = np.array([[0.1, 0.1, 0.5], [0.12, 0.1, 2.0], [0.1, 0.12, 2.0]])
    points = np.concatenate([mesh.positions, blade])
    quads = mesh.corner_vertices.reshape(-1, 4).tolist()
    through = polygon_mesh(points, [*quads, [apex, apex + 1, apex + 2]], np.zeros(len(quads) + 1, dtype=bool))
    (piece,) = filled(through, vertex(2, 2))
    assert piece.verdict.grade == UNUSABLE
    assert "pass" in piece.verdict.reason
    (piece,) = filled(mesh, vertex(2, 2))
    assert piece.verdict.grade != UNUSABLE


def judged(points: Floats, join: Join, **of_result: object) -> Verdict:
    """The verdict on a disc with these points, whose boundary comes first, and nothing around it."""
    (flat, triangles), rim = hexagon(3), 18
    alone = polygon_mesh(flat[:rim], [[0, 1, 2]], [False])
    seen = measured(replace(alone, triangles=alone.triangles[:0]), np.arange(rim), points, triangles, np.arange(rim))
    usual = {"converged": True, "termination": "converged", "equation": "harmonic", "loops": (np.arange(rim),)}
    usual["girth"] = None
    result = SimpleNamespace(**{**usual, **of_result})
    return judge(np.arange(rim), result, join, seen)  # type: ignore[arg-type]


def test_what_has_not_converged_is_unusable() -> None:
    (points, _), rim = hexagon(3), 18
    reported = judged(points, Join(nothing(), np.empty(0)), converged=False, termination="stalled")
    assert reported.grade == UNUSABLE
    assert reported.reason == f"No fair surface was found for a boundary of {rim} edges"
    assert set(reported.spots.tolist()) == set(range(rim))


def joined(degrees: float = 0.0, limit: float = 12.0) -> Join:
    """One vertex of the boundary, 2, with such a kink."""
    values = np.where(np.arange(4) == 2, degrees, 1.0)
    return Join(np.arange(4), values, np.flatnonzero(values > limit), limit)


def test_a_fold_is_unusable_and_a_substitute_worth_a_look() -> None:
    points, _ = hexagon(3)
    assert judged(points, joined()).grade == GOOD
    verdict = judged(points, joined(), equation="loft")
    assert (verdict.grade, "the loft that joins them is a stand-in" in verdict.reason) == (LOOK, True)
    verdict = judged(points, joined(), equation="smoothed")
    assert (verdict.grade, "the old shape was smoothed" in verdict.reason) == (LOOK, True)
    points[-1, 0] += 2.5  # the middle, far beyond its neighbours
    verdict = judged(points, joined())
    assert (verdict.grade, "has folds" in verdict.reason) == (UNUSABLE, True)


def test_a_kink_is_worth_a_look_where_it_is_seen() -> None:
    points, _ = hexagon(3)
    verdict = judged(points, joined(30.0))
    assert (verdict.grade, verdict.spots.tolist()) == (LOOK, [2])
    assert "1 vertex of the boundary, of 30°" in verdict.reason
    assert judged(points, joined(20.0, limit=25.0)).grade == GOOD


def test_the_curvature_around_is_continued_where_it_can_be() -> None:
    grid = grid_points(40)
    x, y = grid[:, 0], grid[:, 1]
    waves = np.column_stack([x, y, 0.3 * np.sin(2.5 * x) * np.cos(2.0 * y)])
    rows, columns = np.divmod(np.arange(1600), 40)
    keep = np.hypot(rows - 19.5, columns - 19.5) > 8
    quads = [quad for quad, stays in zip(grid_quads(40), keep, strict=True) if stays]
    sheet = polygon_mesh(waves, quads, np.zeros(len(quads), dtype=bool))
    rim = int(np.intersect1d(np.array(grid_quads(40))[~keep], np.array(quads))[0])
    off, notes = {}, {}
    for name, noise in (("G1", 0.0), ("G2", 0.0), ("rough", 2e-3)):
        rough = waves + noise * np.random.default_rng(0).normal(size=waves.shape)
        (piece,) = filled(replace(sheet, positions=rough), rim, continuity="G1" if name == "G1" else "G2")
        px, py, pz = piece.positions.T
        off[name] = np.abs(pz - 0.3 * np.sin(2.5 * px) * np.cos(2.0 * py)).max()
        notes[name] = piece.notes
    assert off["G2"] < 0.5 * off["G1"]
    assert notes["G1"] == notes["G2"] == ()
    (note,) = notes["rough"]
    assert "only the slope fits, not the curvature. The curvature around it looks like noise" in note


# Shape keys over a new surface: one of their own where they bend its boundary, otherwise what was carried over.
RIM = 32


def filled_keys(half_angle: float = 60.0) -> tuple[NewSurface, Surroundings, Floats]:
    """A cap over a hole in the unit sphere; what is around it, its rim first, and its new vertices."""
    vertices, triangles = holes.bowl(RIM, half_angle)
    result = fairing.fill(vertices, triangles, [np.arange(RIM)])
    number = np.arange(len(vertices) + len(result.vertices))
    number[len(vertices) :] += RIM - len(vertices)
    surface = NewSurface(np.concatenate([vertices[:RIM], result.vertices]), number[result.triangles], result.equation)
    return surface, Surroundings(np.arange(len(vertices)), triangles, np.eye(4)), vertices


def larger(surface: NewSurface, factor: float = 1.5) -> Floats:
    """Where offsets that are carried over lead for a key of another size: too flat."""
    flat = factor * surface.points[RIM:]
    flat[:, 2] -= 0.04 * factor * (1 - np.hypot(flat[:, 0], flat[:, 1]) / factor)
    return flat


def test_a_larger_ball_comes_back_from_offsets_that_are_too_flat() -> None:
    surface, around, places = filled_keys()
    carried = larger(surface)
    (found,) = key_surfaces(surface, around, [1.5 * places], [carried])
    assert found is not None
    assert np.abs(np.linalg.norm(carried, axis=1) - 1.5).max() > 0.02
    assert np.abs(np.linalg.norm(found, axis=1) - 1.5).max() < 2e-4


def test_keys_that_move_the_boundary_as_a_whole_keep_their_offsets() -> None:
    surface, around, places = filled_keys()
    shift = np.array([0.1, 0.2, 0.3])
    still, aside = surface.points[RIM:], surface.points[RIM:] + shift
    assert key_surfaces(surface, around, [places, places + shift], [still, aside]) == [None, None]


def test_a_key_without_a_surface_keeps_its_offsets() -> None:
    surface, around, places = filled_keys()
    broken = 1.5 * places
    broken[3] = np.nan
    point = np.zeros_like(places)
    carried = larger(surface)
    assert key_surfaces(surface, around, [broken, point], [carried, carried]) == [None, None]
    loft = NewSurface(surface.points, surface.triangles, "loft")
    assert key_surfaces(loft, around, [1.5 * places], [carried]) == [None]


def test_a_surface_through_itself_is_not_taken() -> None:
    """The rim as a figure eight: whatever comes out, it is no better than what was carried over."""
    surface, around, places = filled_keys()
    turn = np.arctan2(places[:, 1], places[:, 0])
    eight = np.column_stack([np.sin(turn), np.sin(2 * turn), 0.1 * places[:, 2]]) * np.hypot(*places[:, :2].T)[:, None]
    assert key_surfaces(surface, around, [eight], [larger(surface)]) == [None]


# Holes at which hard edges of the mesh end.
SIZE_ENDS = 24  # faces along each side of [−1, 1]²


def roof(degrees: float, hole_at: float) -> MeshArrays:
    """Two slopes that meet in a ridge along x, with a square hole of 6 × 6 faces around (0, hole_at)."""
    flat = grid_points(SIZE_ENDS)
    points = flat.copy()
    points[:, 2] = -np.tan(np.radians(degrees) / 2.0) * np.abs(flat[:, 1])
    quads = np.array(grid_quads(SIZE_ENDS))
    away = np.abs(flat[quads].mean(axis=1) - [0.0, hole_at, 0.0])[:, :2].max(axis=1)
    left = quads[away > 0.26]
    return polygon_mesh(points, left.tolist(), np.zeros(len(left), dtype=bool))


def rim(mesh: MeshArrays, hole_at: float) -> Ints:
    chosen = np.abs(grid_points(SIZE_ENDS)[:, :2] - [0.0, hole_at]).max(axis=1) < 0.3
    ((loop,), _) = border_loops(mesh, chosen)
    return loop


@pytest.mark.parametrize("degrees", [90.0, 50.0])
def test_a_ridge_runs_on_through_a_hole(degrees: float) -> None:
    """The two slopes come back, the report says why, and no quad lies over the ridge."""
    mesh = roof(degrees, 0.0)
    (piece,) = fill(mesh, np.eye(4), [rim(mesh, 0.0)], FillOptions(quads=True)).pieces
    assert piece.verdict.grade == GOOD
    assert reported([piece.across, piece.across]) == "2 run on"
    slope = np.tan(np.radians(degrees) / 2.0)
    np.testing.assert_allclose(piece.points[:, 2], -slope * np.abs(piece.points[:, 1]), atol=1e-9)
    on_ridge = np.unique(piece.across.edges)
    np.testing.assert_allclose(piece.points[on_ridge, 1:], 0.0, atol=1e-9)
    lines = np.empty((0, 2), dtype=np.int64)
    polygons = piece.faces(np.zeros(len(piece.triangles), dtype=np.int64), lines).polygons
    assert max(map(len, polygons)) == 4
    for polygon in polygons:
        sides = np.sign(np.round(piece.points[polygon, 1], 9))
        assert not {-1.0, 1.0} <= set(sides.tolist())
    assert not len(piece.across.sharp)


def test_faces_wound_against_each_other_are_left() -> None:
    quads = [quad for number, quad in enumerate(grid_quads(3)) if number != 4]
    quads[1] = quads[1][::-1]
    mesh = polygon_mesh(grid_points(3), quads, np.zeros(8, dtype=bool))
    loops, left = border_loops(mesh, only(mesh, 5))
    assert not loops
    assert all("point opposite ways" in each.reason and len(each.spots) for each in left)
    assert 5 in np.concatenate([each.vertices for each in left])
