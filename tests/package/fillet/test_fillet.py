"""fairing.fillet: seams are rounded by the fairest surface within a width along the surface."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.typing import NDArray

import fairing
import measures
import solids
import wedges
from fairing import _core
from grids import halves, numbered
from measures import areas, with_new
from wedges import FloatArray, IntArray

WIDTH = 0.3


def middle(result: fairing.results.FilletResult, reach: float = 0.7) -> FloatArray:
    """The new vertices beside the middle of a wedge's edge, where its ends are not felt."""
    return result.vertices[np.abs(result.vertices[:, 2]) < reach]


@pytest.mark.parametrize("rows", [1, 7])
@pytest.mark.parametrize("degrees", [30, 40, 60, 90, 120, 150])
def test_between_planes_it_is_the_arc_that_touches_both(degrees: float, rows: int) -> None:
    vertices, triangles, seam = wedges.wedge(degrees, rows=rows)
    result = fairing.fillet(vertices, triangles, seam, width=WIDTH)
    centre, radius = wedges.arc(degrees, WIDTH)
    assert (result.converged, result.warnings) == (True, ())
    off = np.linalg.norm(middle(result)[:, :2] - centre, axis=1) - radius
    assert len(off) > 100
    assert abs(off).max() < 1e-3 * WIDTH


def test_curvature_is_continued_where_that_is_asked_for() -> None:
    """The profile's curvature then is quadratic in the arc length, 0 at both ends; the arc is 8 % of the width off."""
    vertices, triangles, seam = wedges.wedge(120, rows=2, length=3.0)
    result = fairing.fillet(vertices, triangles, seam, width=WIDTH, spacing=WIDTH / 6, continuity="G2")
    assert result.continuity == "G2"
    exact = wedges.curvature_continuous(120, WIDTH)
    off = [np.linalg.norm(exact - place, axis=1).min() for place in middle(result, 0.3)[:, :2]]
    assert max(off) < 5e-3 * WIDTH


def heights(profile: float) -> tuple[FloatArray, FloatArray]:
    """Of a wedge of 120°: the arc length from the middle of the arc, and the height over the chord, in widths."""
    vertices, triangles, seam = wedges.wedge(120, rows=2, length=3.0)
    result = fairing.fillet(vertices, triangles, seam, width=WIDTH, spacing=WIDTH / 8, profile=profile)
    places = middle(result, 0.3)[:, :2] / WIDTH
    return places[:, 0], places[:, 1] + np.cos(np.radians(60))


@pytest.mark.parametrize("profile", [-0.5, 0.5])
def test_the_profile_is_the_drawn_beam(profile: float) -> None:
    """B⁗ + (B − d) / ℓ⁴ = 0 along the arc, B and B′ zero at both ends; d leads from it to the seam, or to the chord."""
    across, height = heights(profile)
    centre, radius = wedges.arc(120, 1.0)
    half, count = np.radians(30), 801
    turn = np.linspace(-half, half, count)
    step = radius * (turn[1] - turn[0])
    fair = np.column_stack([centre[0] + radius * np.sin(turn), centre[1] + radius * np.cos(turn)])
    side = turn / half
    seam = np.column_stack([side * np.sin(np.radians(60)), -np.abs(side) * np.cos(np.radians(60))])
    chord = np.column_stack([side * np.sin(np.radians(60)), np.full(count, -np.cos(np.radians(60)))])
    pull = (4 * abs(profile) / (1 - abs(profile))) ** 4
    inner = count - 2
    beam = sum(c * np.eye(inner, k=k) for k, c in zip((-2, -1, 0, 1, 2), (1, -4, 6, -4, 1), strict=True))
    beam[0, 0] = beam[-1, -1] = 7  # clamped
    system = beam / step**4 + pull * np.eye(inner)
    exact = fair.copy()
    exact[1:-1] += np.linalg.solve(system, pull * ((seam if profile > 0 else chord) - fair)[1:-1])
    exact[:, 1] += np.cos(np.radians(60))
    places = np.column_stack([across, height])
    off = [np.linalg.norm(exact - place, axis=1).min() for place in places]
    assert max(off) < 1e-2


