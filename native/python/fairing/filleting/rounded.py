"""What comes in the place of a seam: the surface, solved, and its new mesh."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.maps import interpolate
from fairing.measure import boundary_loops, nearest
from fairing.meshing.remesh import Patch, Spacing, Watch, halves_of
from fairing.results import Diagnostic, FilletResult, FloatArray, IntArray, Progress, read_only, report_fields

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Wishes:
    """What a fillet's surface is to be like."""

    spacing: float
    profile: float
    widths: tuple[FloatArray, FloatArray]
    walls: IntArray
    options: dict[str, Any]
    watch: Watch
    in_rows: bool = False


@dataclass(frozen=True)
class Given:
    """A mesh, and its seams."""

    points: FloatArray
    triangles: IntArray
    seams: IntArray

    def cut(self, wishes: Wishes, progress: Progress | None) -> dict[str, Any]:
        """Cut along the line that suits triangles."""
        edges = self.seams.tolist(), wishes.walls.tolist()
        return _core.cut_fillet(
            self.points, self.triangles, edges, wishes.widths, wishes.spacing, not wishes.in_rows, progress
        )


@dataclass(frozen=True)
class Made:
    """A surface's mesh. Numbers: the caller's n vertices, the line's points, new ones."""

    cut: dict[str, Any]
    triangles: IntArray
    vertices: FloatArray
    """(n + l + k, 3)"""
    patch: Patch
    old: IntArray
    """(l + k,) under each of the line's points and of the new ones, the old triangle,"""
    weights: FloatArray
    """(l + k, 3) and where there."""
    on_seam: IntArray
    """Vertices that lie on a seam."""
    values: dict[str, Any]
    """Fields of the result that don't depend on the numbers, and `mean_curvature` (l + k,), `fixed`, `warnings`."""


def solved(given: Given, cut: dict[str, Any], wishes: Wishes) -> Made:
    """The new mesh within the line, faired."""
    watch, count = wishes.watch, len(given.points)
    placed = np.concatenate([given.points, cut["points"]])
    inside, pieces, triangles, lines = _core.first_mesh(
        placed, cut["triangles"], cut["inside"], cut["seams"], cut["spacings"]
    )
    cut = {**cut, "inside": inside}
    rim = np.isin(cut["boundary"], np.concatenate(boundary_loops(triangles)))
    patch = Patch(placed, triangles, cut["boundary"][rim], np.ascontiguousarray(cut["normals"][rim]))
    spacing = Spacing(wishes.spacing, even=True, flat=True, each=cut["spacings"])
    new, origin, on_seam = patch.remeshed(len(placed), lines, spacing, wishes.options, watch.part(0.2, 0.4))
    watch.lap("mesh")
    chosen = dict(wishes.options)
    if chosen.get("continuity", "G1") == "G2":
        chosen["fixed_curvatures"] = cut["curvatures"][rim]
    begun = _core.least_bent(new.vertices, new.triangles, patch.fixed)
    report = replace(new, vertices=begun).faired(chosen, watch.part(0.4, 1.0))
    watch.lap("fair")
    old, weights = _origins(cut, origin, pieces, count)
    values = report_fields(report, count)
    vertices = report.vertices
    if wishes.profile:
        carried = np.einsum("kc,kcd->kd", weights, given.points[given.triangles[old]])
        before = np.concatenate([given.points, carried])
        vertices = _drawn(Patch(vertices, new.triangles, patch.fixed, None), before, given.seams, wishes)
        curvature = _core.mean_curvature(vertices, new.triangles, patch.fixed, patch.normals, "fitted")
        values["mean_curvature"] = curvature[count:]
    seam_points = np.flatnonzero(on_seam >= 0) + len(placed)
    values["warnings"] = tuple(
        warning for warning in values["warnings"]
        if warning.code != "SHARP_BOUNDARY" or not len(cut["corners"])  # two sides of a seam meet there
    )  # fmt: skip
    fair = Patch(vertices, new.triangles, patch.fixed, patch.normals)
    return Made(cut, new.triangles, vertices, fair, old, weights, seam_points, values)


