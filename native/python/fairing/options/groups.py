"""The options of all calls that make surfaces, in groups: each described here, and nowhere else in Python."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, fields, replace
from typing import Any

import numpy.typing as npt

from fairing import _core
from fairing.options import arguments


@dataclass(frozen=True)
class PaperOptions:
    """What Schneider & Kobbelt leave open (§6, §7), and what was added to it. ValueError names what is not accepted."""

    damping: float = 0.9
    """s of §7.5, in (0, 1]."""
    cg_steps: int = 60
    """Conjugate gradient steps of a global H-update (§7.1)."""
    sweeps: int = 1
    """Gauss–Seidel sweeps of a local H-update (§7.1)."""
    vertex_sweeps: int = 2
    """Sweeps over the vertices in each update of the mesh (§7.2: one)."""
    acceleration: str = "anderson"
    """Whether each cycle of updates starts from the best combination of the last sixteen ("anderson"), or where the
    last one ended ("none"), as published."""

    def __post_init__(self) -> None:
        arguments.choice("acceleration", self.acceleration, _core.WORDS["acceleration"])
        for name in ("cg_steps", "sweeps", "vertex_sweeps"):
            arguments.whole(name, getattr(self, name), 1)
        if arguments.positive("damping", self.damping) > 1.0:
            raise ValueError(f"damping: {self.damping} is not accepted; accepted is above 0 and up to 1")


def engine_options(method: str, levels: int, given: PaperOptions | None) -> _core.PaperOptions:
    """What the engine takes, checked; ``given`` is None where the caller leaves it out."""
    if given is not None and not isinstance(given, PaperOptions):
        raise ValueError(f"paper: a fairing.PaperOptions is needed, not {given!r}")
    if given is not None and method != "paper":
        raise ValueError(f"paper: accepted with method 'paper' only, not {method!r}")
    result = _core.PaperOptions()
    for name, value in vars(given or PaperOptions()).items():
        setattr(result, name, value)
    result.levels = arguments.whole("levels", levels, 0, None if method == "paper" else 1)
    return result


_Check = Callable[[str, Any], Any]


def _checked(default: Any, check: _Check) -> Any:
    """A field that is the engine's, too, under the same name; ``check`` returns what it takes."""
    return field(default=default, metadata={"check": check})


def _word(default: str, accepted: tuple[str, ...]) -> Any:
    return _checked(default, lambda name, value: arguments.choice(name, value, accepted))


def _vertices(name: str, value: Any) -> list[int]:
    return [] if value is None else [int(v) for v in arguments.integers(name, value, None)]


@dataclass(frozen=True, eq=False)
class Boundary:
    """What holds the patch, and what is around it. Arrays are taken as they are: they must stay so during the call."""

    vertices: npt.ArrayLike | None = None
    """(k,) int. Vertices that keep their position; default: the vertices on the mesh border, which are always fixed.
    Curves of fixed vertices inside the mesh are cut: the patches on both sides end there. A fixed vertex without fixed
    neighbours is a pin: its position counts, its normal does not."""

    normals: npt.ArrayLike | None = None
    """(k, 3) float. Normals at ``vertices``, any length but zero, on the side from which the triangles are
    counter-clockwise. Default: the average of the adjacent triangle normals (§7.5), which makes the result depend on
    the interior. So do border vertices that are left out of ``vertices``: they stay fixed, and take that average.
    :func:`fairing.surrounding_normals` gives zero where no triangle lies outside; leave these vertices out."""

    curvatures: npt.ArrayLike | None = None
    """(k,) float. Of "G2": mean curvatures H at ``vertices``, in length⁻¹, −1/R on a sphere with outward normals; NaN
    where the curvature is not known. Default: fitted to the triangles outside."""

    outside: npt.ArrayLike | None = None
    """(o, 3) int. Triangles around the patch, which stay; "mended", "G2", ``detail`` and ``join`` read them. Triangles
    whose corners are all ``vertices`` count among them."""

    continuity: npt.ArrayLike | None = None
    """(k,) str. One of "G0" | "G1" | "G2" for each of ``vertices``, where it differs along the boundary: its position
    is met, its tangent plane too, or its curvature as well. An edge has what both of its ends have. "G0" are
    ``creases``: the surface, one of "least_variation", finds its slope there. Not beside "G2" (docs/joins.md)."""


