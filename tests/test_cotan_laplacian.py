"""`fairing.cotan_laplacian`: identities of the matrix with entries −(cot α + cot β), no ½."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.sparse import coo_array, csr_array

import fairing
import shapes
from curves import FloatArray
from meshing import IntArray
from shapes import Patch, Style


def stiffness(patch: Patch) -> csr_array:
    rows, columns, values = fairing.cotan_laplacian(patch.vertices, patch.triangles)
    count = len(patch.vertices)
    return coo_array((values, (rows, columns)), shape=(count, count)).tocsr()


def reference(vertices: FloatArray, triangles: IntArray) -> FloatArray:
    """The same matrix, dense, corner by corner."""
    result = np.zeros((len(vertices), len(vertices)))
    for k in range(3):
        apex, i, j = (triangles[:, (k + turn) % 3] for turn in range(3))
        a, b = vertices[i] - vertices[apex], vertices[j] - vertices[apex]
        cot = (a * b).sum(axis=1) / np.linalg.norm(np.cross(a, b), axis=1)
        for p, q, sign in ((i, j, -1), (j, i, -1), (i, i, 1), (j, j, 1)):
            np.add.at(result, (p, q), sign * cot)
    return result


@pytest.mark.parametrize("style", [Style(), Style(flips=0.3), Style(aspect=5.0)])
def test_entries(style: Style) -> None:
    patch = shapes.catenoid(200, style)
    expected = reference(patch.vertices, patch.triangles)
    assert np.abs(stiffness(patch).toarray() - expected).max() < 1e-11 * np.abs(expected).max()


def test_invariant_under_scale_and_winding() -> None:
    patch = shapes.catenoid(200)
    rows, columns, values = fairing.cotan_laplacian(1e5 * patch.vertices, patch.triangles[:, ::-1])
    count = len(patch.vertices)
    other = coo_array((values, (rows, columns)), shape=(count, count)).toarray()
    assert np.abs(other - stiffness(patch).toarray()).max() < 1e-10


def test_triangles_of_any_size() -> None:
    """S has no unit: also where squares of lengths are no numbers, and in one mesh with others."""
    patch = shapes.catenoid(100)
    expected = stiffness(patch).toarray()
    for scale in (2.0**-1000, 2.0**-600, 2.0**600, 2.0**1000):
        rows, columns, values = fairing.cotan_laplacian(scale * patch.vertices, patch.triangles)
        assert np.array_equal(coo_array((values, (rows, columns))).toarray(), expected)
    both = np.vstack([patch.vertices, 2.0**1000 * patch.vertices])
    faces = np.vstack([patch.triangles, patch.triangles + len(patch.vertices)])
    rows, columns, values = fairing.cotan_laplacian(both, faces)
    found = coo_array((values, (rows, columns))).toarray()
    assert np.array_equal(found, np.kron(np.eye(2), expected))
