"""A picture of new faces: Blender's Grid Fill, its QuadriFlow, and rows, over the same holes."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

import fairing
import holes
import peers
import real_meshes
from cases import Hole
from holes import FloatArray, IntArray
from judged import Faces
from picture_sheet import save_sheet
from rasteriser import View
from stripes import Layer, facing, render

TILE = 250
AROUND, NEW = (0.9, 0.9, 0.9), (0.5, 0.75, 1.0)
PATCHES = (("ict_head", 4805, 4.1), ("mh_body", 1701, 1.02), ("penguin", 82, 0.267))
NAMES = ("Grid Fill", "QuadriFlow, Preserve Boundary", "Fair Fill, Quads")


def shown() -> Iterator[Hole]:
    """Half a ball, and three discs of real meshes."""
    points, around = holes.bowl(32)
    yield Hole("half a ball", points, around, np.arange(32))
    for name, seed, radius in PATCHES:
        patch = real_meshes.make_patch(name, name, seed, radius)
        assert patch is not None
        loop = patch.vertices_in_mesh[fairing.boundary_loops(patch.triangles)[0]]
        yield Hole(name, patch.whole, patch.outside, loop)


def save(path: Path) -> None:
    """A column for each hole, a row for each way."""
    columns = [list(_tiles(hole)) for hole in shown()]
    save_sheet([[(tile, name) for tile in row] for name, *row in zip(NAMES, *columns, strict=True)], path)


def _tiles(hole: Hole) -> Iterator[FloatArray]:
    result = fairing.fill(hole.points, hole.outside, [hole.loop], faces="quads", edges="ignored")
    assert result.quads is not None
    whole = np.concatenate([hole.points, result.vertices])
    faces = result.quads.quads.tolist() + result.quads.triangles.tolist()
    view = _view(hole, whole, result.triangles)
    count = len(faces)
    for call in (peers.grid_fill, peers.blender_quadriflow):
        made = call(hole, count)
        yield _picture(hole, view, *((np.zeros((0, 3)), []) if made is None else made[:2]))
    yield _picture(hole, view, whole, faces)


def _view(hole: Hole, whole: FloatArray, triangles: IntArray) -> View:
    rim = hole.points[hole.loop]
    a, b, c = np.moveaxis(whole[triangles], 1, 0)
    ahead = np.cross(b - a, c - a).sum(axis=0)
    ahead /= np.linalg.norm(ahead)
    aside = np.cross(ahead, [0.3, 0.5, 0.8])
    reach = 1.25 * float(np.linalg.norm(rim - rim.mean(axis=0), axis=1).max())
    return facing(ahead + 0.6 * aside / np.linalg.norm(aside), whole[np.unique(triangles)].mean(axis=0), reach)


def _picture(hole: Hole, view: View, points: FloatArray, faces: Faces) -> FloatArray:
    near = np.linalg.norm(hole.points - view.target, axis=1) < 1.5 * view.width
    layers = [Layer(hole.points, hole.outside[near[hole.outside].all(axis=1)], AROUND, wire=True)]
    quads = np.array([face for face in faces if len(face) == 4], dtype=np.int64).reshape(-1, 4)
    rest = np.array([face for face in faces if len(face) == 3], dtype=np.int64).reshape(-1, 3)
    halves = quads[:, [0, 1, 3, 2, 3, 1]].reshape(-1, 3)
    if len(faces):
        layers.append(Layer(points, np.concatenate([halves, rest]), NEW, wire=True, halves=len(halves)))
    return render(layers, view, TILE)
