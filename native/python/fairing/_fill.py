"""Surfaces over holes and between boundary loops."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import (
    _arguments,
    _run_on,
)
from fairing._adopted import taken
from fairing._chosen import Wanted, blamed, chosen_loops, fillable
from fairing._fill_task import Task
from fairing._groups import Options
from fairing._new_mesh import FillResult, read_only
from fairing._patch import refuse_made_here, spacing_of
from fairing._rows import FACES, quads_of
from fairing._types import MeshError
from fairing._watch import Progress


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
    **before: Any,
) -> FillResult:
    """Fill holes, or join boundary loops, with the fairest surface that continues the surroundings.

    The surface does not depend on ``spacing``: it is solved on a mesh that is fine enough, and a coarser mesh is cut
    from it. A loop of three or four edges that are no longer than the new ones is closed by one face. Vertices and
    edges given stay as they are. Each loop is filled by itself: one that can't be is left open, and
    ``result.left_because`` says why. No argument is ever changed.

    Parameters
    ----------
    vertices : (n, 3) float
    triangles : (m, 3) int
        The mesh around, consistently wound; there may be none if ``loops`` and ``normals`` are given.
    loops : list of (k,) int
        Closed loops of border vertices, in either direction: each is filled. Default: all holes, that is all of
        :func:`fairing.hole_loops` but those around the outside of a sheet (:func:`fairing.outer_borders`), which
        ``left_open`` and the warning NOT_A_HOLE name. Loops along triangles may touch themselves and each other. A loop
        that no triangle touches has the new surface on its left, seen from the side of the normals; it is turned where
        that leads away from the other loops of a bridge, or outside of a lone loop.
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
        together are joined by a curve of least variation, three and more meet in a point. Each curve is a crease of a
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
    before
        Fields of ``options`` as keyword arguments: deprecated.

    Raises
    ------
    MeshError
        The first reason where no loop can be filled, or one of those that are to be joined is bad: NOT_A_LOOP,
        NO_BOUNDARY, NONMANIFOLD_VERTEX (loops that cross, or vertices of one boundary in one place or on its edges),
        NONMANIFOLD_EDGE (also where the surface would double back onto a triangle that sticks out into a loop, or where
        ``wires`` cross), NOT_A_HOLE (there are none but outer borders; or one that was named lies around a flat sheet,
        which no surface closes), OUT_OF_PROPORTION (``max_vertices``), LOOPS_NOT_JOINED (one is turned; loops that no
        surface joins), ZERO_NORMAL, NORMALS_OPPOSE_WINDING, NONFINITE or INDEX_RANGE; ``elements`` are the vertices.
    ValueError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fair`.
    """
    given = taken("fill", options, before, threads)
    points = _arguments.floats("vertices", vertices)
    around = _arguments.triangles_within(triangles, len(points))
    limit = _arguments.whole("longest", longest, 0)
    length = spacing_of(spacing, inner)
    refuse_made_here(given, progress)
    if not isinstance(bridge, (bool, np.bool_)):
        raise ValueError(f"bridge: True or False is needed, not {bridge!r}")
    if _arguments.finite("longest_length", longest_length) < 0:
        raise ValueError(f"longest_length: a length, or 0 for any, is needed, not {longest_length!r}")
    if fixed_curvatures is not None and given.get("continuity", "G1") != "G2":
        raise ValueError("fixed_curvatures: accepted with continuity 'G2' only")
    finite = np.isfinite(points).all(axis=1)
    known = around if finite.all() else around[finite[around].all(axis=1)]
    broken = _run_on.Edges.of((points, known), (edges, wires, marked), bool(bridge))
    wanted = Wanted(loops, normals, fixed_curvatures, bool(bridge), limit, float(longest_length), broken.hard)
    chosen = chosen_loops(points, around, wanted)
    in_rows = _arguments.choice("faces", faces, FACES) == "quads"
    task = Task(points, known, bool(bridge), length, max_vertices, broken, given, _rising(progress), in_rows)
    while True:
        try:
            values = task.filled(chosen)
            break
        except MeshError as error:
            if bridge or len(chosen.outline.loops) == 1:
                raise
            less = blamed(chosen, error) or fillable(chosen, task.filled)
            if less is chosen:
                raise
            chosen = less
    values["warnings"] += chosen.warnings
    pairs = values.pop("pairs", None)
    return FillResult(
        **values,
        quads=None if pairs is None else quads_of(values["triangles"], pairs),
        loops=tuple(read_only(loop) for loop in chosen.outline.loops),
        left_open=tuple(read_only(each.loop) for each in chosen.left),
        left_because=tuple(each.reason for each in chosen.left),
    )


def _rising(progress: Progress | None) -> Progress | None:
    """The callback, which never hears less than before: some loops are filled after others, or once more."""
    if progress is None:
        return None
    most = 0.0

    def reported(fraction: float, stage: str) -> bool | None:
        nonlocal most
        most = max(most, fraction)
        return progress(most, stage)

    return reported
