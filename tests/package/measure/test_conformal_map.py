"""fairing.maps.conformal_map: exact maps come back; a border that is fixed all around makes it harmonic."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.linalg import spsolve

import fairing
import holes
import shapes
from holes import FloatArray, IntArray


def tilted_sheet(cells: int = 8) -> tuple[FloatArray, FloatArray, IntArray]:
    """(n, 2) a jittered square, (n, 3) the same somewhere in space, and its triangles."""
    flat, triangles = holes.sheet(lambda u, v: (u, v, 0 * u), (cells, cells), lambda u, v: np.zeros(len(u), bool))
    turned, _ = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))
    return flat[:, :2], flat @ turned.T * np.sign(np.linalg.det(turned)) + [3.0, -1.0, 2.0], triangles


def test_a_flat_piece_is_laid_out_from_two_neighbours() -> None:
    """The map is a similarity there, whatever lies between."""
    flat, points, triangles = tilted_sheet()
    scale, turn = 0.3, np.exp(0.7j)
    wanted = (flat @ [1, 1j]) * scale * turn
    places = np.column_stack([wanted.real, wanted.imag])
    found = fairing.maps.conformal_map(points, triangles, [3, 12], places[[3, 12]])
    np.testing.assert_allclose(found, places, atol=1e-9)


def test_a_fixed_border_makes_it_harmonic() -> None:
    patch = shapes.cap(400)
    rng = np.random.default_rng(0)
    given = patch.vertices[patch.fixed, :2] * [1.0, 0.5] + 0.05 * rng.normal(size=(len(patch.fixed), 2))
    found = fairing.maps.conformal_map(patch.vertices, patch.triangles, patch.fixed, given)
    rows, columns, values = fairing.cotan_laplacian(patch.vertices, patch.triangles)
    count = len(patch.vertices)
    laplacian = coo_array((values, (rows, columns)), shape=(count, count)).tocsr()
    inside = np.setdiff1d(np.arange(count), patch.fixed)
    wanted = np.zeros((count, 2))
    wanted[patch.fixed] = given
    wanted[inside] = spsolve(laplacian[inside][:, inside], -(laplacian[inside] @ wanted))
    np.testing.assert_allclose(found, wanted, atol=1e-9)


def test_a_sphere_is_projected_from_half_of_its_outline() -> None:
    """The stereographic projection from the south pole keeps angles; the other half of the outline is free."""
    errors = []
    for n_free in (200, 800, 3200):
        patch = shapes.cap(n_free)
        x, y, z = patch.vertices.T
        exact = np.column_stack([x, y]) / (1 + z)[:, None]
        half = patch.fixed[y[patch.fixed] > 0]
        found = fairing.maps.conformal_map(patch.vertices, patch.triangles, half, exact[half])
        errors.append(np.abs(found - exact).max())  # at the far end of the free border
    assert errors[0] > 1.3 * errors[1] > 1.9 * errors[2]
    assert errors[2] < 2.5e-2


def test_what_is_not_determined_is_refused() -> None:
    flat, points, triangles = tilted_sheet()
    twice = np.concatenate([points, points + 5.0]), np.concatenate([triangles, triangles + len(points)])
    with pytest.raises(fairing.SolverError, match="less than two fixed vertices"):
        fairing.maps.conformal_map(*twice, [0, 1, len(points)], flat[[0, 1, 0]])
