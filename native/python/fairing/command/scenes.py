"""Files by trimesh: one mesh of all objects in the scene's own coordinates, and back."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from fairing.objects.hosts import opened
from fairing.objects.parts import Parts, Polygons, alike
from fairing.results import FloatArray

_OBJECT = "\0object"  # data: the number of the object that vertices and faces belong to


def read(trimesh: Any, source: Path) -> tuple[Parts, Any]:
    """All objects as one mesh, each where it stands first, and the scene with the objects, their names and places."""
    scene = trimesh.load_scene(source, process=False)
    meshes = {name: opened(mesh) for name, mesh in scene.geometry.items() if hasattr(mesh, "faces")}
    if not meshes:
        raise ValueError("it holds no mesh")
    places: dict[str, FloatArray] = {}
    for node in scene.graph.nodes_geometry:
        matrix, name = scene.graph[node]
        places.setdefault(name, matrix)
    matrices = [places.get(name, np.eye(4)) for name in meshes]
    parts = _joined([parts for parts, _ in meshes.values()], matrices)
    if source.suffix.lower() == ".stl":
        return _welded(parts), next(iter(meshes.values()))[1]
    return parts, (source, scene, meshes, matrices)


def write(trimesh: Any, target: Path, parts: Parts, known: Any) -> list[str]:
    """Write a mesh, into the scene that was read if there is one; tell what it can't have."""
    if not isinstance(known, tuple):
        make = known or opened(trimesh.Trimesh([[0, 0, 0]] * 3, [[0, 1, 2]], process=False))[1]
        make(parts).export(str(target))
        return sorted({*parts.vertex_data, *parts.face_data})
    source, scene, meshes, matrices = known
    for number, (name, (before, make)) in enumerate(meshes.items()):
        scene.geometry[name] = make(_one_of(parts, number, before, np.linalg.inv(matrices[number])))
    said = _json(source)
    options = {"include_normals": True} if '"NORMAL"' in json.dumps(said) else {}
    scene.export(str(target), **options, **({"embed_buffers": True} if target.suffix.lower() == ".gltf" else {}))
    return [key for key in ("animations", "skins", "cameras") if said.get(key)]


def _welded(parts: Parts) -> Parts:
    """Of a soup of triangles: one vertex for each place."""
    first, number = alike(parts.points)
    said = {name: values for name, values in parts.face_data.items() if name != _OBJECT and values.any()}
    return Parts(parts.points[first], Polygons(number[parts.faces.corners], parts.faces.sizes), {}, said)


def _joined(own: list[Parts], matrices: list[FloatArray]) -> Parts:
    moved = [_moved(parts.points, parts.faces, matrix) for parts, matrix in zip(own, matrices, strict=True)]
    counts, sizes = [len(points) for points, _ in moved], [faces.sizes for _, faces in moved]
    begins = np.cumsum([0, *counts])
    corners = [(faces.corners + begin).astype(np.int32) for (_, faces), begin in zip(moved, begins, strict=False)]
    return Parts(
        np.concatenate([points for points, _ in moved]),
        Polygons(np.concatenate(corners), np.concatenate(sizes)),
        _together([parts.vertex_data for parts in own], counts),
        _together([parts.face_data for parts in own], [len(each) for each in sizes]),
    )


def _one_of(made: Parts, number: int, before: Parts, matrix: FloatArray) -> Parts:
    """The faces of one object, with its own vertices and the kinds of data that it had."""
    mine, places = made.face_data[_OBJECT] == number, np.arange(len(made.points))
    chosen = made.faces.chosen(mine)
    kept = ~np.isin(places, made.faces.corners) & (made.vertex_data[_OBJECT] == number) | np.isin(
        places, chosen.corners
    )
    faces = Polygons((np.cumsum(kept) - 1)[chosen.corners].astype(np.int32), chosen.sizes)
    of_vertices = {key: made.vertex_data[key][kept] for key in before.vertex_data}
    of_faces = {key: made.face_data[key][mine] for key in before.face_data}
    return Parts(*_moved(made.points[kept], faces, matrix), of_vertices, of_faces)


def _moved(points: FloatArray, faces: Polygons, matrix: FloatArray) -> tuple[FloatArray, Polygons]:
    """In other coordinates; a mirror turns the faces."""
    if np.linalg.det(matrix[:3, :3]) < 0:
        faces = faces.turned(np.arange(len(faces.sizes)))
    return points if (matrix == np.eye(4)).all() else points @ matrix[:3, :3].T + matrix[:3, 3], faces


def _together(data: list[dict[str, Any]], counts: list[int]) -> dict[str, Any]:
    """One table of all objects, zero where one has no such data, with the number of each row's object."""
    names = {name: values for each in data for name, values in each.items()}
    made = {}
    for name, like in names.items():
        shape, kind = like.shape[1:], like.dtype
        rows = [each.get(name, np.zeros((n, *shape), kind)) for each, n in zip(data, counts, strict=True)]
        made[name] = np.concatenate(rows)
    return made | {_OBJECT: np.repeat(np.arange(len(counts)), counts)}


def _json(source: Path) -> dict[str, Any]:
    """The text of a glTF file; empty of others."""
    raw = source.read_bytes()
    if source.suffix.lower() == ".glb":
        raw = raw[20 : 20 + int(np.frombuffer(raw, "<u4", 1, 12)[0])]
    elif source.suffix.lower() != ".gltf":
        return {}
    return json.loads(raw)
