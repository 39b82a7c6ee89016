"""Selections as people make them, the patch they make, its winding and its mirror."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays, fins, free_vertices, make_patch
from addon.arrays.types import Floats, Mask
from addon.arrays.winding import with_one_winding
from addon.fair.solve import solve
from addon.mirror.symmetry import NEAR, mirror_map, with_image
from addon.options.options import FairOptions
from addon.selection.selection import enclosed_faces, left_out_faces
from addon.verdict.outcome import outcome

import fairing
from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh, tube

SIZE = 12
FLAT = grid(SIZE, 0.0)
CENTRES = grid_points(SIZE)[np.array(grid_quads(SIZE))].mean(axis=1)


def chosen(mask: Mask, mesh: MeshArrays = FLAT) -> MeshArrays:
    return replace(mesh, in_patch=mask)


def where(test: Callable[[Floats], Mask]) -> Mask:
    return np.array(test(CENTRES.T))


def boundary_of(mesh: MeshArrays, faces: Mask) -> Mask:
    """The edges between the faces and the others."""
    uses = np.bincount(mesh.corner_edges[faces[mesh.corner_faces]], minlength=len(mesh.edges))
    rest = np.bincount(mesh.corner_edges[~faces[mesh.corner_faces]], minlength=len(mesh.edges))
    between: Mask = (uses > 0) & (rest > 0)
    return between


def test_a_loop_of_edges_encloses_the_smaller_side() -> None:
    inside = where(lambda c: np.abs(c).max(axis=0) < 0.5)
    assert np.array_equal(enclosed_faces(FLAT, boundary_of(FLAT, inside)), inside)


@pytest.mark.parametrize(("low", "high"), [(3, 6), (12, 19), (5, 15), (2, 18)])
def test_two_loops_round_a_limb_enclose_what_is_between(low: int, high: int) -> None:
    points, quads = tube(10, range(21))  # face 10 · row + column
    mesh = polygon_mesh(points, quads, [False] * len(quads))
    row = np.arange(len(mesh.in_patch)) // 10
    between = (row >= low) & (row < high)
    assert np.array_equal(enclosed_faces(mesh, boundary_of(mesh, between)), between)


def test_a_loop_that_does_not_close_encloses_nothing() -> None:
    walls = boundary_of(FLAT, where(lambda c: np.abs(c).max(axis=0) < 0.5))
    walls[np.flatnonzero(walls)[0]] = False
    assert not enclosed_faces(FLAT, walls).any()
    assert not enclosed_faces(FLAT, np.zeros_like(walls)).any()


def test_a_lasso_that_left_faces_out() -> None:
    inside = where(lambda c: np.abs(c).max(axis=0) < 0.7)
    hole = np.zeros_like(inside)
    hole[[SIZE * 5 + 5, SIZE * 5 + 6, SIZE * 7 + 7]] = True
    assert np.array_equal(left_out_faces(chosen(inside & ~hole)), hole)
    cross = np.zeros_like(inside)
    cross[[SIZE * 5 + 5, SIZE * 4 + 5, SIZE * 6 + 5, SIZE * 5 + 4, SIZE * 5 + 6]] = True
    assert not left_out_faces(chosen(inside & ~cross)).any()  # one more than an oversight has
    long = np.zeros_like(inside)
    long[SIZE * 5 + 4 : SIZE * 5 + 8] = True
    assert np.array_equal(left_out_faces(chosen(inside & ~long)), long)
    large = where(lambda c: np.abs(c).max(axis=0) < 0.3)  # a hole on purpose
    assert not left_out_faces(chosen(inside & ~large)).any()
    corner = np.ones_like(inside)
    corner[0] = False  # at the mesh's own border
    assert not left_out_faces(chosen(corner)).any()
    assert not left_out_faces(replace(chosen(inside), hidden=hole)).any()


def test_a_selection_on_one_side_gets_its_image() -> None:
    one = where(lambda c: (np.abs(c[0] - 0.5) < 0.3) & (np.abs(c[1]) < 0.5))
    mesh = replace(chosen(one, grid(SIZE, 0.0, on_sphere)), mirror_x=True)
    points = mesh.positions.copy()
    patch = make_patch(mesh)
    points[patch.vertices[patch.free]] *= 1.3  # inside anything may be
    both = with_image(replace(mesh, positions=points))
    assert np.array_equal(both.in_patch, one | where(lambda c: (np.abs(c[0] + 0.5) < 0.3) & (np.abs(c[1]) < 0.5)))
    assert mirror_map(both, make_patch(both)) is not None
    assert np.array_equal(with_image(replace(mesh, mirror_x=False)).in_patch, one)


def test_no_image_where_there_is_none() -> None:
    one = where(lambda c: (np.abs(c[0] - 0.5) < 0.3) & (np.abs(c[1]) < 0.5))
    bent = FLAT.positions.copy()
    bent[bent[:, 0] < 0.0, 2] = 0.1
    mesh = replace(chosen(one), mirror_x=True)
    assert np.array_equal(with_image(replace(mesh, positions=bent)).in_patch, one)
    across = where(lambda c: (np.abs(c[0] - 0.1) < 0.3) & (np.abs(c[1]) < 0.5))  # meets its own image
    assert np.array_equal(with_image(replace(mesh, in_patch=across)).in_patch, across)


# From faces and a selection to the patch: counted by hand on small meshes.


def test_an_open_border_and_a_pin_hold_vertices() -> None:
    everything = grid(4, 2.0)
    assert np.flatnonzero(free_vertices(everything)).tolist() == [6, 7, 8, 11, 12, 13, 16, 17, 18]
    pinned = everything.pinned.copy()
    pinned[12] = True
    assert np.flatnonzero(free_vertices(replace(everything, pinned=pinned))).tolist() == [6, 7, 8, 11, 13, 16, 17, 18]


@pytest.mark.parametrize(
    ("size", "share", "map_scale", "area"),
    [(8, 0.8, 1.0, 1.5**2), (6, 0.67, -2.0, 2.0 * (4.0 / 3.0) ** 2)],  # 6 × 6 quads of a quarter; 4 × 4 of a third
)
def test_triangles_of_the_patch_cover_it_once_and_face_up(
    size: int, share: float, map_scale: float, area: float
) -> None:
    """Up was outside, and a map that mirrors leaves it there."""
    world = grid(size, share).transformed(np.diag([map_scale, 1.0, 1.0, 1.0]))
    patch = make_patch(world)
    a, b, c = (world.positions[patch.vertices[column]] for column in patch.triangles.T)
    areas = 0.5 * np.cross(b - a, c - a)[:, 2]
    assert areas.min() > 0.0
    assert areas.sum() == pytest.approx(area)


@pytest.mark.parametrize("scale", [0.0, np.inf, np.nan, 1e-9])
def test_a_flattening_map_is_refused(scale: float) -> None:
    with pytest.raises(ValueError, match="scale is zero or invalid"):
        grid(4, 0.6).transformed(np.diag([1.0, 1.0, scale, 1.0]))


def with_a_fin() -> list[list[int]]:
    """Two by two quads, and a triangle upright on the edge between the vertices 4 and 5."""
    return [*grid_quads(2), [4, 5, 9]]


def test_a_fin_is_left_out() -> None:
    """An upright triangle, selected too, on an edge of the boundary of the middle 4 × 4 of 6 × 6 quads."""
    plain = grid(6, 0.67)
    points = np.vstack([plain.positions, [[-0.2, -0.7, 1.0]]])
    mesh = polygon_mesh(points, [*grid_quads(6), [9, 10, 49]], [*plain.in_patch, True])
    assert np.flatnonzero(fins(mesh)).tolist() == [36]
    assert np.array_equal(make_patch(mesh).triangles, make_patch(plain).triangles)


def test_three_selected_faces_at_an_edge_are_refused_by_name() -> None:
    points = np.vstack([grid_points(2), [[0.5, 0.0, 1.0]]])
    mesh = polygon_mesh(points, with_a_fin(), [True] * 5)
    with pytest.raises(fairing.MeshError, match="edge 4–5") as refusal:
        make_patch(mesh)
    assert refusal.value.diagnostic.elements.tolist() == [4, 5]
    pinned = mesh.pinned.copy()
    pinned[[4, 5]] = True
    make_patch(replace(mesh, pinned=pinned))  # does not raise


# Faces of the selection that are wound against the others count as if they were not.
EYE = np.eye(4)


def sphere(turned: np.ndarray) -> MeshArrays:
    """A side of a cubic sphere with its middle selected, some faces wound the other way round."""
    quads = [quad[::-1] if face in turned else quad for face, quad in enumerate(grid_quads(SIZE))]
    selected = grid(SIZE, 0.6).in_patch
    return polygon_mesh(on_sphere(grid_points(SIZE)), quads, selected)


def some_of(chosen: np.ndarray, every: int) -> np.ndarray:
    return np.flatnonzero(chosen)[::every]


def directed(mesh: MeshArrays) -> set[tuple[int, int]]:
    loops = mesh.corner_vertices.reshape(-1, 4)[mesh.in_patch]
    return {(int(a), int(b)) for loop in loops for a, b in zip(loop, np.roll(loop, -1), strict=True)}


@pytest.mark.parametrize("every", [3, 7])
def test_few_faces_are_turned_to_the_others(every: int) -> None:
    plain = sphere(np.array([]))
    some = some_of(plain.in_patch, every)
    mesh, count = with_one_winding(sphere(some))
    assert count == len(some)
    assert directed(mesh) == directed(plain)
    a, b, c = (mesh.positions[mesh.triangles[mesh.in_patch[mesh.triangle_faces]][:, k]] for k in range(3))
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a) > 0.0).all()
    ends = np.sort(np.column_stack([mesh.corner_vertices.reshape(-1, 4).ravel(), _following(mesh)]), axis=1)
    np.testing.assert_array_equal(ends, np.sort(mesh.edges[mesh.corner_edges], axis=1))


def _following(mesh: MeshArrays) -> np.ndarray:
    return np.roll(mesh.corner_vertices.reshape(-1, 4), -1, axis=1).ravel()


def test_custom_normals_stay_with_their_corners() -> None:
    plain = sphere(np.array([]))
    some = some_of(plain.in_patch, 7)
    spoilt = sphere(some)
    normals = spoilt.positions[spoilt.corner_vertices]  # those of turned faces point in, as Blender gives them
    normals[np.isin(spoilt.corner_faces, some)] *= -1.0
    mesh, _ = with_one_winding(replace(spoilt, corner_normals=normals))
    np.testing.assert_array_equal(mesh.corner_normals, mesh.positions[mesh.corner_vertices])


def test_the_result_and_what_is_said_of_it_are_those_of_a_clean_mesh() -> None:
    """Normals along the boundary would point to both sides, and each turned face would look like a kink of 180°."""
    plain = sphere(np.array([]))
    options = FairOptions()
    clean, spoilt = (
        outcome(mesh, EYE, options, solve(mesh, EYE, options)) for mesh in (plain, sphere(some_of(plain.in_patch, 3)))
    )
    np.testing.assert_allclose(spoilt.positions, clean.positions, atol=1e-9)
    assert spoilt.verdict.grade == "GOOD"
    assert spoilt.join.worst == pytest.approx(clean.join.worst, abs=1e-6)
    assert set(spoilt.warnings) - set(clean.warnings) == {
        f"{len(some_of(plain.in_patch, 3))} faces are flipped against the others: recalculate normals"
    }


# X mirror: the boundary by position, the inside by connectivity.
def expected_images(size: int, vertices: np.ndarray) -> np.ndarray:
    row, column = np.divmod(vertices, size + 1)
    return np.searchsorted(vertices, row * (size + 1) + size - column)


def test_images_in_a_grid_whatever_lies_inside() -> None:
    mesh = grid(8, 0.8)
    patch = make_patch(mesh)
    crumpled = mesh.positions.copy()
    crumpled[patch.vertices[patch.free]] += np.random.default_rng(1).normal(size=(len(patch.free), 3))
    image = mirror_map(replace(mesh, positions=crumpled), patch)
    assert image is not None
    np.testing.assert_array_equal(image, expected_images(8, patch.vertices))


@pytest.mark.parametrize(("shift", "found"), [(0.9 * NEAR, True), (1.1 * NEAR, False), (-1.1 * NEAR, False)])
@pytest.mark.parametrize("axis", [0, 1, 2])
def test_the_boundary_is_compared_as_far_as_blender_looks(shift: float, axis: int, found: bool) -> None:
    mesh = grid(8, 0.8)
    patch = make_patch(mesh)
    points = mesh.positions.copy()
    points[patch.vertices[patch.boundary[1]], axis] += shift
    assert (mirror_map(replace(mesh, positions=points), patch) is not None) == found


def test_of_two_near_images_the_nearest_is_taken() -> None:
    """Two vertices of the boundary 0.5 NEAR apart: both lie near each other's mirror images."""
    points = grid_points(4)
    points[[10, 14], 1] = 0.5 * NEAR  # left and right ends of the middle row …
    points[[5, 9], 1] = 0.0  # … and of the row below it
    mesh = polygon_mesh(points, grid_quads(4), [True] * 16)
    image = mirror_map(mesh, make_patch(mesh))
    assert image is not None
    assert image[[10, 14, 5, 9]].tolist() == [14, 10, 9, 5]


@pytest.mark.parametrize("where", [0.5, 0.25])
def test_pins_must_be_symmetric_too(where: float) -> None:
    mesh = grid(8, 0.8)
    pinned = np.isclose(mesh.positions[:, 0], where) & np.isclose(mesh.positions[:, 1], 0.0)
    assert mirror_map(mesh, make_patch(replace(mesh, pinned=pinned))) is None
    both = pinned | (np.isclose(mesh.positions[:, 0], -where) & np.isclose(mesh.positions[:, 1], 0.0))
    assert mirror_map(mesh, make_patch(replace(mesh, pinned=both))) is not None


def test_connectivity_must_be_symmetric() -> None:
    quads = grid_quads(4)
    split = quads[5]  # inside, left of the middle: as two triangles
    mesh = polygon_mesh(grid_points(4), [*quads[:5], split[:3], [split[0], *split[2:]], *quads[6:]], [True] * 17)
    assert mirror_map(mesh, make_patch(mesh)) is None
