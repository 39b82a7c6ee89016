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
from fairing.results import Diagnostic, FilletResult, FloatArray, IntArray, read_only, report_fields

Mask = npt.NDArray[np.bool_]


@dataclass(frozen=True)
class Task:
    """A mesh, its seams, and what their surface is to be like."""

    points: FloatArray
    triangles: IntArray
    seams: IntArray
    walls: IntArray
    widths: tuple[FloatArray, FloatArray]
    spacing: float
    profile: float
    options: dict[str, Any]
    watch: Watch
    in_rows: bool

    @property
    def largest(self) -> float:
        """The largest width at a seam."""
        return max(float(side[self.seams].max()) for side in self.widths)

    def cut(self) -> dict[str, Any]:
        """Cut along the line that suits triangles."""
        edges, progress = (self.seams, self.walls), self.watch.part(0, 0.2)
        return _core.cut_fillet(
            self.points, self.triangles, edges, self.widths, self.spacing, not self.in_rows, progress
        )


@dataclass(frozen=True)
class Made:
    """A surface's mesh. Numbers: the caller's n vertices, the line's points, new ones."""

    cut: dict[str, Any]
    patch: Patch
    """Its (n + l + k, 3) vertices and triangles, and what is fixed."""
    old: IntArray
    """(l + k,) under each of the line's points and of the new ones, the old triangle,"""
    weights: FloatArray
    """(l + k, 3) and where there."""
    on_seam: IntArray
    """Vertices that lie on a seam."""
    values: dict[str, Any]
    """Fields of the result that don't depend on the numbers, and `mean_curvature` (l + k,), `fixed`, `warnings`."""

    def before(self, task: Task) -> FloatArray:
        """(n + l + k, 3) where the vertices were on the old surface."""
        carried = np.einsum("kc,kcd->kd", self.weights, task.points[task.triangles[self.old]])
        return np.concatenate([task.points, carried])


def solved(task: Task, cut: dict[str, Any]) -> Made:
    """The new mesh within the line, faired."""
    watch, count = task.watch, len(task.points)
    placed = np.concatenate([task.points, cut["points"]])
    inside, pieces, triangles, lines = _core.first_mesh(
        placed, cut["triangles"], cut["inside"], cut["seams"], cut["spacings"]
    )
    cut = {**cut, "inside": inside}
    rim = np.isin(cut["boundary"], np.concatenate(boundary_loops(triangles)))
    patch = Patch(placed, triangles, cut["boundary"][rim], np.ascontiguousarray(cut["normals"][rim]))
    spacing = Spacing(task.spacing, even=True, flat=True, each=cut["spacings"])
    new, origin, on_seam = patch.remeshed(len(placed), lines, spacing, task.options, watch.part(0.2, 0.4))
    watch.lap("mesh")
    begun = _core.least_bent(new.vertices, new.triangles, patch.fixed)
    chosen = {**task.options, "start": "kept", "reference": begun}
    if chosen.get("continuity", "G1") == "G2":
        chosen["fixed_curvatures"] = cut["curvatures"][rim]
    begun = _core.least_bent(begun, new.triangles, patch.fixed)  # the first still has the seams' angles in its metric
    report = replace(new, vertices=begun).faired(chosen, watch.part(0.4, 1.0))
    watch.lap("fair")
    values = report_fields(report, count)
    values["warnings"] = tuple(
        warning for warning in values["warnings"]
        if warning.code != "SHARP_BOUNDARY" or not len(cut["corners"])  # two sides of a seam meet there
    )  # fmt: skip
    seam_points = np.flatnonzero(on_seam >= 0) + len(placed)
    fair = replace(new, vertices=report.vertices)
    made = Made(cut, fair, *_origins(cut, origin, pieces, count), seam_points, values)
    if not task.profile:
        return made
    drawn = _drawn(task, made)
    curvature = _core.mean_curvature(drawn, fair.triangles, fair.fixed, fair.normals, "fitted")
    return replace(
        made, patch=replace(fair, vertices=drawn), values={**values, "mean_curvature": curvature[count:]}
    )  # fmt: skip


def result_of(task: Task, made: Made) -> FilletResult:
    """With the pieces outside, and without vertices that are in none of the triangles."""
    count, cut, new = len(task.points), made.cut, made.patch.triangles
    parent = cut["parent"]
    gone = np.bincount(parent, minlength=len(task.triangles)) != 1  # cut, within the fillet, or turned into another
    gone[parent[cut["inside"] | (cut["triangles"] != task.triangles[parent]).any(axis=1)]] = True
    kept = np.flatnonzero(~cut["inside"] & gone[parent])
    triangles = np.concatenate([cut["triangles"][kept], new])
    used = np.unique(triangles[triangles >= count]) - count  # points on the seam are no vertices of the new mesh
    number = np.concatenate([np.arange(count), np.zeros(len(made.old), dtype=np.int64)])
    number[count + used] = count + np.arange(len(used))
    # Under a new triangle lies what is under a corner of it that is on no seam: on the right side.
    rank = np.concatenate([np.full(count, -1), np.arange(count, count + len(made.old))])
    rank[made.on_seam] = 0
    best = new[np.arange(len(new)), rank[new].argmax(axis=1)] - count
    values = dict(made.values)
    values["seconds"] = {**values["seconds"], **task.watch.seconds}
    values["warnings"] = tuple(_renumbered(warning, number, len(kept)) for warning in values["warnings"])
    numbered = {"triangles": number[triangles], "fixed": number[values["fixed"]], "line": number[cut["line"]]}
    numbered |= {"gone": np.flatnonzero(gone), "parent": np.append(parent[kept], made.old[np.maximum(best, 0)])}
    values |= {name: read_only(each.astype(np.int32)) for name, each in numbered.items()}
    values["vertices"] = read_only(made.patch.vertices[count:][used])
    values["mean_curvature"] = read_only(values["mean_curvature"][used])
    origin = read_only(made.old[used]), read_only(made.weights[used])
    seam, walls = read_only(task.seams), read_only(task.walls)
    return FilletResult(**values, outside=len(kept), origin=origin, seam=seam, walls=walls)


