"""Which border loops fairing.fill takes for holes, and what is out of proportion."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import fairing
import holes
import measures
import shapes
from holes import FloatArray, Mesh
from meshing import face_normals

Place = Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray, FloatArray]]


def bent(degrees: float) -> Place:
    """A square bent along one direction."""
    whole = np.radians(degrees)

    def place(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        turn = (u - 0.5) * whole
        return np.sin(turn) / whole, v, np.cos(turn) / whole

    return place


def saddle(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    return u, v, 0.5 * (u - 0.5) * (v - 0.5)


def dish(half_angle: float) -> Mesh:
    """The cap of a ball."""
    return holes.bowl(48, 180.0 - half_angle)


def tube(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    return np.cos(2 * np.pi * u), np.sin(2 * np.pi * u), 3 * v


def spool(u: FloatArray, v: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A tube whose ends flare out into flat rings."""
    radius = 1.0 + np.interp(v, [0.0, 0.25, 0.75, 1.0], [1.0, 0.0, 0.0, 1.0])
    height = np.interp(v, [0.0, 0.25, 0.75, 1.0], [0.0, 0.0, 2.0, 2.0])
    return radius * np.cos(2 * np.pi * u), radius * np.sin(2 * np.pi * u), height


def whole(u: FloatArray, v: FloatArray) -> Any:
    return np.zeros(u.shape, dtype=bool)


def torn(u: FloatArray, v: FloatArray) -> Any:
    """A ragged end, a slit and a hole."""
    ragged = v > 0.85 + 0.08 * np.sin(23.0 * u) + 0.05 * np.cos(41.0 * u)
    return ragged | ((abs(u - 0.5) < 0.02) & (v > 0.5)) | ((u - 0.2) ** 2 + (v - 0.4) ** 2 < 0.01)


def twelve(u: FloatArray, v: FloatArray) -> Any:
    """Twelve holes in a sheet."""
    return ((u * 4) % 1 - 0.5) ** 2 + ((v * 3) % 1 - 0.5) ** 2 < 0.05


def sorted_out(mesh: Mesh) -> tuple[int, int]:
    """How many holes and how many outer borders."""
    outer = fairing.borders.outer_borders(*mesh)
    return int((~outer).sum()), int(outer.sum())


SHAPES: dict[str, tuple[Mesh, int, int]] = {
    "flat sheet": (holes.sheet(lambda u, v: (u, v, 0 * u), (12, 12), whole), 0, 1),
    "flat sheet with twelve holes": (holes.sheet(lambda u, v: (u, v, 0 * u), (60, 60), twelve), 12, 1),
    "saddle": (holes.sheet(saddle, (16, 16), whole), 0, 1),
    "tube": (holes.sheet(tube, (24, 12), whole, closed=True), 2, 0),
    "torn tube": (holes.sheet(tube, (48, 36), torn, closed=True), 3, 0),
    "spool": (holes.sheet(spool, (36, 24), whole, closed=True), 0, 2),
    "dish of 20°": (dish(20.0), 0, 1),
    "dish of 30°": (dish(30.0), 1, 0),
    "half a ball": (dish(90.0), 1, 0),
    "ball with a hole": (dish(160.0), 1, 0),
    **{
        f"sheet bent by {degrees}°": (holes.sheet(bent(degrees), (16, 16), whole), 0, 1)
        for degrees in (10, 30, 90, 180, 270)
    },
    **{
        f"sheet bent by {degrees}°, with a hole": (holes.sheet(bent(degrees), (24, 24), holes.disc), 1, 1)
        for degrees in (10, 180)
    },
}


@pytest.mark.parametrize("name", SHAPES)
def test_holes_and_outer_borders(name: str) -> None:
    mesh, inner, outer = SHAPES[name]
    assert sorted_out(mesh) == (inner, outer)


def test_loops_may_run_either_way_and_are_taken_alone() -> None:
    (vertices, triangles), _, _ = SHAPES["sheet bent by 180°, with a hole"]
    hole, border = sorted(fairing.boundary_loops(triangles), key=len)
    for loops in ([border, hole], [border[::-1], hole[::-1]]):
        assert fairing.borders.outer_borders(vertices, triangles, loops).tolist() == [True, False]
    assert fairing.borders.outer_borders(vertices, triangles, [hole]).tolist() == [False]
    assert fairing.borders.outer_borders(*closed()).tolist() == []


def closed() -> Mesh:
    vertices, triangles = holes.bowl(24)
    found = fairing.fill(vertices, triangles)
    return np.concatenate([vertices, found.vertices]), np.concatenate([triangles, found.triangles])


@pytest.mark.parametrize("half_angle", [30.0, 60.0, 90.0, 120.0, 145.0])
def test_what_a_fill_takes_is_known_before(half_angle: float) -> None:
    mesh = holes.bowl(48, half_angle)
    expected = fairing.borders.expected_vertices(*mesh)
    assert expected == pytest.approx(len(fairing.fill(*mesh).vertices), rel=0.25)
    finer = fairing.borders.expected_vertices(
        *mesh, spacing=0.5 * 2.0 * np.sin(np.radians(half_angle)) * np.sin(np.pi / 48)
    )
    assert finer == pytest.approx(4.0 * expected, rel=0.02)


