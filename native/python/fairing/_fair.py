"""The main call."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy.typing as npt

from fairing import _arguments, _core, _feather, _joining, _mending, _options
from fairing._given import given
from fairing._groups import Boundary, Options, Skin
from fairing._types import FairResult, FloatArray

Progress = Callable[[float, str], "bool | None"]
Preview = Callable[[FloatArray], object]


def fair(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    boundary: Boundary | npt.ArrayLike | None = None,
    options: Options | None = None,
    *,
    progress: Progress | None = None,
    preview: Preview | None = None,
    threads: int = 0,
    **named: Any,
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
    boundary : Boundary | (k,) int
        What is fixed (:class:`fairing.Boundary`), or the fixed vertices alone. Default: the mesh border.
    options : Options
        Which surface, and how it is found (:class:`fairing.Options`).
    progress : callable(fraction, stage) -> None | bool
        Called every 50 ms or so, by the calling thread, with the part done (0 … 1, never less than before) and what
        is being done. None or True goes on, False cancels; exceptions come out of the call.
    preview : callable(vertices) -> None
        Called once, by the calling thread, before the search begins: with the (n, 3) vertices of a first surface, which
        always exists and is finite. Of bi-Laplacian fills of the boundary, by the connectivity and by ``reference``, it
        is the one with the least bending energy, after two steps of its descent. Without ``detail``, and between the
        boundary that is given. Exceptions come out of the call.
    threads : int
        0: one for each core, eight at most. The result has the same bits for every number of threads.
    named
        Fields of the options by their names, in place of groups: ``equation="constant", bulge=0.1``; and ``fixed``,
        ``fixed_normals``, ``fixed_curvatures`` and ``outside`` for those of the boundary.

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
    held, chosen = given(boundary, options, named)
    return solved(vertices, triangles, held, chosen, progress, threads, preview)


def solved(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    boundary: Boundary,
    chosen: Options,
    progress: Progress | None,
    threads: int,
    preview: Preview | None = None,
) -> FairResult:
    """What :func:`fair` does."""
    surface, skin, curves = chosen.surface, chosen.skin, chosen.curves
    points = _arguments.floats("vertices", vertices)
    count = points.shape[0]
    faces = _arguments.triangles_as_given(triangles, count)
    fixed, normals = _arguments.boundary(boundary.vertices, boundary.normals)
    reference = chosen.layout.reference
    m0 = None if reference is None else _arguments.floats("reference", reference, count)
    _options.faired_needs_fixed(curves.open_border, fixed)
    _options.callback(progress)
    engine = _options.engine_options(chosen, threads, count)
    fades = skin.weights is not None or skin.feather != 0.0
    if fades:
        engine.detail = 1.0
    joins = _options.continuity(surface.continuity, surface.equation, chosen.solving.method)
    around = _mending.Surroundings.of(points, faces, fixed, boundary.outside)
    as_given = _mending.Boundary(points, fixed, normals)
    if not joins and boundary.curvatures is not None:
        raise ValueError("fixed_curvatures: accepted with continuity 'G2' only")
    if joins:
        as_given = _joining.with_curvatures(as_given, around, boundary.curvatures, boundary.continuity)

    def call(held: _mending.Boundary) -> dict[str, Any]:
        return _core.fair(
            held.vertices, faces, held.fixed, held.normals, held.curvatures, m0, around.outside,
            engine, progress, preview,
        )  # fmt: skip

    fitted = _arguments.choice("outline", surface.outline, _options.OUTLINES) == "mended"
    if fitted:
        _mending.refuse_creases(curves.creases, around)
    refused = {
        "reference": m0 is not None, "outline": fitted, "continuity": joins,
    }  # fmt: skip
    fade = _fade(skin, refused, count, threads, progress)
    if fade is not None:
        return FairResult(**_feather.solve_feathered(call, as_given, around, fade))
    answer = _mending.solve_fitted(call, as_given, faces, around) if fitted else call(as_given)
    return FairResult(**_mending.with_join(answer, around))


def _fade(
    skin: Skin, refused: dict[str, bool], count: int, threads: int, progress: Progress | None
) -> _feather.Fade | None:
    """How the change fades out; None where it does not."""
    parts = _feather.vertex_weights(skin.weights, count)
    width = _feather.width(skin.feather, parts, refused)
    if not width > 0.0 and parts is None:
        return None
    size = _arguments.share("detail_size", skin.detail_size)
    return _feather.Fade(float(skin.detail), size, width if parts is None else parts, threads, progress)
