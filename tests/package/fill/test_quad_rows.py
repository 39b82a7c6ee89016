"""Quads in rows: the patterns are sound for every boundary, closed forms come back, rows go on through."""

from collections import Counter
from typing import Any

import numpy as np
import pytest

import fairing
import holes
import shapes
from grids import corners, halves, numbered
from holes import FloatArray, IntArray

TURN = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]


def faces_of(result: Any) -> list[list[int]]:
    faces: list[list[int]] = result.quads.quads.tolist() + result.quads.triangles.tolist()
    return faces


def check_disc(faces: list[list[int]], loop: list[int]) -> Counter[int]:
    """A disc whose border is the loop, in its direction; returns how many faces each vertex has."""
    sides = Counter((a, b) for face in faces for a, b in zip(face, face[1:] + face[:1], strict=True))
    assert max(sides.values()) == 1
    assert all(len(set(face)) == len(face) for face in faces)
    border = {(a, b) for a, b in sides if (b, a) not in sides}
    assert border == set(zip(loop, loop[1:] + loop[:1], strict=True))
    around = Counter(vertex for face in faces for vertex in face)
    edges = (len(sides) + len(border)) // 2
    assert len(around) - edges + len(faces) == 1
    return around


def grid(place: Any, columns: int, rows: int, hole: set[tuple[int, int]], closed: bool = False) -> tuple[Any, ...]:
    """A grid of quads without some cells: all vertices, triangles, and the loop around the hole."""
    width = columns if closed else columns + 1
    number = lambda i, j: (i % width) * (rows + 1) + j  # noqa: E731
    quads = {
        (i, j): [number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)]
        for i in range(columns)
        for j in range(rows)
    }
    i, j = (index.ravel() for index in np.mgrid[:width, : rows + 1])
    inside = [quads[cell] for cell in sorted(hole)]
    outside = np.array([quad for cell, quad in quads.items() if cell not in hole])
    sides = {(a, b) for quad in inside for a, b in zip(quad, quad[1:] + quad[:1], strict=True)}
    step = {a: b for a, b in sides if (b, a) not in sides}
    loop = [min(step)]
    while step[loop[-1]] != loop[0]:
        loop.append(step[loop[-1]])
    return place(i, j), np.concatenate([outside[:, [0, 1, 2]], outside[:, [0, 2, 3]]]), loop, inside


@pytest.mark.parametrize("shape", ["rectangle", "ell"])
def test_a_hole_of_a_plane_grid_comes_back(shape: str) -> None:
    """The same vertices, wherever the plane lies."""
    hole = {(x, y) for x in range(3, 10) for y in range(4, 9)}
    if shape == "ell":
        hole -= {(x, y) for x in range(6, 10) for y in range(6, 9)}
    flat = lambda i, j: np.column_stack([i, 1.3 * j, 0 * i]) @ TURN * 0.01 + 4  # noqa: E731
    points, around, loop, inside = grid(flat, 13, 13, hole)
    result = fairing.fill(points, around, [loop], faces="quads")
    assert not [warning.code for warning in result.warnings if warning.code == "NO_QUAD_ROWS"]
    faces = faces_of(result)
    assert len(faces) == len(inside)
    check_disc(faces, result.loops[0].tolist())
    gone = np.setdiff1d(inside, around)
    away = np.linalg.norm(result.vertices[:, None] - points[gone], axis=2)
    assert len(result.vertices) == len(gone)
    assert away.min(axis=1).max() < 0.01 * 0.05


def test_rows_of_a_cylinder_go_on() -> None:
    """A loop that enters the hole leaves on the other side, where it would have been, and lies on the cylinder."""
    radians = 2 * np.pi / 40
    pipe = lambda i, j: np.column_stack([np.cos(radians * i), np.sin(radians * i), radians * j])  # noqa: E731
    hole = {(x, y) for x in range(5, 15) for y in range(6, 14)}
    points, around, loop, inside = grid(pipe, 40, 20, hole, closed=True)
    result = fairing.fill(points, around, [loop], faces="quads")
    gone = np.setdiff1d(inside, around)
    away = np.linalg.norm(result.vertices[:, None] - points[gone], axis=2)
    assert len(result.vertices) == len(gone)
    assert away.min(axis=1).max() < 0.1 * radians
    assert abs(np.linalg.norm(result.vertices[:, :2], axis=1) - 1).max() < 1e-3
    around_each = check_disc(faces_of(result), result.loops[0].tolist())
    assert {around_each[vertex] for vertex in around_each if vertex >= len(points)} == {4}


@pytest.mark.parametrize("edges", [12, 13, 24, 48, 96])
def test_half_a_sphere_is_closed(edges: int) -> None:
    """Four poles, one of which the triangle of an odd boundary stands for; the surface is that of the triangles."""
    vertices, triangles, *_ = holes.bowl(edges)
    result = fairing.fill(vertices, triangles, faces="quads")
    assert result.quads is not None
    points = np.concatenate([vertices, result.vertices])
    around = check_disc(faces_of(result), result.loops[0].tolist())
    poles = [count for vertex, count in around.items() if vertex >= len(vertices) and count != 4]
    assert len(result.quads.triangles) == edges % 2
    assert poles == [3] * (4 - edges % 2)
    angles = holes.angles(points, result.quads.quads)
    assert 70 < angles.min() <= angles.max() < 125
    assert abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < 0.15 / edges**2
    pairs = np.concatenate([result.quads.pairs.ravel(), result.quads.rest])
    assert sorted(pairs.tolist()) == list(range(len(result.triangles)))


