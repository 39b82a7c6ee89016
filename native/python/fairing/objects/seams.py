"""Seams across holes: files part vertices where texture coordinates or materials end; surfaces go on over them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from fairing._new_mesh import FilletResult, NewMeshResult
from fairing._types import FloatArray, IntArray
from fairing.objects.data import is_normal, mixed, mixes, nearest, spread
from fairing.objects.parts import PLACE, Data, Parts, Polygons, alike


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


def filled(parts: Parts, surfaces: Sequence[NewMeshResult]) -> Parts:
    """Parts with the surfaces over holes of the welded mesh, all new vertices and faces behind those there are.

    A new face lies on the side of a seam that the face nearest to it lies on, and has the data of that one; where two
    sides meet, new vertices are parted as the old ones are.
    """
    count = len(parts.points)
    points = np.concatenate([parts.points, *(each.vertices for each in surfaces)])
    rim = np.flatnonzero(np.isin(parts.triangles, np.concatenate([each.triangles for each in surfaces])).any(axis=1))
    sides = Sides.around(parts, rim)
    faces, beside = _pieces(parts, surfaces, points, rim)
    surface = Parts(points, faces).own
    on_sides = np.column_stack([faces.corners, np.repeat(sides.of_rim[beside], faces.sizes)])
    pairs, pair_of = np.unique(on_sides, axis=0, return_inverse=True)
    numbers = np.array([sides.copies[s].get(v, -1) for v, s in pairs.tolist()])
    inner, firsts = np.unique(pairs[:, 0], return_index=True)
    numbers[firsts[inner >= count]] = inner[inner >= count]
    again = np.flatnonzero(numbers < 0)  # places that a second side needs
    numbers[again] = len(points) + np.arange(len(again))
    side = np.full(len(points) - count, sides.of_rim[0])
    side[inner[inner >= count] - count] = pairs[firsts[inner >= count], 1]
    places = np.concatenate([np.arange(count, len(points)), pairs[again, 0]])
    added = _rows(parts, sides, (points, surface), places, np.concatenate([side, pairs[again, 1]]))
    of_faces = {
        name: np.concatenate([values, values[parts.faces.face_of[rim[beside]]]])
        for name, values in parts.face_data.items()
    }
    whole = Polygons.joined([parts.faces, Polygons(numbers[pair_of.ravel()].astype(np.int32), faces.sizes)])
    of_vertices = {name: np.concatenate([values, added[name]]) for name, values in parts.vertex_data.items()}
    return Parts(np.concatenate([points, points[pairs[again, 0]]]), whole, of_vertices, of_faces)


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


def _rows(parts: Parts, sides: Sides, surface: tuple[FloatArray, IntArray], places: IntArray, of: IntArray) -> Data:
    """What is stored at new vertices: in these ``places`` (k,) of the surface, on these sides (k,)."""
    points, triangles = surface
    held = np.unique(triangles[triangles < len(parts.points)])
    everywhere = dict(zip(held.tolist(), held.tolist(), strict=True))
    found = {
        name: np.empty((len(places), *values.shape[1:]), values.dtype) for name, values in parts.vertex_data.items()
    }
    for name, values in parts.vertex_data.items():
        if name == PLACE:
            found[name] = _new_places(values, places)
            continue
        differs = any((values[v] != values[p]).any() for each in sides.copies.values() for p, v in each.items())
        for side in np.unique(of).tolist() if differs else [-1]:
            mine = of == side if differs else slice(None)
            own = {p: v for p, v in sides.copies.get(side, {}).items() if p in everywhere}
            copies = own if differs and own else everywhere
            pins, rows = np.array(list(copies)), values[list(copies.values())]
            if not mixes(rows):
                found[name][mine] = rows[nearest(points[places[mine]], points[pins])]
                continue
            around = np.unique(sides.corners[sides.of_rim == side]) if differs else None
            trend = (points[around], values[around]) if differs else None
            found[name][mine] = spread(surface, (pins, rows), held, trend)[places[mine]]
    return found


def _new_places(values: IntArray, vertices: IntArray) -> IntArray:
    """The numbers in a file of new vertices, which are those of old ones where they are copies of these."""
    old = vertices < len(values)
    beyond = values.max(initial=-1) + 1 + vertices - len(values)
    return np.where(old, values[np.where(old, vertices, 0)], beyond).astype(values.dtype)


def rounded(parts: Parts, result: FilletResult) -> tuple[Parts, int]:
    """Parts with a fillet in place of what is gone, without vertices that only this had, and how many old ones stay.

    A vertex that new faces on two sides of a seam share is parted, as the old ones are.
    """
    count = len(parts.points)
    faces, under = Polygons.of(result.triangles), result.parent
    if result.quads is not None:
        faces = Polygons.joined([Polygons.of(result.quads.triangles), Polygons.of(result.quads.quads)])
        under = np.concatenate([under[result.quads.rest], under[result.quads.pairs[:, 0]]])
    corners, again, added = _on_their_sides(parts, result, faces, under)
    whole = np.ones(len(parts.faces.sizes), dtype=bool)
    whole[parts.faces.face_of[result.gone]] = False
    halves = np.setdiff1d(np.flatnonzero(~whole[parts.faces.face_of]), result.gone)
    faces = Polygons.joined([parts.faces.chosen(whole), Polygons.of(parts.own[halves]), Polygons(corners, faces.sizes)])
    old = np.concatenate([np.flatnonzero(whole), parts.faces.face_of[halves], parts.faces.face_of[under]])
    of_faces = {name: values[old] for name, values in parts.face_data.items()}
    points = np.concatenate([parts.points, result.vertices, result.vertices[again - count]])
    used = np.isin(np.arange(len(points)), faces.corners)
    used[:count] |= ~np.isin(np.arange(count), parts.faces.corners)
    of_vertices = {name: np.concatenate([values, added[name]])[used] for name, values in parts.vertex_data.items()}
    faces = Polygons((np.cumsum(used) - 1)[faces.corners].astype(np.int32), faces.sizes)
    return Parts(points[used], faces, of_vertices, of_faces), int(used[:count].sum())


def _on_their_sides(
    parts: Parts, result: FilletResult, faces: Polygons, under: IntArray
) -> tuple[IntArray, IntArray, Data]:
    """The corners of a fillet's faces, new vertices that stand there once more, and the data of all new ones.

    ``under``: the old triangle of each face.
    """
    count, (triangles, weights) = len(parts.points), result.origin
    rows = mixed(parts.vertex_data, parts.own[triangles], weights)
    near = np.unique(np.concatenate([result.gone, under, triangles]))
    sides = Sides.around(parts, near)
    below = np.repeat(under, faces.sizes)
    side = sides.of_rim[np.searchsorted(near, below)]
    own = np.concatenate([np.full(count, -1), sides.of_rim[np.searchsorted(near, triangles)]])
    corners = faces.corners.copy()
    for k in np.flatnonzero(own[corners] != side).tolist() if len(sides.copies) > 1 else []:
        corners[k] = sides.copies[side[k]].get(corners[k], corners[k])
    other = np.flatnonzero((corners >= count) & (own[corners] != side))
    at = np.einsum("kc,kcd->kd", weights, parts.points[parts.own[triangles]])[corners[other] - count]
    there = mixed(parts.vertex_data, parts.own[below[other]], _barycentric(at, parts.points[parts.own[below[other]]]))
    differs = np.zeros(len(other), dtype=bool)
    for name, values in there.items():
        if values.dtype.kind in "uif" and not is_normal(name, values) and name != PLACE:
            gap = np.abs(values.astype(float) - rows[name][corners[other] - count])
            differs |= (gap > 1e-3 * np.ptp(rows[name].astype(float))).any(axis=tuple(range(1, gap.ndim)))
    other, first = other[differs], np.flatnonzero(differs)
    _, one, number = np.unique(
        np.column_stack([corners[other], side[other]]), axis=0, return_index=True, return_inverse=True
    )
    again = corners[other[one]]
    corners[other] = count + len(result.vertices) + number.ravel()
    data = {name: np.concatenate([values, there[name][first[one]]]) for name, values in rows.items()}
    if PLACE in data:
        new = np.arange(count, count + len(result.vertices))
        data[PLACE] = _new_places(parts.vertex_data[PLACE], np.concatenate([new, again]))
    return corners, again, data


def _barycentric(at: FloatArray, triangles: FloatArray) -> FloatArray:
    """(k, 3) weights of the corners (k, 3, 3) at the feet of places (k, 3) in their planes."""
    a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    normal = np.cross(a, b)
    size = np.maximum((normal**2).sum(axis=1), 1e-300)
    away = at - triangles[:, 0]
    second = (np.cross(away, b) * normal).sum(axis=1) / size
    third = (np.cross(a, away) * normal).sum(axis=1) / size
    return np.column_stack([1 - second - third, second, third])
