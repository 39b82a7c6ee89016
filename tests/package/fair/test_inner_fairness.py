"""Where vertices sit within the surface, and warnings that name their elements."""

import numpy as np
import pytest

import fairing
import measures
import shapes
from curves import FloatArray
from grids import halves, numbered
from meshing import IntArray, face_normals
from shapes import Patch, Style
from solving import codes, fair_patch

CURVED = {"cap": shapes.cap(500), "linear_flux": shapes.linear_flux(500)}


def uniform_weights(edges: IntArray, count: int) -> FloatArray:
    """λ (count, count), dense, 1/m."""
    weights = np.zeros((count, count))
    weights[edges[:, 0], edges[:, 1]] = weights[edges[:, 1], edges[:, 0]] = 1.0
    return np.asarray(weights / np.maximum(weights.sum(axis=1), 1.0)[:, None])


def tangential_imbalance(patch: Patch, result: fairing.FairResult, weights: FloatArray) -> float:
    """Largest tangential part of Σ λ_ij q_j − q_i, over the mean edge.

    Two rings off the outline: nearer to it the solver's normals know the prescribed ones.
    """
    ends = result.vertices[measures.edges(patch.triangles)]
    edge = np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).mean()
    normals = fairing.vertex_normals(result.vertices, patch.triangles)
    delta = weights @ result.vertices - result.vertices
    tangential = delta - (delta * normals).sum(axis=1)[:, None] * normals
    away = measures.beyond_rings(patch.triangles, patch.fixed, 2)
    return float(np.linalg.norm(tangential, axis=1)[away].max() / edge)


@pytest.mark.parametrize("name", CURVED)
def test_uniform_is_balanced(name: str) -> None:
    """At 1e-10 D per step a vertex is within about 1e-6 edges of its place."""
    patch = CURVED[name]
    weights = uniform_weights(measures.edges(patch.triangles), len(patch.vertices))
    assert tangential_imbalance(patch, fair_patch(patch), weights) < 1e-6
    conformal = fair_patch(patch, inner_fairness="conformal", reference=patch.vertices)
    assert tangential_imbalance(patch, conformal, weights) > 0.05


def test_a_planar_mesh_is_reproduced() -> None:
    """Conformal weights reproduce linear functions: a flat mesh is its own fair mesh, sheared from Delaunay's, too."""
    patch = shapes.plane(500)
    patch.vertices[:, 2] += 1.5 * patch.vertices[:, 1]
    result = fair_patch(patch, inner_fairness="conformal", reference=patch.vertices)
    assert np.abs(result.vertices - patch.vertices).max() < 1e-8
    assert np.abs(fair_patch(patch).vertices - patch.vertices).max() > 1e-2


@pytest.mark.parametrize("name", CURVED)
def test_custom_weights_are_balanced_and_leave_the_surface_alone(name: str) -> None:
    patch = CURVED[name]
    edges = measures.edges(patch.triangles)
    rows = np.column_stack([edges, np.random.default_rng(3).uniform(1.0, 4.0, len(edges))])
    weights = np.zeros((len(patch.vertices),) * 2)
    weights[edges[:, 0], edges[:, 1]] = weights[edges[:, 1], edges[:, 0]] = rows[:, 2]
    weights /= weights.sum(axis=1)[:, None]
    result = fair_patch(patch, inner_fairness=rows)
    assert result.converged
    assert tangential_imbalance(patch, result, weights) < 1e-6
    uniform = fair_patch(patch)
    assert np.abs(result.vertices - uniform.vertices).max() > 1e-2
    assert patch.error(result.vertices) < 2.0 * patch.error(uniform.vertices) + 1e-9


def test_custom_weights_that_lead_to_no_fixed_vertex_are_refused() -> None:
    patch = CURVED["cap"]
    edges = measures.edges(patch.triangles)
    free = np.isin(edges, patch.free).all(axis=1)
    rows = np.column_stack([edges[free], np.ones(free.sum())])
    with pytest.raises(ValueError, match="inner_fairness: no chain of positive weights"):
        fair_patch(patch, inner_fairness=rows)