def test_no_concave_quad_is_handed_out() -> None:
    """A star of sharp points has no pattern of convex quads: pairs of triangles stand in."""
    turn = 2 * np.pi * np.arange(100) / 100
    radius = np.where(np.arange(100) % 2, 1.0, 0.3)
    points = np.column_stack([radius * np.cos(turn), radius * np.sin(turn), 0 * turn])
    up = np.tile([0.0, 0.0, 1.0], (100, 1))
    result = fairing.fill(points, np.empty((0, 3), int), [np.arange(100)], normals=up, faces="quads")
    (warning,) = [each for each in result.warnings if each.code == "NO_QUAD_ROWS"]
    assert (warning.code, warning.figures) == ("NO_QUAD_ROWS", {"edges": 100.0, "shape": 1.0})
    assert warning.elements.tolist() == list(range(100))
    assert result.quads is not None
    angles = holes.angles(np.concatenate([points, result.vertices]), result.quads.quads)
    assert angles.sum(axis=1).min() > 330


def tubes(counts: list[int], gap: float) -> tuple[FloatArray, IntArray, list[IntArray]]:
    """Pieces of tubes of radius 1 in a row around the z-axis, with gaps; the loops that face each other."""
    points, faces, loops, begin, height = [], [], [], 0, 0.0
    for k, count in enumerate(counts):
        turn = 2 * np.pi * np.arange(count) / count + 0.1 * k
        for row in range(4):
            points.append(np.column_stack([np.cos(turn), np.sin(turn), np.full(count, height + 0.2 * row)]))
        faces.append(begin + halves(np.pad(numbered(4, count), [(0, 0), (0, 1)], "wrap"))[:, ::-1])
        loops += [begin + np.arange(count), begin + 3 * count + np.arange(count)]
        begin, height = begin + 4 * count, height + 0.6 + gap
    return np.concatenate(points), np.concatenate(faces), loops[1:-1]


@pytest.mark.parametrize(("counts", "poles"), [((24, 24), []), ((24, 20), [3, 5]), ((25, 24), [5]), ((8, 8), [])])
def test_rows_run_along_a_bridge(counts: tuple[int, int], poles: list[int]) -> None:
    """Between loops of one count none but regular vertices, else one pair of poles, on the cylinder itself."""
    points, around, loops = tubes(list(counts), 1.5)
    result = fairing.fill(points, around, loops, bridge=True, faces="quads")
    assert result.quads is not None
    faces = faces_of(result)
    sides = Counter((a, b) for face in faces for a, b in zip(face, face[1:] + face[:1], strict=True))
    assert max(sides.values()) == 1
    ends = [(loop.tolist(), np.roll(loop, -1).tolist()) for loop in result.loops]
    assert {(a, b) for a, b in sides if (b, a) not in sides} == {
        pair for a, b in ends for pair in zip(a, b, strict=True)
    }
    around_each = Counter(vertex for face in faces for vertex in face)
    new = {vertex: count for vertex, count in around_each.items() if vertex >= len(points)}
    assert sorted(count for count in new.values() if count != 4) == poles
    assert len(result.quads.triangles) == sum(counts) % 2
    angles = holes.angles(np.concatenate([points, result.vertices]), result.quads.quads)
    assert 50 < angles.min() <= angles.max() < 130
    assert abs(np.linalg.norm(result.vertices[:, :2], axis=1) - 1).max() < 0.1 / min(counts)


def test_what_stands_in_is_said() -> None:
    """More than two loops in one surface leave pairs of triangles."""
    turn = 2 * np.pi * np.arange(12) / 12
    rim = np.column_stack([np.full(12, 2.0), 0.6 * np.cos(turn), 0.6 * np.sin(turn)])
    thirds = 2 * np.pi * np.arange(3) / 3
    spun = [np.array([[np.cos(t), np.sin(t), 0], [-np.sin(t), np.cos(t), 0], [0, 0, 1]]) for t in thirds]
    points = np.concatenate([rim @ each for each in spun])
    normals = np.concatenate([(rim - [2.0, 0, 0]) @ each for each in spun])
    loops = np.arange(36).reshape(3, 12)
    result = fairing.fill(points, np.empty((0, 3), int), list(loops), normals=normals, bridge=True, faces="quads")
    (warning,) = [each for each in result.warnings if each.code == "NO_QUAD_ROWS"]
    assert "several" in warning.figures
    assert result.quads is not None
    assert len(result.quads.quads) > 2 * len(result.quads.triangles)


