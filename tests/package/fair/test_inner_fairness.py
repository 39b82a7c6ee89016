"""Where vertices sit within the surface: Σ λ_ij q_j − q_i is parallel to the normal (§7.3)."""

import numpy as np
import pytest

import fairing
import measures
import random_inputs
import shapes
from curves import FloatArray
from meshing import IntArray
from shapes import Patch, Style
from solving import fair_patch

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


@pytest.mark.parametrize("kind", ["conformal", "shape_preserving"])
def test_a_planar_mesh_is_reproduced(kind: str) -> None:
    """Both weights reproduce linear functions: every flat mesh is its own fair mesh."""
    patch = shapes.plane(500)
    result = fair_patch(patch, inner_fairness=kind, reference=patch.vertices)
    assert np.abs(result.vertices - patch.vertices).max() < 1e-8
    uniform = fair_patch(patch)
    assert np.abs(uniform.vertices - patch.vertices).max() > 1e-2


def lopsided_rows(edges: IntArray) -> FloatArray:
    """Rows (i, j, λ) with λ_ij from 1 to 4 and λ_ji of its own: far from symmetric."""
    both = np.vstack([edges, edges[:, ::-1]])
    weights = np.random.default_rng(3).uniform(1.0, 4.0, len(both))
    return np.column_stack([both, weights])


@pytest.mark.parametrize("name", CURVED)
def test_custom_weights_are_balanced_and_leave_the_surface_alone(name: str) -> None:
    patch = CURVED[name]
    rows = lopsided_rows(measures.edges(patch.triangles))
    weights = np.zeros((len(patch.vertices),) * 2)
    weights[rows[:, 0].astype(int), rows[:, 1].astype(int)] = rows[:, 2]
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
    rows = np.column_stack([np.vstack([edges[free], edges[free][:, ::-1]]), np.ones(2 * free.sum())])
    with pytest.raises(ValueError, match=r"inner_fairness: (no chain of positive weights|vertex .* needs a row)"):
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


def test_where_no_mesh_of_the_users_carries_the_equation_all_weights_have_one_surface() -> None:
    """Few vertices, an outline of wild normals: each is placed on the surface of the engine's own mesh."""
    patch = random_inputs.make_patch("disc", 40, 119, height=1.0, noise=0.6)
    even = patch.fair()
    result = patch.fair(inner_fairness="inverse_distance")
    assert even.converged
    assert result.converged
    assert not result.polished
    rim = patch.fixed
    assert np.abs(result.mean_curvature[rim] - even.mean_curvature[rim]).max() < 1e-12
    assert result.mean_curvature.min() >= even.mean_curvature.min() - 1e-12
    assert result.mean_curvature.max() <= even.mean_curvature.max() + 1e-12
    assert np.abs(result.vertices - even.vertices).max() > 1e-3
