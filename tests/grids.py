"""Grids of jittered quads split by random diagonals, for rectangles and tubes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from curves import FloatArray
from domains import Domain, Style, jittered, spacing, stations

IntArray = NDArray[np.int64]


@dataclass(frozen=True)
class Grid:
    """The same fields as `meshing.Mesh`."""

    st: FloatArray
    triangles: IntArray
    fixed: IntArray


def _axes(domain: Domain, h: float, style: Style) -> tuple[FloatArray, FloatArray]:
    if domain.shape not in ("tube", "rectangle"):
        raise ValueError(f"no grid on a {domain.shape}")
    s = stations(domain, style, h * np.sqrt(style.aspect))
    width = float(domain.surface.width(np.linspace(*domain.ends, 101)).mean())
    across = max(6, round((domain.high - domain.low) * width / h * np.sqrt(style.aspect)))
    t = np.linspace(domain.low, domain.high, across + 1)
    return s, t[:-1] if domain.closed else t


def count(domain: Domain, h: float, style: Style) -> int:
    """Number of free vertices for the edge length h."""
    s, t = _axes(domain, h, style)
    return (len(s) - 2) * (len(t) if domain.closed else len(t) - 2)


def grid(domain: Domain, h: float, style: Style) -> Grid:
    """The grid with its rows along t; free vertices jittered, jitter halved where it would fold."""
    s, t = _axes(domain, h, style)
    rng = np.random.default_rng(style.seed)
    rows, columns = len(s), len(t)
    st = np.column_stack([np.repeat(s, columns), np.tile(t, rows)])
    outline = np.zeros((rows, columns), dtype=bool)
    outline[[0, -1]] = True
    if not domain.closed:
        outline[:, [0, -1]] = True
    fixed = np.flatnonzero(outline.ravel())
    triangles = _split(rows, columns, domain.closed, rng)
    offset = _shaken(domain, st, fixed, h, style, rng)
    return Grid(_unfolded(domain, st, offset, triangles), triangles, fixed)


def _split(rows: int, columns: int, closed: bool, rng: np.random.Generator) -> IntArray:
    across = columns if closed else columns - 1
    i, j = np.divmod(np.arange((rows - 1) * across), across)
    following = (j + 1) % columns
    a, b = i * columns + j, (i + 1) * columns + j
    c, d = (i + 1) * columns + following, i * columns + following
    swap = rng.random(len(a)) < 0.5
    a, b, c, d = (np.where(swap, p, q) for p, q in ((b, a), (c, b), (d, c), (a, d)))
    return np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])])


def _shaken(
    domain: Domain, st: FloatArray, fixed: IntArray, h: float, style: Style,
    rng: np.random.Generator,
) -> FloatArray:  # fmt: skip
    """Random offsets (k, 2) of the free points."""
    size = h * spacing(domain, style, st[:, 0])
    moved = jittered(domain, st, size, style, rng) - st
    if domain.closed:
        moved[:, 1] = (moved[:, 1] + np.pi) % (2 * np.pi) - np.pi
    moved[fixed] = 0.0
    return moved


def _unfolded(domain: Domain, st: FloatArray, offset: FloatArray, triangles: IntArray) -> FloatArray:
    """Points st + offset (k, 2), offsets halved at the corners of triangles that turn over."""
    for _ in range(10):
        corner = domain.space(st + offset)[triangles]
        cross = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
        normals = domain.surface.normal(st[:, 0], st[:, 1])[triangles].mean(axis=1)
        signed = (cross * normals).sum(axis=1) * np.sign((cross * normals).sum())
        offset[triangles[signed < 0.1 * np.median(signed)]] *= 0.5
    return st + offset
