"""Loops for fairing.fill: which way they run, whose normals are whose, and what no surface fills or joins."""

from itertools import product
from typing import Any

import numpy as np
import pytest

import fairing
import holes
from holes import FloatArray, IntArray

EMPTY = np.empty((0, 3), dtype=int)


def ring(count: int, radius: float = 1.0, centre: Any = (0.0, 0.0, 0.0)) -> tuple[FloatArray, FloatArray]:
    """Counter-clockwise around z; the directions away from the middle."""
    turn = 2 * np.pi * np.arange(count) / count
    away = np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    return np.asarray(centre) + radius * away, away


def up(count: int) -> FloatArray:
    return np.tile([0.0, 0.0, 1.0], (count, 1))


def s_bend() -> tuple[FloatArray, FloatArray, list[IntArray]]:
    """Two bare circles, the lower one of radius .5, with the normals of the tubes that end there."""
    (lower, below), (upper, above) = ring(32, 0.5), ring(32, 0.3, (0.9, 0.0, 1.0))
    return np.concatenate([lower, upper]), np.concatenate([below, above]), [np.arange(32), np.arange(32, 64)]


@pytest.mark.parametrize("turned", list(product([False, True], repeat=2)))
@pytest.mark.parametrize("inside", [False, True])
def test_bare_circles_are_joined_whichever_way_they_run(turned: tuple[bool, bool], inside: bool) -> None:
    vertices, normals, loops = s_bend()
    given = [loop[::-1] if turn else loop for loop, turn in zip(loops, turned, strict=True)]
    result = fairing.fill(vertices, EMPTY, given, normals=-normals if inside else normals, bridge=True)
    assert (result.converged, result.equation) == (True, "least_variation")
    assert result.boundary_angle.max() < 3.0  # 0.6 and 1.3 on two meshes of the engine's; turned ones have 90
    first, second = (np.ptp(loop) and loop[1] - loop[0] for loop in result.loops)
    assert first * second < 0  # the surface lies on the left of both


