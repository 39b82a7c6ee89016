"""Irregular triangle meshes of exact surface patches, with exact vertices."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.spatial import Delaunay, cKDTree

from curves import FloatArray
from domains import Domain, Style, boundary, interior, jittered, spacing, stations
from grids import IntArray, halves


@dataclass(frozen=True)
class Mesh:
    """Vertices by their (s, t) (n, 2), triangles (m, 3), and the fixed vertices (k,) in order."""

    st: FloatArray
    triangles: IntArray
    fixed: IntArray


def mesh(domain: Domain, n_free: int, style: Style) -> Mesh:
    """A mesh with about n_free free vertices (within a few per cent)."""
    plain = round(n_free * (1.0 - style.valence3))
    build = grid if style.layout == "grid" else delaunay
    result = build(domain, _edge_length(domain, plain, style), style)
    rng = np.random.default_rng([style.seed, 7])
    triangles = oriented(domain, result.st, result.triangles)
    triangles = _flipped(domain, result.st, triangles, style, rng)
    triangles = without_ears(domain, result.st, triangles, result.fixed)
    result = Mesh(result.st, triangles, result.fixed)
    return _with_valence3(domain, result, n_free - plain, style.clusters, rng) if style.valence3 else result


def _edge_length(domain: Domain, n_free: int, style: Style) -> float:
    """The edge length that gives nearly n_free free vertices, by a multiplicative search."""
    count_of = grid_count if style.layout == "grid" else _count
    h, error = float(np.sqrt(_area(domain) / n_free)), np.inf
    best = h
    for _ in range(12):
        count = count_of(domain, h, style)
        if abs(count - n_free) < error:
            best, error = h, abs(count - n_free)
        if error <= 0.004 * n_free:
            break
        h *= float(np.sqrt(max(count, 1) / n_free))
    return best


def _area(domain: Domain) -> float:
    start, stop = domain.ends
    widths = domain.surface.width(np.linspace(start, stop, 201))
    return float(widths.mean() * (stop - start) * (domain.high - domain.low))


def _points(domain: Domain, h: float, style: Style) -> tuple[list[FloatArray], FloatArray]:
    rng = np.random.default_rng(style.seed)
    loops = boundary(domain, style, h, rng)
    return loops, interior(domain, style, h, loops, rng)


def _count(domain: Domain, h: float, style: Style) -> int:
    return len(_points(domain, h, style)[1])


def delaunay(domain: Domain, h: float, style: Style) -> Mesh:
    """Delaunay triangulation in the conformal chart; free vertices first, then the boundary."""
    return triangulated(domain, *_points(domain, h, style), style)


def triangulated(domain: Domain, loops: list[FloatArray], free: FloatArray, style: Style) -> Mesh:
    """Delaunay triangles of these points: stretched back by the style's aspect and stretch, not yet oriented."""
    st = np.vstack([free, *loops])
    fixed = np.arange(len(free), len(st))
    chart = domain.surface.chart(st[:, 0], st[:, 1])
    longer = style.aspect * style.stretch
    if domain.shape != "disc" or longer != 1.0:
        chart = chart / np.array([longer, 1.0])
    if domain.shape == "tube":
        return Mesh(st, _without_flat(chart, _periodic(chart), fixed), fixed)
    triangles = Delaunay(chart).simplices.astype(np.int64)
    return Mesh(st, _without_flat(chart, triangles, fixed), fixed)


def _periodic(chart: FloatArray) -> IntArray:
    """Delaunay triangles of points that repeat after 2π in the second coordinate.

    Of the translates of a triangle the one is kept whose smallest index lies in the middle copy.
    """
    count = len(chart)
    copies = [chart + np.array([0.0, 2 * np.pi * k]) for k in (-1, 0, 1)]
    simplices = Delaunay(np.vstack(copies)).simplices
    index, copy = simplices % count, simplices // count
    smallest = np.argmin(index, axis=1)
    middle = copy[np.arange(len(copy)), smallest] == 1
    return np.asarray(index[middle], dtype=np.int64)


