"""A surface without its roughness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from fairing import _core
from fairing.filleting import fillet
from fairing.measure import edges_with_uses
from fairing.options import arguments, checks
from fairing.results import FloatArray, IntArray, Progress

EDGES = 12.0  # mean edges around that the shortest wave has that stays: as many as for what counts as detail
SPREAD = 2  # times that a vertex's mean edge is averaged with its neighbours'


def denoise(
    vertices: npt.ArrayLike,
    triangles: npt.ArrayLike,
    *,
    size: float = 0.0,
    amount: float = 1.0,
    fixed: npt.ArrayLike | None = None,
    edges: npt.ArrayLike | None = None,
    progress: Progress | None = None,
    threads: int = 0,
) -> FloatArray:
    """(n, 3) the positions without roughness: what is shorter than ``size`` goes, what is longer stays.

    The surface b with the least ∫ |b − x|² + l⁴ |Δb|², once for x and once more for what was left of it: waves of
    length ``size`` lose 1 % of their height, longer ones less, those of .46 of it one half. A sphere keeps its radius
    to (√2 size/(2 π R))⁸/81 of it. No argument is ever changed.

    Parameters
    ----------
    vertices : (n, 3) float
    triangles : (m, 3) int
        The whole mesh, or a part and its surroundings; the surface passes smoothly into those that don't move.
    size : float
        The shortest wavelength that stays, in the unit of the positions. 0: twelve of the edges around each vertex, so
        that fine parts of a mesh keep finer shapes.
    amount : float
        0 … 1: how much of the roughness goes.
    fixed : (k,) int
        Vertices that keep their bits; border vertices do always.
    edges : (e, 2) int
        Edges that stay, and over which the surface may bend: hard edges.
    progress, threads
        As for :func:`fairing.fair`.

    Raises
    ------
    MeshError
        INDEX_RANGE, NONFINITE.
    ValueError, Cancelled, SolverError
        As for :func:`fairing.fair`.
    """
    points, faces = arguments.mesh(vertices, triangles)
    fillet.check_finite(points, faces)
    length = arguments.finite("size", size)
    if length < 0:
        raise ValueError(f"size: a length, or 0 for {EDGES:g} mean edges, is needed, not {size!r}")
    share = arguments.share("amount", amount)
    count = arguments.whole("threads", threads, 0)
    held = arguments.vertices_of("fixed", fixed, len(points))
    part = _part(faces, held, arguments.edges_of("edges", edges, faces), len(points))
    result = points.copy()
    if not len(part.free) or share == 0.0:
        return result
    numbers, local = np.unique(part.triangles, return_inverse=True)
    local = local.reshape(-1, 3).astype(np.int32)
    low = points[numbers].min(axis=0)
    unit = float(np.ptp(points[numbers], axis=0).max()) or 1.0
    placed = (points[numbers] - low) / unit
    around = edges_around(placed, np.searchsorted(numbers, part.edges))
    sizes = np.full(len(placed), length / unit) if length else EDGES * around
    sizes[np.isin(numbers, part.loose)] = 0.0
    moved = np.isin(numbers, part.free)
    stays = np.flatnonzero(~moved).astype(np.int32)
    smooth = _core.denoised(placed, local, stays, sizes, count, checks.callback(progress))
    # The move is scaled, not the place: what does not move keeps its bits.
    result[numbers[moved]] += share * unit * (smooth[moved] - placed[moved])
    return result


@dataclass(frozen=True)
class _Part:
    """Vertices that move, those over which the surface may bend, and what either depends on."""

    free: IntArray
    loose: IntArray
    triangles: IntArray
    edges: npt.NDArray[np.int64]  # (e, 2) of the triangles


def _part(faces: IntArray, fixed: IntArray, edges: IntArray, count: int) -> _Part:
    moves = np.zeros(count, dtype=bool)
    moves[faces] = True
    moves[fixed] = False
    # The curvature at the neighbours of what moves counts, and needs all triangles there.
    near = np.zeros(count, dtype=bool)
    near[faces[moves[faces].any(axis=1)]] = True
    around = faces[near[faces].any(axis=1)]
    sides, uses = edges_with_uses(around)
    border = sides[(uses == 1) & near[sides].any(axis=1)]
    loose = np.unique(np.concatenate([border.ravel(), edges.ravel()]))
    moves[loose] = False
    return _Part(np.flatnonzero(moves), loose, around, sides)


def edges_around(points: FloatArray, edges: npt.NDArray[np.intp]) -> FloatArray:
    """(n,) the mean length of the edges around each vertex."""
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    both, count = edges.ravel(), len(points)
    uses = np.bincount(both, minlength=count)
    around: FloatArray = np.bincount(both, np.repeat(lengths, 2), count) / uses
    for _ in range(SPREAD):
        around = (around + np.bincount(both, around[edges[:, ::-1]].ravel(), count)) / (1 + uses)
    return around