def _renumbered(warning: Diagnostic, number: npt.NDArray[np.int64], pieces: int) -> Diagnostic:
    """In the numbers of the result's vertices and triangles."""
    elements = warning.elements + pieces if warning.kind == "triangle" else number[warning.elements]
    return replace(warning, elements=read_only(elements.astype(np.int32)))


def _drawn(task: Task, made: Made) -> FloatArray:
    """(n + l + k, 3) the surface with its profile."""
    at, triangles, fixed = made.patch.vertices, made.patch.triangles, made.patch.fixed
    assert fixed is not None
    profile, before = abs(task.profile), made.before(task)
    target = before if task.profile > 0 else interpolate(at, triangles, fixed, at[fixed])
    used = np.unique(triangles)
    if profile == 1.0:
        drawn = at.copy()
        drawn[used] = target[used]
        return drawn
    ends = np.unique(task.seams)
    near = nearest(before[used], before[ends])
    width = 0.5 * (task.widths[0][ends] + task.widths[1][ends])[near]
    pull = np.zeros(len(at))
    pull[used] = (4 * profile / ((1 - profile) * width)) ** 4
    return _core.drawn_to(at, triangles, fixed, target, pull)


def _origins(cut: dict[str, Any], origin: Any, pieces: IntArray, begin: int) -> tuple[IntArray, FloatArray]:
    """Triangles (k,) of the old mesh and weights (k, 3) there, of the line's points and then of those within.

    The line's points have the numbers from ``begin`` on.
    """
    place = np.zeros(len(cut["points"]), dtype=np.int64)
    flat = cut["triangles"].ravel()
    on_line = np.flatnonzero(flat >= begin)
    for within in (False, True):  # at the ends of seams the fillet's own side counts, not the face that it cuts
        those = on_line[cut["inside"][on_line // 3] == within]
        place[flat[those] - begin] = those
    rows = pieces[origin[0]]
    inner = np.einsum("kc,kcw->kw", origin[1], cut["weights"].reshape(-1, 3, 3)[rows])
    old = np.concatenate([cut["parent"][place // 3], cut["parent"][rows]]).astype(np.int32)
    weights = np.clip(np.concatenate([cut["weights"][place], inner]), 0.0, None)
    return old, weights / weights.sum(axis=1, keepdims=True)


def in_rows(task: Task, made: Made, spacing: float, counted: IntArray | None) -> tuple[Made, IntArray] | None:
    """And the pairs (q, 2) of its triangles that are quads; None where no rows fit."""
    patch = made.patch
    inside = made.cut["inside"]
    rows = _core.fillet_rows(
        task.points, task.triangles, (task.seams, task.walls), task.widths, (task.spacing, spacing), counted,
        (patch.vertices, patch.triangles, patch.fixed, patch.normals, made.before(task), inside), None,
    )  # fmt: skip
    if rows is None:
        return None
    vertices = np.concatenate([patch.vertices, rows["places"]])
    triangles = np.concatenate([halves_of(vertices, rows["quads"]), rows["triangles"]])
    known, stays = made.values["mean_curvature"], np.isin(made.values["fixed"], triangles)
    corners = patch.triangles[rows["solved"]] - len(task.points)
    inner = (np.where(corners < 0, 0.0, known[np.maximum(corners, 0)]) * rows["on_solved"]).sum(axis=1)
    values = {
        **made.values, "cut": True, "polished": False, "mean_curvature": np.concatenate([known, inner]),
        **{name: read_only(made.values[name][stays]) for name in ("fixed", "boundary_angle", "join")},
        "warnings": tuple(_moved(warning, patch, vertices, triangles) for warning in made.values["warnings"]),
    }  # fmt: skip
    rowed = Made(
        rows["cut"], Patch(vertices, triangles, values["fixed"], None),
        np.concatenate([made.old, rows["given"]]).astype(np.int32), np.concatenate([made.weights, rows["on_given"]]),
        np.concatenate([made.on_seam, len(patch.vertices) + np.flatnonzero(rows["on_seam"])]), values,
    )  # fmt: skip
    count = len(rows["quads"])
    return rowed, np.arange(2 * count, dtype=np.int32).reshape(2, count).T.copy()


def _moved(warning: Diagnostic, solved: Patch, vertices: FloatArray, triangles: IntArray) -> Diagnostic:
    """For what it names on the solved mesh the nearest vertices of the one with rows."""
    names = warning.elements if warning.kind == "vertex" else solved.triangles[warning.elements].ravel()
    used = np.unique(triangles)
    near = used[np.unique(nearest(solved.vertices[names], vertices[used]))]
    return replace(warning, elements=read_only(near.astype(np.int32)), kind="vertex")
