"""Real meshes and patches, where the folder with them is beside the project."""

from __future__ import annotations

import json
import os
from heapq import heappop, heappush
from pathlib import Path
from typing import Any

import bmesh
import bpy
import numpy as np

import meshes

FOLDER = Path(os.environ.get("FAIRING_MESHES") or Path(__file__).parents[3] / "shared" / "data")


def patches() -> list[dict[str, Any]]:
    """Return the list of patches; empty where there are none."""
    index = FOLDER / "patches.json"
    found: list[dict[str, Any]] = json.loads(index.read_text())["patches"] if index.is_file() else []
    return found


def name(patch: dict[str, Any]) -> str:
    """Return a short name for a patch."""
    return f"{Path(patch['mesh']).stem} {patch['patch']}"


def load(file: str) -> bpy.types.Object:
    """Add a mesh from an OBJ file, vertices in the order of its v lines."""
    points, texture, faces, corners = [], [], [], []
    for line in (FOLDER / file).read_text().splitlines():
        key, *words = line.split()[:1] + line.split()[1:] if line.strip() else [""]
        if key == "v":
            points.append([float(word) for word in words[:3]])
        elif key == "vt":
            texture.append([float(word) for word in words[:2]])
        elif key == "f":
            faces.append([int(word.split("/")[0]) - 1 for word in words])
            corners += [int(word.split("/")[1]) - 1 for word in words if word.count("/") and word.split("/")[1]]
    obj = meshes.add(points, faces, Path(file).stem)
    if len(corners) == sum(map(len, faces)):
        layer = obj.data.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", np.array(texture, dtype=np.float32)[corners].ravel())
    return obj


def _distances(obj: bpy.types.Object, seed: int, radius: float) -> dict[int, float]:
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    found: dict[int, float] = {}
    queue = [(0.0, seed)]
    while queue:
        so_far, vertex = heappop(queue)
        if vertex in found or so_far > radius:
            continue
        found[vertex] = so_far
        for edge in bm.verts[vertex].link_edges:
            heappush(queue, (so_far + edge.calc_length(), edge.other_vert(bm.verts[vertex]).index))
    bm.free()
    return found


def faces_of(obj: bpy.types.Object, patch: dict[str, Any]) -> meshes.Mask:
    """Grow the patch from its seed along edges, as the rule in the index says."""
    near = _distances(obj, patch["seed"], patch["radius"])
    inside = np.array([all(v in near for v in p.vertices) for p in obj.data.polygons])
    by_edge: dict[tuple[int, int], list[int]] = {}
    for face in np.flatnonzero(inside):
        for key in obj.data.polygons[face].edge_keys:
            by_edge.setdefault(key, []).append(int(face))
    reached = {f for f in np.flatnonzero(inside).tolist() if patch["seed"] in obj.data.polygons[f].vertices}
    queue = list(reached)
    while queue:
        for key in obj.data.polygons[queue.pop()].edge_keys:
            for other in by_edge[key]:
                if other not in reached:
                    reached.add(other)
                    queue.append(other)
    faces = np.zeros(len(inside), dtype=bool)
    faces[list(reached)] = True
    return faces
