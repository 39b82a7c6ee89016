"""The two models of the demo: Suzanne with an ear selected, and a sphere with a spoilt half."""

from collections import defaultdict
from heapq import heappop, heappush

import bpy
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


def positions(mesh: bpy.types.Mesh) -> Floats:
    """Return the (n, 3) vertex positions."""
    flat = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", flat)
    return flat.reshape(-1, 3).astype(np.float64)


def _centres(mesh: bpy.types.Mesh) -> Floats:
    return np.array([polygon.center for polygon in mesh.polygons])


def _corners(mesh: bpy.types.Mesh) -> list[list[int]]:
    return [list(polygon.vertices) for polygon in mesh.polygons]


def _flood(mesh: bpy.types.Mesh, seed: int, within: Mask) -> Mask:
    """Return the faces in `within` that lead to the face `seed` by shared vertices."""
    corners = _corners(mesh)
    touched = np.zeros(len(mesh.vertices), dtype=bool)
    touched[corners[seed]] = True
    count = -1
    faces = np.zeros(len(corners), dtype=bool)
    while faces.sum() != count:
        count = faces.sum()
        for face in np.flatnonzero(within & ~faces):
            if touched[corners[face]].any():
                faces[face] = True
                touched[corners[face]] = True
    return faces


def _distances(mesh: bpy.types.Mesh, faces: Mask) -> Floats:
    """Return (n,): the length of the shortest path along edges from each vertex to the faces."""
    points = positions(mesh)
    links: dict[int, list[tuple[int, float]]] = defaultdict(list)
    for edge in mesh.edges:
        a, b = edge.vertices
        length = float(np.linalg.norm(points[a] - points[b]))
        links[a].append((b, length))
        links[b].append((a, length))
    distance = np.full(len(points), np.inf)
    corners = _corners(mesh)
    queue = [(0.0, v) for v in {v for face in np.flatnonzero(faces) for v in corners[face]}]
    while queue:
        so_far, vertex = heappop(queue)
        if so_far < distance[vertex]:
            distance[vertex] = so_far
            for other, length in links[vertex]:
                heappush(queue, (so_far + length, other))
    return distance


def ear_faces(mesh: bpy.types.Mesh, margin: float = 0.35) -> Mask:
    """Select Suzanne's ear on the +x side, outlined on the head around its root.

    A plane x = c cuts the ear off for c large; as c shrinks, the piece around the tip suddenly
    takes in the cheek. The last c before that is the root; the boundary is `margin` further on.
    """
    centres = _centres(mesh)
    tip = int(centres[:, 0].argmax())
    behind_cheek = centres[tip, 1] - 0.5
    low, high = 0.0, float(centres[tip, 0]) - 0.1
    for _ in range(6):
        middle = 0.5 * (low + high)
        piece = _flood(mesh, tip, centres[:, 0] > middle)
        if centres[piece, 1].min() < behind_cheek:
            low = middle
        else:
            high = middle
    distance = _distances(mesh, _flood(mesh, tip, centres[:, 0] > high))
    return np.array([distance[corners].max() < margin for corners in _corners(mesh)])


def suzanne() -> bpy.types.Object:
    """Add Blender's monkey, subdivided twice for good, shaded smooth."""
    bpy.ops.mesh.primitive_monkey_add()
    monkey = bpy.context.object
    modifier = monkey.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = 2
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    monkey.data.shade_smooth()
    return monkey


def spoilt_sphere() -> tuple[bpy.types.Object, Mask]:
    """Add an irregular unit sphere whose upper half is squashed and noisy; return it and the half.

    The rim and everything below lie on the sphere to float32.
    """
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=6, radius=1.0)
    sphere = bpy.context.object
    mesh = sphere.data
    mesh.shade_smooth()
    random = np.random.default_rng(1)
    points = positions(mesh)
    points += random.uniform(-0.008, 0.008, points.shape)  # a quarter of an edge
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    upper = np.array([all(points[v, 2] > 0.0 for v in p.vertices) for p in mesh.polygons])
    inside = _inner_vertices(mesh, upper)
    points[inside, 2] *= 0.3
    points[inside] += random.normal(0.0, 0.02, points[inside].shape)
    mesh.vertices.foreach_set("co", points.ravel().astype(np.float32))
    mesh.update()
    return sphere, upper


def _inner_vertices(mesh: bpy.types.Mesh, faces: Mask) -> Mask:
    outside = np.zeros(len(mesh.vertices), dtype=bool)
    for face in np.flatnonzero(~faces):
        outside[list(mesh.polygons[face].vertices)] = True
    return ~outside


def select(obj: bpy.types.Object, faces: Mask) -> None:
    """Enter edit mode with exactly these faces selected."""
    obj.data.polygons.foreach_set("select", faces.tolist())
    chosen = np.zeros(len(obj.data.vertices), dtype=bool)
    for face in np.flatnonzero(faces):
        chosen[list(obj.data.polygons[face].vertices)] = True
    obj.data.vertices.foreach_set("select", chosen.tolist())
    bpy.context.view_layer.objects.active = obj
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.object.mode_set(mode="EDIT")
