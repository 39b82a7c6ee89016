"""Patches that are meshed anew and solved."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np

from fairing import _core
from fairing.options import arguments, checks
from fairing.options.groups import Boundary, Options
from fairing.results import Diagnostic, FairResult, FloatArray, IntArray, MeshError, Origin, read_only
from fairing.solving.fair import solved

Progress = Callable[[float, str], "bool | None"]


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


PROPORTION = 20.0  # times as many as over flat surfaces, or over the old one: more are refused
_ALWAYS = 50_000  # new vertices, which take some two seconds: never refused
_NEVER = 4_000_000  # new vertices: a slip in the spacing, rather than a wish


def refuse_large(count: float, flat: float, max_vertices: int, elements: IntArray) -> None:
    """MeshError (OUT_OF_PROPORTION) where so many new vertices would be too many; ``elements``: vertices around.

    ``flat``: about how many there would be over flat surfaces, or over the old one. ``max_vertices``: the caller's; 0:
    twenty times ``flat``, within bounds.
    """
    most = float(max_vertices or min(max(_ALWAYS, PROPORTION * flat), _NEVER))
    if count > most:
        text = f"the surface would take about {count:.2g} new vertices, and {most:.2g} are accepted"
        text += ": raise `spacing`, or allow more by `max_vertices`"
        figures = {"count": float(count), "limit": most, "flat": flat}
        raise MeshError(Diagnostic("OUT_OF_PROPORTION", text, np.unique(elements).astype(np.int32), "vertex", figures))


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
        """Begun at these vertices."""
        chosen = {"inner_fairness": "conformal", **options}
        threads = chosen.pop("threads", 0)
        boundary = Boundary(self.fixed, self.normals, chosen.pop("fixed_curvatures", None))
        return solved(self.vertices, self.triangles, boundary, Options.of(**chosen, start="given"), progress, threads)


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
    if arguments.finite("spacing", value) < 0:
        raise ValueError(f"spacing: a length, or 0 for that of the boundary's edges, is needed, not {value!r}")
    chosen = ("even" if value else "outline") if inner is None else inner
    return Spacing(float(value), arguments.choice("inner", chosen, INNER) == "even")
