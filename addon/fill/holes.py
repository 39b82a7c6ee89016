"""Which borders are filled where nobody chose any, and how many vertices that takes. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import fairing

from ..arrays.border import BorderRefusal, Left, border_loops, refuse_all
from ..arrays.region import MeshArrays, nothing
from ..arrays.types import Floats, Ints, Mask
from ..mirror.reflected import Whole, with_image
from ..mirror.symmetry import vertices_with_image
from ..options.other_options import FillOptions
from ..words.sentences import in_numbers_of
from ..words.words import said


@dataclass(frozen=True)
class Borders:
    """Border loops, each with the hole on its left, in numbers of the whole."""

    whole: Whole
    loops: list[Ints]  # that are to be filled
    left_open: tuple[Ints, ...] = ()  # outer borders
    left: tuple[Left, ...] = ()  # what can't be filled, in numbers of the half
    longer: int = 0  # how many are longer than asked for

    @property
    def vertices(self) -> Ints:
        """Those of the half of all that are to be filled, ascending."""
        return np.sort(self.whole.own(np.concatenate([nothing(), *self.loops])))

    def expected_vertices(self, matrix: Floats, bridge: bool) -> float:
        """Return about how many vertices will be new, with edges as long as the boundaries'."""
        world = _placed(self.whole.mesh, matrix)
        return fairing.borders.expected_vertices(world.positions, world.triangles, self.loops, bridge=bridge)

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences about those that stay open as they should."""
        return (*self._on_outer(), *self._on_longer())

    def _on_outer(self) -> tuple[str, ...]:
        if not self.left_open:
            return ()
        edges = said("edges", n=sum(map(len, self.left_open)))
        first = min(int(loop.min()) for loop in self.left_open)
        return (said("outer_stay", n=len(self.left_open), edges=edges, first=first),)

    def _on_longer(self) -> tuple[str, ...]:
        if not self.longer:
            return ()
        return (said("longer_stay", n=self.longer),)


def borders_at(mesh: MeshArrays, seeds: Mask) -> Borders:
    """Return the borders through the vertices of the (n,) mask; see border_loops.

    Where they end at a plane of reflection they are those of the whole, which is closed along the plane.
    """
    seeds = vertices_with_image(mesh, seeds)
    loops, left = border_loops(mesh, seeds)
    touched = np.zeros(len(seeds), dtype=bool)
    touched[np.concatenate([nothing(), *loops, *(each.vertices for each in left)])] = True
    whole = with_image(mesh, touched)
    if whole.planes:
        on = np.any([plane.on_plane(mesh.positions) for plane in whole.planes], axis=0)
        own = np.arange(len(whole.mesh.positions)) < len(seeds)
        loops, left = border_loops(whole.mesh, own & whole.vertices(seeds & ~on))
        left = [each.named(whole.own) for each in left]
    return Borders(whole, loops, left=tuple(left))


def chosen_borders(matrix: Floats, borders: Borders, options: FillOptions, every: bool) -> Borders:
    """Return the borders that are meant: not the longer ones, and where nobody chose any (`every`), the holes alone.

    Raises BorderRefusal with the first reason where there is none.
    """
    if not borders.loops:
        refuse_all(borders.left)
    with in_numbers_of(borders.whole.own):
        short = short_among(matrix, borders, options)
        return holes_among(matrix, short) if every else short


def holes_among(matrix: Floats, borders: Borders) -> Borders:
    """Return the holes among all border loops of a mesh; matrix: 4×4, to where they are filled.

    Raises BorderRefusal where none of them is a hole.
    """
    loops = borders.loops
    if not loops:
        return borders
    world = _placed(borders.whole.mesh, matrix)
    outer = fairing.borders.outer_borders(world.positions, world.triangles, loops)
    if outer.all():
        refuse_all(borders.left)
        reason = said("all_outside", n=len(loops)) if len(loops) > 1 else said("one_outside")
        raise BorderRefusal(reason, np.concatenate(loops))
    pairs = list(zip(loops, outer.tolist(), strict=True))
    left_open = tuple(loop for loop, out in pairs if out)
    return replace(borders, loops=[loop for loop, out in pairs if not out], left_open=left_open)


def short_among(matrix: Floats, borders: Borders, options: FillOptions) -> Borders:
    """Return the borders with no more edges than asked for, and no longer in the space that `matrix` leads to.

    Raises BorderRefusal where there are borders, and none is so short.
    """
    edges, length = options.longest, options.longest_length
    if not borders.loops or not (edges or length):
        return borders
    world = _placed(borders.whole.mesh, matrix)
    sizes = [_length(world.positions[loop]) for loop in borders.loops]
    kept = [
        loop
        for loop, size in zip(borders.loops, sizes, strict=True)
        if (not edges or len(loop) <= edges) and (not length or size <= length)
    ]
    if not kept:
        refuse_all(borders.left)
        fewest = min(map(len, borders.loops))
        raise BorderRefusal(said("all_longer_than", edges=fewest, length=min(sizes)), borders.vertices)
    return replace(borders, loops=kept, longer=len(borders.loops) - len(kept))


def _length(points: Floats) -> float:
    return float(np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum())


def _placed(mesh: MeshArrays, matrix: Floats) -> MeshArrays:
    with np.errstate(invalid="ignore", over="ignore"):  # elsewhere
        return mesh.transformed(matrix)
