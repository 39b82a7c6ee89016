"""Rounded seams."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core, _seams
from fairing._adopted import taken
from fairing._first_mesh import FirstMesh, first_mesh, without_specks
from fairing._groups import Options
from fairing._interpolate import interpolate
from fairing._measure import boundary_loops
from fairing._new_mesh import FilletResult, read_only, report_fields
from fairing._patch import Patch, Spacing, refuse_made_here
from fairing._proportion import Limit
from fairing._types import Diagnostic, FloatArray, IntArray, MeshError
from fairing._watch import Progress, Watch

_ROWS = 4  # edges across each side of a fillet by default: 90° then bend by less than 12° from row to row


def fillet(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    seam: npt.ArrayLike | None = None,
    options: Options | None = None,
    *,
    width: npt.ArrayLike,
    width_2: npt.ArrayLike | None = None,
    walls: npt.ArrayLike | None = None,
    profile: float = 0.0,
    spacing: float = 0.0,
    max_vertices: int = 0,
    progress: Progress | None = None,
    threads: int = 0,
    **before: Any,
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
    options : Options
        Those of :func:`fairing.fair` that don't concern the boundary, ``continuity`` among them: "G1" is tangent to
        both sides, "G2" continues their curvature, too.
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
    profile : float
        −1 … 1, flat to sharp. 0: the fair surface. Towards 1 it is drawn to the old one, towards −1 to the soap film
        over the line, so that ∫ |Δ(x − fair)|² + |x − that|² / ℓ⁴ is least, with ℓ = width · (1 / |profile| − 1) / 4:
        over that length the seam, or the chamfer's edges, stay rounded. It is tangent for all but ±1, which are these
        two themselves.
    spacing : float
        Length of the new edges. 0: a quarter of the least width.
    max_vertices : int
        More new vertices than that are refused, as by :func:`fairing.remesh`.
    progress : callable(fraction, stage) -> None | bool
        As for :func:`fairing.fair`.
    threads : int
        As for :func:`fairing.fair`.
    before
        Fields of ``options`` as keyword arguments: deprecated.

    Raises
    ------
    MeshError
        NO_SEAM; SEAM_ON_BORDER; NONMANIFOLD_EDGE (a seam of three triangles and more); INCONSISTENT_WINDING beside a
        seam; WIDTH_TOO_LARGE (nothing would be left of a part between seams, whose vertices are the ``elements``);
        OUT_OF_PROPORTION; and those of :func:`fairing.fair`.
    ValueError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fair`.
    """
    given = taken("fillet", options, before, threads)
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.triangles_within(triangles, len(points))
    _seams.check_finite(points, faces)
    refuse_made_here(given, progress)
    seams, ends = _seams.seams_and_walls(points, faces, seam, walls)
    widths = (
        _seams.width_of("width", width, seams, len(points)),
        _seams.width_of("width_2", width_2, seams, len(points)),
    )
    both = widths[0], widths[0] if width_2 is None else widths[1]
    length = _spacing(spacing, both, seams)
    _refuse_large(points, seams, both, length, max_vertices)
    shape = _arguments.finite("profile", profile)
    if abs(shape) > 1:
        raise ValueError(f"profile: a number from -1 to 1 is needed, not {profile!r}")
    watch = Watch(progress)
    cut = _core.cut_fillet(points, faces, seams.tolist(), ends.tolist(), both, length, watch.part(0, 0.2))
    if len(cut["swallowed"]):
        raise _too_wide(cut["swallowed"], both, seams)
    watch.lap("cut")
    return _filled(points, faces, seams, cut, Wishes(length, shape, both, ends, given, watch))


@dataclass(frozen=True)
class Wishes:
    """What a fillet's surface is to be like."""

    spacing: float
    profile: float
    widths: tuple[FloatArray, FloatArray]
    walls: IntArray
    options: dict[str, Any]
    watch: Watch


