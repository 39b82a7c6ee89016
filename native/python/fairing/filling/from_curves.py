"""Surfaces over wires: closed loops and networks of edges without faces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NoReturn

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.measure import edges_with_uses, self_intersections
from fairing.meshing.denoise import edges_around
from fairing.meshing.remesh import Patch, Spacing, Watch, refuse_large, spacing_of
from fairing.options import arguments, checks
from fairing.options.groups import Boundary, Options
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
from fairing.solving.fair import solved

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
    spacing, inner, max_vertices
        As for :func:`fairing.fill`, the wires in place of the boundary.
    progress, threads
        As for :func:`fairing.fair`.

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
    count = arguments.whole("threads", threads, 0)
    arguments.whole("max_vertices", max_vertices, 0)
    checks.callback(progress)
    if not isinstance(closed, (bool, np.bool_)):
        raise ValueError(f"closed: True or False is needed, not {closed!r}")
    _check(wires, points)
    if not (wires[:, None] == sharp).all(axis=2).any(axis=0).all():
        raise ValueError("creases: some of them are none of `edges`")
    watch = Watch(progress)
    cells = _Cells(*_core.wire_cells(wires, points, bool(closed)))
    return _Task(points, cells, _Held.of(cells, wires, sharp), length, max_vertices, count).filled(watch)


@dataclass(frozen=True, eq=False)
class _Cells:
    """Loops with their surface on the left, all of a network wound alike, and the normal of each (l, 3)."""

    loops: list[IntArray]
    normals: FloatArray
    left_open: list[IntArray]
    rims: IntArray
    """(r, 2) edges around openings that are closed."""


@dataclass(frozen=True)
class _Held:
    """Vertices of wires, all fixed: those where the surface finds a slope on either side, and one on both."""

    creases: IntArray
    smooth: IntArray
    bent: IntArray
    """(c, 2) the edges over which it may bend."""

    @classmethod
    def of(cls, cells: _Cells, wires: IntArray, sharp: IntArray) -> _Held:
        """Free slopes are at the edges over which the surface may bend, and at wires with one cell."""
        sides = np.concatenate([np.column_stack([loop, np.roll(loop, -1)]) for loop in cells.loops])
        used = np.bincount(arguments.places_of(sides, wires), minlength=len(wires))
        bent = np.unique(np.sort(np.concatenate([sharp, cells.rims]), axis=1), axis=0)
        creases = np.intersect1d(np.concatenate([wires[used == 1], bent]), wires[used > 0]).astype(np.int32)
        return cls(creases, np.setdiff1d(wires[used > 0], creases).astype(np.int32), bent)

    @property
    def all(self) -> IntArray:
        return np.union1d(self.creases, self.smooth)


@dataclass(frozen=True, eq=False)
class _Task:
    points: FloatArray
    cells: _Cells
    held: _Held
    length: Spacing
    max_vertices: Any
    threads: int

    def filled(self, watch: Watch) -> FromCurvesResult:
        first = self._bent(self._films(watch.part(0.0, 0.2)), watch.part(0.2, 0.3))
        watch.lap("first")
        usual = first.expected_new(Spacing(0.0, False))
        refuse_large(first.expected_new(self.length), usual, self.max_vertices, self.held.all)
        options = {"creases": self.held.all, "threads": self.threads}
        new = first.remeshed(len(self.points), arguments.NO_EDGES, self.length, options, watch.part(0.3, 0.4))[0]
        watch.lap("mesh")
        report = solved(
            new.vertices, new.triangles, Boundary(new.fixed, new.normals), self._options, watch.part(0.4, 1.0),
            self.threads,
        )  # fmt: skip
        values = report_fields(report, len(self.points))
        if not report.converged and len(self.held.smooth):
            values.update(self._plate(new))
        values["seconds"] = {**values["seconds"], **watch.seconds}
        return FromCurvesResult(
            **values,
            triangles=new.triangles,
            cells=tuple(map(read_only, self.cells.loops)),
            cell=_core.cells_of_triangles(new.triangles, self.cells.loops, len(new.vertices)),
            left_open=tuple(map(read_only, self.cells.left_open)),
            creases=read_only(self.held.bent),
        )

    def _plate(self, new: Patch) -> dict[str, Any]:
        """The fields that differ where the equation has no surface: the plate itself stands in."""
        count = len(self.points)
        curvature = _core.mean_curvature(new.vertices, new.triangles, new.fixed, None, "averaged")
        crossing = self_intersections(new.vertices, new.triangles)
        text = "no surface of least variation was found through these wires: a thin plate stands in, which bends more"
        found = [Diagnostic("NO_SOLUTION", text, self.held.all, "vertex", {"plate": 1.0})]
        if len(crossing):
            text = "the thin plate through the wires passes through itself: divide large cells by more wires"
            found.append(
                Diagnostic("SELF_INTERSECTION", text, crossing, "triangle", {"triangles": float(len(crossing))})
            )
        return {
            "vertices": read_only(new.vertices[count:]), "mean_curvature": read_only(curvature[count:]),
            "equation": "bilaplacian", "provenance": "first_surface", "warnings": tuple(found),
        }  # fmt: skip

    @property
    def _options(self) -> Options:
        if not len(self.held.smooth):  # each cell by itself
            return Options.of(equation="soap_film", creases=self.held.creases, inner_fairness="conformal")
        return Options.of(
            equation="least_variation", creases=self.held.creases, smooth_curves=self.held.smooth,
            inner_fairness="conformal", start="given",
        )  # fmt: skip

    def _films(self, progress: Progress | None) -> Patch:
        """A soap film in each cell. The normals are told, as all wires are, but do not count."""
        loops, normals = self.cells.loops, self.cells.normals
        rows = [np.tile(normal, (len(loop), 1)) for loop, normal in zip(loops, normals, strict=True)]
        found = _core.fill_loops(self.points, loops, rows, False, "soap_film", progress)
        fixed = self.held.all
        return Patch(
            np.concatenate([self.points, found["vertices"]]), found["triangles"], fixed,
            np.tile(normals[:1], (len(fixed), 1)),
        )  # fmt: skip

    def _bent(self, films: Patch, progress: Progress | None) -> Patch:
        """The films without their kinks at smooth wires: a thin plate, near the surface of least variation."""
        if not len(self.held.smooth):
            return films
        numbers, local = np.unique(films.triangles, return_inverse=True)
        local = local.reshape(-1, 3).astype(np.int32)
        low = films.vertices[numbers].min(axis=0)
        placed = films.vertices[numbers] - low
        unit = float(placed.max())
        placed /= unit
        sizes = _STIFF * edges_around(placed, edges_with_uses(local)[0])
        sizes[np.isin(numbers, self.held.creases)] = 0.0
        fixed = np.isin(numbers, self.held.all)
        bent = _core.denoised(
            placed, local, np.flatnonzero(fixed).astype(np.int32), sizes, self.threads, progress
        )  # fmt: skip
        vertices = films.vertices.copy()
        vertices[numbers[~fixed]] = low + unit * bent[~fixed]
        return Patch(vertices, films.triangles, films.fixed, films.normals)


def _wires(name: str, value: npt.ArrayLike, count: int) -> IntArray:
    """(e, 2) edges, each once, the lower end first."""
    given = arguments.vertices_of(name, value, count, 2)
    if (given[:, 0] == given[:, 1]).any():
        raise ValueError(f"{name}: row {int((given[:, 0] == given[:, 1]).argmax())} joins a vertex to itself")
    return np.unique(np.sort(given, axis=1), axis=0).astype(np.int32)


def _check(wires: IntArray, points: FloatArray) -> None:
    """MeshError for what no surface can begin with."""
    if not len(wires):
        _refuse("NO_CELL", "there are no wires: edges without a face are needed", wires)
    used = np.unique(wires)
    broken = used[~np.isfinite(points[used]).all(axis=1)]
    if len(broken):
        _refuse("NONFINITE", f"coordinates are not finite at {arguments.listed(broken)}", broken)
    on_edges, pairs = _core.touching_edges(wires, points)
    short = wires[(points[wires[:, 0]] == points[wires[:, 1]]).all(axis=1)]
    where = np.unique(np.concatenate([short.ravel(), pairs.ravel(), on_edges.ravel()]))
    if not len(where):
        where = np.unique(_core.crossing_edges(wires, points))
    if len(where):
        text = f"wires cross, or lie on each other, at {arguments.listed(where)}: "
        _refuse("WIRES_CROSS", text + "give them one common vertex, or move them apart", where)


def _refuse(code: str, text: str, where: IntArray) -> NoReturn:
    elements = where.astype(np.int32).ravel()
    raise MeshError(Diagnostic(code, text, elements, "vertex", {"vertices": float(len(elements))}))
