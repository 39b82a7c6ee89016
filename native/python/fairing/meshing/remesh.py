"""New meshes for patches, and what is solved on them."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.options import arguments, checks
from fairing.options.groups import Boundary, Options
from fairing.results import (
    FairResult,
    FloatArray,
    IntArray,
    Origin,
    PairedQuads,
    Progress,
    RemeshResult,
    read_only,
)  # fmt: skip
from fairing.solving import surroundings
from fairing.solving.fair import solved

FACES = ("triangles", "quads")


class Watch:
    """Seconds of the stages, and the callback's share of each."""

    def __init__(self, progress: Progress | None) -> None:
        self.seconds: dict[str, float] = {}
        self._progress = progress
        self._begin = self._last = perf_counter()

    def lap(self, stage: str) -> None:
        now = perf_counter()
        self.seconds[stage] = now - self._last
        self.seconds["total"] = now - self._begin
        self._last = now

    def part(self, begin: float, end: float) -> Progress | None:
        progress = self._progress
        if progress is None:
            return None
        return lambda fraction, stage: progress(begin + (end - begin) * fraction, stage)


INNER = ("outline", "even")


@dataclass(frozen=True)
class Spacing:
    """How long new edges are to be."""

    length: float
    even: bool
    flat: bool = False
    """Whether the old triangles are the surface as they are, broken along seams, and small angles may stay."""
    each: FloatArray | None = None
    """(n,) of the vertices, in place of the length."""

    @property
    def wanted(self) -> tuple[float | FloatArray, bool, bool]:
        return self.length if self.each is None else self.each, self.even, self.flat