def _without_flat(chart: FloatArray, triangles: IntArray, fixed: IntArray) -> IntArray:
    """Drop the slivers that Delaunay leaves along a straight or concave boundary."""
    on_boundary = np.isin(triangles, fixed).all(axis=1)
    a, b, c = (chart[triangles[:, k]] for k in range(3))
    ab, ac = b - a, c - a
    doubled = np.abs(ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0])
    longest = np.maximum((ab**2).sum(axis=1), ((ac - ab) ** 2).sum(axis=1))
    return np.asarray(triangles[~(on_boundary & (doubled < 0.05 * longest))])


def face_normals(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Cross products of the triangles, (m, 3): twice the area long."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.asarray(np.cross(b - a, c - a))


def oriented(domain: Domain, st: FloatArray, triangles: IntArray) -> IntArray:
    """Triangles with the winding of the surface normals (each one: the mesh hugs the surface)."""
    normals = domain.surface.normal(st[:, 0], st[:, 1])
    against = _agreement(domain.space(st), normals, triangles) < 0
    result = triangles.copy()
    result[against, 1], result[against, 2] = triangles[against, 2], triangles[against, 1]
    return result


def _agreement(points: FloatArray, normals: FloatArray, triangles: IntArray) -> FloatArray:
    """Scaled cosine between each triangle's normal and the surface normal, (m,)."""
    cross = face_normals(points, triangles)
    mean = normals[triangles].mean(axis=1)
    return np.asarray((cross * mean).sum(axis=1) / np.maximum((cross**2).sum(axis=1), 1e-300) ** 0.5)


def edge_pairs(triangles: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """Interior edges (e, 2), their two triangles (e, 2) and the two opposite vertices (e, 2)."""
    corners = np.vstack([np.roll(triangles, -k, axis=1) for k in range(3)])
    owner = np.tile(np.arange(len(triangles)), 3)
    ends = np.sort(corners[:, 1:], axis=1)
    order = np.lexsort((owner, ends[:, 1], ends[:, 0]))
    same = (ends[order[1:]] == ends[order[:-1]]).all(axis=1)
    first, second = order[:-1][same], order[1:][same]
    faces = np.column_stack([owner[first], owner[second]])
    return ends[first], faces, np.column_stack([corners[first, 0], corners[second, 0]])


def flip_edges(domain: Domain, st: FloatArray, triangles: IntArray, chosen: IntArray, quality: float) -> IntArray:
    """Flip the chosen interior edges (rows of `edge_pairs`) where the outcome stays unfolded."""
    _, faces, opposite = edge_pairs(triangles)
    points, normals = domain.space(st), domain.surface.normal(st[:, 0], st[:, 1])
    known = {tuple(edge) for edge in np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2))}
    result, touched = triangles.copy(), np.zeros(len(triangles), dtype=bool)
    for edge in chosen:
        pair, (c, d) = faces[edge], opposite[edge]
        if touched[pair].any() or (min(c, d), max(c, d)) in known:
            continue
        a, b = _directed(triangles[pair[0]], c)
        new = np.array([[c, a, d], [d, b, c]])
        if _roundness(points, normals, new).min() > quality:
            result[pair], touched[pair] = new, True
            known.add((min(c, d), max(c, d)))
    return result


def _directed(triangle: IntArray, apex: int) -> tuple[int, int]:
    """The two other corners in winding order after the apex."""
    at = int(np.flatnonzero(triangle == apex)[0])
    return int(triangle[(at + 1) % 3]), int(triangle[(at + 2) % 3])


