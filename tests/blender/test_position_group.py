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


@pytest.mark.parametrize("continuity", ["G0", "G2"])
@pytest.mark.parametrize("weight", [0.0, 1.0])
def test_a_group_without_boundary_vertices_says_so(weight: float, continuity: str) -> None:
    obj, faces = meshes.domed_grid()
    free = meshes.free_vertices(obj, faces)
    put(obj, np.ones_like(free) if weight == 0.0 else free, weight)
    notes = inspect(obj, faces, continuity=continuity, continuity_group="Loose").notes
    assert any("tangent all along" in note for note in notes)
