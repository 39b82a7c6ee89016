"""What new vertices and faces get of the data around them, also across seams, where files part vertices."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from fairing.maps import interpolate
from fairing.measure import nearest
from fairing.objects.parts import PLACE, Data, Parts, Polygons, alike
from fairing.results import FilletResult, FloatArray, IntArray, NewMeshResult, SolverError


@dataclass(frozen=True, eq=False)
class Sides:
    """The triangles around holes, parted where vertices in one place differ in what is stored for them."""

    of_rim: IntArray
    """(r,) the side of each triangle, named by one of its vertices."""
    copies: dict[int, dict[int, int]]
    """Of each side: the vertex that stands for a place."""
    corners: IntArray
    """(r, 3) the triangles' vertices; one for all that are alike."""

    @classmethod
    def around(cls, parts: Parts, rim: IntArray) -> Sides:
        """The sides of the triangles ``rim``: as large as they get while none has a place twice."""
        used, corners = np.unique(parts.own[rim], return_inverse=True)
        stored = [
            np.nan_to_num(values[used].reshape(len(used), -1).astype(np.float64))
            for name, values in parts.vertex_data.items()
            if name != PLACE and not is_normal(name, values) and values.dtype.kind in "biuf"
        ]
        first, number = alike(np.column_stack([parts.same[used], *stored]))
        own: IntArray = used[first][number[corners.reshape(-1, 3)]]
        places, times = np.unique(parts.same[used[first]], return_counts=True)
        copies = {v: {int(parts.same[v]): v} for v in used[first].tolist()}
        if (times == 1).all():
            every = {place: v for each in copies.values() for place, v in each.items()}
            return cls(np.zeros(len(rim), np.int64), {0: every}, own)
        middles, seam = parts.points[own].mean(axis=1), parts.points[places[times > 1]]
        away = np.linalg.norm(middles - seam[nearest(middles, seam)], axis=1)
        side = {v: v for v in copies}
        for triangle in own[np.argsort(away)].tolist():  # sides that must end do so far from the seams
            for corner in triangle[1:]:
                a, b = sorted((side[triangle[0]], side[corner]), key=lambda v: len(copies[v]))
                if a != b and not copies[a].keys() & copies[b].keys():
                    side.update(dict.fromkeys(copies[a].values(), b))
                    copies[b] |= copies.pop(a)
        of_rim = [max((side[v] for v in triangle), key=lambda each: len(copies[each])) for triangle in own.tolist()]
        return cls(np.array(of_rim), copies, own)


class Parted(NamedTuple):
    """New faces on sides: a vertex for each place and side, those there are and, behind them, new ones."""

    faces: Polygons
    places: IntArray
    """(k,) where each new vertex stands."""
    side: IntArray
    """(k,) the side that it is on."""
    corner: IntArray
    """(k,) the first corner of the faces that it is."""
    points: FloatArray
    """(k, 3)"""

    @classmethod
    def by(cls, sides: Sides, faces: Polygons, of_faces: IntArray, points: FloatArray, count: int) -> Parted:
        """``faces``: of the places ``points``, of which those from ``count`` on are new; ``of_faces``: their sides."""
        rows = np.column_stack([faces.corners, np.repeat(of_faces, faces.sizes)])
        pairs, first, pair_of = np.unique(rows, axis=0, return_index=True, return_inverse=True)
        numbers = np.array([sides.copies[s].get(v, -1) for v, s in pairs.tolist()])
        new = np.flatnonzero(numbers < 0)
        once = np.diff(pairs[new, 0], prepend=-1) != 0
        new = np.concatenate([new[once & (pairs[new, 0] >= count)], new[~(once & (pairs[new, 0] >= count))]])
        numbers[new] = count + np.arange(len(new))
        corners = numbers[pair_of.ravel()].astype(np.int32)
        return cls(Polygons(corners, faces.sizes), pairs[new, 0], pairs[new, 1], first[new], points[pairs[new, 0]])


def filled(parts: Parts, surfaces: Sequence[NewMeshResult]) -> Parts:
    """Parts with the surfaces over holes of the welded mesh, all new vertices and faces behind those there are.

    A new face lies on the side of a seam that the face nearest to it lies on, and has the data of that one; where two
    sides meet, new vertices are parted as the old ones are.
    """
    points = np.concatenate([parts.points, *(each.vertices for each in surfaces)])
    rim = np.flatnonzero(np.isin(parts.triangles, np.concatenate([each.triangles for each in surfaces])).any(axis=1))
    sides = Sides.around(parts, rim)
    faces, beside = _pieces(parts, surfaces, points, rim)
    new = Parted.by(sides, faces, sides.of_rim[beside], points, len(parts.points))
    added = _rows(parts, sides, (points, Parts(points, faces).own), new)
    of_faces = parts.faces.face_of[rim[beside]]
    return _with(parts, parts.faces, new, added, np.append(np.arange(len(parts.faces.sizes)), of_faces))


