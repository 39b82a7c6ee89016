# mypy: disable-error-code="valid-type"
"""The options as Blender properties: names, ranges, and what each does to the shape.

No postponed annotations here: Blender reads them as property definitions.
"""

from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

from .skin_properties import SkinProperties
from .surface_properties import EQUATIONS, SurfaceProperties, continuity_property, equation_property

_OTHERWISE = (
    (
        "LEAST_VARIATION",
        "Least Variation",
        "Where no surface of that shape fits the boundary, Least Variation is used instead",
    ),
    ("STOP", "Stop", "Keeps the best surface of that shape that was found; the report says so"),
)
_INNER_FAIRNESS = (
    ("AUTOMATIC", "Automatic", "Keep Texture where the selection has a UV map, Uniform where it has none"),
    ("UNIFORM", "Uniform", "Edges become equally long. Best topology, but textures slide"),
    (
        "CONFORMAL",
        "Keep Texture",
        "Faces keep their angles as far as they can, so that textures keep their look",
    ),
    ("INVERSE_DISTANCE", "Keep Spacing", "Finely meshed areas stay fine, coarse ones stay coarse"),
    (
        "SHAPE_PRESERVING",
        "Keep Proportions",
        "Each vertex keeps its place among its neighbours. Textures may be distorted more than with Uniform",
    ),
)
_BOUNDARY_NORMALS = (
    (
        "AUTOMATIC",
        "Automatic",
        "Surroundings, but Inside where the boundary is a hard edge: the top of a box stays flat",
    ),
    (
        "SURROUNDING",
        "Surroundings",
        "Continues the faces around the selection, whatever is inside",
    ),
    ("INSIDE", "Inside", "Keeps the slope of the selected faces along the boundary"),
    ("AVERAGE", "Average", "Leans half way between the faces inside and outside: keeps some of the old shape's slope"),
    ("CUSTOM", "Custom Normals", "Follows the shading normals along the boundary, custom split normals included"),
)
_METHODS = (
    ("GLOBAL", "Global", "The fast solver. The old shape inside the selection does not matter"),
    ("PAPER", "Multigrid", "The published iteration, step by step: slow, for comparison"),
)
_OUTLINES = (
    ("GIVEN", "As Selected", "The boundary stays where it is"),
    (
        "MENDED",
        "Smooth",
        "A noisy boundary and two rings of faces around it are smoothed first, by a quarter of an edge at most",
    ),
)
_MESHES = (
    ("KEEP", "Keep", "Vertices stay the same vertices; they move"),
    (
        "NEW",
        "New",
        "Regular triangles take the place of the selected faces. Seams of UVs and colours, borders of materials and "
        "marked edges stay; UVs, colours, weights and shape keys are carried over",
    ),
)
_PIN_EDGES = (
    ("AUTOMATIC", "Automatic", "Hard edges that run through the selection, marked sharp or by their angle"),
    ("NONE", "None", "No edge inside the selection is held"),
    ("SHARP", "Sharp", "The surface passes through edges marked sharp; closed loops of them divide it"),
    ("SEAM", "Seam", "The surface passes through UV seams; closed loops of them divide it"),
    ("CREASE", "Crease", "The surface passes through edges with a crease weight; closed loops of them divide it"),
)
_PIN_CURVES = (
    ("FAIRED", "Faired", "Those that run through between marked edges outside become fair curves, with what is around"),
    ("HELD", "As They Are", "They stay where they are"),
)
_PIN_SLOPES = (
    ("AUTOMATIC", "Automatic", "Crease for edges marked sharp, averaged for others"),
    ("CREASE", "Crease", "Each side finds a slope of its own: two flat sides stay flat up to the edge"),
    ("SMOOTH", "Smooth Through", "The surface runs through the edges with a slope that it finds"),
    ("AVERAGE", "Averaged", "Both sides take the mean slope of the old faces at the edge"),
)
_PIN_PULLS = (
    ("SURFACE", "The Surface", "It passes through all pins as a whole, and bends everywhere for them"),
    ("LOCAL", "Around Them", "Lone pins lift what is within three times Pin Radius; the rest is as without them"),
)
_OPEN_BORDERS = (
    ("HELD", "Held", "Open borders inside the selection stay where they are"),
    ("FAIRED", "Faired", "Open borders become fair curves, with a free slope"),
)


