"""Surfaces over holes and between boundary loops."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import (
    _arguments,
    _core,
    _holes,
    _hub,
    _loops,
    _options,
    _pinches,
    _run_on,
    _short_edges,
    _sides,
    _single_face,
)  # fmt: skip
from fairing._along import filled_along
from fairing._chosen import Chosen, Wanted, blamed, chosen_loops, fillable
from fairing._fair import fair
from fairing._joined import joined
from fairing._measure import boundary_loops
from fairing._new_mesh import FillResult, Origin, read_only, report_fields
from fairing._proportion import Limit
from fairing._tangency import not_tangent
from fairing._types import FairResult, FloatArray, IntArray, MeshError
from fairing._watch import Watch

_OF_LOOPS = ("loops", "left_open", "left_because")  # fields

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
    longest_length: float = 0.0,
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
    options
        Those of :func:`fairing.fair` that don't concern the boundary: ``equation``, ``load``, ``bulge``,
        ``continuity``, ``tolerance``, ``max_iterations``, ``threads``, … By default ``inner_fairness`` keeps the
        triangles' shapes.

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
    points = _arguments.floats("vertices", vertices)
    around = _arguments.triangles_within(triangles, len(points))
    limit = _arguments.whole("longest", longest, 0)
    length = spacing_of(spacing, inner)
    refuse_made_here(options, progress)
    if not isinstance(bridge, (bool, np.bool_)):
        raise ValueError(f"bridge: True or False is needed, not {bridge!r}")
    if _arguments.finite("longest_length", longest_length) < 0:
        raise ValueError(f"longest_length: a length, or 0 for any, is needed, not {longest_length!r}")
    if fixed_curvatures is not None and options.get("continuity", "G1") != "G2":
        raise ValueError("fixed_curvatures: accepted with continuity 'G2' only")
    finite = np.isfinite(points).all(axis=1)
    known = around if finite.all() else around[finite[around].all(axis=1)]
    broken = _run_on.Edges.of((points, known), (edges, wires, marked), bool(bridge))
    wanted = Wanted(loops, normals, fixed_curvatures, bool(bridge), limit, float(longest_length), broken.hard)
    chosen = chosen_loops(points, around, wanted)
    task = _Task(points, known, bool(bridge), length, max_vertices, broken, options, _rising(progress))
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
    return FillResult(
        **values,
        loops=tuple(read_only(loop) for loop in chosen.outline.loops),
        left_open=tuple(read_only(each.loop) for each in chosen.left),
        left_because=tuple(each.reason for each in chosen.left),
    )


def _rising(progress: Progress | None) -> Progress | None:
    """The callback, which never hears less than before: some loops are filled after others, or once more."""
    if progress is None:
        return None
    most = 0.0

    def told(fraction: float, stage: str) -> bool | None:
        nonlocal most
        most = max(most, fraction)
        return progress(most, stage)

    return told


@dataclass(frozen=True)
class _Task:
    """What one call asks for, but for the loops."""

    points: FloatArray
    around: IntArray
    bridge: bool
    length: Spacing
    max_vertices: Any
    broken: _run_on.Edges
    options: dict[str, Any]
    progress: Progress | None

    def filled(self, chosen: Chosen) -> dict[str, Any]:
        """The fields of a result but for the loops: curves, faces, fans and surfaces, as each loop asks for."""
        Limit.of(0.0, self.max_vertices)
        loops = chosen.outline.loops
        plain = [k for k, loop in enumerate(loops) if not self.bridge and self._is_single(loop)]
        rest = [k for k in range(len(loops)) if k not in set(plain)]
        curves, through = self._curves(chosen, rest)
        rest = [k for k in rest if k not in set(through)]
        fans, hubs = self._fans(chosen, [] if self.bridge else self._hubs(chosen, rest))
        others = [k for k in rest if k not in set(hubs)]
        watch = Watch(self.progress)
        share = len(through) / max(1, len(through) + len(others))
        along = self._along(chosen.part(through), curves, watch.part(0.0, share)) if curves and through else None
        if curves and along is not None and not along["converged"]:
            curves, along = curves.left_alone([loops[k] for k in through]), None
            others = sorted([*others, *through])
        made = [
            along,
            self._solved(chosen.part(others), watch.part(share, 1.0)) if others else None,
            fans,
            self._single_faces(chosen.part(plain)) if plain else None,
        ]
        values = joined(len(self.points), [fields for fields in made if fields is not None])
        if curves:
            values["warnings"] += curves.warnings
            bands = tuple(tuple(map(read_only, band)) for band in curves.bands)
            values |= {"curves": tuple(map(read_only, curves.curves)), "marked": curves.marked, "bands": bands}
        return values

    def _curves(self, chosen: Chosen, numbers: list[int]) -> tuple[_run_on.Curves | None, list[int]]:
        """What runs through these loops, and through which."""
        if not numbers:
            return None, []
        part = chosen.part(numbers)
        length = (self.length.length, self.length.even)
        curves = self.broken.run_on(part.outline, self._shared(part), (self.points, self.around), length)
        return curves, [k for k, cut in zip(numbers, curves.cut, strict=True) if cut is not None]

    def _along(self, chosen: Chosen, curves: _run_on.Curves, progress: Progress | None) -> dict[str, Any]:
        task = (chosen.outline, self._shared(chosen), self.around, self.length.wanted(0), self.options)
        return filled_along(curves, task, progress)

    def _shared(self, chosen: Chosen) -> FloatArray:
        return _short_edges.with_shared_normals(chosen.outline, self.points, chosen.normals)

    def _hubs(self, chosen: Chosen, numbers: list[int]) -> list[int]:
        """The loops over which one vertex is enough."""
        plain = self.options.get("equation", "harmonic") in ("harmonic", "automatic")
        if self.length.length or not plain or self.options.get("continuity", "G1") != "G1":
            return []
        loops, rows = chosen.outline.loops, chosen.outline.split(chosen.normals)
        fit = [k for k in numbers if len(loops[k]) < 9 and len(np.unique(loops[k])) == len(loops[k])]
        points = [self.points[loop] for loop in loops]
        return [k for k in fit if _hub.takes_hub(points[k], rows[k], points[k].mean(axis=0))]

    def _fans(self, chosen: Chosen, numbers: list[int]) -> tuple[dict[str, Any] | None, list[int]]:
        """The fans over these loops, and those over which they are good."""
        if not numbers:
            return None, []
        part = chosen.part(numbers)
        outline, rows = part.outline, part.outline.split(part.normals)
        Limit.of(float(len(numbers)), self.max_vertices).check(float(len(numbers)), outline.vertices)
        watch = Watch(self.progress)
        split = _pinches.split(outline, self.points, part.normals, False)
        hubs = np.stack([self.points[loop].mean(axis=0) for loop in outline.loops])
        triangles = read_only(_hub.fans(split.outline.loops, split.count))
        patch = Patch(np.concatenate([split.points, hubs]), triangles, split.outline.vertices, part.normals)
        options = {**self.options, "otherwise": "stop"}
        report = patch.faired("given", self.around, options, watch.part(0.0, 1.0))
        found = report.vertices[split.count :]
        good = [
            _hub.takes_hub(self.points[loop], row, hub)
            for loop, row, hub in zip(outline.loops, rows, found, strict=True)
        ]
        if not report.converged or not all(good):
            kept = [k for k, fits in zip(numbers, good, strict=True) if fits] if report.converged else []
            return self._fans(chosen, kept)
        values = report_fields(report, split.count)
        watch.lap("fans")
        values["seconds"] = {**values["seconds"], **watch.seconds}
        return split.welded({**values, "triangles": patch.triangles}), numbers

    def _is_single(self, loop: IntArray) -> bool:
        return _single_face.is_single(self.points[loop], self.length.length)

    def _single_faces(self, chosen: Chosen) -> dict[str, Any]:
        loops = chosen.outline.loops
        rows = chosen.outline.split(chosen.normals)
        edges = _single_face.edges_among(self.around, chosen.outline.vertices)
        faces = [_single_face.face_over(each, self.points, row, edges) for each, row in zip(loops, rows, strict=True)]
        _loops.check_doubles(np.concatenate(faces), self.around)
        angles = [
            _single_face.angles_at(loop, self.points, row, face)
            for loop, row, face in zip(loops, rows, faces, strict=True)
        ]
        values = _single_face.fields_of(faces, angles, loops, self.around, self.points)
        equation, continuity = (self.options.get(*each) for each in (("equation", "harmonic"), ("continuity", "G1")))
        arrays = {name: read_only(array) for name, array in values.items()}
        return {**_single_face.report_of(str(equation), str(continuity)), **arrays}

    def _solved(self, chosen: Chosen, progress: Progress | None) -> dict[str, Any]:
        """The same without curves, where there are vertices inside."""
        options, bridge, length = dict(self.options), self.bridge, self.length
        normals = self._shared(chosen)
        split = _pinches.split(chosen.outline, self.points, normals, bridge)
        outline, points, around = split.outline, split.parted, self.around
        rims = [points[loop] for loop in outline.loops]
        most = Limit.of(_holes.flat_count(rims, length.length, bridge), self.max_vertices)
        least = most.flat if bridge else _holes.least_count(rims, outline.split(chosen.normals), length.length)
        most.check(least, chosen.outline.vertices)
        if chosen.curvatures is not None:
            options["fixed_curvatures"] = chosen.curvatures
        watch = Watch(progress)
        first = _first_surface(points, outline, normals, bridge, options, watch.part(0, 0.2))
        watch.lap("first")
        slopes = None if options.get("equation") == "minimal" else normals
        patch = Patch(np.concatenate([points, first["vertices"]]), first["triangles"], outline.vertices, slopes)
        count = patch.expected_count(length)
        most.check(count, chosen.outline.vertices, first["converged"])
        fine, _ = patch.remeshed(split.count, length, LEAST_COUNT, options, watch.part(0.2, 0.4))
        fine = fine.with_old(split.points)
        watch.lap("mesh")
        _loops.check_doubles(fine.triangles, around)
        coarser = count < 0.9 * LEAST_COUNT * (1 if bridge else len(outline.loops))
        trying = options if first["converged"] else {**options, "otherwise": "stop"}  # it was sought in vain once
        report = fine.faired(_start(first["start"], options), around, trying, watch.part(0.4, 0.9 if coarser else 1.0))
        values = report_fields(report, split.count)
        values["warnings"] += not_tangent(report, outline, split.points, around)
        if coarser:
            solved = Patch(report.vertices, fine.triangles, outline.vertices, slopes)
            coarse, origin = solved.remeshed(split.count, length, 0, options, watch.part(0.9, 1.0))
            values.update(cut_fields(coarse, split.count))
            values["mean_curvature"] = carried(report.mean_curvature, fine.triangles, origin)
        else:
            values["triangles"] = fine.triangles
        watch.lap("coarser")
        values["seconds"] = {**values["seconds"], **watch.seconds}
        return split.welded(values)


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
    flat: bool = False
    """Whether the old triangles are the surface as they are, broken along seams, and small angles may stay."""

    def wanted(self, least: int) -> tuple[float, int, bool, bool]:
        return self.length, least, self.even, self.flat


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

    def with_old(self, vertices: FloatArray) -> Patch:
        """The same with its first vertices at these places."""
        return Patch(
            np.concatenate([vertices, self.vertices[len(vertices) :]]), self.triangles, self.fixed, self.normals
        )

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
    own = asked in ("least_variation", "minimal") or (asked == "automatic" and not joins_curvature)
    return asked if own else "harmonic"


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