@pytest.mark.parametrize("rows", [1, 3, 8])
def test_it_ends_on_straight_lines_beside_straight_edges(rows: int) -> None:
    vertices, triangles = solids.box(rows)
    result = fairing.fillet(vertices, triangles, width=0.2, spacing=0.1)
    points, faces = with_new(vertices, triangles, result)
    ends = points[np.unique(result.line)]
    across = np.sort(np.abs(ends), axis=1)
    assert abs(across[:, 2] - 1).max() < 1e-12
    assert abs(across[:, 1] - 0.8).max() < 1e-12
    pieces = result.triangles[: result.outside]
    kept = np.delete(triangles, result.gone, axis=0)
    assert abs(areas(points, pieces).sum() + areas(points, kept).sum() - 6 * 1.6**2) < 1e-10
    assert areas(points, pieces).min() > 0
    assert measures.euler_number(faces) == 2
    assert fairing.boundary_loops(faces) == []


def plate(count: int) -> tuple[FloatArray, IntArray, IntArray]:
    """[−2, 2]² in the plane z = 0, and its edges from (−.5, 0) to (.5, 0)."""
    x = np.linspace(-2, 2, count + 1)
    vertices = np.array([[a, b, 0.0] for b in x for a in x])
    triangles = halves(numbered(count + 1, count + 1).T)
    on = np.flatnonzero((np.abs(vertices[:, 1]) < 1e-9) & (np.abs(vertices[:, 0]) < 0.5 + 1e-9))
    return vertices, triangles, np.column_stack([on[:-1], on[1:]])


@pytest.mark.parametrize("count", [8, 24])
def test_the_line_closes_around_the_ends_of_a_seam(count: int) -> None:
    vertices, triangles, seam = plate(count)
    result = fairing.fillet(vertices, triangles, seam, width=0.37)
    points = np.concatenate([vertices, result.vertices])
    ends = points[np.unique(result.line)]
    nearest = np.column_stack([np.clip(ends[:, 0], -0.5, 0.5), np.zeros((len(ends), 2))])
    assert abs(np.linalg.norm(ends - nearest, axis=1) - 0.37).max() < 1e-6
    assert (ends[:, 0] > 0.8).any()
    assert abs(result.vertices[:, 2]).max() < 1e-9  # nothing to round: nothing changes
    assert len(fairing.boundary_loops(result.triangles[result.outside :])) == 1


def test_pieces_outside_stay_in_their_planes_and_all_else_stays() -> None:
    vertices, triangles = solids.sphere(24, 12)
    ring = np.array([[a, b] for a, b in measures.edges(triangles) if abs(vertices[[a, b], 2]).max() < 1e-9])
    result = fairing.fillet(vertices, triangles, ring, width=0.4)
    points, faces = with_new(vertices, triangles, result)
    for t, parent in zip(result.triangles[: result.outside], result.parent[: result.outside], strict=True):
        a, b, c = vertices[triangles[parent]]
        normal = np.cross(b - a, c - a)
        assert np.abs((points[t] - a) @ normal / np.linalg.norm(normal)).max() < 1e-14
    assert measures.euler_number(faces) == 2
    assert fairing.boundary_loops(faces) == []


def test_widths_differ_on_both_sides() -> None:
    vertices, triangles, seam = wedges.wedge(90, rows=3)
    vertices[vertices[:, 0] < 0] *= [1.4, 1.4, 1.0]  # the left side becomes the larger one
    result = fairing.fillet(vertices, triangles, seam, width=0.4, width_2=0.2)
    points = np.concatenate([vertices, result.vertices])
    ends = points[np.unique(result.line)]
    ends = ends[np.abs(ends[:, 2]) < 1.5]
    reach = np.linalg.norm(ends[:, :2], axis=1)
    assert abs(reach[ends[:, 0] < 0] - 0.4).max() < 1e-12
    assert abs(reach[ends[:, 0] > 0] - 0.2).max() < 1e-12


def test_widths_vary_along_the_seam() -> None:
    """Linear in between, on each side: the line beside a seam of two planes is straight, and leans."""
    vertices, triangles, seam = wedges.wedge(90, rows=4)
    width = 0.3 + 0.05 * vertices[:, 2]
    result = fairing.fillet(vertices, triangles, seam, width=width)
    points = np.concatenate([vertices, result.vertices])
    ends = points[np.unique(result.line)]
    ends = ends[np.abs(ends[:, 2]) < 1.9]
    assert abs(np.linalg.norm(ends[:, :2], axis=1) - 0.3 - 0.05 * ends[:, 2]).max() < 1e-9


