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
_SMALL = 1000  # new vertices that are solved in any case
_NEVER = 4_000_000  # new vertices: a slip in the spacing, rather than a wish


@dataclass(frozen=True)
class Limit:
    """Of the new vertices of a call."""

    flat: float
    """About how many there would be over flat surfaces, or over the old one."""
    most: float
    chosen: bool
    """By the caller."""

    @classmethod
    def of(cls, flat: float, max_vertices: Any) -> Limit:
        """``max_vertices``: the caller's; 0: twenty times as many as over flat surfaces, within bounds."""
        given = arguments.whole("max_vertices", max_vertices, 0)
        return cls(flat, float(given or min(max(_ALWAYS, PROPORTION * flat), _NEVER)), given > 0)

    def check(self, count: float, elements: IntArray, found: bool = True) -> None:
        """MeshError (OUT_OF_PROPORTION) where so many vertices would be too many; ``elements``: vertices around.

        ``found``: whether a first small surface was. What is left of a search in vain deserves no large mesh, however
        large it is: nothing is always accepted then.
        """
        most = self.most if found or self.chosen else min(self.most, max(_SMALL, PROPORTION * self.flat))
        if count <= most:
            return
        text = f"the surface would take about {count:.2g} new vertices, and {most:.2g} are accepted"
        text += ": raise `spacing`, or allow more by `max_vertices`"
        if not found:
            text = f"no surface was found on a small mesh, and {text}"
        figures = {"count": float(count), "limit": most, "flat": self.flat}
        where = np.unique(elements).astype(np.int32)
        raise MeshError(Diagnostic("OUT_OF_PROPORTION", text, where, "vertex", figures))


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

    def wanted(self, least: int) -> tuple[float | FloatArray, int, bool, bool]:
        return self.length if self.each is None else self.each, least, self.even, self.flat


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
        count = _core.expected_count(self.vertices, self.triangles, self.fixed, self.normals, spacing.wanted(0))
        return count - 0.5 * sum(map(len, _core.boundary_loops(mine)))

    def remeshed(
        self, old_count: int, spacing: Spacing, least: int, options: dict[str, Any], progress: Progress | None
    ) -> tuple[Patch, Origin]:
        """On the first ``old_count`` of these vertices and new ones."""
        new, origin, _ = self.meshed_anew(old_count, arguments.NO_EDGES, (spacing, least), options, progress)
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
            self.vertices, self.triangles, self.fixed, self.normals, free_slopes(options), lines,
            wanted[0].wanted(wanted[1]),
            arguments.whole("threads", options.get("threads", 0), 0), progress,
        )  # fmt: skip
        triangles = mesh["triangles"].copy()
        triangles[triangles >= len(self.vertices)] -= len(self.vertices) - old_count
        placed = np.concatenate([self.vertices[:old_count], mesh["vertices"]])
        new = Patch(placed, read_only(triangles), self.fixed, self.normals)
        return new, (mesh["triangle"], mesh["weights"]), mesh["old"]

    def faired(self, start: str, outside: Any, options: dict[str, Any], progress: Progress | None) -> FairResult:
        chosen = {"inner_fairness": "conformal", **options}
        threads = chosen.pop("threads", 0)
        joined = {name: chosen.pop(f"fixed_{name}", None) for name in ("curvatures", "continuity")}
        around = outside if outside is not None and len(outside) else None
        boundary = Boundary(self.fixed, self.normals, outside=around, **joined)
        return solved(self.vertices, self.triangles, boundary, Options.of(**chosen, start=start), progress, threads)


def free_slopes(options: dict[str, Any]) -> tuple[IntArray, IntArray]:
    """Fixed vertices on creases, and on smooth curves."""
    given = {name: options.get(name) for name in ("creases", "smooth_curves")}
    creases, curves = (arguments.integers(name, [] if at is None else at, None) for name, at in given.items())
    return creases, curves


_MADE_HERE = ("reference", "neighbours", "outline", "start")


def refuse_made_here(options: dict[str, Any], progress: Any) -> None:
    for name in _MADE_HERE:
        if name in options:
            raise ValueError(f"{name}: not accepted here; the mesh and its boundary are made by this call")
    checks.continuity(
        options.get("continuity", "G1"), options.get("equation", "harmonic"), options.get("method", "global")
    )
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
