"""Surfaces over holes and between outlines, and new meshes for patches."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core, _loops, _options, _sides
from fairing._fair import fair
from fairing._new_mesh import FillResult, NewMeshResult, Origin, RemeshResult
from fairing._types import FairResult, FloatArray, IntArray, MeshError

LEAST_COUNT = 1000
"""Free vertices of the mesh that is solved, for each component. Coarser wishes are cut from its surface."""
MOST_COUNT = 4_000_000

INNER = ("outline", "even")

_Progress = Callable[[float, str], "bool | None"]


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
    fixed_curvatures: Any = None,
    progress: _Progress | None = None,
    **options: Any,
) -> FillResult:
    """Fill holes, or join outlines, with the fairest surface that continues the surroundings.

    The surface does not depend on ``spacing``: it is solved on a mesh that is fine enough, and a coarser mesh is cut
    from it. Vertices and edges given stay as they are. No argument is ever changed.

    Parameters
    ----------
    vertices : (n, 3) float
    triangles : (m, 3) int
        The mesh around, consistently wound; there may be none if ``loops`` and ``normals`` are given.
    loops : list of (k,) int
        Closed loops of border vertices, in either direction; default: all border loops. A loop that no triangle
        touches has the new surface on its left, seen from the side of the normals; it is turned where that leads away
        from the other loops of a bridge, or outside of a lone loop.
    normals : (n, 3), (Σ k, 3) float, or a list with a (k, 3) for each loop
        Normals at the outline, of any length but zero; of the vertices, where n is Σ k and they are no list.
        Default: :func:`fairing.surrounding_normals`.
    bridge : bool
        False: each loop gets a surface of its own. True: one surface joins all loops, a tube between two, a blend
        between more.
    spacing : float
        Length of the new edges away from the outline, in the unit of ``vertices``. 0: as the outline's own edges. From
        the outline, whose edges stay, lengths grow or shrink by a half of the distance.
    inner : "outline" | "even"
        "outline": new edges are in proportion to those of the outline around them, and ``spacing`` long in the mean.
        "even": all are ``spacing`` long; as the outline's mean edge for 0. Default: "outline" for a spacing of 0, else
        "even".
    longest : int
        Without ``loops``: border loops with more edges than that are left open; 0: none.
    fixed_curvatures : (n,), (Σ k,) float, or a list with a (k,) for each loop
        Mean curvatures H at the outline, NaN where not known, for ``continuity="G2"``: the surface continues the
        curvature around it, too. Default: fitted to the triangles around.
    progress : callable(fraction, stage) -> None | bool
        As for :func:`fairing.fair`.
    options
        Those of :func:`fairing.fair` that don't concern the outline: ``equation``, ``load``, ``bulge``, ``continuity``,
        ``tolerance``, ``max_iterations``, ``threads``, … ``inner_fairness`` is by default that which keeps the
        triangles' shapes.

    Raises
    ------
    MeshError
        NOT_A_LOOP, NO_BOUNDARY, NONMANIFOLD_VERTEX (loops that touch or cross, or vertices of one outline in one
        place), NONMANIFOLD_EDGE (also where the surface would double back onto a triangle that sticks out into a
        loop), NOT_A_HOLE (the outside of a sheet), LOOPS_NOT_JOINED (one is turned; loops that no surface joins),
        ZERO_NORMAL, NORMALS_OPPOSE_WINDING, NONFINITE or INDEX_RANGE; ``elements`` are the vertices.
    ValueError, Cancelled, SolverError, MemoryError
        As for :func:`fairing.fair`.
    """
    points = _arguments.floats("vertices", vertices)
    around = _arguments.triangles_within(triangles, len(points))
    limit = _arguments.whole("longest", longest, 0)
    length = _spacing(spacing, inner)
    _check_options(options, progress)
    if not isinstance(bridge, (bool, np.bool_)):
        raise ValueError(f"bridge: True or False is needed, not {bridge!r}")
    outline = _loops.border_loops(around, limit) if loops is None else _loops.given_loops(loops, points, around)
    _loops.check(outline, points, bool(bridge))
    outline, normals = _sides.settled(
        outline, points, _loops.loop_normals(normals, outline, points, around), bool(bridge)
    )
    if fixed_curvatures is not None:
        options["fixed_curvatures"] = _loops.loop_curvatures(fixed_curvatures, outline, len(points))
    watch = _Watch(progress)
    first = _first_surface(points, outline, normals, bool(bridge), options, watch.part(0, 0.2))
    watch.lap("first")
    patch = _Patch(np.concatenate([points, first["vertices"]]), first["triangles"], outline.vertices, normals)
    count = patch.expected_count(length)
    fine, _ = patch.remeshed(len(points), length, LEAST_COUNT, options, watch.part(0.2, 0.4))
    watch.lap("mesh")
    _loops.check_doubles(fine.triangles, around)
    coarser = count < 0.9 * LEAST_COUNT * (1 if bridge else len(outline.loops))
    chosen = options if first["converged"] else {**options, "otherwise": "stop"}  # it was sought in vain once
    report = fine.faired(_start(first["start"], options), around, chosen, watch.part(0.4, 0.9 if coarser else 1.0))
    values = _report(report, len(points))
    if coarser:
        solved = _Patch(report.vertices, fine.triangles, outline.vertices, normals)
        coarse, origin = solved.remeshed(len(points), length, 0, options, watch.part(0.9, 1.0))
        values.update(_cut(coarse, len(points)))
        values["mean_curvature"] = _carried(report.mean_curvature, fine.triangles, origin)
    else:
        values["triangles"] = fine.triangles
    watch.lap("coarser")
    values["seconds"] = {**values["seconds"], **watch.seconds}
    return FillResult(**values, loops=tuple(_read_only(loop) for loop in outline.loops))


def remesh(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    *,
    fixed: npt.ArrayLike | None = None,
    fixed_normals: npt.ArrayLike | None = None,
    kept: npt.ArrayLike | None = None,
    spacing: float = 0.0,
    inner: str | None = None,
    progress: _Progress | None = None,
    **options: Any,
) -> RemeshResult:
    """Fair a patch on a new mesh: :func:`fairing.fair`, and then other vertices and triangles for its surface.

    Fixed vertices and the outline's edges stay. ``origin`` says where each new vertex lies on the old patch, so that
    what belongs to its vertices or corners can be carried over: what :func:`fairing.fair` makes of the old mesh, with
    ``inner_fairness="conformal"`` by default, takes them there. ``spacing`` and ``inner`` are those of
    :func:`fairing.fill`, the other parameters those of :func:`fairing.fair`. Where the new mesh is coarser than the
    old one and has less than 1000 vertices, it is cut from the surface of the old one, and not solved again.

    ``kept``, (e, 2): edges of the old mesh that the new one has, too, between new vertices at the same places of the
    surface, which ``result.old`` names: seams of a texture.
    """
    points = _arguments.floats("vertices", vertices)
    faces = _arguments.triangles_within(triangles, len(points))
    held, given_normals = _arguments.boundary(fixed, fixed_normals)
    lines = _arguments.edges_of("kept", kept, faces)
    length = _spacing(spacing, inner)
    outside = options.pop("outside", None)
    _check_options(options, progress)
    watch = _Watch(progress)
    old = _Patch(points, faces, held, given_normals)
    report = old.faired("outline", outside, options, watch.part(0, 0.4))
    watch.lap("first")
    if given_normals is None:
        averaged = _core.vertex_normals(points, faces, "averaged")
        held, given_normals = report.fixed, averaged[report.fixed]
    solved = _Patch(report.vertices, faces, held, given_normals)
    new, origin, old_vertex = solved.meshed_anew(len(points), lines, (length, 0), options, watch.part(0.4, 0.6))
    watch.lap("mesh")
    values = _report(report, len(points))
    added = len(new.vertices) - len(points)
    if added >= min(LEAST_COUNT, len(np.setdiff1d(faces, report.fixed))):
        values = _report(new.faired("given", outside, options, watch.part(0.6, 1.0)), len(points))
        values["triangles"] = new.triangles
    else:
        values.update(_cut(new, len(points)))
        values["mean_curvature"] = _carried(report.mean_curvature, faces, origin)
    values["seconds"] = {**values["seconds"], **watch.seconds}
    return RemeshResult(**values, origin=origin, old=_read_only(old_vertex))


def _first_surface(
    points: FloatArray,
    outline: _loops.Outline,
    normals: FloatArray,
    bridge: bool,
    options: dict[str, Any],
    progress: _Progress | None,
) -> Any:
    """On a coarse mesh: `vertices`, `triangles`, `converged`, and how the solve on a fine one `start`s."""
    rows = outline.split(normals)
    try:
        return _core.fill_loops(points, list(outline.loops), rows, bridge, _first_equation(options), progress)
    except MeshError as error:
        if not bridge or error.code != "NONMANIFOLD_EDGE":
            raise
        raise _sides.not_joined(outline, points, normals) from error


@dataclass(frozen=True)
class _Spacing:
    """How long new edges are to be."""

    length: float
    even: bool

    def wanted(self, least: int) -> tuple[float, int, bool]:
        return self.length, least, self.even


@dataclass(frozen=True)
class _Patch:
    """A mesh to be solved or meshed anew, with its outline and the normals there."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray | None
    normals: FloatArray | None

    def expected_count(self, spacing: _Spacing) -> float:
        """About how many vertices a mesh of that spacing has; ValueError where these are too many."""
        count = _core.expected_count(self.vertices, self.triangles, self.fixed, self.normals, spacing.wanted(0))
        if not count <= MOST_COUNT:
            raise ValueError(f"spacing: {spacing.length} gives about {count:.2g} vertices; {MOST_COUNT} are accepted")
        return count

    def remeshed(
        self, old_count: int, spacing: _Spacing, least: int, options: dict[str, Any], progress: _Progress | None
    ) -> tuple[_Patch, Origin]:
        """On the first ``old_count`` of these vertices and new ones."""
        new, origin, _ = self.meshed_anew(old_count, _arguments.NO_EDGES, (spacing, least), options, progress)
        return new, origin

    def meshed_anew(
        self,
        old_count: int,
        lines: IntArray,
        wanted: tuple[_Spacing, int],
        options: dict[str, Any],
        progress: _Progress | None,
    ) -> tuple[_Patch, Origin, IntArray]:
        """The same with edges that stay, and with the old vertex that each new one is, or −1."""
        self.expected_count(wanted[0])
        mesh = _core.remesh(
            self.vertices, self.triangles, self.fixed, self.normals, lines, wanted[0].wanted(wanted[1]),
            _arguments.whole("threads", options.get("threads", 0), 0), progress,
        )  # fmt: skip
        triangles = mesh["triangles"].copy()
        triangles[triangles >= len(self.vertices)] -= len(self.vertices) - old_count
        placed = np.concatenate([self.vertices[:old_count], mesh["vertices"]])
        new = _Patch(placed, _read_only(triangles), self.fixed, self.normals)
        return new, (mesh["triangle"], mesh["weights"]), mesh["old"]

    def faired(self, start: str, outside: Any, options: dict[str, Any], progress: _Progress | None) -> FairResult:
        chosen = {"inner_fairness": "conformal", **options}
        if outside is not None and len(outside):
            chosen["outside"] = outside
        return fair(
            self.vertices, self.triangles, fixed=self.fixed, fixed_normals=self.normals, start=start,
            progress=progress, **chosen,
        )  # fmt: skip


