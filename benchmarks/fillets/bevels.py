"""The same seams rounded by Fair Fillet with quads, and by Blender's Bevel: polygons outside, and new ones."""

from __future__ import annotations

import importlib
from typing import Any

import plain_addon  # noqa: F401

# isort: split
import numpy as np
from addon.arrays.region import MeshArrays
from addon.fillet.rounding import hard, round_arrays
from addon.options.other_options import FilletOptions

import fairing
from hard_surfaces import FloatArray, Polygons, Problem

Made = tuple[FloatArray, Polygons, Polygons]
ROWS = 8  # Fair Fillet's by default


def arrays(points: FloatArray, polygons: Polygons) -> MeshArrays:
    """As the add-on reads them."""
    triangles, faces, corners, edges = [], [], [], {}
    for number, polygon in enumerate(polygons):
        found = _triangles(points, polygon)
        triangles += found
        faces += [number] * len(found)
        for a, b in zip(polygon, [*polygon[1:], polygon[0]], strict=True):
            corners.append((a, edges.setdefault((min(a, b), max(a, b)), len(edges)), number))
    vertices, sides, owners = np.array(corners).T
    return MeshArrays(
        positions=points, edges=np.array(list(edges)), corner_vertices=vertices, corner_edges=sides,
        corner_faces=owners, triangles=np.array(triangles), triangle_faces=np.array(faces),
        in_patch=np.zeros(len(polygons), dtype=bool), pinned=np.zeros(len(points), dtype=bool),
    )  # fmt: skip


def _triangles(points: FloatArray, polygon: list[int]) -> list[list[int]]:
    """Ears of a plane polygon, one after the other."""
    places = points[polygon]
    normal = np.cross(places, np.roll(places, -1, axis=0)).sum(axis=0)
    left, found = list(polygon), []
    while len(left) > 3:
        k = next(k for k in range(len(left)) if _is_ear(points, left, k, normal))
        found.append([left[k - 1], left[k], left[(k + 1) % len(left)]])
        del left[k]
    return [*found, left]


def _is_ear(points: FloatArray, polygon: list[int], k: int, normal: FloatArray) -> bool:
    a, b, c = (polygon[j % len(polygon)] for j in (k - 1, k, k + 1))
    if np.cross(points[b] - points[a], points[c] - points[a]) @ normal <= 1e-12:
        return False
    others = points[[v for v in polygon if v not in (a, b, c)]]
    sides = ((a, b), (b, c), (c, a))
    inside = [np.cross(points[y] - points[x], others - points[x]) @ normal > -1e-12 for x, y in sides]
    return not np.logical_and.reduce(inside).any()


def fillet(problem: Problem) -> tuple[Made, Any]:
    """And what the engine says; raises fairing.MeshError, a ValueError."""
    mesh = arrays(problem.points, problem.polygons)
    chosen = np.array([tuple(edge) in problem.seam for edge in np.sort(mesh.edges, axis=1).tolist()])
    rounded = round_arrays(mesh, chosen, np.eye(4), FilletOptions(width=problem.width, quads=True))
    part, count = rounded.part, len(problem.points)
    gone = set(part.gone_faces.tolist())
    kept = [polygon for number, polygon in enumerate(problem.polygons) if number not in gone]
    number = np.concatenate([part.stay, count + np.arange(len(rounded.new_positions))])
    new = [number[polygon].tolist() for polygon in rounded.polygons.polygons]
    points = np.concatenate([problem.points, rounded.new_positions])
    return (points, kept + new[: rounded.unselected], new[rounded.unselected :]), rounded


def bevel(problem: Problem) -> Made:
    """Blender's, of the same width and as many segments."""
    bpy, bmesh = importlib.import_module("bpy"), importlib.import_module("bmesh")
    mesh = bpy.data.meshes.new("Seams")
    mesh.from_pydata(problem.points.tolist(), [], problem.polygons)
    bm = bmesh.new()
    bm.from_mesh(mesh)
    edges = [edge for edge in bm.edges if tuple(sorted(v.index for v in edge.verts)) in problem.seam]
    result = bmesh.ops.bevel(
        bm, geom=edges, offset=problem.width, offset_type="OFFSET", segments=ROWS, profile=0.5, affect="EDGES"
    )
    new = set(result["faces"])
    bm.verts.index_update()
    points = np.array([tuple(vertex.co) for vertex in bm.verts])
    faces = {face: [vertex.index for vertex in face.verts] for face in bm.faces}
    made = points, [p for f, p in faces.items() if f not in new], [p for f, p in faces.items() if f in new]
    bm.free()
    bpy.data.meshes.remove(mesh)
    return made


def hard_edges(points: FloatArray, polygons: Polygons) -> set[tuple[int, int]]:
    mesh = arrays(points, polygons)
    return {(a, b) for a, b in np.sort(mesh.edges[hard(mesh)], axis=1).tolist()}


def has_rows(result: fairing.results.FilletResult) -> bool:
    return "NO_QUAD_ROWS" not in [warning.code for warning in result.warnings]


def off_triangles(problem: Problem, made: Made) -> float:
    """How far new vertices are from the fillet in triangles half as long, over D of the fillet, at most; or NaN."""
    mesh = arrays(problem.points, problem.polygons)
    chosen = np.array([tuple(edge) in problem.seam for edge in np.sort(mesh.edges, axis=1).tolist()])
    options = FilletOptions(width=problem.width, spacing=problem.width / 8)
    try:
        fine = round_arrays(mesh, chosen, np.eye(4), options).result
    except ValueError:
        return float("nan")
    points = np.concatenate([problem.points, fine.vertices])
    new = made[0][np.unique(np.concatenate([np.array(polygon) for polygon in made[2]]))]
    off = fairing._core.signed_distances(new, points, fine.triangles[fine.outside :])
    return float(np.abs(off).max() / (2 * np.linalg.norm(new - new.mean(axis=0), axis=1).max()))


def corner_angles(points: FloatArray, quads: Any) -> FloatArray:
    """(q, 4) degrees, above 180 where a quad is not convex."""
    corners = points[quads]
    ahead, back = np.roll(corners, -1, axis=1) - corners, np.roll(corners, 1, axis=1) - corners
    cross = np.cross(ahead, back)
    normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    angles = np.degrees(np.arctan2(np.linalg.norm(cross, axis=2), (ahead * back).sum(axis=2)))
    return np.where((cross * normals[:, None]).sum(axis=2) < 0, 360 - angles, angles)
