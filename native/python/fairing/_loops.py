"""Loops to be filled: found, checked and turned so that the new surface lies on their left."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments
from fairing._crossings import crossing_edges, touches
from fairing._holes import is_endless, is_outer
from fairing._measure import boundary_loops
from fairing._outline import surrounding_normals
from fairing._types import Diagnostic, FloatArray, IntArray, MeshError


@dataclass(frozen=True)
class Outline:
    """Loops with the new surface on their left; ``turned`` are those that run against the caller's order."""

    loops: tuple[IntArray, ...]
    turned: tuple[bool, ...]
    bare: tuple[bool, ...]
    """Whether no triangle holds the loop."""

    @property
    def vertices(self) -> IntArray:
        return np.concatenate(self.loops)

    def split(self, rows: FloatArray) -> list[FloatArray]:
        """Rows in the loops' order, those of each loop apart."""
        return np.split(rows, np.cumsum([len(loop) for loop in self.loops])[:-1])

    def rows_of(self, rows: FloatArray, name: str, count: int, by_loop: bool) -> FloatArray:
        """Rows in the loops' order, of an argument with a row for each of the mesh's ``count`` vertices, or for each
        vertex of the loops, as the caller named these. Where it may be either, ``by_loop`` says which."""
        if len(rows) == count and not by_loop:
            of_loops: FloatArray = rows[self.vertices]
            return of_loops
        here = len(self.vertices)
        if len(rows) != here:
            text = f"{name}: {here} rows, one for each vertex of the loops, or {count}, one for each vertex of the mesh"
            raise ValueError(f"{text}, are needed, not {len(rows)}")
        parts = zip(self.split(rows), self.turned, strict=True)
        return np.concatenate([part[::-1] if turned else part for part, turned in parts])


def border_loops(triangles: IntArray, longest: int) -> Outline:
    """All border loops of up to ``longest`` edges (0: of any length)."""
    found = [loop[::-1].copy() for loop in boundary_loops(triangles)]
    chosen = [loop for loop in found if not longest or len(loop) <= longest]
    if not chosen:
        text = "the mesh has no border: there is nothing to fill"
        if found:
            text = f"no border loop has {longest} edges or fewer; the shortest has {min(map(len, found))}"
        raise MeshError(Diagnostic("NO_BOUNDARY", text, np.empty(0, np.int32), "vertex", {"loops": len(found)}))
    return Outline(tuple(chosen), (False,) * len(chosen), (False,) * len(chosen))


def without_outer(
    outline: Outline, vertices: FloatArray, normals: FloatArray
) -> tuple[Outline, FloatArray, tuple[IntArray, ...]]:
    """The holes among all border loops, their normals (Σ k, 3), and the outer borders that are left out.

    MeshError (NOT_A_HOLE) where no hole is left.
    """
    parts = outline.split(normals)
    outer = [is_outer(vertices[loop], part) for loop, part in zip(outline.loops, parts, strict=True)]
    left = tuple(loop for loop, out in zip(outline.loops, outer, strict=True) if out)
    if all(outer):
        raise MeshError(not_holes(left))
    holes = tuple(loop for loop, out in zip(outline.loops, outer, strict=True) if not out)
    kept = np.concatenate([part for part, out in zip(parts, outer, strict=True) if not out])
    return Outline(holes, (False,) * len(holes), (False,) * len(holes)), kept, left


def not_holes(loops: Sequence[IntArray]) -> Diagnostic:
    """Tells of outer borders that were left open; name them in `loops` to have them filled all the same."""
    edges = np.sort(np.concatenate(loops)).astype(np.int32)
    what = "1 border loop goes" if len(loops) == 1 else f"{len(loops)} border loops go"
    text = f"{what} around the outside of a sheet, at {listed(edges)}, and stay{'s' * (len(loops) == 1)} open"
    text += ": name a loop in `loops` to have it filled all the same"
    return Diagnostic("NOT_A_HOLE", text, edges, "vertex", {"loops": float(len(loops)), "vertices": float(len(edges))})


def refuse_endless(outline: Outline, vertices: FloatArray, normals: FloatArray) -> None:
    """MeshError (NOT_A_HOLE) for a loop over which lies no surface but the other side of a sheet without height."""
    for loop, part in zip(outline.loops, outline.split(normals), strict=True):
        if not is_endless(vertices[loop], part):
            continue
        text = f"the border loop at {listed(loop)} goes around the outside of a flat sheet: no surface closes it"
        figures = {"loops": 1.0, "vertices": float(len(loop)), "endless": 1.0}
        raise MeshError(Diagnostic("NOT_A_HOLE", text, np.sort(loop).astype(np.int32), "vertex", figures))


