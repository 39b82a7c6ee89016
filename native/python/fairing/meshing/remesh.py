"""New meshes for patches."""

from __future__ import annotations

from typing import Any

import numpy.typing as npt

from fairing import _core
from fairing.meshing.patch import Progress, own_mesh_options, refuse_made_here, spacing_of
from fairing.meshing.quads import FACES, quads_of
from fairing.options import arguments
from fairing.options.checks import given
from fairing.options.groups import Boundary, Options
from fairing.results import RemeshResult
from fairing.solving import slopes, surroundings


def remesh(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    boundary: Boundary | npt.ArrayLike | None = None,
    options: Options | None = None,
    *,
    kept: npt.ArrayLike | None = None,
    spacing: float = 0.0,
    inner: str | None = None,
    faces: str = "triangles",
    max_vertices: int = 0,
    progress: Progress | None = None,
    threads: int = 0,
    **named: Any,
) -> RemeshResult:
    """Fair a patch on a new mesh: :func:`fairing.fair`, and then other vertices and triangles for its surface.

    Fixed vertices and the boundary's edges stay; no vertex need be free. ``origin`` says where each new vertex lies on
    the old patch, so that what belongs to its vertices or corners can be carried over: what :func:`fairing.fair` makes
    of the old mesh, with ``inner_fairness="conformal"`` by default, takes them there. ``spacing`` and ``inner`` are
    those of :func:`fairing.fill`, the other parameters those of :func:`fairing.fair`. Where the new mesh is coarser
    than the old one and has less than 1000 vertices, it is cut from the surface of the old one, and not solved again.

    ``kept``, (e, 2): edges of the old mesh that the new one has, too, between new vertices at the same places of the
    surface, which ``result.old`` names: seams of a texture.

    ``creases``, some of the fixed vertices: as in :func:`fairing.fair`, each side of a curve of them finds its slope.
    Hard edges through the patch are such curves, made fair by :func:`fairing.fair_edges`. They keep their vertices.

    ``faces``: as for :func:`fairing.fill`. Quads are in rows where one patch between one boundary loop or two has no
    pins, creases or ``kept`` edges.

    ``max_vertices``: more new vertices than that are refused (OUT_OF_PROPORTION), by the old surface before anything is
    solved, and by the faired one. 0: 20 times as many as the old surface would have with that spacing, or 50 000 where
    that is less, 4 000 000 at most.
    """
    around, chosen = given(boundary, options, named)
    if around.continuity is not None and around.curvatures is None:
        raise ValueError("continuity: 'G2' on parts of the boundary needs `curvatures` here")
    points, corners = arguments.mesh(vertices, triangles)
    held, given_normals = arguments.boundary(around.vertices, around.normals)
    lines = arguments.edges_of("kept", kept, corners)
    length = spacing_of(spacing, inner)
    in_rows = arguments.choice("faces", faces, FACES) == "quads"
    most = arguments.whole("max_vertices", max_vertices, 0)
    refuse_made_here(chosen, progress)
    if chosen.surface.equation == "soap_film":
        raise ValueError("equation: 'soap_film' has no normals to continue; accepted are the others")
    engine = own_mesh_options(chosen, threads)
    beside = surroundings.Surroundings.of(points, corners, held, around.outside)
    joined = surroundings.Boundary(points, held, given_normals)
    if chosen.surface.continuity == "G2":
        joined = slopes.with_curvatures(joined, beside, around.curvatures, around.continuity)
    outside = beside.outside if around.outside is not None else corners[:0]
    patch = points, corners, joined.fixed, given_normals, joined.curvatures, outside
    values = _core.new_patch(patch, lines.tolist(), engine, (length.length, length.even, in_rows, most), progress)
    values.pop("base")
    pairs = values.pop("pairs")
    return RemeshResult(**values, quads=None if pairs is None else quads_of(values["triangles"], pairs))
