"""Which loops a call fills, and which it leaves open, each with its reason: what is wrong with one stops no other."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from fairing import _crossings, _loops, _sides
from fairing._hole_loops import hole_loops, recut
from fairing._holes import is_outer
from fairing._loops import Outline
from fairing._types import Diagnostic, FloatArray, IntArray, MeshError


@dataclass(frozen=True)
class Left:
    """A loop that stays open."""

    loop: IntArray
    reason: Diagnostic


@dataclass(frozen=True)
class Chosen:
    """Loops that are to be filled, with their data in the loops' order, and those that are not."""

    outline: Outline
    normals: FloatArray
    """(Σ k, 3) unit."""
    curvatures: FloatArray | None
    """(Σ k,) as they were given, NaN where not known."""
    left: tuple[Left, ...] = ()

    def part(self, numbers: Sequence[int]) -> Chosen:
        """Some of the loops alone."""
        curvatures = None
        if self.curvatures is not None:
            of_loops = _rows(self.outline, self.curvatures)
            curvatures = np.concatenate([of_loops[k] for k in numbers])
        rows = self.outline.split(self.normals)
        normals = np.concatenate([rows[k] for k in numbers])
        return Chosen(_some(self.outline, numbers), normals, curvatures)

    @property
    def outer(self) -> tuple[IntArray, ...]:
        """Those left open because they go around the outside of a sheet."""
        return tuple(each.loop for each in self.left if _is_outer(each.reason))

    @property
    def warnings(self) -> tuple[Diagnostic, ...]:
        """One for all outer borders, and one for each other loop that stays open."""
        outer = self.outer
        others = tuple(each.reason for each in self.left if not _is_outer(each.reason))
        return ((_loops.not_holes(outer),) if outer else ()) + others


@dataclass(frozen=True)
class Wanted:
    """What the caller says about the loops."""

    loops: Any
    normals: Any
    curvatures: Any
    bridge: bool
    longest: int
    """Edges; 0: any number."""
    longest_length: float
    """Around a loop; 0: any length."""
    hard: IntArray
    """(h, 2) edges across which no fit of normals looks."""


def chosen_loops(points: FloatArray, around: IntArray, wanted: Wanted) -> Chosen:
    """The loops meant, each checked by itself, turned so that the surface lies on their left.

    MeshError with the first reason where none is left, or any is bad where all are to be joined. See
    :func:`fairing.fill`.
    """
    outline, left = _found(points, around, wanted)
    outline, normals, curvatures, bad = _sound(outline, points, around, wanted)
    left += bad
    if wanted.loops is None:
        plain = _loops.loop_normals(None, outline, points, around) if len(wanted.hard) else normals
        outline, normals, outer = _without_outer(outline, points, (normals, plain), left)
        left += outer
    outline, normals = _sides.settled(outline, points, normals, wanted.bridge)
    if curvatures is not None:
        curvatures = _loops.loop_curvatures(curvatures, outline, len(points))
    chosen = Chosen(outline, normals, curvatures, tuple(left))
    if wanted.bridge:
        return chosen
    return _without(chosen, dict(_loops.endless(chosen.outline, points, chosen.normals)))


def fillable(chosen: Chosen, attempt: Callable[[Chosen], Any]) -> Chosen:
    """The loops on which an attempt raises no MeshError by themselves; the first error where there are none."""
    bad = {}
    for k in range(len(chosen.outline.loops)):
        try:
            attempt(chosen.part([k]))
        except MeshError as error:
            bad[k] = error.diagnostic
    return _without(chosen, bad)


def blamed(chosen: Chosen, error: MeshError) -> Chosen | None:
    """Without the loops that an error names; None where it names none, or all."""
    hit = [k for k, loop in enumerate(chosen.outline.loops) if np.isin(loop, error.elements).any()]
    if error.kind != "vertex" or not hit or len(hit) == len(chosen.outline.loops):
        return None
    return _without(chosen, dict.fromkeys(hit, error.diagnostic))


def _without(chosen: Chosen, bad: dict[int, Diagnostic]) -> Chosen:
    """Leave these loops open; MeshError with the first reason where no other is there."""
    if not bad:
        return chosen
    kept = [k for k in range(len(chosen.outline.loops)) if k not in bad]
    if not kept:
        raise MeshError(bad[0])
    part = chosen.part(kept)
    left = tuple(Left(chosen.outline.loops[k], reason) for k, reason in bad.items())
    return Chosen(part.outline, part.normals, part.curvatures, chosen.left + left)


def _found(points: FloatArray, around: IntArray, wanted: Wanted) -> tuple[Outline, list[Left]]:
    if wanted.loops is not None:
        outline = _loops.given_loops(wanted.loops, points, around)
        _loops.refuse_shared_edges(outline)
        by_vertex = all(_is_by_vertex(rows, outline, len(points)) for rows in (wanted.normals, wanted.curvatures))
        return (_recut(outline, points, around) if by_vertex else outline), []
    all_loops = hole_loops(points, around)
    short = [np.roll(loop, -1) for loop in all_loops.loops if _is_short(loop, points, wanted)]
    torn = [Left(chain, _torn(chain)) for chain in all_loops.torn]
    if not short:
        if torn and not all_loops.loops:
            raise MeshError(torn[0].reason)
        raise MeshError(_nothing(all_loops.loops, points, wanted))
    return Outline(tuple(short), (False,) * len(short), (False,) * len(short)), torn


def _is_by_vertex(rows: Any, outline: Outline, count: int) -> bool:
    return rows is None or (isinstance(rows, np.ndarray) and len(rows) == count != len(outline.vertices))