@dataclass(frozen=True)
class Patch:
    """A mesh to be solved or meshed anew, with its boundary and the normals there."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray | None
    normals: FloatArray | None

    def expected_new(self, spacing: Spacing) -> float:
        """About how many vertices of a mesh of that spacing are new: half as many as the boundary has are not."""
        mine = self.triangles[_core.components(self.triangles, self.fixed, len(self.vertices)) >= 0]
        count = _core.expected_count(self.vertices, self.triangles, self.fixed, self.normals, spacing.wanted)
        return count - 0.5 * sum(map(len, _core.boundary_loops(mine)))

    def remeshed(
        self, old_count: int, lines: IntArray, spacing: Spacing, options: dict[str, Any], progress: Progress | None
    ) -> tuple[Patch, Origin, IntArray]:
        """On the first ``old_count`` of these vertices and new ones, with edges that stay: where each new vertex lies.

        Last the old vertex that each new one is, or −1.
        """
        given = {name: options.get(name) for name in ("creases", "smooth_curves")}
        free_slopes = tuple(arguments.integers(name, [] if at is None else at, None) for name, at in given.items())
        mesh = _core.remesh(
            self.vertices, self.triangles, self.fixed, self.normals, free_slopes, lines, spacing.wanted,
            arguments.whole("threads", options.get("threads", 0), 0), progress,
        )  # fmt: skip
        triangles = mesh["triangles"].copy()
        triangles[triangles >= len(self.vertices)] -= len(self.vertices) - old_count
        placed = np.concatenate([self.vertices[:old_count], mesh["vertices"]])
        new = Patch(placed, read_only(triangles), self.fixed, self.normals)
        return new, (mesh["triangle"], mesh["weights"]), mesh["old"]

    def faired(self, options: dict[str, Any], progress: Progress | None) -> FairResult:
        """Begun at these vertices, if not told otherwise."""
        chosen = {"inner_fairness": "conformal", "start": "given", **options}
        threads = chosen.pop("threads", 0)
        boundary = Boundary(self.fixed, self.normals, chosen.pop("fixed_curvatures", None))
        return solved(self.vertices, self.triangles, boundary, Options.of(**chosen), progress, threads)


_MADE_HERE = ("reference", "neighbours", "outline", "start")


def options_of(options: Options | None, named: dict[str, Any], progress: Any) -> Options:
    """The options of a call that makes its boundary itself."""
    for name in checks.OF_BOUNDARY:
        if name in named:
            raise ValueError(f"{name}: not accepted here; the mesh and its boundary are made by this call")
    chosen = checks.given(None, options, named)[1]
    refuse_made_here(chosen, progress)
    return chosen


def refuse_made_here(chosen: Options, progress: Any) -> None:
    for name in _MADE_HERE:
        if name in chosen.chosen:
            raise ValueError(f"{name}: not accepted here; the mesh and its boundary are made by this call")
    checks.continuity(chosen.surface.continuity, chosen.surface.equation, chosen.solving.method)
    checks.callback(progress)


def own_mesh_options(chosen: Options, threads: int) -> _core.Options:
    """What the engine is told about a mesh that a call makes itself, checked."""
    if vars(chosen.skin).keys() & chosen.chosen.keys():
        raise ValueError("detail, feather and weights: not accepted here, where the mesh is made by this call")
    fairness = chosen.layout.inner_fairness
    if not isinstance(fairness, str | None):
        raise ValueError("inner_fairness: rows of weights are not accepted here, where the mesh is made by this call")
    return checks.engine_options(chosen.changed(inner_fairness=fairness or "conformal"), threads, 0)


def spacing_of(value: Any, inner: str | None) -> Spacing:
    length = arguments.length("spacing", value, "that of the boundary's edges")
    chosen = ("even" if value else "outline") if inner is None else inner
    return Spacing(length, arguments.choice("inner", chosen, INNER) == "even")


def halves_of(points: FloatArray, quads: IntArray) -> IntArray:
    """(2 q, 3) the first triangles of all quads, then the second ones."""
    turned = _turned(points, quads)
    return np.concatenate([turned[:, [0, 1, 3]], turned[:, [2, 3, 1]]])


def _turned(points: FloatArray, quads: IntArray) -> IntArray:
    """Quads that begin so that the diagonal from corner 1 to corner 3 is the shorter one."""
    corners = points[quads]
    lengths = np.linalg.norm(corners[:, [0, 1]] - corners[:, [2, 3]], axis=2)
    is_shorter = lengths[:, 0] < (1 - 1e-6) * lengths[:, 1]
    return np.where(is_shorter[:, None], np.roll(quads, -1, axis=1), quads)


def quads_of(triangles: IntArray, pairs: IntArray) -> PairedQuads:
    """The faces that pairs of triangles make."""
    first, second = triangles[pairs[:, 0]], triangles[pairs[:, 1]]
    begin = (first[:, :, None] != second[:, None, :]).all(axis=2).argmax(axis=1)
    end = (second[:, :, None] != first[:, None, :]).all(axis=2).argmax(axis=1)
    row = np.arange(len(pairs))
    at = [first[row, begin], first[row, (begin + 1) % 3], second[row, end], first[row, (begin + 2) % 3]]
    rest = np.setdiff1d(np.arange(len(triangles), dtype=np.int32), pairs)
    quads = np.stack(at, axis=1).astype(np.int32).reshape(-1, 4)
    return PairedQuads(*(read_only(each) for each in (quads, triangles[rest], pairs, rest)))


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
    around, chosen = checks.given(boundary, options, named)
    if around.continuity is not None and around.curvatures is None:
        raise ValueError("continuity: 'G2' on parts of the boundary needs `curvatures` here")
    points, corners = arguments.mesh(vertices, triangles)
    held, given_normals = arguments.boundary(around.vertices, around.normals)
    lines = arguments.edges_of("kept", kept, corners)
    length = spacing_of(spacing, inner)
    in_rows = arguments.choice("faces", faces, FACES) == "quads"
    most = arguments.whole("max_vertices", max_vertices, 0)
    refuse_made_here(chosen, progress)
    if chosen.surface.equation == "soap_film":
        raise ValueError("equation: 'soap_film' has no normals to continue; accepted are the others")
    engine = own_mesh_options(chosen, threads)
    beside = surroundings.Surroundings.of(points, corners, held, around.outside)
    joined = surroundings.Boundary(points, held, given_normals)
    if chosen.surface.continuity == "G2":
        joined = surroundings.with_curvatures(joined, beside, around.curvatures, around.continuity)
    outside = beside.outside if around.outside is not None else corners[:0]
    patch = points, corners, joined.fixed, given_normals, joined.curvatures, outside
    values = _core.new_patch(patch, lines.tolist(), engine, (length.length, length.even, in_rows, most), progress)
    values.pop("base")
    pairs = values.pop("pairs")
    return RemeshResult(**values, quads=None if pairs is None else quads_of(values["triangles"], pairs))