def given_loops(loops: Any, vertices: FloatArray, triangles: IntArray) -> Outline:
    """The caller's loops, in range; those along the mesh turned so that the new surface lies on their left."""
    if isinstance(loops, np.ndarray) and loops.ndim == 1 and loops.dtype != object:
        loops = [loops]
    if not isinstance(loops, (Sequence, np.ndarray)) or isinstance(loops, str) or not len(loops):
        raise ValueError("loops: a list of vertex indices for each loop is needed")
    if all(isinstance(entry, (int, np.integer)) for entry in loops):
        loops = [loops]
    named = [_arguments.integers("loops", loop, None) for loop in loops]
    inside = [_arguments.indices_within("loops", loop, len(vertices)) for loop in named]
    sides = _directed_edges(triangles, len(vertices))
    sense = [_sense(loop, sides, len(vertices)) for loop in inside]
    oriented = (loop[::-1].copy() if sign > 0 else loop for loop, sign in zip(inside, sense, strict=True))
    return Outline(tuple(oriented), tuple(sign > 0 for sign in sense), tuple(sign == 0 for sign in sense))


def check(outline: Outline, vertices: FloatArray, joined: bool) -> None:
    """MeshError where a loop is too short, passes a vertex or a place twice, touches another loop or is not finite.

    joined: whether one surface is to join all loops. Then no two of them may pass the same place either.
    """
    seen = outline.vertices
    for loop in outline.loops:
        if len(np.unique(loop)) < 3:
            _refuse("NOT_A_LOOP", f"a loop of {len(loop)} vertices bounds nothing: three are needed", loop)
        if len(np.unique(loop)) < len(loop):
            _refuse_pinch("a loop touches itself", _repeated(loop))
    twice = _repeated(seen)
    if len(twice):
        _refuse_pinch("two loops touch each other", twice)
    broken = seen[~np.isfinite(vertices[seen]).all(axis=1)]
    if len(broken):
        _refuse("NONFINITE", f"coordinates are not finite at {listed(broken)}", broken)
    for loop in outline.loops:
        after = np.roll(loop, -1)
        same = loop[(vertices[loop] == vertices[after]).all(axis=1)]
        if len(same):
            _refuse("NOT_A_LOOP", f"an edge of a loop has no length at {listed(same)}: merge these vertices", same)
    for loops in [outline.loops] if joined else [(loop,) for loop in outline.loops]:
        _refuse_touches(loops, vertices)
        crossing = np.unique(crossing_edges(loops, vertices))
        if len(crossing):
            text = f"edges of a boundary cross each other at {listed(crossing)}: move them apart"
            _refuse("NONMANIFOLD_VERTEX", text, crossing, crossing=float(len(crossing)))


def _refuse_pinch(what: str, twice: IntArray) -> None:
    text = f"{what} at {listed(twice)}: split these vertices"
    _refuse("NONMANIFOLD_VERTEX", text, twice, pinches=float(len(twice)))


def _refuse_touches(loops: Sequence[IntArray], vertices: FloatArray) -> None:
    """MeshError where vertices of one surface's boundary lie on its edges, or on each other."""
    found = touches(loops, vertices)
    if len(found.on_edges):
        edge, on_edge = found.on_edges[0, :2], found.on_edges[:, 2]
        here = on_edge[(found.on_edges[:, :2] == edge).all(axis=1)]
        lying = float(len(np.unique(on_edge)))
        what, them = ("lies on its", "it") if len(here) == 1 else ("lie on its", "them")
        more = f" ({lying:.0f} on edges in all)" if lying > len(here) else ""
        text = f"{listed(here)} of a boundary {what} edge {edge[0]}-{edge[1]}{more}: dissolve {them}"
        figures = {"on_edge" if lying == 1.0 else "on_edges": lying}
        _refuse(
            "NONMANIFOLD_VERTEX", f"{text}, or split that edge there and merge", np.append(edge, on_edge), **figures
        )
    meeting = np.unique(found.pairs)
    if len(meeting):
        advice = "merge them where the mesh is torn, move them apart where the boundary touches itself"
        text = f"a boundary passes through one place several times, with {listed(meeting)}: {advice}"
        _refuse("NONMANIFOLD_VERTEX", text, meeting, meeting=float(len(meeting)))


def loop_normals(
    normals: Any, outline: Outline, vertices: FloatArray, triangles: IntArray, hard: IntArray | None = None
) -> FloatArray:
    """(Σ k, 3) unit normals in the order of the loops; hard: (h, 2) edges across which no fit looks."""
    where = outline.vertices
    around = surrounding_normals(vertices, triangles, where, creases=hard).normals
    if normals is None:
        missing = where[~(np.linalg.norm(around, axis=1) > 0)]
        if len(missing):
            _refuse("ZERO_NORMAL", f"no triangle touches {listed(missing)}: pass `normals`", missing)
        return around
    given, by_loop = _stacked(normals, 2)
    rows = outline.rows_of(_arguments.floats("normals", given), "normals", len(vertices), by_loop)
    size = np.linalg.norm(rows, axis=1)
    bad = where[~(np.isfinite(size) & (size > 0))]
    if len(bad):
        _refuse("ZERO_NORMAL", f"normals: zero or not finite at {listed(bad)}", bad)
    cosine = (rows * around).sum(axis=1) / size
    against = where[cosine < 0]
    if 2 * len(against) <= len(where):
        against = where[cosine < -0.5]  # a few: not at a mere crease
    if len(against):
        text = f"normals: {len(against)} of {len(where)} point against the triangles around: turn them"
        _refuse("NORMALS_OPPOSE_WINDING", text, against)
    unit: FloatArray = rows / size[:, None]
    _check_across(unit, outline, vertices)
    return unit