class _Watch:
    """Seconds of the stages, and the callback's share of each."""

    def __init__(self, progress: _Progress | None) -> None:
        self.seconds: dict[str, float] = {}
        self._progress = progress
        self._begin = self._last = perf_counter()

    def lap(self, stage: str) -> None:
        now = perf_counter()
        self.seconds[stage] = now - self._last
        self.seconds["total"] = now - self._begin
        self._last = now

    def part(self, begin: float, end: float) -> _Progress | None:
        progress = self._progress
        if progress is None:
            return None
        return lambda fraction, stage: progress(begin + (end - begin) * fraction, stage)


_MADE_HERE = ("fixed", "fixed_normals", "reference", "neighbours", "outline", "start", "outside")


def _check_options(options: dict[str, Any], progress: Any) -> None:
    for name in _MADE_HERE:
        if name in options:
            raise ValueError(f"{name}: not accepted here; the mesh and its outline are made by this call")
    if options.get("equation") == "minimal":
        raise ValueError("equation: 'minimal' has no normals to continue; accepted are the others")
    _options.continuity(
        options.get("continuity", "G1"), options.get("equation", "harmonic"), options.get("method", "global")
    )
    _options.callback(progress)


def _spacing(value: Any, inner: str | None) -> _Spacing:
    if _arguments.finite("spacing", value) < 0:
        raise ValueError(f"spacing: a length, or 0 for that of the outline's edges, is needed, not {value!r}")
    chosen = ("even" if value else "outline") if inner is None else inner
    return _Spacing(float(value), _arguments.choice("inner", chosen, INNER) == "even")


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


def _report(report: FairResult, old_count: int) -> dict[str, Any]:
    """The fields of a report on ``old_count`` old vertices and then new ones; `triangles` is missing."""
    own = {field.name for field in fields(NewMeshResult)}
    values = {field.name: getattr(report, field.name) for field in fields(report) if field.name in own}
    values["cut"] = False
    for name in ("vertices", "mean_curvature"):
        values[name] = _read_only(values[name][old_count:])
    return values


def _cut(patch: _Patch, old_count: int) -> dict[str, Any]:
    """The fields of a mesh that was cut from another one's surface."""
    return {
        "vertices": _read_only(patch.vertices[old_count:]), "triangles": patch.triangles, "polished": False,
        "cut": True,
    }  # fmt: skip


def _carried(values: FloatArray, triangles: IntArray, origin: Origin) -> FloatArray:
    """(k,) values at vertices (n,), interpolated at places on triangles."""
    carried: FloatArray = _read_only((values[triangles[origin[0]]] * origin[1]).sum(axis=1))
    return carried


def _read_only(array: Any) -> Any:
    result = np.ascontiguousarray(array)
    if result is array or result.base is not None:
        result = result.copy()
    result.flags.writeable = False
    return result