def _filled(points: FloatArray, faces: IntArray, seams: IntArray, cut: dict[str, Any], wishes: Wishes) -> FilletResult:
    """The new mesh within the line, faired."""
    watch, count = wishes.watch, len(points)
    placed = np.concatenate([points, cut["points"]])
    inside = cut["inside"] = without_specks(cut, placed, wishes.spacing)
    first = first_mesh(cut, placed, wishes.spacing)
    rim = np.isin(cut["boundary"], np.concatenate(boundary_loops(first.triangles)))
    patch = Patch(placed, first.triangles, cut["boundary"][rim], np.ascontiguousarray(cut["normals"][rim]))
    spacing = Spacing(wishes.spacing, even=True, flat=True)
    new, origin, on_seam = patch.meshed_anew(
        len(placed), first.lines, (spacing, 0), wishes.options, watch.part(0.2, 0.4)
    )
    watch.lap("mesh")
    chosen = dict(wishes.options)
    if chosen.get("continuity", "G1") == "G2":
        chosen["fixed_curvatures"] = cut["curvatures"][rim]
    report = new.faired("given", None, chosen, watch.part(0.4, 1.0))
    watch.lap("fair")
    kept = np.flatnonzero(~inside & _is_gone(cut["parent"], inside, len(faces))[cut["parent"]])
    old, weights = _origins(cut, origin, first, len(placed) - count)
    parents = np.concatenate(
        [cut["parent"][kept], _under(new.triangles, old, count, np.flatnonzero(on_seam >= 0) + len(placed))]
    )
    values = report_fields(report, count)
    if wishes.profile:
        carried = np.einsum("kc,kcd->kd", weights, points[faces[old]])
        before = np.concatenate([points, carried])
        drawn = _drawn(Patch(report.vertices, new.triangles, patch.fixed, None), before, seams, wishes)
        values.update(vertices=drawn[count:], mean_curvature=_curvatures(drawn, new, patch)[count:])
    triangles = np.concatenate([cut["triangles"][kept], new.triangles])
    used = np.unique(triangles[triangles >= count]) - count  # points on the seam are no vertices of the new mesh
    number = np.concatenate([np.arange(count), np.zeros(len(old), dtype=np.int64)])
    number[count + used] = count + np.arange(len(used))
    for name in ("vertices", "mean_curvature"):
        values[name] = read_only(values[name][used])
    values["triangles"] = read_only(number[triangles].astype(np.int32))
    values["fixed"] = read_only(number[values["fixed"]].astype(np.int32))
    values["seconds"] = {**values["seconds"], **watch.seconds}
    values["warnings"] = tuple(
        _renumbered(warning, number, len(kept))
        for warning in values["warnings"]
        if warning.code != "SHARP_BOUNDARY" or not len(cut["corners"])  # two sides of a seam meet there
    )
    return FilletResult(
        **values,
        gone=read_only(np.flatnonzero(_is_gone(cut["parent"], inside, len(faces))).astype(np.int32)),
        outside=len(kept),
        parent=read_only(parents.astype(np.int32)),
        origin=(read_only(old[used]), read_only(weights[used])),
        seam=read_only(seams),
        walls=read_only(wishes.walls),
        line=read_only(number[cut["line"]].astype(np.int32)),
    )


def _renumbered(warning: Diagnostic, number: npt.NDArray[np.int64], pieces: int) -> Diagnostic:
    """In the numbers of the result's vertices and triangles."""
    elements = warning.elements + pieces if warning.kind == "triangle" else number[warning.elements]
    return replace(warning, elements=read_only(elements.astype(np.int32)))


def _drawn(fair: Patch, before: FloatArray, seams: IntArray, wishes: Wishes) -> FloatArray:
    """(n, 3) the surface with its profile; ``before``: where its vertices were on the old one."""
    at, profile = fair.vertices, abs(wishes.profile)
    assert fair.fixed is not None
    target = before if wishes.profile > 0 else interpolate(at, fair.triangles, fair.fixed, at[fair.fixed])
    used = np.unique(fair.triangles)
    if profile == 1.0:
        drawn = at.copy()
        drawn[used] = target[used]
        return drawn
    ends = np.unique(seams)
    near = _nearest(before[used], before[ends])
    width = 0.5 * (wishes.widths[0][ends] + wishes.widths[1][ends])[near]
    pull = np.zeros(len(at))
    pull[used] = (4 * profile / ((1 - profile) * width)) ** 4
    return _core.drawn_to(at, fair.triangles, fair.fixed, target, pull)


def _nearest(places: FloatArray, ends: FloatArray) -> IntArray:
    """(k,) the nearest of the ends (s, 3), in blocks of places."""
    block = max(1, 2_000_000 // len(ends))
    found = [
        ((part[:, None] - ends[None]) ** 2).sum(axis=2).argmin(axis=1)
        for part in np.array_split(places, range(block, len(places), block))
    ]
    result: IntArray = np.concatenate(found)
    return result


def _curvatures(drawn: FloatArray, new: Patch, patch: Patch) -> FloatArray:
    return _core.mean_curvature(drawn, new.triangles, patch.fixed, patch.normals, "fitted")


def _is_gone(parent: IntArray, inside: npt.NDArray[np.bool_], count: int) -> npt.NDArray[np.bool_]:
    """(m,) which triangles do not stay: cut, within the fillet, or turned into the one beside."""
    gone: npt.NDArray[np.bool_] = np.bincount(parent, minlength=count) != 1
    gone[parent[inside]] = True
    return gone


def _origins(cut: dict[str, Any], origin: Any, within: FirstMesh, line_count: int) -> tuple[IntArray, FloatArray]:
    """Triangles (k,) of the old mesh and weights (k, 3) there, of the line's points and then of those within."""
    first = len(cut["points"])
    begin = cut["triangles"].max(initial=0) + 1 - first if first else 0
    place = np.zeros(line_count, dtype=np.int64)
    flat = cut["triangles"].ravel()
    on_line = np.flatnonzero(flat >= begin) if first else np.empty(0, np.int64)
    place[flat[on_line] - begin] = on_line
    inner = np.einsum("kc,kcw->kw", origin[1], within.weights[origin[0]])
    old = np.concatenate([cut["parent"][place // 3], within.parents[origin[0]]]).astype(np.int32)
    weights = np.concatenate([cut["weights"][place], inner])
    weights = np.clip(weights, 0.0, None)
    return old, weights / weights.sum(axis=1, keepdims=True)


def _under(triangles: IntArray, old: IntArray, count: int, on_seam: IntArray) -> IntArray:
    """The old triangle under one of each new one's corners: one that is on no seam, so that it is on the right side."""
    rank = np.arange(count + len(old))
    rank[:count] = -1
    rank[on_seam] = 0
    best = triangles[np.arange(len(triangles)), rank[triangles].argmax(axis=1)] - count
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