def _with(parts: Parts, kept: Polygons, new: Parted, added: Data, like: IntArray) -> Parts:
    """Faces that are kept, and new ones; ``like``: the old face whose data each has."""
    of_vertices = {name: np.concatenate([values, added[name]]) for name, values in parts.vertex_data.items()}
    if PLACE in of_vertices:  # new vertices that are copies of old ones have the numbers of these
        values, old = parts.vertex_data[PLACE], new.places < len(parts.points)
        beyond = values.max(initial=-1) + 1 + new.places - len(values)
        numbers = np.where(old, values[np.where(old, new.places, 0)], beyond)
        of_vertices[PLACE] = np.append(values, numbers).astype(values.dtype)
    of_faces = {name: values[like] for name, values in parts.face_data.items()}
    points = np.concatenate([parts.points, new.points])
    return Parts(points, Polygons.joined([kept, new.faces]), of_vertices, of_faces)


def _pieces(
    parts: Parts, surfaces: Sequence[NewMeshResult], points: FloatArray, rim: IntArray
) -> tuple[Polygons, IntArray]:
    """The new faces, and of each which of the triangles ``rim`` is the nearest one around the same hole."""
    count = first = len(parts.points)
    pieces, under = [], []
    for each in surfaces:
        own = [each.triangles] if each.quads is None else [each.quads.quads, each.quads.triangles]
        piece = Polygons.joined([Polygons.of(rows) for rows in own if len(rows)])
        piece = Polygons(np.where(piece.corners < count, piece.corners, piece.corners + first - count), piece.sizes)
        first += len(each.vertices)
        near = np.flatnonzero(np.isin(parts.triangles[rim], piece.corners).any(axis=1))
        middles = np.add.reduceat(points[piece.corners], piece.first) / piece.sizes[:, None]
        pieces.append(piece)
        under.append(near[nearest(middles, parts.points[parts.own[rim[near]]].mean(axis=1))])
    return Polygons.joined(pieces), np.concatenate(under)


def _rows(parts: Parts, sides: Sides, surface: tuple[FloatArray, IntArray], new: Parted) -> Data:
    """What is stored at the new vertices of a surface, spread from the vertices of their sides."""
    points, triangles = surface
    held = np.unique(triangles[triangles < len(parts.points)])
    everywhere = dict(zip(held.tolist(), held.tolist(), strict=True))
    found = {}
    for name, values in parts.vertex_data.items():
        found[name] = np.empty((len(new.places), *values.shape[1:]), values.dtype)
        differs = any((values[v] != values[p]).any() for each in sides.copies.values() for p, v in each.items())
        for side in np.unique(new.side).tolist() if differs else [-1]:
            mine = new.side == side if differs else slice(None)
            own = {p: v for p, v in sides.copies.get(side, {}).items() if p in everywhere}
            copies = own if differs and own else everywhere
            pins, rows = np.array(list(copies)), values[list(copies.values())]
            around = np.unique(sides.corners[sides.of_rim == side]) if differs else None
            trend = (points[around], values[around]) if differs else None
            with suppress(SolverError):  # over triangles without area nothing spreads
                if mixes(rows):
                    found[name][mine] = spread(surface, (pins, rows), held, trend)[new.places[mine]]
                    continue
            found[name][mine] = rows[nearest(points[new.places[mine]], points[pins])]
    return found


def rounded(parts: Parts, result: FilletResult) -> tuple[Parts, int]:
    """Parts with a fillet in place of what is gone, without vertices that only this had, and how many old ones stay.

    A vertex that new faces on two sides of a seam share is parted, as the old ones are.
    """
    count = len(parts.points)
    faces, under = Polygons.of(result.triangles), result.parent
    if result.quads is not None:
        faces = Polygons.joined([Polygons.of(result.quads.triangles), Polygons.of(result.quads.quads)])
        under = np.concatenate([under[result.quads.rest], under[result.quads.pairs[:, 0]]])
    near = np.unique(np.concatenate([result.gone, under, result.origin[0]]))
    sides = Sides.around(parts, near)
    points = np.concatenate([parts.points, result.vertices])
    new = Parted.by(sides, faces, sides.of_rim[np.searchsorted(near, under)], points, count)
    below = np.repeat(under, faces.sizes)[new.corner]
    weights = _barycentric(new.points, parts.points[parts.own[below]])
    fresh = np.flatnonzero(new.places >= count)
    triangles, known = (each[new.places[fresh] - count] for each in result.origin)
    mine = sides.of_rim[np.searchsorted(near, triangles)] == new.side[fresh]
    below[fresh[mine]], weights[fresh[mine]] = triangles[mine], known[mine]
    added = mixed(parts.vertex_data, parts.own[below], weights)
    whole = np.ones(len(parts.faces.sizes), dtype=bool)
    whole[parts.faces.face_of[result.gone]] = False
    halves = np.setdiff1d(np.flatnonzero(~whole[parts.faces.face_of]), result.gone)
    kept = Polygons.joined([parts.faces.chosen(whole), Polygons.of(parts.own[halves])])
    old = np.concatenate([np.flatnonzero(whole), parts.faces.face_of[halves], parts.faces.face_of[under]])
    made = _with(parts, kept, new, added, old)
    used = np.isin(np.arange(len(made.points)), made.faces.corners)
    used[:count] |= ~np.isin(np.arange(count), parts.faces.corners)
    faces = Polygons((np.cumsum(used) - 1)[made.faces.corners].astype(np.int32), made.faces.sizes)
    data = {name: values[used] for name, values in made.vertex_data.items()}
    return Parts(made.points[used], faces, data, made.face_data), int(used[:count].sum())


