"""*Continuity Group*: parts of the boundary whose position alone is kept, or whose curvature is continued."""

import bpy
import numpy as np
import pytest

import meshes
from extension import inspect

SLOPE = 0.5  # of the faces beyond the left side: about 27°


def put(obj: bpy.types.Object, vertices: meshes.Mask, weight: float = 1.0) -> None:
    """Make the vertices the group *Loose*."""
    obj.vertex_groups.new(name="Loose").add(np.flatnonzero(vertices).tolist(), weight, "REPLACE")


def sloping_plate() -> tuple[bpy.types.Object, meshes.Mask, meshes.Mask]:
    """A flat square that bends down along its left side, where the selection ends, its free vertices rough; the
    selection's faces; the vertices near enough to that side for the bend to count in the slopes there."""
    obj = meshes.grid(16)
    points = meshes.positions(obj)
    faces = meshes.faces_where(obj, lambda c: max(abs(c.x), abs(c.y)) < 0.6)
    free = meshes.free_vertices(obj, faces)
    left = points[free][:, 0].min() - 0.125
    points[:, 2] = np.minimum(SLOPE * (points[:, 0] - left), 0.0)
    points[free, 2] = 0.05 * np.random.default_rng(1).normal(size=free.sum())
    meshes.move(obj, points)
    return obj, faces, points[:, 0] < left + 0.3


def test_the_slope_is_found_along_the_group_and_met_elsewhere() -> None:
    """The plate goes on flat, with a bend at that side which was asked for; without the group it swells."""
    obj, faces, side = sloping_plate()
    free = meshes.free_vertices(obj, faces)
    put(obj, side)
    assert meshes.fair(obj, faces) == {"FINISHED"}
    assert np.abs(meshes.positions(obj)[free, 2]).max() > 0.02
    obj, faces, side = sloping_plate()
    put(obj, side)
    assert meshes.fair(obj, faces, continuity="G0", continuity_group="Loose") == {"FINISHED"}
    assert np.abs(meshes.positions(obj)[free, 2]).max() < 1e-5
    assert (meshes.report().verdict, meshes.report().reason) == ("GOOD", "")


@pytest.mark.parametrize("weight", [0.0, 1.0])
def test_a_group_without_boundary_vertices_says_so(weight: float) -> None:
    obj, faces = meshes.domed_grid()
    free = meshes.free_vertices(obj, faces)
    put(obj, np.ones_like(free) if weight == 0.0 else free, weight)
    notes = inspect(obj, faces, continuity="G0", continuity_group="Loose").notes
    assert any("tangent all along" in note for note in notes)


# *Curvature Group*: parts of the selection's boundary along which the curvature outside is continued, too.
ASPECT = 1.6  # of an egg, which is no harmonic surface


def rough_egg() -> tuple[bpy.types.Object, meshes.Mask, meshes.Mask]:
    """An egg, faces selected on its side, and their free vertices, which are rough."""
    obj = meshes.sphere(64)
    points = meshes.positions(obj) * [1.0, 1.0, ASPECT]
    faces = meshes.faces_where(obj, lambda c: c.x > 0.5)
    meshes.move(obj, points)
    free = meshes.free_vertices(obj, faces)
    points[free] *= 1.0 + 0.01 * np.random.default_rng(3).normal(size=(free.sum(), 1))
    meshes.move(obj, points)
    return obj, faces, free


def faired(towards: meshes.Floats | None, **options: object) -> tuple[meshes.Floats, meshes.Floats]:
    """How high the free vertices end above the egg, and where; the group is what lies in that direction."""
    obj, faces, free = rough_egg()
    if towards is not None:
        put(obj, meshes.positions(obj) @ towards > 0.0)
    assert meshes.fair(obj, faces, **options) == {"FINISHED"}
    points = meshes.positions(obj)[free]
    return np.abs(np.linalg.norm(points / [1.0, 1.0, ASPECT], axis=1) - 1.0), points


def test_the_curvature_is_continued_along_the_group_alone() -> None:
    """Its side of the dent comes nearer to the egg; the other stays as with tangent joins."""
    up = np.array([0.0, 0.0, 1.0])
    tangent, places = faired(None)
    parted, _ = faired(up, continuity="G2", continuity_group="Loose")
    curved, _ = faired(None, continuity="G2")
    above, below = places[:, 2] > 0.4, places[:, 2] < -0.4
    assert curved.mean() < parted.mean() < tangent.mean()
    assert parted[above].mean() < 0.8 * tangent[above].mean()
    assert abs(parted[below].mean() - tangent[below].mean()) < abs(curved[below].mean() - tangent[below].mean())


@pytest.mark.parametrize("remesh", [False, True])
def test_a_group_off_the_boundary_says_so_and_the_join_is_tangent(remesh: bool) -> None:
    obj, faces, free = rough_egg()
    put(obj, free)
    notes = inspect(obj, faces, continuity="G2", continuity_group="Loose").notes
    assert any("tangent all along" in note for note in notes)
    assert meshes.fair(obj, faces, continuity="G2", continuity_group="Loose", remesh=remesh) == {"FINISHED"}
    if not remesh:
        np.testing.assert_array_equal(meshes.positions(obj)[free], faired(None)[1])
