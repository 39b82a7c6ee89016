"""Fillets in quads: what is left of cut faces, and where the corners of new ones take their values from."""

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.fillet.rounding import Rounded, hard, round_arrays
from addon.options.other_options import FilletOptions

from polygon_mesh import polygon_mesh, tube

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


def test_a_seam_that_ends_where_its_face_turns_in_gets_blocks_around_its_end() -> None:
    """One edge of an L, from its inner corner: the line leads around that through the half turn to the next edge.

    Two blocks of a quarter lie there, each with a pole; the other end is at a wall, without one.
    """
    ell = np.array([[1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]])
    points = np.concatenate([np.column_stack([ell, np.full(6, z)]) for z in (0.0, 1.0)])
    walls = [[k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k] for k in range(6)]
    mesh = polygon_mesh(points, [*walls, [0, 5, 4, 3, 2, 1], [6, 7, 8, 9, 10, 11]], np.zeros(8, dtype=bool))
    seam = (np.sort(mesh.edges, axis=1) == [6, 7]).all(axis=1)
    result = round_arrays(mesh, seam, ALL, FilletOptions(width=0.2, quads=True))
    assert result.warnings == ()
    new = result.polygons.polygons[result.unselected :]
    assert {len(polygon) for polygon in new} == {4}
    sides = [(a, b) for polygon in new for a, b in zip(polygon, [*polygon[1:], polygon[0]], strict=True)]
    border = {v for a, b in sides if (b, a) not in set(sides) for v in (a, b)}
    around = np.bincount([v for polygon in new for v in polygon])
    inner = [int(around[v]) for v in set(np.concatenate(new).tolist()) - border]
    assert (inner.count(3), set(inner)) == (2, {3, 4})


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
