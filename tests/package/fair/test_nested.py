"""Levels, and meshes of the engine's own: faster, or where the mesh given can't carry the equation."""

import itertools

import numpy as np
import pytest

import fairing
import shapes
import solids
from curves import FloatArray
from grids import halves, numbered
from shapes import Patch, Style
from solving import fair_patch

PATCHES = {
    "hemisphere": lambda: shapes.cap(5000),
    "catenoid": lambda: shapes.catenoid(5000),
    "pipe": lambda: shapes.cylinder(4000, Style(seed=2)),
    "clothoid cylinder": lambda: shapes.clothoid(4000),
}


@pytest.mark.parametrize("name", PATCHES)
def test_levels_change_the_way_and_not_the_surface(name: str) -> None:
    """Both solve one discrete equation to 1e-10, so they end within some 1e-9 D of each other."""
    patch: Patch = PATCHES[name]()
    nested = fair_patch(patch, tolerance=1e-10)
    plain = fair_patch(patch, tolerance=1e-10, levels=1)
    assert nested.converged
    assert plain.converged
    assert len(nested.levels) > 1
    assert list(nested.levels) == sorted(nested.levels)
    assert nested.levels[-1] == len(patch.vertices)
    assert plain.levels == (len(patch.vertices),)
    assert np.abs(nested.vertices - plain.vertices).max() <= 1e-8 * patch.diameter


def test_the_split_operator_leads_to_the_same_sphere() -> None:
    """Beyond 15,000 free vertices K is inverted to parts in a thousand: the iteration ends where the equation does."""
    patch = shapes.cap(18_000)
    result = fair_patch(patch, tolerance=1e-11)
    assert result.converged
    assert len(result.levels) > 1
    assert result.iterations <= 14
    assert patch.error(result.vertices) <= 1e-8
    again = fair_patch(patch, tolerance=1e-11, threads=1)
    assert np.array_equal(again.vertices, result.vertices)


@pytest.mark.parametrize("quads", [30, 44, 60])
def test_extraordinary_vertices_are_passed(quads: int) -> None:
    """Next to a cube's corners vertices move over several edges from one level to the next, within the surface."""
    vertices, triangles, fixed = solids.cube_cap(quads)
    start = np.zeros_like(vertices)
    start[fixed] = vertices[fixed]
    result = fairing.fair(start, triangles, fixed=fixed, fixed_normals=vertices[fixed], tolerance=1e-10)
    assert result.converged
    assert len(result.levels) > 1
    assert result.iterations <= 16
    assert np.abs(np.linalg.norm(result.vertices, axis=1) - 1).max() <= 1e-8


# Connectivity that can't carry the equation: the surface is solved on a proxy mesh.
def finger(around: int, layers: int) -> tuple[FloatArray, shapes.IntArray, FloatArray]:
    """A long thimble's connectivity over the rim of a hemisphere; rim first, with its normals.

    Balanced evenly, ring k of such a mesh shrinks like exp(−2π k / around): crowded beyond double
    precision near the tip, whatever the surface.
    """
    angle = 2 * np.pi * np.arange(around) / around
    rim = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(around)])
    count = around * layers + 1
    rings = numbered(layers, around)
    walls = halves(np.column_stack([rings, rings[:, 0]]))[:, ::-1]
    tip = np.column_stack([rings[-1], np.roll(rings[-1], -1), np.full(around, count - 1)])
    vertices = np.zeros((count, 3))
    vertices[:around] = rim
    return vertices, np.vstack([walls, tip]), rim


@pytest.mark.parametrize(
    ("around", "layers", "limit", "curvature"),
    [*((a, n, 1e-4, 2e-2) for a, n in ((24, 20), (24, 60), (16, 60))), (40, 100, 2e-5, 5e-3)],
)
def test_a_crowded_mesh_lies_on_the_sphere(around: int, layers: int, limit: float, curvature: float) -> None:
    """Within a share of D, with its H, although H of a large mesh itself is noise near the tip."""
    vertices, triangles, rim = finger(around, layers)
    result = fairing.fair(vertices, triangles, fixed=np.arange(around), fixed_normals=rim)
    assert result.converged
    assert np.abs(np.linalg.norm(result.vertices, axis=1) - 1).max() / 2 < limit
    assert result.vertices[:, 2].min() > -1e-9
    # of the unit sphere; a last step of 1e-6 D shows in H as 1e-6 / h²
    np.testing.assert_allclose(result.mean_curvature, -1.0, atol=curvature)
    assert not len(fairing.looks.flipped_triangles(result.vertices, triangles))


def test_coarse_levels_are_subsets_with_all_of_the_boundary() -> None:
    patch = shapes.cap(4000)
    levels = fairing.hierarchy(patch.vertices, patch.triangles, fixed=patch.fixed)
    assert len(levels) > 2
    assert np.array_equal(levels[-1][1], patch.triangles)
    for (coarse, triangles), (fine, _) in itertools.pairwise(levels):
        assert len(coarse) < 0.7 * len(fine) and np.isin(coarse, fine).all() and np.isin(patch.fixed, coarse).all()
        assert np.array_equal(np.unique(triangles), coarse)
        assert len(coarse) - len(fairing.edges_with_uses(triangles)[0]) + len(triangles) == 1  # a disc
    assert [len(level) for level, _ in fairing.hierarchy(patch.vertices, patch.triangles, levels=2)] == [
        len(level) for level, _ in levels[-2:]
    ]
