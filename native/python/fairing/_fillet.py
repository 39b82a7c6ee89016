"""Rounded seams."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core, _seams
from fairing._fill import Patch, Spacing, refuse_made_here
from fairing._measure import boundary_loops
from fairing._new_mesh import FilletResult, read_only, report_fields
from fairing._proportion import Limit
from fairing._types import Diagnostic, FloatArray, IntArray, MeshError
from fairing._watch import Progress, Watch

_ROWS = 4  # edges across each side of a fillet by default: 90° then bend by less than 12° from row to row


def fillet(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    seam: npt.ArrayLike | None = None,
    *,
    width: npt.ArrayLike,
    width_2: npt.ArrayLike | None = None,
    walls: npt.ArrayLike | None = None,
    spacing: float = 0.0,
    max_vertices: int = 0,
    progress: Progress | None = None,
    **options: Any,
) -> FilletResult:
    """Round seams: replace what lies within ``width`` of them, along the surface, by the fairest surface.

    The mesh is cut along the line at that distance, which is exact: straight beside straight seams, also where
    triangles are large. Outside nothing changes but the triangles that the line passes; their pieces stay in their
    planes. Within comes a new mesh. Its slopes at the line are those of each side, fitted without crossing a seam.
    Between two planes the surface is the circular arc that touches both at the line, but for the ends of the seam,
    where it fades into what is there. No argument is ever changed.

    Parameters
    ----------
    vertices : (n, 3) float
    triangles : (m, 3) int
    seam : (e, 2) int
        Edges between two triangles. Default: all of :func:`fairing.hard_edges`.
    width : float or (n,) float
        How far the fillet reaches on either side, a length; of the vertices, where it varies: those of the seams count,
        and lengths in between are interpolated along each edge.
    width_2 : float or (n,) float
        The same on the other side, where that differs: ``width`` is that of the larger part, by the area that hangs
        together without seams and walls, ``width_2`` that of the smaller one. Where both are one, or of one size,
        ``width`` lies on the left of the first edge given, and of those that follow each other from there.
    walls : (w, 2) int
        Edges that a fillet does not reach over: it ends there, tangent to its own side. Default: the other hard edges.
        Open borders always are walls.
    spacing : float
        Length of the new edges. 0: a quarter of the least width.
    max_vertices : int
        More new vertices than that are refused, as by :func:`fairing.remesh`.
    progress : callable(fraction, stage) -> None | bool
        As for :func:`fairing.fair`.
    options
        Those of :func:`fairing.fair` that don't concern the boundary, ``continuity`` among them: "G1" is tangent to
        both sides, "G2" continues their curvature, too.

    Raises
    ------
    MeshError
        NO_SEAM; SEAM_ON_BORDER; NONMANIFOLD_EDGE (a seam of three triangles and more); INCONSISTENT_WINDING beside a
        seam; WIDTH_TOO_LARGE (nothing would be left of a part between seams, whose vertices are the ``elements``);
        OUT_OF_PROPORTION; and those of :func:`fairing.fair`.
    ValueError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fair`.
    """
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.triangles_within(triangles, len(points))
    _seams.check_finite(points, faces)
    refuse_made_here(options, progress)
    seams, ends = _seams.seams_and_walls(points, faces, seam, walls)
    widths = (
        _seams.width_of("width", width, seams, len(points)),
        _seams.width_of("width_2", width_2, seams, len(points)),
    )
    both = widths[0], widths[0] if width_2 is None else widths[1]
    length = _spacing(spacing, both, seams)
    _refuse_large(points, seams, both, length, max_vertices)
    watch = Watch(progress)
    cut = _core.cut_fillet(points, faces, seams.tolist(), ends.tolist(), both, length, watch.part(0, 0.2))
    if len(cut["swallowed"]):
        raise _too_wide(cut["swallowed"], both, seams)
    watch.lap("cut")
    return _filled(points, seams, cut, Wishes(length, options, watch))


@dataclass(frozen=True)
class Wishes:
    """What a fillet's surface is to be like."""

    spacing: float
    options: dict[str, Any]
    watch: Watch


def _filled(points: FloatArray, seams: IntArray, cut: dict[str, Any], wishes: Wishes) -> FilletResult:
    """The new mesh within the line, faired."""
    watch, count = wishes.watch, len(points)
    inside = cut["inside"]
    placed = np.concatenate([points, cut["points"]])
    pieces, faces, lines = _thinned(cut, placed, wishes.spacing)
    patch = Patch(placed, faces, cut["boundary"], cut["normals"])
    spacing = Spacing(wishes.spacing, even=True, flat=True)
    new, origin, _ = patch.meshed_anew(len(placed), lines, (spacing, 0), wishes.options, watch.part(0.2, 0.4))
    watch.lap("mesh")
    chosen = dict(wishes.options)
    if chosen.get("continuity", "G1") == "G2":
        chosen["fixed_curvatures"] = cut["curvatures"]
    report = new.faired("given", None, chosen, watch.part(0.4, 1.0))
    watch.lap("fair")
    kept = np.flatnonzero(~inside & _touched(cut["parent"], inside))
    old, weights = _origins(cut, origin, pieces, len(placed) - count)
    parents = np.concatenate([cut["parent"][kept], _under(new.triangles, old, count)])
    values = report_fields(report, count)
    triangles = np.concatenate([cut["triangles"][kept], new.triangles])
    used = np.unique(triangles[triangles >= count]) - count  # points on the seam are no vertices of the new mesh
    number = np.concatenate([np.arange(count), np.zeros(len(old), dtype=np.int64)])
    number[count + used] = count + np.arange(len(used))
    for name in ("vertices", "mean_curvature"):
        values[name] = read_only(values[name][used])
    values["triangles"] = read_only(number[triangles].astype(np.int32))
    values["fixed"] = read_only(number[values["fixed"]].astype(np.int32))
    values["seconds"] = {**values["seconds"], **watch.seconds}
    values["warnings"] = tuple(w for w in values["warnings"] if w.code != "SHARP_BOUNDARY" or not len(cut["corners"]))
    return FilletResult(
        **values,
        gone=read_only(np.unique(cut["parent"][_touched(cut["parent"], inside)]).astype(np.int32)),
        outside=len(kept),
        parent=read_only(parents.astype(np.int32)),
        origin=(read_only(old[used]), read_only(weights[used])),
        seam=read_only(seams),
        line=read_only(number[cut["line"]].astype(np.int32)),
    )


def _touched(parent: IntArray, inside: npt.NDArray[np.bool_]) -> npt.NDArray[np.bool_]:
    """Which pieces are of triangles that do not stay."""
    pieces = np.bincount(parent)
    gone = np.zeros(len(pieces), dtype=bool)
    gone[parent[inside]] = True
    touched: npt.NDArray[np.bool_] = (gone | (pieces > 1))[parent]
    return touched


def _thinned(cut: dict[str, Any], placed: FloatArray, spacing: float) -> tuple[IntArray, IntArray, IntArray]:
    """Pieces within the fillet (p,), their triangles (p, 3), and the seam's edges (l, 2): a new mesh begins with these.

    Where these are far shorter than the spacing, as a boolean leaves them, they are closed: only a first mesh of the
    surface is made with them, and it would be as fine.
    """
    whole = np.flatnonzero(cut["inside"])
    triangles, lines = np.ascontiguousarray(cut["triangles"][whole]), cut["seams"]
    merged = _merged(lines, placed, cut["boundary"], 0.5 * spacing)
    closed = merged[triangles]
    stays = (closed != np.roll(closed, 1, axis=1)).all(axis=1)
    closed = closed[stays].astype(np.int32)
    sides = closed[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    keys = np.sort(sides[:, 0].astype(np.int64) * _seams.LARGE + sides[:, 1])
    if (keys[1:] == keys[:-1]).any() or len(boundary_loops(closed)) != len(boundary_loops(triangles)):
        return whole, triangles, _between(lines, triangles)
    ends = merged[lines]
    ends = np.unique(np.sort(ends[ends[:, 0] != ends[:, 1]], axis=1), axis=0).astype(np.int32)
    return whole[stays], np.ascontiguousarray(closed), _between(ends, closed)


def _between(lines: IntArray, triangles: IntArray) -> IntArray:
    """Those that are edges of two triangles."""
    sides = triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
    known, uses = np.unique(_seams.keys_of(sides), return_counts=True)
    inner: IntArray = np.ascontiguousarray(lines[np.isin(_seams.keys_of(lines), known[uses == 2])], dtype=np.int32)
    return inner


def _merged(lines: IntArray, placed: FloatArray, boundary: IntArray, least: float) -> npt.NDArray[np.int64]:
    """(n,) the vertex that each becomes where edges shorter than that are closed; those of the boundary stay."""
    stays = np.zeros(len(placed), dtype=bool)
    stays[boundary] = True
    branches = np.flatnonzero(np.bincount(lines.ravel(), minlength=len(placed)) > 2)
    stays[branches] = True
    merged = np.arange(len(placed))

    def top(vertex: int) -> int:
        while merged[vertex] != vertex:
            vertex = int(merged[vertex])
        return vertex

    lengths = np.linalg.norm(placed[lines[:, 0]] - placed[lines[:, 1]], axis=1)
    short = np.flatnonzero(lengths < least)
    for k in short[np.argsort(lengths[short], kind="stable")].tolist():
        a, b = top(int(lines[k, 0])), top(int(lines[k, 1]))
        if a == b or (stays[a] and stays[b]) or np.linalg.norm(placed[a] - placed[b]) >= least:
            continue
        merged[a if stays[b] else b] = b if stays[b] else a
    return np.array([top(vertex) for vertex in range(len(placed))]) if len(short) else merged


def _origins(cut: dict[str, Any], origin: Any, inside: IntArray, line_count: int) -> tuple[IntArray, FloatArray]:
    """Triangles (k,) of the old mesh and weights (k, 3) there, of the line's points and then of those within."""
    corners = cut["weights"].reshape(-1, 3, 3)
    first = len(cut["points"])
    begin = cut["triangles"].max(initial=0) + 1 - first if first else 0
    place = np.zeros(line_count, dtype=np.int64)
    flat = cut["triangles"].ravel()
    on_line = np.flatnonzero(flat >= begin) if first else np.empty(0, np.int64)
    place[flat[on_line] - begin] = on_line
    piece = inside[origin[0]]
    within = np.einsum("kc,kcw->kw", origin[1], corners[piece])
    old = np.concatenate([cut["parent"][place // 3], cut["parent"][piece]]).astype(np.int32)
    weights = np.concatenate([cut["weights"][place], within])
    weights = np.clip(weights, 0.0, None)
    return old, weights / weights.sum(axis=1, keepdims=True)


def _under(triangles: IntArray, old: IntArray, count: int) -> IntArray:
    """The old triangle under one of each new one's corners: the last, which most often is no old vertex."""
    best = triangles.max(axis=1) - count
    result: IntArray = old[np.maximum(best, 0)]
    return result


def _spacing(value: Any, widths: tuple[FloatArray, FloatArray], seams: IntArray) -> float:
    if _arguments.finite("spacing", value) < 0:
        raise ValueError(f"spacing: a length, or 0 for a quarter of the least width, is needed, not {value!r}")
    return float(value) or min(float(side[seams].min()) for side in widths) / _ROWS


def _refuse_large(
    points: FloatArray, seams: IntArray, widths: tuple[FloatArray, FloatArray], spacing: float, most: Any
) -> None:
    """MeshError where so many vertices are wanted that a slip in the spacing is likelier than a wish."""
    lengths = np.linalg.norm(points[seams[:, 0]] - points[seams[:, 1]], axis=1)
    usual, wanted = (
        sum(float((lengths * side[seams].mean(axis=1) / edge**2).sum()) for side in widths)
        for edge in (min(float(side[seams].min()) for side in widths) / _ROWS, spacing)
    )
    Limit.of(usual, most).check(wanted, seams.ravel())


def _too_wide(vertices: IntArray, widths: tuple[FloatArray, FloatArray], seams: IntArray) -> MeshError:
    widest = max(float(side[seams].max()) for side in widths)
    text = "width: nothing would be left of a part between seams; a smaller width is needed, or one of its seams less"
    figures = {"width": widest, "vertices": float(len(vertices))}
    return MeshError(Diagnostic("WIDTH_TOO_LARGE", text, vertices, "vertex", figures))
