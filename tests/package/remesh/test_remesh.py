"""fairing.remesh: another mesh for the same fair surface, with the way back to the old one."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import creased
import fairing
import holes
import measures
import shapes
from holes import FloatArray


@pytest.fixture(scope="module")
def cap() -> shapes.Patch:
    return shapes.cap(1500, shapes.Style(jitter=0.8, seed=4), half_angle=70)


def remeshed(patch: shapes.Patch, spacing: float = 0.0) -> fairing.RemeshResult:
    start = shapes.start_from_nothing(patch)
    return fairing.remesh(start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.fixed_normals, spacing=spacing)


def rim_edge(patch: shapes.Patch) -> float:
    loop = fairing.boundary_loops(patch.triangles)[0]
    return float(np.linalg.norm(patch.vertices[loop] - patch.vertices[np.roll(loop, 1)], axis=1).mean())


@pytest.mark.parametrize("factor", [0.5, 1.0, 3.0])
def test_the_surface_stays_and_the_mesh_is_clean(cap: shapes.Patch, factor: float) -> None:
    wanted = factor * rim_edge(cap)
    result = remeshed(cap, wanted)
    assert (result.converged, result.cut) == (True, factor > 1.0)
    assert abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < 2e-5
    points = np.concatenate([cap.vertices, result.vertices])
    assert holes.angles(points, result.triangles).min() >= 25
    sides = measures.edges(result.triangles)
    new = (sides >= len(cap.vertices)).all(axis=1)
    lengths = np.linalg.norm(points[sides[new, 0]] - points[sides[new, 1]], axis=1) / wanted
    assert 1 / np.sqrt(2) < np.median(lengths) < np.sqrt(2)


def test_the_boundary_and_its_edges_stay(cap: shapes.Patch) -> None:
    result = remeshed(cap)
    before, after = (fairing.boundary_loops(faces) for faces in (cap.triangles, result.triangles))
    assert [loop.tolist() for loop in before] == [loop.tolist() for loop in after]
    used = np.unique(result.triangles)
    assert np.array_equal(used[used < len(cap.vertices)], np.sort(cap.fixed))


def test_origins_lie_where_the_old_patch_has_the_new_vertices(cap: shapes.Patch) -> None:
    """Any smooth field on the old mesh comes over by these weights: here the coordinates themselves."""
    result = fairing.remesh(
        cap.vertices, cap.triangles, fixed=cap.fixed, fixed_normals=cap.fixed_normals, spacing=0.5 * rim_edge(cap)
    )
    triangle, weights = result.origin
    assert weights.shape == (len(result.vertices), 3)
    assert weights.min() >= 0
    assert abs(weights.sum(axis=1) - 1).max() < 1e-12
    carried = (cap.vertices[cap.triangles[triangle]] * weights[:, :, None]).sum(axis=1)
    edge = rim_edge(cap)
    assert np.linalg.norm(carried - result.vertices, axis=1).max() < 0.3 * edge
    corners = np.concatenate([cap.vertices, carried])[result.triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert ((across * corners.mean(axis=1)).sum(axis=1) > 0).all()  # one to one: nothing turns over


def test_a_torn_patch_is_no_input() -> None:
    patch = shapes.cap(50)
    with pytest.raises(fairing.MeshError, match="NO_FREE_VERTICES"):
        fairing.remesh(patch.vertices, patch.triangles, fixed=np.arange(len(patch.vertices)))
    with pytest.raises(ValueError, match="spacing"):
        fairing.remesh(patch.vertices, patch.triangles, fixed=patch.fixed, spacing=-2.0)


def test_inner_fixed_curves_stay() -> None:
    vertices, triangles = whole_sphere()
    belt = np.arange(24)
    normals = vertices[belt] / np.linalg.norm(vertices[belt], axis=1)[:, None]
    result = fairing.remesh(vertices, triangles, fixed=belt, fixed_normals=normals, spacing=0.2)
    assert result.converged
    assert abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < 5e-4
    assert not fairing.boundary_loops(result.triangles)
    sides = {tuple(side) for side in measures.edges(result.triangles)}
    assert all(tuple(sorted((i, (i + 1) % 24))) in sides for i in belt)


def whole_sphere() -> tuple[FloatArray, holes.IntArray]:
    """A bowl with its filling: vertices 0 … 23 are the equator."""
    vertices, triangles = holes.bowl(24)
    filled = fairing.fill(vertices, triangles)
    return np.concatenate([vertices, filled.vertices]), np.concatenate([triangles, filled.triangles])


def across(patch: shapes.Patch) -> holes.IntArray:
    """Edges (k, 2) on a shortest path from boundary to boundary through the top."""
    neighbours: dict[int, set[int]] = {}
    for a, b in measures.edges(patch.triangles).tolist():
        neighbours.setdefault(a, set()).add(b)
        neighbours.setdefault(b, set()).add(a)
    top = int(np.argmax(patch.vertices[:, 2]))
    before = {top: top}
    reached = [top]
    for vertex in reached:
        for other in sorted(neighbours[vertex] - before.keys()):
            before[other] = vertex
            reached.append(other)
    rim = patch.fixed[np.argsort(patch.vertices[patch.fixed, 0])]
    edges = []
    for end in (int(rim[0]), int(rim[-1])):
        while end != top:
            edges.append((end, before[end]))
            end = before[end]
    return np.array(edges, dtype=np.int32)


@pytest.mark.parametrize("factor", [0.6, 2.0])
def test_kept_edges_are_in_the_new_mesh_and_nothing_runs_across(cap: shapes.Patch, factor: float) -> None:
    lines = across(cap)
    result = fairing.remesh(
        cap.vertices, cap.triangles, fixed=cap.fixed, fixed_normals=cap.fixed_normals,
        kept=lines, spacing=factor * rim_edge(cap),
    )  # fmt: skip
    assert result.converged
    assert abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < 2e-5  # they move with the surface
    number = {v: v for v in cap.fixed.tolist()}
    number |= {int(v): len(cap.vertices) + k for k, v in enumerate(result.old) if v >= 0}
    assert set(number) - set(cap.fixed.tolist()) == set(lines.ravel().tolist()) - set(cap.fixed.tolist())
    sides = {tuple(side) for side in measures.edges(result.triangles).tolist()}
    kept = {tuple(sorted((number[a], number[b]))) for a, b in lines.tolist()}
    assert kept <= sides
    # Old and new triangles fall into two parts alike.
    walls = {tuple(sorted(line)) for line in lines.tolist()}
    new_part, old_part = parts(result.triangles, kept), parts(cap.triangles, walls)
    where = {v: k for k, v in enumerate(np.flatnonzero(result.old < 0) + len(cap.vertices))}
    origin = result.origin[0][result.old < 0]
    pairs = {
        (new_part[t], old_part[origin[where[v]]])
        for t, corners in enumerate(result.triangles.tolist())
        for v in corners
        if v in where
    }
    assert len(pairs) == 2


def parts(triangles: holes.IntArray, walls: set[tuple[int, int]]) -> list[int]:
    """The part of each triangle, parts being joined across edges that are no walls."""
    at: dict[tuple[int, int], list[int]] = {}
    for t, corners in enumerate(triangles.tolist()):
        for k in range(3):
            at.setdefault(tuple(sorted((corners[k], corners[(k + 1) % 3]))), []).append(t)
    label = list(range(len(triangles)))

    def root(t: int) -> int:
        while label[t] != t:
            t = label[t]
        return t

    for side, both in at.items():
        if side not in walls and len(both) == 2:
            label[root(both[0])] = root(both[1])
    return [root(t) for t in range(len(triangles))]


def test_kept_edges_must_be_edges(cap: shapes.Patch) -> None:
    with pytest.raises(ValueError, match="not joined by an edge"):
        fairing.remesh(
            cap.vertices, cap.triangles, fixed=cap.fixed, kept=[[int(cap.fixed[0]), int(cap.fixed[-1] // 2)]]
        )


# New meshes for patches of few large faces, none of whose vertices is free.
SQUARE = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])


HEXAGON = np.array([[np.cos(t), np.sin(t), 0.0] for t in np.pi / 3 * np.arange(6)])


@pytest.mark.parametrize(
    ("points", "triangles"),
    [
        (SQUARE[:3], [[0, 1, 2]]),
        (SQUARE, [[0, 1, 2], [0, 2, 3]]),
        (HEXAGON, [[0, 1, 2], [0, 2, 4], [2, 3, 4], [4, 5, 0]]),
        (HEXAGON, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]),
    ],
)
@pytest.mark.parametrize("spacing", [0.0, 0.1])
def test_a_patch_without_free_vertices_gets_some(points: FloatArray, triangles: Any, spacing: float) -> None:
    """A plane stays a plane; the boundary's edges stay; places on the old triangles are where the vertices are."""
    up = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    fixed = np.arange(len(points))
    before = points.copy()
    result = fairing.remesh(points, triangles, fixed=fixed, fixed_normals=up, spacing=spacing)
    np.testing.assert_array_equal(points, before)
    assert result.converged
    assert len(result.vertices) > (0 if spacing == 0.0 else 10)
    assert abs(result.vertices[:, 2]).max() < 1e-9
    both = np.concatenate([points, result.vertices])
    corners = both[result.triangles]
    areas = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2]
    old = points[np.array(triangles)]
    whole = np.cross(old[:, 1] - old[:, 0], old[:, 2] - old[:, 0])[:, 2].sum()
    assert (areas > 0.0).all()
    assert areas.sum() == pytest.approx(whole)
    boundary = {tuple(sorted(pair)) for pair in zip(fixed.tolist(), np.roll(fixed, -1).tolist(), strict=True)}
    assert boundary <= set(map(tuple, measures.edges(result.triangles).tolist()))
    rows, weights = result.origin
    assert set(rows.tolist()) <= set(range(len(triangles)))
    np.testing.assert_allclose(weights.sum(axis=1), 1.0)
    there = (old[rows] * weights[:, :, None]).sum(axis=1)
    assert np.linalg.norm(there - result.vertices, axis=1).max() < 0.5  # fair on the way from there


