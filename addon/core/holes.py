"""Which borders are filled where nobody chose any, and how many vertices that takes. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import fairing

from .arrays import Floats, Ints
from .border import BorderRefusal
from .region import MeshArrays
from .words import counted

_OUTSIDE = "around the outside of a sheet of faces"
_ALL_THE_SAME = "to fill one all the same, select it alone"


@dataclass(frozen=True)
class Borders:
    """Border loops, each with the hole on its left."""

    loops: list[Ints]  # that are to be filled
    left_open: tuple[Ints, ...] = ()

    @property
    def notes(self) -> tuple[str, ...]:
        """A sentence about those that are left open."""
        if not self.left_open:
            return ()
        text = counted(len(self.left_open), "border runs", "borders run")
        edges = counted(sum(map(len, self.left_open)), "edge", "edges")
        stay = "stays open" if len(self.left_open) == 1 else "stay open"
        first = min(int(loop.min()) for loop in self.left_open)
        return (f"{text} {_OUTSIDE} and {stay} ({edges}, one at vertex {first}): {_ALL_THE_SAME}",)


def holes_among(mesh: MeshArrays, matrix: Floats, loops: list[Ints]) -> Borders:
    """Return the holes among all border loops of a mesh; `matrix`, 4×4, leads to where they are filled.

    Raises BorderRefusal where none of them is a hole.
    """
    if not loops:
        return Borders(loops)
    world = _placed(mesh, matrix)
    outer = fairing.outer_borders(world.positions, world.triangles, loops)
    if outer.all():
        each = "The border runs" if len(loops) == 1 else f"All {len(loops)} borders run"
        raise BorderRefusal(f"{each} {_OUTSIDE}, there is no hole: {_ALL_THE_SAME}", np.concatenate(loops))
    pairs = list(zip(loops, outer.tolist(), strict=True))
    return Borders([loop for loop, out in pairs if not out], tuple(loop for loop, out in pairs if out))


def expected_vertices(mesh: MeshArrays, matrix: Floats, loops: list[Ints], bridge: bool) -> float:
    """Return about how many vertices will be new, with edges as long as the boundaries'."""
    world = _placed(mesh, matrix)
    return fairing.expected_vertices(world.positions, world.triangles, loops, bridge=bridge)


def _placed(mesh: MeshArrays, matrix: Floats) -> MeshArrays:
    with np.errstate(invalid="ignore", over="ignore"):  # elsewhere
        return mesh.transformed(matrix)
