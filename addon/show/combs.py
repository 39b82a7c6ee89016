"""Curvature combs of the selected edges, drawn over everything."""

from __future__ import annotations

from typing import Any

import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..core.combs import Comb

TOOTH, LINE = (0.30, 0.75, 1.0, 1.0), (1.0, 0.75, 0.2, 1.0)
WIDTHS = (1.0, 2.0)  # pixels, of the teeth and of the line along their tips


def draw(context: Any, combs: tuple[Comb, ...], full: float) -> None:
    """Draw them into the 3D view that is being drawn; full: the curvature of a tooth of full length."""
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    gpu.state.depth_test_set("NONE")
    gpu.state.blend_set("ALPHA")
    for comb in combs:
        tips = comb.tips(full)
        teeth = np.stack([comb.feet, tips], axis=1).reshape(-1, 3)
        for places, colour, width in zip((teeth, tips[comb.pairs.ravel()]), (TOOTH, LINE), WIDTHS, strict=True):
            shader.bind()
            shader.uniform_float("viewportSize", (context.region.width, context.region.height))
            shader.uniform_float("lineWidth", width * context.preferences.system.ui_scale)
            shader.uniform_float("color", colour)
            batch_for_shader(shader, "LINES", {"pos": places.astype(np.float32)}).draw(shader)
    gpu.state.blend_set("NONE")