def refused(code: str, *args: object, **options: object) -> NDArray[np.int32]:
    with pytest.raises(fairing.MeshError) as caught:
        fairing.fillet(*args, **options)  # type: ignore[arg-type]
    assert caught.value.code == code
    return caught.value.elements


def test_a_width_that_leaves_nothing_of_a_part_is_refused_with_the_part() -> None:
    vertices, triangles = solids.box(4)
    assert len(refused("WIDTH_TOO_LARGE", vertices, triangles, width=1.1, clamp=False)) == len(vertices)
    vertices, triangles = solids.cylinder(32, 6, 6.0)
    assert set(vertices[refused("WIDTH_TOO_LARGE", vertices, triangles, width=1.2, clamp=False), 2]) == {
        0.0,
        6.0,
    }  # both lids


def slotted() -> tuple[FloatArray, IntArray]:
    """A block of 3 × 3 × 2 with a slot 1 wide and 1 deep along y."""
    boundary = np.array([(0, 0), (3, 0), (3, 2), (2, 2), (2, 1), (1, 1), (1, 2), (0, 2)], dtype=np.float64)
    caps = np.array([(0, 1, 5), (1, 4, 5), (1, 2, 4), (2, 3, 4), (0, 5, 7), (5, 6, 7)])
    around = np.arange(8)
    after = (around + 1) % 8
    vertices = np.concatenate([np.insert(boundary, 1, depth, axis=1) for depth in (0.0, 3.0)])
    walls = [np.column_stack([around, after + 8, after]), np.column_stack([around, around + 8, after + 8])]
    return vertices, np.concatenate([caps, caps[:, ::-1] + 8, *walls])


@pytest.mark.parametrize("width", [0.49, 0.5, 0.51])
def test_fillets_that_would_close_a_slot_are_refused(width: float) -> None:
    """At .5 nothing is left of floor, walls and lands: a balloon. One land by itself becomes half a cylinder."""
    vertices, triangles = slotted()
    refused("WIDTH_TOO_LARGE", vertices, triangles, width=width, clamp=False)
    rib = fairing.fillet(vertices, triangles, np.array([(2, 10), (3, 11)]), width=0.5).vertices
    np.testing.assert_allclose(np.hypot(rib[:, 0] - 2.5, np.maximum(rib[:, 2] - 1.5, 0.0)), 0.5, atol=1e-3)


@pytest.mark.parametrize("height", [0.5, 1.0, 4.0])
def test_a_fillet_is_a_fifth_of_the_shortest_side_wide(height: float) -> None:
    """Of all edges of a box and of one; of a cylinder's lid, which is wider than its rim is long."""
    vertices, triangles = solids.box(3)
    vertices = vertices * (1.0, 1.0, 0.5 * height)
    assert fairing.fillet_width(vertices, triangles) == pytest.approx(0.2 * min(2.0, height))
    upright = np.flatnonzero((np.abs(vertices[:, :2] - 1.0) < 1e-9).all(axis=1))
    order = upright[np.argsort(vertices[upright, 2])]
    seam = np.column_stack([order[:-1], order[1:]])
    assert fairing.fillet_width(vertices, triangles, seam) == pytest.approx(0.4)
    result = fairing.fillet(vertices, triangles, seam)
    assert abs(vertices[:, :2]).max() - abs(result.vertices[:, 0]).min() == pytest.approx(0.4, rel=0.02)
    vertices, triangles = solids.cylinder(32, 4, height)
    across = 2.0 * np.cos(np.pi / 32)
    assert fairing.fillet_width(vertices, triangles) == pytest.approx(0.2 * min(height, across), rel=0.01)


def test_a_clamped_width_fits_and_says_where() -> None:
    vertices, triangles = slotted()
    result = fairing.fillet(vertices, triangles, width=0.55, clamp=True)
    (warning,) = [each for each in result.warnings if each.code == "WIDTH_TOO_LARGE"]
    assert (warning.figures["width"], warning.figures["clamped"]) == (0.55, 1.0)
    assert 0.4 < warning.figures["widest"] < 0.5
    assert result.converged
    assert result.vertices[:, 2].max() <= 2.0 + 1e-6
    points, faces = with_new(vertices, triangles, result)
    assert fairing.boundary_loops(faces) == []
    assert len(fairing.self_intersections(points, faces)) == 0
    same = fairing.fillet(vertices, triangles, width=0.4, clamp=True)
    np.testing.assert_array_equal(same.vertices, fairing.fillet(vertices, triangles, width=0.4, clamp=False).vertices)
    assert same.warnings == ()
    assert same.vertices[:, 2].max() <= 2.0 + 1e-6


