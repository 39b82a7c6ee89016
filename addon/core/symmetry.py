"""Blender's X mirror: which vertex of a patch is the mirror image of which.

Positions decide on the outline alone. Inside, connectivity does: what lies there may be anything.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from itertools import product

import numpy as np

from .arrays import Floats, Ints
from .region import MeshArrays, Patch

NEAR = 2e-5  # as far as Blender's own X mirror looks, in the mesh's own units
FLIP = np.array([-1.0, 1.0, 1.0])

Loop = Sequence[int]
Edge = tuple[int, int]
Box = tuple[float, ...]


def mirror_map(mesh: MeshArrays, patch: Patch) -> Ints | None:
    """Return (p,): the patch vertex across x = 0 of each patch vertex, or None where there is none.

    mesh: in its own coordinates. None: the outline, the connectivity or the free vertices aren't
    symmetric, so the whole patch isn't.
    """
    images = _outline_images(mesh.positions[patch.vertices[patch.outline]], patch.outline)
    if images is None:
        return None
    loops = _faces(mesh, patch)
    found = _spread(images, loops, {edge: face for face, loop in enumerate(loops) for edge in _sides(loop)})
    if found is None or len(found) != len(patch.vertices):
        return None
    image = np.array([found[v] for v in range(len(found))], dtype=np.int64)
    is_free = np.zeros(len(image), dtype=bool)
    is_free[patch.free] = True
    if (image[image] != np.arange(len(image))).any() or (is_free != is_free[image]).any():
        return None
    return image


def symmetrised(positions: Floats, image: Ints) -> Floats:
    """Return the mean of the positions (p, 3) and their mirror image: symmetric to the last bit."""
    mean: Floats = 0.5 * (positions + FLIP * positions[image])
    return mean


def _outline_images(points: Floats, outline: Ints) -> dict[int, int] | None:
    """Return the mirror image of each outline vertex, the nearest one to it, None where one is missing."""
    mirrored = points * FLIP
    box = _boxes(points)
    images = {}
    for vertex, point in zip(outline.tolist(), mirrored, strict=True):
        near = [k for corner in _corners(point) for k in box.get(corner, ())]
        distances = np.linalg.norm(points[near] - point, axis=1)
        if not (distances <= NEAR).any():
            return None
        images[vertex] = int(outline[near[int(distances.argmin())]])
    return images


def _boxes(points: Floats) -> dict[Box, list[int]]:
    """Sort the points (k, 3) into boxes that are twice NEAR wide."""
    found: dict[Box, list[int]] = {}
    for k, row in enumerate(np.floor(points / (2.0 * NEAR)).tolist()):
        found.setdefault(tuple(row), []).append(k)
    return found


def _corners(point: Floats) -> set[Box]:
    """Return the boxes that may hold points within NEAR of a point (3,)."""
    low, high = (np.floor((point + shift) / (2.0 * NEAR)).tolist() for shift in (-NEAR, NEAR))
    return set(product(*zip(low, high, strict=True)))


def _faces(mesh: MeshArrays, patch: Patch) -> list[Loop]:
    """Return the polygons of the patch as loops of patch indices."""
    number = np.full(len(mesh.positions), -1, dtype=np.int64)
    number[patch.vertices] = np.arange(len(patch.vertices))
    chosen = mesh.in_patch[mesh.corner_faces]
    starts = np.flatnonzero(np.diff(mesh.corner_faces[chosen])) + 1
    return [loop.tolist() for loop in np.split(number[mesh.corner_vertices[chosen]], starts)]


def _sides(loop: Loop) -> Iterator[Edge]:
    return zip(loop, (*loop[1:], loop[0]), strict=True)


def _spread(image: dict[int, int], loops: list[Loop], face_of: dict[Edge, int]) -> dict[int, int] | None:
    """Carry the images from the outline's edges across face after face; None at a contradiction."""
    image = dict(image)
    borders = [edge for edge in face_of if edge[::-1] not in face_of and edge[0] in image and edge[1] in image]
    queue = deque(borders)
    done: set[int] = set()
    while queue:
        a, b = queue.popleft()
        face = face_of[a, b]
        if face in done:
            continue
        done.add(face)
        other = face_of.get((image[b], image[a]))
        if other is None or not _match(image, _from(loops[face], a), _backwards(loops[other], image[a])):
            return None
        queue.extend(edge[::-1] for edge in _sides(loops[face]) if edge[::-1] in face_of)
    return image


def _from(loop: Loop, start: int) -> Loop:
    at = loop.index(start)
    return (*loop[at:], *loop[:at])


def _backwards(loop: Loop, start: int) -> Loop:
    return _from(loop[::-1], start)


def _match(image: dict[int, int], loop: Loop, mirrored: Loop) -> bool:
    """Pair the corners of a face with those of its mirror image; False at a contradiction."""
    if len(loop) != len(mirrored):
        return False
    return all(image.setdefault(vertex, other) == other for vertex, other in zip(loop, mirrored, strict=True))
