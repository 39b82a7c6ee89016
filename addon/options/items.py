"""The values that choices have, with their labels and tooltips."""

from __future__ import annotations

from .table import Item

HARMONIC = ("AUTOMATIC", "HARMONIC")  # shapes that can continue the curvature outside
SHAPES: tuple[Item, ...] = (
    (
        "AUTOMATIC",
        "Automatic",
        "Harmonic; between two boundary loops the first of the three that neither narrows nor swells",
    ),
    ("HARMONIC", "Harmonic", "Curvature changes evenly. Restores spheres and pipes"),
    ("MINIMAL_ENERGY", "Minimal Energy", "Bends as little as possible: rounder near tight boundaries"),
    (
        "LEAST_VARIATION",
        "Least Variation",
        "Curvature changes as little as it can. For tubes, elbows and limbs that Harmonic inflates. Slower",
    ),
)
TANGENT: Item = ("G1", "Tangent", "The surface leaves its boundary with the slope of the faces around it")
CURVATURE: Item = (
    "G2",
    "Curvature",
    "The surface takes up the curvature of the faces around it, too, and reflection lines don't break. "
    "For the shape Harmonic",
)
CONTINUITIES: tuple[Item, ...] = (
    ("G0", "Position", "A soap film: least area, flat over a flat boundary, with a crease along it"),
    TANGENT,
    CURVATURE,
)
DISTRIBUTIONS: tuple[Item, ...] = (
    ("AUTOMATIC", "Automatic", "Keep Texture where the selection has a UV map, Uniform where it has none"),
    ("UNIFORM", "Uniform", "Edges become equally long. Best topology, but textures slide"),
    ("CONFORMAL", "Keep Texture", "Faces keep their angles as far as they can, so that textures keep their look"),
    ("INVERSE_DISTANCE", "Keep Spacing", "Finely meshed areas stay fine, coarse ones stay coarse"),
)
SLOPES: tuple[Item, ...] = (
    (
        "AUTOMATIC",
        "Automatic",
        "Surroundings, but Inside where the boundary is a hard edge: the top of a box stays flat",
    ),
    ("SURROUNDING", "Surroundings", "Continues the faces around the selection, whatever is inside"),
    ("INSIDE", "Inside", "Keeps the slope of the selected faces along the boundary"),
    ("AVERAGE", "Average", "Leans half way between the faces inside and outside: keeps some of the old shape's slope"),
    ("CUSTOM", "Custom Normals", "Follows the shading normals along the boundary, custom split normals included"),
)
PINNED: tuple[Item, ...] = (
    ("AUTOMATIC", "Automatic", "Hard edges that run through the selection, marked sharp or by their angle"),
    ("NONE", "None", "No edge inside the selection is held"),
    ("SHARP", "Sharp", "The surface passes through edges marked sharp; closed loops of them divide it"),
    ("SEAM", "Seam", "The surface passes through UV seams; closed loops of them divide it"),
    ("CREASE", "Crease", "The surface passes through edges with a crease weight; closed loops of them divide it"),
)
SLOPES_AT_PINS: tuple[Item, ...] = (
    ("AUTOMATIC", "Automatic", "Crease for edges marked sharp, averaged for others"),
    ("CREASE", "Crease", "Each side finds a slope of its own: two flat sides stay flat up to the edge"),
    ("SMOOTH", "Smooth Through", "The surface runs through the edges with a slope that it finds"),
    ("AVERAGE", "Averaged", "Both sides take the mean slope of the old faces at the edge"),
)
