"""Surfaces over wires: closed loops and networks of edges without faces."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.filling.ends import sides_of
from fairing.measure import self_intersections
from fairing.meshing.denoise import denoised, edges_around
from fairing.meshing.remesh import Patch, Spacing, Watch, spacing_of
from fairing.options import arguments, checks
from fairing.results import (
    Diagnostic,
    FloatArray,
    FromCurvesResult,
    IntArray,
    MeshError,
    Progress,
    read_only,
    report_fields,
)

_STIFF = 100.0  # mean edges: shorter waves go from soap films that are bent into one surface, whose cells have some 20


def surface_from_curves(
    vertices: npt.ArrayLike,
    edges: npt.ArrayLike,
    *,
    creases: npt.ArrayLike | None = None,
    closed: bool = False,
    spacing: float = 0.0,
    inner: str | None = None,
    max_vertices: int = 0,
    progress: Progress | None = None,
    threads: int = 0,
) -> FromCurvesResult:
    """Make a fair surface through wires: a closed loop of edges, or a network of them.

    Through a network goes the surface of least variation, with one slope on both sides of each wire and a free one at
    those that it ends at: planes, spheres and circular cylinders come back from their curves. A lone loop does not say
    which slope is meant, and bounds a soap film (H = 0). Where no surface of least variation is found, as through rough
    wires, a thin plate stands in, not ``converged``, and NO_SOLUTION says so. Vertices given stay, with their bits;
    networks apart from each other have surfaces of their own. No argument is ever changed.

    The wires' directions where they meet tell in which order they lie around that point, and so which cells they
    enclose (docs/curves.md). No surface closes an opening: a loop at which half of the wires that meet it end, or one
    that is seen from outside, such as a bottle's mouth, the rim of a boat and the boundary of a sheet.

    Parameters
    ----------
    vertices : (n, 3) float
    edges : (e, 2) int
        The wires. They hang together by common vertices, end nowhere, and bound two cells at most.
    creases : (c, 2) int
        Some of these edges: over them the surface may bend.
    closed : bool
        Whether openings get a soap film, with a crease around. The outside of a sheet stays open.
    spacing, inner, max_vertices, progress, threads
        As for :func:`fairing.fill`, the wires in place of the boundary.

    Raises
    ------
    MeshError
        WIRES_END; WIRES_CROSS (or touch without a common vertex); NO_CELL (there are no wires, or some that divide
        nothing, or bound openings alone); UNCLEAR_CELLS (wires that leave a vertex one above the other, as where three
        sheets meet, or along which a surface comes back to its other side); OUT_OF_PROPORTION; NONFINITE; INDEX_RANGE.
        ``elements`` are vertices.
    ValueError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fair`.
    """
    points = arguments.floats("vertices", vertices)
    wires = _wires("edges", edges, len(points))
    sharp = _wires("creases", arguments.NO_EDGES if creases is None else creases, len(points))
    length = spacing_of(spacing, inner)
    most, threads = arguments.whole("max_vertices", max_vertices, 0), arguments.whole("threads", threads, 0)
    watch = Watch(checks.callback(progress))
    if not isinstance(closed, (bool, np.bool_)):
        raise ValueError(f"closed: True or False is needed, not {closed!r}")
    _check(wires, points)
    if (arguments.places_of(sharp, wires) < 0).any():
        raise ValueError("creases: some are not in `edges`")
    # Loops with their surface on the left, all of a network wound alike, and the normal of each (l, 3); what is no
    # cell, and edges (r, 2) around openings that are closed.
    cells, normals, left_open, rims = _core.wire_cells(wires, points, bool(closed))
    used = np.bincount(arguments.places_of(np.concatenate([*map(sides_of, cells)]), wires), minlength=len(wires))
    bent = np.unique(np.sort(np.concatenate([sharp, rims]), axis=1), axis=0)  # the surface may bend there
    held = np.unique(wires[used > 0])
    free = np.intersect1d(np.concatenate([wires[used == 1], bent]), held).astype(np.int32)  # slopes on either side
    smooth = np.setdiff1d(held, free).astype(np.int32)  # one slope on both
    # A soap film in each cell; normals are told, as all wires are, but do not count.
    rows = [np.tile(normal, (len(loop), 1)) for loop, normal in zip(cells, normals, strict=True)]
    films = _core.fill_loops(points, cells, rows, False, "soap_film", watch.part(0.0, 0.2))
    first = Patch(
        np.concatenate([points, films["vertices"]]), films["triangles"], held, np.tile(normals[:1], (len(held), 1))
    )
    options: dict[str, Any] = {"creases": free, "threads": threads}
    options |= {"equation": "soap_film", "start": "outline"}  # each cell by itself
    if len(smooth):
        first = _bent(first, free, threads, watch.part(0.2, 0.3))
        options |= {"equation": "least_variation", "smooth_curves": smooth, "start": "given"}
    watch.lap("first")
    _core.refuse_large(first.expected_new(length), first.expected_new(Spacing(0.0, False)), most, held)
    parts = watch.part(0.3, 0.4), watch.part(0.4, 1.0)
    every = {"creases": held, "threads": threads}
    new = first.remeshed(len(points), arguments.NO_EDGES, length, every, parts[0])[0]
    watch.lap("mesh")
    report = new.faired(options, parts[1])
    values = report_fields(report, len(points))
    if not report.converged and len(smooth):
        values.update(_plate(new, len(points)))
    values["seconds"] = {**values["seconds"], **watch.seconds}
    return FromCurvesResult(
        **values,
        triangles=new.triangles,
        cells=tuple(map(read_only, cells)),
        cell=_core.cells_of_triangles(new.triangles, cells, len(new.vertices)),
        left_open=tuple(map(read_only, left_open)),
        creases=read_only(bent),
    )


def _plate(new: Patch, count: int) -> dict[str, Any]:
    """The fields that differ where the equation has no surface: the plate itself stands in."""
    curvature = _core.mean_curvature(new.vertices, new.triangles, new.fixed, None, "averaged")
    crossing = self_intersections(new.vertices, new.triangles)
    text = "no surface of least variation was found through these wires: a thin plate stands in, which bends more"
    assert new.fixed is not None
    found = [Diagnostic("NO_SOLUTION", text, new.fixed, "vertex", {"plate": 1.0})]
    if len(crossing):
        text = "the thin plate through the wires passes through itself: divide large cells by more wires"
        figures = {"triangles": float(len(crossing))}
        found.append(Diagnostic("SELF_INTERSECTION", text, crossing, "triangle", figures))
    return {
        "vertices": read_only(new.vertices[count:]), "mean_curvature": read_only(curvature[count:]),
        "equation": "bilaplacian", "provenance": "first_surface", "warnings": tuple(found),
    }  # fmt: skip


def _bent(films: Patch, creases: IntArray, threads: int, progress: Progress | None) -> Patch:
    """The films without their kinks at smooth wires: a thin plate, near the surface of least variation."""

    def sizes(placed: FloatArray, edges: IntArray, names: IntArray, _: float) -> FloatArray:
        return np.where(np.isin(names, creases), 0.0, _STIFF * edges_around(placed, edges))

    assert films.fixed is not None
    move = denoised(films.vertices, films.triangles, films.fixed, sizes, threads, progress)
    return Patch(films.vertices + move, films.triangles, films.fixed, films.normals)


def _wires(name: str, value: npt.ArrayLike, count: int) -> IntArray:
    """(e, 2) edges, each once, the lower end first."""
    given = arguments.vertices_of(name, value, count, 2)
    if (given[:, 0] == given[:, 1]).any():
        raise ValueError(f"{name}: row {int((given[:, 0] == given[:, 1]).argmax())} joins a vertex to itself")
    return np.unique(np.sort(given, axis=1), axis=0).astype(np.int32)


def _check(wires: IntArray, points: FloatArray) -> None:
    """MeshError for what no surface can begin with."""
    if not len(wires):
        raise _refused("NO_CELL", "there are no wires: edges without a face are needed", wires)
    arguments.refuse_not_finite(points, np.unique(wires))
    on_edges, pairs = _core.touching_edges(wires, points)
    short = wires[(points[wires[:, 0]] == points[wires[:, 1]]).all(axis=1)]
    where = np.unique(np.concatenate([short.ravel(), pairs.ravel(), on_edges.ravel()]))
    if not len(where):
        where = np.unique(_core.crossing_edges(wires, points))
    if len(where):
        text = f"wires cross, or lie on each other, at {arguments.listed(where)}: "
        raise _refused("WIRES_CROSS", text + "give them one common vertex, or move them apart", where)


def _refused(code: str, text: str, where: IntArray) -> MeshError:
    elements = where.astype(np.int32).ravel()
    return MeshError(Diagnostic(code, text, elements, "vertex", {"vertices": float(len(elements))}))
