"""The options of Fair Fill, Fair Fillet, Fair Denoise and Fair From Curves. Plain Python, no bpy."""

from __future__ import annotations

from dataclasses import dataclass

from . import shared
from .items import CURVATURE, TANGENT
from .table import PARTS, SURFACE, VERTICES, Chosen, option

HOLES = "Holes"


@dataclass(frozen=True)
class FillOptions(Chosen):
    """The options of `mesh.fair_fill`."""

    shape: str = shared.shape(counts=lambda o: o.continuity != "G0")
    continuity: str = shared.continuity(counts=lambda o: o.continuity != "G2" or shared.is_harmonic(o))
    bridge: bool = option(
        SURFACE,
        "Bridge",
        "One surface joins all boundary loops of an object: a tube between two, a blend between more",
        False,
    )
    run_on: bool = option(
        SURFACE,
        "Continue Hard Edges",
        "Hard edges that end at a hole, marked sharp or by their angle, are joined by fair curves, and edges that were "
        "drawn across it are taken as they are. Otherwise the surface is smooth",
        True,
        counts=lambda o: not o.bridge,
    )
    spacing: float = shared.spacing()
    quads: bool = shared.quads()
    longest: int = option(
        HOLES,
        "Max Edges",
        "Borders with more edges than that stay open; 0: any number",
        0,
        bounds=shared.ANY_COUNT,
        slider=(0, 100),
    )
    longest_length: float = shared.length(
        HOLES, "Longest Border", "Borders that are longer than that stay open; 0: any length", 0.0, slider=(0.0, 10.0)
    )
    allow_folds: bool = shared.allow_folds()

    @property
    def equation(self) -> str:
        """The engine's word."""
        return "soap_film" if self.continuity == "G0" else self.shape.lower()

    @property
    def joins_curvature(self) -> bool:
        """Whether the curvature around is continued."""
        return self.continuity == "G2"

    @property
    def runs_on(self) -> bool:
        """Whether edges that end at a hole go on through it."""
        return self.run_on and not self.bridge


@dataclass(frozen=True)
class FilletOptions(Chosen):
    """The options of `mesh.fair_fillet`."""

    width: float = shared.length(
        SURFACE,
        "Width",
        "How far the fillet reaches on the larger side of each seam, in world space; 0: a fifth of the shortest way to "
        "the next edge",
        0.0,
        slider=(0.0, 10.0),
    )
    width_2: float = shared.length(SURFACE, "Width 2", "On the smaller side; 0: same as Width", 0.0, slider=(0.0, 10.0))
    clamp: bool = option(
        SURFACE,
        "Clamp",
        "Narrows the fillet where there is no room, and says where. Otherwise a too large width is refused",
        True,
    )
    profile: float = option(
        SURFACE,
        "Profile",
        "-1 is flat as a chamfer, 0 round, 1 as sharp as the edge was",
        0.0,
        bounds=(-1.0, 1.0),
        digits=2,
    )
    continuity: str = shared.continuity(items=(TANGENT, CURVATURE))
    spacing: float = shared.length(
        VERTICES,
        "Edge Length",
        "Length of new edges (world space), less where the fillet narrows. With Quads: only across the seam; "
        "0: a quarter of Width",
        0.0,
        slider=(0.0, 1.0),
    )
    quads: bool = option(
        VERTICES,
        "Quads",
        "Quads in rows along the seam; edges across it join those outside on both sides. Where none fit, triangles",
        False,
    )
    width_group: str = shared.group(
        PARTS, "Vertex Group", "The widths are multiplied by the weights of this vertex group along the seam"
    )


@dataclass(frozen=True)
class DenoiseOptions(Chosen):
    """The options of `mesh.fair_denoise`."""

    size: float = shared.length(
        SURFACE,
        "Size",
        "Bumps smaller than this go, larger ones stay (world space); 0: twelve edge lengths",
        0.0,
        slider=(0.0, 10.0),
    )
    amount: float = shared.factor(SURFACE, "Amount", "How much of the roughness goes", 1.0, digits=2)


@dataclass(frozen=True)
class CurvesOptions(Chosen):
    """The options of `mesh.fair_from_curves`."""

    fill_openings: bool = option(
        SURFACE,
        "Fill Openings",
        "Closes openings inside a curve, too: a bottle's mouth, the rim of a boat",
        False,
    )
    spacing: float = shared.spacing()
    quads: bool = shared.quads()
