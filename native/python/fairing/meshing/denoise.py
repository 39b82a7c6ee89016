"""A surface without its roughness."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from fairing import _core
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
    points, faces = arguments.finite_mesh(vertices, triangles)
    length = arguments.length("size", size, f"{EDGES:g} mean edges")
    share = arguments.share("amount", amount)
    count = arguments.whole("threads", threads, 0)
    held = arguments.vertices_of("fixed", fixed, len(points))
    lines = arguments.edges_of("edges", edges, faces)
    moves = np.zeros(len(points), dtype=bool)
    moves[faces] = True
    moves[held] = False
    # The curvature at the neighbours of what moves counts, and needs all triangles there.
    near = np.zeros(len(points), dtype=bool)
    near[faces[moves[faces].any(axis=1)]] = True
    around = faces[near[faces].any(axis=1)]
    sides, uses = edges_with_uses(around)
    border = sides[(uses == 1) & near[sides].any(axis=1)]
    loose = np.unique(np.concatenate([border.ravel(), lines.ravel()]))  # the surface may bend there
    moves[loose] = False
    if not moves.any() or share == 0.0:
        return points.copy()

    def sizes(placed: FloatArray, edges: IntArray, names: IntArray, unit: float) -> FloatArray:
        wanted = np.full(len(placed), length / unit) if length else EDGES * edges_around(placed, edges)
        return np.where(np.isin(names, loose), 0.0, wanted)

    # The move is scaled, not the place: what does not move keeps its bits.
    stays = np.flatnonzero(~moves).astype(np.int32)
    return points + share * denoised(points, around, stays, sizes, count, checks.callback(progress))


def denoised(
    points: FloatArray, triangles: IntArray, fixed: IntArray,
    sizes: Callable[[FloatArray, IntArray, IntArray, float], FloatArray], threads: int, progress: Progress | None,
) -> FloatArray:  # fmt: skip
    """(n, 3) the moves of vertices that are not fixed, solved in a box of size 1.

    sizes: of the places (k, 3) there, their edges (e, 2), the vertices (k,) and the box's size: (k,) wavelengths.
    """
    names, local = np.unique(triangles, return_inverse=True)
    local = local.reshape(-1, 3).astype(np.int32)
    low = points[names].min(axis=0)
    unit = float(np.ptp(points[names], axis=0).max()) or 1.0
    placed = (points[names] - low) / unit
    stays = np.isin(names, fixed)
    wanted = sizes(placed, edges_with_uses(local)[0].astype(np.int32), names, unit)
    smooth = _core.denoised(placed, local, np.flatnonzero(stays).astype(np.int32), wanted, threads, progress)
    moves = np.zeros_like(points)
    moves[names[~stays]] = unit * (smooth - placed)[~stays]
    return moves


def edges_around(points: FloatArray, edges: IntArray) -> FloatArray:
    """(n,) the mean length of the edges around each vertex."""
    lengths = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1)
    both, count = edges.ravel(), len(points)
    uses = np.bincount(both, minlength=count)
    around: FloatArray = np.bincount(both, np.repeat(lengths, 2), count) / uses
    for _ in range(SPREAD):
        around = (around + np.bincount(both, around[edges[:, ::-1]].ravel(), count)) / (1 + uses)
    return around
