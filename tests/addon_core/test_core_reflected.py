"""Half a mesh with a Mirror modifier: the whole is faired, the half moves."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays, Reflection
from addon.arrays.types import Floats, Mask
from addon.fair.solve import solve
from addon.mirror.reflected import Whole, whole_of
from addon.options.options import FairOptions
from addon.verdict.outcome import Fairing, outcome

from polygon_mesh import grid_points, grid_quads, on_sphere, polygon_mesh

SIZE = 16


def across(axis: int, reach: float = 1e-3) -> Reflection:
    flip = np.eye(4)
    flip[axis, axis] = -1.0
    return Reflection(flip, reach)


def part_of_sphere(*axes: int) -> tuple[MeshArrays, Mask]:
    """The part below 0 along the axes of a cubic sphere's side, its selected middle pushed in and shaken; what moves.

    It ends on the planes of reflection, which the selection reaches.
    """
    points, quads = grid_points(SIZE), np.array(grid_quads(SIZE))
    centres = points[quads].mean(axis=1)
    there = (centres[:, list(axes)] < 0.0).all(axis=1)
    used, corners = np.unique(quads[there], return_inverse=True)
    selected = np.abs(centres[there]).max(axis=1) < 0.6
    points = points[used]
    mesh = polygon_mesh(on_sphere(points), corners.reshape(-1, 4).tolist(), selected)
    free = np.abs(points).max(axis=1) < 0.6
    shaken = mesh.positions.copy()
    shaken[free] = 0.8 * shaken[free] + 0.05 * np.random.default_rng(5).normal(size=(int(free.sum()), 3))
    for axis in axes:
        shaken[np.isclose(points[:, axis], 0.0), axis] = 0.0
    return replace(mesh, positions=shaken, reflections=tuple(across(axis) for axis in axes)), free


def whole(mesh: MeshArrays) -> Whole:
    found = whole_of(mesh)
    assert found is not None
    return found


def fair(mesh: MeshArrays, matrix: Floats) -> Fairing:
    both, options = whole(mesh), FairOptions()
    return both.half_of(outcome(both.mesh, matrix, options, solve(both.mesh, matrix, options)))


@pytest.mark.parametrize("axes", [(0,), (1,), (0, 1)])
def test_the_sphere_comes_back_up_to_the_planes(axes: tuple[int, ...]) -> None:
    mesh, free = part_of_sphere(*axes)
    shear = np.array([[1.0, 0.0, 0.0, 2.0], [0.5, 2.0, 0.0, 1.0], [0.0, 0.0, 0.5, 0.0], [0.0, 0.0, 0.0, 1.0]])
    done = fair(mesh, np.eye(4))
    np.testing.assert_array_equal(done.vertices, np.flatnonzero(free))
    np.testing.assert_allclose(np.linalg.norm(done.positions, axis=1), 1.0, atol=1e-5)
    for axis in axes:
        on_plane = mesh.positions[done.vertices, axis] == 0.0
        assert on_plane.any()
        np.testing.assert_array_equal(done.positions[on_plane, axis], 0.0)
    assert (done.verdict.grade, done.free_count) == ("GOOD", int(free.sum()))
    assert done.join.vertices.max() < len(mesh.positions)
    assert len(done.result.vertices) == len(np.unique(mesh.corner_vertices[mesh.in_patch[mesh.corner_faces]]))
    assert (fair(mesh, shear).positions[:, list(axes)] <= 0.0).all()


def test_the_images_are_those_of_blender() -> None:
    """Faces the other way round, no vertex, edge or face twice, each corner's edge between it and the next."""
    mesh, _ = part_of_sphere(0)
    both = whole(mesh).mesh
    assert len(both.positions) == 2 * len(mesh.positions) - (SIZE + 1)
    assert len(both.edges) == 2 * len(mesh.edges) - SIZE
    assert len(np.unique(np.sort(both.edges, axis=1), axis=0)) == len(both.edges)
    loops = both.corner_vertices.reshape(-1, 4)
    following = np.roll(loops, -1, axis=1).ravel()
    sides = np.sort(np.column_stack([loops.ravel(), following]), axis=1)
    np.testing.assert_array_equal(np.sort(both.edges[both.corner_edges], axis=1), sides)
    a, b, c = (both.positions[both.triangles[:, k]] for k in range(3))
    assert (np.cross(b - a, c - a)[:, 2] > 0.0).mean() > 0.9  # crumpled, but all wound alike
    directed = {(int(p), int(q)) for p, q in zip(loops.ravel(), following, strict=True)}
    assert len(directed) == loops.size
    np.testing.assert_array_equal(np.bincount(both.corner_edges).max(), 2)