def _recut(outline: Outline, points: FloatArray, around: IntArray) -> Outline:
    """Loops along the mesh that touch themselves or each other, parted as around holes."""
    held = [k for k, bare in enumerate(outline.bare) if not bare]
    passes = [outline.loops[k] for k in held]
    if not held or len(np.unique(np.concatenate(passes))) == sum(map(len, passes)):
        return outline
    parted = [(held[k], loop) for k, loop in recut(passes, points, around)]
    parted += [(k, outline.loops[k]) for k, bare in enumerate(outline.bare) if bare]
    parted.sort(key=lambda pair: pair[0])
    of = [k for k, _ in parted]
    turned, bare = (tuple(flags[k] for k in of) for flags in (outline.turned, outline.bare))
    return Outline(tuple(loop for _, loop in parted), turned, bare)


def _is_short(loop: IntArray, points: FloatArray, wanted: Wanted) -> bool:
    if wanted.longest and len(loop) > wanted.longest:
        return False
    return not wanted.longest_length or length_of(points[loop]) <= wanted.longest_length


def length_of(points: FloatArray) -> float:
    """Around a loop (k, 3)."""
    with np.errstate(invalid="ignore", over="ignore"):
        return float(np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1).sum())


def _nothing(loops: Sequence[IntArray], points: FloatArray, wanted: Wanted) -> Diagnostic:
    text = "the mesh has no border: there is nothing to fill"
    if loops and wanted.longest_length:
        least = min(length_of(points[loop]) for loop in loops)
        text = f"no border loop is {wanted.longest_length:g} long or shorter; the shortest is {least:.4g} long"
    if loops and wanted.longest and all(len(loop) > wanted.longest for loop in loops):
        text = f"no border loop has {wanted.longest} edges or fewer; the shortest has {min(map(len, loops))}"
    figures = {"loops": float(len(loops))}
    return Diagnostic("NO_BOUNDARY", text, np.empty(0, np.int32), "vertex", figures)


def _torn(chain: IntArray) -> Diagnostic:
    ends = np.unique(chain[[0, -1]]).astype(np.int32)
    text = f"triangles are wound against each other at {_loops.listed(ends)}: the border ends there"
    return Diagnostic("NOT_A_LOOP", text, ends, "vertex", {"vertices": float(len(ends)), "torn": 1.0})


def _sound(
    outline: Outline, points: FloatArray, around: IntArray, wanted: Wanted
) -> tuple[Outline, FloatArray, Any, list[Left]]:
    """The loops that pass all checks, their normals (Σ k, 3), the given curvatures of these, and the others."""
    normals, curvatures = wanted.normals, wanted.curvatures
    if wanted.bridge or len(outline.loops) == 1:
        _loops.check(outline, points, wanted.bridge)
        return outline, _loops.loop_normals(normals, outline, points, around, wanted.hard), curvatures, []
    if not any(outline.bare) and _crossings.are_clear(outline.loops, points):
        return outline, _loops.loop_normals(normals, outline, points, around, wanted.hard), curvatures, []
    kept, left, first = [], [], None
    for k, loop in enumerate(outline.loops):
        try:
            _loops.check(_some(outline, [k]), points, False)
            kept.append(k)
        except MeshError as error:
            first = first or error
            left.append(Left(loop, error.diagnostic))
    if not kept:
        assert first is not None
        raise first
    sizes = [len(loop) for loop in outline.loops]
    rows = [_of_loops(each, sizes, kept, len(points)) for each in (normals, curvatures)]
    sound = _some(outline, kept)
    return sound, _loops.loop_normals(rows[0], sound, points, around, wanted.hard), rows[1], left


def _of_loops(rows: Any, sizes: list[int], kept: list[int], count: int) -> Any:
    """The caller's rows of these loops, where they are in the loops' order."""
    if rows is None or len(kept) == len(sizes):
        return rows
    if isinstance(rows, (list, tuple)) and len(rows) == len(sizes) and np.ndim(rows[0]):
        return [rows[k] for k in kept]
    if len(rows) != sum(sizes) or len(rows) == count:
        return rows
    parts = np.split(np.asarray(rows), np.cumsum(sizes)[:-1])
    return np.concatenate([parts[k] for k in kept])


def _without_outer(
    outline: Outline, points: FloatArray, normals: tuple[FloatArray, FloatArray], others: list[Left]
) -> tuple[Outline, FloatArray, list[Left]]:
    """The holes, their normals, and the outer borders; MeshError where there is no hole.

    normals: those that surfaces take, and those that hard edges don't stop: how a border turns is a matter of all that
    is around it.
    """
    rows, plain = outline.split(normals[0]), outline.split(normals[1])
    outer = [is_outer(points[loop], part) for loop, part in zip(outline.loops, plain, strict=True)]
    kept = [k for k, out in enumerate(outer) if not out]
    left = [Left(loop, _loops.not_holes([loop])) for loop, out in zip(outline.loops, outer, strict=True) if out]
    if not kept:
        raise MeshError(others[0].reason if others else _loops.not_holes([each.loop for each in left]))
    return _some(outline, kept), np.concatenate([rows[k] for k in kept]), left


def _is_outer(reason: Diagnostic) -> bool:
    return reason.code == "NOT_A_HOLE" and "endless" not in reason.figures


def _some(outline: Outline, numbers: Sequence[int]) -> Outline:
    turned, bare = (tuple(flags[k] for k in numbers) for flags in (outline.turned, outline.bare))
    return Outline(tuple(outline.loops[k] for k in numbers), turned, bare)


def _rows(outline: Outline, values: FloatArray) -> list[FloatArray]:
    return np.split(values, np.cumsum([len(loop) for loop in outline.loops])[:-1])
