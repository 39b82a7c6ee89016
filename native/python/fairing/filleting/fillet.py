"""Seams that are rounded."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.filleting.rounded import Made, Task, in_rows, result_of, solved
from fairing.measure import edges_with_uses, hard_edges, nearest
from fairing.meshing.remesh import FACES, Watch, options_of, quads_of
from fairing.options import arguments
from fairing.options.groups import Options
from fairing.results import Diagnostic, FilletResult, FloatArray, IntArray, MeshError, Progress


def seamed(vertices: Any, triangles: Any, seam: Any, walls: Any) -> tuple[FloatArray, IntArray, IntArray, IntArray]:
    """The mesh, and its seams and walls (e, 2), checked."""
    points, faces = arguments.finite_mesh(vertices, triangles)
    hard = hard_edges(points, faces) if seam is None or walls is None else arguments.NO_EDGES
    seams = hard if seam is None else arguments.edges_of("seam", seam, faces)
    if not len(seams):
        what = "the mesh has no hard edges" if seam is None else "it has no edges"
        text = f"seam: {what}: select the edges that are to be rounded"
        raise MeshError(Diagnostic("NO_SEAM", text, np.empty(0, np.int32), "vertex", {}))
    _check_sides(seams, faces)
    ends = hard if walls is None else arguments.edges_of("walls", walls, faces)
    return points, faces, seams, ends[arguments.places_of(ends, seams) < 0]


def refuse_vertices_on_edges(points: FloatArray, faces: IntArray, parent: IntArray) -> None:
    """MeshError where border vertices of triangles that a cut changes lie on the border's edges."""
    edges, uses = edges_with_uses(faces)
    border = edges[uses == 1].astype(np.int32)
    on_edges = _core.touching_edges(border, points)[0] if len(border) else border
    changed = faces[np.bincount(parent, minlength=len(faces)) > 1]
    found = on_edges[np.isin(on_edges, changed).any(axis=1)]
    if len(found):
        a, b, vertex = found[0].tolist()
        text = f"vertex {vertex} lies on the border edge {a}-{b}: dissolve it, or split that edge there and merge"
        figures = {"on_edge" if len(found) == 1 else "on_edges": float(len(found))}
        raise MeshError(Diagnostic("NONMANIFOLD_VERTEX", text, found.ravel().astype(np.int32), "vertex", figures))


def _check_sides(seams: IntArray, faces: IntArray) -> None:
    """MeshError where a seam has not one triangle on either side."""
    tails, heads = np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)]).T
    at = arguments.places_of(np.column_stack([tails, heads]), seams)
    named = arguments.places_of(seams, seams)
    both, upward = (
        np.bincount(at[those], minlength=len(seams))[named] for those in (at >= 0, (at >= 0) & (tails < heads))
    )
    cases = (
        (both > 2, "NONMANIFOLD_EDGE", "have three triangles and more: take the seam apart, or leave these edges out"),
        (both < 2, "SEAM_ON_BORDER", "lie on an open border, with nothing to round on the other side: leave them out"),
        (
            upward != 1,
            "INCONSISTENT_WINDING",
            "lie between triangles wound against each other: recalculate the normals",
        ),
    )
    for bad, code, what in cases:
        if bad.any():
            where = np.unique(seams[bad]).astype(np.int32)
            text = f"seam: {int(bad.sum())} of its edges {what}"
            raise MeshError(Diagnostic(code, text, where, "vertex", {"edges": float(bad.sum())}))


def _width(name: str, value: Any, seams: IntArray, count: int) -> FloatArray:
    """(n,) positive at the seams."""
    if np.ndim(value) == 0:
        return np.full(count, arguments.positive(name, value))
    array = np.asarray(value, dtype=np.float64)
    if array.shape != (count,):
        raise ValueError(
            f"{name}: a length, or one for each of the {count} vertices, is needed, not shape {array.shape}"
        )
    at = array[seams]
    if not (np.isfinite(at) & (at > 0)).all():
        raise ValueError(f"{name}: a positive length is needed at each vertex of the seams")
    return np.where(np.isfinite(array), array, 0.0)


_ROWS = 4  # edges across each side of a fillet by default: 90° then bend by less than 12° from row to row


