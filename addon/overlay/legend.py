"""The legend of the quality overlay: its colours, what they stand for, and the largest value."""

from __future__ import annotations

from typing import Any

import blf
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..arrays.types import Floats
from ..translations import translated
from .data import sense

LOW, MIDDLE, HIGH = (0.10, 0.30, 0.85), (0.96, 0.96, 0.96), (0.85, 0.12, 0.10)  # as in overlay_shader.py
TITLES = {"CURVATURE": "Mean Curvature", "DEVIATION": "Deviation"}
_STEPS = 32
_SIZE = (180.0, 12.0)  # pixels at scale 1
_ABOVE = 44.0  # the lower edge


def colours(shares: Floats) -> Floats:
    """Return the colours (k, 3) for shares (k,) of the full colour's value, -1 … 1."""
    ends = np.where(shares[:, None] < 0.0, LOW, HIGH)
    mixed: Floats = MIDDLE + np.abs(shares)[:, None] * (ends - np.array(MIDDLE))
    return mixed


def texts(mode: str, full: float, largest: float) -> tuple[str, str, str, str]:
    """Return the title with the largest value, and what stands below the left end, the middle and the right end."""
    title = f"{translated(TITLES[mode])}   {translated('largest')} {largest:+.4g}"
    return title, f"{-full:.3g}", "0", f"{full:+.3g}"


def draw(context: Any, mode: str, full: float, largest: float) -> None:
    """Draw it into the middle of the lower edge: redo panel, toolbar and sidebar lie over the sides."""
    scale = context.preferences.system.ui_scale
    width, height = (scale * value for value in _SIZE)
    left, bottom = 0.5 * (context.region.width - width), scale * _ABOVE
    title, *ends = texts(mode, full, largest)
    blf.size(0, 11.0 * scale)
    blf.color(0, 1.0, 1.0, 1.0, 1.0)
    _write(title, left, bottom + 1.5 * height)
    edges = np.linspace(0.0, 1.0, _STEPS + 1)
    xs = np.repeat(left + width * edges, 2)
    places = np.column_stack([xs, np.tile([bottom, bottom + height], _STEPS + 1)]).astype(np.float32)
    rgba = np.column_stack([np.repeat(colours(sense(mode) * (2.0 * edges - 1.0)), 2, axis=0), np.ones(len(places))])
    shader = gpu.shader.from_builtin("SMOOTH_COLOR")
    batch_for_shader(shader, "TRI_STRIP", {"pos": places, "color": rgba.astype(np.float32)}).draw(shader)
    for text, share in zip(ends, (0.0, 0.5, 1.0), strict=True):
        _write(text, left + share * (width - blf.dimensions(0, text)[0]), bottom - 1.1 * height)


def _write(text: str, x: float, y: float) -> None:
    blf.position(0, x, y, 0.0)
    blf.draw(0, text)
