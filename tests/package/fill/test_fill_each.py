"""Each hole by itself: borders that touch, loops that no surface closes beside others, single faces, flat lids."""

from typing import Any

import numpy as np
import pytest

import bad_inputs
import fairing
import holes
import measures
from grids import halves, numbered
from holes import FloatArray, IntArray, Mesh
from measures import with_new
from meshing import face_normals


def ball(level: int = 4) -> Mesh:
    """A unit sphere, an irregular one."""
    return bad_inputs.closed_ball(5 * 4**level)[:2]


def assert_closed(vertices: FloatArray, triangles: IntArray) -> None:
    """A sphere's closed oriented manifold with no two vertices in one place."""
    assert measures.is_oriented_manifold(triangles) and fairing.boundary_loops(triangles) == []
    assert measures.euler_number(triangles) == 2
    used = np.unique(triangles)
    assert len(np.unique(vertices[used].round(12), axis=0)) == len(used)


def caps(vertices: FloatArray, triangles: IntArray, axes: FloatArray, cosine: float) -> IntArray:
    """The triangles without those whose middle is near one of the axes."""
    middle = vertices[triangles].mean(axis=1)
    return triangles[((middle / np.linalg.norm(middle, axis=1)[:, None]) @ axes.T < cosine).all(axis=1)]


def thirteen() -> tuple[FloatArray, IntArray]:
    """A ball with thirteen holes; in one of them a face hangs by a corner."""
    vertices, triangles = ball()
    golden = (1 + 5**0.5) / 2
    axes = np.concatenate(
        [np.roll([(0.0, s, t * golden)], k, axis=1) for s in (-1, 1) for t in (-1, 1) for k in range(3)]
    )
    axes = np.concatenate([axes, [[1.0, 1.0, 1.0]]])
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    left = caps(vertices, triangles, axes, 0.975)
    border = np.unique(np.concatenate(fairing.boundary_loops(left)))
    keys = {tuple(row) for row in left.tolist()}
    gone = np.array([row for row in triangles.tolist() if tuple(row) not in keys])
    near = vertices[gone].mean(axis=1) @ axes[-1] > 0.97
    hanging = gone[near & (np.isin(gone, border).sum(axis=1) == 1)][:1]
    return vertices, np.concatenate([left, hanging])


def test_holes_that_meet_in_a_corner_are_two() -> None:
    """Also three around one vertex; `boundary_loops` follows the fans, across the corner."""
    vertices, triangles = ball(2)
    star = np.flatnonzero((triangles == 20).any(axis=1))
    for chosen, count in ((star[[0]], 1), (star, 1)):
        assert len(fairing.borders.hole_loops(vertices, np.delete(triangles, chosen, axis=0)).loops) == count
    ring = np.unique(triangles[star])
    apart: list[int] = []
    for t in star.tolist():  # no two of them share an edge
        if all(len(np.intersect1d(triangles[t], triangles[other])) == 1 for other in apart):
            apart.append(t)
    assert len(apart) >= 2
    open_mesh = np.delete(triangles, apart, axis=0)
    loops = fairing.borders.hole_loops(vertices, open_mesh).loops
    assert sorted(map(tuple, np.sort(loops, axis=1))) == sorted(map(tuple, np.sort(triangles[apart], axis=1)))
    assert max(map(len, fairing.boundary_loops(open_mesh))) == 3 * len(apart)
    assert {20} < {*ring.tolist()}
    result = fairing.fill(vertices, open_mesh)
    assert len(result.vertices) == 0
    assert_closed(*with_new(vertices, open_mesh, result))


def test_a_loop_that_touches_itself_is_parted() -> None:
    """`boundary_loops` follows the fans, across the vertex where two holes meet."""
    vertices, triangles = ball(3)
    pair = caps(vertices, triangles, np.array([[0.0, 0.0, 1.0]]), 0.97)
    star = np.flatnonzero((triangles == pair[0, 0]).any(axis=1))
    apart = next(t for t in star if len(np.intersect1d(triangles[t], triangles[star[0]])) == 1)
    open_mesh = np.delete(triangles, [star[0], apart], axis=0)
    (loop,) = fairing.boundary_loops(open_mesh)
    assert_closed(*with_new(vertices, open_mesh, fairing.fill(vertices, open_mesh, [loop])))


def corners(vertices: FloatArray, result: fairing.FillResult) -> set[Any]:
    """Triangles by the places of their corners, in any order."""
    places = np.concatenate([vertices, result.vertices]).round(9) + 0.0
    return {tuple(sorted(map(tuple, each))) for each in places[result.triangles].tolist()}


