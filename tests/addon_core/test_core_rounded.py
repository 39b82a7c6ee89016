"""Fillets in quads, and UVs of new faces."""

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.arrays.types import Floats, Ints, Mask
from addon.fillet.rounding import Rounded, hard, round_arrays
from addon.options.other_options import FilletOptions
from addon.remesh.unwrapping import RimUVs, Surface, Unwrapped, unwrapped

from polygon_mesh import hexagon, polygon_mesh, tube

ALL = np.eye(4)


def prism(sides: int, levels: int = 1) -> MeshArrays:
    """Over a regular polygon, from z = 0 to 1, with one face at each end."""
    points, walls = tube(sides, np.linspace(0.0, 1.0, levels + 1).tolist())
    polygons = [*walls, list(range(sides))[::-1], list(range(sides * levels, len(points)))]
    return polygon_mesh(points, polygons, np.zeros(len(polygons), dtype=bool))


def rounded(mesh: MeshArrays, width: float) -> Rounded:
    return round_arrays(mesh, hard(mesh), ALL, FilletOptions(width=width, quads=True))


@pytest.mark.parametrize(("sides", "width"), [(4, 0.2), (5, 0.2), (24, 0.1)])
def test_what_is_left_of_a_face_has_as_many_corners_as_it_had(sides: int, width: float) -> None:
    mesh = prism(sides)
    result = rounded(mesh, width)
    assert result.warnings == ()
    outside, new = result.polygons.polygons[: result.unselected], result.polygons.polygons[result.unselected :]
    assert sorted(map(len, outside)) == sorted([4] * sides + [sides] * 2)
    assert {len(polygon) for polygon in new} == {4}


def test_corners_of_a_face_take_their_values_from_one_side() -> None:
    """So that a texture whose sides lie apart is not smeared; those of the pieces from just where they lie."""
    mesh = prism(4, 2)
    result = rounded(mesh, 0.15)
    part = result.part
    places = np.concatenate([mesh.positions[part.stay], result.new_positions])
    at = 0
    for number, polygon in enumerate(result.polygons.polygons):
        corners = result.polygons.corners[at : at + len(polygon)]
        at += len(polygon)
        sources, weights = part.corners.sources[corners], part.corners.weights[corners]
        used = sources[weights > 1e-6]
        normals = {tuple(np.round(_normal(mesh, face), 6)) for face in mesh.corner_faces[used].tolist()}
        assert len(normals) == 1
        if number < result.unselected:
            carried = np.einsum("cs,csd->cd", weights, mesh.positions[mesh.corner_vertices[sources]])
            assert abs(carried - places[polygon]).max() < 1e-12


def _normal(mesh: MeshArrays, face: int) -> np.ndarray:
    a, b, c = mesh.positions[mesh.corner_vertices[mesh.corner_faces == face]][:3]
    normal = np.cross(b - a, c - b)
    return normal / np.linalg.norm(normal)


def test_a_seam_that_ends_where_its_face_turns_in_has_triangles_there_alone() -> None:
    """One edge of an L, from its inner corner: the line leads around that through the half turn to the next edge. The
    other end is at a wall."""
    ell = np.array([[1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]])
    points = np.concatenate([np.column_stack([ell, np.full(6, z)]) for z in (0.0, 1.0)])
    walls = [[k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k] for k in range(6)]
    mesh = polygon_mesh(points, [*walls, [0, 5, 4, 3, 2, 1], [6, 7, 8, 9, 10, 11]], np.zeros(8, dtype=bool))
    seam = (np.sort(mesh.edges, axis=1) == [6, 7]).all(axis=1)
    result = round_arrays(mesh, seam, ALL, FilletOptions(width=0.2, quads=True))
    assert result.warnings == ()
    new = result.polygons.polygons[result.unselected :]
    places = np.concatenate([mesh.positions[result.part.stay], result.new_positions])
    along = np.array([places[polygon, 1].mean() for polygon in new])
    count = np.array([len(polygon) for polygon in new])
    assert (count[(along > 1.3) & (along < 1.9)] == 4).all()
    assert (count == 4).sum() >= 8


