"""Graded irregular meshes: fine around one spot of a surface, coarse far from it.

Random points, as dense as the local size asks for, triangulated by Delaunay and not smoothed; then every
twelfth edge is flipped where the two triangles stay below an aspect of 12. `RATIO` gives a ratio
of longest to shortest edge of about 40.
"""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

import shapes
from curves import FloatArray
from domains import Domain, Style, clearance, contains
from meshing import IntArray, Mesh, edge_pairs, flip_edges, oriented, triangulated, without_ears
from shapes import Patch

RATIO = 12.0
ASPECT = 12.0
FLIPS = 1 / 12


@dataclass(frozen=True)
class Grading:
    """Edge lengths grow by `ratio` from a spot on the outline's side to the farthest point of the patch.

    spot: its place (s, t) in shares of the domain; seed: of the points.
    """

    ratio: float = RATIO
    spot: tuple[float, float] = (0.4, 0.15)
    seed: int = 0


def regraded(patch: Patch, n_free: int, grading: Grading | None = None) -> Patch:
    """A graded mesh of the same piece of surface (disc or tube) with about n_free free vertices."""
    chosen = grading or Grading()
    domain, size = patch.domain, _Size(patch.domain, chosen)
    h, best, error = 1.0, 1.0, np.inf
    for _ in range(14):
        count = len(_points(domain, size, h, chosen.seed)[1])
        if abs(count - n_free) < error:
            best, error = h, abs(count - n_free)
        if error <= 0.02 * n_free:
            break
        h *= float(np.sqrt(max(count, 4) / n_free))
    loops, free = _points(domain, size, best, chosen.seed)
    made = triangulated(domain, loops, free, Style())
    triangles = _flipped(domain, made.st, oriented(domain, made.st, made.triangles), chosen.seed)
    triangles = without_ears(domain, made.st, triangles, made.fixed)
    return shapes.patch_of(domain, Mesh(made.st, triangles, made.fixed))


def _flipped(domain: Domain, st: FloatArray, triangles: IntArray, seed: int) -> IntArray:
    count = len(edge_pairs(triangles)[0])
    chosen = np.random.default_rng([seed, 13]).permutation(count)[: round(FLIPS * count)]
    return flip_edges(domain, st, triangles, chosen, quality=0.25 * np.sqrt(3) / ASPECT)


class _Size:
    """Relative edge length, 1 at the spot and `ratio` at the farthest point, linear in the distance between."""

    def __init__(self, domain: Domain, grading: Grading) -> None:
        self.domain, self.ratio = domain, grading.ratio
        start, stop = domain.ends
        share_s, share_t = grading.spot
        t = domain.low + share_t * (domain.high - domain.low)
        self.spot = domain.surface.point(np.array([start + share_s * (stop - start)]), np.array([t]))
        lattice = np.meshgrid(np.linspace(start, stop, 41), np.linspace(domain.low, domain.high, 81))
        self.reach = float(self._away(np.column_stack([axis.ravel() for axis in lattice])).max())

    def _away(self, st: FloatArray) -> FloatArray:
        return np.asarray(np.linalg.norm(self.domain.space(st) - self.spot, axis=1))

    def __call__(self, st: FloatArray) -> FloatArray:
        return np.asarray(1.0 + (self.ratio - 1.0) * self._away(st) / self.reach)


def _points(domain: Domain, size: _Size, h: float, seed: int) -> tuple[list[FloatArray], FloatArray]:
    rng = np.random.default_rng([seed, 11])
    loops = [_loop(domain, size, h, s) for s in _rims(domain)]
    st = _scattered(domain, size, h, rng)
    keep = contains(domain, st) & (clearance(domain, st, loops) > 0.45 * h * size(st))
    return loops, st[keep]


def _rims(domain: Domain) -> tuple[float, ...]:
    if domain.shape not in ("disc", "tube"):
        raise ValueError(f"no graded mesh of a {domain.shape}")
    return domain.ends if domain.shape == "tube" else domain.ends[1:]


def _loop(domain: Domain, size: _Size, h: float, s: float) -> FloatArray:
    """Points around s = const, as far apart as the local size asks."""
    t = np.linspace(domain.low, domain.high, 2001)
    st = np.column_stack([np.full(len(t), s), t])
    rate = float(domain.surface.width(np.array([s]))[0]) / (h * size(st))
    total = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(t))])
    count = max(12, round(total[-1]))
    even = np.interp(np.arange(count) / count * total[-1], total, t)
    return np.column_stack([np.full(count, s), even])


def _scattered(domain: Domain, size: _Size, h: float, rng: np.random.Generator) -> FloatArray:
    """Random points with one in about h² size² of area, none closer than 0.6 of that to an earlier one."""
    s = np.linspace(*domain.ends, 401)
    width = domain.surface.width(s)
    total = np.concatenate([[0.0], np.cumsum(0.5 * (width[1:] + width[:-1]) * np.diff(s))])
    area = (domain.high - domain.low) * total[-1]
    tries = round(min(3.0 * area / h**2, 4e5))
    st = np.column_stack([np.interp(total[-1] * rng.random(tries), total, s),
                          domain.low + (domain.high - domain.low) * rng.random(tries)])  # fmt: skip
    st = st[rng.random(tries) < size(st) ** -2]
    return np.asarray(st[_apart(domain.space(st), 0.6 * h * size(st))])


def _apart(points: FloatArray, radius: FloatArray) -> FloatArray:
    """Mask of the points with no earlier kept point within their own radius."""
    keep = np.ones(len(points), dtype=bool)
    for k, near in enumerate(cKDTree(points).query_ball_point(points, radius)):
        earlier = [j for j in near if j < k]
        keep[k] = not keep[earlier].any()
    return keep
