# mypy: disable-error-code="valid-type"
"""The options as Blender properties, and the last report as the panel shows it.

No postponed annotations here: Blender reads them as property definitions.
"""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

_EQUATIONS = (
    ("HARMONIC", "Harmonic", "Mean curvature blends smoothly from the outline: the all-round fair"),
    ("CONSTANT", "Bulge", "Like Harmonic, with an even load that lifts or sinks the middle"),
    ("MINIMAL_ENERGY", "Minimal Energy", "Least bending energy: rounder between tight outlines"),
    ("MINIMAL", "Minimal", "Soap film: least area, meets the outline in position only"),
)
_INNER_FAIRNESS = (
    ("UNIFORM", "Uniform", "Vertices spread evenly over the patch"),
    ("CONFORMAL", "Keep Texture", "Faces keep their angles, so that textures keep their look"),
    ("INVERSE_DISTANCE", "Keep Spacing", "Fine and coarse areas stay about as fine and coarse"),
    ("SHAPE_PRESERVING", "Keep Shape", "Faces keep their proportions and never fold over"),
)
_BOUNDARY_NORMALS = (
    ("SURROUNDING", "Surroundings", "Tangent to the surface around the selection"),
    ("AVERAGE", "Average", "Tangent to the average of all faces at the outline"),
    ("CUSTOM", "Custom Normals", "Tangent to the shading normals along the outline"),
)
_METHODS = (
    ("GLOBAL", "Global", "The fast solver, started from scratch: old shape does not matter"),
    ("PAPER", "Multigrid", "The published iteration, step for step"),
)
_PIN_EDGES = (
    ("NONE", "None", "No edge inside the selection is held"),
    ("SHARP", "Sharp", "Vertices on edges marked sharp stay where they are"),
    ("SEAM", "Seam", "Vertices on edges marked as UV seams stay where they are"),
    ("CREASE", "Crease", "Vertices on edges with a crease weight stay where they are"),
)


class FairProperties:
    """The properties of `mesh.fair_region`; names and defaults are those of options.FairOptions."""

    factor: FloatProperty(
        name="Factor",
        description="From the original shape (0) to the fair one (1)",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
    equation: EnumProperty(name="Shape", description="The kind of fair surface", items=_EQUATIONS, default="HARMONIC")
    bulge: FloatProperty(
        name="Bulge",
        description="For the shape Bulge: 1 lifts a flat disc by a quarter of its radius",
        default=0.0,
        soft_min=-2.0,
        soft_max=2.0,
    )
    inner_fairness: EnumProperty(
        name="Inside",
        description="How vertices are spread over the surface",
        items=_INNER_FAIRNESS,
        default="UNIFORM",
    )
    boundary_normals: EnumProperty(
        name="Tangent To",
        description="What the surface continues at its outline",
        items=_BOUNDARY_NORMALS,
        default="SURROUNDING",
    )
    method: EnumProperty(name="Method", description="The solver", items=_METHODS, default="GLOBAL")
    levels: IntProperty(
        name="Levels",
        description="Levels of the solver's hierarchy; 0: chosen by the solver",
        default=0,
        min=0,
        max=20,
    )
    tolerance: FloatProperty(
        name="Tolerance",
        description="Stop when no vertex moves by more than this share of the patch's size",
        default=1e-6,
        min=1e-14,
        max=1e-2,
        precision=8,
    )
    max_iterations: IntProperty(name="Iterations", description="Give up after this many steps", default=200, min=1)
    pin_group: StringProperty(name="Pin Group", description="Vertices of this vertex group stay where they are")
    pin_edges: EnumProperty(
        name="Pin Edges",
        description="Marked edges whose vertices stay where they are",
        items=_PIN_EDGES,
        default="NONE",
    )


class FairReport(bpy.types.PropertyGroup):
    """What the last run did; kept on the window manager, so it is not part of the file's undo."""

    objects: StringProperty()
    free_vertices: IntProperty()
    seconds: FloatProperty()
    residual: FloatProperty()
    boundary_angle: FloatProperty()
    converged: BoolProperty()
    warnings: StringProperty()
