"""A picture: given, and what each filter made of it, whole and close up."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from engine import FloatArray
from picture_sheet import save_sheet
from stripes import Layer, facing, render

TILE = 330  # pixels
GREY = (0.82, 0.82, 0.82)


def upright(points: FloatArray) -> FloatArray:
    """Turn y, which is up in the meshes, into z."""
    return points[:, [0, 2, 1]] * (1.0, -1.0, 1.0)


def write(made: dict[str, FloatArray], triangles: np.ndarray, path: Path) -> None:
    """Draw one column for each of the surfaces."""
    clean = upright(made["clean"])
    low, high = clean.min(axis=0), clean.max(axis=0)
    rows = []
    for raised, share in ((0.0, 0.56), (0.2, 0.16)):
        centre = (low + high) / 2 + (0.0, 0.0, raised) * (high - low)
        view = facing(np.array([0.4, -1.0, 0.25]), centre, share * float((high - low).max()))
        rows.append(
            [(render([Layer(upright(each), triangles, GREY)], view, TILE), name) for name, each in made.items()]
        )
    save_sheet(rows, path)