def test_what_is_asked_of_vertices_edges_and_faces_goes_along() -> None:
    mesh, _ = part_of_sphere(0)
    marks = np.random.default_rng(3)
    edge, face, vertex = (marks.random(k) < 0.3 for k in (len(mesh.edges), len(mesh.in_patch), len(mesh.positions)))
    normals = marks.normal(size=(len(mesh.corner_vertices), 3))
    both = whole(
        replace(mesh, pinned=vertex, sharp=edge, hidden=face, parts=vertex.astype(float), corner_normals=normals)
    ).mesh
    middle = both.positions[both.edges].mean(axis=1)
    marked = middle[both.sharp]
    for flipped in marked * (-1.0, 1.0, 1.0):
        assert np.abs(marked - flipped).sum(axis=1).min() < 1e-12
    assert both.sharp.sum() == 2 * edge.sum() - (edge & (mesh.positions[mesh.edges, 0] == 0.0).all(axis=1)).sum()
    assert both.hidden.sum() == 2 * face.sum()
    assert both.pinned.sum() == both.parts.sum() == 2 * vertex.sum() - (vertex & (mesh.positions[:, 0] == 0.0)).sum()
    at = both.positions[both.corner_vertices]
    image = len(normals) + np.flatnonzero(np.abs(at[len(normals) :] - at[0] * (-1.0, 1.0, 1.0)).max(axis=1) < 1e-12)
    assert any(np.array_equal(both.corner_normals[k], normals[0] * (-1.0, 1.0, 1.0)) for k in image)


def test_only_a_patch_cut_by_the_plane_is_made_whole() -> None:
    mesh, _ = part_of_sphere(0)
    assert whole_of(replace(mesh, reflections=())) is None
    assert whole_of(replace(mesh, reflections=(across(1),))) is None  # where the mesh has no end
    centres = mesh.positions[mesh.corner_vertices].reshape(-1, 4, 3).mean(axis=1)
    assert whole_of(replace(mesh, in_patch=mesh.in_patch & (centres[:, 0] < -0.15))) is None
    moved = mesh.positions - np.array([2e-3, 0.0, 0.0])
    assert whole_of(replace(mesh, positions=moved)) is None  # further from its image than the modifier merges
    assert whole_of(replace(mesh, positions=moved, reflections=(across(0, 5e-3),))) is not None


def test_spots_and_faces_are_those_of_the_half() -> None:
    """A pin that holds a spike makes kinks; what is shown of the image would be no vertex of the mesh."""
    mesh, free = part_of_sphere(0)
    points = mesh.positions.copy()
    top = int(np.flatnonzero(free & (mesh.positions[:, 0] < -0.2))[0])
    points[top] *= 3.0
    pinned = np.zeros(len(points), dtype=bool)
    pinned[top] = True
    done = fair(replace(mesh, positions=points, pinned=pinned), np.eye(4))
    count = len(mesh.positions)
    assert done.verdict.grade != "GOOD"
    assert len(done.verdict.spots)
    assert done.verdict.spots.max() < count
    assert len(np.unique(done.verdict.spots)) == len(done.verdict.spots)
    assert max([*done.before.folded, *done.after.folded, *done.after.needles], default=0) < len(mesh.in_patch)
