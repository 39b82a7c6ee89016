"""The boundary on the quality overlay, thin, so that it hides no join."""

from __future__ import annotations

from typing import Any

import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..arrays.types import Floats

BOUNDARY = (1.0, 0.5, 0.0, 0.6)
NEARER = 6e-5  # than the overlay itself, which is 2e-5 in front of the mesh


def draw_boundary(context: Any, edges: Floats) -> None:
    """Draw edges (e, 2, 3) in world space as a thin line on the overlay."""
    gpu.state.depth_test_set("LESS_EQUAL")
    projection = gpu.matrix.get_projection_matrix()
    projection[2] = projection[2] - NEARER * projection[3]
    with gpu.matrix.push_pop_projection():
        gpu.matrix.load_projection_matrix(projection)
        _draw(context, edges)
    gpu.state.depth_test_set("NONE")


def _draw(context: Any, edges: Floats) -> None:
    shader = gpu.shader.from_builtin("POLYLINE_UNIFORM_COLOR")
    shader.bind()
    shader.uniform_float("viewportSize", (context.region.width, context.region.height))
    shader.uniform_float("lineWidth", context.preferences.system.ui_scale)
    shader.uniform_float("color", BOUNDARY)
    gpu.state.blend_set("ALPHA")
    batch_for_shader(shader, "LINES", {"pos": edges.reshape(-1, 3).astype(np.float32)}).draw(shader)
    gpu.state.blend_set("NONE")
