"""The further generators keep their promises: checked without the engine."""

from __future__ import annotations

import numpy as np
import pytest

import connectivity
import graded
import measures
import shapes
import six_arms
import tetrathing
from shapes import Patch, Style

BASES = {"hemisphere": shapes.cap(60), "cylinder": shapes.cylinder(60, length=3.0), "catenoid": shapes.catenoid(60)}


def is_patch(patch: Patch) -> bool:
    """An oriented manifold whose border is exactly the fixed vertices, each with a free neighbour at least."""
    border = np.unique(measures.border_edges(patch.triangles))
    touching = patch.triangles[np.isin(patch.triangles, patch.free).any(axis=1)]
    return (
        measures.is_oriented_manifold(patch.triangles)
        and np.array_equal(border, np.sort(patch.fixed))
        and bool(np.isin(patch.fixed, touching).all())
    )


@pytest.mark.parametrize("name", BASES)
@pytest.mark.parametrize("n_free", [1000, 3000])
def test_graded_meshes(name: str, n_free: int) -> None:
    """Edge ratio about 40, aspects up to 12 and not far below, vertices on the surface, the size asked for."""
    patch = graded.regraded(BASES[name], n_free)
    assert is_patch(patch)
    assert abs(len(patch.free) - n_free) < 0.03 * n_free
    assert 25 < measures.edge_ratio(patch.vertices, patch.triangles) < 60
    assert 10 < measures.aspects(patch.vertices, patch.triangles).max() <= graded.ASPECT + 1e-9
    assert patch.distance(patch.vertices).max() < 1e-12


def test_graded_meshes_are_deterministic() -> None:
    one, other = (graded.regraded(BASES["hemisphere"], 500) for _ in range(2))
    assert np.array_equal(one.vertices, other.vertices)
    assert np.array_equal(one.triangles, other.triangles)


def test_aspect_of_single_triangles() -> None:
    """1 for an equilateral one; √3/2 · 10/2 with base 10 and height 2."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0.5, 0.5 * np.sqrt(3), 0], [0, 0, 0], [10, 0, 0], [4, 2, 0]])
    triangles = np.array([[0, 1, 2], [3, 4, 5]])
    assert np.allclose(measures.aspects(corners, triangles), [1.0, 2.5 * np.sqrt(3)])


def test_clusters_of_valence_three() -> None:
    """The share that was asked for, and many of them within one ring of another."""
    patch = shapes.cap(1000, Style(valence3=0.3, clusters=4))
    assert is_patch(patch)
    three = np.flatnonzero(measures.valences(patch.triangles, len(patch.vertices)) == 3)
    three = three[np.isin(three, patch.free)]
    assert len(three) >= 0.28 * len(patch.free)
    alone = shapes.cap(1000, Style(valence3=0.3))
    assert measures.valences(patch.triangles, len(patch.vertices)).max() > 10
    assert is_patch(alone)


@pytest.mark.parametrize("jitter", [0.0, 0.6, 0.9])
def test_six_arms(jitter: float) -> None:
    """A sphere with six holes; rims exactly on the cylinders."""
    made = six_arms.six_arms(1500, jitter=jitter)
    assert measures.is_oriented_manifold(made.triangles)
    assert measures.euler_number(made.triangles) == 2 - 6
    assert np.array_equal(np.unique(measures.border_edges(made.triangles)), made.fixed)
    assert np.abs(np.linalg.norm(made.fixed_normals, axis=1) - 1).max() < 1e-14
    reach = np.abs(made.vertices[made.fixed] - made.fixed_normals)
    assert np.abs(np.sort(reach, axis=1) - [0, 0, 2.5]).max() < 1e-12


def test_six_arms_face_outwards() -> None:
    """Normals of triangles at the rims agree with the prescribed ones."""
    made = six_arms.six_arms(1500, jitter=0.0)
    cross = np.cross(*(made.vertices[made.triangles[:, k]] - made.vertices[made.triangles[:, 0]] for k in (1, 2)))
    outward = np.zeros_like(made.vertices)
    outward[made.fixed] = made.fixed_normals
    assert (np.einsum("mk,mjk->m", cross, outward[made.triangles]) > -1e-3).all()


@pytest.mark.parametrize("times", [1, 2, 3])
def test_tetrathing(times: int) -> None:
    """Closed, genus 3, with six circles of 4 · 2^times fixed vertices."""
    made = tetrathing.tetrathing(times=times)
    assert measures.is_oriented_manifold(made.triangles)
    assert len(measures.border_edges(made.triangles)) == 0
    assert measures.euler_number(made.triangles) == 2 - 2 * 3
    assert len(made.fixed) == 6 * 4 * 2**times


def test_shuffled_connectivity() -> None:
    """Another mesh of the same topology, valences of free vertices bounded, curves of fixed vertices kept."""
    made = tetrathing.tetrathing(times=3)
    triangles = connectivity.shuffled(made.triangles, made.fixed, 0.3)
    assert measures.is_oriented_manifold(triangles)
    assert measures.euler_number(triangles) == -4
    changed = ~np.isin(measures.edges(triangles) @ [10**6, 1], measures.edges(made.triangles) @ [10**6, 1])
    assert changed.sum() > 0.1 * len(changed)
    free = np.setdiff1d(np.arange(len(made.vertices)), made.fixed)
    valence = measures.valences(triangles, len(made.vertices))[free]
    assert valence.min() >= 3
    assert valence.max() <= 10


def test_distance_to_a_mesh_of_all_sizes() -> None:
    """By octaves the same as by trying every triangle."""
    patch = graded.regraded(BASES["hemisphere"], 300)
    points = np.random.default_rng(3).standard_normal((200, 3))
    fast = measures.distance_to_mesh(points, patch.vertices, patch.triangles)
    slow = [
        min(measures.distance_to_mesh(point[None], patch.vertices, triangle[None])[0] for triangle in patch.triangles)
        for point in points[:20]
    ]
    assert np.abs(fast[:20] - slow).max() < 1e-14