def refused(call: Callable[[], Any]) -> fairing.MeshError:
    with pytest.raises(fairing.MeshError) as caught:
        call()
    assert caught.value.code == "OUT_OF_PROPORTION"
    return caught.value


def test_more_than_was_allowed_is_refused_before_it_is_made() -> None:
    vertices, triangles = holes.bowl(48)
    reported: list[str] = []
    error = refused(lambda: fairing.fill(vertices, triangles, max_vertices=300))
    assert {*error.elements} == {*range(48)}
    assert error.diagnostic.figures["limit"] == 300
    assert error.diagnostic.figures["count"] == pytest.approx(424, rel=0.1)
    options: dict[str, Any] = {"spacing": 0.04, "progress": lambda _, stage: reported.append(stage)}
    refused(lambda: fairing.fill(vertices, triangles, max_vertices=3000, **options))
    assert "mesh" not in reported  # the second look, at the first small surface
    refused(lambda: fairing.fill(vertices, triangles, **{**options, "spacing": 1e-4}))
    assert len(fairing.fill(vertices, triangles, max_vertices=500).vertices) == pytest.approx(424, rel=0.1)


@pytest.mark.parametrize("times", [0.5, 1.0, 2.0, 8.0])
@pytest.mark.parametrize("make", [shapes.cap, shapes.cylinder])
def test_the_size_of_a_new_mesh_is_known_before(make: Callable[[int], shapes.Patch], times: float) -> None:
    """Of coarse ones, half of whose triangles touch the boundary, as well."""
    patch = make(300)
    loop = fairing.boundary_loops(patch.triangles)[0]
    edges = np.linalg.norm(patch.vertices[np.roll(loop, -1)] - patch.vertices[loop], axis=1)
    given: dict[str, Any] = {
        "fixed": patch.fixed,
        "fixed_normals": patch.fixed_normals,
        "spacing": times * edges.mean(),
    }
    error = refused(lambda: fairing.remesh(patch.vertices, patch.triangles, max_vertices=1, **given))
    found = len(fairing.remesh(patch.vertices, patch.triangles, **given).vertices)
    assert error.diagnostic.figures["count"] == pytest.approx(found, rel=0.15)


def with_vertex(mesh: Mesh, share: float) -> Mesh:
    """A bowl with one vertex more on its first edge, so far along it."""
    vertices, triangles = mesh
    new = vertices[5] + share * (vertices[6] - vertices[5])
    (row,) = np.flatnonzero(np.isin(triangles, [5, 6]).sum(axis=1) == 2)
    first = int(np.flatnonzero(~np.isin(triangles[row], [5, 6]))[0])
    apex, a, b = np.roll(triangles[row], -first)
    split = [[apex, a, len(vertices)], [apex, len(vertices), b]]
    points = np.concatenate([vertices, [new / np.linalg.norm(new)]])
    return points, np.concatenate([np.delete(triangles, row, axis=0), split])


@pytest.mark.parametrize("share", [1e-3, 1e-5])
def test_one_tiny_edge_does_not_set_the_mesh_of_the_whole_hole(share: float) -> None:
    """It took 1.5 s at a thousandth, 8 s and more below, instead of .1 s."""
    found = fairing.fill(*with_vertex(holes.bowl(48), share))
    plain = fairing.fill(*holes.bowl(48))
    assert found.converged
    assert abs(np.linalg.norm(found.vertices, axis=1) - 1.0).max() < 1e-4
    assert len(found.vertices) == pytest.approx(len(plain.vertices), rel=0.1)
    assert len(holes.bowl(48)[0]) in found.triangles  # the vertex at the tiny edge has its place in the new mesh


def test_a_sheet_that_is_bent_a_little_asks_for_too_large_a_ball() -> None:
    """Named, it was sought for 10 s, in vain."""
    vertices, triangles = holes.sheet(bent(10.0), (12, 12), whole)
    (border,) = fairing.boundary_loops(triangles)
    error = refused(lambda: fairing.fill(vertices, triangles, [border]))
    assert {*error.elements} == {*border}


def test_a_flat_sheet_is_not_closed_by_its_own_back() -> None:
    """Over its border lies no surface but the other side of a pillow without height, named or not."""
    vertices, triangles = holes.sheet(lambda u, v: (u, v, 0 * u), (12, 12), whole)
    (border,) = fairing.boundary_loops(triangles)
    with pytest.raises(fairing.MeshError, match="flat sheet: no surface closes it") as caught:
        fairing.fill(vertices, triangles, [border])
    assert caught.value.code == "NOT_A_HOLE"
    assert {*caught.value.elements} == {*border}


# `spacing` and `inner` of fairing.fill and fairing.remesh: new edges as the outline's nearby, or all of one length.
EMPTY = np.empty((0, 3), dtype=int)


