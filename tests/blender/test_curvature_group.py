"""*Curvature Group*: parts of the selection's boundary along which the curvature outside is continued, too."""

import bpy
import numpy as np
import pytest

import meshes
from extension import inspect
from test_position_group import put

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