def test_clamped_widths_taper() -> None:
    """Beyond a wall that ends the fillet becomes wider by a quarter of the way along the seam, not at once."""
    vertices, triangles = solids.box(16)
    hard, edges = fairing.hard_edges(vertices, triangles), measures.edges(triangles)
    x, y, z = np.moveaxis(vertices[edges], 2, 0)
    wall = edges[(abs(x + 0.75).max(axis=1) < 1e-9) & (abs(y).max(axis=1) < 0.3) & (z.min(axis=1) > 1.0 - 1e-9)]
    seam = hard[(vertices[hard, 0].max(axis=1) < -1.0 + 1e-9) & (vertices[hard, 2].min(axis=1) > 1.0 - 1e-9)]
    result = fairing.fillet(vertices, triangles, seam, width=0.4, clamp=True, walls=np.concatenate([hard, wall]))
    points = np.concatenate([vertices, result.vertices])
    ends = points[np.unique(result.line)]
    ends = ends[ends[:, 2] > 1.0 - 1e-9]
    along, reach = ends[np.argsort(ends[:, 1])][:, 1::-1].T
    assert ((reach + 1.0).min(), (reach + 1.0).max()) == pytest.approx((0.225, 0.4), abs=1e-3)
    assert abs(np.diff(reach) / np.diff(along)).max() < 0.3


def parted(count: int, sides: int) -> tuple[FloatArray, IntArray, IntArray, list[int]]:
    """A box with some vertices in one place of an edge, on one of its sides or both, its edges in that line, and these
    vertices in the order of a triangle there."""
    vertices, triangles = solids.box(2)
    edge = measures.edges(triangles)
    along = edge[(np.abs(vertices[edge][:, :, :2] - 1).max(axis=(1, 2)) < 1e-9)]
    a, b = along[0].tolist()
    chain = [a, *range(len(vertices), len(vertices) + count), b]
    more = np.concatenate([vertices, [vertices[a] + 0.3 * (vertices[b] - vertices[a])] * count])
    beside = np.flatnonzero((triangles == a).any(axis=1) & (triangles == b).any(axis=1))[:sides]
    parts = []
    for t in triangles[beside].tolist():
        apex = next(v for v in t if v not in (a, b))
        ordered = chain if t[t.index(a) - 2] == b else chain[::-1]
        parts += [[u, v, apex] for u, v in pairwise(ordered)]
    return more, np.concatenate([np.delete(triangles, beside, axis=0), parts]), along, ordered


def test_a_vertex_on_an_edge_is_named() -> None:
    """One of a box's edges has a vertex in it, on one side only: it has two triangles nowhere."""
    vertices, triangles, _, ordered = parted(1, 1)
    assert set(refused("NONMANIFOLD_VERTEX", vertices, triangles, width=0.1).tolist()) == set(ordered)


def test_other_bad_seams_are_refused_with_their_places() -> None:
    vertices, triangles = solids.sphere(12, 6)
    refused("NO_SEAM", vertices, triangles, width=0.1)
    flat, sheet, _ = plate(4)
    assert refused("SEAM_ON_BORDER", flat, sheet, [[0, 1]], width=0.1).tolist() == [0, 1]
    three = np.concatenate([sheet, [[0, 6, 20]]])
    assert refused("NONMANIFOLD_EDGE", flat, three, [[0, 6]], width=0.1).tolist() == [0, 6]
    wrong = sheet.copy()
    first = int(np.flatnonzero((sheet == 0).any(axis=1) & (sheet == 6).any(axis=1))[0])
    wrong[first] = wrong[first][::-1]
    assert refused("INCONSISTENT_WINDING", flat, wrong, [[0, 6]], width=0.1).tolist() == [0, 6]
    with pytest.raises(ValueError, match="width"):
        fairing.fillet(flat, sheet, [[6, 7]], width=0.0)
    with pytest.raises(ValueError, match="not joined by an edge"):
        fairing.fillet(flat, sheet, [[0, 9]], width=0.1)


