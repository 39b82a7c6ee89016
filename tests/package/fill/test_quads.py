"""fairing.maps.paired_quads: nearly all faces are quads, none concave, each triangle once, and what is kept stays."""

from typing import Any

import numpy as np
import pytest

import fairing
import holes
from holes import FloatArray, IntArray

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
HALVES = np.array([[0, 1, 2], [0, 2, 3]])


def dome(edges: int) -> tuple[FloatArray, IntArray]:
    """An even triangulation over a round hole, and vertices of the bowl that none of its triangles has."""
    vertices, triangles, *_ = holes.bowl(edges)
    result = fairing.fill(vertices, triangles)
    return np.concatenate([vertices, result.vertices]), result.triangles


def sides(faces: IntArray) -> set[tuple[int, int]]:
    return {(int(a), int(b)) for face in faces for a, b in zip(face, np.roll(face, -1), strict=True)}


def corner_signs(points: FloatArray, quads: IntArray) -> FloatArray:
    """(q, 4) the sine of each corner seen along the quad's mean normal: positive where it is convex."""
    corners = points[quads]
    ahead = np.roll(corners, -1, axis=1) - corners
    ahead /= np.linalg.norm(ahead, axis=2, keepdims=True)
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    crosses: FloatArray = np.einsum("qkx,qx->qk", np.cross(np.roll(ahead, 1, axis=1), ahead), normals)
    return crosses


@pytest.mark.parametrize("edges", [16, 32, 64, 128])
def test_nearly_all_faces_are_quads_and_each_triangle_counts_once(edges: int) -> None:
    points, triangles = dome(edges)
    paired = fairing.maps.paired_quads(points, triangles)
    assert len(paired.quads) >= 0.9 * (len(paired.quads) + len(paired.triangles))
    assert np.array_equal(np.sort(np.concatenate([paired.pairs.ravel(), paired.rest])), np.arange(len(triangles)))
    assert np.array_equal(paired.triangles, triangles[paired.rest])
    assert corner_signs(points, paired.quads).min() > np.sin(np.radians(14))


def test_kept_edges_and_the_border_survive() -> None:
    points, triangles = dome(64)
    first = fairing.maps.paired_quads(points, triangles)
    kept = first.quads[::3, [1, 3]]  # would go, were they not kept
    second = fairing.maps.paired_quads(points, triangles, kept)
    left = sides(second.quads) | sides(second.triangles)
    assert all((a, b) in left or (b, a) in left for a, b in kept.tolist())
    whole = sides(triangles)
    border = {(a, b) for a, b in whole if (b, a) not in whole}
    assert border <= left
    assert len(second.quads) > 0.4 * len(triangles)


def test_a_grid_comes_back_whatever_its_diagonals() -> None:
    k = np.arange(81).reshape(9, 9)
    cells = np.stack([k[:-1, :-1], k[1:, :-1], k[1:, 1:], k[:-1, 1:]], axis=-1).reshape(-1, 4)
    turned = np.random.default_rng(1).random(len(cells)) < 0.5
    cells[turned] = np.roll(cells[turned], 1, axis=1)
    triangles = np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
    points = np.stack([k.ravel() // 9, k.ravel() % 9, np.zeros(81)], axis=1)
    paired = fairing.maps.paired_quads(points, triangles)
    assert {frozenset(quad) for quad in paired.quads.tolist()} == {frozenset(cell) for cell in cells.tolist()}


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((SQUARE, [[0, 1, 1]]), "row 0 names a vertex twice"),
        ((SQUARE * [1, np.nan, 1], HALVES), "vertex|vertices"),
        ((SQUARE, HALVES, [[1, 3]]), "kept: 1 and 3 are not joined"),
        ((SQUARE, [[0, 1, 4]]), "row 0 names vertex 4"),
        ((SQUARE, [[0, 1]]), "triangles"),
    ],
)
def test_bad_input_is_refused(arguments: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        fairing.maps.paired_quads(*arguments)