def uneven_circle() -> FloatArray:
    """Radius 1, edges four times as long on the left (x < 0) as on the right, growing in between."""
    turn = np.linspace(0.0, 2 * np.pi, 4000, endpoint=False)
    density = 4.0 ** (0.5 * (1.0 + np.tanh(6.0 * np.cos(turn))))
    share = np.cumsum(density) / density.sum()
    chosen = np.interp(np.arange(64) / 64, share, turn)
    return np.column_stack([np.cos(chosen), np.sin(chosen), 0 * chosen])


CIRCLE = uneven_circle()


MEAN = float(np.linalg.norm(CIRCLE - np.roll(CIRCLE, 1, axis=0), axis=1).mean())


def disc(**options: Any) -> fairing.FillResult:
    """A flat surface over the circle."""
    return fairing.fill(CIRCLE, EMPTY, [np.arange(64)], normals=np.tile([0.0, 0.0, 1.0], (64, 1)), **options)


def lengths(result: fairing.FillResult | fairing.RemeshResult, old: FloatArray) -> tuple[FloatArray, FloatArray]:
    """(e, 3) middles and (e,) lengths of new edges away from the circle."""
    points = np.concatenate([old, result.vertices])
    ends = points[measures.edges(result.triangles)]
    middles = ends.mean(axis=1)
    inside = np.linalg.norm(middles, axis=1) < 0.75
    return middles[inside], np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)[inside]


def ratio(result: fairing.FillResult | fairing.RemeshResult, old: FloatArray = CIRCLE) -> float:
    """Of edges on the left to those on the right."""
    middles, found = lengths(result, old)
    return float(np.median(found[middles[:, 0] < -0.3]) / np.median(found[middles[:, 0] > 0.3]))


def typical(result: fairing.FillResult) -> float:
    return float(np.median(lengths(result, CIRCLE)[1]))


@pytest.mark.parametrize("factor", [0.5, 1.0, 2.0])
def test_edges_follow_the_boundaries_or_have_one_length(factor: float) -> None:
    even = disc(spacing=factor * MEAN, inner="even")
    assert ratio(even) == pytest.approx(1.0, abs=0.15)
    assert 0.7 < typical(even) / (factor * MEAN) < 1.4
    graded = disc(spacing=factor * MEAN, inner="outline")
    assert ratio(graded) > 1.5
    assert 0.6 < typical(graded) / (factor * MEAN) < 1.6


SQUARE = np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0]])


@pytest.mark.parametrize("spacing", [0.4, 0.2, 0.1])
@pytest.mark.parametrize("dome", [False, True])
def test_the_wanted_length_holds_inside_a_boundary_of_four_edges(spacing: float, dome: bool) -> None:
    """Its edges stay, and new ones grow towards them; angles stay above 18°."""
    slope = SQUARE / np.sqrt(6.0) + [0.0, 0.0, np.sqrt(2.0 / 3.0)]
    normals = slope if dome else np.tile([0.0, 0.0, 1.0], (4, 1))
    result = fairing.fill(SQUARE, EMPTY, [np.arange(4)], normals=normals, spacing=spacing)
    assert result.converged
    points = np.concatenate([SQUARE, result.vertices])
    edges = measures.edges(result.triangles)
    ends = points[edges]
    inner = np.abs(ends.mean(axis=1)[:, :2]).max(axis=1) < 0.5
    lengths = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1)
    assert 0.7 < np.median(lengths[inner]) / spacing < 1.7
    corner = lengths[(edges < 4).any(axis=1)]
    assert corner.max() < 2.01
    assert corner.min() > spacing
    assert holes.angles(points, result.triangles).min() > 18.0


@pytest.mark.parametrize("equation", ["soap_film", "harmonic"])
@pytest.mark.parametrize("width", [0.001, 0.01, 0.05])
@pytest.mark.parametrize("aside", [0.0, 0.3])
def test_a_slit_of_four_edges_is_filled(width: float, aside: float, equation: str) -> None:
    """Its only diagonal cuts off sharp corners at both ends: a vertex has to come in all the same."""
    slit = np.array([[0.0, 0, 0], [0.5 - aside, -width, 0], [1, 0, 0], [0.5 + aside, 0.5 * width, 0]])
    result = fairing.fill(
        slit, np.empty((0, 3), int), [[0, 1, 2, 3]], normals=[[0, 0, 1]] * 4, spacing=0.3, equation=equation
    )  # fmt: skip
    assert result.converged
    assert np.abs(result.vertices[:, 2]).max() < 1e-9
    area = face_normals(np.concatenate([slit, result.vertices]), result.triangles)[:, 2].sum() / 2
    assert area == pytest.approx(0.75 * width)


def test_a_collapse_may_leave_an_edge_between_vertices_of_the_boundary() -> None:
    """An edge that the first mesh did not have."""
    x, y = [784, 193, -155, -177, -596, -322, -915], [123, 423, 434, 361, 712, 285, -215]
    loop = np.column_stack([x, y, [-578, 355, 443, 149, 642, 340, 405]]) / 1000
    k, after = np.arange(7), (np.arange(7) + 1) % 7
    around = np.concatenate([np.column_stack([k, k + 7, after]), np.column_stack([after, k + 7, after + 7])])
    assert fairing.fill(np.concatenate([loop, 2 * loop - [0, 0, 0.3]]), around, [k]).converged