def test_a_kept_edge_inside_stays_one() -> None:
    up = np.tile([0.0, 0.0, 1.0], (4, 1))
    given = {"fixed": np.arange(4), "fixed_normals": up, "spacing": 0.4}
    result = fairing.remesh(SQUARE, [[0, 1, 2], [0, 2, 3]], kept=[[0, 2]], **given)
    assert (0, 2) in set(map(tuple, measures.edges(result.triangles).tolist()))
    without = fairing.remesh(SQUARE, [[0, 1, 2], [0, 2, 3]], **given)
    assert (0, 2) not in set(map(tuple, measures.edges(without.triangles).tolist()))


# A new mesh for a patch through which hard edges run: they are held, and each side finds its slope.
def meshed(part: creased.Dented, factor: float) -> fairing.RemeshResult:
    return fairing.remesh(
        part.vertices, part.patch, fixed=part.fixed, fixed_normals=part.normals, creases=part.curve,
        spacing=factor * part.edge, equation="automatic",
    )  # fmt: skip


@pytest.mark.parametrize("factor", [0.6, 1.0, 2.0])
@pytest.mark.parametrize(("n", "seed"), [(8, 1), (14, 2), (22, 3)])
@pytest.mark.parametrize(
    ("make", "bound"),
    [
        (creased.dented_edge, 1e-9),
        (creased.dented_corner, 1e-9),
        (creased.dented_rim, 1e-4),
        (creased.dented_sheet, 1e-3),
    ],
)
def test_edges_are_held(
    make: Callable[[int, int], creased.Dented], bound: float, n: int, seed: int, factor: float
) -> None:
    """The sides come back, whether the mesh is solved or, where it is coarser, cut from the solved one."""
    part = make(n, seed)
    result = meshed(part, factor)
    assert result.converged
    assert part.error(result.vertices) < bound
    sides = {tuple(side) for side in measures.edges(result.triangles).tolist()}
    assert {tuple(sorted(pair)) for pair in part.edges.tolist()} <= sides