_KEYS = (
    ("ACTIVE", "Active", "The active shape key; where that is the Basis, keys relative to it follow"),
    ("ALL", "All", "With the Basis every shape key that bends the selection, each from its own surroundings"),
)


class FairProperties(SurfaceProperties, SkinProperties):
    """The properties of `mesh.fair_region`; names and defaults are those of options.FairOptions."""

    factor: FloatProperty(
        name="Factor",
        description="How far vertices go: 0 leaves the original shape, 1 is fair, between is a blend of both",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    equation: equation_property(EQUATIONS)
    otherwise: EnumProperty(
        name="Otherwise",
        description="What to do where no surface of that shape fits the boundary",
        items=_OTHERWISE,
        default="LEAST_VARIATION",
    )
    bulge: FloatProperty(
        name="Bulge",
        description="Lifts (above 0) or sinks the middle of each island, measured by the island's size: "
        "1 lifts a flat disc by a quarter of its radius. For the shape Bulge",
        default=0.0,
        soft_min=-1.0,
        soft_max=1.0,
        step=5,
        precision=2,
    )
    inner_fairness: EnumProperty(
        name="Spread Vertices",
        description="How vertices spread over the surface. The surface itself stays the same",
        items=_INNER_FAIRNESS,
        default="AUTOMATIC",
    )
    boundary_normals: EnumProperty(
        name="Tangent To",
        description="The slope with which the surface leaves its boundary",
        items=_BOUNDARY_NORMALS,
        default="AUTOMATIC",
    )
    continuity: continuity_property()
    method: EnumProperty(name="Method", description="How the surface is computed", items=_METHODS, default="GLOBAL")
    levels: IntProperty(
        name="Levels",
        description="Steps from coarse to fine of the method Multigrid; 0: chosen for you",
        default=0,
        min=0,
        max=20,
    )
    tolerance: FloatProperty(
        name="Tolerance",
        description="Done when no vertex moves by more than this part of the patch's size; "
        "smaller is more exact and slower",
        default=1e-6,
        min=1e-14,
        max=1e-2,
        precision=8,
    )
    max_iterations: IntProperty(
        name="Iterations",
        description="Give up after so many steps, and report it",
        default=200,
        min=1,
    )
    pin_group: StringProperty(
        name="Pin Group",
        description="The surface passes through the vertices of this vertex group; closed loops of them divide it",
    )
    pin_edges: EnumProperty(
        name="Pin Edges",
        description="Marked edges that the surface passes through",
        items=_PIN_EDGES,
        default="AUTOMATIC",
    )
    pin_curve: EnumProperty(
        name="Pinned Edges",
        description="Whether hard edges that run through the selection become fair themselves",
        items=_PIN_CURVES,
        default="FAIRED",
    )
    pin_slope: EnumProperty(
        name="At Pinned Edges",
        description="With which slope the surface meets the pinned edges",
        items=_PIN_SLOPES,
        default="AUTOMATIC",
    )
    pin_pull: EnumProperty(
        name="Pins Pull", description="What pinned vertices move", items=_PIN_PULLS, default="SURFACE"
    )
    pin_radius: FloatProperty(
        name="Pin Radius",
        description="Over which part of the patch's size a single pinned vertex lifts or holds the surface; "
        "0: in a point, which leaves a dent",
        default=0.1,
        min=0.0,
        max=1.0,
        soft_max=0.3,
        precision=3,
        subtype="FACTOR",
    )
    keys: EnumProperty(name="Keys", description="Which shape keys are faired", items=_KEYS, default="ACTIVE")
    open_border: EnumProperty(
        name="Open Border",
        description="What becomes of open borders inside the selection",
        items=_OPEN_BORDERS,
        default="HELD",
    )
    outline: EnumProperty(
        name="Boundary",
        description="What is done about a noisy boundary",
        items=_OUTLINES,
        default="GIVEN",
    )
    mesh: EnumProperty(
        name="Mesh",
        description="Whether the selected faces stay or are replaced",
        items=_MESHES,
        default="KEEP",
    )