def quad_edges(patch: Patch, quads: int) -> IntArray:
    """Edges of the grid's quads: triangles k and k + quads share the diagonal of quad k."""
    first, second = patch.triangles[:quads], patch.triangles[quads:]
    shared = [np.intersect1d(a, b) for a, b in zip(first, second, strict=True)]
    diagonals = {tuple(pair) for pair in np.sort(shared, axis=1).tolist()}
    edges = measures.edges(patch.triangles)
    return np.array([edge for edge in edges.tolist() if tuple(edge) not in diagonals])


def test_neighbours_of_quads_leave_the_diagonals_out() -> None:
    patch = shapes.cylinder(400, Style(layout="grid", jitter=0.2))
    edges = quad_edges(patch, len(patch.triangles) // 2)
    assert len(edges) < len(measures.edges(patch.triangles))
    result = fair_patch(patch, neighbours=edges)
    weights = uniform_weights(edges, len(patch.vertices))
    assert tangential_imbalance(patch, result, weights) < 1e-6
    assert np.abs(result.vertices - fair_patch(patch).vertices).max() > 1e-3


# What a result says about itself: warnings that name their elements.
CAP = shapes.cap(400)


def ribbon(degrees: float, across: int = 8, per_turn: int = 100) -> tuple[FloatArray, IntArray]:
    """A ribbon around a circle whose tilt goes from one side to the other in a full turn.

    Beyond 360° it passes through itself along its middle line.
    """
    along = int(per_turn * degrees / 360.0)
    angle, radius = np.meshgrid(np.radians(np.linspace(0, degrees, along + 1)), np.linspace(0.7, 1.3, across + 1))
    height = 0.5 * (radius - 1.0) * np.cos(angle / 2.0)
    vertices = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1).reshape(-1, 3)
    return vertices, halves(numbered(*angle.shape))


def test_a_surface_through_itself_is_reported() -> None:
    """Crossings lie on the middle line of the doubled part, and nowhere else."""
    vertices, triangles = ribbon(430.0)
    result = fairing.fair(vertices, triangles)
    assert result.converged
    (warning,) = (w for w in result.warnings if w.code == "SELF_INTERSECTION")
    assert warning.kind == "triangle"
    crossing = result.vertices[triangles[warning.elements]].mean(axis=1)
    angle = np.degrees(np.arctan2(crossing[:, 1], crossing[:, 0])) % 360.0
    assert len(crossing) >= 2 * 70 / 360 * 100
    assert ((angle < 75.0) | (angle > 355.0)).all()
    assert np.abs(np.hypot(crossing[:, 0], crossing[:, 1]) - 1.0).max() < 0.15
    assert np.array_equal(fairing.self_intersections(result.vertices, triangles), warning.elements)
    assert "SELF_INTERSECTION" not in codes(fairing.fair(*ribbon(350.0)))


def test_self_intersections_of_any_triangles() -> None:
    """Two squares through each other, though nothing joins them; side by side they don't cross, nor with NaN."""
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    upright = square[:, [0, 2, 1]] + np.array([0.0, 0.4, -0.5])
    triangles = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]])
    both = np.vstack([square, upright])
    assert fairing.self_intersections(both, triangles).tolist() == [0, 1, 2, 3]
    assert not len(fairing.self_intersections(np.vstack([square, square + np.array([0.0, 0.0, 0.1])]), triangles))
    assert fairing.self_intersections(both, triangles, near=[0]).tolist() == [0, 2, 3]  # 1 crosses these, but not 0
    assert fairing.self_intersections(both, triangles, near=[3, 2]).tolist() == [0, 1, 2, 3]
    assert not len(fairing.self_intersections(both, triangles, near=[]))
    both[3] = np.nan
    assert fairing.self_intersections(both, triangles).tolist() == [0, 2, 3]
    assert fairing.self_intersections(both, triangles, near=[2]).tolist() == [0, 2]
    assert not len(fairing.self_intersections(both, triangles, near=[1]))
    for wrong in ([4], [-1]):
        with pytest.raises(ValueError, match=f"no triangle {wrong[0]}"):
            fairing.self_intersections(both, triangles, near=wrong)


