"""The add-on's path from a mesh to new positions: normals along the boundary, the answer, and halves with a mirror."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from addon.arrays.around import outside_triangles
from addon.arrays.region import MeshArrays, Patch, Reflection, make_patch
from addon.arrays.types import Floats, Mask
from addon.fair import engine
from addon.fair.boundary import average_normals, boundary
from addon.fair.memory import MOST, Memory
from addon.fair.solve import Kept, pose, solve
from addon.mirror.reflected import Whole, whole_of
from addon.options.options import FairOptions
from addon.verdict.outcome import Fairing, outcome
from addon.verdict.verdict import AS_SELECTED, LOOK

import fairing
from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh

EYE = np.eye(4)


def spoilt_sphere(size: int = 16) -> MeshArrays:
    """A side of a cubic sphere, its selected middle pushed in and shaken."""
    mesh = grid(size, 0.6, on_sphere)
    points = mesh.positions.copy()
    inside, _ = pose(mesh, EYE, FairOptions())
    free = inside.patch.vertices[inside.patch.free]
    points[free] = 0.8 * points[free] + 0.05 * np.random.default_rng(5).normal(size=(len(free), 3))
    return replace(mesh, positions=points)


def fair(mesh: MeshArrays, matrix: Floats = EYE, **options: object) -> Fairing:
    chosen = FairOptions(**options)
    return outcome(mesh, matrix, chosen, solve(mesh, matrix, chosen))


def test_the_factor_blends_between_the_mesh_and_the_answer() -> None:
    mesh = spoilt_sphere()
    whole, half, nothing = (fair(mesh, factor=factor) for factor in (1.0, 0.5, 0.0))
    start = mesh.positions[whole.vertices]
    assert nothing.positions.tobytes() == start.tobytes()
    np.testing.assert_allclose(half.positions, 0.5 * (start + whole.positions), atol=1e-15)


def counting_kept(ahead: bool = False) -> Kept:
    return Kept(Memory(MOST), ahead)


def test_the_engine_is_asked_for_all_of_the_detail_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every share of it follows from that answer; none of it is another one."""
    mesh, kept = spoilt_sphere(), counting_kept()
    whole = solve(mesh, EYE, FairOptions(detail=1.0), kept=kept).result
    assert np.abs(whole.vertices - whole.base).max() > 0.01
    with monkeypatch.context() as nothing_solves:
        nothing_solves.setattr(fairing, "fair", lambda *_args, **_options: pytest.fail("solved again"))
        nothing_solves.setattr(engine, "RepeatedSolve", lambda *_args: pytest.fail("solved again"))
        part = solve(mesh, EYE, FairOptions(detail=0.25), kept=kept).result
    np.testing.assert_allclose(part.vertices, whole.base + 0.25 * (whole.vertices - whole.base), atol=1e-15)
    longer = FairOptions(detail=1.0, bulge=0.2)
    again, anew = solve(mesh, EYE, longer, kept=kept).result, solve(mesh, EYE, longer).result
    np.testing.assert_allclose(again.vertices, anew.vertices, atol=1e-5)
    assert np.abs(again.vertices - whole.vertices).max() > 0.01


def test_a_patch_that_may_cross_is_looked_at_and_a_clear_one_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh = spoilt_sphere()
    solved = solve(mesh, EYE, FairOptions())
    asked: list[bool] = []
    look = fairing.looks.judged

    def judged(*mesh: Any, is_clear: bool, **others: Any) -> fairing.looks.Judged:
        asked.append(is_clear)
        return look(*mesh, is_clear=is_clear, **others)

    monkeypatch.setattr(fairing.looks, "judged", judged)
    outcome(mesh, EYE, FairOptions(), solved)
    outcome(mesh, EYE, FairOptions(factor=0.5), solved)  # nobody knows of what lies half-way
    assert asked == [True, False]


def cube_corner(size: int = 13, radius: float = 0.5) -> MeshArrays:
    """The three sides of a cube [−1, 1]³ that meet in (1, 1, 1), size² quads each; those near the corner selected."""
    points = grid_points(size) + np.array([0.0, 0.0, 1.0])
    sides = np.concatenate([np.roll(points, axis, axis=1) for axis in range(3)])
    positions, numbers = np.unique(sides.round(9), axis=0, return_inverse=True)
    quads = np.concatenate([np.array(grid_quads(size)) + axis * len(points) for axis in range(3)])
    faces = numbers.reshape(-1)[quads]
    near = np.linalg.norm(positions[faces].mean(axis=1) - 1.0, axis=1) < radius
    return polygon_mesh(positions, faces.tolist(), near)


