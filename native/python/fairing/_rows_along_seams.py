"""A fillet's surface meshed anew by quads in rows along its seams."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing._dropped_points import without_points
from fairing._fillet_strips import Seams
from fairing._first_mesh import without_specks
from fairing._found_line import FoundLine, NoRowsError
from fairing._new_mesh import read_only
from fairing._patch import Patch
from fairing._rounded import Given, Made, Wishes, line_places
from fairing._row_origins import RowOrigins
from fairing._row_quads import RowMesh, row_mesh, widest
from fairing._rows import halves_of
from fairing._seam_edges import SeamEdges
from fairing._strip_surface import Solved
from fairing._types import Diagnostic, FloatArray, IntArray


def in_rows(
    given: Given, made: Made, wishes: Wishes, spacing: float, counted: IntArray | None
) -> tuple[Made, IntArray]:
    """And the pairs (q, 2) of its triangles that are quads. Raises NoRowsError."""
    edges = given.seams.tolist(), wishes.walls.tolist()
    found = _core.fillet_line(given.points, given.triangles, edges, wishes.widths, wishes.spacing, None)
    line = FoundLine.of(found)
    if not len(line.segments):
        raise NoRowsError
    within = np.unique(made.cut["triangles"][made.inside])
    near = given.triangles[np.isin(given.triangles, within).any(axis=1)]
    leading = SeamEdges(line, given.points, near, counted)
    width = min(float(side[given.seams].min()) for side in wishes.widths)
    seams = Seams(given.points, line, width, spacing, leading.linked, leading.must)
    mesh = row_mesh(seams, _components(made))
    cut = given.cut(wishes, mesh.chosen.arrays(), None)
    made = _with_rows(given, made, mesh, (cut, mesh.chosen.not_needed(leading.must)), wishes)
    count = len(mesh.quads)
    return made, np.arange(2 * count, dtype=np.int32).reshape(2, count).T.copy()


def _components(made: Made) -> list[Solved]:
    patch = made.patch
    assert patch.fixed is not None
    assert patch.normals is not None
    part = _core.components(patch.triangles, patch.fixed, len(patch.vertices))
    found = []
    for number in range(part.max(initial=-1) + 1):
        rows = np.flatnonzero(part == number)
        triangles = np.ascontiguousarray(patch.triangles[rows])
        own = np.isin(patch.fixed, triangles)
        normals = np.ascontiguousarray(patch.normals[own])
        found.append(Solved(patch.vertices, triangles, rows, patch.fixed[own], normals))
    return found


def _with_rows(
    given: Given, made: Made, mesh: RowMesh, again: tuple[dict[str, Any], list[int]], wishes: Wishes
) -> Made:
    """again: the second cut, and points of it that are dropped."""
    cut, dropped = again
    placed = np.concatenate([given.points, cut["points"]])
    inside = without_specks(cut, placed, wishes.spacing)
    vertices = np.concatenate([placed, mesh.places])
    _check(vertices, mesh.quads, cut["triangles"][inside], set(dropped))
    halves = halves_of(vertices, mesh.quads)
    on_line, line_weights = line_places(cut, len(placed) - len(given.points))
    old, weights = _below(given, made, mesh, np.concatenate([given.seams, wishes.walls]))
    line_weights = np.clip(line_weights, 0.0, None)
    origins = (
        np.concatenate([on_line, old]).astype(np.int32),
        np.concatenate([line_weights / line_weights.sum(axis=1, keepdims=True), weights]),
    )
    rim = cut["boundary"]
    rim = rim[np.isin(rim, mesh.quads)]
    cut, inside = _without(cut, inside, placed, dropped)
    values = {**made.values, **_at_boundary(made, vertices, rim)}
    curvature = np.concatenate([np.zeros(len(given.points)), made.values["mean_curvature"]])
    inner = (curvature[made.triangles[mesh.triangle]] * mesh.weights).sum(axis=1)
    values["mean_curvature"] = np.concatenate([_nearest_values(made, curvature, cut["points"]), inner])
    values["warnings"] = tuple(_moved(warning, made, vertices, mesh.quads) for warning in values["warnings"])
    values.update(cut=True, polished=False)
    patch = Patch(vertices, halves, rim, None)
    return replace(
        made, cut=cut, inside=inside, triangles=halves, vertices=vertices, line_count=len(cut["points"]), patch=patch,
        old=origins[0], weights=origins[1], on_seam=len(placed) + np.flatnonzero((weights == 0.0).any(axis=1)),
        values=values,
    )  # fmt: skip


def _without(
    cut: dict[str, Any], inside: npt.NDArray[np.bool_], placed: FloatArray, dropped: list[int]
) -> tuple[dict[str, Any], npt.NDArray[np.bool_]]:
    """The cut without some points of its line."""
    after = dict(cut["line"].tolist())
    gone, groups = set(dropped), []
    for a in [a for a in after if a not in gone]:
        group = []
        while after[a] in gone:
            group.append(after[a])
            after[a] = after.pop(group[-1])
        groups += [group] if group else []
    triangles, parents = without_points(cut["triangles"][~inside], cut["parent"][~inside], placed, groups)
    within = np.arange(len(triangles) + inside.sum()) >= len(triangles)
    changed = {
        "triangles": np.concatenate([triangles, cut["triangles"][inside]]),
        "parent": np.concatenate([parents, cut["parent"][inside]]),
        "inside": within,
        "line": np.array(list(after.items()), dtype=np.int32).reshape(-1, 2),
    }
    return {**cut, **changed}, within


def _check(vertices: FloatArray, quads: IntArray, pieces: IntArray, dropped: set[int]) -> None:
    """NoRowsError where the boundary is not that of the old pieces, or an angle is none of a convex quad."""
    own, old = _border(quads), _border(pieces)
    for a in old:
        while old[a] in dropped:
            old[a] = old[old[a]]
    if own != {a: b for a, b in old.items() if a not in dropped}:
        raise NoRowsError
    if (widest(vertices[quads]) >= 180.0).any():
        raise NoRowsError


def _border(faces: IntArray) -> dict[int, int]:
    """What comes after each vertex of the border. Raises NoRowsError where a side is there twice, or a vertex."""
    sides = {(a, b) for row in faces.tolist() for a, b in zip(row, [*row[1:], row[0]], strict=True)}
    border = [(a, b) for a, b in sides if (b, a) not in sides]
    if len(sides) != faces.size or len(dict(border)) != len(border):
        raise NoRowsError
    return dict(border)


def _below(given: Given, made: Made, mesh: RowMesh, parting: IntArray) -> tuple[IntArray, FloatArray]:
    """Old triangles (k,) under the new vertices, and weights (k, 3) there."""
    count = len(given.points)
    carried = np.einsum("kc,kcd->kd", made.weights, given.points[given.triangles[made.old]])
    before = np.concatenate([given.points, carried])
    corners = made.triangles[mesh.triangle]
    places = np.einsum("kc,kcd->kd", mesh.weights, before[corners])
    under = np.where(corners >= count, made.old[np.maximum(corners - count, 0)], -1)
    inside = np.unique(made.cut["parent"][made.inside])
    return RowOrigins(given.points, given.triangles, inside, parting).of(places, under, mesh.wanted)


def _moved(warning: Diagnostic, made: Made, vertices: FloatArray, quads: IntArray) -> Diagnostic:
    """For what it names on the solved mesh the nearest vertices of the quads."""
    names = warning.elements if warning.kind == "vertex" else made.triangles[warning.elements].ravel()
    used = np.unique(quads)
    near = used[np.unique(_nearest(vertices[used], made.vertices[names]))]
    return replace(warning, elements=read_only(near.astype(np.int32)), kind="vertex")


def _at_boundary(made: Made, vertices: FloatArray, rim: IntArray) -> dict[str, Any]:
    """The fields of a report at the vertices of another boundary: those of the nearest one of its own."""
    fixed = made.values["fixed"]
    near = _nearest(made.vertices[fixed], vertices[rim])
    found = {name: read_only(made.values[name][near]) for name in ("boundary_angle", "join")}
    return {"fixed": rim, **found}


def _nearest_values(made: Made, values: FloatArray, places: FloatArray) -> FloatArray:
    fixed = made.values["fixed"]
    found: FloatArray = values[fixed[_nearest(made.vertices[fixed], places)]]
    return found


def _nearest(of: FloatArray, places: FloatArray) -> IntArray:
    return np.array([np.linalg.norm(of - place, axis=1).argmin() for place in places], dtype=np.int64)
