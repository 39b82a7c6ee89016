"""Slopes and curvatures at a boundary come from its own side of hard edges."""

import numpy as np
import pytest

import fairing
import solids
from solids import FloatArray, IntArray

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


@pytest.mark.parametrize("continuity", ["G1", "G2"])
@pytest.mark.parametrize("rings", [1, 1.5, 2, 3])
def test_a_crease_beside_the_boundary_does_not_bend_the_join(rings: float, continuity: str) -> None:
    """Fits across it give .01 to .12."""
    panel = solids.panel(rings)
    found = fairing.surrounding_normals(panel.vertices, panel.outside, panel.rim)
    result = fairing.fair(
        panel.vertices, panel.inside, fixed=panel.rim, fixed_normals=found.normals, outside=panel.outside,
        continuity=continuity,
    )  # fmt: skip
    assert panel.error(result.vertices) < 1e-3


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


def test_a_ring_between_two_walls_is_flat_again() -> None:
    """Noise on the end of a thick pipe counts for nothing."""
    radii = np.concatenate([np.ones(11), np.linspace(0.925, 0.4, 8), np.full(10, 0.4)])
    heights = np.concatenate([np.linspace(-1.0, 0.0, 11), np.zeros(8), np.linspace(-0.1, -1.0, 10)])
    points, triangles = turned(radii, heights)
    top = points[triangles, 2].min(axis=1) == 0.0
    free = slice(11 * AROUND, 18 * AROUND)
    points[free, 2] += 0.05 * np.random.default_rng(0).normal(size=7 * AROUND)
    (made, _), _ = fairing.fair_faces((points, triangles), np.flatnonzero(top))
    assert np.abs(made[free, 2]).max() < 1e-6


def turned(radii: FloatArray, heights: FloatArray) -> tuple[FloatArray, IntArray]:
    """A surface of revolution, from one end of its profile to the other: vertices, triangles."""
    angles = 2.0 * np.pi * np.arange(AROUND) / AROUND
    rings = [[r * np.cos(angles), r * np.sin(angles), np.full(AROUND, z)] for r, z in zip(radii, heights, strict=True)]
    points = np.moveaxis(np.array(rings), 1, 2).reshape(-1, 3)
    first = np.arange((len(radii) - 1) * AROUND)
    second = first - first % AROUND + (first + 1) % AROUND
    halves = [[first, second, second + AROUND], [first, second + AROUND, first + AROUND]]
    return points, np.concatenate([np.column_stack(corners) for corners in halves])
