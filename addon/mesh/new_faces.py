"""New vertices and faces in a bmesh, with what belongs to them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arrays.types import Floats, Ints
from ..words.sentences import doubled
from .layers import OF_CORNERS, OF_VERTICES, MeanLayers, Shapes, Weights, copied_layers, copy
from .live_mesh import LAYER
from .set_aside import ROW
from .target import Target

Carrier = Callable[[Floats], Floats]  # from values at the sources (n, w) to values at new elements


@dataclass(frozen=True)
class VertexData:
    """k new vertices and what they are made of."""

    positions: Floats  # (k, 3) local
    sources: Sequence[Any]  # vertices
    carry: Carrier  # to (k, w)
    examples: Sequence[Any]  # (k,) vertices
    before: Floats | None = None  # (k, 3) where they were on an old surface, which other shape keys than a Basis keep
    keyed: Callable[[Shapes, Floats, Floats], Floats] | None = None  # better offsets than those carried, from starts


@dataclass(frozen=True)
class FaceData:
    """m new faces over `stay` and then the new vertices."""

    stay: Sequence[Any]  # vertices
    polygons: list[list[int]]
    sources: Sequence[Any]  # corners
    carry: Carrier  # to (u, w)
    numbers: list[int]  # of the rows of these, for each new corner, face after face
    corner_examples: Sequence[Any]  # for each new corner
    examples: Sequence[Any]  # (m,) faces
    in_live: bool = False  # whether new faces are in the live region where their examples are


def make_vertices(target: Target, data: VertexData) -> list[Any]:
    """Make them in an open target; return them."""
    bm, shapes = target.bm, target.shapes
    layers, aside = MeanLayers(bm.verts.layers, OF_VERTICES), target.aside.part(bm, "POINT")
    weights = Weights(bm, data.sources)
    members = weights.read(data.sources)
    read = (layers.read(data.sources), aside.read(data.sources), members, shapes.offsets(data.sources))
    values = data.carry(np.concatenate(read, axis=1))
    made = []
    for position, example in zip(data.positions.tolist(), data.examples, strict=True):
        vertex = bm.verts.new(position, example)
        vertex.hide = False
        made.append(vertex)
    own, more, groups, offsets = np.split(values, np.cumsum([part.shape[1] for part in read[:-1]]), axis=1)
    layers.write(made, own)
    aside.write(made, more)
    weights.write(made, weights.limited(groups, members, target.bones))
    # As Blender keeps them.
    starts: Floats = data.positions.astype(np.float32).astype(np.float64)
    if data.before is not None and not shapes.follow:
        starts = data.before
    if data.keyed is not None:
        offsets = data.keyed(shapes, starts, offsets)
    shapes.write(made, offsets, starts)
    return made


def make_faces(target: Target, vertices: Sequence[Any], data: FaceData) -> list[Any]:
    """Make them in an open target, over data.stay and these new vertices; return them."""
    bm = target.bm
    layers, aside = MeanLayers(bm.loops.layers, OF_CORNERS), target.aside.part(bm, "CORNER")
    values = data.carry(np.concatenate([layers.read(data.sources), aside.read(data.sources)], axis=1))
    live = None if data.in_live else bm.faces.layers.int.get(LAYER)
    table = [*data.stay, *vertices]
    made = []
    for polygon, example in zip(data.polygons, data.examples, strict=True):
        face = bm.faces.new([table[corner] for corner in polygon], example)
        face.hide = False
        if live is not None:
            face[live] = 0
        made.append(face)
    corners = [corner for face in made for corner in face.loops]
    copied = copied_layers(bm.loops.layers)
    if copied:
        copy(copied, data.corner_examples, corners)
    if layers.width:
        layers.write(corners, values[:, : layers.width], data.numbers)
    aside.write(corners, values[data.numbers, layers.width :])
    return made


def refuse_doubles(bm: Any, data: FaceData) -> None:
    """Raise MeshRefusal where a new face is there already, old or new, as no mesh has one twice: before any is made."""
    made = set()
    for polygon in data.polygons:
        corners = frozenset(polygon)
        if corners in made:
            raise doubled([data.stay[corner].index for corner in polygon if corner < len(data.stay)])
        made.add(corners)
        if max(polygon) >= len(data.stay):
            continue
        face = bm.faces.get([data.stay[corner] for corner in polygon])
        if face is not None:
            raise doubled([vertex.index for vertex in face.verts])


def kinds(target: Target, faces: Sequence[Any], corners: Sequence[Any] = ()) -> Ints:
    """Return (n,): equal numbers for faces that are equal in all that has no mean, and so are their corners.

    Faces have their indices.
    """
    bm = target.bm
    layers = [layer for layer in copied_layers(bm.faces.layers) if layer.name not in (LAYER, ROW + "FACE")]
    aside = target.aside.part(bm, "FACE").keys(np.array([face.index for face in faces], dtype=np.int64))
    keys = [
        (face.material_index, face.smooth, key, *(face[layer] for layer in layers))
        for face, key in zip(faces, aside, strict=True)
    ]
    of_corners = [layer for layer in copied_layers(bm.loops.layers) if layer.name != ROW + "CORNER"]
    if of_corners and corners:
        values = [tuple(corner[layer] for layer in of_corners) for corner in corners]
        keys = [key + more for key, more in zip(keys, values, strict=True)]
    numbers: dict[Any, int] = {}
    return np.array([numbers.setdefault(key, len(numbers)) for key in keys], dtype=np.int64)
