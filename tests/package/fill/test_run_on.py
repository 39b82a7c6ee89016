"""Hard edges and bands that end at a hole run on through it."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

import creased
import fairing
import holes
from creased import FloatArray, Hole, IntArray


def filled(hole: Hole, **options: object) -> fairing.FillResult:
    return fairing.fill(hole.vertices, hole.triangles, [hole.loop], **options)  # type: ignore[arg-type]


def on_curves(hole: Hole, result: fairing.FillResult) -> FloatArray:
    """The places of all vertices of all curves."""
    return np.concatenate([hole.vertices, result.vertices])[np.concatenate(result.curves)]


@pytest.mark.parametrize(
    ("make", "curves", "bound"),
    [
        (creased.in_box_edge, 1, 1e-9),
        (creased.in_box_corner, 3, 1e-9),
        (creased.in_lid, 1, 1e-9),
        (creased.in_bent_sheet, 1, 1e-3),
    ],
)
@pytest.mark.parametrize(("n", "seed"), [(8, 1), (14, 2), (22, 3)])
def test_an_edge_runs_on(make: Callable[[int, int], Hole], curves: int, bound: float, n: int, seed: int) -> None:
    """Flat sides, a straight edge, a circle, a cylinder come back; a parabola and its sheet to 1e-3 of the hole."""
    hole = make(n, seed)
    result = filled(hole)
    assert result.converged
    assert len(result.curves) == curves
    assert hole.error(result.vertices) < bound
    assert hole.edge_error(on_curves(hole, result)) < bound
    assert holes.angles(np.concatenate([hole.vertices, result.vertices]), result.triangles).min() > 15


def test_the_edge_is_rounded_where_that_is_asked_for() -> None:
    hole = creased.in_box_edge(14, 1)
    result = filled(hole, edges="ignored")
    assert result.curves == ()
    assert hole.error(result.vertices) > 0.03
    with pytest.raises(ValueError, match="edges: 'off' is not accepted; accepted are 'run_on', 'ignored'"):
        filled(hole, edges="off")


def test_the_mesh_fits_and_keeps_the_spacing() -> None:
    """Every edge of the loop and of the curve has its two triangles, and finer wishes make finer curves."""
    hole = creased.in_box_edge(14, 1)
    counts = []
    for spacing in (0.03, 0.06, 0.12):
        result = filled(hole, spacing=spacing)
        assert hole.error(result.vertices) < 1e-9
        whole = np.concatenate([hole.triangles, result.triangles])
        sides = np.sort(np.concatenate([whole[:, [0, 1]], whole[:, [1, 2]], whole[:, [2, 0]]]), axis=1)
        edges, uses = np.unique(sides, axis=0, return_counts=True)
        inner = {tuple(edge) for edge in edges[uses == 2].tolist()}
        (curve,) = result.curves
        loop = np.column_stack([hole.loop, np.roll(hole.loop, -1)])
        for pair in (*loop.tolist(), *np.column_stack([curve[:-1], curve[1:]]).tolist()):
            assert (min(pair), max(pair)) in inner
        counts.append(len(curve))
    assert counts[0] > 1.6 * counts[1] > 2.2 * counts[2]


def test_a_marked_edge_runs_on_however_flat() -> None:
    """Across an edge of 20°, which is no hard edge unless it is marked; the curve tells."""
    steep = creased.in_box_edge(14)
    x, y, z = steep.vertices.T
    low = np.tan(np.radians(20.0))
    flat = np.column_stack([x - z, y, low * z])
    sides_of = (lambda p: np.abs(p[:, 2]), lambda p: np.abs(p[:, 2] + low * p[:, 0]) / np.hypot(1.0, low))
    hole = replace(steep, vertices=flat, sides=sides_of)
    x = flat[:, 0]
    sides = np.concatenate([hole.triangles[:, [0, 1]], hole.triangles[:, [1, 2]]])
    marked = np.unique(np.sort(sides[(np.abs(x[sides]) < 1e-9).all(axis=1)], axis=1), axis=0)
    assert filled(hole).curves == ()
    result = filled(hole, marked=marked)
    assert result.marked == (True,)
    assert hole.error(result.vertices) < 1e-9 < hole.error(filled(hole).vertices)
    assert filled(creased.in_box_edge(8, 1)).marked == (False,)


def drawn_across(hole: Hole, places: FloatArray) -> tuple[FloatArray, IntArray]:
    """The vertices with a wire through these places, from one end of the edge x = z = 0 to the other."""
    on_edge = [v for v in hole.loop.tolist() if np.abs(hole.vertices[v, [0, 2]]).max() < 1e-9]
    first, last = sorted(on_edge, key=lambda v: float(hole.vertices[v, 1]))[:: len(on_edge) - 1]
    count = len(hole.vertices)
    chain = [first, *range(count, count + len(places)), last]
    return np.concatenate([hole.vertices, places]), np.column_stack([chain[:-1], chain[1:]])


def test_a_drawn_edge_is_used_as_it_is() -> None:
    """A wire that bulges within the plane x = 0: it stays to the bit, that side stays flat, and the other meets it."""
    hole = creased.in_box_edge(14, 1)
    y = np.linspace(0.3, 0.7, 8)
    places = np.column_stack([np.zeros(8), y, 0.04 * np.cos(np.pi * (y - 0.5) / 0.56)])
    vertices, wires = drawn_across(hole, places)
    result = fairing.fill(vertices, hole.triangles, [hole.loop], wires=wires)
    (curve,) = result.curves
    assert result.marked == (False,)
    assert {tuple(sorted(pair)) for pair in wires.tolist()} == {
        tuple(sorted(pair)) for pair in np.column_stack([curve[:-1], curve[1:]]).tolist()
    }
    assert np.isin(curve, result.triangles).all()
    assert result.vertices[:, 2].max() > 0.02  # the top rises to it
    both = fairing.hard_edges(hole.vertices, hole.triangles)
    assert fairing.fill(vertices, hole.triangles, [hole.loop], wires=wires, marked=both).marked == (True,)
    below = result.vertices[result.vertices[:, 0] > -1e-9]
    assert len(below) > 5
    assert np.abs(below[:, 0]).max() < 1e-9


def test_drawn_edges_that_cross_are_refused_with_their_places() -> None:
    hole = creased.in_box_edge(14, 1)
    vertices, wires = drawn_across(hole, np.array([[0.0, 0.5, 0.0]]))
    a, b = (int(hole.loop[np.argmin(hole.vertices[hole.loop] @ way)]) for way in ([1.0, 0, 0.2], [0.2, 0, 1.0]))
    with pytest.raises(fairing.MeshError, match="edges drawn across a hole cross each other") as caught:
        fairing.fill(vertices, hole.triangles, [hole.loop], wires=[*wires.tolist(), [a, b]])
    assert caught.value.code == "NONMANIFOLD_EDGE"
    assert set(caught.value.elements.tolist()) == {a, b, *wires.ravel().tolist()}
    with pytest.raises(fairing.MeshError, match="form a ring"):
        middle = len(hole.vertices)
        more = np.concatenate([vertices, [[-0.05, 0.45, 0.0], [-0.05, 0.55, 0.0]]])
        ring = [[middle, middle + 1], [middle + 1, middle + 2], [middle + 2, middle]]
        fairing.fill(more, hole.triangles, [hole.loop], wires=[*wires.tolist(), *ring])
    with pytest.raises(fairing.MeshError, match="wires: row 0 names vertex 999999"):
        fairing.fill(vertices, hole.triangles, [hole.loop], wires=[[0, 999999]])


def test_a_hole_beside_a_hard_edge_takes_no_slope_from_the_other_side() -> None:
    """Its boundary runs along a box edge: flat to roundoff, where normals from beyond the edge make a bulge."""
    box = creased.box_edge(12, 1)
    flat = (np.abs(box.vertices[box.triangles][:, :, 0]) < 1e-12).all(axis=1)
    near = (np.linalg.norm(box.vertices - [0.0, 0.5, 0.0], axis=1) < 0.33)[box.triangles].all(axis=1)
    kept = box.triangles[~(flat & near)]
    gone = np.unique(box.triangles[flat & near])
    loop = next(loop for loop in fairing.boundary_loops(kept) if np.isin(loop, gone).all())
    beside, rounded = (fairing.fill(box.vertices, kept, [loop], edges=how).vertices for how in ("run_on", "ignored"))
    assert np.abs(beside[:, 0]).max() < 1e-9
    assert np.abs(rounded[:, 0]).max() > 0.01
    assert len(fairing.fill(box.vertices, kept, [loop]).curves) == 0


def test_where_no_surface_holds_the_edge_it_is_left_alone() -> None:
    """One step is too few along the curve: the smooth surface comes back, and the ends are named."""
    hole = creased.in_bent_sheet(14, 1)
    one = fairing.Options(solving=fairing.Solving(max_iterations=1, tolerance=1e-14))
    result, smooth = (filled(hole, edges=how, options=one) for how in ("run_on", "ignored"))
    (warning,) = [reported for reported in result.warnings if reported.code == "EDGES_LEFT_ALONE"]
    assert warning.figures["no_surface"] == 1.0
    assert np.abs(hole.vertices[warning.elements, 0]).max() < 1e-9
    assert result.curves == ()
    assert result.equation == smooth.equation
    assert len(result.vertices) == pytest.approx(len(smooth.vertices), rel=0.1)


def test_ends_that_lead_nowhere_are_named_and_the_hole_is_filled() -> None:
    """A box edge that fades out within the hole's outline: only one end comes to it."""
    fold = creased.fading_fold(16, 1, steep=1.2)
    hole = creased.cut_out(
        fold.vertices, fold.triangles, np.linalg.norm(fold.vertices[:, :2] - [0.0, 0.5], axis=1) < 0.33, ()
    )
    result = filled(hole)
    (warning,) = [reported for reported in result.warnings if reported.code == "EDGES_LEFT_ALONE"]
    assert warning.figures == {"ends": 1.0, "lonely": 1.0}
    assert np.abs(hole.vertices[warning.elements, 0]).max() < 1e-9
    assert str(warning).endswith(f"at vertex {warning.elements[0]}: no edge across it matches")
    assert result.curves == ()
    assert result.converged


