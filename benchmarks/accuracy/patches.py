"""Patches of real meshes: every λ from every start; do they converge, and to the same surface?"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from exact import Scope
from real_meshes import DATA, listed_patches, random_patches
from report import WEIGHTS, Row
from specimens import KINDS, LIMIT, SAME, SMOOTH, Record, sweep


def rows(scope: Scope) -> Iterator[Row]:
    """Shares that fail, per λ, of the 27 listed patches and of random ones; the boundary angles."""
    if not DATA.exists():
        yield Row("real patches", 0, "all", 0.01, np.nan, "no meshes", False, np.nan, "shared/data is missing")
        return
    limit, scope.engine.limit = scope.engine.limit, LIMIT
    sets = (
        ("27 patches", "listed", listed_patches()),
        (f"{scope.patches} random patches", "random", random_patches(scope.patches, scope.seed)),
    )
    for title, name, chosen in sets:
        records = sweep(scope.engine, chosen, WEIGHTS, scope.folder / f"patches_{name}.csv")
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


def _failing(title: str, weights: str, records: list[Record]) -> Row:
    failing = [record for record in records if not record.good]
    refused = sum(bool(record.refused) for record in records)
    differ = sum(record.converged == len(KINDS) and record.spread > SAME for record in records)
    silent = sum(not record.honest for record in records)
    spoilt = [sum(r.folded > 0 for r in records), sum(r.crossing > 0 for r in records)]
    note = (
        f"{len(failing)} of {len(records)} fail: {refused} refused, {differ} differ between starts, {silent} silently; "
        f"folded, crossing: {spoilt}; slowest {max((r.slowest for r in records), default=0.0):.1f} s"
    )
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
    note = "; ".join(parts) + f"; median over boundaries {middle:.2g}°"
    largest = max((record.angle for record in smooth), default=np.nan)
    return Row(f"{title}: boundary angle, °", 0, "all", 1.0, largest, "", True, np.nan, note)
