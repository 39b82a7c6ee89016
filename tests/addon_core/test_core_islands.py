"""Loose pieces of faces inside holes: which lie where, and how they are joined."""

import numpy as np
from addon.arrays.border import border_loops
from addon.arrays.region import MeshArrays
from addon.arrays.types import Ints
from addon.fill.filling import fill
from addon.fill.holes import Borders, chosen_borders
from addon.fill.islands import islands_inside
from addon.mirror.reflected import Whole
from addon.options.other_options import FillOptions

from polygon_mesh import grid_points, grid_quads, on_sphere, polygon_mesh

SIZE = 16


def ball_with_island(away: float = 0.0) -> tuple[MeshArrays, list[Ints]]:
    """Part of a sphere with a hole of 8 × 8 faces and a piece of 2 × 2 in its middle, lifted by `away`; its loops."""
    quads = np.array(grid_quads(SIZE))
    rows, columns = np.divmod(np.arange(SIZE * SIZE), SIZE)
    far = np.maximum(np.abs(rows - 7.5), np.abs(columns - 7.5))
    kept = quads[(far > 4) | (far < 1)]
    points = on_sphere(grid_points(SIZE))
    points[np.unique(quads[far < 1])] += [0.0, 0.0, away]
    mesh = polygon_mesh(points, kept.tolist(), np.zeros(len(kept), dtype=bool))
    loops, left = border_loops(mesh, np.ones(len(points), dtype=bool))
    assert not left
    return mesh, sorted(loops, key=len)


def test_an_island_is_found_in_its_hole() -> None:
    mesh, loops = ball_with_island()
    assert [len(loop) for loop in loops] == [8, 32, 64]
    assert islands_inside(mesh, loops, np.array([True, False, True])) == {0: 1}
    far, _ = ball_with_island(away=5.0)
    assert islands_inside(far, loops, np.array([True, False, True])) == {}


def test_an_island_is_joined_with_its_hole_where_that_is_asked_for() -> None:
    mesh, loops = ball_with_island()
    options = FillOptions(islands=True)
    chosen = chosen_borders(np.eye(4), Borders(Whole.of(mesh), loops[:2]), options, True)
    assert [len(loop) for loop in chosen.loops] == [8, 32]
    done = fill(mesh, np.eye(4), chosen.loops, options)
    (piece,) = done.pieces
    assert not done.left
    assert [len(loop) for loop in piece.loops] == [32, 8]
    assert np.abs(np.linalg.norm(piece.positions, axis=1) - 1.0).max() < 5e-3
    edges = np.sort(
        np.concatenate([piece.triangles[:, [0, 1]], piece.triangles[:, [1, 2]], piece.triangles[:, [2, 0]]])
    )
    names, uses = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    assert len(piece.points) - len(names) + len(piece.triangles) == 0  # a ring
    assert np.count_nonzero(uses == 1) == 40
    plain = FillOptions()
    alone = chosen_borders(np.eye(4), Borders(Whole.of(mesh), loops[:2]), plain, True)
    assert [len(loop) for loop in alone.loops] == [32]
