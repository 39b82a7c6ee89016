"""`fairing.boundary_loops`: every border vertex once, in order with the mesh on the left."""

from __future__ import annotations

import numpy as np
import pytest

import bad_inputs
import blend
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


def test_three_rims_of_the_blend() -> None:
    check(blend.cylinder_blend(820).triangles, 3)


def test_closed_meshes_have_none() -> None:
    assert fairing.boundary_loops(bad_inputs.closed_ball()[1]) == []


def test_a_single_sided_mesh_has_no_left_and_is_refused() -> None:
    with pytest.raises(fairing.MeshError) as caught:
        fairing.boundary_loops(bad_inputs.moebius_strip().triangles)
    assert caught.value.code == "NOT_ORIENTABLE"
