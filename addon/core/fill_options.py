"""The options of Fair Fill, Fair Fillet, Fair Denoise and Fair From Curves, as fair_options.py has them. No bpy."""

from __future__ import annotations

from dataclasses import replace

from .option_items import CURVATURE, HARD_EDGES, TANGENT
from .option_shared import ALLOW_FOLDS, CONTINUITY, PARTS, SHAPE, SURFACE, VERTICES, limits, of_new_mesh
from .option_table import Before, Option, Table, always

HOLES = "Holes"
FILL_EQUATIONS = ("AUTOMATIC", "HARMONIC", "MINIMAL_ENERGY", "SOAP_FILM", "LEAST_VARIATION")

FILL: Table = (
    replace(SHAPE, before=(Before("equation", FILL_EQUATIONS),)),
    CONTINUITY,
    Option(
        "bridge",
        "Bridge",
        "One surface joins all boundary loops of an object: a tube between two, a blend between more",
        False,
        SURFACE,
    ),
    Option(
        "run_on",
        "Continue Hard Edges",
        "Hard edges that end at a hole, marked sharp or by their angle, are joined by fair curves, and edges that were "
        "drawn across it are taken as they are. Otherwise the surface is smooth",
        True,
        SURFACE,
        shown=lambda o: not o.bridge,
        field="hard_edges",
        values=HARD_EDGES,
        before=(Before("hard_edges", HARD_EDGES),),
    ),
    *of_new_mesh(always),
    Option(
        "islands",
        "Join Islands",
        "Loose pieces of faces inside a hole are joined with it by one surface; otherwise the hole is closed over them",
        False,
        HOLES,
        shown=lambda o: not o.bridge,
    ),
    Option(
        "longest",
        "Most Edges",
        "Borders with more edges than that stay open; 0: any number",
        0,
        HOLES,
        bounds=(0, 2**31 - 1),
        slider=(0, 100),
    ),
    Option(
        "longest_length",
        "Longest Border",
        "Borders that are longer than that stay open; 0: any length",
        0.0,
        HOLES,
        bounds=(0.0, 1e9),
        slider=(0.0, 10.0),
        digits=4,
        kind="DISTANCE",
    ),
    ALLOW_FOLDS,
)

FILLET: Table = (
    Option(
        "width",
        "Width",
        "How far the fillet reaches along the surface, in world space, on the larger side of each seam",
        0.1,
        SURFACE,
        bounds=(1e-6, 1e9),
        slider=(0.0, 10.0),
        digits=4,
        kind="DISTANCE",
    ),
    Option(
        "width_2",
        "Width 2",
        "The same on the smaller side; 0: as wide",
        0.0,
        SURFACE,
        bounds=(0.0, 1e9),
        slider=(0.0, 10.0),
        digits=4,
        kind="DISTANCE",
    ),
    Option(
        "profile",
        "Profile",
        "-1 is flat as a chamfer, 0 round, 1 as sharp as the edge was",
        0.0,
        SURFACE,
        bounds=(-1.0, 1.0),
        digits=2,
    ),
    replace(CONTINUITY, items=(TANGENT, CURVATURE), shown=always),
    Option(
        "spacing",
        "Edge Length",
        "Length of the new edges, in world space, with Quads across the seam; 0: a quarter of the least width",
        0.0,
        VERTICES,
        bounds=(0.0, 1e9),
        slider=(0.0, 1.0),
        digits=4,
        kind="DISTANCE",
    ),
    Option(
        "quads",
        "Quads",
        "Quads in rows along the seam that continue the edges outside from side to side. Where the sides have no "
        "pairs, pairs of triangles",
        True,
        VERTICES,
    ),
    Option(
        "width_group",
        "Vertex Group",
        "The widths are multiplied by the weights of this vertex group along the seam",
        "",
        PARTS,
        kind="VERTEX_GROUP",
    ),
    *limits(),
)

DENOISE: Table = (
    Option(
        "size",
        "Size",
        "What is shorter than this goes, what is longer stays, in world space; 0: twelve of the edges around",
        0.0,
        SURFACE,
        bounds=(0.0, 1e9),
        slider=(0.0, 10.0),
        digits=4,
        kind="DISTANCE",
    ),
    Option(
        "amount",
        "Amount",
        "How much of the roughness goes",
        1.0,
        SURFACE,
        bounds=(0.0, 1.0),
        digits=2,
        kind="FACTOR",
    ),
)

CURVES: Table = (
    Option(
        "fill_openings",
        "Fill Openings",
        "What the curves only go around gets a surface, too: a bottle's mouth, the rim of a boat",
        False,
        SURFACE,
    ),
    *(option for option in of_new_mesh(always) if option.name != "subdivide_boundary"),
)
