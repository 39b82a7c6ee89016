"""On which side of its loop a surface lies: by the loop's direction and the normals there, the surface on its left."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from fairing._loops import Outline, listed
from fairing._types import Diagnostic, FloatArray, IntArray, MeshError

_AWAY = -0.3  # mean cosine between the directions into the surface and to the other loops; −.17 at a bend of 200°
_ACROSS = 0.1  # of the same: the side of a loop whose surface leads neither there nor away is open
_FACING = 0.5  # of the same, and between normals and the directions from a loop's middle
_MOST_PLACES = 400  # of a loop, and of all others together
_TINY = 1e-300


def settled(outline: Outline, vertices: FloatArray, normals: FloatArray, joined: bool) -> tuple[Outline, FloatArray]:
    """The loops and their normals (Σ k, 3), those turned that no triangle holds and whose surface would lead away.

    MeshError: LOOPS_NOT_JOINED where the normals of two loops that face each other point to different sides.
    """
    joined = joined and len(outline.loops) > 1
    if not joined and not any(outline.bare):
        return outline, normals
    rims = _rims(outline, vertices, normals)
    away = [rim.way_to_others < _AWAY if joined else leads_outside(rim.points, rim.normals) for rim in rims]
    turns = [is_away and bare for is_away, bare in zip(away, outline.bare, strict=True)]
    result = replace(
        outline,
        loops=tuple(loop[::-1].copy() if turn else loop for loop, turn in zip(outline.loops, turns, strict=True)),
        turned=tuple(was != turn for was, turn in zip(outline.turned, turns, strict=True)),
    )
    parts = [rim.normals[::-1] if turn else rim.normals for rim, turn in zip(rims, turns, strict=True)]
    there = np.concatenate(parts)
    if joined:
        _check_sides(result, vertices, there)
    return result, there


def leads_outside(points: FloatArray, normals: FloatArray) -> bool:
    """Whether the surface on the left of a loop (k, 3) would lie outside of it, and be no ball either.

    It does around a sheet: the loop runs clockwise, seen from the normals. So does the hole that leaves little of a
    ball or a limb, but the normals there (k, 3), unit, lean outwards, or inwards, at most places, and by 6° in the
    mean.
    """
    clockwise, one_sided, least_lean = -0.5, 0.5, 0.1
    out = points - points.mean(axis=0)
    area = np.cross(out, np.roll(out, -1, axis=0)).sum(axis=0)
    size = np.linalg.norm(area)
    if not size > 1e-9 * (out * out).sum():
        return False
    axis = area / size
    if not (normals @ axis).mean() < clockwise:
        return False
    out -= np.outer(out @ axis, axis)
    lean = (normals * _unit(out)).sum(axis=1)
    return bool(abs(lean.mean()) < max(one_sided * np.abs(lean).mean(), least_lean))


def not_joined(outline: Outline, vertices: FloatArray, normals: FloatArray) -> MeshError:
    """Why no triangulation joins the loops: which of them leads away, and what to do."""
    ways = [rim.way_to_others for rim in _rims(outline, vertices, normals)]
    worst = int(np.argmin(ways))
    if ways[worst] > _ACROSS:
        text = "loops: no surface joins them; they cross or are linked, face away from each other, or are too many"
        return _refusal("LOOPS_NOT_JOINED", f"{text}: join fewer", outline.vertices, {})
    loop = outline.loops[worst]
    if outline.bare[worst]:
        what = "the surface would lead away from the others there"
        return _refused(outline, worst, what, "turn its normals or its direction")
    text = f"loops: no surface joins loop {worst} ({listed(loop)}) with the others: the triangles around it lie between"
    return _refusal("LOOPS_NOT_JOINED", f"{text}: cut them back, or leave it out", loop, {"between": float(len(loop))})


def _check_sides(outline: Outline, vertices: FloatArray, normals: FloatArray) -> None:
    """A tube that is seen from outside at one end and from inside at the other one crosses itself."""
    rims = _rims(outline, vertices, normals)
    if len(rims) != 2 or min(rim.way_to_others for rim in rims) < _FACING:
        return
    out = [float((rim.normals * _unit(rim.points - rim.points.mean(axis=0))).sum(axis=1).mean()) for rim in rims]
    if min(map(abs, out)) > _FACING and out[0] * out[1] < 0:
        inner = int(np.argmin(out))
        what = "its normals point to the axis of the tube, those of the other one away from it"
        raise _refused(outline, inner, what, "turn its normals")


def _refused(outline: Outline, k: int, what: str, advice: str) -> MeshError:
    loop = outline.loops[k]
    if not outline.bare[k]:
        advice = "flip the triangles around it" + (", or leave it out" if len(outline.loops) > 2 else "")
    text = f"loops: no surface joins loop {k} ({listed(loop)}) with the others, {what}: {advice}"
    return _refusal("LOOPS_NOT_JOINED", text, loop, {"turned": float(len(loop))})


@dataclass(frozen=True)
class _Rim:
    """A loop (k, 3), its normals, and where it leads."""

    points: FloatArray
    normals: FloatArray
    way_to_others: float
    """Mean cosine between the directions into its surface and to the other loops; 0 for a lone loop."""


def _rims(outline: Outline, vertices: FloatArray, normals: FloatArray) -> list[_Rim]:
    parts = outline.split(normals)
    rims = []
    for k, loop in enumerate(outline.loops):
        others = [vertices[other] for j, other in enumerate(outline.loops) if j != k]
        way = _way_to(np.concatenate(others), vertices[loop], parts[k]) if others else 0.0
        rims.append(_Rim(vertices[loop], parts[k], way))
    return rims


def _way_to(others: FloatArray, points: FloatArray, normals: FloatArray) -> float:
    along = np.roll(points, -1, axis=0) - np.roll(points, 1, axis=0)
    few = _spread(len(points))
    into = _unit(np.cross(normals[few], along[few]))
    across = others[_spread(len(others))][None] - points[few, None]
    near = (across * across).sum(axis=2).argmin(axis=1)
    toward = _unit(across[np.arange(len(few)), near])
    return float((into * toward).sum(axis=1).mean())


def _spread(count: int) -> IntArray:
    """Some of so many, evenly."""
    return np.unique(np.linspace(0, count - 1, min(count, _MOST_PLACES)).round().astype(np.int32))


def _unit(vectors: FloatArray) -> FloatArray:
    result: FloatArray = vectors / np.maximum(np.linalg.norm(vectors, axis=1), _TINY)[:, None]
    return result


def _refusal(code: str, text: str, elements: IntArray, figures: dict[str, float]) -> MeshError:
    return MeshError(Diagnostic(code, text, np.sort(elements).astype(np.int32), "vertex", figures))
