"""One picture of several patches: as they were and as they came out, from two sides each."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from engine import FloatArray
from picture_sheet import save_pairs
from stripes import Layer, View, facing, render

if TYPE_CHECKING:
    from specimens import Specimen

TILE = 170  # pixels
AROUND, PATCH = (0.9, 0.9, 0.9), (0.5, 0.75, 1.0)


def save(specimens: Sequence[Specimen], path: Path) -> None:
    """Two specimens in each row, four tiles each; nothing is written without specimens."""
    if specimens:
        save_pairs([(_title(specimen), tiles(specimen)) for specimen in specimens], path)


def _title(specimen: Specimen) -> str:
    record = specimen.record
    loops = "" if record.loops == 1 else f", {record.loops} loops"
    ended = "refused" if record.refused else record.states.split(" ")[0].rstrip(",")
    return f"{record.name}, {record.weights}, {record.free} free{loops}, {ended}, {record.angle:.0f}°"


def tiles(specimen: Specimen) -> list[FloatArray]:
    """Before from two sides, after from the same two."""
    patch = specimen.patch
    near = np.linalg.norm(patch.whole - _centre(specimen), axis=1) < 3 * _reach(specimen)
    around = Layer(patch.whole, patch.outside[near[patch.outside].all(axis=1)], AROUND, striped=True)
    return [
        render([around, Layer(vertices, patch.triangles, PATCH, striped=True)], view, TILE)
        for vertices in (patch.vertices, specimen.vertices)
        for view in _views(specimen)
    ]


def _centre(specimen: Specimen) -> FloatArray:
    return np.asarray(specimen.patch.vertices[specimen.patch.fixed].mean(axis=0))


def _reach(specimen: Specimen) -> float:
    return 1.15 * float(np.linalg.norm(specimen.patch.vertices - _centre(specimen), axis=1).max())


def _views(specimen: Specimen) -> list[View]:
    """From the side of the mean prescribed normal, and from across it."""
    mean = specimen.patch.normals.mean(axis=0) + 1e-3
    mean /= np.linalg.norm(mean)
    across = np.cross(mean, [0.3, 0.5, 0.8])
    across /= np.linalg.norm(across)
    centre, reach = _centre(specimen), _reach(specimen)
    return [facing(direction, centre, reach) for direction in (mean + 0.2 * across, across + 0.3 * mean)]
