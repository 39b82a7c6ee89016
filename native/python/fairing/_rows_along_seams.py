"""A fillet's surface meshed anew by quads in rows along its seams."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from fairing import _core
from fairing._new_mesh import read_only
from fairing._patch import Patch
from fairing._rounded import Given, Made, Wishes, line_places, nearest
from fairing._rows import halves_of
from fairing._types import Diagnostic, FloatArray, IntArray
from fairing._watch import Progress


def in_rows(
    given: Given, made: Made, wishes: Wishes, spacing: float, counted: IntArray | None, progress: Progress | None
) -> tuple[Made, IntArray] | None:
    """And the pairs (q, 2) of its triangles that are quads; None where no rows fit."""
    carried = np.einsum("kc,kcd->kd", made.weights, given.points[given.triangles[made.old]])
    before = np.concatenate([given.points, carried])
    patch = made.patch
    assert patch.fixed is not None
    assert patch.normals is not None
    rows = _core.fillet_rows(
        given.points, given.triangles, (given.seams.tolist(), wishes.walls.tolist()), wishes.widths,
        (wishes.spacing, spacing), None if counted is None else counted.tolist(),
        (made.vertices, made.triangles, patch.fixed, patch.normals, before), progress,
    )  # fmt: skip
    if rows is None:
        return None
    count = len(rows["quads"])
    return _with_rows(given, made, rows, wishes), np.arange(2 * count, dtype=np.int32).reshape(2, count).T.copy()


def _with_rows(given: Given, made: Made, rows: dict[str, Any], wishes: Wishes) -> Made:
    cut = rows["cut"]
    placed = np.concatenate([given.points, cut["points"]])
    vertices = np.concatenate([placed, rows["places"]])
    halves = halves_of(vertices, rows["quads"])
    whole = cut["inside"]  # of pieces outside that are meshed anew a corner may lie beyond the parent
    within = {"points": cut["points"], "triangles": cut["triangles"][whole], "parent": cut["parent"][whole]}
    within["weights"] = cut["weights"].reshape(-1, 3, 3)[whole].reshape(-1, 3)
    on_line, line_weights = line_places(within, len(given.points))
    line_weights = np.clip(line_weights, 0.0, None)
    weights = np.concatenate([line_weights / line_weights.sum(axis=1, keepdims=True), rows["on_given"]])
    rim = cut["boundary"][np.isin(cut["boundary"], rows["quads"])]
    curvature = np.concatenate([np.zeros(len(given.points)), made.values["mean_curvature"]])
    inner = (curvature[made.triangles[rows["solved"]]] * rows["on_solved"]).sum(axis=1)
    fixed = made.values["fixed"]
    near = nearest(vertices[rim], made.vertices[fixed])
    values = {
        **made.values, "fixed": rim, "cut": True, "polished": False,
        **{name: read_only(made.values[name][near]) for name in ("boundary_angle", "join")},
        "mean_curvature": np.concatenate([curvature[fixed[nearest(cut["points"], made.vertices[fixed])]], inner]),
        "warnings": tuple(_moved(warning, made, vertices, rows["quads"]) for warning in made.values["warnings"]),
    }  # fmt: skip
    on_seam = len(placed) + np.flatnonzero(rows["on_seam"])
    return replace(
        made, cut={**cut, "eaten": made.cut["eaten"]}, inside=cut["inside"],
        triangles=halves, vertices=vertices, line_count=len(cut["points"]), patch=Patch(vertices, halves, rim, None),
        old=np.concatenate([on_line, rows["given"]]).astype(np.int32), weights=weights, on_seam=on_seam, values=values,
    )  # fmt: skip


def _moved(warning: Diagnostic, made: Made, vertices: FloatArray, quads: IntArray) -> Diagnostic:
    """For what it names on the solved mesh the nearest vertices of the quads."""
    names = warning.elements if warning.kind == "vertex" else made.triangles[warning.elements].ravel()
    used = np.unique(quads)
    near = used[np.unique(nearest(made.vertices[names], vertices[used]))]
    return replace(warning, elements=read_only(near.astype(np.int32)), kind="vertex")