def test_a_fillet_stops_at_walls_and_is_tangent_to_its_own_side_there() -> None:
    """A hard edge .2 widths from the seam: it stays where it is, and the strip between keeps its slope."""
    vertices, triangles = solids.box(1)
    tall = vertices * [1.0, 1.0, 0.03]
    top = np.array(
        [[a, b] for a, b in measures.edges(triangles) if (tall[[a, b], 2] > 0).all() and (tall[[a, b], 0] > 0).all()]
    )
    seam = top[np.abs(tall[top][:, :, 0] - 1).max(axis=1) < 1e-9]
    result = fairing.fillet(tall, triangles, seam, width=0.3)
    assert result.converged
    assert result.vertices[:, 2].min() >= -0.03 - 1e-9
    _, faces = with_new(tall, triangles, result)
    assert measures.euler_number(faces) == 2
    assert fairing.boundary_loops(faces) == []


def foot(sides: int) -> tuple[FloatArray, IntArray, IntArray]:
    """A boss on an undivided box, and its lower edge."""
    vertices, triangles, walls = solids.box_with_boss(sides)
    triangles = np.concatenate([triangles, walls])
    ring = 8 + np.arange(sides)
    return vertices, triangles, np.column_stack([ring, np.roll(ring, -1)])


@pytest.mark.parametrize("width", [0.05, 0.1, 0.2])
@pytest.mark.parametrize("sides", [4, 8])
def test_it_goes_around_the_foot_of_a_boss_whose_walls_meet_in_edges(sides: int, width: float) -> None:
    """The line passes each of these edges in one point: two, in the same place, have slivers between them."""
    vertices, triangles, seam = foot(sides)
    result = fairing.fillet(vertices, triangles, seam, width=width)
    assert (result.converged, result.provenance, result.warnings) == (True, "equation", ())
    points = np.concatenate([vertices, result.vertices])
    new = result.triangles[result.outside :]
    sizes = np.linalg.norm(points[new] - points[np.roll(new, 1, axis=1)], axis=2)
    assert sizes.min() > 0.05 * width
    assert sizes.max() < 0.75 * width
    on_edges = np.unique(result.line)
    corners = vertices[8 : 8 + sides, :2]
    apart = np.linalg.norm(points[on_edges, None, :2] - corners, axis=2)
    assert ((apart < 1e-9).sum(axis=0) == 1).all()


def is_round(vertices: FloatArray, triangles: IntArray, result: fairing.results.FilletResult) -> None:
    """The fillet of width .2 at a box's edge x = y = 1 is a cylinder's quarter there, and nothing is left open."""
    assert result.converged
    near = middle(result)
    near = near[(near[:, :2] > 0.8 - 1e-9).all(axis=1)]
    off = abs(np.hypot(near[:, 0] - 0.8, near[:, 1] - 0.8) - 0.2) / 0.2
    assert off.max() < 5e-3
    _, faces = with_new(vertices, triangles, result)
    assert fairing.boundary_loops(faces) == []


@pytest.mark.parametrize("count", [1, 2, 3])
def test_what_booleans_leave_in_a_seam_is_got_over(count: int) -> None:
    """Edges without length, whose points of the line lie in one place and seemed to be before each other for ever; or a
    vertex on one side only, and so a triangle without area in the seam."""
    vertices, triangles, along, ordered = parted(count, min(count, 2))
    if count == 1:
        triangles = np.concatenate([triangles, [[ordered[0], ordered[2], ordered[1]]]])
    seam = np.concatenate([along[min(count - 1, 1) :], list(pairwise(ordered))])
    is_round(vertices, triangles, fairing.fillet(vertices, triangles, seam, width=0.2))


def test_a_short_edge_of_a_seam_is_not_closed_where_a_triangle_would_lie_on_the_seam() -> None:
    points = np.pad([(-0.2, -0.2), (0, 0), (1, 0), (2, 0), (1, 2), (1, -2), (-2, 0)], ((0, 0), (0, 1)))
    triangles = np.array([int(v) for v in "014124234046650021032053"], dtype=np.int32).reshape(-1, 3)
    _, _, made, _ = _core.first_mesh(points, triangles, [1] * 8, [(1, 0), (1, 2), (2, 3)], np.ones(7))
    assert len(made) == 6
    assert areas(points, made).min() > 0.05


