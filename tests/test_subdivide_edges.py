"""Long edges are parted, and a coarse outline gets a new mesh as fine as wanted."""

from __future__ import annotations

import numpy as np
import pytest

import fairing
import measures
import solids
from hard_holes import FloatArray, IntArray


def area(vertices: FloatArray, triangles: IntArray) -> float:
    corners = vertices[triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(across, axis=1).sum() / 2)


def top_of_box() -> tuple[FloatArray, IntArray, IntArray]:
    """A box of 2 × 2 × 2 with one square to a side, without its top: vertices, triangles, and the hole's loop."""
    vertices, triangles = solids.box(1)
    top = (vertices[triangles][:, :, 2] > 1 - 1e-9).all(axis=1)
    (loop,) = fairing.boundary_loops(triangles[top])
    return vertices, triangles[~top], loop


@pytest.mark.parametrize("length", [0.1, 0.35, 1.0, 5.0])
def test_edges_are_parted_in_equal_pieces(length: float) -> None:
    """Each about as long as wanted; the surface is the same, and the pieces of both triangles at an edge fit."""
    vertices, triangles, loop = top_of_box()
    edges = np.column_stack([loop, np.roll(loop, -1)])
    parted = fairing.subdivide_edges(vertices, triangles, edges, length)
    pieces = max(1, round(2.0 / length))
    assert len(parted.vertices) == 8 + 4 * (pieces - 1)
    assert np.array_equal(parted.vertices[:8], vertices)
    whole = parted.along(loop)
    steps = np.linalg.norm(parted.vertices[np.roll(whole, -1)] - parted.vertices[whole], axis=1)
    np.testing.assert_allclose(steps, 2.0 / pieces)
    assert area(parted.vertices, parted.triangles) == pytest.approx(area(vertices, triangles))
    (border,) = fairing.boundary_loops(parted.triangles)
    assert set(border.tolist()) == set(whole.tolist())
    np.testing.assert_allclose(
        parted.vertices[8:],
        (1 - parted.shares[:, None]) * vertices[parted.ends[:, 0]]
        + parted.shares[:, None] * vertices[parted.ends[:, 1]],
    )
    for piece, parent in zip(parted.triangles, parted.parent, strict=True):
        corners, own = parted.vertices[piece], vertices[triangles[parent]]
        normal = np.cross(own[1] - own[0], own[2] - own[0])
        assert np.abs((corners - own[0]) @ normal).max() < 1e-12
        assert np.cross(corners[1] - corners[0], corners[2] - corners[0]) @ normal > 1e-9


def test_every_edge_of_a_closed_mesh_may_be_parted() -> None:
    vertices, triangles = solids.box(1)
    parted = fairing.subdivide_edges(vertices, triangles, measures.edges(triangles), 0.4)
    assert not fairing.boundary_loops(parted.triangles)
    assert area(parted.vertices, parted.triangles) == pytest.approx(24.0)
    assert np.linalg.norm(np.diff(parted.vertices[measures.edges(parted.triangles)], axis=1), axis=2).max() < 3.0


def test_a_hole_of_four_edges_is_filled_as_finely_as_wanted() -> None:
    """Without it one vertex, or few, beside edges of length 2; with it all new edges are about as long as wanted."""
    vertices, triangles, loop = top_of_box()
    length = 0.25
    parted = fairing.subdivide_edges(vertices, triangles, np.column_stack([loop, np.roll(loop, -1)]), length)
    result = fairing.fill(parted.vertices, parted.triangles, [parted.along(loop)], spacing=length, equation="soap_film")
    assert np.abs(result.vertices[:, 2] - 1.0).max() < 1e-9
    points = np.concatenate([parted.vertices, result.vertices])
    lengths = np.linalg.norm(np.diff(points[measures.edges(result.triangles)], axis=1)[:, 0], axis=1)
    assert 0.5 * length < lengths.min() <= lengths.max() < 1.7 * length
    assert area(points, result.triangles) == pytest.approx(4.0)


def test_bad_input_is_named() -> None:
    vertices, triangles, loop = top_of_box()
    with pytest.raises(fairing.MeshError, match="edges: row 0 names vertex 99"):
        fairing.subdivide_edges(vertices, triangles, [[0, 99]], 1.0)
    with pytest.raises(ValueError, match="length"):
        fairing.subdivide_edges(vertices, triangles, [[int(loop[0]), int(loop[1])]], 0.0)