def _barycentric(at: FloatArray, triangles: FloatArray) -> FloatArray:
    """(k, 3) weights of the corners (k, 3, 3) at the feet of places (k, 3) in their planes."""
    a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normal = np.cross(a, b)
    away = at - triangles[:, 0]
    parts = np.stack([np.cross(away, b), np.cross(a, away)], axis=1) @ normal[:, :, None]
    second, third = (parts[:, :, 0] / np.maximum((normal**2).sum(axis=1), 1e-300)[:, None]).T
    return np.column_stack([1 - second - third, second, third])


Array = npt.NDArray[Any]
_NORMALS = {"normals", "normal", "vertex_normals"}


def spread(
    surface: tuple[FloatArray, IntArray], pins: tuple[IntArray, Array], held: IntArray,
    trend: tuple[FloatArray, Array] | None,
) -> Array:  # fmt: skip
    """Values at all vertices of a surface, spread from its boundary ``held`` inwards as heat would.

    ``pins``: the vertices of ``held`` with a value, and their values. ``trend``: places and values around; a linear
    function fitted to them goes on where ``held`` has no value, and the rest spreads.
    """
    points, triangles = surface
    flat = pins[1].reshape(len(pins[0]), -1).astype(np.float64)
    base, rest = np.zeros((len(points), flat.shape[1])), np.zeros((len(held), flat.shape[1]))
    if trend is not None:
        middle = trend[0].mean(axis=0)
        rows = trend[1].reshape(len(trend[0]), -1).astype(np.float64)
        slope, *_ = np.linalg.lstsq(np.insert(trend[0] - middle, 3, 1.0, axis=1), rows, rcond=1e-6)
        base = np.insert(points - middle, 3, 1.0, axis=1) @ slope
    rest[np.searchsorted(held, pins[0])] = flat - base[pins[0]]
    return _like(interpolate(points, triangles, held, rest) + base, pins[1])


def mixed(data: Data, corners: IntArray, weights: FloatArray) -> Data:
    """Data of vertices that lie at these corners (k, 3) with these weights (k, 3)."""
    nearest_corner = corners[np.arange(len(corners)), weights.argmax(axis=1)]
    rows: Data = {}
    for name, values in data.items():
        flat = values.reshape(len(values), -1)
        rows[name] = values[nearest_corner]
        if mixes(values):
            rows[name] = _like(np.einsum("kc,kcd->kd", weights, flat[corners].astype(np.float64)), values)
    return rows


def with_normals(made: Parts, moved: IntArray) -> Parts:
    """The same with normals that are stored at vertices renewed where these vertices and their neighbours moved.

    Where one place has several, as along hard edges, each is that of its own faces.
    """
    stored = [name for name, values in made.vertex_data.items() if is_normal(name, values)]
    if not stored or not len(moved):
        return made
    near = np.unique(made.triangles[np.isin(made.triangles, made.same[moved]).any(axis=1)])
    touched = np.flatnonzero(np.isin(made.same, near))
    smooth = _normals(made.points, made.triangles)[made.same[touched]]
    own = _normals(made.points, made.own)[touched]
    data = dict(made.vertex_data)
    for name in stored:
        data[name] = values = data[name].copy()
        hard = np.zeros(len(values), dtype=bool)
        hard[made.same[(values != values[made.same]).any(axis=1)]] = True
        values[touched] = np.where(hard[made.same[touched], None], own, smooth)
    return Parts(made.points, made.faces, data, made.face_data)


def _normals(points: FloatArray, triangles: IntArray) -> FloatArray:
    """(n, 3) of any triangles, by their areas: files have some that join in no manifold."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    sums = np.zeros_like(points)
    np.add.at(sums, triangles, np.cross(b - a, c - a)[:, None])
    return sums / np.maximum(np.linalg.norm(sums, axis=1, keepdims=True), np.finfo(float).tiny)


def is_normal(name: str, values: Array) -> bool:
    return name.lower() in _NORMALS and values.dtype.kind == "f" and values.shape[1:] == (3,)


def mixes(values: Array) -> bool:
    """Whether a mean of two has a meaning: real numbers, and bytes, which are colours."""
    return values.dtype == np.uint8 or (values.dtype.kind == "f" and bool(np.isfinite(values).all()))


def _like(rows: FloatArray, values: Array) -> Array:
    """(k, c) numbers in the type and with the columns of the values."""
    shaped = rows.reshape(-1, *values.shape[1:])
    return (np.clip(np.rint(shaped), 0, 255) if values.dtype == np.uint8 else shaped).astype(values.dtype)
