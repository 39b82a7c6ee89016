"""Meshes to try jobs on: scans and characters of shared/data, and solids, tubes, voxels, skins and cages of bpy's."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import bmesh
import bpy
import numpy as np
from mathutils import Matrix
from numpy.typing import NDArray

from polygons import read_polygons

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
Faces = list[list[int]]
DATA = Path(__file__).resolve().parents[3] / "shared" / "data"


@dataclass(frozen=True)
class Scene:
    """A polygon mesh: vertices (n, 3); edges marked sharp (k, 2); weights (n,) by group; keys (n, 3) by name."""

    vertices: Floats
    faces: Faces
    sharp: Ints = field(default_factory=lambda: np.empty((0, 2), dtype=np.int64))
    groups: dict[str, Floats] = field(default_factory=dict)
    keys: dict[str, Floats] = field(default_factory=dict)


def real(name: str) -> Scene:
    """A mesh of shared/data."""
    return Scene(*read_polygons(DATA / f"{name}.obj"))


def case(name: str) -> tuple[Scene, Mask, Ints]:
    """A case that an artist met, with the faces and vertices that were selected."""
    with np.load(DATA.parent / "cases" / f"{name}.npz") as stored:
        data = {key: stored[key] for key in stored.files}
    ends = np.cumsum(data["counts"])
    faces = [data["corners"][end - count : end].tolist() for end, count in zip(ends, data["counts"], strict=True)]
    keys = {key[4:]: data[key] for key in data if key.startswith("key_")}
    chosen = np.isin(np.arange(len(faces)), data["selected_faces"])
    return Scene(data["vertices"], faces, data["sharp_edges"], keys=keys), chosen, data["selected_vertices"]


def of_bmesh(bm: Any) -> Scene:
    """Read a bmesh and free it."""
    bm.verts.index_update()
    found = Scene(np.array([v.co for v in bm.verts]), [[v.index for v in face.verts] for face in bm.faces])
    bm.free()
    return found


def _loaded(scene: Scene) -> Any:
    bm = bmesh.new()
    vertices = [bm.verts.new(point) for point in scene.vertices.tolist()]
    for face in scene.faces:
        bm.faces.new([vertices[v] for v in face])
    bm.normal_update()
    return bm


def _object(scene: Scene) -> Any:
    mesh = bpy.data.meshes.new("scene")
    bm = _loaded(scene)
    bm.to_mesh(mesh)
    bm.free()
    obj = bpy.data.objects.new("scene", mesh)
    bpy.context.collection.objects.link(obj)
    return obj


def modified(scene: Scene, *modifiers: tuple[str, dict[str, Any]]) -> Scene:
    """The mesh with Blender's modifiers applied."""
    obj = _object(scene)
    for kind, settings in modifiers:
        modifier = obj.modifiers.new(kind, kind)
        for name, value in settings.items():
            setattr(modifier, name, _object(value) if isinstance(value, Scene) else value)
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    bm = bmesh.new()
    bm.from_mesh(evaluated.to_mesh())
    return of_bmesh(bm)


def joined(first: Scene, second: Scene) -> Scene:
    """Their union, as a boolean makes it."""
    return modified(first, ("BOOLEAN", {"operation": "UNION", "solver": "EXACT", "object": second}))


def voxels(scene: Scene, size: float) -> Scene:
    """The mesh as a voxel remesh makes it."""
    return modified(scene, ("REMESH", {"mode": "VOXEL", "voxel_size": size}))


def subdivided(scene: Scene, levels: int) -> Scene:
    """The mesh as Catmull and Clark subdivide it."""
    return modified(scene, ("SUBSURF", {"levels": levels}))


def triangulated(scene: Scene) -> Scene:
    """The mesh with its faces cut into triangles."""
    bm = _loaded(scene)
    bmesh.ops.triangulate(bm, faces=bm.faces)
    return of_bmesh(bm)


def moved(scene: Scene, turn: Sequence[float] = (0, 0, 0), by: Sequence[float] = (0, 0, 0)) -> Scene:
    """The mesh turned about x, y, z (radians), then moved."""
    matrix = Matrix.Rotation(turn[2], 3, "Z") @ Matrix.Rotation(turn[1], 3, "Y") @ Matrix.Rotation(turn[0], 3, "X")
    return Scene(scene.vertices @ np.array(matrix).T + np.array(by, dtype=float), scene.faces)


def suzanne(levels: int) -> Scene:
    """Blender's monkey, its head alone, subdivided."""
    bm = bmesh.new()
    bmesh.ops.create_monkey(bm)
    bm.verts.ensure_lookup_table()
    linked, queue = set(), [max(bm.verts, key=lambda v: v.co.z)]
    while queue:
        vertex = queue.pop()
        if vertex not in linked:
            linked.add(vertex)
            queue += [edge.other_vert(vertex) for edge in vertex.link_edges]
    bmesh.ops.delete(bm, geom=[v for v in bm.verts if v not in linked], context="VERTS")
    found = of_bmesh(bm)
    return subdivided(found, levels) if levels else found


def sphere(subdivisions: int) -> Scene:
    """An icosphere of radius 1."""
    bm = bmesh.new()
    bmesh.ops.create_icosphere(bm, subdivisions=subdivisions, radius=1.0)
    return of_bmesh(bm)


def box(cells: int, size: Sequence[float] = (1.0, 1.0, 1.0)) -> Scene:
    """A box from −size to size with a grid of so many cells on each side."""
    bm = bmesh.new()
    bmesh.ops.create_cube(bm, size=2.0)
    bmesh.ops.subdivide_edges(bm, edges=bm.edges, cuts=cells - 1, use_grid_fill=True)
    bmesh.ops.scale(bm, vec=size, verts=bm.verts)
    return of_bmesh(bm)


