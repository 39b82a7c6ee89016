"""fairing.fill: holes in exact surfaces come back, whatever the spacing; clean meshes; clear errors."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import fairing
import holes
from holes import FloatArray, IntArray, catenoid, cylinder_side, saddle, torus, tube
from measures import euler_number, with_new

EMPTY = np.empty((0, 3), dtype=int)


def apex(result: fairing.FillResult) -> float:
    """Height of the highest new vertex over the origin."""
    return float(np.linalg.norm(result.vertices[result.vertices[:, 2].argmax()]))


@pytest.mark.parametrize(("edges", "bound"), [(12, 5e-2), (24, 5e-3), (48, 6e-4), (96, 2e-4), (192, 5e-5)])
def test_a_hemisphere_comes_back(edges: int, bound: float) -> None:
    result = fairing.fill(*holes.bowl(edges))
    assert result.converged
    assert abs(apex(result) - 1) < bound
    assert abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < bound
    assert abs(result.mean_curvature + 1).max() < 60 * bound


Place = Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]]


def radius(points: FloatArray) -> FloatArray:
    return np.hypot(points[:, 0], points[:, 1])


def off_torus(points: FloatArray) -> FloatArray:
    return np.hypot(radius(points) - 2, points[:, 2]) - 0.7


# The harmonic surface over the torus' hole is another one; a ten-thousandth of its diameter away.
@pytest.mark.parametrize(
    ("place", "distance", "equation", "bound"),
    [
        (cylinder_side, lambda p: radius(p) - 1, "harmonic", 1e-5),
        (saddle, lambda p: radius(p) - np.cosh(p[:, 2]), "harmonic", 2e-5),
        (torus, off_torus, "harmonic", 6e-4),
        (torus, off_torus, "least_variation", 1e-4),
    ],
)
def test_holes_in_other_surfaces(
    place: Place, distance: Callable[[FloatArray], FloatArray], equation: str, bound: float
) -> None:
    vertices, triangles = holes.sheet(place, (60, 60), holes.disc)
    loop = min(fairing.boundary_loops(triangles), key=len)
    result = fairing.fill(vertices, triangles, [loop], equation=equation)
    diameter = 2 * np.linalg.norm(vertices[loop] - vertices[loop].mean(axis=0), axis=1).max()
    assert result.converged
    assert abs(distance(result.vertices)).max() < bound * diameter
    assert result.boundary_angle.max() < 0.1


@pytest.mark.parametrize(
    ("place", "distance"), [(tube, lambda p: radius(p) - 1), (catenoid, lambda p: radius(p) - np.cosh(p[:, 2]))]
)
def test_two_boundaries_become_a_tube(place: Place, distance: Callable[[FloatArray], FloatArray]) -> None:
    vertices, triangles = holes.sheet(place, (60, 30), holes.band, closed=True)
    loops = sorted(fairing.boundary_loops(triangles), key=lambda loop: abs(vertices[loop, 2].mean()))[:2]
    result = fairing.fill(vertices, triangles, loops, bridge=True)
    diameter = 2 * np.linalg.norm(vertices[result.fixed] - vertices[result.fixed].mean(axis=0), axis=1).max()
    assert result.converged
    assert abs(distance(result.vertices)).max() < 2e-4 * diameter
    _, joined = with_new(vertices, triangles, result)
    assert len(fairing.boundary_loops(joined)) == len(fairing.boundary_loops(triangles)) - 2
    assert np.array_equal(fairing.fill(vertices, triangles, loops[::-1], bridge=True).vertices, result.vertices)


def three_tubes() -> tuple[FloatArray, IntArray]:
    """Open tubes towards three sides of the plane, outward normals."""
    part, faces = holes.sheet(
        lambda u, v: (1.6 + v, 0.5 * np.cos(2 * np.pi * u), 0.5 * np.sin(2 * np.pi * u)), (24, 8),
        lambda u, v: np.zeros(len(u), dtype=bool), closed=True,
    )  # fmt: skip
    turned = []
    for k in range(3):
        c, s = np.cos(2 * np.pi * k / 3), np.sin(2 * np.pi * k / 3)
        turned.append(part @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1.0]]))
    return np.concatenate(turned), np.concatenate([faces[:, ::-1] + k * len(part) for k in range(3)])


def test_three_boundaries_become_a_blend() -> None:
    vertices, triangles = three_tubes()
    loops = [loop for loop in fairing.boundary_loops(triangles) if np.linalg.norm(vertices[loop[0]]) < 2]
    result = fairing.fill(vertices, triangles, loops, bridge=True)
    assert result.converged
    assert not [warning.code for warning in result.warnings]
    _, faces = with_new(vertices, triangles, result)
    assert len(fairing.boundary_loops(faces)) == 3
    assert euler_number(faces) == -1  # a sphere with three holes
    # The surface has the threefold symmetry and the mirror plane of its boundaries; its mesh does not.
    top = result.vertices[np.argsort(np.linalg.norm(result.vertices[:, :2], axis=1))[:12]]
    assert np.ptp(np.abs(top[:, 2])) < 0.05
    assert {*np.sign(top[:, 2])} == {-1.0, 1.0}


def test_a_hole_around_a_limb_does_not_close_it() -> None:
    """All of a cylinder but a strip along it. The triangulation of least area cuts across: no harmonic surface grew."""

    def cylinder(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        return np.cos(2 * np.pi * u), np.sin(2 * np.pi * u), 4 * v

    def hole(u: FloatArray, v: FloatArray) -> NDArray[np.bool_]:
        return np.abs(v - 0.5) < 0.42 * np.sqrt(np.clip(np.sin(np.pi * u) - 0.25, 0, 1))

    vertices, triangles = holes.sheet(cylinder, (64, 64), hole, closed=True)
    loops = [loop for loop in fairing.boundary_loops(triangles) if np.ptp(vertices[loop, 2]) > 0.1]
    result = fairing.fill(vertices, triangles, loops)
    assert len(loops) == 1
    assert (result.converged, result.equation) == (True, "harmonic")
    assert np.abs(np.hypot(result.vertices[:, 0], result.vertices[:, 1]) - 1).max() < 1e-4


@pytest.mark.parametrize("edges", [3, 4, 5])
def test_the_smallest_holes(edges: int) -> None:
    vertices, triangles = holes.bowl(edges, 40)
    result = fairing.fill(vertices, triangles)
    assert (len(result.vertices), len(result.triangles)) == ((0, edges - 2) if edges < 5 else (1, 5))
    refused("NO_BOUNDARY", set(), *with_new(vertices, triangles, result))


def refused(code: str, elements: set[int], *arguments: Any, **options: Any) -> None:
    with pytest.raises(fairing.MeshError) as caught:
        fairing.fill(*arguments, **options)
    assert caught.value.code == code
    assert {*caught.value.elements} == elements


def test_bad_loops_are_refused_with_their_vertices() -> None:
    vertices, triangles = holes.bowl(24)
    rim = fairing.boundary_loops(triangles)[0]
    refused("NOT_A_LOOP", {*(rim + 24)}, vertices, triangles, [rim + 24])  # an inner ring
    refused("NOT_A_LOOP", {rim[0], rim[9]}, vertices, triangles, [rim[:10]])  # not closed
    refused("NOT_A_LOOP", {*rim[:2]}, vertices, triangles, [rim[:2]])
    refused("NOT_A_LOOP", {*rim}, vertices, triangles, [rim, rim])
    refused("INDEX_RANGE", {999}, vertices, triangles, [[0, 1, 999]])
    turn = np.exp(2j * np.pi * np.arange(12) / 12)
    free = np.column_stack([turn.real, turn.imag, 0 * turn.real])
    eight = np.array([0, 1, 2, 3, 4, 5, 0, 7, 8, 9])
    refused("NONMANIFOLD_VERTEX", {0}, free, EMPTY, [eight], normals=np.tile([0, 0, 1.0], (12, 1)))
    refused("ZERO_NORMAL", {*range(12)}, free, EMPTY, [np.arange(12)])
    doubled = free.copy()
    doubled[4] = doubled[5]
    refused("NOT_A_LOOP", {4}, doubled, EMPTY, [np.arange(12)], normals=np.tile([0, 0, 1.0], (12, 1)))
    broken = free.copy()
    broken[3] = np.nan
    refused("NONFINITE", {3}, broken, EMPTY, [np.arange(12)], normals=np.tile([0, 0, 1.0], (12, 1)))


def test_boundaries_that_pass_a_place_twice_are_refused() -> None:
    """A figure eight, and the two sides of a tear, by position alone. Loops that are filled apart may share places."""
    turn = 2 * np.pi * np.arange(24) / 24
    up = np.tile([0, 0, 1.0], (48, 1))
    eight = np.column_stack([np.cos(turn), np.sin(turn) * np.cos(turn), 0 * turn])
    eight[[6, 18]] = 0
    refused("NONMANIFOLD_VERTEX", {6, 18}, eight, EMPTY, [np.arange(24)], normals=up[:24])
    there = np.column_stack([np.linspace(0, 1, 8), np.zeros((8, 2))])
    tear = np.concatenate([there, there[-2:0:-1]])
    refused("NONMANIFOLD_VERTEX", {*range(1, 7), *range(8, 14)}, tear, EMPTY, [np.arange(14)], normals=up[:14])
    circle = np.column_stack([np.cos(turn), np.sin(turn), 0 * turn])
    both = (np.array([[[1, 0, 0]], [[-1, 0, 0]]]) + circle).reshape(-1, 3)
    both[24] = both[12]
    loops = [np.arange(24), np.arange(24, 48)]
    refused("NONMANIFOLD_VERTEX", {12, 24}, both, EMPTY, loops, normals=up, bridge=True)
    assert fairing.fill(both, EMPTY, loops, normals=up).converged


def test_bad_normals_are_refused_with_their_vertices() -> None:
    vertices, triangles = holes.bowl(24)
    exact = vertices / np.linalg.norm(vertices, axis=1)[:, None]
    refused("NORMALS_OPPOSE_WINDING", {*range(24)}, vertices, triangles, normals=-exact)
    few = exact.copy()
    few[[2, 5, 9]] *= -3
    refused("NORMALS_OPPOSE_WINDING", {2, 5, 9}, vertices, triangles, normals=few)
    some = exact.copy()
    some[[3, 7]] = 0
    refused("ZERO_NORMAL", {3, 7}, vertices, triangles, normals=some)
    with pytest.raises(ValueError, match="normals: 145 rows"):
        fairing.fill(vertices, triangles, normals=exact[:5])


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"spacing": -1.0}, "spacing: a length"),
        ({"spacing": 1e-7}, "new vertices, the limit is 4e\\+06: raise `spacing`"),
        ({"spacing": np.nan}, "spacing: a finite number"),
        ({"bridge": 2}, "bridge: True or False"),
        ({"longest": -1}, "longest: -1"),
        ({"loops": "rim"}, "loops: a list"),
        ({"loops": []}, "loops: a list"),
        ({"fixed": [0]}, "fixed: not accepted here"),
        ({"equation": "maximal"}, "equation: 'maximal'"),
    ],
)
def test_options_are_checked(options: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        fairing.fill(*holes.bowl(12), **options)


def test_a_knotted_loop_says_that_its_surface_crosses_itself() -> None:
    turn = 2 * np.pi * np.arange(96) / 96
    knot = np.column_stack(
        [np.sin(turn) + 2 * np.sin(2 * turn), np.cos(turn) - 2 * np.cos(2 * turn), -np.sin(3 * turn)]
    )
    normals = np.cross(np.roll(knot, -1, axis=0) - np.roll(knot, 1, axis=0), [0, 0, 1.0])
    result = fairing.fill(knot, EMPTY, [np.arange(96)], normals=normals)
    assert "SELF_INTERSECTION" in [warning.code for warning in result.warnings]