def test_no_new_vertex_comes_to_lie_over_one_of_the_border() -> None:
    border = [(0.03, 0.32), (-0.37, 0.81), (-0.17, 0.22), (-0.66, 0.73), (-0.24, -0.06), (-0.05, -0.18), (0.47, -0.15)]
    points = np.pad([*border, (0.0, 0.0)], ((0, 0), (0, 1)))
    fan, up = np.array([(k, (k + 1) % 7, 7) for k in range(7)], dtype=np.int32), np.tile([0.0, 0.0, 1.0], (7, 1))
    made = _core.remesh(points, fan, fan[:, 0], up, ([], []), [], (0.3, True, True), 0, None)
    assert np.linalg.norm(made["vertices"][:, None] - points[:7], axis=2).min() > 1e-3


def test_errors_name_vertices_of_the_mesh_given(monkeypatch: pytest.MonkeyPatch) -> None:
    """Not those of the mesh that was cut from it."""
    vertices, triangles = solids.box(1)

    def broken(*_: object) -> None:
        names = np.array([3, 900], dtype=np.int32)
        raise fairing.MeshError(fairing.Diagnostic("NONMANIFOLD_EDGE", "edge 3–900", names, "vertex", {}))

    monkeypatch.setattr("fairing.filleting.fillet.solved", broken)
    with pytest.raises(fairing.MeshError) as caught:
        fairing.fillet(vertices, triangles, width=0.2)
    assert caught.value.elements.tolist() == [3]


def volume(vertices: FloatArray, triangles: IntArray) -> float:
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6)


@pytest.mark.parametrize("shear", [0.0, 0.3])
def test_a_fillet_goes_on_through_the_faces_at_its_ends(shear: float) -> None:
    """The upright edges of a box: nothing of it leaves the planes at their ends, of which it takes the corners."""
    width = 0.2
    vertices, triangles = solids.box(1)
    hard = fairing.hard_edges(vertices, triangles)
    seam = hard[np.ptp(vertices[hard][:, :, :2], axis=1).max(axis=1) < 1e-9]
    walls = hard[np.ptp(vertices[hard][:, :, 2], axis=1) < 1e-9]
    vertices = vertices + shear * vertices[:, 2:] * (1.0, 0.0, 0.0)
    result = fairing.fillet(vertices, triangles, seam, width=width, walls=walls)
    points, faces = with_new(vertices, triangles, result)
    assert (result.converged, fairing.boundary_loops(faces)) == (True, [])
    assert len(fairing.self_intersections(points, faces)) == 0
    used = points[np.unique(faces)]
    assert abs(used[:, 2]).max() == pytest.approx(1.0, abs=1e-6)
    at_ends = used[abs(used[:, 2]) > 1.0 - 1e-6] - shear * used[abs(used[:, 2]) > 1.0 - 1e-6][:, 2:] * (1.0, 0.0, 0.0)
    assert (abs(at_ends[:, :2]).sum(axis=1) < 2.0 - 0.4 * width).all()
    if shear == 0.0:
        assert volume(points, faces) == pytest.approx(8.0 - (4.0 - np.pi) * width**2 * 2.0, rel=1e-3)
        corner = abs(result.vertices[:, :2]) - (1.0 - width)
        assert abs(np.linalg.norm(np.maximum(corner, 0.0), axis=1) - width).max() < 1e-3 * width


def test_a_fillet_fills_the_corners_of_a_pocket_up_to_its_mouth() -> None:
    width = 0.2
    outer, inner = np.array([(-2, -2), (2, -2), (2, 2), (-2, 2)]), np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)])
    rings = [(outer, -2), (outer, 1), (inner, 1), (inner, 0)]
    vertices = np.array([(*place, height) for ring, height in rings for place in ring], dtype=np.float64)
    sides = [
        (4 * r + k, 4 * r + (k + 1) % 4, 4 * r + 4 + (k + 1) % 4, 4 * r + 4 + k) for r in range(3) for k in range(4)
    ]
    quads = [*sides, (3, 2, 1, 0), (12, 13, 14, 15)]
    triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])
    seam = np.array([(8 + k, 12 + k) for k in range(4)])
    result = fairing.fillet(vertices, triangles, seam, width=width)
    points, faces = with_new(vertices, triangles, result)
    assert (result.converged, result.warnings, fairing.boundary_loops(faces)) == (True, (), [])
    assert len(fairing.self_intersections(points, faces)) == 0
    assert volume(points, faces) == pytest.approx(44.0 + (4.0 - np.pi) * width**2, rel=1e-4)
    assert abs(points[np.unique(faces)][:, 2]).max() == 2.0
