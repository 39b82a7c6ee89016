"""The main call."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing import _arguments, _core, _feather, _joining, _mending, _options, _paper
from fairing._paper import PaperOptions
from fairing._types import FairResult, FloatArray

Progress = Callable[[float, str], "bool | None"]
Preview = Callable[[FloatArray], object]


def fair(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    *,
    fixed: npt.ArrayLike | None = None,
    fixed_normals: npt.ArrayLike | None = None,
    reference: npt.ArrayLike | None = None,
    equation: str = "harmonic",
    otherwise: str = "least_variation",
    load: float = 0.0,
    bulge: float = 0.0,
    inner_fairness: Any = "uniform",
    neighbours: npt.ArrayLike | None = None,
    method: str = "global",
    levels: int = 0,
    tolerance: float = 1e-6,
    max_iterations: int = 200,
    normals: str = "fitted",
    threads: int = 0,
    progress: Progress | None = None,
    paper: PaperOptions | None = None,
    outline: str = "given",
    outside: npt.ArrayLike | None = None,
    detail: float = 0.0,
    detail_size: float = 0.0,
    continuity: str = "G1",
    fixed_curvatures: npt.ArrayLike | None = None,
    start: str = "outline",
    feather: float = 0.0,
    weights: npt.ArrayLike | None = None,
    creases: npt.ArrayLike | None = None,
    smooth_curves: npt.ArrayLike | None = None,
    open_border: str = "held",
    pin_radius: float = 0.1,
    detail_from: npt.ArrayLike | None = None,
    preview: Preview | None = None,
) -> FairResult:
    """Replace the free vertices of a mesh by the fairest surface with the given boundary data.

    Solves Δ_B H = 0 (Schneider & Kobbelt 2001, eq. 4) for the positions of all vertices that are not fixed,
    with prescribed positions and normals at the fixed ones. The interior given does not matter, except for
    conformal weights without ``reference`` and for default normals. No argument is ever changed. Large arrays are not
    copied: they must stay as they are during the call.

    Parameters
    ----------
    vertices : (n, 3) float
        Positions, any unit.
    triangles : (m, 3) int
        Vertex indices, consistently wound.
    fixed : (k,) int
        Vertices that keep their position; default: the vertices on the mesh border, which are always fixed.
        Curves of fixed vertices inside the mesh are cut: the patches on both sides end there. A fixed vertex
        without fixed neighbours is a pin: its position counts, its normal does not.
    fixed_normals : (k, 3) float
        Normals at ``fixed``, any length but zero, on the side from which the triangles are counter-clockwise.
        Default: the average of the adjacent triangle normals (§7.5), which makes the result depend on the interior.
        So do border vertices that are left out of ``fixed``: they stay fixed, and take that average.
        :func:`fairing.surrounding_normals` gives zero where no triangle lies outside; leave these vertices out.
    reference : (n, 3) float
        The original mesh M0 of all weights but the uniform ones, and the shape that is kept in part where no surface is
        found (``otherwise``); default: ``vertices``.
    equation : "harmonic" | "constant" | "minimal_energy" | "minimal" | "least_variation" | "automatic"
        Δ_B H = 0, Δ_B H = ``load`` or Δ_B H = −2H(H² − K) with tangent planes met (G1), or H = 0 with positions
        met only (G0). See §7.5. "least_variation": the surface whose normal curvatures vary least (G1), which exists
        between boundary loops that no harmonic surface joins; docs/least_variation.md. "automatic", decided for each
        component by its boundary alone: "least_variation" between two loops that face each other along a tube of more
        than 2 mean radii, where harmonic surfaces have waists and balloons; "harmonic" elsewhere, with "G2", and with
        ``method`` "paper".
    otherwise : "least_variation" | "stop"
        What stands in where no surface of ``equation`` is accepted (method "global", all but "minimal"); one that is
        accepted is always returned. The default is the surface of least variation. Where several boundary loops have
        none either, the shape of ``reference`` is smoothed as far as it goes, or a loft joins them where no such shape
        is known; it may leave the tangent planes given (docs/least_variation.md). At last the surface of ``preview`` is
        kept. ``result.equation`` and the warning NO_SOLUTION report the stand-in. "stop": the best surface found, not
        ``converged``. A solve that ran out of fewer than 200 ``max_iterations``, or has part of its load, is
        never replaced.
    load : float
        Of "constant", in length⁻³; positive bulges along the normals.
    bulge : float
        Of "constant", by the boundary's own size: adds 8 ``bulge`` / a³ to ``load``, for each component (see
        :func:`fairing.components`) with a the RMS distance of its boundary from the boundary's centroid. 1 lifts a flat
        disc by about a quarter of its radius, whatever its size.
    inner_fairness : "uniform" | "conformal" | "inverse_distance" | "shape_preserving" | (e, 3) array
        How vertices sit within the surface (§7.3); rows of the array: i, j, λ_ij ≥ 0, normalised for each i, one
        at least for each free i.
    neighbours : (e, 2) int
        Edges that uniform and inverse-distance weights use instead of the triangles' own (for quads and n-gons).
    method : "global" | "paper"
        The fast solver, or the factorised multigrid iteration of §7, step for step.
    levels : int
        "paper": levels of the hierarchy, 0: chosen, 1: none. "global": 0 or 1 likewise.
    tolerance : float
        "global": stop when an iteration moves no vertex by more than ``tolerance`` × D, or when the next one would
        move none by more than half of it, judged by how the steps shrink. "paper": see ``epsilon`` of
        :class:`fairing.PaperOptions`.
    max_iterations : int
        "global": steps of each single iteration on one mesh. A solve consists of several: coarser levels, other
        initial surfaces, and the engine's own mesh where the one given fails. A small number may therefore take longer;
        only ``progress`` bounds the time. "paper": updates of the finest mesh; coarser ones may take more.
    normals : "fitted" | "averaged"
        Vertex normal behind H. "paper" always averages.
    threads : int
        0: one for each core, eight at most. The result has the same bits for every number of threads.
    progress : callable(fraction, stage) -> None | bool
        Called every 50 ms or so, by the calling thread, with the part done (0 … 1, never less than before) and what
        is being done. None or True goes on, False cancels; exceptions come out of the call.
    paper : PaperOptions
        What only "paper" has: damping, sweeps, acceleration, … (see :class:`fairing.PaperOptions`).
    outline : "given" | "mended"
        "mended": a noisy boundary is first moved onto the fit of its surroundings, with the two rings outside, as by
        :func:`fairing.mend_outline`; the normals there are the fit's. ``moved`` names what moved. Where the fitted
        boundary gives folds, no solution, or a worst ``join`` above 12° that is larger than with the given one, both
        are solved and the given one is kept (warning OUTLINE_KEPT).
    continuity : "G1" | "G2"
        "G2": the surface continues the curvature of its surroundings, too, and Δ_B² H = 0 (docs/joins.md). Where that
        is not known, or no such surface is found, the tangent join is kept, with the warning G2_NOT_MET. For
        ``equation`` "harmonic".
    fixed_curvatures : (k,) float
        Of "G2": mean curvatures H at ``fixed``, in length⁻¹, −1/R on a sphere with outward normals; NaN where the
        curvature is not known. Default: fitted to the triangles outside.
    outside : (o, 3) int
        Triangles around the patch, which stay; "mended", "G2", ``detail`` and ``join`` read them. Triangles whose
        corners are all ``fixed`` count among them.
    detail : float
        0 … 1: how much of the detail of ``reference`` is put back on the fair surface. The old patch is split into a
        smooth base and what is left, its detail, which the new surface takes over, turned as the base turns. Vertices
        then sit conformally to the old base, whatever ``inner_fairness`` says. With triangles ``outside`` both bases
        meet the boundary that these would have without their detail, so that ``result.base`` does not pass through
        noise. Given normals that differ from those of the triangles outside are kept. docs/detail.md.
    detail_size : float
        Shape that repeats within less than this counts as detail: a wavelength as a share of D. 0: twelve mean edges,
        .45 D at most.
    detail_from : (s, 3) int
        Triangles of ``vertices``, a sample: their detail replaces that of an old patch that has none, like a filled
        hole. Heights are copied from it piece by piece, and meet the boundary's own detail.
        ``detail_size`` 0 is then twelve mean edges of the sample. Needs ``detail`` above 0; not with ``feather`` or
        ``weights``. Triangles of the patch itself don't count. Vertices lie as ``inner_fairness`` says.
    feather : float
        Width of a band outside the patch in which the change fades out, as a share of D. The join becomes round: the
        base loses all that repeats within less than two widths (D/2 at most) at the old boundary, less on both sides of
        it, and nothing at a width's distance. Detail that ``detail`` leaves out fades in likewise. Needs the triangles
        ``outside``. ``moved`` names the band's vertices; all others keep their bits. docs/detail.md.
    weights : (n,) float
        In place of ``feather``: each vertex's share of its move, 0 … 1, inside too. The band is where
        vertices of ``outside`` have a weight.
    start : "outline" | "given" | "least_variation" | "loft" | "smoothed"
        "given": the initial surface is the vertices given, which lie near the solution. Where a few steps do not lead
        there without folds, the boundary alone decides as always. For all equations but "minimal", and "global".
        Vertices move along the normals only where conformal weights are those of these same vertices.
        "least_variation" (from the vertices given), "loft", "smoothed": begin with that stand-in, where another solve
        has shown that the equation has no surface. Where it is not accepted the boundary alone decides.
    creases : (c,) int
        Some of the fixed vertices, those at which a crease ends on the boundary among them: position only, whatever
        ``fixed_normals`` says there. Each side of a curve of them finds a slope of its own. A component with such a
        curve is solved as "least_variation", one that is bounded by a single loop of them as "minimal", as
        ``result.equation`` reports. docs/curves.md.
    smooth_curves : (s,) int
        Some of the fixed vertices: position only, and curves of them are not cut. The surface, one of
        "least_variation", runs through them with one slope that it finds.
    open_border : "held" | "faired"
        "faired": border vertices that are not in ``fixed``, which must be given, don't stay. The border becomes a fair
        curve on a surface of "least_variation" that ends there with a free slope.
    preview : callable(vertices) -> None
        Called once, by the calling thread, before the search begins: with the (n, 3) vertices of a first surface, which
        always exists and is finite. Of bi-Laplacian fills of the boundary, by the connectivity and by ``reference``, it
        is the one with the least bending energy, after two steps of its descent. Without ``detail``, and between the
        boundary that is given. Exceptions come out of the call.
    pin_radius : float
        Over which length, as a share of D, a pin lifts or holds the surface: the standard deviation of a Gaussian. 0:
        in a point, which leaves a dent that sharpens with the mesh. For the harmonic equations and "G1". Where no
        surface is found with the radius, the pins act in a point, with the warning PINS_NOT_SPREAD.

    Returns
    -------
    FairResult

    Raises
    ------
    MeshError
        The input can't be faired; ``code`` and ``elements`` say why and where.
    ValueError
        A shape or option is wrong; the message names the argument and what is accepted.
    Cancelled
        ``progress`` returned False.
    SolverError
        The numerics broke down.
    MemoryError
        There is not enough memory; on Linux a large run (100,000 free vertices) says so before it begins.
    """
    points = _arguments.floats("vertices", vertices)
    count = points.shape[0]
    faces = _arguments.triangles_as_given(triangles, count)
    fixed_list, given_normals = _arguments.boundary(fixed, fixed_normals)
    m0 = None if reference is None else _arguments.floats("reference", reference, count)
    edges = _options.neighbour_edges(neighbours, count)
    _options.faired_needs_fixed(open_border, fixed_list)
    _arguments.choice("method", method, _options.METHODS)
    _options.callback(progress)
    kind, rows = _options.inner_fairness(inner_fairness, count)
    of_paper = _paper.engine_options(method, levels, paper)
    shown = _arguments.share("detail", detail)
    put_back = 1.0 if weights is not None or feather != 0.0 else shown
    options = _options.engine_options(
        equation=equation, otherwise=otherwise, load=load, bulge=bulge, fairness=kind, method=method, normals=normals,
        tolerance=tolerance, max_iterations=max_iterations, threads=threads, detail=put_back, detail_size=detail_size,
        start=start, creases=creases, smooth_curves=smooth_curves, open_border=open_border, pin_radius=pin_radius,
    )  # fmt: skip
    joins = _options.continuity(continuity, equation, method)
    sample = _options.sample(detail_from, count, detail)
    around = _mending.Surroundings.of(points, faces, fixed_list, outside)
    if sample is not None:
        held = around.rim if fixed_list is None else np.union1d(around.rim, fixed_list)
        sample = _options.sample_around(sample, around.inside, held)
    as_given = _mending.Boundary(points, fixed_list, given_normals)
    if not joins and fixed_curvatures is not None:
        raise ValueError("fixed_curvatures: accepted with continuity 'G2' only")
    if joins:
        as_given = _joining.with_curvatures(as_given, around, fixed_curvatures)

    def call(boundary: _mending.Boundary) -> dict[str, Any]:
        return _core.fair(
            boundary.vertices,
            faces,
            boundary.fixed,
            boundary.normals,
            boundary.curvatures,
            m0,
            edges,
            rows,
            around.outside,
            sample,
            options,
            of_paper,
            progress,
            preview,
        )

    fitted = _arguments.choice("outline", outline, _options.OUTLINES) == "mended"
    if fitted:
        _mending.refuse_creases(creases, around)
    parts = _feather.vertex_weights(weights, count)
    refused = {"reference": m0 is not None, "outline": fitted, "continuity": joins, "detail_from": sample is not None}
    width = _feather.width(feather, parts, refused)
    if width > 0.0 or parts is not None:
        fade = _feather.Fade(
            shown, _arguments.share("detail_size", detail_size), width if parts is None else parts, threads, progress
        )
        return FairResult(**_feather.solve_feathered(call, as_given, around, fade))
    answer = _mending.solve_fitted(call, as_given, faces, around) if fitted else call(as_given)
    return FairResult(**_mending.with_join(answer, around))