@pytest.mark.parametrize("smooth", [False, True])
def test_a_hard_edge_outside_stays_and_one_that_is_rounded_inside_is_reported(smooth: bool) -> None:
    mesh = cube_corner()
    answered = fair(mesh, smooth_boundary=smooth)
    assert answered.verdict.grade == LOOK
    assert answered.verdict.reason.startswith("A hard edge from outside")
    assert AS_SELECTED not in answered.verdict.remedies


def test_measuring_can_be_cancelled() -> None:
    """It takes as long as the solution, and a process that ends waits for it."""
    mesh = spoilt_sphere()
    solved = solve(mesh, EYE, FairOptions())
    with pytest.raises(fairing.Cancelled):
        outcome(mesh, EYE, FairOptions(), solved, lambda _, stage: stage != "measurement")


# Normals along the outline: known ones on planes and spheres, from each source.
def normals_of(mesh: MeshArrays, patch: Patch, source: str) -> tuple[Floats, tuple[str, ...]]:
    found = boundary(mesh, patch, source, outside_triangles(mesh, patch))
    return found.normals, found.notes


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
    assert reported == ("16 border vertices have no faces outside: their slope is the selection's",)
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
        "14 boundary vertices lie on hard edges: the surface keeps the slope inside there (Tangent To)",
    )
    assert np.array_equal(known.inward(patch), patch.vertices[patch.fixed[sides]])
    outer, reported = normals_of(mesh, patch, "SURROUNDING")
    assert reported == ()
    assert np.abs(outer[sides, 0]).min() > 0.8
    flat = boundary(table(16, 0.0), patch, "INSIDE", outside_triangles(mesh, patch))
    assert flat.from_inside.all()
    assert flat.notes == ("The boundary is a hard edge all along: the surface keeps the slope inside (Tangent To)",)


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


# Half a mesh with a Mirror modifier: the whole is faired, the half moves.
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


def fair_reflected(mesh: MeshArrays, matrix: Floats) -> Fairing:
    both, options = whole(mesh), FairOptions()
    return both.half_of(outcome(both.mesh, matrix, options, solve(both.mesh, matrix, options)))


@pytest.mark.parametrize("axes", [(0,), (1,), (0, 1)])
def test_the_sphere_comes_back_up_to_the_planes(axes: tuple[int, ...]) -> None:
    mesh, free = part_of_sphere(*axes)
    shear = np.array([[1.0, 0.0, 0.0, 2.0], [0.5, 2.0, 0.0, 1.0], [0.0, 0.0, 0.5, 0.0], [0.0, 0.0, 0.0, 1.0]])
    done = fair_reflected(mesh, np.eye(4))
    np.testing.assert_array_equal(done.vertices, np.flatnonzero(free))
    np.testing.assert_allclose(np.linalg.norm(done.positions, axis=1), 1.0, atol=1e-5)
    for axis in axes:
        on_plane = mesh.positions[done.vertices, axis] == 0.0
        assert on_plane.any()
        np.testing.assert_array_equal(done.positions[on_plane, axis], 0.0)
    assert (done.verdict.grade, done.free_count) == ("GOOD", int(free.sum()))
    assert done.join.vertices.max() < len(mesh.positions)
    assert len(done.result.vertices) == len(np.unique(mesh.corner_vertices[mesh.in_patch[mesh.corner_faces]]))
    assert (fair_reflected(mesh, shear).positions[:, list(axes)] <= 0.0).all()


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
    done = fair_reflected(replace(mesh, positions=points, pinned=pinned), np.eye(4))
    count = len(mesh.positions)
    assert done.verdict.grade != "GOOD"
    assert len(done.verdict.spots)
    assert done.verdict.spots.max() < count
    assert len(np.unique(done.verdict.spots)) == len(done.verdict.spots)
    assert max([*done.before.folded, *done.after.folded], default=0) < len(mesh.in_patch)


def test_other_options_start_from_the_solver_that_was_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh, kept = spoilt_sphere(), counting_kept(ahead=True)
    solve(mesh, EYE, FairOptions(), kept=kept)
    monkeypatch.setattr(fairing, "fair", lambda *_args, **_options: pytest.fail("a call without its solver"))
    monkeypatch.setattr(engine, "RepeatedSolve", lambda *_args: pytest.fail("another solver"))
    other = FairOptions(inner_fairness="INVERSE_DISTANCE")
    again = outcome(mesh, EYE, other, solve(mesh, EYE, other, kept=kept))
    np.testing.assert_allclose(np.linalg.norm(again.positions, axis=1), 1.0, atol=1e-6)
    moved = replace(mesh, positions=1.5 * mesh.positions)
    with pytest.raises(pytest.fail.Exception, match="another solver"):
        solve(moved, EYE, FairOptions(), kept=kept)
