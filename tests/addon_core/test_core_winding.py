"""Faces of the selection that are wound against the others count as if they were not."""

from dataclasses import replace

import numpy as np
import pytest
from addon.arrays.region import MeshArrays
from addon.arrays.winding import with_one_winding
from addon.fair.solve import solve
from addon.options.options import FairOptions
from addon.verdict.outcome import outcome

from polygon_mesh import grid, grid_points, grid_quads, on_sphere, polygon_mesh

EYE = np.eye(4)
SIZE = 12


def sphere(turned: np.ndarray) -> MeshArrays:
    """A side of a cubic sphere with its middle selected, some faces wound the other way round."""
    quads = [quad[::-1] if face in turned else quad for face, quad in enumerate(grid_quads(SIZE))]
    selected = grid(SIZE, 0.6).in_patch
    return polygon_mesh(on_sphere(grid_points(SIZE)), quads, selected)


def some_of(chosen: np.ndarray, every: int) -> np.ndarray:
    return np.flatnonzero(chosen)[::every]


def directed(mesh: MeshArrays) -> set[tuple[int, int]]:
    loops = mesh.corner_vertices.reshape(-1, 4)[mesh.in_patch]
    return {(int(a), int(b)) for loop in loops for a, b in zip(loop, np.roll(loop, -1), strict=True)}


@pytest.mark.parametrize("every", [3, 7])
def test_few_faces_are_turned_to_the_others(every: int) -> None:
    plain = sphere(np.array([]))
    some = some_of(plain.in_patch, every)
    mesh, count = with_one_winding(sphere(some))
    assert count == len(some)
    assert directed(mesh) == directed(plain)
    a, b, c = (mesh.positions[mesh.triangles[mesh.in_patch[mesh.triangle_faces]][:, k]] for k in range(3))
    assert (np.einsum("ij,ij->i", np.cross(b - a, c - a), a) > 0.0).all()
    ends = np.sort(np.column_stack([mesh.corner_vertices.reshape(-1, 4).ravel(), _following(mesh)]), axis=1)
    np.testing.assert_array_equal(ends, np.sort(mesh.edges[mesh.corner_edges], axis=1))


def _following(mesh: MeshArrays) -> np.ndarray:
    return np.roll(mesh.corner_vertices.reshape(-1, 4), -1, axis=1).ravel()


def test_custom_normals_stay_with_their_corners() -> None:
    plain = sphere(np.array([]))
    some = some_of(plain.in_patch, 7)
    spoilt = sphere(some)
    normals = spoilt.positions[spoilt.corner_vertices]  # those of turned faces point in, as Blender gives them
    normals[np.isin(spoilt.corner_faces, some)] *= -1.0
    mesh, _ = with_one_winding(replace(spoilt, corner_normals=normals))
    np.testing.assert_array_equal(mesh.corner_normals, mesh.positions[mesh.corner_vertices])


def test_the_result_and_what_is_said_of_it_are_those_of_a_clean_mesh() -> None:
    """Normals along the outline would point to both sides, and each turned face would look like a kink of 180°."""
    plain = sphere(np.array([]))
    options = FairOptions()
    clean, spoilt = (
        outcome(mesh, EYE, options, solve(mesh, EYE, options)) for mesh in (plain, sphere(some_of(plain.in_patch, 3)))
    )
    np.testing.assert_allclose(spoilt.positions, clean.positions, atol=1e-9)
    assert spoilt.verdict.grade == "GOOD"
    assert spoilt.join.worst == pytest.approx(clean.join.worst, abs=1e-6)
    assert set(spoilt.warnings) - set(clean.warnings) == {
        f"{len(some_of(plain.in_patch, 3))} faces are wound against the others; a copy with one winding was solved"
    }
