"""Long edges of a boundary in several: all arrays of the mesh go along."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import fairing
from core.border import border_loops
from core.fill_pieces import FillOptions
from core.filling import fill
from core.options import FairOptions
from core.region import MeshArrays
from core.remeshing import remesh_arrays
from core.subdivided import with_subdivided_patch
from core.verdict import GOOD
from polygon_mesh import grid, polygon_mesh

EYE = np.eye(4)


def box(open_top: bool) -> MeshArrays:
    """A box of 2 × 2 × 2 of six squares; the top is missing, or the patch."""
    points = np.array([[x, y, z] for z in (-1.0, 1.0) for y in (-1.0, 1.0) for x in (-1.0, 1.0)])
    sides = [[0, 2, 3, 1], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]]
    if open_top:
        return polygon_mesh(points, sides, np.zeros(5, dtype=bool))
    return polygon_mesh(points, [*sides, [4, 5, 7, 6]], [False] * 5 + [True])


def test_faces_beside_the_edges_become_polygons_and_all_fits() -> None:
    mesh = box(open_top=False)
    top = (mesh.positions[mesh.edges][:, :, 2] > 0).all(axis=1)
    mesh = replace(mesh, sharp=top, lines={"seam": top})
    parted = with_subdivided_patch(mesh, mesh.positions, 0.25)
    whole = parted.mesh
    assert len(parted.ends) == 4 * 3
    np.testing.assert_array_equal(whole.positions[:8], mesh.positions)
    assert sorted(np.bincount(whole.corner_faces).tolist()) == [4, 7, 7, 7, 7, 16]
    after = np.arange(len(whole.corner_vertices)) + 1
    last = np.flatnonzero(np.diff(whole.corner_faces, append=-1))
    after[last] = np.concatenate([[0], last[:-1] + 1])
    sides = np.sort(np.column_stack([whole.corner_vertices, whole.corner_vertices[after]]), axis=1)
    np.testing.assert_array_equal(sides, np.sort(whole.edges[whole.corner_edges], axis=1))
    assert (np.bincount(whole.corner_edges) == 2).all()
    on_top = (whole.positions[whole.edges][:, :, 2] > 0).all(axis=1)
    assert np.array_equal(whole.sharp, on_top)
    assert np.array_equal(whole.lines["seam"], on_top)
    corners = whole.positions[whole.triangles]
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    np.testing.assert_allclose(np.bincount(whole.triangle_faces, areas), 4.0)
    assert not fairing.boundary_loops(whole.triangles)


def test_nothing_is_parted_where_edges_are_as_wanted() -> None:
    mesh = grid(8, 0.5)
    assert with_subdivided_patch(mesh, mesh.positions, 1.0).mesh is mesh
    assert with_subdivided_patch(mesh, mesh.positions, 2.0).mesh is mesh


@pytest.mark.parametrize("scale", [1.0, 50.0])
def test_a_coarse_hole_gets_edges_as_wanted(scale: float) -> None:
    """Edges of the new surface; without it they are as long as the boundary's beside it."""
    mesh = box(open_top=True)
    seeds = mesh.positions[:, 2] > 0
    loops, _ = border_loops(mesh, seeds)
    matrix = np.diag([scale, scale, scale, 1.0])
    counts = {}
    for subdivides in (False, True):
        options = FillOptions(equation="SOAP_FILM", spacing=0.2, subdivide_boundary=subdivides)
        filled = fill(mesh, matrix, loops, options)
        (piece,) = filled.pieces
        assert piece.verdict.grade == GOOD
        assert np.abs(piece.positions[:, 2] - 1.0).max() < 1e-6
        counts[subdivides] = len(piece.outline), len(piece.positions)
        assert (filled.parted is not None) == subdivides
    assert counts[False][0] == 4
    assert counts[True][0] == 20
    flat = piece.points / scale
    sides = np.sort(piece.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    lengths = np.linalg.norm(flat[sides[:, 0]] - flat[sides[:, 1]], axis=1)
    assert 0.15 < lengths.min() <= lengths.max() < 0.8


def test_a_coarse_patch_gets_edges_as_wanted() -> None:
    """The top of a box of six faces, on a mesh of its own."""
    mesh = box(open_top=False)
    done = remesh_arrays(mesh, EYE, FairOptions(mesh="NEW", spacing=0.2, subdivide_boundary=True))
    assert done.parted is not None
    assert len(done.part.stay) == 4 + 4 * 4
    assert np.abs(done.new_positions[:, 2] - 1.0).max() < 1e-6
    sides = np.sort(done.part.triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    lengths = np.linalg.norm(done.points[sides[:, 0]] - done.points[sides[:, 1]], axis=1)
    assert lengths.max() < 0.8
    assert done.verdict.spots.max(initial=0) < 8


def test_a_refusal_names_vertices_that_are_there() -> None:
    """The parted boundary has more; in a fill and on a new mesh."""
    mesh = box(open_top=True)
    loops, _ = border_loops(mesh, mesh.positions[:, 2] > 0)
    options = FillOptions(equation="SOAP_FILM", spacing=0.2, subdivide_boundary=True, max_vertices=3)
    closed = box(open_top=False)
    few = FairOptions(mesh="NEW", spacing=0.2, subdivide_boundary=True, max_vertices=3)
    for run in (lambda: fill(mesh, EYE, loops, options), lambda: remesh_arrays(closed, EYE, few)):
        with pytest.raises(fairing.MeshError, match="3 are accepted") as refused:
            run()
        assert len(refused.value.elements)
        assert set(refused.value.elements.tolist()) <= {4, 5, 6, 7}
