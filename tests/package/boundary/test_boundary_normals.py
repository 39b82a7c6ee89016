"""Slopes at a boundary: of the surroundings, of its own side of hard edges, or of the patch itself."""

import numpy as np
import pytest

import bad_inputs
import fairing
import solids
from grids import halves, numbered
from meshing import face_normals
from solids import FloatArray, IntArray


def faired(
    vertices: FloatArray, inside: IntArray, outside: IntArray, side: str = "automatic", continuity: str = "G1"
) -> tuple[fairing.FairResult, fairing.solving.surroundings.BoundaryNormals, IntArray]:
    """The result, the normals, and the free vertices."""
    rim = np.intersect1d(inside, outside)
    found = fairing.boundary_normals(vertices, inside, rim, outside=outside, side=side)
    result = fairing.fair(
        vertices, inside, fixed=rim, fixed_normals=found.normals, outside=outside, continuity=continuity
    )
    return result, found, np.setdiff1d(inside, rim)


def dented_box(n: int, noise: float = 0.0) -> tuple[FloatArray, IntArray, IntArray]:
    """A box with a dent in its top, and noise on that in edges: vertices, the top's triangles, the others."""
    vertices, triangles = solids.box(n)
    top = np.abs(vertices[triangles].mean(axis=1)[:, 2] - 1) < 1e-9
    own = np.setdiff1d(triangles[top], triangles[~top])
    vertices[own, 2] += noise * 2 / n * np.random.default_rng(3).normal(size=len(own))
    middle = own[np.abs(vertices[own, :2]).max(axis=1) < 0.55]
    vertices[middle, 2] -= 0.2
    return vertices, triangles[top], triangles[~top]


@pytest.mark.parametrize("n", [8, 16])
def test_the_top_of_a_box_comes_back_flat(n: int) -> None:
    """Tangent to the sides it rises by .98."""
    vertices, inside, outside = dented_box(n)
    result, found, free = faired(vertices, inside, outside)
    assert found.from_inside.all()
    assert np.abs(result.vertices[free, 2] - 1).max() < 1e-6
    outer, away, _ = faired(vertices, inside, outside, side="outside")
    assert not away.from_inside.any()
    assert np.abs(outer.vertices[free, 2] - 1).max() > 0.5


def bevelled_box(segments: int, width: float, cells: int = 6) -> tuple[FloatArray, IntArray, IntArray]:
    """A box with rounded edges, and noise on its flat top: vertices, the top's triangles, the others."""
    half = segments // 2
    vertices, triangles = solids.box(cells + segments)
    step = np.rint((vertices + 1) * (cells + segments) / 2) - (cells + segments) / 2
    inner = (1 - width) * np.clip(step / (cells / 2), -1, 1)
    beyond = np.sign(step) * np.clip(np.abs(step) - cells / 2, 0, None)
    offset = np.tan(np.pi / 4 * beyond / half)
    vertices = inner + width * offset / np.linalg.norm(offset, axis=1, keepdims=True)
    top = (vertices[triangles][:, :, 2] > 1 - 1e-9).all(axis=1)
    own = np.setdiff1d(triangles[top], triangles[~top])
    vertices[own, 2] += 0.1 * np.random.default_rng(7).normal(size=len(own))
    return vertices, triangles[top], triangles[~top]


@pytest.mark.parametrize("width", [0.02, 0.1, 0.3])
@pytest.mark.parametrize("segments", [2, 4, 6])
def test_the_top_of_a_bevelled_box_comes_back_flat(segments: int, width: float) -> None:
    """Fits see the walls beyond two rows, and took the slope of the bevel: .2 high."""
    result, _, free = faired(*bevelled_box(segments, width))
    assert np.abs(result.vertices[free, 2] - 1).max() < 1e-3 * width


@pytest.mark.parametrize("kind", ["dome", "crumpled", "pocket"])
def test_damage_up_to_the_rim_of_a_box_does_not_count(kind: str) -> None:
    """The fair surface of clean faces is what they say, a dish for instance; of these none says anything."""
    vertices, inside, outside = dented_box(12)
    own = np.setdiff1d(inside, outside)
    x, y = vertices[own, :2].T
    noise = np.random.default_rng(5).normal(size=len(own))
    shapes = {"dome": 0.4 * np.clip(1 - (x**2 + y**2) / 0.6, 0, None), "crumpled": 0.2 * noise, "pocket": -0.6 + 0 * x}
    vertices[own, 2] = 1 + shapes[kind]
    result, found, free = faired(vertices, inside, outside)
    assert found.from_inside.all()
    assert np.abs(result.vertices[free, 2] - 1).max() < 1e-6