@dataclass(frozen=True)
class Surface:
    """Which surface, and how it joins its boundary."""

    equation: str = _word("harmonic", _core.WORDS["equation"])
    """One of "harmonic" | "constant" | "minimal_energy" | "soap_film" | "least_variation" | "automatic": Δ_B H = 0,
    Δ_B H = ``load`` or Δ_B H = −2H(H² − K) with tangent planes met (G1, §7.5), or H = 0 with positions met only (G0).
    "least_variation": the surface whose normal curvatures vary least (G1; docs/least_variation.md). "automatic", for
    each component by its boundary: "least_variation" between two loops that face each other along a tube of more than
    2 mean radii, where harmonic surfaces have waists; "harmonic" elsewhere, with "G2", and with ``method`` "paper"."""

    otherwise: str = _word("least_variation", _core.WORDS["otherwise"])
    """One of "least_variation" | "stop": What stands in where no surface of ``equation`` is accepted (method "global",
    all but "soap_film"): the surface of least variation; where several boundary loops have none either, the shape of
    ``reference``, smoothed, or a loft, which may leave the tangent planes given (docs/least_variation.md). Reported by
    ``result.equation`` and NO_SOLUTION. "stop": the best surface found, not ``converged``. A solve that ran out of
    fewer than 200 ``max_iterations``, or has part of its load, is never replaced."""

    load: float = _checked(0.0, arguments.finite)
    """float. Of "constant", in length⁻³; positive bulges along the normals."""

    bulge: float = _checked(0.0, arguments.finite)
    """float. Of "constant", by the boundary's own size: adds 8 ``bulge`` / a³ to ``load``, for each component with a
    the RMS distance of its boundary from the boundary's centroid. 1 lifts a flat disc by a quarter of its radius."""

    continuity: str = "G1"
    """One of "G1" | "G2": "G2": the surface continues the curvature of its surroundings, too, and Δ_B² H = 0
    (docs/joins.md). Where that is not known, or no such surface is found, the tangent join is kept, with the warning
    G2_NOT_MET. For ``equation`` "harmonic"."""

    outline: str = "given"
    """One of "given" | "mended": "mended": a noisy boundary is first moved onto the fit of its surroundings, with the
    two rings outside; the normals there are the fit's, and ``moved`` names what moved. Where that gives folds, no
    solution, or a larger visible kink, the given one is kept (warning OUTLINE_KEPT)."""


@dataclass(frozen=True, eq=False)
class Layout:
    """How vertices lie within the surface, which stays the same."""

    inner_fairness: Any = None
    """One of "uniform" | "conformal" | "inverse_distance" | (e, 3) array | None, which is "uniform" for
    :func:`fairing.fair` and "conformal" for calls that make vertices: How vertices sit within the surface (§7.3); rows
    of the array: i, j, λ_ij ≥ 0, the same for j, i. A pair may be listed again: its weights are added."""

    neighbours: npt.ArrayLike | None = None
    """(e, 2) int. Edges that uniform and inverse-distance weights use instead of the triangles' own (for quads and
    n-gons)."""

    reference: npt.ArrayLike | None = None
    """(n, 3) float. The original mesh M0 of all weights but the uniform ones, and the shape that is kept in part where
    no surface is found (``otherwise``); default: ``vertices``."""


@dataclass(frozen=True, eq=False)
class Skin:
    """What stays of the old skin, and how the change fades out (docs/detail.md)."""

    detail: float = _checked(0.0, arguments.share)
    """float. 0 … 1: how much of the detail of ``reference``, what is left of it without a smooth base, is put back on
    the fair surface, turned as the base turns. Vertices then sit conformally to the old base, whatever
    ``inner_fairness`` says. With triangles ``outside`` both bases meet the boundary without its detail. Given normals
    that differ from those of the triangles outside are kept."""

    detail_size: float = _checked(0.0, arguments.share)
    """float. Shape that repeats within less than this counts as detail: a wavelength as a share of D. 0: twelve mean
    edges, .45 D at most."""

    feather: float = 0.0
    """float. Width of a band outside the patch in which the change fades out, as a share of D. The join becomes round:
    the base loses what repeats within less than two widths at the old boundary, and nothing at a width's distance.
    Needs the triangles ``outside``. ``moved`` names the band's vertices; all others keep their bits."""

    weights: npt.ArrayLike | None = None
    """(n,) float. In place of ``feather``: each vertex's share of its move, 0 … 1, inside too. The band is where
    vertices of ``outside`` have a weight."""