def bevelled_box(cells: int, width: float, segments: int) -> Scene:
    """A box whose edges were bevelled, then divided where it is flat."""
    bevelled = modified(
        box(1),
        ("BEVEL", {"width": width, "segments": segments, "limit_method": "ANGLE"}),
    )
    bm = _loaded(bevelled)
    for axis in range(3):
        for place in np.linspace(-1 + width, 1 - width, cells + 1)[1:-1]:
            normal = np.eye(3)[axis]
            geometry = [*bm.verts, *bm.edges, *bm.faces]
            bmesh.ops.bisect_plane(bm, geom=geometry, plane_co=normal * place, plane_no=normal)
    return of_bmesh(bm)


def tube(path: Floats, radii: Floats, sides: int) -> Scene:
    """An open tube of quads about a path (k, 3) with a radius (k,) at each point."""
    tangents = np.gradient(path, axis=0)
    tangents /= np.linalg.norm(tangents, axis=1)[:, None]
    helper = np.eye(3)[np.abs(tangents).sum(axis=0).argmin()]
    across = np.cross(tangents, helper)
    across /= np.linalg.norm(across, axis=1)[:, None]
    other = np.cross(tangents, across)
    angles = 2 * np.pi * np.arange(sides) / sides
    rings = np.cos(angles)[:, None, None] * across + np.sin(angles)[:, None, None] * other
    points = path + radii[:, None] * rings
    vertices = points.transpose(1, 0, 2).reshape(-1, 3)
    faces = [
        [sides * i + j, sides * i + (j + 1) % sides, sides * (i + 1) + (j + 1) % sides, sides * (i + 1) + j]
        for i in range(len(path) - 1)
        for j in range(sides)
    ]
    return Scene(vertices, faces)


def sheet(cells: int, height: Any, reach: float = 1.0) -> Scene:
    """A grid over [−reach, reach]² whose height is a function of x, y."""
    steps = np.linspace(-reach, reach, cells + 1)
    x, y = (places.ravel() for places in np.meshgrid(steps, steps))
    row = cells + 1
    faces = [
        [row * j + i, row * j + i + 1, row * (j + 1) + i + 1, row * (j + 1) + i]
        for j in range(cells)
        for i in range(cells)
    ]
    return Scene(np.column_stack([x, y, height(x, y)]), faces)


def letter(rng: Any) -> Scene:
    """A letter embossed on a plate, as one voxel mesh."""
    curve = bpy.data.curves.new("text", "FONT")
    curve.body, curve.size, curve.extrude = str(rng.choice(list("ABRSEK5&"))), 1.4, 0.12
    curve.align_x = curve.align_y = "CENTER"
    obj = bpy.data.objects.new("text", curve)
    bpy.context.collection.objects.link(obj)
    bm = bmesh.new()
    bm.from_mesh(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh())
    bmesh.ops.remove_doubles(bm, verts=bm.verts, dist=1e-5)
    text = of_bmesh(bm)
    plate = moved(box(1, (1.2, 1.2, 0.15)), by=(0, 0, -0.2))
    return voxels(joined(plate, moved(text, by=(0, 0, 0.0))), 0.03)


def neighbours(scene: Scene) -> Ints:
    """Edges (e, 2), each once."""
    ends = np.concatenate([np.column_stack([face, np.roll(face, -1)]) for face in scene.faces])
    return np.unique(np.sort(ends, axis=1), axis=0)


def normals(scene: Scene) -> Floats:
    """Vertex normals (n, 3)."""
    found = np.zeros_like(scene.vertices)
    for size in {len(face) for face in scene.faces}:
        faces = np.array([face for face in scene.faces if len(face) == size])
        corners = scene.vertices[faces]
        areas = np.cross(corners, np.roll(corners, -1, axis=1)).sum(axis=1)
        np.add.at(found, faces, areas[:, None])
    return np.asarray(found / np.linalg.norm(found, axis=1).clip(1e-300)[:, None])


def displaced(scene: Scene, heights: Floats) -> Scene:
    """The vertices moved along their normals by heights (n,)."""
    return Scene(scene.vertices + heights[:, None] * normals(scene), scene.faces)


def grain(scene: Scene, rng: Any, size: float, height: float) -> Scene:
    """The mesh with pores and wrinkles: a sum of waves about as long as `size`, in all directions."""
    directions = rng.normal(size=(40, 3))
    directions *= 2 * np.pi / size / np.linalg.norm(directions, axis=1)[:, None] * rng.uniform(0.6, 1.4, (40, 1))
    waves = np.cos(scene.vertices @ directions.T + rng.uniform(0, 2 * np.pi, 40)).sum(axis=1)
    return displaced(scene, height * waves / np.sqrt(20.0))


def noisy(scene: Scene, rng: Any, share: float) -> Scene:
    """All vertices shaken by `share` of a mean edge."""
    ends = neighbours(scene)
    edge = np.linalg.norm(np.diff(scene.vertices[ends], axis=1), axis=2).mean()
    return Scene(scene.vertices + share * edge * rng.normal(size=scene.vertices.shape), scene.faces)


def bump(scene: Scene, at: Floats, width: float, height: float) -> Scene:
    """The mesh with a round hill (or a hollow) where it is nearest to a point."""
    away = np.linalg.norm(scene.vertices - scene.vertices[nearest(scene, at)], axis=1)
    return displaced(scene, height * np.exp(-0.5 * (away / width) ** 2))


def nearest(scene: Scene, at: Floats) -> int:
    """The vertex nearest to a point."""
    return int(np.linalg.norm(scene.vertices - at, axis=1).argmin())