def test_rows_are_those_of_the_vertices_where_they_may_be_of_the_loops() -> None:
    vertices, normals, (first, second) = s_bend()
    loops = [first, second[::-1]]
    of_vertices = fairing.fill(vertices, EMPTY, loops, normals=normals, bridge=True)
    by_loop = fairing.fill(vertices, EMPTY, loops, normals=[normals[loop] for loop in loops], bridge=True)
    np.testing.assert_array_equal(of_vertices.vertices, by_loop.vertices)
    shifted = normals[(np.arange(64) + 8) % 32 + 32 * (np.arange(64) // 32)]
    with pytest.raises(ValueError, match="normals: 64 of 64 point along the boundary"):
        fairing.fill(vertices, EMPTY, loops, normals=shifted, bridge=True)


@pytest.mark.parametrize("saddle", [0.0, 0.2])
def test_a_bare_loop_is_filled_inside_whichever_way_it_runs(saddle: float) -> None:
    points, away = ring(48)
    points[:, 2] = saddle * (away[:, 0] ** 2 - away[:, 1] ** 2)
    for loop in (np.arange(48), np.arange(48)[::-1]):
        result = fairing.fill(points, EMPTY, [loop], normals=up(48))
        corners = np.concatenate([points, result.vertices])[result.triangles]
        assert result.converged
        assert np.hypot(*result.vertices[:, :2].T).max() < 1
        assert np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2].min() > 0


def wavy(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    return u, v, 0.1 * np.sin(9 * u) * np.cos(9 * v)


def test_the_outside_of_a_sheet_is_left_open_and_named() -> None:
    vertices, triangles = holes.sheet(wavy, (30, 30), holes.disc)
    inner, outer = sorted(fairing.boundary_loops(triangles), key=len)
    result = fairing.fill(vertices, triangles)
    alone = fairing.fill(vertices, triangles, [inner])
    np.testing.assert_allclose(result.vertices, alone.vertices, atol=1e-5)  # fits along both borders, or along one
    (left,), (warning,) = result.left_open, result.warnings
    assert {*left} == {*warning.elements} == {*outer}
    assert (warning.code, warning.figures["loops"]) == ("NOT_A_HOLE", 1.0)
    short = fairing.fill(vertices, triangles, longest=len(inner))
    for other in (alone, short):
        assert (other.converged, other.left_open, other.warnings) == (True, (), ())


def test_a_mesh_without_holes_is_refused_at_once() -> None:
    vertices, triangles = holes.sheet(wavy, (30, 30), lambda u, v: np.zeros(u.shape, dtype=bool))
    reported: list[str] = []
    with pytest.raises(fairing.MeshError, match="around the outside of a sheet") as caught:
        fairing.fill(vertices, triangles, progress=lambda _, stage: reported.append(stage))
    assert caught.value.code == "NOT_A_HOLE"
    assert {*caught.value.elements} == {*fairing.boundary_loops(triangles)[0]}
    assert not reported


def refused(code: str, elements: set[int], turned: bool, vertices: FloatArray, loops: Any, normals: FloatArray) -> str:
    """The message of a bridge without a mesh around, all arrays as they were."""
    before = vertices.copy(), normals.copy()
    with pytest.raises(fairing.MeshError) as caught:
        fairing.fill(vertices, EMPTY, loops, normals=normals, bridge=True)
    assert (caught.value.code, "turned" in caught.value.diagnostic.figures) == (code, turned)
    assert {*caught.value.elements} == elements
    np.testing.assert_array_equal(vertices, before[0])
    np.testing.assert_array_equal(normals, before[1])
    return str(caught.value)


def test_the_loop_that_is_turned_is_named() -> None:
    vertices, normals, loops = s_bend()
    for k in (0, 1):
        other = normals.copy()
        other[loops[k]] *= -1
        text = refused("LOOPS_NOT_JOINED", {*loops[k]}, True, vertices, loops, other)
        assert f"loop {k}" in text
        assert "turn its normals" in text
    rims = np.concatenate([ring(48)[0], ring(24, 0.8)[0]])
    lip = np.concatenate([ring(48)[1], -ring(24)[1]])
    both = [np.arange(48), np.arange(48, 72)]
    assert fairing.fill(rims, EMPTY, [both[0], both[1][::-1]], normals=lip, bridge=True).converged
    text = refused("LOOPS_NOT_JOINED", {*range(48)}, True, rims, both, lip)
    assert "lead away from the others" in text


def test_a_tube_whose_faces_are_turned_over_is_named() -> None:
    vertices, triangles = holes.sheet(
        lambda u, v: (np.cos(2 * np.pi * u), np.sin(2 * np.pi * u), 3 * v - 1.5), (24, 12), holes.band, closed=True
    )
    upper = vertices[triangles].mean(axis=1)[:, 2] > 0
    triangles[upper] = triangles[upper][:, ::-1]
    loops = sorted(fairing.boundary_loops(triangles), key=lambda loop: abs(vertices[loop, 2].mean()))[:2]
    turned = max(loops, key=lambda loop: vertices[loop, 2].mean())
    with pytest.raises(fairing.MeshError, match="flip the triangles around it") as caught:
        fairing.fill(vertices, triangles, loops, bridge=True)
    assert caught.value.code == "LOOPS_NOT_JOINED"
    assert {*caught.value.elements} == {*turned}


def test_edges_that_cross_are_refused_with_their_ends() -> None:
    """A figure eight without a vertex in its middle, and two circles that cut each other, where they are joined."""
    turn = 2 * np.pi * (np.arange(48) + 0.5) / 48
    eight = np.column_stack([np.sin(turn), np.sin(2 * turn), 0 * turn])
    refused("NONMANIFOLD_VERTEX", {0, 23, 24, 47}, False, eight, [np.arange(48)], up(48))
    eight[20:28, 2] = 0.1  # one way above the other one
    fairing.fill(eight, EMPTY, [np.arange(48)], normals=up(48))
    both = np.concatenate([ring(24)[0], ring(24, 1.0, (1.3, 0.0, 0.0))[0]])
    loops = [np.arange(24), np.arange(24, 48)]
    refused("NONMANIFOLD_VERTEX", {3, 4, 20, 21, 32, 33, 39, 40}, False, both, loops, up(48))
    assert fairing.fill(both, EMPTY, loops, normals=up(48)).converged