@dataclass(frozen=True, eq=False)
class Curves:
    """Creases, curves and borders within the patch (docs/curves.md)."""

    creases: npt.ArrayLike | None = field(default=None, metadata={"check": _vertices})
    """(c,) int. Some of the fixed vertices, those at which a crease ends on the boundary among them: position only,
    whatever ``fixed_normals`` says. Each side of a curve of them finds a slope of its own. A component with such a
    curve is solved as "least_variation", one within a single loop of them as "soap_film"."""

    smooth_curves: npt.ArrayLike | None = field(default=None, metadata={"check": _vertices})
    """(s,) int. Some of the fixed vertices: position only, and curves of them are not cut. The surface, one of
    "least_variation", runs through them with one slope that it finds."""

    open_border: str = _word("held", _core.WORDS["open_border"])
    """One of "held" | "faired": "faired": border vertices that are not in ``fixed``, which must be given, don't stay.
    The border becomes a fair curve on a surface of "least_variation" that ends there with a free slope."""

    pin_radius: float = _checked(0.1, arguments.share)
    """float. Over which length, as a share of D, a pin lifts or holds the surface: the standard deviation of a
    Gaussian. 0, and where no surface is found (PINS_NOT_SPREAD): in a point. For the harmonic equations and "G1"."""


@dataclass(frozen=True, eq=False)
class Solving:
    """How the surface is found, and how exactly."""

    method: str = _word("global", _core.WORDS["method"])
    """One of "global" | "paper": The fast solver, or the factorised multigrid iteration of §7, step for step."""

    levels: int = 0
    """int. 0: from coarse to fine where that is faster; 1: on the mesh alone; of "paper" also more, at most so many."""

    tolerance: float = _checked(1e-6, arguments.positive)
    """float. "global": stop when an iteration moves no vertex by more than ``tolerance`` × D, or the next one would
    move none by more than half of it. "paper": where the changes still to come are that small, by the last ones."""

    max_iterations: int = _checked(200, lambda name, value: arguments.whole(name, value, 1))
    """int. "global": steps of each single iteration on one mesh. A solve consists of several, so a small number may
    take longer; only ``progress`` bounds the time. "paper": updates of the finest mesh."""

    normals: str = _word("fitted", _core.WORDS["normals"])
    """One of "fitted" | "averaged": Vertex normal behind H. "paper" always averages."""

    start: str = _word("outline", ("outline", "given", "kept", "least_variation", "loft", "smoothed"))
    """One of "outline" | "given" | "kept" | "least_variation" | "loft" | "smoothed": "given": the initial surface is
    the vertices given, which lie near the solution (all equations but "soap_film", and "global"); "kept": and stand in
    where they lead to none. "least_variation" (from the vertices given), "loft", "smoothed": begin with that stand-in,
    where another solve has shown that the equation has no surface. Where these fail, and by "outline", the boundary
    alone decides."""

    paper: PaperOptions | None = None
    """PaperOptions. What only "paper" has: damping, sweeps, acceleration, … (see :class:`fairing.PaperOptions`)."""


@dataclass(frozen=True)
class Options:
    """All that a call may be told about its surface, in groups; what is left out has its default."""

    surface: Surface = Surface()
    layout: Layout = Layout()
    skin: Skin = Skin()
    curves: Curves = Curves()
    solving: Solving = Solving()

    @classmethod
    def of(cls, **named: Any) -> Options:
        """Options by the fields' names alone, whatever their groups: ``Options.of(equation="soap_film", detail=1.0)``.

        Raises TypeError for a field that no group has.
        """
        return cls().changed(**named)

    def changed(self, **named: Any) -> Options:
        """The same with some fields changed, by their names alone; TypeError for one that no group has."""
        by_group: dict[str, dict[str, Any]] = {}
        for name, value in named.items():
            if name not in GROUP_OF:
                raise TypeError(f"{name!r} is no option; there are {', '.join(GROUP_OF)}")
            by_group.setdefault(GROUP_OF[name], {})[name] = value
        return replace(self, **{group: replace(getattr(self, group), **some) for group, some in by_group.items()})

    def for_engine(self) -> dict[str, Any]:
        """What the engine takes as it is, checked, by name; ValueError for what it doesn't."""
        of_all = ((group, each) for group in vars(self).values() for each in fields(group))
        return {
            each.name: each.metadata["check"](each.name, getattr(group, each.name))
            for group, each in of_all
            if "check" in each.metadata
        }

    @property
    def chosen(self) -> dict[str, Any]:
        """What differs from the defaults, by the fields' names."""
        given = {name: getattr(getattr(self, group), name) for name, group in GROUP_OF.items()}
        return {name: value for name, value in given.items() if not _is_default(name, value)}


GROUP_OF = {name: group for group, of_one in vars(Options()).items() for name in vars(of_one)}  # of each field
_DEFAULTS = {name: getattr(getattr(Options(), group), name) for name, group in GROUP_OF.items()}


def _is_default(name: str, value: Any) -> bool:
    default = _DEFAULTS[name]
    return value is default or (isinstance(value, (str, int, float)) and value == default)
