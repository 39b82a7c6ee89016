"""A new mesh for a patch through which hard edges run: they are held, and each side finds its slope."""

from collections.abc import Callable

import pytest

import creased
import fairing
import measures


def meshed(part: creased.Dented, factor: float) -> fairing.RemeshResult:
    return fairing.remesh(
        part.vertices, part.patch, fixed=part.fixed, fixed_normals=part.normals, creases=part.curve,
        spacing=factor * part.edge, equation="automatic",
    )  # fmt: skip


@pytest.mark.parametrize("factor", [0.6, 1.0, 2.0])
@pytest.mark.parametrize(("n", "seed"), [(8, 1), (14, 2), (22, 3)])
@pytest.mark.parametrize(
    ("make", "bound"),
    [
        (creased.dented_edge, 1e-9),
        (creased.dented_corner, 1e-9),
        (creased.dented_rim, 1e-4),
        (creased.dented_sheet, 1e-3),
    ],
)
def test_edges_are_held(
    make: Callable[[int, int], creased.Dented], bound: float, n: int, seed: int, factor: float
) -> None:
    """The sides come back, whether the mesh is solved or, where it is coarser, cut from the solved one."""
    part = make(n, seed)
    result = meshed(part, factor)
    assert result.converged
    assert part.error(result.vertices) < bound
    sides = {tuple(side) for side in measures.edges(result.triangles).tolist()}
    assert {tuple(sorted(pair)) for pair in part.edges.tolist()} <= sides
