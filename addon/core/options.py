"""What the caller can choose, by the names that operator, script and command line share."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import partial
from math import isclose
from typing import Any

from .checked import refuse_negative, refuse_other_kinds
from .fair_options import FAIR
from .option_items import (
    ACCEPT,
    DISTRIBUTIONS,
    EQUATIONS,
    FACTOR_MASKS,
    FAIRED,
    INNER,
    KEYS,
    MESHES,
    METHODS,
    OTHERWISE,
    OUTLINES,
    PINNED,
    PULLS,
    SLOPES,
    SLOPES_AT_PINS,
    identifiers,
)
from .option_shared import LEAST_SPACING
from .option_table import fields_of, options_of, read_named

OF_CURVATURE = ("AUTOMATIC", "HARMONIC")  # equations that can continue the curvature outside
CONTINUITIES = ("G1", "G2")

_CHOICES = {
    "equation": EQUATIONS,
    "otherwise": OTHERWISE,
    "inner_fairness": identifiers(DISTRIBUTIONS),
    "boundary_normals": identifiers(SLOPES),
    "continuity": CONTINUITIES,
    "method": METHODS,
    "pin_edges": identifiers(PINNED),
    "pin_curve": FAIRED,
    "pin_slope": identifiers(SLOPES_AT_PINS),
    "pin_pull": PULLS,
    "open_border": FAIRED,
    "outline": OUTLINES,
    "accept": ACCEPT,
    "mesh": MESHES,
    "inner": INNER,
    "factor_mask": FACTOR_MASKS,
    "keys": KEYS,
}


@dataclass(frozen=True)
class FairOptions:
    """What the options of `mesh.fair_region` (fair_options.py) come to.

    Raises ValueError for a value it does not know, TypeError for one of another kind.
    """

    factor: float = 1.0  # 0 keeps the original, 1 is fair
    equation: str = "AUTOMATIC"  # LEAST_VARIATION for long tubes, HARMONIC for all else; the engine decides
    otherwise: str = "LEAST_VARIATION"  # where the equation has no surface
    bulge: float = 0.0  # for CONSTANT: 1 lifts a flat disc by a quarter of its radius
    inner_fairness: str = "AUTOMATIC"  # CONFORMAL for a patch with a texture, UNIFORM for others
    detail: float = 0.0  # how much of the old patch's detail is put back, 0 … 1
    detail_size: float = 0.0  # what is shorter counts as detail: a part of the patch's size; 0: twelve edges
    feather: float = 0.0  # width of the band outside in which the change fades out: a part of the patch's size
    factor_group: str = ""  # name of a vertex group whose weights scale the way of each vertex, outside too
    factor_mask: str = "IGNORED"  # USED: the sculpt mask scales it
    boundary_normals: str = "AUTOMATIC"  # INSIDE along hard edges of the boundary, SURROUNDING elsewhere
    continuity: str = "G1"  # G2: the curvature of the faces outside is continued, too
    position_group: str = ""  # name of a vertex group, along which the boundary's position alone is kept
    curvature_group: str = ""  # name of a vertex group, along which the curvature outside is continued, too
    tension: float = 1.0  # how far the slopes of the boundary are carried in
    tension_group: str = ""  # name of a vertex group, whose weights are exponents of the tension
    method: str = "GLOBAL"
    levels: int = 0  # 0: chosen by the engine
    tolerance: float = 1e-6  # of the patch's diameter
    max_iterations: int = 200
    pin_group: str = ""  # name of a vertex group, empty for none
    pin_edges: str = "AUTOMATIC"  # SHARP for those that run through the selection, NONE for the others
    pin_curve: str = "FAIRED"  # of SHARP: those that run through become fair themselves; HELD: they stay as they are
    pin_slope: str = "AUTOMATIC"  # of these edges: CREASE for SHARP, AVERAGE for others
    pin_pull: str = "SURFACE"  # LOCAL: lone pins lift what is around them, the rest is as without them
    pin_radius: float = 0.1  # over which part of the patch's size a pinned vertex lifts the surface
    open_border: str = "HELD"  # FAIRED: it becomes fair, too
    outline: str = "GIVEN"  # MENDED: a noisy boundary is smoothed first, with two rings around it
    accept: str = "USABLE"  # ALL: written whatever it is worth
    mesh: str = "KEEP"  # NEW: other vertices and triangles for the same surface
    spacing: float = 1.0  # of a new mesh, as a factor of the boundary's edges
    inner: str = "OUTLINE"  # new edges are in proportion to the boundary's nearby; EVEN: of one length
    subdivide_boundary: bool = False  # long edges of the boundary are parted, to be as long as those of a new mesh
    quads: bool = False  # a new mesh has quads, as far as pairs of triangles make some
    max_vertices: int = 0  # more new ones are refused; 0: twenty times as many as the old surface would have
    keys: str = "ACTIVE"  # ALL: with the Basis every shape key is faired, each from its own surroundings
    limit_total: int = 0  # vertex groups of bones of a new vertex; 0: as many as one vertex of the old mesh has

    def __post_init__(self) -> None:
        for name, choices in _CHOICES.items():
            value = getattr(self, name)
            if value not in choices:
                raise ValueError(f"{name}: expected one of {', '.join(choices)}, got {value!r}")
        refuse_other_kinds(self)
        for name in ("factor", "detail", "detail_size", "pin_radius"):
            if not 0.0 <= getattr(self, name) <= 1.0:
                raise ValueError(f"{name}: expected a number from 0 to 1, got {getattr(self, name)!r}")
        if not 0.0 <= self.feather < float("inf"):
            raise ValueError(f"feather: expected 0 or a positive number, got {self.feather!r}")
        if not 0.0 < self.tension < float("inf"):
            raise ValueError(f"tension: expected a positive number, got {self.tension!r}")
        if not self.spacing >= LEAST_SPACING:
            raise ValueError(f"spacing: expected {LEAST_SPACING} or more, got {self.spacing!r}")
        refuse_negative(self, "max_vertices")
        refuse_negative(self, "limit_total")

    @classmethod
    def named(cls, properties: dict[str, Any]) -> FairOptions:
        """Read options from a caller's keyword arguments; raises TypeError for one that does not exist."""
        return cls(**read_named(FAIR, properties, "fair_mesh"))

    @classmethod
    def of(cls, properties: Any) -> FairOptions:
        """Read every option from an object that has them as attributes."""
        return cls(**fields_of(FAIR, partial(getattr, properties)))

    @property
    def chosen(self) -> dict[str, Any]:
        """The options that come to this, by their names."""
        return options_of(FAIR, vars(self))

    @classmethod
    def parsed(cls, text: str) -> FairOptions:
        """Read what `json.dumps(asdict(options))` wrote; names that another version had are left out.

        Raises TypeError and ValueError for a text that is something else, ValueError for a value it does not know.
        """
        stored = json.loads(text)
        if not isinstance(stored, dict):
            raise TypeError(f"options: expected names with values, got {text!r}")
        return cls(**{name: stored[name] for name in vars(cls()) if name in stored})

    def resolved(self, textured: bool) -> FairOptions:
        """Return the options with what AUTOMATIC stands for; textured: the patch has a UV map."""
        if self.inner_fairness != "AUTOMATIC":
            return self
        return replace(self, inner_fairness="CONFORMAL" if textured else "UNIFORM")

    @property
    def joins_curvature(self) -> bool:
        """Whether the curvature outside counts: only for the harmonic shape of the fast solver."""
        wanted = self.continuity == "G2" or bool(self.curvature_group)
        return wanted and self.equation in OF_CURVATURE and self.method == "GLOBAL"

    @property
    def frees_slopes(self) -> bool:
        """Whether the surface finds its slope along the position group: no equation has it beside given curvatures."""
        may = self.equation != "SOAP_FILM" and self.method == "GLOBAL" and self.outline == "GIVEN"
        return bool(self.position_group) and may and not self.joins_curvature

    @property
    def has_tension(self) -> bool:
        """Whether slopes are carried in further, or less far: only by the harmonic shape of the fast solver."""
        may = self.equation in OF_CURVATURE and self.method == "GLOBAL"
        return self.tension != 1.0 and may and not self.joins_curvature and not self.position_group

    @property
    def slope_at_pinned_edges(self) -> str:
        """What AUTOMATIC stands for; the published method knows averages alone."""
        if self.method != "GLOBAL":
            return "AVERAGE"
        if self.pin_slope != "AUTOMATIC":
            return self.pin_slope
        return "CREASE" if self.pins_sharp else "AVERAGE"

    @property
    def fairs_pinned_edges(self) -> bool:
        """Whether pinned edges move."""
        return self.pins_sharp and self.pin_curve == "FAIRED" and self.method == "GLOBAL"

    @property
    def pins_sharp(self) -> bool:
        """Whether edges marked sharp are held, all or some."""
        return self.pin_edges == "SHARP" or self.pins_running_through

    @property
    def pins_running_through(self) -> bool:
        """Whether those are held that run through the selection."""
        may = self.method == "GLOBAL" and self.outline == "GIVEN"
        return self.pin_edges == "AUTOMATIC" and may

    @property
    def finds_edges(self) -> bool:
        """Whether edges that nobody has marked count among these: a surface along edges has no load, nor given H."""
        return self.pins_running_through and self.equation not in ("CONSTANT", "SOAP_FILM") and not self.joins_curvature

    @property
    def pulls_locally(self) -> bool:
        """Whether lone pins lift the surface around them only."""
        may = bool(self.pin_group) and self.pin_radius > 0.0 and self.mesh == "KEEP" and not self.moves_band
        return self.pin_pull == "LOCAL" and may

    @property
    def fairs_border(self) -> bool:
        """Whether open borders move."""
        return self.open_border == "FAIRED" and self.method == "GLOBAL"

    @property
    def reads_surroundings(self) -> bool:
        """Whether the engine looks at the faces outside itself: what a repeated solve does not."""
        return self.outline == "MENDED" or self.takes_base

    @property
    def takes_base(self) -> bool:
        """Whether the old shape is split into base and detail, which belong to its triangles."""
        return self.detail > 0.0 or self.moves_band

    @property
    def keeps_triangles(self) -> bool:
        """Whether quads stay cut as the old shape has them, to which conformal weights and detail belong."""
        return self.inner_fairness == "CONFORMAL" or self.takes_base

    @property
    def goes_by_weight(self) -> bool:
        """Whether each vertex has a factor of its own."""
        return bool(self.factor_group) or self.factor_mask == "USED"

    @property
    def moves_band(self) -> bool:
        """Whether vertices outside the selection take part."""
        return self.feather > 0.0 or self.goes_by_weight

    @property
    def idle(self) -> tuple[str, ...]:
        """The names of options that are set, but that nothing looks at beside the others."""
        only = {
            "bulge": self.equation == "CONSTANT",
            "continuity": self.equation in OF_CURVATURE and self.method == "GLOBAL",
            "boundary_normals": self.equation != "SOAP_FILM",
            "position_group": self.frees_slopes,
            "curvature_group": self.joins_curvature and self.continuity == "G1",
            "tension_group": self.has_tension,
            "levels": self.method == "PAPER",
            "spacing": self.mesh == "NEW",
            "inner": self.mesh == "NEW",
            "subdivide_boundary": self.mesh == "NEW",
            "quads": self.mesh == "NEW",
            "max_vertices": self.mesh == "NEW",
            "limit_total": self.mesh == "NEW",
            "detail_size": self.detail > 0.0,
            "pin_curve": self.pins_sharp and self.method == "GLOBAL",
            "pin_radius": bool(self.pin_group),
            "pin_slope": self.pin_edges != "NONE",
            "otherwise": self.method == "GLOBAL" and self.equation not in ("SOAP_FILM", "LEAST_VARIATION"),
            "open_border": self.mesh == "KEEP",
            "pin_pull": self.pulls_locally,
            "keys": self.mesh == "KEEP",  # a new mesh fairs them all
        }
        return tuple(name for name, read in only.items() if not read and self._is_set(name))

    def _is_set(self, name: str) -> bool:
        """Return whether an option is not its default; Blender's numbers have single precision."""
        value, default = getattr(self, name), getattr(FairOptions(), name)
        return not isclose(value, default, rel_tol=1e-6) if isinstance(default, float) else value != default

    def engine_arguments(self) -> dict[str, Any]:
        """Return the keyword arguments of `fairing.fair` that need no mesh; the options must be resolved."""
        return {
            "equation": self.equation.lower(),
            "otherwise": self.otherwise.lower(),
            "bulge": self.bulge if self.equation == "CONSTANT" else 0.0,
            "inner_fairness": self.inner_fairness.lower(),
            "detail": self.detail,
            "detail_size": self.detail_size,
            "method": self.method.lower(),
            "levels": self.levels,
            "tolerance": self.tolerance,
            "max_iterations": self.max_iterations,
            "pin_radius": self.pin_radius,
            "continuity": "G2" if self.joins_curvature else "G1",
        }