@pytest.mark.parametrize("seed", range(4))
def test_a_hole_is_the_same_wherever_its_loop_begins_and_whatever_its_numbers(seed: int) -> None:
    """Some of which touch: one by one, turned and in other numbers, and all in one call, in any order."""
    rng = np.random.default_rng(seed)
    vertices, triangles = ball(3)
    triangles = caps(vertices, triangles, vertices[rng.integers(len(vertices), size=6)], 0.95)
    vertices = vertices * (1 + 0.1 * np.sin(3 * vertices[:, [1]] + seed))
    number = rng.permutation(len(vertices)).astype(np.int32)
    renumbered = vertices[np.argsort(number)]
    for loops in (fairing.borders.hole_loops(vertices, triangles).loops, fairing.boundary_loops(triangles)):
        again = [np.roll(number[loop], rng.integers(len(loop)))[:: rng.choice([-1, 1])] for loop in loops]
        alone = [corners(renumbered, fairing.fill(renumbered, number[triangles], [loop])) for loop in again]
        together = fairing.fill(vertices, triangles, [loops[k] for k in rng.permutation(len(loops))])
        assert corners(vertices, together) == set().union(*alone)


def test_what_is_wrong_with_one_loop_stops_no_other() -> None:
    """A vertex that is not finite, one on another's edge, faces wound against each other, a lone triangle."""
    vertices, triangles = thirteen()
    good = fairing.fill(vertices, triangles)
    plain = [loop for loop in good.loops if len(np.unique(loop)) == len(loop)]
    bad, torn = plain[0], plain[1]
    vertices = vertices.copy()
    vertices[bad[3]] = np.nan
    beside = np.flatnonzero((triangles == torn[0]).any(axis=1) & (triangles == torn[1]).any(axis=1))
    triangles = triangles.copy()
    triangles[beside] = triangles[beside][:, ::-1]
    corner = len(vertices)
    vertices = np.concatenate([vertices, np.eye(3) + 3.0])
    triangles = np.concatenate([triangles, [[corner, corner + 1, corner + 2]]])
    before = vertices.copy(), triangles.copy()
    result = fairing.fill(vertices, triangles)
    assert len(result.loops) == 11
    codes = {each.code: set(loop.tolist()) for loop, each in zip(result.left_open, result.left_because, strict=True)}
    assert codes["NONFINITE"] == {*bad.tolist()}
    assert codes["NOT_A_HOLE"] == {corner, corner + 1, corner + 2}
    assert {torn[0], torn[1]} <= codes["NOT_A_LOOP"] | {*torn.tolist()}
    assert {each.code for each in result.warnings} >= {"NONFINITE", "NOT_A_HOLE"}
    assert abs(np.linalg.norm(result.vertices, axis=1) - 1).max() < 1e-3
    np.testing.assert_array_equal(vertices, before[0])
    np.testing.assert_array_equal(triangles, before[1])


def test_longest_as_edges_and_as_a_length() -> None:
    vertices, triangles = thirteen()
    loops = fairing.fill(vertices, triangles).loops
    sizes = sorted(map(len, loops))
    lengths = [np.linalg.norm(vertices[loop] - vertices[np.roll(loop, 1)], axis=1).sum() for loop in loops]
    some = fairing.fill(vertices, triangles, longest=sizes[5])
    assert sorted(map(len, some.loops)) == [size for size in sizes if size <= sizes[5]]
    middle = float(np.median(lengths)) + 1e-9
    some = fairing.fill(vertices, triangles, longest_length=middle)
    assert len(some.loops) == sum(length <= middle for length in lengths)
    with pytest.raises(fairing.MeshError, match="long or shorter"):
        fairing.fill(vertices, triangles, longest_length=0.01)
    with pytest.raises(ValueError, match="longest_length: a length"):
        fairing.fill(vertices, triangles, longest_length=-1.0)


@pytest.mark.parametrize("place", ["flat", "cylinder", "sphere"])
def test_a_missing_triangle_is_closed_by_one(place: str) -> None:
    """No vertex is new, so that nothing rises: a bump of a third of an edge otherwise."""
    if place == "sphere":
        vertices, triangles = ball(3)
    else:
        bend = 0.0 if place == "flat" else 3.0
        vertices, triangles = holes.sheet(
            lambda u, v: (np.sin(bend * u) / bend, v, np.cos(bend * u) / bend) if bend else (u, v, 0 * u),
            (12, 12),
            lambda u, v: np.zeros(u.shape, dtype=bool),
        )
    middle = int(np.linalg.norm(vertices[triangles].mean(axis=1) - [0.4, 0.5, 0.2], axis=1).argmin())
    loop = triangles[middle]
    around = np.delete(triangles, middle, axis=0)
    result = fairing.fill(vertices, around, [loop])
    assert (len(result.vertices), {*result.triangles[0].tolist()}) == (0, {*loop.tolist()})
    assert result.converged
    assert not len(fairing.looks.visible_join(vertices, result.triangles, around, result.fixed).seen)