def fillet(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    seam: npt.ArrayLike | None = None,
    options: Options | None = None,
    *,
    width: npt.ArrayLike | None = None,
    width_2: npt.ArrayLike | None = None,
    clamp: bool = False,
    walls: npt.ArrayLike | None = None,
    profile: float = 0.0,
    spacing: float = 0.0,
    faces: str = "triangles",
    neighbours: npt.ArrayLike | None = None,
    max_vertices: int = 0,
    progress: Progress | None = None,
    threads: int = 0,
    **named: Any,
) -> FilletResult:
    """Round seams: replace what lies within ``width`` of them, along the surface, by the fairest surface.

    The mesh is cut along the line at that distance, which is exact: straight beside straight seams, also where
    triangles are large. Outside nothing changes but the triangles that the line passes; their pieces stay in their
    planes. Within comes a new mesh. Its slopes at the line are those of each side, fitted without crossing a seam.
    Between two planes the surface is the circular arc that touches both at the line. A seam that ends on an edge of a
    plane face goes on through that face, which it cuts; other ends fade into what is there. No argument is ever
    changed.

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
        and lengths in between are interpolated along each edge. Default: :func:`fairing.fillet_width`.
    width_2 : float or (n,) float
        The same on the other side, where that differs: ``width`` is that of the larger part, by the area that hangs
        together without seams and walls, ``width_2`` that of the smaller one. Where both are one, or of one size,
        ``width`` lies on the left of the first edge given, and of those that follow each other from there.
    clamp : bool
        Make fillets no wider than there is room: nine tenths of the distance to a wall or the middle between seams,
        and less where nothing would be left of a face; widths taper. WIDTH_TOO_LARGE is then a warning that names the
        vertices, with the least width; without it such widths are refused.
    walls : (w, 2) int
        Edges that a fillet does not reach over: it ends there, tangent to its own side. Default: the other hard edges.
        Open borders always are walls.
    profile : float
        −1 … 1, flat to sharp. 0: the fair surface. Towards 1 it is drawn to the old one, towards −1 to the soap film
        over the line, so that ∫ |Δ(x − fair)|² + |x − that|² / ℓ⁴ is least, with ℓ = width · (1 / |profile| − 1) / 4:
        over that length the seam, or the chamfer's edges, stay rounded. It is tangent for all but ±1, which are these
        two themselves.
    spacing : float
        Length of the new edges where the fillet is widest, elsewhere in proportion to its width; of quads, across the
        seam. 0: a quarter of the width.
    faces : {"triangles", "quads"}
        "quads": rows along the seams. A column crosses them at each of their vertices and at each edge outside that
        comes to the line, which so goes on to the other side, and where the surface asks for one. ``result.quads``
        says which triangles are halves of one; where no rows fit, triangles stay. NO_QUAD_ROWS tells that none do.
    neighbours : (e, 2) int
        For quads, those edges of the mesh that count, of quads and polygons. Default: all edges of the triangles.
    max_vertices : int
        More new vertices than that are refused, as by :func:`fairing.remesh`.
    progress : callable(fraction, stage) -> None | bool
        As for :func:`fairing.fair`.
    threads : int
        As for :func:`fairing.fair`.
    named
        Fields of ``options`` by their names, as for :func:`fairing.fair`.

    Raises
    ------
    MeshError
        NO_SEAM; SEAM_ON_BORDER; NONMANIFOLD_EDGE (a seam of three triangles and more); INCONSISTENT_WINDING beside a
        seam; NONMANIFOLD_VERTEX (one lies on another one's edge within the fillet); WIDTH_TOO_LARGE (nothing would be
        left of a part between seams, whose vertices are the ``elements``, or the surface would leave the solid beside
        a convex seam, or enter it beside a concave one; ``figures["widest"]``, where that is known, is what fits);
        OUT_OF_PROPORTION; and those of :func:`fairing.fair`.
    ValueError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fair`.
    """
    given = options_of(options, named, progress).chosen | ({"threads": threads} if threads else {})
    wants_rows = arguments.choice("faces", faces, FACES) == "quads"
    points, corners, seams, ends = seamed(vertices, triangles, seam, walls)
    counted = None if neighbours is None else arguments.vertices_of("neighbours", neighbours, len(points), 2)
    usual, room = _core.seam_room(points, corners, (seams, ends))
    one = _width("width", usual if width is None else width, seams, len(points))
    both = one, one if width_2 is None else _width("width_2", width_2, seams, len(points))
    shape = arguments.finite("profile", profile)
    if abs(shape) > 1:
        raise ValueError(f"profile: a number from -1 to 1 is needed, not {profile!r}")
    task = Task(points, corners, seams, ends, both, 1.0, shape, given, Watch(progress), wants_rows)
    length = arguments.length("spacing", spacing, "a quarter of the width") or task.largest / _ROWS
    _refuse_large(task, length, max_vertices)
    task = replace(task, spacing=min(length, task.largest / _ROWS) if wants_rows else length)
    widest = room.copy() if clamp else np.full(len(points), np.inf)
    for _ in range(_ROUNDS):
        task = _tapered(task, widest)
        cut = task.cut()
        bad: list[tuple[IntArray, Any]] = [part[:2] for part in cut["eaten"] if not part[2]]
        what = "fillets would meet between seams"
        if not bad:
            refuse_vertices_on_edges(points, corners, cut["parent"])
            task.watch.lap("cut")
            try:
                made = solved(task, cut)
            except MeshError as error:
                raise _named(error, len(points)) from error
            near = _outside(task, made)
            bad = [(near, np.minimum(np.maximum(*task.widths), room)[near])] if len(near) else []
            what = "the fillet would stick out of the shape"
        if not bad or not clamp:
            break
        for vertices, most in bad:
            widest[vertices] = np.minimum(widest[vertices], _NARROWER * most)
    if bad:
        where = np.unique(np.concatenate([vertices for vertices, _ in bad]))
        raise _too_wide(what, where, task.largest, min(float(np.min(most)) for _, most in bad))
    warnings, pairs = _clamped(both, task.widths, seams), None
    if wants_rows:
        made, pairs = in_rows(task, made, length, counted) or (made, np.empty((0, 2), np.int32))
        if not len(pairs):
            at, text = np.unique(seams).astype(np.int32), "no rows of quads fit along the seams: triangles stay"
            figures = {"edges": float(len(seams)), "seams": 1.0}
            warnings += (Diagnostic("NO_QUAD_ROWS", text, at, "vertex", figures),)
    result = result_of(task, made)
    result = replace(result, warnings=(*warnings, *result.warnings))
    return result if pairs is None else replace(result, quads=quads_of(result.triangles, pairs + result.outside))


