"""New meshes for patches."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core
from fairing._given import flat, given
from fairing._groups import Boundary, Options
from fairing._inner_vertices import with_inner_vertices
from fairing._new_mesh import RemeshResult, read_only, report_fields
from fairing._patch import (
    LEAST_COUNT,
    Patch,
    Spacing,
    carried,
    cut_fields,
    free_slopes,
    refuse_made_here,
    spacing_of,
)
from fairing._proportion import Limit
from fairing._quads import paired_quads
from fairing._rows import FACES, no_rows, quads_of, rows_over
from fairing._types import IntArray, MeshError
from fairing._watch import Progress, Watch


def remesh(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    boundary: Boundary | npt.ArrayLike | None = None,
    options: Options | None = None,
    *,
    kept: npt.ArrayLike | None = None,
    spacing: float = 0.0,
    inner: str | None = None,
    faces: str = "triangles",
    max_vertices: int = 0,
    progress: Progress | None = None,
    threads: int = 0,
    **named: Any,
) -> RemeshResult:
    """Fair a patch on a new mesh: :func:`fairing.fair`, and then other vertices and triangles for its surface.

    Fixed vertices and the boundary's edges stay; no vertex need be free. ``origin`` says where each new vertex lies on
    the old patch, so that what belongs to its vertices or corners can be carried over: what :func:`fairing.fair` makes
    of the old mesh, with ``inner_fairness="conformal"`` by default, takes them there. ``spacing`` and ``inner`` are
    those of :func:`fairing.fill`, the other parameters those of :func:`fairing.fair`. Where the new mesh is coarser
    than the old one and has less than 1000 vertices, it is cut from the surface of the old one, and not solved again.

    ``kept``, (e, 2): edges of the old mesh that the new one has, too, between new vertices at the same places of the
    surface, which ``result.old`` names: seams of a texture.

    ``creases``, some of the fixed vertices: as in :func:`fairing.fair`, each side of a curve of them finds its slope.
    Hard edges through the patch are such curves, made fair by :func:`fairing.fair_edges`. They keep their vertices.

    ``faces``: as for :func:`fairing.fill`. Quads are in rows where one patch between one boundary loop or two has no
    pins, creases or ``kept`` edges.

    ``max_vertices``: more new vertices than that are refused (OUT_OF_PROPORTION), by the old surface before anything is
    solved, and by the faired one. 0: 20 times as many as the old surface would have with that spacing, or 50 000 where
    that is less, 4 000 000 at most.
    """
    around, chosen = given(boundary, options, named)
    if around.continuity is not None and around.curvatures is None:
        raise ValueError("continuity: 'G2' on parts of the boundary needs `curvatures` here")
    wishes = flat(chosen, threads, around)
    points = _arguments.floats("vertices", vertices)
    corners = _arguments.triangles_within(triangles, len(points))
    held, given_normals = _arguments.boundary(around.vertices, around.normals)
    lines = _arguments.edges_of("kept", kept, corners)
    length = spacing_of(spacing, inner)
    wants_quads = _arguments.choice("faces", faces, FACES) == "quads"
    outside = around.outside
    refuse_made_here(wishes, progress)
    if wishes.get("equation") == "soap_film":
        raise ValueError("equation: 'soap_film' has no normals to continue; accepted are the others")
    watch = Watch(progress)
    base = len(points)
    refined = with_inner_vertices(points, corners, held, lines)
    if refined is not None:
        points, corners = refined.vertices, refined.triangles
    old = Patch(points, corners, held, given_normals)
    most = Limit.of(_count_on(old, length), max_vertices)
    border = old.border()
    most.check(most.flat, border)
    report = old.faired("outline", outside, wishes, watch.part(0, 0.4))
    watch.lap("first")
    if given_normals is None:
        averaged = _core.vertex_normals(points, corners, "averaged")
        held, given_normals = report.fixed, averaged[report.fixed]
    solved = Patch(report.vertices, corners, held, given_normals)
    most.check(solved.expected_new(length), border)
    stays = len(lines) > 0 or len(free_slopes(wishes)[0]) > 0
    rows = rows_over(solved, base, watch.part(0.4, 0.6)) if wants_quads and not stays else None
    if rows is not None:
        new, origin, old_vertex = rows.patch, rows.origin, np.full(len(rows.origin[0]), -1, np.int32)
    else:
        new, origin, old_vertex = solved.meshed_anew(base, lines, (length, 0), wishes, watch.part(0.4, 0.6))
    watch.lap("mesh")
    values = report_fields(report, base)
    added = len(new.vertices) - base
    if added >= min(LEAST_COUNT, len(np.setdiff1d(corners, report.fixed))):
        values = report_fields(new.faired("given", outside, wishes, watch.part(0.6, 1.0)), base)
        values["triangles"] = new.triangles
    else:
        values.update(cut_fields(new, base))
        values["mean_curvature"] = carried(report.mean_curvature, corners, origin)
    values["seconds"] = {**values["seconds"], **watch.seconds}
    quads = None
    if rows is not None:
        quads = quads_of(new.triangles, rows.pairs)
    elif wants_quads:
        values["warnings"] += (no_rows(border, "curves" if stays else "shape"),)
        quads = paired_quads(new.vertices, new.triangles, _edges_again(new.triangles, base, old_vertex, lines))
    if refined is not None:
        origin = refined.given(origin)
    places = read_only(origin[0]), read_only(origin[1])
    return RemeshResult(**values, origin=places, old=read_only(old_vertex), quads=quads)


def _edges_again(triangles: IntArray, base: int, old: IntArray, kept: IntArray) -> IntArray:
    """(e, 2) edges of the new triangles that are the old mesh's ``kept`` ones."""
    name = np.concatenate([np.arange(base), old])
    held = {(a, b) for a, b in np.sort(kept, axis=1).tolist()}
    sides = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
    again = [tuple(pair) in held for pair in np.sort(name[sides], axis=1).tolist()]
    edges: IntArray = sides[np.array(again, dtype=bool)]
    return edges


def _count_on(old: Patch, spacing: Spacing) -> float:
    """About how many new vertices there would be on the old surface; 0 where `fair` will say why there is none."""
    try:
        return old.expected_new(spacing)
    except MeshError:
        return 0.0
