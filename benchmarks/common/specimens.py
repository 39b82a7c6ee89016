"""Patches of real meshes from several starts: do they converge, and to the same surface?"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

import fairing
from engine import Engine, FloatArray, Outcome
from interiors import moved
from real_meshes import RealPatch

KINDS = ("given", "flattened", "noisy")
SMOOTH = 20.0  # degrees that the outline's normals turn per edge where the surroundings count as smooth
SAME = 0.005  # of the radius
LIMIT = 30.0  # seconds for one call


@dataclass(frozen=True)
class Record:
    """One patch with one λ: what came of its starts. `spread` is over the radius, angles are degrees.

    turn: largest turn of the prescribed normals per outline edge; unfitted: share of normals that are averages;
    converged, polished: how many starts; folded, crossing: of the converged ones, those with triangles that are
    turned over or pass through others; torn: of these, those with triangles that pass through others and did not
    before; bend: largest |H| inside over that on the outline, of the first start; way, equation: of the first start;
    slowest: CPU seconds of one start; claimed: the spread of those that say that they converged.
    """

    name: str
    weights: str
    free: int
    fixed: int
    loops: int
    turn: float
    unfitted: float
    converged: int
    polished: int
    folded: int
    crossing: int
    way: str
    slowest: float
    refused: str
    states: str
    spread: float
    claimed: float
    angle: float
    angle_median: float
    residual: float
    codes: str
    cpu: float
    equation: str
    torn: int
    bend: float

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
        """Whether the surroundings define a tangent plane all along the outline."""
        return self.turn < SMOOTH and self.unfitted == 0.0

    @property
    def badness(self) -> tuple[bool, float]:
        """Orders by what is worst: no convergence (by the angle), then angles where they should be small."""
        angle = 0.0 if np.isnan(self.angle) else self.angle
        return not self.good, angle if self.smooth or not self.good else 0.0


@dataclass(frozen=True)
class Specimen:
    """A record with its patch and the vertices from the first start (the given ones after a refusal)."""

    record: Record
    patch: RealPatch
    vertices: FloatArray


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


def measured(engine: Engine, patch: RealPatch, weights: str) -> Specimen:
    """All starts of one patch with one λ."""
    outcomes = [solve(engine, patch, weights, kind) for kind in KINDS]
    refusals = [outcome.refused for outcome in outcomes if outcome.refused]
    first = outcomes[0]
    record = Record(
        patch.name, weights, patch.free, len(patch.fixed), patch.loops, patch.turn, float(1 - patch.fitted.mean()),
        sum(outcome.converged for outcome in outcomes), sum(outcome.polished for outcome in outcomes),
        _claiming(outcomes, "FLIPPED_TRIANGLES"), _claiming(outcomes, "SELF_INTERSECTION"),
        " ".join(first.way), max(outcome.cpu for outcome in outcomes),
        refusals[0].replace("\n", " ")[:80] if refusals else "", " ".join(outcome.state for outcome in outcomes),
        np.nan if refusals else _spread(outcomes) / patch.radius,
        _spread([outcome for outcome in outcomes if outcome.converged]) / patch.radius,
        np.nan if refusals else float(first.boundary_angle.max()),
        np.nan if refusals else float(np.median(first.boundary_angle)), first.residual,
        " ".join(sorted({code for outcome in outcomes for code in outcome.codes})),
        sum(outcome.cpu for outcome in outcomes), first.equation,
        sum(outcome.converged and _torn(outcome, patch) for outcome in outcomes),
        np.nan if refusals else _bend(first, patch),
    )  # fmt: skip
    return Specimen(record, patch, patch.vertices if refusals else first.vertices)


def _claiming(outcomes: list[Outcome], code: str) -> int:
    return sum(outcome.converged and code in outcome.codes for outcome in outcomes)


def _torn(outcome: Outcome, patch: RealPatch) -> bool:
    before, after = (fairing.self_intersections(v, patch.triangles) for v in (patch.vertices, outcome.vertices))
    return bool(len(np.setdiff1d(after, before)))


def _bend(outcome: Outcome, patch: RealPatch) -> float:
    bend = np.abs(outcome.mean_curvature)
    inside = np.ones(len(bend), dtype=bool)
    inside[patch.fixed] = False
    return float(bend[inside].max() / bend[patch.fixed].max())


def _spread(outcomes: list[Outcome]) -> float:
    away = [np.linalg.norm(outcome.vertices - outcomes[0].vertices, axis=1).max() for outcome in outcomes]
    return float(max(away, default=0.0))


def sweep(engine: Engine, chosen: Iterable[RealPatch], choices: Sequence[str], path: Path) -> list[Specimen]:
    """All patches with all these λ; one line each in the CSV file, written as it goes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    specimens: list[Specimen] = []
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        for patch in chosen:
            for weights in choices:
                specimens.append(measured(engine, patch, weights))
                fields = asdict(specimens[-1].record)
                if len(specimens) == 1:
                    writer.writerow(fields)
                writer.writerow(fields.values())
                file.flush()
    return specimens


def worst(specimens: list[Specimen], count: int) -> list[Specimen]:
    """The worst of different patches, worst first."""
    chosen: dict[str, Specimen] = {}
    for specimen in sorted(specimens, key=lambda s: s.record.badness, reverse=True):
        chosen.setdefault(specimen.record.name, specimen)
    return list(chosen.values())[:count]
