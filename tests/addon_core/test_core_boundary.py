"""Normals along the outline: known ones on planes and spheres, from each source."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from core.around import RINGS, numbered, outside_triangles
from core.arrays import Floats
from core.boundary import average_normals, prescribed_curvatures, prescribed_normals
from core.region import MeshArrays, Patch, make_patch
from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh


def normals_of(mesh: MeshArrays, patch: Patch, source: str) -> tuple[Floats, tuple[str, ...]]:
    return prescribed_normals(mesh, patch, source, outside_triangles(mesh, patch))


def test_normals_of_the_surroundings_are_the_spheres_however_the_patch_lies() -> None:
    mesh = grid(16, 0.6, on_sphere)
    patch = make_patch(mesh)
    spoilt = mesh.positions.copy()
    spoilt[patch.vertices[patch.free]] *= 3.0
    normals, told = normals_of(replace(mesh, positions=spoilt), patch, "SURROUNDING")
    rim = mesh.positions[patch.vertices[patch.fixed]]
    assert told == ()
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
    normals, told = normals_of(replace(mesh, corner_normals=tilted), patch, "CUSTOM")
    assert told == ()
    np.testing.assert_allclose(normals, np.tile([0.6, 0.0, 0.8], (len(patch.fixed), 1)))
    with pytest.raises(ValueError, match="without its corner normals"):
        normals_of(mesh, patch, "CUSTOM")


def test_a_border_without_faces_outside_is_told_and_takes_the_patch_average() -> None:
    mesh = grid(4, 2.0)  # all of it
    patch = make_patch(mesh)
    normals, told = normals_of(mesh, patch, "SURROUNDING")
    assert told == ("16 border vertices have no faces outside: their normals come from the patch",)
    assert np.allclose(normals, [0.0, 0.0, 1.0])
    pinned = np.zeros(25, dtype=bool)
    pinned[12] = True
    inner = replace(mesh, pinned=pinned)
    assert normals_of(inner, make_patch(inner), "SURROUNDING")[1] == told  # a pin is none of them


def test_what_is_not_finite_outside_is_left_out() -> None:
    mesh = grid(16, 0.6, on_sphere)
    patch = make_patch(mesh)
    broken = mesh.positions.copy()
    broken[17 * 2 + 8] = np.nan  # next to the outline
    with np.errstate(invalid="ignore"):
        normals, _ = normals_of(replace(mesh, positions=broken), patch, "SURROUNDING")
    np.testing.assert_allclose(normals, mesh.positions[patch.vertices[patch.fixed]], atol=1e-9)


def test_triangles_around_are_those_within_four_rings() -> None:
    mesh = grid(20, 0.3)
    patch = make_patch(mesh)
    outside = outside_triangles(mesh, patch)
    rim = np.abs(mesh.positions[patch.vertices]).max()
    rings = 10.0 * (np.abs(mesh.positions).max(axis=1) - rim)  # how many steps outside, below zero inside
    assert rings[outside].max() == pytest.approx(RINGS)
    assert rings[outside].mean(axis=1).min() > 0.0  # none of the patch itself
    sideways = np.abs(mesh.positions[:, 1]) < rim  # away from the corners, which diagonals cut
    near = sideways & (rings < RINGS + 0.5)
    wanted = near[mesh.triangles].all(axis=1) & ~mesh.in_patch[mesh.triangle_faces]
    assert {*map(tuple, mesh.triangles[wanted].tolist())} <= {*map(tuple, outside.tolist())}
    vertices, around = numbered(patch, outside)
    assert np.array_equal(vertices[: len(patch.vertices)], patch.vertices)
    assert np.array_equal(vertices[around], outside)
    assert len(np.unique(vertices)) == len(vertices)


def test_curvatures_of_the_faces_outside() -> None:
    """−1/R on a sphere, on the patch's side where the faces outside are wound against it; NaN where there are none."""
    for wound in (1, -1):
        selected = grid(16, 0.6).in_patch
        quads = [loop if k else loop[::wound] for loop, k in zip(grid_quads(16), selected, strict=True)]
        mesh = polygon_mesh(on_sphere(grid_points(16)), quads, selected)
        patch = make_patch(mesh)
        found = prescribed_curvatures(mesh, patch, outside_triangles(mesh, patch))
        np.testing.assert_allclose(found, -1.0, atol=1e-9)
    alone = grid(4, 2.0)
    patch = make_patch(alone)
    assert np.isnan(prescribed_curvatures(alone, patch, outside_triangles(alone, patch))).all()