def test_flipped_triangles_are_those_around_a_vertex_dragged_across_an_edge() -> None:
    """In the plane the turned triangles are those with a negative area."""
    patch = shapes.plane(300)
    assert not len(fairing.looks.flipped_triangles(patch.vertices, patch.triangles))
    vertices = patch.vertices.copy()
    middle = patch.free[np.linalg.norm(vertices[patch.free], axis=1).argmin()]
    triangle = next(t for t in patch.triangles if middle in t)
    opposite = vertices[triangle[triangle != middle]].mean(axis=0)
    vertices[middle] += 1.4 * (opposite - vertices[middle])
    upwards = face_normals(patch.vertices, patch.triangles)[0]
    turned = np.flatnonzero(face_normals(vertices, patch.triangles) @ upwards < 0.0)
    assert len(turned) > 0
    assert np.array_equal(fairing.looks.flipped_triangles(vertices, patch.triangles, fixed=patch.fixed), turned)


@pytest.mark.parametrize("kind", ["conformal", "inverse_distance"])
def test_a_reference_that_carries_no_texture_is_reported_and_left_out(kind: str) -> None:
    """A crumpled or a collapsed M0: the answer is the uniform one, bit for bit."""
    uniform = fair_patch(CAP)
    collapsed = CAP.vertices.copy()
    collapsed[CAP.free] = collapsed[CAP.fixed].mean(axis=0)
    for reference in (shapes.start_from_nothing(CAP, "point"), collapsed):
        result = fair_patch(CAP, inner_fairness=kind, reference=reference)
        (warning,) = (w for w in result.warnings if w.code == "REFERENCE_UNUSABLE")
        assert len(warning.elements) > len(CAP.triangles) / 10
        assert np.array_equal(result.vertices, uniform.vertices)
    assert "REFERENCE_UNUSABLE" not in codes(fair_patch(CAP, inner_fairness=kind, reference=CAP.vertices))


def test_weights_that_turn_triangles_over_give_way_to_uniform_ones() -> None:
    """A planar mesh with λ that pull half of the vertices to one neighbour each, past the others."""
    patch = shapes.plane(300)
    edges = measures.edges(patch.triangles)
    both = np.vstack([edges, edges[:, ::-1]])
    uniform = fair_patch(patch)
    rng = np.random.default_rng(1)
    rows = np.column_stack([both, rng.uniform(0.0, 1.0, len(both)) ** 12])
    ends = rng.integers(len(patch.vertices), size=(len(patch.free), 2))
    far = np.column_stack([patch.free, ends[:, 0], np.full(len(patch.free), 50.0)])
    result = fair_patch(patch, inner_fairness=np.vstack([rows, far[far[:, 0] != far[:, 1]]]))
    (warning,) = (w for w in result.warnings if w.code == "FLIPPED_TRIANGLES")
    assert "uniform" in warning.message
    assert np.abs(result.vertices - uniform.vertices).max() < 1e-8


def test_coordinates_too_far_from_the_origin_are_reported() -> None:
    """Doubles near 1e12 are 1e-4 apart; edges of the patch are 0.06 long."""
    near = fairing.fair(CAP.vertices + 1e6, CAP.triangles, fixed=CAP.fixed, fixed_normals=CAP.fixed_normals)
    assert "PRECISION" not in codes(near)
    far = fairing.fair(CAP.vertices + 1e12, CAP.triangles, fixed=CAP.fixed, fixed_normals=CAP.fixed_normals)
    assert "PRECISION" in codes(far)
    assert np.isfinite(far.vertices).all()
