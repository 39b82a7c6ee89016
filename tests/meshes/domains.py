"""Pieces of an exact surface in its (s, t) coordinates, and points spread over them.

Points are (k, 2) arrays of (s, t). Spacing `h` is a length in space; everything random is seeded.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from curves import FloatArray
from surfaces import Sphere, Surface

BoolArray = NDArray[np.bool_]
Shape = Literal["disc", "tube", "rectangle", "oval"]


@dataclass(frozen=True)
class Style:
    """How irregular a mesh is.

    jitter: full width of the random displacement in edge lengths (0.6: up to ±0.3 h).
    valence3: share of the free vertices that are inserted into triangles: into random ones, or into those
    nearest to so many random centres (clusters).
    flips: share of the edges that are flipped away from Delaunay.
    grading: ratio of the edge lengths at the ends of s. aspect: edge length along s over across. stretch: of the plane
    in which points are triangulated, so that triangles are as much longer along s than Delaunay's.
    layout: "rows" (hexagonal-like rows, Delaunay), "grid" (quads, random diagonals), "random".
    """

    jitter: float = 0.6
    valence3: float = 0.0
    clusters: int = 0
    flips: float = 0.0
    grading: float = 1.0
    aspect: float = 1.0
    stretch: float = 1.0
    layout: Literal["rows", "grid", "random"] = "rows"
    seed: int = 0


@dataclass(frozen=True)
class Domain:
    """s in [curve.start, curve.stop] times t in [low, high]; discs start at the pole, s = 0.

    A tube closes in t after 2π; an oval is the ellipse inscribed in the rectangle.
    """

    surface: Surface
    shape: Shape
    low: float = 0.0
    high: float = 2 * np.pi

    @property
    def ends(self) -> tuple[float, float]:
        """First and last s."""
        return self.surface.curve.start, self.surface.curve.stop

    @property
    def closed(self) -> bool:
        """Whether t is an angle that runs all the way round."""
        return self.shape in ("disc", "tube")

    def space(self, st: FloatArray) -> FloatArray:
        """Positions (k, 3)."""
        return self.surface.point(st[:, 0], st[:, 1])


def spacing(domain: Domain, style: Style, s: FloatArray) -> FloatArray:
    """Edge length at s relative to h, geometric between the ends, with a mean of about 1."""
    start, stop = domain.ends
    share = (s - start) / (stop - start)
    return np.asarray(style.grading ** (share - 0.5))


def stations(domain: Domain, style: Style, step: float) -> FloatArray:
    """Values of s from end to end with local distances of about step times `spacing`."""
    s = np.linspace(*domain.ends, 2001)
    rate = 1.0 / spacing(domain, style, s)
    total = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(s))])
    count = max(2, round(total[-1] / step))
    result = np.interp(np.linspace(0, total[-1], count + 1), total, s)
    result[[0, -1]] = domain.ends
    return result


def _row(domain: Domain, s: float, h: float, shift: float) -> FloatArray:
    """One row at s: all the way round, or strictly between low and high."""
    extent = domain.high - domain.low
    length = extent * float(domain.surface.width(np.array([s]))[0])
    count = max(5 if domain.closed else 1, round(length / h))
    if domain.shape == "disc" and s < 1e-12:
        count = 1
    steps = np.arange(count) + shift
    inside = steps if domain.closed else steps[(steps > 0.25) & (steps < count - 0.25)]
    return np.column_stack([np.full(len(inside), s), domain.low + extent * inside / count])


def rows(domain: Domain, style: Style, h: float, rng: np.random.Generator) -> FloatArray:
    """Interior points in rows √3/2 h apart (times aspect), with random or alternating phases."""
    across, along = h / np.sqrt(style.aspect), h * np.sqrt(style.aspect)
    s = stations(domain, style, 0.5 * np.sqrt(3) * along)
    first = 0 if domain.shape == "disc" else 1
    size = across * spacing(domain, style, s)
    phases = rng.random(len(s)) if domain.closed else 0.5 * (np.arange(len(s)) % 2)
    chosen = range(first, len(s) - 1)
    return np.vstack([_row(domain, s[k], size[k], phases[k]) for k in chosen])


def stretched_disc(domain: Domain, style: Style, h: float) -> FloatArray:
    """A hexagonal lattice of the stereographic chart, `aspect` times longer in x than in y."""
    sphere = domain.surface
    if not isinstance(sphere, Sphere) or style.grading != 1.0:
        raise ValueError("anisotropic discs are made on spheres only, and not graded")
    rim = np.tan(0.5 * domain.ends[1] / sphere.radius)
    step = h / sphere.radius * np.array([np.sqrt(style.aspect), 1 / np.sqrt(style.aspect)])
    reach = int(2 * rim / step.min()) + 2
    i, j = np.meshgrid(np.arange(-reach, reach + 1), np.arange(-reach, reach + 1))
    lattice = np.column_stack([(i + 0.5 * (j % 2)).ravel(), (0.5 * np.sqrt(3) * j).ravel()]) * step
    inside = lattice[np.hypot(lattice[:, 0], lattice[:, 1]) < rim]
    return np.column_stack(sphere.unchart(inside))


def boundary(domain: Domain, style: Style, h: float, rng: np.random.Generator) -> list[FloatArray]:
    """Boundary loops, evenly spaced in space (times `spacing`), in order around each loop."""
    start, stop = domain.ends
    across = h / np.sqrt(style.aspect) * spacing(domain, style, np.array([start, stop]))
    if domain.shape == "disc":
        return [_row(domain, stop, float(h * spacing(domain, style, np.array([stop]))[0]), 0.0)]
    if domain.shape == "tube":
        pairs = zip((start, stop), across, strict=True)
        return [_row(domain, s, size, rng.random()) for s, size in pairs]
    if domain.shape == "oval":
        return [_oval(domain, style, h)]
    return [_rectangle(domain, style, h)]


def _rectangle(domain: Domain, style: Style, h: float) -> FloatArray:
    """The four sides, corners once each."""
    start, stop = domain.ends
    sizes = h / np.sqrt(style.aspect) * spacing(domain, style, np.array([start, stop]))
    widths = (domain.high - domain.low) * domain.surface.width(np.array([start, stop]))
    counts = np.maximum(2, np.round(widths / sizes)).astype(int)
    sides = [np.linspace(domain.low, domain.high, count + 1)[:-1] for count in counts]
    s = stations(domain, style, h * np.sqrt(style.aspect))
    low = np.column_stack([s[:-1], np.full(len(s) - 1, domain.low)])
    high = np.column_stack([s[:0:-1], np.full(len(s) - 1, domain.high)])
    last = np.column_stack([np.full(counts[1], stop), sides[1]])
    first = np.column_stack([np.full(counts[0], start), domain.high + domain.low - sides[0]])
    return np.vstack([low, last, high, first])


def _oval(domain: Domain, style: Style, h: float) -> FloatArray:
    start, stop = domain.ends
    turn = np.linspace(0, 2 * np.pi, 4001)
    s = 0.5 * (start + stop) + 0.5 * (stop - start) * np.cos(turn)
    t = 0.5 * (domain.low + domain.high) + 0.5 * (domain.high - domain.low) * np.sin(turn)
    edges = np.linalg.norm(np.diff(domain.space(np.column_stack([s, t])), axis=0), axis=1)
    steps = edges / spacing(domain, style, 0.5 * (s[1:] + s[:-1]))
    total = np.concatenate([[0.0], np.cumsum(steps)])
    count = max(6, round(total[-1] / h))
    even = np.interp(np.arange(count) / count * total[-1], total, turn)
    half_s, half_t = 0.5 * (stop - start), 0.5 * (domain.high - domain.low)
    centre = np.array([0.5 * (start + stop), 0.5 * (domain.low + domain.high)])
    return np.asarray(centre + np.column_stack([half_s * np.cos(even), half_t * np.sin(even)]))


def contains(domain: Domain, st: FloatArray) -> BoolArray:
    """Which points lie strictly inside."""
    start, stop = domain.ends
    a = (2 * st[:, 0] - start - stop) / (stop - start)
    b = (2 * st[:, 1] - domain.low - domain.high) / (domain.high - domain.low)
    if domain.shape == "oval":
        return np.asarray(a**2 + b**2 < 1)
    if domain.shape == "disc":
        return np.asarray(st[:, 0] < stop)
    return np.asarray((np.abs(a) < 1) & ((np.abs(b) < 1) | domain.closed))


def jittered(domain: Domain, st: FloatArray, size: FloatArray, style: Style, rng: np.random.Generator) -> FloatArray:
    """Every point moved by up to ±jitter/2 edges along s and across it, on the exact surface."""
    offset = (rng.random((len(st), 2)) - 0.5) * max(style.jitter, 1e-6) * size[:, None]
    offset *= np.sqrt(style.aspect) ** np.array([1, -1])
    along, across = domain.surface.frame(st[:, 0], st[:, 1])
    moved = domain.space(st) + offset[:, :1] * along + offset[:, 1:] * across
    s, t = domain.surface.locate(moved)
    return np.column_stack([s, t if not domain.closed else t % (2 * np.pi)])


def clearance(domain: Domain, st: FloatArray, loops: list[FloatArray]) -> FloatArray:
    """Distance in space to the boundary, sampled four times per edge."""
    samples = [domain.space(_refined(domain, loop)) for loop in loops]
    return np.asarray(cKDTree(np.vstack(samples)).query(domain.space(st))[0])


def _refined(domain: Domain, loop: FloatArray) -> FloatArray:
    ahead = np.roll(loop, -1, axis=0) - loop
    if domain.closed:
        ahead[:, 1] = (ahead[:, 1] + np.pi) % (2 * np.pi) - np.pi
    return np.vstack([loop + share * ahead for share in (0.0, 0.25, 0.5, 0.75)])


def thinned(points: FloatArray, size: FloatArray) -> BoolArray:
    """Mask that drops the later one of every pair of points (k, 3) closer than 0.55 size."""
    pairs = cKDTree(points).query_pairs(0.55 * float(size.max()), output_type="ndarray")
    lengths = np.linalg.norm(points[pairs[:, 0]] - points[pairs[:, 1]], axis=1)
    crowded = pairs[lengths < 0.55 * size[pairs[:, 0]]]
    keep = np.ones(len(points), dtype=bool)
    keep[crowded[:, 1]] = False
    return keep


def scattered(domain: Domain, style: Style, h: float, rng: np.random.Generator) -> FloatArray:
    """Random points, uniform per area (in units of the local spacing), thinned."""
    s = np.linspace(*domain.ends, 2001)
    density = domain.surface.width(s) / spacing(domain, style, s) ** 2
    total = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(s))])
    count = round(2.2 * (domain.high - domain.low) * total[-1] / h**2)
    t = domain.low + (domain.high - domain.low) * rng.random(count)
    st = np.column_stack([np.interp(total[-1] * rng.random(count), total, s), t])
    size = h * spacing(domain, style, st[:, 0])
    return np.asarray(st[thinned(domain.space(st), size)])


def interior(domain: Domain, style: Style, h: float, loops: list[FloatArray], rng: np.random.Generator) -> FloatArray:
    """Jittered points inside, none within about 0.4 edges of the boundary."""
    if style.layout == "random":
        st = scattered(domain, style, h, rng)
    elif domain.shape == "disc" and style.aspect != 1.0:
        st = stretched_disc(domain, style, h)
    else:
        st = rows(domain, style, h, rng)
    size = h * spacing(domain, style, st[:, 0])
    near = 0.4 * size / np.sqrt(max(style.aspect, 1 / style.aspect))
    keep = contains(domain, st) & (clearance(domain, st, loops) > near)
    st, size, near = st[keep], size[keep], near[keep]
    if len(st) == 0:
        return np.empty((0, 2))
    moved = jittered(domain, st, size, style, rng)
    stays = ~contains(domain, moved) | (clearance(domain, moved, loops) < near)
    return np.asarray(np.where(stays[:, None], st, moved))
