"""`fairing.boundary_loops`: every border vertex once, in order with the mesh on the left."""

import numpy as np
import pytest

import bad_inputs
import fairing
import measures
import shapes
from meshing import IntArray


def check(triangles: IntArray, count: int) -> None:
    loops = fairing.boundary_loops(triangles)
    assert len(loops) == count
    border = {tuple(edge) for edge in measures.border_edges(triangles).tolist()}
    steps = [(int(a), int(b)) for loop in loops for a, b in zip(loop, np.roll(loop, -1), strict=True)]
    assert len(steps) == len(set(steps)) == len(border)
    assert set(steps) == border
    assert all(loop[0] == loop.min() for loop in loops)


@pytest.mark.parametrize(("name", "count"), [("cap", 1), ("cylinder", 2), ("plane", 1), ("torus", 1)])
def test_loops_of_patches(name: str, count: int) -> None:
    check(getattr(shapes, name)(200).triangles, count)


def test_closed_meshes_have_none() -> None:
    assert fairing.boundary_loops(bad_inputs.closed_ball()[1]) == []


def test_a_single_sided_mesh_has_no_left_and_is_refused() -> None:
    with pytest.raises(fairing.MeshError) as caught:
        fairing.boundary_loops(bad_inputs.moebius_strip()[1])
    assert caught.value.code == "NOT_ORIENTABLE"


def test_a_waist_between_two_fans_is_no_border() -> None:
    """Both its ends lie on the border, free vertices on both its sides: the solver cuts there, the loop does not."""
    left = [[0, 2, 3], [0, 3, 4], [0, 4, 5], [0, 5, 2]]
    right = [[1, 3, 2], [1, 2, 6], [1, 6, 7], [1, 7, 3]]
    (loop,) = fairing.boundary_loops(left + right)
    assert list(loop) == [2, 6, 7, 3, 4, 5]
