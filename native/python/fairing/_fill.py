"""Surfaces over holes and between boundary loops."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core, _holes, _loops, _options, _run_on, _short_edges, _sides
from fairing._along import filled_along
from fairing._fair import fair
from fairing._measure import boundary_loops
from fairing._new_mesh import FillResult, Origin, read_only, report_fields
from fairing._proportion import Limit
from fairing._tangency import not_tangent
from fairing._types import FairResult, FloatArray, IntArray, MeshError
from fairing._watch import Watch

LEAST_COUNT = 1000
"""Free vertices of the mesh that is solved, for each component. Coarser wishes are cut from its surface."""

INNER = ("outline", "even")

Progress = Callable[[float, str], "bool | None"]


def fill(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    loops: Any = None,
    *,
    normals: Any = None,
    bridge: bool = False,
    spacing: float = 0.0,
    longest: int = 0,
    inner: str | None = None,
    max_vertices: int = 0,
    fixed_curvatures: Any = None,
    edges: str = "run_on",
    wires: npt.ArrayLike | None = None,
    marked: npt.ArrayLike | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> FillResult:
    """Fill holes, or join boundary loops, with the fairest surface that continues the surroundings.

    The surface does not depend on ``spacing``: it is solved on a mesh that is fine enough, and a coarser mesh is cut
    from it. Vertices and edges given stay as they are. No argument is ever changed.

    Parameters
    ----------
    vertices : (n, 3) float
    triangles : (m, 3) int
        The mesh around, consistently wound; there may be none if ``loops`` and ``normals`` are given.
    loops : list of (k,) int
        Closed loops of border vertices, in either direction: each is filled. Default: all holes, that is all border
        loops but those around the outside of a sheet (:func:`fairing.outer_borders`), which ``left_open`` and the
        warning NOT_A_HOLE name. A loop that no triangle touches has the new surface on its left, seen from the side of
        the normals; it is turned where that leads away from the other loops of a bridge, or outside of a lone loop.
    normals : (n, 3), (Σ k, 3) float, or a list with a (k, 3) for each loop
        Normals at the boundary, of any length but zero; of the vertices, where n is Σ k and they are no list.
        Default: :func:`fairing.surrounding_normals`.
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
    longest : int
        Without ``loops``: border loops with more edges than that are left open; 0: none.
    max_vertices : int
        More new vertices than that are refused, as soon as a first small surface shows that there would be so many. 0:
        20 times as many as flat surfaces over the loops would have, or 50 000 where that is less, 4 000 000 at most.
    fixed_curvatures : (n,), (Σ k,) float, or a list with a (k,) for each loop
        Mean curvatures H at the boundary, NaN where not known, for ``continuity="G2"``: the surface continues the
        curvature around it, too. Default: fitted to the triangles around.
    edges : "run_on" | "ignored"
        "run_on": hard edges (:func:`fairing.hard_edges`) that end at a hole run on through it. Ends that belong
        together are joined by a curve of least variation, three and more meet in a point. Each curve is a crease of a
        surface of least variation (docs/curves.md); ``curves`` names it, and EDGES_LEFT_ALONE ends that are not joined.
        So do narrow bands of high curvature, bevels and rolled edges (``bands``). Not with ``bridge``.
    wires : (w, 2) int
        Edges without a triangle that were drawn across holes: they are such curves as they are.
    marked : (e, 2) int
        Edges that are hard whatever they bend.
    progress : callable(fraction, stage) -> None | bool
        As for :func:`fairing.fair`.
    options
        Those of :func:`fairing.fair` that don't concern the boundary: ``equation``, ``load``, ``bulge``,
        ``continuity``, ``tolerance``, ``max_iterations``, ``threads``, … By default ``inner_fairness`` keeps the
        triangles' shapes.

    Raises
    ------
    MeshError
        NOT_A_LOOP, NO_BOUNDARY, NONMANIFOLD_VERTEX (loops that touch or cross, or vertices of one boundary in one place
        or on its edges), NONMANIFOLD_EDGE (also where the surface would double back onto a triangle that sticks out
        into a loop, or where ``wires`` cross), NOT_A_HOLE (there are none but outer borders; or one that was named
        lies around a flat sheet, which no surface closes), OUT_OF_PROPORTION (``max_vertices``),
        LOOPS_NOT_JOINED (one is turned; loops that no surface joins), ZERO_NORMAL, NORMALS_OPPOSE_WINDING, NONFINITE or
        INDEX_RANGE; ``elements`` are the vertices.
    ValueError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fair`.
    """
    points = _arguments.floats("vertices", vertices)
    around = _arguments.triangles_within(triangles, len(points))
    limit = _arguments.whole("longest", longest, 0)
    length = spacing_of(spacing, inner)
    refuse_made_here(options, progress)
    if not isinstance(bridge, (bool, np.bool_)):
        raise ValueError(f"bridge: True or False is needed, not {bridge!r}")
    outline = _loops.border_loops(around, limit) if loops is None else _loops.given_loops(loops, points, around)
    _loops.check(outline, points, bool(bridge))
    broken = _run_on.Edges.of((points, around), (edges, wires, marked), bool(bridge))
    normals = _loops.loop_normals(normals, outline, points, around, broken.hard)
    outer: tuple[IntArray, ...] = ()
    if loops is None:
        outline, normals, outer = _loops.without_outer(outline, points, normals)
    outline, normals = _sides.settled(outline, points, normals, bool(bridge))
    if not bridge:
        _loops.refuse_endless(outline, points, normals)
    rims = [points[loop] for loop in outline.loops]
    most = Limit.of(_holes.flat_count(rims, length.length, bool(bridge)), max_vertices)
    least = most.flat if bridge else _holes.least_count(rims, outline.split(normals), length.length)
    most.check(least, outline.vertices)
    normals = _short_edges.with_shared_normals(outline, points, normals)
    if fixed_curvatures is not None:
        options["fixed_curvatures"] = _loops.loop_curvatures(fixed_curvatures, outline, len(points))
    curves = broken.run_on(outline, normals, (points, around), (length.length, length.even))
    if curves.holds_any:

        def others(these: _loops.Outline, rows: FloatArray, rest: Any, part: Progress | None) -> FillResult:
            return fill(
                points, around, list(these.loops), normals=these.split(rows), spacing=spacing, inner=inner,
                max_vertices=max_vertices, edges="ignored", progress=part, **{**options, "fixed_curvatures": rest},
            )  # fmt: skip

        task = (outline, normals, around, length.wanted(0), options)
        result = filled_along(curves, task, others, progress)
        told = result.warnings + ((_loops.not_holes(outer),) if outer else ())
        return replace(result, left_open=tuple(map(read_only, outer)), warnings=told)
    watch = Watch(progress)
    first = _first_surface(points, outline, normals, bool(bridge), options, watch.part(0, 0.2))
    watch.lap("first")
    patch = Patch(np.concatenate([points, first["vertices"]]), first["triangles"], outline.vertices, normals)
    count = patch.expected_count(length)
    most.check(count, outline.vertices, first["converged"])
    fine, _ = patch.remeshed(len(points), length, LEAST_COUNT, options, watch.part(0.2, 0.4))
    watch.lap("mesh")
    _loops.check_doubles(fine.triangles, around)
    coarser = count < 0.9 * LEAST_COUNT * (1 if bridge else len(outline.loops))
    chosen = options if first["converged"] else {**options, "otherwise": "stop"}  # it was sought in vain once
    report = fine.faired(_start(first["start"], options), around, chosen, watch.part(0.4, 0.9 if coarser else 1.0))
    values = report_fields(report, len(points))
    values["warnings"] += not_tangent(report, outline, points, around)
    if coarser:
        solved = Patch(report.vertices, fine.triangles, outline.vertices, normals)
        coarse, origin = solved.remeshed(len(points), length, 0, options, watch.part(0.9, 1.0))
        values.update(cut_fields(coarse, len(points)))
        values["mean_curvature"] = carried(report.mean_curvature, fine.triangles, origin)
    else:
        values["triangles"] = fine.triangles
    watch.lap("coarser")
    values["seconds"] = {**values["seconds"], **watch.seconds}
    values["warnings"] += curves.warnings + ((_loops.not_holes(outer),) if outer else ())
    return FillResult(
        **values,
        loops=tuple(read_only(loop) for loop in outline.loops),
        left_open=tuple(read_only(loop) for loop in outer),
    )


def _first_surface(
    points: FloatArray,
    outline: _loops.Outline,
    normals: FloatArray,
    bridge: bool,
    options: dict[str, Any],
    progress: Progress | None,
) -> Any:
    """On a coarse mesh: `vertices`, `triangles`, `converged`, and how the solve on a fine one `start`s."""
    thin = _short_edges.thinned(outline, points, normals)
    rows = thin.outline.split(thin.normals)
    try:
        found = _core.fill_loops(points, list(thin.outline.loops), rows, bridge, _first_equation(options), progress)
        return {**found, "triangles": thin.with_all(found["triangles"])}
    except MeshError as error:
        if not bridge or error.code != "NONMANIFOLD_EDGE":
            raise
        raise _sides.not_joined(outline, points, normals) from error


@dataclass(frozen=True)
class Spacing:
    """How long new edges are to be."""

    length: float
    even: bool

    def wanted(self, least: int) -> tuple[float, int, bool]:
        return self.length, least, self.even


@dataclass(frozen=True)
class Patch:
    """A mesh to be solved or meshed anew, with its boundary and the normals there."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray | None
    normals: FloatArray | None

    def expected_count(self, spacing: Spacing) -> float:
        """About how many vertices a mesh of that spacing has."""
        return _core.expected_count(self.vertices, self.triangles, self.fixed, self.normals, spacing.wanted(0))

    def expected_new(self, spacing: Spacing) -> float:
        """About how many of these are new: by Euler's formula half as many as the outline has vertices are not."""
        mine = self.triangles[_core.components(self.triangles, self.fixed, len(self.vertices)) >= 0]
        return self.expected_count(spacing) - 0.5 * sum(map(len, _core.boundary_loops(mine)))

    def border(self) -> IntArray:
        """Its border vertices."""
        border: IntArray = np.unique(np.concatenate([np.empty(0, np.int32), *boundary_loops(self.triangles)]))
        return border

    def remeshed(
        self, old_count: int, spacing: Spacing, least: int, options: dict[str, Any], progress: Progress | None
    ) -> tuple[Patch, Origin]:
        """On the first ``old_count`` of these vertices and new ones."""
        new, origin, _ = self.meshed_anew(old_count, _arguments.NO_EDGES, (spacing, least), options, progress)
        return new, origin

    def meshed_anew(
        self,
        old_count: int,
        lines: IntArray,
        wanted: tuple[Spacing, int],
        options: dict[str, Any],
        progress: Progress | None,
    ) -> tuple[Patch, Origin, IntArray]:
        """The same with edges that stay, and with the old vertex that each new one is, or −1."""
        mesh = _core.remesh(
            self.vertices, self.triangles, self.fixed, self.normals, lines, wanted[0].wanted(wanted[1]),
            _arguments.whole("threads", options.get("threads", 0), 0), progress,
        )  # fmt: skip
        triangles = mesh["triangles"].copy()
        triangles[triangles >= len(self.vertices)] -= len(self.vertices) - old_count
        placed = np.concatenate([self.vertices[:old_count], mesh["vertices"]])
        new = Patch(placed, read_only(triangles), self.fixed, self.normals)
        return new, (mesh["triangle"], mesh["weights"]), mesh["old"]

    def faired(self, start: str, outside: Any, options: dict[str, Any], progress: Progress | None) -> FairResult:
        chosen = {"inner_fairness": "conformal", **options}
        if outside is not None and len(outside):
            chosen["outside"] = outside
        return fair(
            self.vertices, self.triangles, fixed=self.fixed, fixed_normals=self.normals, start=start,
            progress=progress, **chosen,
        )  # fmt: skip


_MADE_HERE = ("fixed", "fixed_normals", "reference", "neighbours", "outline", "start", "outside")


def refuse_made_here(options: dict[str, Any], progress: Any) -> None:
    for name in _MADE_HERE:
        if name in options:
            raise ValueError(f"{name}: not accepted here; the mesh and its boundary are made by this call")
    if options.get("equation") == "minimal":
        raise ValueError("equation: 'minimal' has no normals to continue; accepted are the others")
    _options.continuity(
        options.get("continuity", "G1"), options.get("equation", "harmonic"), options.get("method", "global")
    )
    _options.callback(progress)


def spacing_of(value: Any, inner: str | None) -> Spacing:
    if _arguments.finite("spacing", value) < 0:
        raise ValueError(f"spacing: a length, or 0 for that of the boundary's edges, is needed, not {value!r}")
    chosen = ("even" if value else "outline") if inner is None else inner
    return Spacing(float(value), _arguments.choice("inner", chosen, INNER) == "even")


def _start(first: str, options: dict[str, Any]) -> str:
    """Where the solve on the fine mesh begins; ``first``: what suits the first surface, which is a harmonic one.

    Automatic chooses that of least variation by itself: there it stands in for nothing.
    """
    equation = options.get("equation", "harmonic")
    chosen = equation == "automatic" and first == "least_variation"
    same = equation in ("harmonic", "automatic") and options.get("otherwise") != "stop" and not chosen
    return first if same else "given"


def _first_equation(options: dict[str, Any]) -> str:
    """Of the first surface: harmonic but for the equation that joins what no harmonic surface does."""
    asked = str(options.get("equation", "harmonic"))
    joins_curvature = options.get("continuity", "G1") == "G2"
    return asked if asked == "least_variation" or (asked == "automatic" and not joins_curvature) else "harmonic"


def cut_fields(patch: Patch, old_count: int) -> dict[str, Any]:
    """The fields of a mesh that was cut from another one's surface."""
    return {
        "vertices": read_only(patch.vertices[old_count:]), "triangles": patch.triangles, "polished": False,
        "cut": True,
    }  # fmt: skip


def carried(values: FloatArray, triangles: IntArray, origin: Origin) -> FloatArray:
    """(k,) values at vertices (n,), interpolated at places on triangles."""
    carried: FloatArray = read_only((values[triangles[origin[0]]] * origin[1]).sum(axis=1))
    return carried
