"""Normals along the outline: known ones on planes and spheres, from each source."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.around import outside_triangles
from addon.arrays.region import MeshArrays, Patch, make_patch
from addon.arrays.types import Floats, Mask
from addon.fair.boundary import average_normals, boundary

from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh


def normals_of(mesh: MeshArrays, patch: Patch, source: str) -> tuple[Floats, tuple[str, ...]]:
    found = boundary(mesh, patch, source, outside_triangles(mesh, patch))
    return found.normals, found.notes


def test_normals_of_the_surroundings_are_the_spheres_however_the_patch_lies() -> None:
    mesh = grid(16, 0.6, on_sphere)
    patch = make_patch(mesh)
    spoilt = mesh.positions.copy()
    spoilt[patch.vertices[patch.free]] *= 3.0
    normals, reported = normals_of(replace(mesh, positions=spoilt), patch, "SURROUNDING")
    rim = mesh.positions[patch.vertices[patch.fixed]]
    assert reported == ()
    np.testing.assert_allclose(normals, rim, atol=1e-9)  # spheres are met exactly


def test_average_normals_of_a_plane_and_of_a_corner() -> None:
    assert np.allclose(average_normals(grid(4, 0.6), np.arange(25)), [0.0, 0.0, 1.0])
    quads = [[0, 1, 2, 3], [0, 3, 4, 5], [0, 5, 6, 1]]  # three sides of a cube around the vertex 0
    cube = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 1, 1], [0, 0, 1], [1, 0, 1]], dtype=np.float64)
    normals = average_normals(polygon_mesh(cube, quads, [True] * 3), np.arange(len(cube)))
    np.testing.assert_allclose(normals[0], np.ones(3) / np.sqrt(3.0))
    np.testing.assert_allclose(normals[2], [0.0, 0.0, 1.0])


def test_custom_normals_are_the_mean_of_the_corners() -> None:
    mesh = grid(6, 0.67)
    patch = make_patch(mesh)
    tilted = np.tile([0.6, 0.0, 0.8], (len(mesh.corner_vertices), 1))
    normals, reported = normals_of(replace(mesh, corner_normals=tilted), patch, "CUSTOM")
    assert reported == ()
    np.testing.assert_allclose(normals, np.tile([0.6, 0.0, 0.8], (len(patch.fixed), 1)))
    with pytest.raises(ValueError, match="with its corner normals"):
        normals_of(mesh, patch, "CUSTOM")


def test_a_border_without_faces_outside_is_reported_and_takes_the_patch_average() -> None:
    mesh = grid(4, 2.0)  # all of it
    patch = make_patch(mesh)
    normals, reported = normals_of(mesh, patch, "SURROUNDING")
    assert reported == ("16 border vertices have no faces outside: their normals come from the patch",)
    assert np.allclose(normals, [0.0, 0.0, 1.0])
    pinned = np.zeros(25, dtype=bool)
    pinned[12] = True
    inner = replace(mesh, pinned=pinned)
    assert normals_of(inner, make_patch(inner), "SURROUNDING")[1] == reported  # a pin is none of them


def test_curvatures_of_the_faces_outside() -> None:
    """−1/R on a sphere, on the patch's side where the faces outside are wound against it; NaN where there are none."""
    for wound in (1, -1):
        selected = grid(16, 0.6).in_patch
        quads = [loop if k else loop[::wound] for loop, k in zip(grid_quads(16), selected, strict=True)]
        mesh = polygon_mesh(on_sphere(grid_points(16)), quads, selected)
        patch = make_patch(mesh)
        found = boundary(mesh, patch, "AUTOMATIC", outside_triangles(mesh, patch))
        np.testing.assert_allclose(found.curvatures, -1.0, atol=1e-9)
    alone = grid(4, 2.0)
    patch = make_patch(alone)
    assert np.isnan(boundary(alone, patch, "AUTOMATIC", outside_triangles(alone, patch)).curvatures).all()


def table(size: int, drop: float) -> MeshArrays:
    """A grid whose outer rows hang down on the left and right, 45° and more; its flat middle is selected."""
    points = grid_points(size)
    over = np.abs(points[:, 0]) - 0.5
    points[:, 2] -= drop * np.maximum(over, 0.0)
    quads = grid_quads(size)
    selected = [(np.abs(points[loop, :2]).max(axis=0) <= 0.5 + 1e-9).all() for loop in quads]
    return polygon_mesh(points, quads, selected)


def test_along_hard_edges_the_slope_is_that_of_the_selected_faces() -> None:
    mesh = table(16, 2.0)
    patch = make_patch(mesh)
    fixed = mesh.positions[patch.vertices[patch.fixed]]
    known = boundary(mesh, patch, "AUTOMATIC", outside_triangles(mesh, patch))
    np.testing.assert_allclose(known.normals, np.tile([0.0, 0.0, 1.0], (len(fixed), 1)), atol=1e-9)
    sides = np.isclose(np.abs(fixed[:, 0]), 0.5) & (np.abs(fixed[:, 1]) < 0.49)
    assert np.array_equal(known.from_inside, sides)
    assert known.notes == (
        "14 boundary vertices lie on hard edges: the surface does not go on with the slope outside there",
    )
    assert np.array_equal(known.inward(patch), patch.vertices[patch.fixed[sides]])
    outer, reported = normals_of(mesh, patch, "SURROUNDING")
    assert reported == ()
    assert np.abs(outer[sides, 0]).min() > 0.8
    flat = boundary(table(16, 0.0), patch, "INSIDE", outside_triangles(mesh, patch))
    assert flat.from_inside.all()
    assert flat.notes == ("The boundary is a hard edge all along: the surface does not go on with the slope outside",)


def test_marked_edges_stop_the_fit_unless_most_are() -> None:
    """The sides hang down by 17°, one row beside the selection."""
    mesh = table(24, 0.3)
    near = np.abs(mesh.positions[:, :2]).max(axis=1) < 0.5 - 0.05
    selected = [near[loop].all() for loop in grid_quads(24)]
    mesh = replace(mesh, in_patch=np.array(selected))
    patch = make_patch(mesh)
    ridge = np.isclose(np.abs(mesh.positions[:, 0]), 0.5)
    along = ridge[mesh.edges].all(axis=1)

    def tilt(sharp: Mask | None) -> float:
        normals, _ = normals_of(replace(mesh, sharp=sharp), patch, "AUTOMATIC")
        return float(np.abs(normals[:, 0]).max())

    assert tilt(along) < 1e-9
    assert tilt(None) > 0.01
    assert tilt(np.ones(len(mesh.edges), dtype=bool)) == tilt(None)
