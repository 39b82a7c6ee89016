"""The options that several operators share, and the groups in which all are shown. Plain Python, no bpy."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .option_items import ACCEPT, CONTINUITIES, EQUATIONS, INNER, SHAPES
from .option_table import Before, Option, Table, always

LEAST_SPACING = 0.05  # of the boundary's edges

SURFACE, VERTICES, TRANSITION = "Surface", "Vertices", "Transition"
GROUPS = (SURFACE, VERTICES, TRANSITION)
PARTS, PINS, NEW_MESH, SOLVER = "Parts and Masks", "Pins and Borders", "New Mesh", "Solver"
FOLDED = (PARTS, PINS, NEW_MESH, SOLVER)  # under Advanced


SHAPE = Option(
    "shape",
    "Shape",
    "Which surface spans the boundary",
    "AUTOMATIC",
    SURFACE,
    items=SHAPES,
    shown=lambda o: o.continuity != "G0",
    field="equation",
    before=(Before("equation", EQUATIONS),),
)
CONTINUITY = Option(
    "continuity",
    "Continuity",
    "How smoothly the surface joins what is around it",
    "G1",
    SURFACE,
    items=CONTINUITIES,
)


def of_new_mesh(shown: Callable[[Any], bool]) -> Table:
    """Return what is asked for new edges."""
    return (
        Option(
            "spacing",
            "Spacing",
            "Length of the new edges away from the boundary, measured by the boundary's edges: 0.5 is twice as fine",
            1.0,
            VERTICES,
            bounds=(LEAST_SPACING, 1e6),
            slider=(0.25, 4.0),
            digits=2,
            step=5,
            shown=shown,
        ),
        Option(
            "quads",
            "Quads",
            "Quads in rows that continue the boundary's loops, with edges as long as its own. Where no pattern fits, "
            "pairs of triangles, none across a border of materials or face sets",
            False,
            VERTICES,
            shown=shown,
        ),
        Option(
            "equal_edges",
            "Equal Edges",
            "All new edges are of one length. Otherwise they are short where the boundary's edges are short, and long "
            "where these are long",
            False,
            NEW_MESH,
            shown=shown,
            field="inner",
            values=INNER,
            before=(Before("inner", INNER),),
        ),
        Option(
            "subdivide_boundary",
            "Subdivide Boundary",
            "Long edges of the boundary are subdivided, to be as long as the new edges; faces beside them become "
            "polygons with more corners",
            False,
            NEW_MESH,
            shown=shown,
        ),
        *limits(shown),
    )


def limits(shown: Callable[[Any], bool] = always) -> Table:
    """Return what holds new vertices back."""
    return (
        Option(
            "max_vertices",
            "Vertex Limit",
            "More new vertices than that are refused; 0: twenty times as many as a flat surface would have, for a new "
            "mesh as the old one would have, for a fillet as by default, and 50,000 at least",
            0,
            NEW_MESH,
            bounds=(0, 2**31 - 1),
            shown=shown,
        ),
        Option(
            "limit_total",
            "Limit Total",
            "The most vertex groups of bones that a new vertex is in: those with the largest weights, with the same "
            "sum. 0: as many as one of the vertices around is in",
            0,
            NEW_MESH,
            bounds=(0, 2**31 - 1),
            slider=(0, 8),
            shown=shown,
        ),
    )


ALLOW_FOLDS = Option(
    "allow_folds",
    "Allow Folds",
    "Whatever comes out is written. Otherwise the mesh stays as it was where there is no result, or one that folds or "
    "crosses itself",
    False,
    SOLVER,
    field="accept",
    values=ACCEPT,
    before=(Before("accept", ACCEPT),),
)