def _roundness(points: FloatArray, normals: FloatArray, triangles: IntArray) -> FloatArray:
    """Signed area over squared longest edge: 0.43 if equilateral, negative if folded."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    longest = np.max([((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))], axis=0)
    area = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return np.asarray(area * np.sign(_agreement(points, normals, triangles)) / longest)


def _flipped(domain: Domain, st: FloatArray, triangles: IntArray, style: Style, rng: np.random.Generator) -> IntArray:
    if not style.flips:
        return triangles
    count = len(edge_pairs(triangles)[0])
    chosen = rng.permutation(count)[: round(style.flips * count)]
    return flip_edges(domain, st, triangles, chosen, quality=0.08)


def without_ears(domain: Domain, st: FloatArray, triangles: IntArray, fixed: IntArray) -> IntArray:
    """Flip interior edges between two fixed vertices: every corner gets a free neighbour."""
    ends = edge_pairs(triangles)[0]
    chords = np.flatnonzero(np.isin(ends, fixed).all(axis=1))
    return flip_edges(domain, st, triangles, chords, quality=0.0)


def _with_valence3(domain: Domain, base: Mesh, count: int, clusters: int, rng: np.random.Generator) -> Mesh:
    """Insert `count` vertices of valence 3 into different triangles, on the surface."""
    order = _clustered(domain, base, clusters, rng) if clusters else rng.permutation(len(base.triangles))
    chosen = np.sort(order[:count])
    corners = base.triangles[chosen]
    centres = domain.space(base.st)[corners].mean(axis=1)
    st = np.vstack([base.st, np.column_stack(domain.surface.locate(centres))])
    new = len(base.st) + np.arange(count)
    fans = [np.column_stack([corners[:, [k, (k + 1) % 3]], new]) for k in range(3)]
    kept = np.delete(base.triangles, chosen, axis=0)
    return replace(base, st=st, triangles=np.vstack([kept, *fans]))


def _clustered(domain: Domain, base: Mesh, clusters: int, rng: np.random.Generator) -> IntArray:
    """The triangles with a free corner by their distance from so many random ones."""
    usable = np.flatnonzero(~np.isin(base.triangles, base.fixed).all(axis=1))
    centres = domain.space(base.st)[base.triangles[usable]].mean(axis=1)
    seeds = centres[rng.permutation(len(usable))[:clusters]]
    return np.asarray(usable[np.argsort(cKDTree(seeds).query(centres)[0], kind="stable")])


def _axes(domain: Domain, h: float, style: Style) -> tuple[FloatArray, FloatArray]:
    if domain.shape not in ("tube", "rectangle"):
        raise ValueError(f"no grid on a {domain.shape}")
    s = stations(domain, style, h * np.sqrt(style.aspect))
    width = float(domain.surface.width(np.linspace(*domain.ends, 101)).mean())
    across = max(6, round((domain.high - domain.low) * width / h * np.sqrt(style.aspect)))
    t = np.linspace(domain.low, domain.high, across + 1)
    return s, t[:-1] if domain.closed else t


def grid_count(domain: Domain, h: float, style: Style) -> int:
    """Number of free vertices for the edge length h."""
    s, t = _axes(domain, h, style)
    return (len(s) - 2) * (len(t) if domain.closed else len(t) - 2)


def grid(domain: Domain, h: float, style: Style) -> Mesh:
    """The grid with its rows along t; free vertices jittered, jitter halved where it would fold."""
    s, t = _axes(domain, h, style)
    rng = np.random.default_rng(style.seed)
    rows, columns = len(s), len(t)
    st = np.column_stack([np.repeat(s, columns), np.tile(t, rows)])
    border = np.zeros((rows, columns), dtype=bool)
    border[[0, -1]] = True
    if not domain.closed:
        border[:, [0, -1]] = True
    fixed = np.flatnonzero(border.ravel())
    number = np.arange(rows * columns).reshape(rows, columns)
    triangles = halves(np.column_stack([number, number[:, 0]]) if domain.closed else number, rng)
    offset = _shaken(domain, st, fixed, h, style, rng)
    return Mesh(_unfolded(domain, st, offset, triangles), triangles, fixed)


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