def _check_across(normals: FloatArray, outline: Outline, vertices: FloatArray) -> None:
    """ValueError where most of the unit normals lie along the outline: they belong to other vertices."""
    along = [np.roll(vertices[loop], -1, axis=0) - np.roll(vertices[loop], 1, axis=0) for loop in outline.loops]
    tangents = np.concatenate(along)
    wrong = np.abs((normals * tangents).sum(axis=1)) > np.sqrt(0.5) * np.linalg.norm(tangents, axis=1)
    if 2 * wrong.sum() > len(normals):
        text = f"normals: {wrong.sum()} of {len(normals)} point along the boundary, not across it"
        raise ValueError(f"{text}: are the rows in the order of the vertices, or of the loops as they were named?")


def loop_curvatures(curvatures: Any, outline: Outline, count: int) -> FloatArray:
    """(Σ k,) mean curvatures in the order of the loops, NaN where not known; ``count``: of the mesh's vertices."""
    given, by_loop = _stacked(curvatures, 1)
    here = outline.vertices
    rows = (
        here if np.shape(given) == here.shape and (by_loop or len(here) != count) else np.arange(count, dtype=np.int32)
    )
    return outline.rows_of(_arguments.curvatures(given, rows), "fixed_curvatures", count, by_loop)


def _stacked(values: Any, dimensions: int) -> tuple[Any, bool]:
    """A list with an array of so many dimensions for each loop as one array, and whether it was one."""
    if isinstance(values, (list, tuple)) and len(values) and np.ndim(values[0]) == dimensions:
        return np.concatenate([np.asarray(rows) for rows in values]), True
    return values, False


def _directed_edges(triangles: IntArray, count: int) -> npt.NDArray[np.int64]:
    tails = triangles.astype(np.int64)
    return (tails * count + np.roll(tails, -1, axis=1)).ravel()


def _sense(loop: IntArray, sides: npt.NDArray[np.int64], count: int) -> int:
    """1 where the mesh lies on the loop's left, −1 on its right, 0 where there is none.

    MeshError where the loop is no border.
    """
    if len(loop) < 3:
        return 0  # `check` refuses it
    tails, heads = loop.astype(np.int64), np.roll(loop, -1).astype(np.int64)
    along = np.isin(tails * count + heads, sides)
    against = np.isin(heads * count + tails, sides)
    if (along & against).any():
        inner = _ends(loop, along & against)
        _refuse("NOT_A_LOOP", f"edges of a loop are no border, faces lie on both sides: {listed(inner)}", inner)
    if along.any() and not along.all():
        odd = _ends(loop, ~along)
        text = f"a loop leaves the border of the mesh, or the triangles' windings differ along it: {listed(odd)}"
        _refuse("NOT_A_LOOP", text, odd)
    if against.any() and not against.all():
        odd = _ends(loop, ~against)
        _refuse("NOT_A_LOOP", f"a loop leaves the border of the mesh at {listed(odd)}", odd)
    return int(along.all()) - int(against.all())


def _ends(loop: IntArray, edges: npt.NDArray[np.bool_]) -> IntArray:
    ends: IntArray = np.unique(np.concatenate([loop[edges], np.roll(loop, -1)[edges]]))
    return ends


def _repeated(indices: IntArray) -> IntArray:
    values, counts = np.unique(indices, return_counts=True)
    repeated: IntArray = values[counts > 1]
    return repeated


def listed(indices: IntArray) -> str:
    shown = ", ".join(str(index) for index in indices[:5])
    more = f" and {len(indices) - 5} more" if len(indices) > 5 else ""
    return f"vertex {shown}" if len(indices) == 1 else f"vertices {shown}{more}"


def _refuse(code: str, text: str, elements: IntArray, **figures: float) -> None:
    figures = {"vertices": float(len(elements)), **figures}
    raise MeshError(Diagnostic(code, text, np.asarray(elements, np.int32), "vertex", figures))


def check_doubles(new: IntArray, triangles: IntArray) -> None:
    """Raise MeshError where a new triangle has the corners of one that is there: a double wall."""
    old = {tuple(corners) for corners in np.sort(triangles, axis=1).tolist()}
    again = [corners for corners in np.sort(new, axis=1).tolist() if tuple(corners) in old]
    made = np.array(again, dtype=np.int32).reshape(-1, 3)
    if len(made):
        text = "loops: the surface would double back onto {} that stick{} out into a loop: remove {} first"
        words = ("1 triangle", "s", "it") if len(made) == 1 else (f"{len(made)} triangles", "", "them")
        figures = {"doubles": float(len(made))}
        raise MeshError(Diagnostic("NONMANIFOLD_EDGE", text.format(*words), np.unique(made), "vertex", figures))