def spoilt(vertices: FloatArray, own: IntArray, rim: IntArray, kind: str) -> FloatArray:
    """The vertices `own` of a cap about z, made flat, scaled towards the middle, turned in, or with noise."""
    made, rng = vertices.copy(), np.random.default_rng(11)
    low = vertices[rim, 2].mean()
    if kind == "flat":
        made[own, 2] = np.minimum(made[own, 2], low)
    elif kind == "scaled":
        made[own] *= 0.55 + 0.3 * rng.random((len(own), 1))
    elif kind == "turned in":
        made[own, 2] = 2 * low - made[own, 2]
    else:
        made[own] *= 1 + 0.12 * rng.normal(size=(len(own), 1))
    return made


@pytest.mark.parametrize("kind", ["flat", "scaled", "turned in", "noise"])
@pytest.mark.parametrize("degrees", [40, 55, 70, 85, 100])
@pytest.mark.parametrize(("parallels", "rows", "noise"), [(36, 36, 0.0), (10, 10, 0.0), (10, 1, 0.0), (90, 90, 0.01)])
def test_a_cap_that_is_spoilt_up_to_the_boundary_comes_back_round(
    parallels: int, rows: int, noise: float, degrees: int, kind: str
) -> None:
    """The curvature outside says how far the middle lies below the tangents: there is no wall, whatever lies inside.

    Rows may be wider than half the way to the middle. One row alone is a cone's, too: only one that goes straight down
    is a wall. Noise has edges like walls.
    """
    vertices, triangles = solids.sphere(4 * parallels // 3, parallels)
    upper = (vertices[triangles][:, :, 2] > np.cos(np.radians(degrees)) - 1e-9).all(axis=1)
    rim = np.intersect1d(triangles[upper], triangles[~upper])
    own = np.setdiff1d(triangles[upper], rim)
    outside = triangles[~upper & (np.isin(triangles, rim).any(axis=1) | (rows > 1))]
    vertices *= 1 + noise * np.random.default_rng(2).normal(size=(len(vertices), 1))
    result, found, _ = faired(spoilt(vertices, own, rim, kind), triangles[upper], outside)
    assert not found.from_inside.any()
    assert np.abs(np.linalg.norm(result.vertices[own], axis=1) - 1).max() < 4e-3 + 20 * noise


@pytest.mark.parametrize("continuity", ["G1", "G2"])
@pytest.mark.parametrize("rings", [0, 0.5, 1, 2])
def test_a_boundary_that_is_partly_hard_mixes_both(rings: float, continuity: str) -> None:
    """One side of the selection lies on a crease: the panel goes on flat there. Tangent to the faces beyond: .05."""
    panel = solids.panel(rings)
    result, found, _ = faired(panel.vertices, panel.inside, panel.outside, continuity=continuity)
    on_crease = (np.abs(panel.clean[panel.rim, 1] - 0.3) < 1e-9) & (np.abs(panel.clean[panel.rim, 0]) < 0.44)
    assert found.from_inside.tolist() == (on_crease & (rings < 1)).tolist()
    assert panel.error(result.vertices) < 1e-3


@pytest.mark.parametrize("height", [0.5, -0.5])
def test_a_boss_or_a_pocket_goes(height: float) -> None:
    """Its walls are plane, and their edge with the plate is hard, but the surface over that lies in the plate."""
    x, y = (a.ravel() for a in np.meshgrid(np.linspace(-1, 1, 17), np.linspace(-1, 1, 17), indexing="ij"))
    triangles = halves(numbered(17, 17))
    plate = np.column_stack([x, y, 0 * x])
    top = (np.abs(plate[triangles].mean(axis=1)[:, :2]) < 0.4).all(axis=1)
    used = np.unique(triangles[top])
    moved = np.full(len(plate), -1)
    moved[used] = len(plate) + np.arange(len(used))
    (loop,) = fairing.boundary_loops(triangles[top])
    after = np.roll(loop, -1)
    walls = [np.column_stack([loop, after, moved[after]]), np.column_stack([loop, moved[after], moved[loop]])]
    vertices = np.concatenate([plate, plate[used] + [0, 0, height]])
    inside = np.concatenate([moved[triangles[top]], *walls])
    result, found, free = faired(vertices, inside, triangles[~top])
    assert not found.from_inside.any()
    assert np.abs(result.vertices[free, 2]).max() < 1e-6


@pytest.mark.parametrize("above", [0.3, 0.5, 0.7])
def test_a_dent_that_ends_in_a_crease_goes(above: float) -> None:
    """A ball whose cap was pushed in: parts of its jagged boundary are hard, but these edges end there."""
    vertices, triangles = solids.box(12)
    vertices = np.tan(vertices * np.pi / 4)
    vertices /= np.linalg.norm(vertices, axis=1)[:, None]
    centre = vertices[triangles].mean(axis=1)
    inside = centre[:, 2] / np.linalg.norm(centre, axis=1) > above
    own = np.setdiff1d(triangles[inside], triangles[~inside])
    vertices[own, 2] -= 0.1 + 0.05 * np.cos(7 * vertices[own, 0])
    result, found, free = faired(vertices, triangles[inside], triangles[~inside])
    assert not found.from_inside.any()
    assert np.abs(np.linalg.norm(result.vertices[free], axis=1) - 1).max() < 1e-3


# `fairing.surrounding_normals`: the tangent planes in which the outside meets a patch.
def angles(one: FloatArray, other: FloatArray) -> FloatArray:
    """Degrees between unit vectors (k, 3)."""
    return np.asarray(np.degrees(np.arccos(np.clip((one * other).sum(axis=1), -1, 1))))


@pytest.mark.parametrize("n_free", [30, 60, 200, 2000])
def test_rim_of_a_hemisphere(n_free: int) -> None:
    """Spheres are met exactly on any rim (15 to 104 edges); one-sided averages are 10 to 2 degrees off."""
    vertices, triangles, equator = bad_inputs.closed_ball(n_free)
    triangles = triangles[vertices[triangles].mean(axis=1)[:, 2] < 0]
    found = fairing.surrounding_normals(vertices, triangles, equator)
    assert found.fitted.all()
    assert np.abs(found.normals - vertices[equator]).max() < 1e-9
    averaged = fairing.vertex_normals(vertices, triangles, normals="averaged")[equator]
    assert angles(averaged, vertices[equator]).max() > 1.0


@pytest.mark.parametrize("axis", [0, 2])
@pytest.mark.parametrize("segments", [6, 8, 12, 16, 24, 64])
def test_spheres_of_meridians(segments: int, axis: int) -> None:
    """The nearest points of long or wide quads lie on two or three lines and leave cubic terms open.

    Six meridians with 32 parallels and more make a hexagonal cup, whose edges near the poles are hard.
    """
    for rings in (6, 8, 12, 16, 32, 64) if segments > 6 else (6, 8, 12, 16):
        vertices, faces = bad_inputs.ball_of_meridians(segments, rings)
        outside = vertices[faces].mean(axis=1)[:, axis] < 0
        rim = np.intersect1d(faces[outside], faces[~outside])
        found = fairing.surrounding_normals(vertices, faces[outside], rim)
        assert found.fitted.all()
        assert np.abs(found.normals - vertices[rim]).max() < 1e-9, rings


@pytest.mark.parametrize(("around", "across", "bound"), [(48, 12, 2.0), (48, 24, 2.0), (96, 24, 0.5), (96, 48, 0.3)])
def test_bands_and_windows_of_a_torus(around: int, across: int, bound: float) -> None:
    """Blender's own torus is the first of these; a cubic of the 22 nearest points is 11 to 55 degrees off."""
    angle = 2 * np.pi * np.arange(around)[:, None] / around
    turn = 2 * np.pi * np.arange(across)[None, :] / across
    outward = np.stack(
        np.broadcast_arrays(np.cos(angle) * np.cos(turn), np.sin(angle) * np.cos(turn), np.sin(turn)), -1
    )
    centres = np.stack(np.broadcast_arrays(np.cos(angle), np.sin(angle), 0 * turn + 0 * angle), -1)
    vertices = (centres + 0.25 * outward).reshape(-1, 3)
    triangles = halves(np.pad(numbered(around, across), (0, 1), "wrap"))
    middle = vertices[triangles].mean(axis=1)
    for inside in (np.hypot(middle[:, 0], middle[:, 1]) > 1.1, (middle > 0).all(axis=1)):
        rim = np.intersect1d(triangles[inside], triangles[~inside])
        normals = fairing.surrounding_normals(vertices, triangles[~inside], rim).normals
        assert angles(normals, outward.reshape(-1, 3)[rim]).max() < bound


def test_too_few_points_give_the_average() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
    triangles = np.array([[0, 1, 2]])
    found = fairing.surrounding_normals(vertices, triangles, np.array([0, 3]))
    assert not found.fitted.any()
    assert np.allclose(found.normals[0], face_normals(vertices, triangles)[0])
    assert np.array_equal(found.normals[1], np.zeros(3))


# Slopes and curvatures at a boundary come from its own side of hard edges.
AROUND = 48  # vertices of a ring


def top_of_box(n: int, rows: int) -> tuple[FloatArray, IntArray, IntArray]:
    """A box whose top is selected but for some rows along its edges: vertices, triangles inside and outside."""
    vertices, triangles = solids.box(n)
    centre = vertices[triangles].mean(axis=1)
    inside = (np.abs(centre[:, 2] - 1) < 1e-9) & (np.abs(centre[:, :2]).max(axis=1) < 1 - 2 * rows / n)
    return vertices, triangles[inside], triangles[~inside]


@pytest.mark.parametrize("n", [8, 16])
@pytest.mark.parametrize("rows", [1, 2])
def test_one_flat_row_beside_a_box_edge_is_enough(n: int, rows: int) -> None:
    """Fits across the edge tilt by 45°, with errors of 6°, and sides rise by one to six edges."""
    vertices, inside, outside = top_of_box(n, rows)
    rim = np.intersect1d(inside, outside)
    found = fairing.surrounding_normals(vertices, outside, rim)
    assert found.fitted.all()
    assert np.abs(found.normals - [0.0, 0.0, 1.0]).max() < 1e-9
    assert found.errors.max() < 1e-9
    dented = vertices.copy()
    dented[np.setdiff1d(inside, rim), 2] -= 0.1
    result = fairing.fair(dented, inside, fixed=rim, fixed_normals=found.normals, outside=outside)
    assert np.abs(result.vertices[np.unique(inside), 2] - 1).max() < 1e-6
    filled = fairing.fill(vertices, outside)
    assert np.abs(filled.vertices[:, 2] - 1).max() < 1e-6


@pytest.mark.parametrize("half", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("depth", [0.2, 0.4, 0.8])
def test_a_pinched_pipe_is_straight_again(half: float, depth: float) -> None:
    """A film between its ends has a waist, and the patch another one: these are no walls."""
    heights = np.linspace(-3.0, 3.0, 61)
    radii = 1.0 - depth * np.maximum(0.0, 1.0 - np.abs(heights) / half)
    points, triangles = turned(radii, heights)
    middle = np.abs(points[triangles, 2].mean(axis=1)) < half
    (made, _), _ = fairing.fair_faces((points, triangles), np.flatnonzero(middle))
    assert np.abs(np.hypot(made[:, 0], made[:, 1]) - 1.0).max() < 1e-4


@pytest.mark.parametrize(("rows", "chamfer"), [(1, 0.0), (2, 0.0), (5, 0.0), (2, 0.1)])
@pytest.mark.parametrize("sides", [5, 6, 7, 8, 24])
def test_the_lid_of_a_prism_comes_back_flat(sides: int, rows: int, chamfer: float) -> None:
    """Balls run through two rings, too, and through corners of fits: a cut across the wall, or chamfer, is straight."""
    points, triangles = solids.cylinder(2 * sides, rows, 1.0)
    middle = np.pi / sides
    if sides < 12:
        turn = np.mod(np.arctan2(points[:, 1], points[:, 0]), 2 * middle) - middle
        points[:, :2] *= (np.cos(middle) / np.cos(turn))[:, None]
    top = points[triangles, 2].min(axis=1) > 1 - 1e-9
    points[points[:, 2] == 1, :2] *= 1 - chamfer
    points[points[:, 2] == 0.5, 2] += 4 * chamfer
    points[np.setdiff1d(triangles[top], triangles[~top]), 2] += 0.1
    result, found, free = faired(points, triangles[top], triangles[~top])
    assert found.from_inside.all()
    assert np.abs(result.vertices[free, 2] - 1).max() < 1e-6


def test_a_boss_two_rows_from_the_edge_is_no_slope() -> None:
    """A curve runs through any three rings: their first row is flat all the same."""
    radii = np.concatenate([np.ones(11), [0.75, 0.5, 0.42, 0.38, 0.34, 0.3, 0.28], np.full(10, 0.25)])
    heights = np.concatenate([np.linspace(-1.0, 0.0, 11), np.zeros(8), np.linspace(-0.1, -0.9, 9)])
    points, triangles = turned(radii, heights)
    lid = np.flatnonzero(points[triangles, 2].min(axis=1) == 0.0)
    points[12 * AROUND : 13 * AROUND, 2] = 0.4
    (made, _), _ = fairing.fair_faces((points, triangles), lid)
    assert np.abs(made[11 * AROUND : 18 * AROUND, 2]).max() < 1e-6


def turned(radii: FloatArray, heights: FloatArray) -> tuple[FloatArray, IntArray]:
    """A surface of revolution, from one end of its profile to the other: vertices, triangles."""
    angles = 2.0 * np.pi * np.arange(AROUND) / AROUND
    rings = [[r * np.cos(angles), r * np.sin(angles), np.full(AROUND, z)] for r, z in zip(radii, heights, strict=True)]
    points = np.moveaxis(np.array(rings), 1, 2).reshape(-1, 3)
    return points, halves(np.pad(numbered(len(radii), AROUND), [(0, 0), (0, 1)], "wrap"))[:, ::-1]