def test_a_patch_is_meshed_anew_in_rows() -> None:
    """A crumpled cap of a sphere: rows over the sphere, each new vertex with its place on the old patch."""
    cap = shapes.cap(1500, shapes.Style(jitter=0.8, seed=4), half_angle=70)
    boundary = fairing.Boundary(cap.fixed, cap.fixed_normals)
    start = shapes.start_from_nothing(cap)
    result = fairing.remesh(start, cap.triangles, boundary, faces="quads")
    assert result.quads is not None
    assert not [warning for warning in result.warnings if warning.code == "NO_QUAD_ROWS"]
    (loop,) = fairing.boundary_loops(cap.triangles)
    around = check_disc(faces_of(result), loop.tolist())
    poles = [count for vertex, count in around.items() if vertex >= len(cap.vertices) and count != 4]
    assert poles == [3] * (4 - len(result.quads.triangles))
    assert abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < 2e-4
    faired = fairing.fair(start, cap.triangles, boundary, fairing.Options.of(inner_fairness="conformal")).vertices
    origin = np.einsum("kc,kcd->kd", result.origin[1], faired[cap.triangles[result.origin[0]]])
    assert np.linalg.norm(origin - result.vertices, axis=1).max() < 5e-3
    assert (result.old == -1).all()


def test_pins_and_kept_edges_leave_no_rows() -> None:
    """They would be lost in a pattern: pairs of triangles stand in, and the edges stay."""
    cap = shapes.cap(600, shapes.Style(jitter=0.3, seed=4), half_angle=60)
    pin = int(np.setdiff1d(np.arange(len(cap.vertices)), cap.fixed)[100])
    pinned = fairing.Boundary(np.append(cap.fixed, pin), np.concatenate([cap.fixed_normals, cap.vertices[[pin]]]))
    result = fairing.remesh(cap.vertices, cap.triangles, pinned, faces="quads")
    assert "NO_QUAD_ROWS" in [warning.code for warning in result.warnings]
    assert pin in result.triangles
    edge = next(pair for pair in cap.triangles[:, :2] if not np.isin(pair, cap.fixed).any())
    boundary = fairing.Boundary(cap.fixed, cap.fixed_normals)
    result = fairing.remesh(cap.vertices, cap.triangles, boundary, kept=[edge], faces="quads")
    (warning,) = [each for each in result.warnings if each.code == "NO_QUAD_ROWS"]
    assert "curves" in warning.figures
    again = len(cap.vertices) + np.flatnonzero(np.isin(result.old, edge))
    assert result.quads is not None
    sides = {frozenset(pair) for face in faces_of(result) for pair in zip(face, face[1:] + face[:1], strict=True)}
    assert frozenset(again.tolist()) in sides


# fairing.maps.paired_quads: nearly all faces are quads, none concave, each triangle once, and what is kept stays.


def dome(edges: int) -> tuple[FloatArray, IntArray]:
    """An even triangulation over a round hole, and vertices of the bowl that none of its triangles has."""
    vertices, triangles, *_ = holes.bowl(edges)
    result = fairing.fill(vertices, triangles)
    return np.concatenate([vertices, result.vertices]), result.triangles


def sides(faces: IntArray) -> set[tuple[int, int]]:
    return {(int(a), int(b)) for face in faces for a, b in zip(face, np.roll(face, -1), strict=True)}


@pytest.mark.parametrize("edges", [16, 32, 64, 128])
def test_nearly_all_faces_are_quads_and_each_triangle_counts_once(edges: int) -> None:
    points, triangles = dome(edges)
    paired = fairing.maps.paired_quads(points, triangles)
    assert len(paired.quads) >= 0.9 * (len(paired.quads) + len(paired.triangles))
    assert np.array_equal(np.sort(np.concatenate([paired.pairs.ravel(), paired.rest])), np.arange(len(triangles)))
    assert np.array_equal(paired.triangles, triangles[paired.rest])
    assert holes.angles(points, paired.quads).max() < 166 and holes.angles(points, paired.quads).sum(axis=1).min() > 330


def test_kept_edges_and_the_border_survive() -> None:
    points, triangles = dome(64)
    first = fairing.maps.paired_quads(points, triangles)
    kept = first.quads[::3, [1, 3]]  # would go, were they not kept
    second = fairing.maps.paired_quads(points, triangles, kept)
    left = sides(second.quads) | sides(second.triangles)
    assert all((a, b) in left or (b, a) in left for a, b in kept.tolist())
    whole = sides(triangles)
    border = {(a, b) for a, b in whole if (b, a) not in whole}
    assert border <= left
    assert len(second.quads) > 0.4 * len(triangles)


def test_a_grid_comes_back_whatever_its_diagonals() -> None:
    k = numbered(9, 9)
    cells = corners(k)
    turned = np.random.default_rng(1).random(len(cells)) < 0.5
    cells[turned] = np.roll(cells[turned], 1, axis=1)
    triangles = np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
    points = np.stack([k.ravel() // 9, k.ravel() % 9, np.zeros(81)], axis=1)
    paired = fairing.maps.paired_quads(points, triangles)
    assert {frozenset(quad) for quad in paired.quads.tolist()} == {frozenset(cell) for cell in cells.tolist()}
