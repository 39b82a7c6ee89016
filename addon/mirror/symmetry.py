"""Blender's X mirror: which vertex of a patch is the mirror image of which.

Positions decide on the boundary alone. Inside, connectivity does: what lies there may be anything.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import product

import numpy as np

from ..arrays.places import edge_keys, numbers_in
from ..arrays.region import MeshArrays, Patch, Reflection
from ..arrays.types import Floats, Ints, Mask
from ..words.words import said

NEAR = 2e-5  # as far as Blender's own X mirror looks, in the mesh's own units
FLIP = np.array([-1.0, 1.0, 1.0])
ACROSS_X = Reflection(np.diag([*FLIP, 1.0]), 2.0 * NEAR)

NOT_SYMMETRIC = said("not_symmetric")

Loop = Sequence[int]
Edge = tuple[int, int]
Box = tuple[float, ...]


def mirror_map(mesh: MeshArrays, patch: Patch) -> Ints | None:
    """Return (p,): the patch vertex across x = 0 of each patch vertex, or None where there is none.

    mesh: in its own coordinates. None: the boundary, the connectivity or the free vertices aren't
    symmetric, so the whole patch isn't.
    """
    rim = (mesh.positions[patch.vertices[patch.boundary]], patch.boundary)
    images = _images(rim, rim)
    if images is None:
        return None
    loops = _faces(mesh, patch)
    face_of = {edge: face for face, loop in enumerate(loops) for edge in _sides(loop)}
    found = _spread(images, loops, face_of, face_of)
    if found is None or len(found) != len(patch.vertices):
        return None
    image = np.array([found[v] for v in range(len(found))], dtype=np.int64)
    is_free = np.zeros(len(image), dtype=bool)
    is_free[patch.free] = True
    if (image[image] != np.arange(len(image))).any() or (is_free != is_free[image]).any():
        return None
    return image


def mirrored(
    mesh: MeshArrays, patch: Patch, fair: Floats, band: tuple[Ints, Ints] | None = None
) -> tuple[Floats, tuple[str, ...]]:
    """Make the positions (q, 3) of the patch and what is around it symmetric where the mesh asks for that.

    band: the mesh vertices (q,), and which of them move (k,), if some around the patch do. A patch without boundary
    stays as it is: nothing tells where its plane is.
    """
    if not mesh.mirror_x or not len(patch.boundary):
        return fair, ()
    image = mirror_map(mesh, patch)
    if image is not None and band is not None:
        image = _with_band(image, mesh.positions[band[0]], band[1])
    if image is None:
        return fair, (said("patch_not_symmetric"),)
    whole = fair.copy()
    whole[: len(image)] = symmetrised(fair[: len(image)], image)
    return whole, ()


def _with_band(image: Ints, points: Floats, moving: Ints) -> Ints | None:
    """Return (q,): the patch's images (p,) followed by those of the vertices around it, of which some move too.

    points: (q, 3) before, in the mesh's own coordinates; they decide outside the patch. None where what moves isn't
    symmetric. A vertex outside that stays is its own image.
    """
    whole = np.concatenate([image, np.arange(len(image), len(points))])
    band = moving[moving >= len(image)]
    images = _images((points[band], band), (points[band], band))
    if images is None:
        return None
    whole[band] = [images[vertex] for vertex in band.tolist()]
    symmetric = (
        np.array_equal(np.sort(whole[moving]), np.sort(moving)) and (whole[whole] == np.arange(len(whole))).all()
    )
    return whole if symmetric else None


def with_image(mesh: MeshArrays) -> MeshArrays:
    """Return a mesh that asks for symmetry with the mirror image of its patch in the patch, where there is one.

    The boundary decides by its places, the inside by its connectivity. As it is where the patch meets its image.
    """
    if not mesh.mirror_x or not mesh.in_patch.any():
        return mesh
    image = _image_faces(mesh)
    if image is None or mesh.in_patch[image].any():
        return mesh
    both = mesh.in_patch.copy()
    both[image] = True
    return replace(mesh, in_patch=both)


def vertices_with_image(mesh: MeshArrays, chosen: Mask) -> Mask:
    """Return the (n,) mask with the mirror images of its vertices where the mesh asks for symmetry and has them."""
    vertices = np.flatnonzero(chosen)
    images = _images_in(mesh, vertices) if mesh.mirror_x else None
    return chosen if images is None else chosen | np.isin(np.arange(len(chosen)), images)


def edges_with_image(mesh: MeshArrays, chosen: Mask) -> Mask:
    """Return the (e,) mask likewise with the images of its edges."""
    ends = np.unique(mesh.edges[chosen])
    images = _images_in(mesh, ends) if mesh.mirror_x else None
    if images is None:
        return chosen
    across = images[np.searchsorted(ends, mesh.edges[chosen])]
    both: Mask = chosen | np.isin(edge_keys(mesh.edges), edge_keys(across))
    return both


def _images_in(mesh: MeshArrays, vertices: Ints) -> Ints | None:
    """Return (k,) the mirror images of vertices (k,); None where one has none."""
    found = _images((mesh.positions[vertices], vertices), (mesh.positions, np.arange(len(mesh.positions))))
    return None if found is None else np.array([found[vertex] for vertex in vertices.tolist()], dtype=np.int64)


def _image_faces(mesh: MeshArrays) -> Ints | None:
    """Return the faces across x = 0 of those of the patch."""
    starts = np.flatnonzero(np.diff(mesh.corner_faces)) + 1
    loops: list[Loop] = [loop.tolist() for loop in np.split(mesh.corner_vertices, starts)]
    face_of = {edge: face for face, loop in enumerate(loops) for edge in _sides(loop)}
    own = {edge: face for edge, face in face_of.items() if mesh.in_patch[face]}
    rim = np.unique([vertex for edge in own if edge[::-1] not in own for vertex in edge]).astype(np.int64)
    images = _images((mesh.positions[rim], rim), (mesh.positions, np.arange(len(mesh.positions))))
    found = _spread(images, loops, own, face_of) if images is not None else None
    if found is None or not all(vertex in found for edge in own for vertex in edge):
        return None
    return np.unique([face_of[found[b], found[a]] for a, b in own])


def symmetrised(positions: Floats, image: Ints) -> Floats:
    """Return the mean of the positions (p, 3) and their mirror image: symmetric to the last bit."""
    mean: Floats = 0.5 * (positions + FLIP * positions[image])
    return mean


Points = tuple[Floats, Ints]  # places (k, 3) and vertices (k,)


def _images(rim: Points, among: Points) -> dict[int, int] | None:
    """Return the mirror image of each vertex of the rim, the nearest one to it, None where one is missing."""
    points, vertices = among
    box = _boxes(points)
    images = {}
    for vertex, point in zip(rim[1].tolist(), rim[0] * FLIP, strict=True):
        near = [k for corner in _corners(point) for k in box.get(corner, ())]
        distances = np.linalg.norm(points[near] - point, axis=1)
        if not (distances <= NEAR).any():
            return None
        images[vertex] = int(vertices[near[int(distances.argmin())]])
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
    number = numbers_in(patch.vertices, len(mesh.positions))
    chosen = mesh.in_patch[mesh.corner_faces]
    starts = np.flatnonzero(np.diff(mesh.corner_faces[chosen])) + 1
    return [loop.tolist() for loop in np.split(number[mesh.corner_vertices[chosen]], starts)]


def _sides(loop: Loop) -> Iterator[Edge]:
    return zip(loop, (*loop[1:], loop[0]), strict=True)


def _spread(
    image: dict[int, int], loops: list[Loop], own: dict[Edge, int], face_of: dict[Edge, int]
) -> dict[int, int] | None:
    """Carry the images from the boundary's edges across face after face; None at a contradiction.

    own: the face of each directed edge of the patch; face_of: the same where images are looked for.
    """
    image = dict(image)
    borders = [edge for edge in own if edge[::-1] not in own and edge[0] in image and edge[1] in image]
    queue = deque(borders)
    done: set[int] = set()
    while queue:
        a, b = queue.popleft()
        face = own[a, b]
        if face in done:
            continue
        done.add(face)
        other = face_of.get((image[b], image[a]))
        if other is None or not _match(image, _from(loops[face], a), _backwards(loops[other], image[a])):
            return None
        queue.extend(edge[::-1] for edge in _sides(loops[face]) if edge[::-1] in own)
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