@pytest.mark.parametrize(("sides", "length"), [(4, 3.2), (6, 4.8)])
@pytest.mark.parametrize("quads", [True, False])
def test_pieces_of_cut_edges_know_their_edge(sides: int, length: float, quads: bool) -> None:
    """The rim of a lid: edges from below end at the fillet."""
    mesh = prism(sides)
    seam = (mesh.positions[mesh.edges][..., 2] > 0.5).all(axis=1)
    result = round_arrays(mesh, seam, ALL, FilletOptions(width=0.2, quads=quads))
    places = np.concatenate([mesh.positions[result.part.stay], result.new_positions])
    polygons = result.polygons.polygons
    drawn = {tuple(sorted(side)) for each in polygons for side in zip(each, [*each[1:], each[0]], strict=True)}
    found: dict[tuple[int, ...], float] = {}
    for pair, ends in zip(result.part.cut.tolist(), result.part.cut_from.tolist(), strict=True):
        low, high = mesh.positions[ends]
        np.testing.assert_allclose(np.cross(places[pair] - low, high - low), 0.0, atol=1e-9)
        if tuple(sorted(pair)) in drawn:
            found[tuple(ends)] = found.get(tuple(ends), 0.0) + float(np.linalg.norm(places[pair[0]] - places[pair[1]]))
    upright = mesh.edges[np.ptp(mesh.positions[mesh.edges][..., 2], axis=1) > 0.5]
    assert set(found) == set(map(tuple, np.sort(upright, axis=1).tolist()))
    assert sum(found.values()) == pytest.approx(length, abs=1e-6)


# UVs of new faces: islands go on by themselves, exactly where the surface is flat, with seams from those around.
RINGS = 8


def disc() -> Surface:
    """A flat hexagon of equilateral triangles, its rim first and counter-clockwise from the positive x-axis."""
    return Surface(*hexagon(RINGS), (np.arange(6 * RINGS),))


def tube_uvs(columns: int = 12, rows: int = 8, height: float = 3.0) -> Surface:
    """A prism without ends, axis z: the upper rim first, then the lower one."""
    turn = 2 * np.pi * np.arange(columns) / columns
    rings = [0, rows, *range(1, rows)]  # of the vertices' order
    points = np.array([(np.cos(t), np.sin(t), height * (1 - ring / rows)) for ring in rings for t in turn])
    first = {ring: k * columns for k, ring in enumerate(rings)}
    triangles = []
    for ring in range(rows):
        for i in range(columns):
            a, b = first[ring] + i, first[ring] + (i + 1) % columns
            c, d = first[ring + 1] + i, first[ring + 1] + (i + 1) % columns
            triangles += [[a, c, d], [a, d, b]]
    upper = np.concatenate([[0], np.arange(columns - 1, 0, -1)])
    return Surface(points, np.array(triangles), (upper, columns + np.arange(columns)))


def halves(surface: Surface, uv: Floats, other: Floats, is_other: Mask, mirrored: Mask | None = None) -> RimUVs:
    """UVs (n, 2) around the boundary, the other ones at the edges (by their tails) of a mask."""
    rim = np.concatenate(surface.loops)
    rows = np.empty((2, len(rim), 2))
    for loop in surface.loops:
        tails, heads = loop, np.roll(loop, -1)
        side = is_other[tails][:, None]
        rows[0, tails] = np.where(side, other[tails], uv[tails])
        rows[1, heads] = np.where(side, other[heads], uv[heads])
    return RimUVs(rows[0], rows[1], np.zeros(len(rim), bool) if mirrored is None else mirrored)


def odd_ends(seams: Ints) -> list[int]:
    """Vertices where an odd number of seams meet: where lines of them end or branch."""
    vertices, counts = np.unique(seams, return_counts=True)
    ends: list[int] = vertices[counts % 2 == 1].tolist()
    return ends


def areas(flat: Unwrapped) -> Floats:
    a, b, c = flat.corners.reshape(-1, 3, 2).transpose(1, 0, 2)
    found: Floats = 0.5 * np.cross(b - a, c - a)
    return found


def test_without_seams_one_map_goes_through_all_of_it() -> None:
    surface = disc()
    uv = surface.points[:, :2] * [0.2, 0.1] + 0.5
    found = unwrapped(surface, halves(surface, uv, uv, np.zeros(len(uv), bool)))
    np.testing.assert_allclose(found.corners, uv[surface.triangles.ravel()], atol=1e-7)
    assert len(found.seams) == 0
    assert found.distortion == pytest.approx(1.0)  # twice as long one way as the other


