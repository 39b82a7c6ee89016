"""Which borders are filled where nobody chose any, and how many vertices that takes. Plain numpy, no bpy."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

import fairing

from .arrays import Floats, Ints, Mask
from .border import BorderRefusal, Left, border_loops, refuse_all
from .fill_pieces import FillOptions
from .halves import Half, halves_of
from .islands import islands_inside
from .region import MeshArrays, nothing
from .words import counted


@dataclass(frozen=True)
class Borders:
    """Border loops, each with the hole on its left."""

    loops: list[Ints]  # that are to be filled
    left_open: tuple[Ints, ...] = ()  # outer borders
    left: tuple[Left, ...] = ()  # what can't be filled
    longer: int = 0  # how many are longer than asked for
    halves: tuple[Half, ...] = ()  # of holes at a plane of reflection

    @property
    def vertices(self) -> Ints:
        """Those of all that are to be filled, ascending."""
        chains = [half.chain for half in self.halves]
        found: Ints = np.unique(np.concatenate([nothing(), *self.loops, *chains]))
        return found

    @property
    def notes(self) -> tuple[str, ...]:
        """Sentences about those that stay open as they should."""
        return (*self._on_outer(), *self._on_longer())

    def _on_outer(self) -> tuple[str, ...]:
        if not self.left_open:
            return ()
        text = counted(len(self.left_open), "border runs", "borders run")
        edges = counted(sum(map(len, self.left_open)), "edge", "edges")
        stay = "stays open" if len(self.left_open) == 1 else "stay open"
        first = min(int(loop.min()) for loop in self.left_open)
        return (
            f"{text} around the outside of a sheet of faces and {stay} ({edges}, one at vertex {first}): "
            "to fill one all the same, select it alone",
        )

    def _on_longer(self) -> tuple[str, ...]:
        if not self.longer:
            return ()
        return (counted(self.longer, "longer border stays open", "longer borders stay open"),)


def _without_outer_halves(mesh: MeshArrays, matrix: Floats, borders: Borders) -> Borders:
    """Return the borders without halves of those around the outside of a sheet."""
    kept, outer = [], []
    for half in borders.halves:
        whole, loop = half.whole(mesh)
        world = _placed(whole, matrix)
        is_outer = fairing.outer_borders(world.positions, world.triangles, [loop])[0]
        outer += [half.chain] * bool(is_outer)
        kept += [half] * (not is_outer)
    return replace(borders, halves=tuple(kept), left_open=(*borders.left_open, *outer))


def borders_at(mesh: MeshArrays, seeds: Mask) -> Borders:
    """Return the borders through the vertices of the (n,) mask; see border_loops and halves_of."""
    found, left = border_loops(mesh, seeds)
    loops: list[Ints] = []
    halves: list[Half] = []
    for loop in found:
        parts = halves_of(mesh, loop)
        if parts is None:
            loops.append(loop)
            continue
        halves += [half for half in parts[0] if seeds[half.chain[1:-1]].any()]
        left += [each for each in parts[1] if seeds[each.vertices].any()]
    return Borders(loops, left=tuple(left), halves=tuple(halves))


def chosen_borders(mesh: MeshArrays, matrix: Floats, borders: Borders, options: FillOptions, every: bool) -> Borders:
    """Return the borders that are meant: not the longer ones, and where nobody chose any (`every`), the holes alone.

    Raises BorderRefusal with the first reason where there is none.
    """
    if not borders.loops and not borders.halves:
        refuse_all(borders.left)
    short = short_among(mesh, matrix, borders, options)
    if every:
        short = _without_outer_halves(mesh, matrix, short)
    return holes_among(mesh, matrix, short, options.islands) if every else short


def holes_among(mesh: MeshArrays, matrix: Floats, borders: Borders, islands: bool = False) -> Borders:
    """Return the holes among all border loops of a mesh, and with `islands` the loose pieces inside them.

    matrix: 4×4, to where they are filled.

    Raises BorderRefusal where none of them is a hole.
    """
    loops = borders.loops
    if not loops:
        return borders
    world = _placed(mesh, matrix)
    outer = fairing.outer_borders(world.positions, world.triangles, loops)
    if islands:
        outer[list(islands_inside(world, loops, outer))] = False
    if outer.all() and not borders.halves:
        refuse_all(borders.left)
        raise BorderRefusal(_all_outside(len(loops)), np.concatenate(loops))
    pairs = list(zip(loops, outer.tolist(), strict=True))
    left_open = tuple(loop for loop, out in pairs if out)
    left_open = (*borders.left_open, *left_open)
    return replace(borders, loops=[loop for loop, out in pairs if not out], left_open=left_open)


def _all_outside(count: int) -> str:
    if count == 1:
        return (
            "The border runs around the outside of a sheet of faces, there is no hole: to fill it all the same, "
            "select it alone"
        )
    return (
        f"All {count} borders run around the outside of a sheet of faces, there is no hole: to fill one all the same, "
        "select it alone"
    )


def short_among(mesh: MeshArrays, matrix: Floats, borders: Borders, options: FillOptions) -> Borders:
    """Return the borders with no more edges than asked for, and no longer in the space that `matrix` leads to.

    Raises BorderRefusal where there are borders, and none is so short.
    """
    edges, length = options.longest, options.longest_length
    if not (borders.loops or borders.halves) or not (edges or length):
        return borders
    world = _placed(mesh, matrix)
    halves = tuple(
        half
        for half in borders.halves
        if (not edges or 2 * len(half.chain) - 2 <= edges)
        and (not length or 2.0 * _along(world.positions[half.chain]) <= length)
    )
    sizes = [_length(world.positions[loop]) for loop in borders.loops]
    kept = [
        loop
        for loop, size in zip(borders.loops, sizes, strict=True)
        if (not edges or len(loop) <= edges) and (not length or size <= length)
    ]
    if not kept and not halves:
        refuse_all(borders.left)
        text = "All borders are longer than that"
        if borders.loops:
            edges, length = min(map(len, borders.loops)), min(sizes)
            text = f"{text}: the one with the fewest has {edges} edges, the shortest is {length:.4g} long"
        raise BorderRefusal(text, borders.vertices)
    longer = len(borders.loops) - len(kept) + len(borders.halves) - len(halves)
    return replace(borders, loops=kept, halves=halves, longer=longer)


def expected_vertices(mesh: MeshArrays, matrix: Floats, loops: list[Ints], bridge: bool) -> float:
    """Return about how many vertices will be new, with edges as long as the boundaries'."""
    world = _placed(mesh, matrix)
    return fairing.expected_vertices(world.positions, world.triangles, loops, bridge=bridge)


def _along(points: Floats) -> float:
    return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())


def _length(points: Floats) -> float:
    return float(np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum())


def _placed(mesh: MeshArrays, matrix: Floats) -> MeshArrays:
    with np.errstate(invalid="ignore", over="ignore"):  # elsewhere
        return mesh.transformed(matrix)
