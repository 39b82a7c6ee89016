"""``continuity="G2"``: the mean curvatures that a surface has to meet at its outline."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from fairing import _arguments, _core
from fairing._mending import Boundary, Surroundings
from fairing._types import FloatArray, IntArray


def with_curvatures(boundary: Boundary, triangles: IntArray, around: Surroundings, given: Any) -> Boundary:
    """The boundary with H at ``fixed``: as given, or fitted to the triangles outside."""
    if given is not None:
        return replace(boundary, curvatures=_arguments.curvatures(given, boundary.fixed))
    raise ValueError("todo")