@pytest.mark.parametrize("turned_over", [False, True])
def test_two_islands_go_on_by_themselves_to_the_middle(turned_over: bool) -> None:
    surface = disc()
    uv = surface.points[:, :2] * 0.1
    other = uv * ([-1.0, 1.0] if turned_over else [1.0, 1.0]) + [5.0, 2.0]
    loop = surface.loops[0]
    right = np.where(loop < 6, True, loop >= 30)  # 24 of the 48 edges
    found = unwrapped(surface, halves(surface, uv, other, right, right & turned_over))
    is_right = found.corners[:, 0] > 2.5
    corner = surface.triangles.ravel()
    np.testing.assert_allclose(found.corners[is_right], other[corner[is_right]], atol=1e-8)
    np.testing.assert_allclose(found.corners[~is_right], uv[corner[~is_right]], atol=1e-8)
    assert set(is_right.reshape(-1, 3).sum(axis=1)) == {0, 3}
    assert odd_ends(found.seams) == [6, 30]
    assert found.distortion == pytest.approx(0.0, abs=1e-8)
    # The line between the two seams that reach the boundary; all triangles lie on the nearer side, but for an edge.
    a, b = surface.points[6, :2], surface.points[30, :2]
    along = (b - a) / np.linalg.norm(b - a)
    middles = surface.points[surface.triangles].mean(axis=1)[:, :2] - a
    beyond = middles @ [-along[1], along[0]]
    sides = is_right[::3]
    assert (sides[beyond > 2.0] == sides[beyond.argmax()]).all()
    assert (sides[beyond < -2.0] == sides[beyond.argmin()]).all()
    assert sides[beyond.argmax()] != sides[beyond.argmin()]


def test_corners_at_the_boundary_keep_their_bits() -> None:
    surface = disc()
    rng = np.random.default_rng(0)
    uv = surface.points[:, :2] * 0.1 + 0.01 * rng.normal(size=(len(surface.points), 2))
    right = surface.loops[0] < 24
    rim = halves(surface, uv, uv + 3.0, right)
    found = unwrapped(surface, rim)
    flat = found.corners.reshape(-1, 3, 2)
    for triangle, corners in zip(surface.triangles.tolist(), flat, strict=True):
        for k in range(3):
            tail, head = triangle[k], triangle[(k + 1) % 3]
            if tail < 48 and head == (tail + 1) % 48:
                np.testing.assert_array_equal(corners[k], rim.after[tail])
                np.testing.assert_array_equal(corners[(k + 1) % 3], rim.before[head])


def strip(surface: Surface) -> tuple[Floats, Floats]:
    """The prism laid out: (n, 2) with u from 0 on at x = 1, and again with the whole way around added there."""
    x, y, z = surface.points.T
    side = 2 * np.sin(np.pi / 12)
    steps = np.round((np.arctan2(y, x) % (2 * np.pi)) / (2 * np.pi / 12))
    uv = np.column_stack([steps * side, z])
    around = np.array([12 * side, 0.0])
    return uv, np.where((steps == 0)[:, None], uv + around, uv)


def cut_tube(surface: Surface, lower: Floats) -> RimUVs:
    """Its UVs, those of the lower rim multiplied and moved by the rows of `lower`."""
    uv, far = strip(surface)
    after, before = np.empty((2, 24, 2))
    for loop, forwards in zip(surface.loops, (False, True), strict=True):
        after[loop] = uv[loop] if forwards else far[loop]
        before[loop] = far[loop] if forwards else uv[loop]
    for rows in (after, before):
        rows[12:] = rows[12:] * lower[0] + lower[1]
    return RimUVs(after, before, np.zeros(24, bool))


def test_a_bridge_between_ends_of_one_island_has_one_seam_from_end_to_end() -> None:
    surface = tube_uvs()
    found = unwrapped(surface, cut_tube(surface, np.array([[1.0, 1.0], [0.0, 0.0]])))
    assert odd_ends(found.seams) == [0, 12]
    assert len(found.seams) == 8
    uv, far = strip(surface)
    corner = surface.triangles.ravel()
    own = np.where((np.abs(found.corners - uv[corner]) < 1e-7).all(axis=1)[:, None], uv[corner], far[corner])
    np.testing.assert_allclose(found.corners, own, atol=1e-7)


def test_a_bridge_between_two_islands_has_a_seam_around_its_middle() -> None:
    surface = tube_uvs()
    apart = np.array([[0.5, 0.5], [30.0, 0.0]])
    found = unwrapped(surface, cut_tube(surface, apart))
    is_lower = found.corners[:, 0] > 25.0
    assert set(is_lower.reshape(-1, 3).sum(axis=1)) == {0, 3}
    middles = surface.points[surface.triangles].mean(axis=1)[:, 2]
    assert (is_lower[::3] == (middles < 1.5))[np.abs(middles - 1.5) > 0.2].all()
    assert found.distortion == pytest.approx(0.0, abs=1e-7)
    assert (areas(found) > 0).all()
    texels = areas(found)[is_lower[::3]].mean() / areas(found)[~is_lower[::3]].mean()
    assert texels == pytest.approx(0.25, rel=1e-6)
