"""Options that several operators have. Plain Python, no bpy."""

from __future__ import annotations

from functools import partial
from typing import Any

from .items import CONTINUITIES, HARMONIC, SHAPES
from .table import SOLVER, SURFACE, VERTICES, option

SHARE = (0.0, 1.0)
ANY_LENGTH = (0.0, 1e9)
ANY_COUNT = (0, 2**31 - 1)

shape = partial(option, SURFACE, "Shape", "Which surface spans the boundary", "AUTOMATIC", items=SHAPES)
continuity = partial(
    option, SURFACE, "Continuity", "How smoothly the surface joins what is around it", "G1", items=CONTINUITIES
)
factor = partial(option, bounds=SHARE, kind="FACTOR")
length = partial(option, bounds=ANY_LENGTH, digits=4, kind="DISTANCE")
group = partial(option, default="", kind="VERTEX_GROUP")
spacing = partial(
    option,
    VERTICES,
    "Spacing",
    "Length of the new edges, relative to those of the boundary: 0.5 is twice as fine",
    1.0,
    bounds=(0.05, 1e6),
    slider=(0.25, 4.0),
    digits=2,
    step=5,
)
quads = partial(
    option,
    VERTICES,
    "Quads",
    "Quads in rows that continue the boundary's loops, with edges of its length. Where no rows fit, triangles joined "
    "in pairs, within each material and face set",
    False,
)
allow_folds = partial(
    option,
    SOLVER,
    "Allow Folds",
    "Whatever comes out is written. Otherwise the mesh stays as it was where there is no result, or one that folds or "
    "crosses itself",
    False,
)


def is_harmonic(options: Any) -> bool:
    """Return whether the shape can continue curvatures, and bulge."""
    return options.shape in HARMONIC
