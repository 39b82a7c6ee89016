"""Pins pulled off surfaces: which have a radius, at what cost, and whether other starts give the same surface.

None of these cases was used to choose a constant of the engine.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

import fairing
import shapes
from engine import FloatArray
from meshing import IntArray
from shapes import Style

SPREAD, ALIKE = 0.12, 1e-4  # nearest pins and outlines, of D; largest difference that counts as the same, of D


@dataclass(frozen=True)
class Base:
    """A patch (n, 3), (m, 3) without pins, with normals (k, 3) at `fixed` (k,)."""

    vertices: FloatArray
    triangles: IntArray
    fixed: IntArray
    normals: FloatArray

    @property
    def size(self) -> float:
        """D."""
        held = self.vertices[self.fixed]
        return 2.0 * float(np.linalg.norm(held - held.mean(axis=0), axis=1).max())


@dataclass(frozen=True)
class Case:
    """Pins (p,) of a base and their (p, 3) ways, in lengths."""

    name: str
    base: Base
    pins: IntArray
    ways: FloatArray

    def fair(self, *, noise: float = 0.0, seed: int = 0) -> fairing.FairResult:
        """The surface, the interior given with noise (of D)."""
        base = self.base
        start = base.vertices.copy()
        free = np.setdiff1d(np.arange(len(start)), base.fixed)
        start[free] += noise * base.size * np.random.default_rng(seed).standard_normal((len(free), 3))
        start[self.pins] = base.vertices[self.pins] + self.ways
        fixed, normals = self.held()
        return fairing.fair(start, base.triangles, fixed=fixed, fixed_normals=normals, threads=1)

    def held(self) -> tuple[IntArray, FloatArray]:
        """What is fixed, and normals there; pins have none."""
        zero = np.zeros((len(self.pins), 3))
        return np.concatenate([self.base.fixed, self.pins]), np.vstack([self.base.normals, zero])


def _exact(make: Callable[..., shapes.Patch], n_free: int, seed: int) -> Base:
    patch = make(n_free, Style(seed=seed))
    return Base(patch.vertices, patch.triangles, patch.fixed, patch.fixed_normals)


BASES: dict[str, Callable[[int, int], Base]] = {
    "cap 60°": partial(_exact, partial(shapes.cap, half_angle=60.0)),
    "hemisphere": partial(_exact, shapes.cap),
    "cap 120°": partial(_exact, partial(shapes.cap, half_angle=120.0)),
    "torus": partial(_exact, shapes.torus),
    "cylinder": partial(_exact, partial(shapes.cylinder, shape="oval")),
    "catenoid": partial(_exact, partial(shapes.catenoid, shape="rectangle")),
    "linear flux": partial(_exact, partial(shapes.linear_flux, shape="oval")),
    "clothoid": partial(_exact, shapes.clothoid),
}


def _normals(base: Base) -> FloatArray:
    corners = base.vertices[base.triangles]
    faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    sums = np.zeros_like(base.vertices)
    np.add.at(sums, base.triangles.ravel(), np.repeat(faces, 3, axis=0))
    return sums / np.linalg.norm(sums, axis=1)[:, None]


def _places(base: Base, count: int, rng: np.random.Generator) -> IntArray:
    """Free vertices at random that keep their distance from the outline and each other, and are no neighbours."""
    free = np.setdiff1d(np.arange(len(base.vertices)), base.fixed)
    taken = base.vertices[base.fixed]
    pins: list[int] = []
    for vertex in rng.permutation(free):
        beside = base.triangles[(base.triangles == vertex).any(axis=1)]
        if np.isin(beside, [*base.fixed, *pins]).any():
            continue
        if np.linalg.norm(taken - base.vertices[vertex], axis=1).min() > SPREAD * base.size:
            pins.append(int(vertex))
            taken = np.vstack([taken, base.vertices[vertex]])
        if len(pins) == count:
            break
    return np.array(pins)


def _ways(base: Base, pins: IntArray, pull: float, kind: str, rng: np.random.Generator) -> FloatArray:
    normals = _normals(base)[pins]
    across = np.cross(normals, rng.standard_normal(normals.shape))
    across /= np.linalg.norm(across, axis=1)[:, None]
    ways = {"out": normals, "in": -normals, "sideways": across, "askew": (normals + across) / np.sqrt(2.0)}[kind]
    return pull * base.size * ways


KINDS, PULLS = ("out", "in", "sideways", "askew"), (0.1, 0.2, 0.3)


def exact_cases(seed: int, n_free: int) -> Iterator[Case]:
    """Each surface with one to four pins, each direction and three lengths of pull in turn."""
    rng = np.random.default_rng(seed)
    for name, make in BASES.items():
        base = make(n_free, seed)
        for kind in KINDS:
            for pull in PULLS:
                yield _case(name, base, kind, pull, rng)


def _case(name: str, base: Base, kind: str, pull: float, rng: np.random.Generator) -> Case:
    pins = _places(base, int(rng.integers(1, 5)), rng)
    told = f"{name} ({len(base.vertices) - len(base.fixed)}), {len(pins)} {kind} {pull}"
    return Case(told, base, pins, _ways(base, pins, pull, kind, rng))


def end_of(result: fairing.FairResult) -> str:
    """What became of the pins."""
    if not result.converged:
        return "none"
    if result.equation != "harmonic":
        return str(result.equation)
    codes = {told.code for told in result.warnings}
    return "points" if "PINS_NOT_SPREAD" in codes else "spread"


def timed(case: Case) -> tuple[fairing.FairResult, float]:
    """With its CPU seconds."""
    began = time.process_time()
    result = case.fair()
    return result, time.process_time() - began


def told(cases: Iterator[Case]) -> None:
    """Print one row for each case, and how many ended in each way."""
    ends: dict[str, int] = {}
    for case in cases:
        result, seconds = timed(case)
        end = end_of(result)
        ends[end] = ends.get(end, 0) + 1
        other = _from_elsewhere(case, result) if result.converged else ""
        print(f"| {case.name} | {end} | {seconds:.1f} | {other} |", flush=True)
    print(ends, flush=True)


def _from_elsewhere(case: Case, result: fairing.FairResult) -> str:
    """Whether a start with noise of 0.01 D gives the same surface."""
    again = case.fair(noise=0.01, seed=1)
    apart = np.abs(again.vertices - result.vertices).max() / case.base.size
    return "same" if apart < ALIKE else f"{end_of(again)}, {apart:.0e} D off"
