"""What the options of *Fair Region* mean together."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from .fair_options import FairTable


@dataclass(frozen=True)
class FairOptions(FairTable):
    """The options of `mesh.fair_region`: those of the table, and what follows from them."""

    def resolved(self, textured: bool) -> FairOptions:
        """Return the options with what AUTOMATIC stands for; textured: the patch has a UV map."""
        if self.inner_fairness != "AUTOMATIC":
            return self
        return replace(self, inner_fairness="CONFORMAL" if textured else "UNIFORM")

    @property
    def is_film(self) -> bool:
        """Whether positions alone are met, all along the boundary."""
        return self.continuity == "G0" and not self.continuity_group

    @property
    def equation(self) -> str:
        """The engine's word; it decides what "automatic" is."""
        if self.is_film:
            return "soap_film"
        return "constant" if self.bulge != 0.0 else self.shape.lower()

    @property
    def joins_curvature(self) -> bool:
        """Whether the curvature outside is continued."""
        return self.continuity == "G2"

    @property
    def frees_slopes(self) -> bool:
        """Whether the surface finds its slope along a part of the boundary."""
        return self.continuity == "G0" and bool(self.continuity_group)

    @property
    def slope_at_pinned_edges(self) -> str:
        """What AUTOMATIC stands for."""
        if self.pin_slope != "AUTOMATIC":
            return self.pin_slope
        return "CREASE" if self.pins_sharp else "AVERAGE"

    @property
    def fairs_pinned_edges(self) -> bool:
        """Whether pinned edges move."""
        return self.pins_sharp and self.fair_pinned_edges

    @property
    def pins_sharp(self) -> bool:
        """Whether edges marked sharp are held, all or some."""
        return self.pin_edges == "SHARP" or self.pins_running_through

    @property
    def pins_running_through(self) -> bool:
        """Whether those are held that run through the selection."""
        return self.pin_edges == "AUTOMATIC" and not self.smooth_boundary

    @property
    def finds_edges(self) -> bool:
        """Whether edges that nobody has marked count among these: a surface along edges has no load, nor given H."""
        surface_along_edges = self.equation not in ("constant", "soap_film") and not self.joins_curvature
        return self.pins_running_through and surface_along_edges

    @property
    def pulls_locally(self) -> bool:
        """Whether lone pins lift the surface around them only; a new mesh passes through them as a whole."""
        return bool(self.pin_group) and self.pin_radius > 0.0 and not self.remesh

    @property
    def reads_surroundings(self) -> bool:
        """Whether the engine looks at the faces outside itself: what a repeated solve does not."""
        return self.smooth_boundary or self.takes_base

    @property
    def takes_base(self) -> bool:
        """Whether the old shape is split into base and detail, which belong to its triangles."""
        return self.detail > 0.0 or self.moves_band

    @property
    def keeps_triangles(self) -> bool:
        """Whether quads stay cut as the old shape has them, to which conformal weights and detail belong."""
        return self.inner_fairness == "CONFORMAL" or self.takes_base or self.remesh

    @property
    def goes_by_weight(self) -> bool:
        """Whether each vertex has a factor of its own."""
        return bool(self.vertex_group) or self.use_mask

    @property
    def moves_band(self) -> bool:
        """Whether vertices outside the selection take part."""
        return self.falloff > 0.0 or self.goes_by_weight

    @property
    def can_fade(self) -> bool:
        """Whether there is a band that could move: a new mesh and a curvature that is met hold the boundary."""
        return not self.remesh and not self.joins_curvature

    def engine_arguments(self) -> dict[str, Any]:
        """Return the keyword arguments of `fairing.fair` that need no mesh; the options must be resolved."""
        return {
            "equation": self.equation,
            "otherwise": "least_variation" if self.fallback else "stop",
            "bulge": self.bulge,
            # New vertices take values from where they were.
            "inner_fairness": "conformal" if self.remesh else self.inner_fairness.lower(),
            "detail": self.detail,
            "pin_radius": self.pin_radius,
            "continuity": "G2" if self.joins_curvature else "G1",
        }
