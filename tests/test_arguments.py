"""Arguments of the usual wrong kinds: the message says what to do; and what `Solver` refuses before it solves."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import bad_inputs
import fairing
import shapes

PATCH = shapes.cap(60)
COUNT = len(PATCH.vertices)
MASK = np.isin(np.arange(COUNT), PATCH.fixed)

CALLS: dict[str, Callable[[Any], Any]] = {
    "fair": lambda triangles: fairing.fair(PATCH.vertices, triangles),
    "mean_curvature": lambda triangles: fairing.mean_curvature(PATCH.vertices, triangles),
    "vertex_normals": lambda triangles: fairing.vertex_normals(PATCH.vertices, triangles),
    "cotan_laplacian": lambda triangles: fairing.cotan_laplacian(PATCH.vertices, triangles),
    "conformal_distortion": lambda triangles: fairing.conformal_distortion(PATCH.vertices, PATCH.vertices, triangles),
    "deviation": lambda triangles: fairing.deviation(PATCH.vertices, PATCH.vertices, triangles),
    "surrounding_normals": lambda triangles: fairing.surrounding_normals(PATCH.vertices, triangles, [0]),
}


def test_a_boolean_mask_hints_at_flatnonzero() -> None:
    with pytest.raises(ValueError, match=r"fixed: .*np\.flatnonzero\(mask\)"):
        fairing.fair(PATCH.vertices, PATCH.triangles, fixed=MASK)
    with pytest.raises(ValueError, match=r"fixed: .*np\.flatnonzero\(mask\)"):
        fairing.Solver(PATCH.triangles, fixed=MASK)
    with pytest.raises(ValueError, match=r"at: .*np\.flatnonzero\(mask\)"):
        fairing.surrounding_normals(PATCH.vertices, PATCH.triangles, MASK)


@pytest.mark.parametrize("name", CALLS)
def test_the_first_wrong_triangle_and_index_are_named(name: str) -> None:
    triangles = PATCH.triangles.copy()
    triangles[7, 1], triangles[9, 2] = COUNT + 5, COUNT + 6
    message = f"triangles: row 7 names vertex {COUNT + 5}, outside 0 … {COUNT - 1}"
    with pytest.raises(fairing.MeshError, match=message) as caught:
        CALLS[name](triangles)
    assert caught.value.code == "INDEX_RANGE"
    assert caught.value.kind == "triangle"
    assert caught.value.elements.tolist() == [7, 9]


@pytest.mark.parametrize("name", CALLS)
def test_faces_that_count_from_one_are_reported_so(name: str) -> None:
    with pytest.raises(fairing.MeshError, match=r"INDEX_RANGE.*subtract 1 from those of an OBJ file"):
        CALLS[name](PATCH.triangles + 1)


def test_masked_entries_are_refused_and_empty_masks_are_not() -> None:
    hidden = np.ma.masked_greater(PATCH.vertices, 0.5)
    with pytest.raises(ValueError, match="vertices: has masked entries"):
        fairing.fair(hidden, PATCH.triangles)
    with pytest.raises(ValueError, match="triangles: has masked entries"):
        fairing.fair(PATCH.vertices, np.ma.masked_equal(PATCH.triangles, 3))
    with pytest.raises(ValueError, match="fixed: has masked entries"):
        fairing.fair(PATCH.vertices, PATCH.triangles, fixed=np.ma.masked_equal(PATCH.fixed, PATCH.fixed[0]))
    plain = fairing.fair(PATCH.vertices, PATCH.triangles)
    for vertices in (np.ma.array(PATCH.vertices), np.ma.array(PATCH.vertices, mask=np.zeros((COUNT, 3), bool))):
        assert np.array_equal(fairing.fair(vertices, PATCH.triangles).vertices, plain.vertices)


# What no positions could mend; the index beyond the last vertex and coordinates are known at the solve only.
LATER = {"not_a_number", "infinite", "normal_not_a_number", "index_too_large", "fixed_out_of_range"}


@pytest.mark.parametrize("name", bad_inputs.CASES)
def test_the_solver_refuses_connectivity_at_once(name: str) -> None:
    case = bad_inputs.CASES[name]()
    fixed = case.options.get("fixed")
    if name in LATER:
        solver = fairing.Solver(case.triangles, fixed=fixed)
        with pytest.raises(fairing.MeshError, match=case.code):
            solver.solve(case.vertices, case.options.get("fixed_normals"))
        return
    with pytest.raises(fairing.MeshError) as caught:
        fairing.Solver(case.triangles, fixed=fixed)
    assert caught.value.code == case.code
    assert case.elements is None or set(case.elements) <= set(np.ravel(caught.value.elements))


def test_the_solver_refuses_fixed_vertices_at_once() -> None:
    with pytest.raises(ValueError, match="fixed names vertex 1 twice"):
        fairing.Solver(PATCH.triangles, fixed=[1, 1])
    with pytest.raises(fairing.MeshError, match="fixed names vertex -1, outside"):
        fairing.Solver(PATCH.triangles, fixed=[0, -1])
    with pytest.raises(fairing.MeshError, match="triangles: row 0 names vertex -1"):
        fairing.Solver([[0, 1, -1]])
    with pytest.raises(fairing.MeshError, match="NO_FREE_VERTICES"):
        fairing.Solver([])
    vertices, triangles, equator = bad_inputs.closed_ball()
    with pytest.raises(fairing.MeshError, match="NO_BOUNDARY"):
        fairing.Solver(triangles)
    result = fairing.Solver(triangles, fixed=equator).solve(vertices, vertices[equator])
    assert result.converged


def test_the_solver_takes_sparse_numbers_and_leaves_them_to_the_solve() -> None:
    """No memory for two thousand million vertices that may never come."""
    solver = fairing.Solver([[0, 1, 2_000_000_000]])
    with pytest.raises(fairing.MeshError, match="INDEX_RANGE"):
        solver.solve(np.eye(3))


def test_pinched_loops_repeat_the_pinch_and_unique_makes_them_fixed() -> None:
    """Two discs of six triangles that share one border vertex."""
    fan = np.array([[0, 1 + k, 1 + (k + 1) % 6] for k in range(6)])
    other = fan + 7
    other[other == 8] = 1
    triangles = np.vstack([fan, other])
    border = np.concatenate(fairing.boundary_loops(triangles))
    assert (border == 1).sum() == 2
    angle = np.pi / 3 * np.arange(6)
    disc = np.vstack([[[0, 0, 0]], np.column_stack([np.cos(angle), np.sin(angle), 0 * angle])])
    vertices = np.vstack([disc, [2, 0, 0] - disc])
    with pytest.raises(ValueError, match="fixed names vertex 1 twice"):
        fairing.fair(vertices, triangles, fixed=border)
    fixed = np.unique(border)
    result = fairing.fair(vertices, triangles, fixed=fixed, fixed_normals=np.tile([0.0, 0.0, 1.0], (len(fixed), 1)))
    assert result.converged
    assert np.abs(result.vertices[:, 2]).max() < 1e-9