def test_a_missing_quad_is_cut_along_the_better_diagonal() -> None:
    """An arrow with a re-entrant corner, and one whose other diagonal is an edge of the mesh."""
    arrow = np.array([[0, 0, 0], [2, 0, 0], [0.4, 0.4, 0], [0, 2, 0]], float)
    up = np.tile([0.0, 0.0, 1.0], (4, 1))
    for turn in range(4):
        loop = np.roll(np.arange(4), turn)
        result = fairing.fill(arrow, np.empty((0, 3), int), [loop], normals=up)
        areas = face_normals(arrow, result.triangles)[:, 2]
        assert len(areas) == 2
        assert (areas > 0).all()
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])
    pyramid = np.concatenate([square, [[0.5, 0.5, -1.0]]])
    below = np.array([[4, 1, 0], [4, 2, 1], [4, 3, 2], [4, 0, 3]])
    result = fairing.fill(pyramid, below[:, ::-1])
    assert_closed(*with_new(pyramid, below[:, ::-1], result))


def cylinder(rim: int, rows: int = 6) -> Mesh:
    """Radius 1, open at z = 0 and at the lower end."""
    return holes.sheet(
        lambda u, v: (np.cos(2 * np.pi * u), np.sin(2 * np.pi * u), -v),
        (rim, rows),
        lambda u, v: np.zeros(u.shape, dtype=bool),
        closed=True,
    )


@pytest.mark.parametrize("rim", [5, 12, 48])
def test_a_soap_film_over_a_cylinder_is_a_flat_lid(rim: int) -> None:
    vertices, triangles = cylinder(rim)
    top = [loop for loop in fairing.boundary_loops(triangles) if (vertices[loop, 2] > -1e-9).all()]
    result = fairing.fill(vertices, triangles, top, equation="soap_film")
    assert (result.converged, result.equation) == (True, "soap_film")
    assert abs(result.vertices[:, 2]).max() < 1e-9
    areas = face_normals(np.concatenate([vertices, result.vertices]), result.triangles)[:, 2]
    assert (areas < 0).all()  # wound as the tube, whose outside is within
    assert -0.5 * areas.sum() == pytest.approx(0.5 * rim * np.sin(2 * np.pi / rim))


# A hole is a job of its own: filled with others, in any order, it is what it is alone.


def test_a_loop_without_a_fair_surface_is_closed_by_the_one_of_least_area() -> None:
    """Slopes that lean out by 120° at every other vertex of a circle: a flat disc, said; none with ``otherwise``."""
    angle = np.arange(16) * np.pi / 8
    points = np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])
    lean = np.radians(120) * np.where(np.arange(16) % 2, 1, -1)[:, None]
    normals = np.sin(lean) * points + np.cos(lean) * [0, 0, 1]
    given: Any = (points, np.empty((0, 3), int), [np.arange(16)])
    result = fairing.fill(*given, normals=normals)
    (warning,) = result.warnings
    assert result.converged and result.equation == "soap_film"
    assert abs(result.vertices[:, 2]).max() < 1e-9
    assert warning.code == "NO_SOLUTION" and warning.figures["film"] == 1.0 and "16 edges" in warning.message
    assert not fairing.fill(*given, normals=normals, otherwise="stop").converged


@pytest.mark.parametrize("back", [1, -1])
def test_a_crack_is_closed_without_new_vertices(back: int) -> None:
    """A sheet torn along six of its edges, by a thousandth of one, or torn so that the two sides cross."""
    x, y = (index.ravel() for index in np.mgrid[:13, :9])
    points = np.column_stack([x, y, 0.02 * x * x]).astype(float)
    triangles = halves(numbered(13, 9))
    torn = 4 + 9 * np.arange(4, 9)
    copies = len(points) + np.arange(5)
    beyond = points[triangles].mean(axis=1)[:, 1] > 4
    number = np.arange(len(points))
    number[torn] = copies
    triangles[beyond] = number[triangles[beyond]]
    points = np.concatenate([points, points[torn] + np.outer([1, back, 1, back, 1], [0, 1e-3, 0])])
    result = fairing.fill(points, triangles)
    (hole,) = (hole for hole in result.holes if hole.surface is not None)
    assert len(hole.loops[0]) == 12 and not len(result.vertices) and len(result.triangles) == 10
    assert back < 0 or not len(fairing.self_intersections(*with_new(points, triangles, result)))


def test_face_that_is_folded_back_over_the_border() -> None:
    points, triangles = ball(1)
    a, b = fairing.borders.hole_loops(points, triangles[(triangles != 20).all(axis=1)]).loops[0][:2]
    points = np.vstack([points, 1.6 * points[a] + points[b] - points[20]])
    triangles = np.vstack([triangles[(triangles != 20).all(axis=1)], [a, b, len(points) - 1]])
    _, closed = with_new(points, triangles, fairing.fill(points, triangles))
    sides = np.sort(closed[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2))
    assert (np.unique(sides, axis=0, return_counts=True)[1] == 2).all()  # not the face once more
