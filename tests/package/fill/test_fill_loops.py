"""Loops: which way they run, which normals and curvatures they have, and what is said of those that are none."""

from functools import lru_cache
from itertools import pairwise, product
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import curves
import fairing
import holes
from holes import FloatArray, IntArray, Mesh

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
    first, second = (np.median(np.diff(loop)) for loop in result.loops)
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


# fairing.fill with continuity="G2": surfaces over holes that continue the curvature around them.
# H is a cubic function of the arc length: Δ_B² H = 0 but Δ_B H ≠ 0.
CUBIC = curves.OdeCurve(-1.6, 1.6, (0.0, 0.0, 0.0), lambda s, _: 0.4 + 0.5 * s + 0.6 * s**2 - 2.0 * s**3)


def cubic(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    profile = CUBIC.frame(2.4 * u - 1.2)
    return profile.x, profile.y, 2.4 * v - 1.2


def off_cubic(points: FloatArray) -> FloatArray:
    profile = CUBIC.frame(CUBIC.nearest(points[:, 0], points[:, 1]))
    return np.hypot(profile.x - points[:, 0], profile.y - points[:, 1])


def curvature_of_cubic(points: FloatArray) -> FloatArray:
    """Of the sheet that `holed` makes, whose normals point away from the profile's left."""
    return -0.5 * CUBIC.frame(CUBIC.nearest(points[:, 0], points[:, 1])).curvature


def torus(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    around, across = 2.8 * u - 1.4, 2.4 * v - 1.2
    return (2 + np.cos(across)) * np.cos(around), (2 + np.cos(across)) * np.sin(around), np.sin(across)


def off_torus(points: FloatArray) -> FloatArray:
    return np.abs(np.hypot(np.hypot(points[:, 0], points[:, 1]) - 2, points[:, 2]) - 1)


SURFACES = {"cubic": (cubic, off_cubic), "torus": (torus, off_torus)}


@lru_cache
def holed(name: str, cells: int) -> tuple[FloatArray, IntArray, IntArray]:
    vertices, triangles = holes.sheet(SURFACES[name][0], (cells, cells), holes.disc)
    return vertices, triangles, min(fairing.boundary_loops(triangles), key=len)


def filled(name: str, cells: int, **options: Any) -> fairing.FillResult:
    vertices, triangles, loop = holed(name, cells)
    return fairing.fill(vertices, triangles, [loop], **options)


def error(name: str, cells: int, result: fairing.FillResult) -> float:
    """The largest distance from the surface over D."""
    vertices, _, loop = holed(name, cells)
    size = 2 * np.linalg.norm(vertices[loop] - vertices[loop].mean(axis=0), axis=1).max()
    return float(SURFACES[name][1](result.vertices).max() / size)


@pytest.mark.parametrize(("name", "bounds"), [("cubic", (1.5e-3, 1e-4)), ("torus", (3e-4, 8e-5))])
def test_the_curvature_around_is_continued(name: str, bounds: tuple[float, float]) -> None:
    """It is fitted to the faces around. Tangent joins stay 4e-3 and 5e-4 off, however fine the mesh is."""
    for cells, bound in zip((40, 80), bounds, strict=True):
        tangent, curved = (filled(name, cells, continuity=continuity) for continuity in ("G1", "G2"))
        assert (tangent.continuity, curved.continuity) == ("G1", "G2")
        assert (curved.converged, curved.warnings) == (True, ())
        assert error(name, cells, curved) < bound < error(name, cells, tangent)
    assert error(name, 80, curved) < 0.15 * error(name, 80, tangent)


def test_curvatures_are_given_in_the_order_of_the_loops_or_of_the_vertices() -> None:
    vertices, triangles, loop = holed("cubic", 40)
    exact = curvature_of_cubic(vertices)
    fits = fairing.surrounding_normals(vertices, triangles, loop).curvatures
    assert np.corrcoef(fits, exact[loop])[0, 1] > 0.9  # of the same sign
    given = [filled("cubic", 40, continuity="G2", fixed_curvatures=values) for values in (exact, [exact[loop]])]
    turned = fairing.fill(vertices, triangles, [loop[::-1]], continuity="G2", fixed_curvatures=exact[loop[::-1]])
    for result in (*given, turned):
        assert error("cubic", 40, result) < 3e-4
    wrong = filled("cubic", 40, continuity="G2", fixed_curvatures=exact[loop[::-1]])
    assert error("cubic", 40, wrong) > 1e-3


def test_a_rough_boundary_keeps_the_tangent_join_and_says_so() -> None:
    vertices, triangles, loop = holed("torus", 40)
    rough = vertices + np.random.default_rng(0).normal(0.0, 2e-3, vertices.shape)
    tangent = fairing.fill(rough, triangles, [loop])
    curved = fairing.fill(rough, triangles, [loop], continuity="G2")
    assert curved.continuity == "G1"
    (warning,) = curved.warnings
    assert (warning.code, "smooth_share" in warning.figures) == ("G2_NOT_MET", True)
    np.testing.assert_array_equal(np.sort(warning.elements), np.sort(loop))
    np.testing.assert_array_equal(curved.vertices, tangent.vertices)


# What fairing.fill says where a boundary is odd: what, where, and what helps.
def t_junctions(bend: float, extra: int) -> tuple[FloatArray, Any, list[int]]:
    """Two rows of faces; where they part, one has vertices on the other one's edge 5-6. And these vertices."""
    turn, places = np.radians(bend), [0.0, 1.0, 2.0, 3.0]
    middle = [(0.0, 1.0 + (k + 1) / (extra + 1), 0.0) for k in range(extra)]
    vertices = [(-1.0, y, 0.0) for y in places] + [(0.0, y, 0.0) for y in places] + middle
    vertices += [(np.cos(turn), y, -np.sin(turn)) for y in places]
    last = 8 + extra
    faces = [face for k in range(3) for face in ((k, 4 + k, 5 + k), (k, 5 + k, k + 1))]
    faces += [face for k in (0, 2) for face in ((4 + k, last + k, last + k + 1), (4 + k, last + k + 1, 5 + k))]
    chain = [5, *range(8, 8 + extra), 6]
    faces += [(a, last + 1, b) for a, b in pairwise(chain)] + [(6, last + 1, last + 2)]
    return np.array(vertices), np.array(faces), list(range(8, 8 + extra))


def single(points: FloatArray) -> FloatArray:
    """What single precision leaves of coordinates some hundred edges away from the origin."""
    return (points + 100.0).astype(np.float32).astype(np.float64)


@pytest.mark.parametrize("bend", [0.0, 90.0])
@pytest.mark.parametrize("extra", [1, 2, 3])
@pytest.mark.parametrize("placed", [np.array, single])
def test_a_t_junction_is_named_with_its_edge(bend: float, extra: int, placed: Any) -> None:
    vertices, triangles, lying = t_junctions(bend, extra)
    loop = min(fairing.boundary_loops(triangles), key=len)
    with pytest.raises(fairing.MeshError, match=r"of a boundary (lies|lie) on its edge 5-6: dissolve") as caught:
        fairing.fill(placed(vertices), triangles, [loop])
    assert caught.value.code == "NONMANIFOLD_VERTEX"
    assert caught.value.elements.tolist() == [5, 6, *lying]
    assert caught.value.diagnostic.figures["on_edge" if extra == 1 else "on_edges"] == extra


def rings(deepest: float, folded: int) -> tuple[FloatArray, Any, Any]:
    """A flat ring around a hole, the faces at its first vertices folded back; and the rim."""
    turn, back = 2.0 * np.pi * np.arange(32) / 32, np.arange(32) < folded
    deep = np.radians(deepest)
    radius, height = np.where(back, 1.0 - 0.2 * np.cos(deep), 0.8), np.where(back, 0.2 * np.sin(deep), 0.0)
    flat = [np.column_stack([r * np.cos(turn), r * np.sin(turn), 0.0 * turn]) for r in (2.0, 1.75, 1.5, 1.25, 1.0)]
    points = np.concatenate([*flat, np.column_stack([radius * np.cos(turn), radius * np.sin(turn), height])])
    k, i = (index.ravel() for index in np.mgrid[:5, :32])
    a, b = 32 * k + i, 32 * k + (i + 1) % 32
    return (
        points,
        np.concatenate([np.column_stack([a, b, b + 32]), np.column_stack([a, b + 32, a + 32])]),
        range(160, 192),
    )


def test_a_rim_that_folds_back_is_named() -> None:
    points, triangles, rim = rings(170.0, 2)
    result = fairing.fill(points, triangles, [np.array(rim)])
    assert result.join.max() > 90.0
    (warning,) = [warning for warning in result.warnings if warning.code == "NOT_TANGENT"]
    assert "folded_back" in warning.figures
    assert {*warning.elements} <= {191, 160, 161, 162}
    assert warning.figures["degrees"] == pytest.approx(result.join.max())
    plain = fairing.fill(*rings(0.0, 0)[:2], [np.array(rim)])
    assert plain.warnings == ()


def shell(thickness: float, half_angle: float) -> Mesh:
    """Both walls of a hollow ball without the same cap."""
    outer, faces = holes.bowl(24, half_angle)
    return np.concatenate([outer, (1.0 - thickness) * outer]), np.concatenate([faces, faces[:, ::-1] + len(outer)])


def test_a_hole_through_both_walls_is_bridged() -> None:
    """However it lies; in one of four turns rounding leads to a loft, which is said."""
    vertices, triangles = shell(0.3, 30.0)
    solved = 0
    for seed in range(12):
        turn = Rotation.random(random_state=seed).as_matrix()
        result = fairing.fill(vertices @ turn.T, triangles, fairing.boundary_loops(triangles), bridge=True)
        assert result.converged
        height = np.linalg.norm(result.vertices, axis=1)
        assert height.min() > 0.65 and height.max() < 1.05
        is_said = "NO_SOLUTION" in {warning.code for warning in result.warnings}
        assert is_said or (result.equation == "harmonic" and result.boundary_angle.max() < 10.0)
        solved += not is_said
    assert solved >= 6


@pytest.mark.parametrize("thickness", [0.05, 0.02])
def test_a_wall_thinner_than_the_edges_of_its_rim_is_joined_or_named(thickness: float) -> None:
    """Half a torus closes it, as high as half of the wall is thick; what is far from that has a warning."""
    vertices, triangles = shell(thickness, 30.0)
    result = fairing.fill(vertices, triangles, fairing.boundary_loops(triangles), bridge=True)
    warned = {warning.code for warning in result.warnings} & {"NOT_TANGENT", "NO_SOLUTION"}
    polar = np.arccos(result.vertices[:, 2] / np.linalg.norm(result.vertices, axis=1))
    height = np.sin(np.radians(30.0) - polar.min()) / (0.5 * thickness)
    assert warned or (result.boundary_angle.max() <= fairing.looks.LIMITS["off_slope"] and abs(height - 1.0) < 0.15)
    assert warned or thickness > 0.02  # the thicker one is joined on some machines, by rounding