def result_of(given: Given, made: Made, wishes: Wishes) -> FilletResult:
    """With the pieces outside, and without vertices that are in none of the triangles."""
    count, cut, inside = len(given.points), made.cut, made.cut["inside"]
    gone = _is_gone(cut, inside, given.triangles)
    kept = np.flatnonzero(~inside & gone[cut["parent"]])
    parents = np.concatenate([cut["parent"][kept], _under(made.triangles, made.old, count, made.on_seam)])
    triangles = np.concatenate([cut["triangles"][kept], made.triangles])
    used = np.unique(triangles[triangles >= count]) - count  # points on the seam are no vertices of the new mesh
    number = np.concatenate([np.arange(count), np.zeros(len(made.old), dtype=np.int64)])
    number[count + used] = count + np.arange(len(used))
    values = dict(made.values)
    values["vertices"] = read_only(made.vertices[count:][used])
    values["mean_curvature"] = read_only(values["mean_curvature"][used])
    values["triangles"] = read_only(number[triangles].astype(np.int32))
    values["fixed"] = read_only(number[values["fixed"]].astype(np.int32))
    values["seconds"] = {**values["seconds"], **wishes.watch.seconds}
    values["warnings"] = tuple(_renumbered(warning, number, len(kept)) for warning in values["warnings"])
    return FilletResult(
        **values,
        gone=read_only(np.flatnonzero(gone).astype(np.int32)),
        outside=len(kept),
        parent=read_only(parents.astype(np.int32)),
        origin=(read_only(made.old[used]), read_only(made.weights[used])),
        seam=read_only(given.seams),
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
    near = nearest(before[used], before[ends])
    width = 0.5 * (wishes.widths[0][ends] + wishes.widths[1][ends])[near]
    pull = np.zeros(len(at))
    pull[used] = (4 * profile / ((1 - profile) * width)) ** 4
    return _core.drawn_to(at, fair.triangles, fair.fixed, target, pull)


def _is_gone(cut: dict[str, Any], inside: Mask, triangles: IntArray) -> Mask:
    """(m,) which triangles do not stay: cut, within the fillet, or turned into the one beside."""
    parent = cut["parent"]
    gone: Mask = np.bincount(parent, minlength=len(triangles)) != 1
    gone[parent[inside | (cut["triangles"] != triangles[parent]).any(axis=1)]] = True
    return gone


def line_places(cut: dict[str, Any], begin: int) -> tuple[IntArray, FloatArray]:
    """Old triangles (l,) of the line's points, which have the numbers from `begin` on, and weights (l, 3) there."""
    place = np.zeros(len(cut["points"]), dtype=np.int64)
    flat = cut["triangles"].ravel()
    on_line = np.flatnonzero(flat >= begin)
    for within in (False, True):  # at the ends of seams the fillet's own side counts, not the face that it cuts
        those = on_line[cut["inside"][on_line // 3] == within]
        place[flat[those] - begin] = those
    return cut["parent"][place // 3], cut["weights"][place]


def _origins(cut: dict[str, Any], origin: Any, pieces: IntArray, count: int) -> tuple[IntArray, FloatArray]:
    """Triangles (k,) of the old mesh and weights (k, 3) there, of the line's points and then of those within."""
    on_line, line_weights = line_places(cut, count)
    rows = pieces[origin[0]]
    inner = np.einsum("kc,kcw->kw", origin[1], cut["weights"].reshape(-1, 3, 3)[rows])
    old = np.concatenate([on_line, cut["parent"][rows]]).astype(np.int32)
    weights = np.clip(np.concatenate([line_weights, inner]), 0.0, None)
    return old, weights / weights.sum(axis=1, keepdims=True)


def _under(triangles: IntArray, old: IntArray, count: int, on_seam: IntArray) -> IntArray:
    """The old triangle under one of each new one's corners: one that is on no seam, so that it is on the right side."""
    rank = np.arange(count + len(old))
    rank[:count] = -1
    rank[on_seam] = 0
    best = triangles[np.arange(len(triangles)), rank[triangles].argmax(axis=1)] - count
    result: IntArray = old[np.maximum(best, 0)]
    return result


def in_rows(
    given: Given, made: Made, wishes: Wishes, spacing: float, counted: IntArray | None, progress: Progress | None
) -> tuple[Made, IntArray] | None:
    """And the pairs (q, 2) of its triangles that are quads; None where no rows fit."""
    carried = np.einsum("kc,kcd->kd", made.weights, given.points[given.triangles[made.old]])
    before = np.concatenate([given.points, carried])
    fixed, normals = made.patch.fixed, made.patch.normals
    assert fixed is not None
    assert normals is not None
    rows = _core.fillet_rows(
        given.points, given.triangles, (given.seams.tolist(), wishes.walls.tolist()), wishes.widths,
        (wishes.spacing, spacing), None if counted is None else counted.tolist(),
        (made.vertices, made.triangles, fixed, normals, before, made.cut["inside"].tolist()), progress,
    )  # fmt: skip
    if rows is None:
        return None
    vertices = np.concatenate([made.vertices, rows["places"]])
    triangles = np.concatenate([halves_of(vertices, rows["quads"]), rows["triangles"]])
    known, stays = made.values["mean_curvature"], np.isin(made.values["fixed"], triangles)
    corners = made.triangles[rows["solved"]] - len(given.points)
    inner = (np.where(corners < 0, 0.0, known[np.maximum(corners, 0)]) * rows["on_solved"]).sum(axis=1)
    values = {
        **made.values, "cut": True, "polished": False, "mean_curvature": np.concatenate([known, inner]),
        **{name: read_only(made.values[name][stays]) for name in ("fixed", "boundary_angle", "join")},
        "warnings": tuple(_moved(warning, made, vertices, triangles) for warning in made.values["warnings"]),
    }  # fmt: skip
    rowed = replace(
        made, cut={**rows["cut"], "eaten": made.cut["eaten"]}, triangles=triangles,
        vertices=vertices, patch=Patch(vertices, triangles, values["fixed"], None),
        old=np.concatenate([made.old, rows["given"]]).astype(np.int32),
        weights=np.concatenate([made.weights, rows["on_given"]]),
        on_seam=np.concatenate([made.on_seam, len(made.vertices) + np.flatnonzero(rows["on_seam"])]), values=values,
    )  # fmt: skip
    count = len(rows["quads"])
    return rowed, np.arange(2 * count, dtype=np.int32).reshape(2, count).T.copy()


def _moved(warning: Diagnostic, made: Made, vertices: FloatArray, triangles: IntArray) -> Diagnostic:
    """For what it names on the solved mesh the nearest vertices of the one with rows."""
    names = warning.elements if warning.kind == "vertex" else made.triangles[warning.elements].ravel()
    used = np.unique(triangles)
    near = used[np.unique(nearest(made.vertices[names], vertices[used]))]
    return replace(warning, elements=read_only(near.astype(np.int32)), kind="vertex")
