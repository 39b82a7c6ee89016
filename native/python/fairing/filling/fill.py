"""Surfaces over holes and between boundary loops."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.borders import given_loops
from fairing.filling import run_on
from fairing.filling.run_on import Curves
from fairing.meshing.remesh import FACES, options_of, own_mesh_options, quads_of, spacing_of
from fairing.options import arguments
from fairing.options.groups import Options
from fairing.results import Diagnostic, FillResult, FloatArray, Hole, IntArray, MeshError, Progress, read_only

_ORDER = (  # the last one is named
    "equation", "low_passed", "least_variation", "least_bent", "swept_tube", "old_shape", "loft", "first_surface",
)  # fmt: skip
_WORST = ("converged", "iteration_limit", "stalled", "folded")
Fields = dict[str, Any]
Loops = tuple[IntArray, ...]


def joined(
    count: int,
    filled: Sequence[tuple[list[IntArray], Fields | Diagnostic]],
    holes: _core.Holes,
    curves: Sequence[Curves | Diagnostic | None],
) -> FillResult:
    """What the engine gives back for each hole, and the loops that were left before, in one; MeshError: all were.

    count: of the caller's vertices; curves: what runs through each hole, or why nothing can.
    """
    of_holes = [(tuple(own), _outcome(report, curves[k] if curves else None)) for k, (own, report) in enumerate(filled)]
    every: list[tuple[Loops, Fields | Diagnostic]] = [*of_holes, *(((loop,), why) for loop, why, _ in holes.left)]
    done = [(own, each) for own, each in every if not isinstance(each, Diagnostic)]
    left = [(loop, why) for own, why in every if isinstance(why, Diagnostic) for loop in own]
    if not done:
        raise MeshError(left[0][1])
    unfilled = [why for _, why, is_outer in holes.left if not is_outer]
    unfilled += [each for _, each in of_holes if isinstance(each, Diagnostic)]
    values = _one(count, [each for _, each in done])
    values["warnings"] += (*(() if holes.outer is None else (holes.outer,)), *unfilled)
    return _result(
        values,
        loops=tuple(loop for own, _ in done for loop in own),
        left_open=tuple(loop for loop, _ in left),
        left_because=tuple(why for _, why in left),
        holes=tuple(
            Hole(own, None, each)
            if isinstance(each, Diagnostic)
            else Hole(own, _result(each, loops=own, left_open=()), None)
            for own, each in every
        ),
    )


def _result(values: Fields, **others: Any) -> FillResult:
    own = {name: value for name, value in values.items() if name not in ("pairs", "base")}
    pairs = values.get("pairs")
    return FillResult(**own, **others, quads=None if pairs is None else quads_of(values["triangles"], pairs))


def _outcome(report: Fields | Diagnostic, curves: Curves | Diagnostic | None) -> Fields | Diagnostic:
    """The fields of one surface, or why there is none."""
    if isinstance(report, Diagnostic) or isinstance(curves, Diagnostic):
        return curves if isinstance(curves, Diagnostic) else report
    values = _once(dict(report))
    is_along = values.pop("along_curves")
    if curves is not None:
        values["warnings"] += tuple(curves.warnings) if is_along or curves.cut is None else curves.left_alone()
    if curves is not None and is_along:
        made = curves.making
        bands = tuple(tuple(map(read_only, band)) for band in made.bands)
        values |= {"curves": tuple(map(read_only, made.curves)), "marked": tuple(made.marked), "bands": bands}
    return values


def _one(count: int, parts: Sequence[Fields]) -> Fields:
    """The fields of a result with those of all parts."""
    if len(parts) == 1:
        return dict(parts[0])
    firsts = np.cumsum([0, *(len(part["vertices"]) for part in parts)]).tolist()
    numbered = list(zip(parts, firsts, strict=False))
    result = dict(max(parts, key=lambda part: _rank(part["provenance"])))
    for name in ("vertices", "mean_curvature", "boundary_angle", "join"):
        result[name] = np.concatenate([part[name] for part in parts])
    for name in ("fixed", "triangles"):
        result[name] = np.concatenate([_moved(part[name], count, first) for part, first in numbered])
    if all("pairs" in part for part in parts):
        rows = np.cumsum([0, *(len(part["triangles"]) for part in parts)]).tolist()
        result["pairs"] = np.concatenate([part["pairs"] + row for part, row in zip(parts, rows, strict=False)])
    result["marked"] = tuple(each for part in parts for each in part.get("marked", ()))
    result["curves"] = tuple(_moved(each, count, first) for part, first in numbered for each in part.get("curves", ()))
    result["bands"] = tuple(
        tuple(_moved(row, count, first) for row in band) for part, first in numbered for band in part.get("bands", ())
    )
    for name, of_all in (("converged", all), ("polished", all), ("cut", any)):
        result[name] = of_all(part[name] for part in parts)
    for name in ("iterations", "residual", "initial_residual"):
        result[name] = max(part[name] for part in parts)
    result["termination"] = max((part["termination"] for part in parts), key=_WORST.index)
    result["way"] = tuple(each for part in parts for each in part["way"])
    stages = dict.fromkeys(name for part in parts for name in part["seconds"])
    result["seconds"] = {name: sum(part["seconds"].get(name, 0.0) for part in parts) for name in stages}
    result["warnings"] = tuple(_renamed(each, count, first) for part, first in numbered for each in part["warnings"])
    return _once(result)


def _rank(provenance: str) -> int:
    return _ORDER.index(provenance) if provenance in _ORDER else len(_ORDER)


def _moved(numbers: IntArray, count: int, first: int) -> IntArray:
    return read_only(np.where(numbers < count, numbers, numbers + first).astype(np.int32))


def _renamed(warning: Diagnostic, count: int, first: int) -> Diagnostic:
    """New vertices have other numbers; of triangles those of the mesh that was solved are named in any case."""
    if warning.kind != "vertex" or not first:
        return warning
    return Diagnostic(warning.code, warning.message, _moved(warning.elements, count, first), "vertex", warning.figures)


def _once(values: Fields) -> Fields:
    """Each fixed vertex once, ascending, with its largest angles: loops may share some, and pass one several times."""
    fixed, place = np.unique(values["fixed"], return_inverse=True)
    result = {**values, "fixed": fixed}
    for name in ("boundary_angle", "join"):
        result[name] = np.zeros(len(fixed))
        np.maximum.at(result[name], place, values[name])
    return {name: read_only(value) if isinstance(value, np.ndarray) else value for name, value in result.items()}


def fill(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    loops: Any = None,
    options: Options | None = None,
    *,
    normals: Any = None,
    bridge: bool = False,
    spacing: float = 0.0,
    longest: int = 0,
    longest_length: float = 0.0,
    inner: str | None = None,
    faces: str = "triangles",
    max_vertices: int = 0,
    fixed_curvatures: Any = None,
    edges: str = "run_on",
    wires: npt.ArrayLike | None = None,
    marked: npt.ArrayLike | None = None,
    progress: Progress | None = None,
    threads: int = 0,
    **named: Any,
) -> FillResult:
    """Fill holes, or join boundary loops, with the fairest surface that continues the surroundings.

    The surface does not depend on ``spacing``: it is solved on a mesh that is fine enough, and a coarser mesh is cut
    from it. A loop of three or four edges that are no longer than the new ones is closed by one face. Vertices and
    edges given stay as they are. Each loop is filled by itself, all at once, as if it were the only one:
    ``result.holes`` has each with its own report. One that can't be filled is left open, and says why. No argument is
    ever changed.

    Parameters
    ----------
    vertices : (n, 3) float
    triangles : (m, 3) int
        The mesh around, consistently wound; there may be none if ``loops`` and ``normals`` are given.
    loops : list of (k,) int
        Closed loops of border vertices, in either direction: each is filled. Default: all holes, that is all of
        :func:`fairing.borders.hole_loops` but those around the outside of a sheet
        (:func:`fairing.borders.outer_borders`), which ``left_open`` and the warning NOT_A_HOLE name. Loops along
        triangles may touch themselves and each other. A loop that no triangle touches has the new surface on its left,
        seen from the side of the normals; it is turned where that leads away from the other loops of a bridge, or
        outside of a lone loop.
    normals : (n, 3), (Σ k, 3) float, or a list with a (k, 3) for each loop
        Normals at the boundary, of any length but zero; of the vertices, where n is Σ k and they are no list.
        Default: :func:`fairing.surrounding_normals`.
    options : Options
        Those of :func:`fairing.fair` that don't concern the mesh given or its boundary.
    bridge : bool
        False: each loop gets a surface of its own. True: one surface joins all loops, a tube between two, a blend
        between more.
    spacing : float
        Length of the new edges away from the boundary, in the unit of ``vertices``. 0: that of the boundary's edges,
        which stay. From there lengths grow or shrink by half of the distance.
    inner : "outline" | "even"
        "outline": new edges are in proportion to those of the boundary around them, and ``spacing`` long in the mean.
        "even": all are ``spacing`` long; as the boundary's mean edge for 0. Default: "outline" for a spacing of 0, else
        "even".
    faces : "triangles" | "quads"
        "quads": ``result.quads`` has them. Over a hole or a tube they are rows that meet the boundary at right
        angles and run from side to side, and one triangle where the boundary has an odd number of edges. Their edges
        are as long as the boundary's, whatever ``spacing`` says. Pairs of triangles stand in where there are no rows:
        NO_QUAD_ROWS tells (docs/quads.md).
    longest : int
        Without ``loops``: border loops with more edges than that are left open; 0: none.
    longest_length : float
        Likewise by their lengths, in the unit of ``vertices``.
    max_vertices : int
        More new vertices than that are refused, as soon as a first small surface shows that there would be so many. 0:
        20 times as many as flat surfaces over the loops would have, or 50 000 where that is less, 4 000 000 at most.
    fixed_curvatures : (n,), (Σ k,) float, or a list with a (k,) for each loop
        Mean curvatures H at the boundary, NaN where not known, for ``continuity="G2"``: the surface continues the
        curvature around it, too. Default: fitted to the triangles around.
    edges : "run_on" | "ignored"
        "run_on": hard edges (:func:`fairing.hard_edges`) that end at a hole run on through it. Ends that belong
        together are joined by a fair curve, three and more meet in a point. Each curve is a crease of a
        surface of least variation (docs/hard_surfaces.md); ``curves`` names it, EDGES_LEFT_ALONE ends that are not
        joined. So do narrow bands of high curvature, bevels and rolled edges (``bands``). Not with ``bridge``.
    wires : (w, 2) int
        Edges without a triangle that were drawn across holes: they are such curves as they are.
    marked : (e, 2) int
        Edges that are hard whatever they bend.
    progress : callable(fraction, stage) -> None | bool
        As for :func:`fairing.fair`.
    threads : int
        As for :func:`fairing.fair`.
    named
        Fields of ``options`` by their names, as for :func:`fairing.fair`.

    Raises
    ------
    MeshError
        The first reason where no loop can be filled, or one of those that are to be joined is bad: NOT_A_LOOP,
        NO_BOUNDARY, NONMANIFOLD_VERTEX (loops that cross, or vertices of one boundary in one place or on its edges),
        NONMANIFOLD_EDGE (also where ``wires`` cross), NOT_A_HOLE (there are none but outer borders; or one that was
        named lies around a flat sheet, which no surface closes), OUT_OF_PROPORTION (``max_vertices``), LOOPS_NOT_JOINED
        (one is turned; loops that no surface joins), ZERO_NORMAL, NORMALS_OPPOSE_WINDING, NONFINITE or INDEX_RANGE;
        ``elements`` are the vertices.
    ValueError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fair`.
    """
    chosen = options_of(options, named, progress)
    points, around = arguments.mesh(vertices, triangles)
    length = spacing_of(spacing, inner)
    if not isinstance(bridge, (bool, np.bool_)):
        raise ValueError(f"bridge: True or False is needed, not {bridge!r}")
    joins = chosen.surface.continuity == "G2"
    if fixed_curvatures is not None and not joins:
        raise ValueError("fixed_curvatures: accepted with continuity 'G2' only")
    engine = own_mesh_options(chosen, threads)
    in_rows = arguments.choice("faces", faces, FACES) == "quads"
    most = arguments.whole("max_vertices", max_vertices, 0)
    runs = arguments.choice("edges", edges, run_on.EDGES) == "run_on" and not bridge
    lines = run_on.Edges.of(len(points), wires, marked, (length.length, length.even))
    own = given_loops(loops, len(points)) if loops is not None else []
    limits = arguments.whole("longest", longest, 0), arguments.length("longest_length", longest_length, "any")
    slopes, slopes_at = _rows("normals", normals, (3,), own, len(points))
    bends, bends_at = _rows("fixed_curvatures", fixed_curvatures, (), own, len(points))
    named_loops = own, slopes, bends, slopes_at, bends_at, *limits
    team = arguments.whole("threads", threads, 0)
    holes = _core.Holes(points, around, lines.marked if runs else arguments.NO_EDGES, named_loops, bool(bridge), team)
    curves = lines.through(holes, points) if runs else []
    through = [each.for_engine if isinstance(each, run_on.Curves) else None for each in curves]
    wishes = bool(bridge), in_rows, joins, length.length, length.even, most
    filled = holes.fill(through, wishes, engine, progress)
    return joined(len(points), filled, holes, curves)


def _rows(
    name: str, values: Any, width: tuple[int, ...], loops: list[IntArray], count: int
) -> tuple[list[FloatArray], FloatArray]:
    """The rows of each loop, or those of all vertices; what is not given is empty."""
    if values is None:
        return [], np.empty((0, *width))
    sizes = [len(loop) for loop in loops]
    by_loop = isinstance(values, (list, tuple)) and len(values) > 0 and np.ndim(values[0]) == 1 + len(width)
    given = np.concatenate([np.asarray(each) for each in values]) if by_loop else values
    rows = arguments.floats(name, given) if width else arguments.numbers(name, given, (-1,), may_miss=True)
    if len(rows) == count and not by_loop:
        return [], rows
    if len(rows) != sum(sizes) or not sizes:
        needed = f"{count} rows, one for each vertex of the mesh"
        if sizes:
            needed = f"{sum(sizes)} rows, one for each vertex of the loops, or {needed}"
        raise ValueError(f"{name}: {needed}, are needed, not {len(rows)}")
    return np.split(rows, np.cumsum(sizes)[:-1]), rows[:0]
