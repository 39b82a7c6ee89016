"""Pictures: before, fair, and fair with detail; the whole patch and close up."""

from __future__ import annotations

from pathlib import Path

import numpy as np

import cases
from cases import Case
from engine import FloatArray
from picture_sheet import Panel, save_sheet
from stripes import Layer, facing, render

TILE = 330  # pixels
GREY, TINT = (0.86, 0.86, 0.86), (0.93, 0.82, 0.7)
WAYS: tuple[tuple[str, dict[str, float]], ...] = (
    ("fair", {}),
    ("fair, with feather", {"feather": 0.15}),
    ("fair, with detail", {"detail": 1.0}),
    ("with detail and feather", {"detail": 1.0, "feather": 0.15}),
)


def write(folder: Path) -> None:
    """One picture for each case."""
    for case in (cases.sphere(6000, 0.25, 3, along_normal=True), *cases.scans(), *cases.orange_skins()):
        save_sheet(rows(case), folder / f"detail_{case.name.split('-')[0]}.webp")


def rows(case: Case) -> list[list[Panel]]:
    """Two rows of tiles, labelled."""
    shown = [("before", case.vertices)] + [(name, case.fair(**options).vertices) for name, options in WAYS]
    return [
        [(tile(case, points, reach * case.diameter, close=close), name) for name, points in shown]
        for close, reach in ((False, 0.75), (True, 0.3))
    ]


def tile(case: Case, points: FloatArray, reach: float, *, close: bool) -> FloatArray:
    """Shaded; close up it looks at a piece of the outline."""
    rim = case.vertices[case.outline]
    centre = rim[np.argmax(rim @ np.array([1.0, -0.3, 0.2]))] if close else rim.mean(axis=0)
    view = facing(case.facing, centre, reach)
    near = np.linalg.norm(points - centre, axis=1) < 1.6 * reach  # the rest is outside the tile
    shown = [part[near[part].any(axis=1)] for part in (case.outside, case.inside)]
    return render([Layer(points, shown[0], GREY), Layer(points, shown[1], TINT)], view, TILE)
