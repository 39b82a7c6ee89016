"""Patches of real meshes from several starts: do they converge, and to the same surface?"""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

from engine import Engine, FloatArray, Outcome
from meshing import IntArray
from real_meshes import RealPatch

KINDS = ("given", "flattened", "noisy")
SMOOTH = 20.0  # degrees that the outline's normals turn per edge where the surroundings count as smooth
SAME = 0.005  # of the radius
LIMIT = 30.0  # seconds for one call


@dataclass(frozen=True)
class Record:
    """One patch with one λ: what came of its starts. `spread` is over the radius, angles are degrees.

    turn: largest turn of the prescribed normals per boundary edge; unfitted: share of normals that are averages;
    converged: how many starts; folded, crossing: of these, those with triangles that are turned over or pass through
    others; equation: of the first start; slowest: CPU seconds of one start; claimed: spread of those that converged.
    """

    name: str
    weights: str
    free: int
    loops: int
    turn: float
    unfitted: float
    converged: int
    folded: int
    crossing: int
    slowest: float
    refused: str
    spread: float
    claimed: float
    angle: float
    angle_median: float
    cpu: float
    equation: str

    @property
    def good(self) -> bool:
        """Converged from every start to the same surface."""
        return self.converged == len(KINDS) and self.spread <= SAME

    @property
    def honest(self) -> bool:
        """Whether every start that says that it converged has led to the same surface."""
        return self.claimed <= SAME

    @property
    def smooth(self) -> bool:
        """Whether the surroundings define a tangent plane all along the boundary."""
        return self.turn < SMOOTH and self.unfitted == 0.0


def solve(engine: Engine, patch: RealPatch, weights: str, kind: str) -> Outcome:
    """One start; weights belong to the mesh as it is given."""
    start = moved(kind, patch.vertices, patch.triangles, patch.fixed)
    options: dict[str, Any] = {}
    if weights in ("uniform", "inverse_distance"):
        options["neighbours"] = patch.neighbours
    return engine.fair(
        start, patch.triangles, fixed=patch.fixed, fixed_normals=patch.normals,
        inner_fairness=weights, reference=patch.vertices, **options,
    )  # fmt: skip


def measured(engine: Engine, patch: RealPatch, weights: str) -> Record:
    """All starts of one patch with one λ."""
    outcomes = [solve(engine, patch, weights, kind) for kind in KINDS]
    refusals = [outcome.refused for outcome in outcomes if outcome.refused]
    first = outcomes[0]
    return Record(
        patch.name, weights, patch.free, patch.loops, patch.turn, float(1 - patch.fitted.mean()),
        sum(outcome.converged for outcome in outcomes),
        _claiming(outcomes, "FLIPPED_TRIANGLES"), _claiming(outcomes, "SELF_INTERSECTION"),
        max(outcome.cpu for outcome in outcomes), refusals[0].replace("\n", " ")[:80] if refusals else "",
        np.nan if refusals else _spread(outcomes) / patch.radius,
        _spread([outcome for outcome in outcomes if outcome.converged]) / patch.radius,
        np.nan if refusals else float(first.boundary_angle.max()),
        np.nan if refusals else float(np.median(first.boundary_angle)),
        sum(outcome.cpu for outcome in outcomes), first.equation,
    )  # fmt: skip


def _claiming(outcomes: list[Outcome], code: str) -> int:
    return sum(outcome.converged and code in outcome.codes for outcome in outcomes)


def _spread(outcomes: list[Outcome]) -> float:
    away = [np.linalg.norm(outcome.vertices - outcomes[0].vertices, axis=1).max() for outcome in outcomes]
    return float(max(away, default=0.0))


def sweep(engine: Engine, chosen: Iterable[RealPatch], choices: Sequence[str], path: Path) -> list[Record]:
    """All patches with all these λ; one line each in the CSV file, written as it goes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    records: list[Record] = []
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        for patch in chosen:
            for weights in choices:
                records.append(measured(engine, patch, weights))
                fields = asdict(records[-1])
                if len(records) == 1:
                    writer.writerow(fields)
                writer.writerow(fields.values())
                file.flush()
    return records


def given(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """The mesh itself."""
    return vertices


def flattened(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """Projected on the plane that fits the boundary best."""
    rim = vertices[fixed]
    centre = rim.mean(axis=0)
    normal = np.linalg.svd(rim - centre)[2][2]
    return np.asarray(vertices - ((vertices - centre) @ normal)[:, None] * normal)


def folded(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """Everything on one side of a plane through the centroid reflected to the other."""
    centre = vertices.mean(axis=0)
    normal = np.linalg.svd(vertices - centre, full_matrices=False)[2][0]
    height = (vertices - centre) @ normal
    return np.asarray(vertices - 2 * np.maximum(height, 0)[:, None] * normal)


def noisy(vertices: FloatArray, fixed: IntArray, h: float) -> FloatArray:
    """Gaussian noise of two mean edge lengths."""
    return np.asarray(vertices + 2 * h * np.random.default_rng(5).standard_normal(vertices.shape))


STARTS: dict[str, Callable[[FloatArray, IntArray, float], FloatArray]] = {
    "given": given, "flattened": flattened, "folded": folded, "noisy": noisy,
}  # fmt: skip


def moved(kind: str, vertices: FloatArray, triangles: IntArray, fixed: IntArray) -> FloatArray:
    """The start of this kind, fixed vertices in their places."""
    edges = np.linalg.norm(vertices[triangles] - np.roll(vertices[triangles], 1, axis=1), axis=2)
    result = STARTS[kind](vertices, fixed, float(edges.mean())).copy()
    result[fixed] = vertices[fixed]
    return result
