"""Which edges a new mesh keeps for the sake of what hangs on them."""

from dataclasses import replace

import numpy as np
from addon.arrays.lines import WIRES, edges_at_wires, inner_lines

from polygon_mesh import grid


def hung_on(*vertices: int) -> object:
    """A grid of 8 × 8 quads, the inner 4 × 4 selected, with an edge without faces at each of these vertices."""
    mesh = grid(8, 0.5, lambda points: points * [1.0, 2.0, 1.0])
    count = len(mesh.positions)
    wires = [(vertex, count + k) for k, vertex in enumerate(vertices)]
    return replace(
        mesh,
        positions=np.concatenate([mesh.positions, np.ones((len(vertices), 3))]),
        edges=np.concatenate([mesh.edges, np.array(wires, dtype=np.int64).reshape(-1, 2)]),
        pinned=np.zeros(count + len(vertices), dtype=bool),
    )


def test_a_vertex_inside_is_kept_by_one_edge_of_the_patch() -> None:
    mesh = hung_on(4 * 9 + 4)
    found = np.flatnonzero(edges_at_wires(mesh))
    assert len(found) == 1
    assert 4 * 9 + 4 in mesh.edges[found[0]]
    assert found[0] in mesh.corner_edges
    kept = inner_lines(replace(mesh, lines={WIRES: edges_at_wires(mesh)}))
    assert np.array_equal(np.flatnonzero(kept), found)


def test_what_hangs_on_the_outline_or_outside_needs_none() -> None:
    assert not edges_at_wires(hung_on()).any()
    assert not edges_at_wires(hung_on(2 * 9 + 4, 0)).any()
