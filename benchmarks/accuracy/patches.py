"""Patches of real meshes: every λ from every start; do they converge, and to the same surface?"""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np

import contact_sheet
from engine import Engine, FloatArray, Outcome
from exact import Scope
from real_meshes import DATA, RealPatch, listed_patches, random_patches
from report import WEIGHTS, Row
from starts import moved

KINDS = ("given", "flattened", "noisy")
SMOOTH = 20.0  # degrees that the outline's normals turn per edge where the surroundings count as smooth
SAME = 0.005  # of the radius
LIMIT = 30.0  # seconds for one call


@dataclass(frozen=True)
class Record:
    """One patch with one λ: what came of its starts. `spread` is over the radius, angles are degrees.

    turn: largest turn of the prescribed normals per outline edge; unfitted: share of normals that are averages;
    converged, polished: how many starts.
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
    refused: str
    states: str
    spread: float
    angle: float
    angle_median: float
    residual: float
    codes: str
    cpu: float

    @property
    def good(self) -> bool:
        """Converged from every start to the same surface."""
        return self.converged == len(KINDS) and self.spread <= SAME

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
        refusals[0].replace("\n", " ")[:80] if refusals else "", " ".join(outcome.state for outcome in outcomes),
        np.nan if refusals else _spread(outcomes) / patch.radius,
        np.nan if refusals else float(first.boundary_angle.max()),
        np.nan if refusals else float(np.median(first.boundary_angle)), first.residual,
        " ".join(sorted({code for outcome in outcomes for code in outcome.codes})),
        sum(outcome.cpu for outcome in outcomes),
    )  # fmt: skip
    return Specimen(record, patch, patch.vertices if refusals else first.vertices)


def _spread(outcomes: list[Outcome]) -> float:
    away = [np.linalg.norm(outcome.vertices - outcomes[0].vertices, axis=1).max() for outcome in outcomes]
    return float(max(away))


def sweep(engine: Engine, chosen: Iterable[RealPatch], path: Path) -> list[Specimen]:
    """All patches with all λ; one line each in the CSV file, written as it goes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    specimens: list[Specimen] = []
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        for patch in chosen:
            for weights in WEIGHTS:
                specimens.append(measured(engine, patch, weights))
                fields = asdict(specimens[-1].record)
                if len(specimens) == 1:
                    writer.writerow(fields)
                writer.writerow(fields.values())
                file.flush()
    return specimens


def rows(scope: Scope) -> Iterator[Row]:
    """Shares that fail, per λ, of the 27 listed patches and of random ones; the boundary angles."""
    if not DATA.exists():
        yield Row("real patches", 0, "all", 0.01, np.nan, "no meshes", False, np.nan, "shared/data is missing")
        return
    limit, scope.engine.limit = scope.engine.limit, LIMIT
    everything: list[Specimen] = []
    sets = (
        ("27 patches", "listed", listed_patches()),
        (f"{scope.patches} random patches", "random", random_patches(scope.patches)),
    )
    for title, name, chosen in sets:
        specimens = sweep(scope.engine, chosen, scope.folder / f"patches_{name}.csv")
        everything += specimens
        records = [specimen.record for specimen in specimens]
        for weights in WEIGHTS:
            yield _failing(title, weights, [r for r in records if r.weights == weights])
        for kind, part in (
            ("disks", [r for r in records if r.loops == 1]),
            ("several loops", [r for r in records if r.loops > 1]),
        ):
            if part:
                yield _failing(f"{title}, {kind}", "all", part)
        yield _angles(title, records)
    scope.engine.limit = limit
    contact_sheet.save(worst(everything, 10), scope.folder / "accuracy_worst_patches.png")


def _failing(title: str, weights: str, records: list[Record]) -> Row:
    failing = [record for record in records if not record.good]
    refused = sum(bool(record.refused) for record in records)
    differ = sum(record.converged == len(KINDS) and record.spread > SAME for record in records)
    note = f"{len(failing)} of {len(records)} fail: {refused} refused, {differ} differ between starts"
    share = len(failing) / max(len(records), 1)
    cpu = sum(record.cpu for record in records)
    return Row(f"{title}: share failing", 0, weights, 0.01, share, "", True, cpu, note)


def _angles(title: str, records: list[Record]) -> Row:
    """The largest angle where normals turn by less than `SMOOTH`; how many are within 1° by the turn."""
    smooth = [record for record in records if record.smooth and record.good]
    parts = []
    for low, high in ((0, 5), (5, 10), (10, SMOOTH)):
        angles = [record.angle for record in smooth if low <= record.turn < high]
        parts.append(f"{low}–{high:g}°/edge: {sum(a <= 1 for a in angles)} of {len(angles)} within 1°")
    middle = np.median([record.angle_median for record in smooth] or [np.nan])
    note = "; ".join(parts) + f"; median over outlines {middle:.2g}°"
    largest = max((record.angle for record in smooth), default=np.nan)
    return Row(f"{title}: boundary angle, °", 0, "all", 1.0, largest, "", True, np.nan, note)


def worst(specimens: list[Specimen], count: int) -> list[Specimen]:
    """The worst of different patches, worst first."""
    chosen: dict[str, Specimen] = {}
    for specimen in sorted(specimens, key=lambda s: s.record.badness, reverse=True):
        chosen.setdefault(specimen.record.name, specimen)
    return list(chosen.values())[:count]
