"""What others make of the same holes: Blender's Grid Fill and QuadriFlow, and PyPI's QuadriFlow and Instant Meshes.

QuadriFlow and Instant Meshes get the fair surface in triangles, and as many faces as our pattern has.
"""

from __future__ import annotations

import importlib
import importlib.util
from collections.abc import Callable
from typing import Any

import numpy as np

import fairing
from cases import Hole
from holes import FloatArray, IntArray
from judged import Faces

Made = tuple[FloatArray, Faces, IntArray]  # places, faces, and the boundary in numbers of these


def patch_of(hole: Hole) -> tuple[FloatArray, IntArray, IntArray]:
    """The fair surface by itself: vertices, triangles, its boundary loop."""
    result = fairing.fill(hole.points, hole.outside, [hole.loop], edges="ignored")
    whole = np.concatenate([hole.points, result.vertices])
    used = np.unique(result.triangles)
    number = np.full(len(whole), -1)
    number[used] = np.arange(len(used))
    return whole[used], number[result.triangles], number[result.loops[0]]


def grid_fill(hole: Hole, _count: int) -> Made | None:
    """Blender's, on the boundary's edges alone; None where it refuses."""
    bpy, bmesh = importlib.import_module("bpy"), importlib.import_module("bmesh")
    loop = hole.loop.tolist()
    mesh = bpy.data.meshes.new("Rim")
    mesh.from_pydata(hole.points[loop].tolist(), [(k, (k + 1) % len(loop)) for k in range(len(loop))], [])
    obj = bpy.data.objects.new("Rim", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (False, True, False)
    bpy.ops.mesh.select_all(action="SELECT")
    bm = bmesh.from_edit_mesh(mesh)
    bm.verts.ensure_lookup_table()
    bm.select_history.add(bm.verts[0])
    try:
        done = bpy.ops.mesh.fill_grid() == {"FINISHED"}
    except RuntimeError:
        done = False
    bpy.ops.object.mode_set(mode="OBJECT")
    made = _mesh_of(obj) if done and len(mesh.polygons) else None
    bpy.data.objects.remove(obj)
    if made is None:
        return None
    points, faces = made
    sides = {(a, b) for face in faces for a, b in zip(face, face[1:] + face[:1], strict=True)}
    ring = np.arange(len(loop))
    return points, faces if (0, 1) in sides else [face[::-1] for face in faces], ring


def blender_quadriflow(hole: Hole, count: int) -> Made | None:
    """With Preserve Boundary."""
    bpy = importlib.import_module("bpy")
    points, triangles, loop = patch_of(hole)
    mesh = bpy.data.meshes.new("Patch")
    mesh.from_pydata(points.tolist(), [], triangles.tolist())
    obj = bpy.data.objects.new("Patch", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    for other in bpy.context.view_layer.objects:
        other.select_set(other == obj)
    try:
        bpy.ops.object.quadriflow_remesh(
            "EXEC_DEFAULT", mode="FACES", target_faces=count, use_preserve_boundary=True, use_mesh_symmetry=False
        )
        made = _mesh_of(obj)
    except RuntimeError:
        made = None
    bpy.data.objects.remove(obj)
    return None if made is None else (*made, _same_places(made[0], points[loop]))


def quadriflow(hole: Hole, count: int) -> Made | None:
    """PyPI's pyquadriflow, with its flag for boundaries."""
    module = importlib.import_module("pyQuadriFlow.pyQuadriFlow")
    points, triangles, loop = patch_of(hole)
    flags = (False, True, False, False, False)
    made = module.pyquadriflow(count, 0, points.tolist(), triangles.tolist(), *flags)
    found = np.array(made["vertices"], dtype=float).reshape(-1, 3)
    faces = [list(map(int, face)) for face in made["faces"]]
    return found, faces, _same_places(found, points[loop])


def instant_meshes(hole: Hole, count: int) -> Made | None:
    """PyPI's pynanoinstantmeshes, aligned to boundaries."""
    module = importlib.import_module("pynanoinstantmeshes")
    points, triangles, loop = patch_of(hole)
    found, faces = module.remesh(
        points.astype(np.float32), triangles.astype(np.uint32), vertex_count=count, align_to_boundaries=True,
        deterministic=True,
    )  # fmt: skip
    rows = [[int(v) for v in dict.fromkeys(face)] for face in np.asarray(faces).tolist()]
    places = np.asarray(found, dtype=float)
    return places, rows, _same_places(places, points[loop])


def _mesh_of(obj: Any) -> tuple[FloatArray, Faces]:
    points = np.array([vertex.co[:] for vertex in obj.data.vertices])
    return points, [list(polygon.vertices) for polygon in obj.data.polygons]


def _same_places(points: FloatArray, wanted: FloatArray) -> IntArray:
    """(k,) the points in these places, to single precision; −1 where there is none."""
    away = np.linalg.norm(points[:, None] - wanted, axis=2)
    edge = np.linalg.norm(np.roll(wanted, -1, axis=0) - wanted, axis=1).min()
    near = away.argmin(axis=0)
    result: IntArray = np.where(away.min(axis=0) < 1e-4 * edge, near, -1 - np.arange(len(wanted)))
    return result


PEERS: dict[str, tuple[str, Callable[[Hole, int], Made | None]]] = {
    "Grid Fill": ("bpy", grid_fill),
    "QuadriFlow, Blender's": ("bpy", blender_quadriflow),
    "pyquadriflow": ("pyQuadriFlow", quadriflow),
    "pynanoinstantmeshes": ("pynanoinstantmeshes", instant_meshes),
}


def installed() -> dict[str, Callable[[Hole, int], Made | None]]:
    """Those that are there."""
    return {name: call for name, (module, call) in PEERS.items() if importlib.util.find_spec(module)}


def ready(name: str) -> None:
    """Import it, so that this takes no time of the first hole."""
    importlib.import_module(PEERS[name][0])
