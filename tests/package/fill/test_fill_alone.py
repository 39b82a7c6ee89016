"""A hole is a job of its own: filled with others, in any order, it is what it is alone."""

import numpy as np

import fairing
from holes import FloatArray, IntArray
from test_fill_each import ball, caps


def random_holes(seed: int) -> tuple[FloatArray, IntArray, list[IntArray]]:
    """A dented ball with holes of some sizes, a few of which touch."""
    rng = np.random.default_rng(seed)
    vertices, triangles = ball(4)
    dents = rng.normal(size=(3, 3))
    vertices = vertices * (1.0 + 0.15 * np.sin(3.0 * vertices @ dents.T).prod(axis=1))[:, None]
    axes = rng.normal(size=(6, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    for axis, cosine in zip(axes, rng.uniform(0.95, 0.995, size=6), strict=True):
        triangles = caps(vertices, triangles, axis[None], float(cosine))
    found = fairing.borders.hole_loops(vertices, triangles)
    return vertices, triangles, [loop for loop in found.loops if len(loop) < 90]


def test_all_surfaces_are_those_of_the_holes() -> None:
    vertices, triangles, loops = random_holes(1)
    result = fairing.fill(vertices, triangles, loops)
    made = [hole.surface for hole in result.holes if hole.surface is not None]
    assert np.array_equal(result.vertices, np.concatenate([each.vertices for each in made]))
    assert len(result.triangles) == sum(len(each.triangles) for each in made)
    assert result.left_open == ()


def test_what_is_wrong_elsewhere_is_no_matter() -> None:
    """A doubled triangle and an edge with three of them, away from the hole."""
    vertices, triangles, loops = random_holes(2)
    near = np.isin(triangles, loops[0]).any(axis=1)
    far = triangles[~near & ~np.isin(triangles, np.concatenate(loops)).any(axis=1)]
    fin = np.array([[far[9, 0], far[9, 1], len(vertices)]])
    points = np.concatenate([vertices, [2.0 * vertices[far[9, 0]]]])
    wrong = np.concatenate([triangles, far[:1], fin])
    (found,) = fairing.fill(points, wrong, [loops[0]]).holes
    (plain,) = fairing.fill(vertices, triangles, [loops[0]]).holes
    assert found.surface is not None
    assert plain.surface is not None
    assert np.abs(found.surface.vertices - plain.surface.vertices).max() < 1e-9