def fillet_width(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    seam: npt.ArrayLike | None = None,
    *,
    walls: npt.ArrayLike | None = None,
) -> float:
    """The width of a fillet by default: a fifth of the shortest side beside the seams.

    A side goes square to a seam, straight on over the surface to the next seam, wall or border. A tenth of the
    seams, by their length, may have shorter ones. Arguments as for :func:`fairing.fillet`.
    """
    points, corners, seams, ends = seamed(vertices, triangles, seam, walls)
    return float(_core.seam_room(points, corners, (seams, ends))[0])


_ROUNDS = 6  # of narrower widths, each of which may leave another part with nothing
_NARROWER = 0.9  # of the width that takes a part whole, or where a surface leaves the shape
_TAPER = 0.25  # of the length along a seam: so much widths change


def _tapered(task: Task, widest: FloatArray) -> Task:
    """With widths of at most `widest` (n,), which becomes less beside narrow places."""
    ends = task.seams
    steps = _TAPER * np.linalg.norm(task.points[ends[:, 0]] - task.points[ends[:, 1]], axis=1)
    before = np.zeros_like(widest)
    while (widest != before).any():
        before = widest.copy()
        np.minimum.at(widest, ends, before[ends[:, ::-1]] + steps[:, None])
    return replace(task, widths=(np.minimum(task.widths[0], widest), np.minimum(task.widths[1], widest)))


def _clamped(
    asked: tuple[FloatArray, FloatArray], taken: tuple[FloatArray, FloatArray], seams: IntArray
) -> tuple[Diagnostic, ...]:
    """What is said where there is less room."""
    wanted, most = (np.maximum(*sides) for sides in (asked, taken))
    where = np.unique(seams[wanted[seams] > most[seams]]).astype(np.int32)
    if not len(where):
        return ()
    figures = {
        "width": float(wanted[where].max()), "widest": float(most[where].min()),
        "vertices": float(len(where)), "clamped": 1.0,
    }  # fmt: skip
    text = f"width: too little room at {len(where)} vertices; it shrinks to {figures['widest']:.4g} there"
    return (Diagnostic("WIDTH_TOO_LARGE", text, where, "vertex", figures),)


def _named(error: MeshError, count: int) -> MeshError:
    """With those of its vertices that are the caller's: others, and triangles, are of the mesh that was cut."""
    said = error.diagnostic
    own = said.elements[said.elements < count] if said.kind == "vertex" else said.elements[:0]
    return MeshError(replace(said, elements=own, kind="vertex"))


def _refuse_large(task: Task, spacing: float, most: Any) -> None:
    """MeshError where so many vertices are wanted that a slip in the spacing is likelier than a wish."""
    lengths = np.linalg.norm(task.points[task.seams[:, 0]] - task.points[task.seams[:, 1]], axis=1)
    across = sum(float((lengths / side[task.seams].mean(axis=1)).sum()) for side in task.widths)
    wanted, usual = across * (task.largest / spacing) ** 2, across * _ROWS**2
    _core.refuse_large(wanted, usual, arguments.whole("max_vertices", most, 0), task.seams.ravel())


def _outside(task: Task, made: Made) -> IntArray:
    """Vertices of seams beside which rounded convex edges leave the solid, or concave ones enter it."""
    count = len(task.points)
    used = np.unique(made.patch.triangles[made.patch.triangles >= count])
    before, after = made.before(task)[used], made.patch.vertices[used]
    edges = np.concatenate([task.seams, task.walls])
    wrong = _core.on_wrong_side(task.points, task.triangles, edges, task.largest, before, after, None)
    ends = np.unique(task.seams)
    return ends[np.unique(nearest(before[wrong], task.points[ends]))]


def _too_wide(what: str, where: IntArray, width: float, widest: float) -> MeshError:
    """widest: that fits there, or not less than what is wanted."""
    text = f"width: {what}; lower it, or leave out one of the seams"
    figures = {"width": width, "vertices": float(len(where))}
    if widest < width:
        figures["widest"] = widest
        text += f"; a fillet of less than {widest:.4g} fits"
    return MeshError(Diagnostic("WIDTH_TOO_LARGE", text, where.astype(np.int32), "vertex", figures))