# Bevels and rolled edges that end at a hole run on through it with their width and their profile.
TENTH = 0.1  # of the radius


def off(hole: Hole, radius: float, **options: object) -> float:
    """Largest distance of a new vertex to the exact surface, over the radius of the edge."""
    result = fairing.fill(hole.vertices, hole.triangles, [hole.loop], **options)  # type: ignore[arg-type]
    assert result.converged
    assert len(result.bands) == ("edges" not in options)
    assert len(result.curves) == 0
    points = np.concatenate([hole.vertices, result.vertices])
    for row in (row for band in result.bands for row in band):
        assert np.isin(row[[0, -1]], hole.loop).all()
        assert hole.sides[0](points[row]).max() < TENTH * radius
    assert result.join.max() < 15
    return float(hole.sides[0](result.vertices).max() / radius)


@pytest.mark.parametrize(
    ("n", "options", "bound"),
    [
        (20, {}, 0.05),
        (30, {}, 0.01),
        (24, {"rows": 3}, 0.05),
        (40, {"radius": 0.06}, 0.05),
        (24, {"taper": 0.3}, 0.05),
        (24, {"bend": 1.0}, TENTH),
        (24, {"bend": -0.7}, TENTH),
    ],
    ids=["coarse", "fine", "three rows", "narrow", "tapering", "a lid's rim", "a bore's rim"],
)
def test_a_rolled_edge_runs_on(n: int, options: dict[str, float], bound: float) -> None:
    hole = creased.in_bevel(n, 1, **options)  # type: ignore[arg-type]
    radius = options.get("radius", 0.12)
    assert off(hole, radius) < bound


def test_without_the_rule_it_swells() -> None:
    assert off(creased.in_bevel(20, 1), 0.12, edges="ignored") > 0.4


def test_a_band_that_ends_in_the_hole_is_no_band_through_it() -> None:
    """Its other side is flat: nothing is held inside."""
    hole = creased.in_bevel(20, 1)
    fade = np.clip((hole.vertices[:, 1] + 0.35) / 0.3, 0, 1)[:, None]
    onto = np.column_stack([hole.vertices[:, 0] - hole.vertices[:, 2], hole.vertices[:, 1], np.zeros(len(fade))])
    vertices = (1 - fade) * hole.vertices + fade * onto
    result = fairing.fill(vertices, hole.triangles, [hole.loop])
    assert result.converged
    assert set(result.fixed.tolist()) == set(hole.loop.tolist())
