"""Meshes of other libraries, told by what they have; none of these libraries is imported.

Each reader returns the parts of a mesh and a function that makes a mesh of the same kind from other parts. The mesh
given is never written to.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from fairing.objects.parts import Data, Parts, Polygons

Maker = Callable[[Parts], Any]
_CORNERS = {"triangle": 3, "quad": 4}  # of meshio's cells that are faces


def opened(mesh: Any) -> tuple[Parts, Maker]:
    """The parts of a mesh, and what makes a mesh like it from others; ValueError where it is none that is known."""
    for has, reader in _READERS:
        if all(hasattr(mesh, name) for name in has):
            return reader(mesh)
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return _arrays(mesh)
    raise ValueError(
        "mesh: a pair (vertices, faces) is needed, or a mesh of trimesh, pyvista (PolyData), meshio or Open3D, "
        f"not {type(mesh).__module__}.{type(mesh).__qualname__}"
    )


def _arrays(mesh: Any) -> tuple[Parts, Maker]:
    vertices, faces = mesh
    try:
        polygons = Polygons.of(faces)
    except ValueError:
        sizes = [len(face) for face in faces] if isinstance(faces, (list, tuple)) else []
        if not sizes or min(sizes) < 3 or len(set(sizes)) == 1:
            raise
        polygons = Polygons(np.concatenate([np.asarray(face, np.int32) for face in faces]), np.array(sizes, np.int32))
    return Parts.checked(vertices, polygons, {}, {}), lambda made: (made.points, made.faces.rows())


def _trimesh(mesh: Any) -> tuple[Parts, Maker]:
    vertex_data, face_data = dict(mesh.vertex_attributes), dict(mesh.face_attributes)
    visual, kind = mesh.visual, getattr(mesh.visual, "kind", None)
    if kind == "vertex":
        vertex_data[_OWN] = np.asarray(visual.vertex_colors)
    elif kind == "face":
        face_data[_OWN] = np.asarray(visual.face_colors)
    elif kind == "texture" and visual.uv is not None:
        vertex_data[_OWN] = np.asarray(visual.uv)

    def make(polygons: Parts) -> Any:
        made = polygons.in_triangles()
        of_vertices, of_faces = dict(made.vertex_data), dict(made.face_data)
        own = of_vertices.pop(_OWN, None) if kind in ("vertex", "texture") else of_faces.pop(_OWN, None)
        result = type(mesh)(
            vertices=made.points, faces=made.faces.triangles, process=False, metadata=dict(mesh.metadata),
            vertex_attributes=of_vertices, face_attributes=of_faces,
        )  # fmt: skip
        if own is not None and kind == "texture":
            result.visual = type(visual)(uv=own, material=visual.material)
        elif own is not None:
            result.visual = type(visual)(result, **{f"{kind}_colors": own})
        return result

    return Parts.checked(mesh.vertices, Polygons.of(mesh.faces), vertex_data, face_data), make


def _pyvista(mesh: Any) -> tuple[Parts, Maker]:
    polygons = _padded(np.asarray(mesh.faces))
    others = mesh.n_cells - len(polygons.sizes)
    if others:
        raise ValueError(f"mesh: PolyData of faces alone is needed, not one with {others} vertices, lines or strips")

    def make(made: Parts) -> Any:
        begins = made.faces.first
        result = type(mesh)(
            made.points.astype(mesh.points.dtype), np.insert(made.faces.corners, begins, made.faces.sizes)
        )
        for store, data in ((result.point_data, made.vertex_data), (result.cell_data, made.face_data)):
            for name, values in data.items():
                store[name] = values
        result.field_data.update(mesh.field_data)
        return result

    return Parts.checked(mesh.points, polygons, _copied(mesh.point_data), _copied(mesh.cell_data)), make


def _padded(flat: npt.NDArray[Any]) -> Polygons:
    """From VTK's list, in which each face begins with the number of its corners."""
    places, at = [], 0
    while at < len(flat):
        places.append(at)
        at += int(flat[at]) + 1
    return Polygons(np.delete(flat, places).astype(np.int32), flat[places].astype(np.int32))


def _meshio(mesh: Any) -> tuple[Parts, Maker]:
    """Lines and points among the cells stay as they are; the faces become one block for each number of corners."""
    blocks = [(block.type, np.asarray(block.data)) for block in mesh.cells]
    solid = sorted({kind for kind, _ in blocks if kind not in (*_CORNERS, "vertex", "line", "polygon")})
    if solid:
        raise ValueError(f"mesh: a surface of triangles, quads and polygons is needed, not cells {solid}")
    faces = [number for number, (kind, _) in enumerate(blocks) if kind in _CORNERS or kind == "polygon"]
    if not faces:
        raise ValueError("mesh: has no faces")
    polygons = Polygons.joined([Polygons.of(blocks[number][1]) for number in faces])
    of_faces = {
        name: np.concatenate([np.asarray(values[number]) for number in faces])
        for name, values in mesh.cell_data.items()
    }
    rest = [number for number in range(len(blocks)) if number not in faces]

    def make(made: Parts) -> Any:
        kinds = [made.faces.sizes == size for size in np.unique(made.faces.sizes)]
        names = {size: kind for kind, size in _CORNERS.items()}
        cells = [
            (names.get(int(made.faces.sizes[kind][0]), "polygon"), made.faces.chosen(kind).rows()) for kind in kinds
        ]
        data = {
            name: [values[kind] for kind in kinds] + [mesh.cell_data[name][number] for number in rest]
            for name, values in made.face_data.items()
        }
        return type(mesh)(
            made.points.astype(mesh.points.dtype), cells + [blocks[number] for number in rest],
            point_data=made.vertex_data, cell_data=data, field_data=dict(mesh.field_data),
        )  # fmt: skip

    return Parts.checked(mesh.points, polygons, _copied(mesh.point_data), of_faces), make


def _open3d(mesh: Any) -> tuple[Parts, Maker]:
    vertex_data = {name: np.array(getattr(mesh, name)) for name in ("vertex_colors", "vertex_normals")}
    face_data = {
        "triangle_normals": np.array(mesh.triangle_normals),
        "triangle_material_ids": np.array(mesh.triangle_material_ids),
        "triangle_uvs": np.array(mesh.triangle_uvs).reshape(-1, 6),
    }

    def make(polygons: Parts) -> Any:
        made = polygons.in_triangles()
        result = type(mesh)(mesh)
        result.vertices = type(mesh.vertices)(made.points)
        result.triangles = type(mesh.triangles)(made.faces.triangles)
        for name, values in {**made.vertex_data, **made.face_data}.items():
            rows = values.reshape(-1, 2) if name == "triangle_uvs" else values
            setattr(result, name, type(getattr(mesh, name))(rows))
        if "triangle_normals" in made.face_data:
            result.compute_triangle_normals()
        return result

    used = [{name: values for name, values in data.items() if len(values)} for data in (vertex_data, face_data)]
    return Parts.checked(np.asarray(mesh.vertices), Polygons.of(np.asarray(mesh.triangles)), *used), make


def _copied(data: Any) -> Data:
    return {name: np.array(data[name]) for name in data.keys()}  # noqa: SIM118 - pyvista's is no dictionary


_OWN = "\0visual"  # trimesh keeps colours and texture coordinates apart from other data
_READERS: tuple[tuple[tuple[str, ...], Callable[[Any], tuple[Parts, Maker]]], ...] = (
    (("points", "faces", "point_data", "cell_data", "n_cells"), _pyvista),
    (("points", "cells", "point_data", "cell_data"), _meshio),
    (("vertices", "triangles", "vertex_normals", "triangle_uvs"), _open3d),
    (("vertices", "faces", "vertex_attributes", "face_attributes", "visual"), _trimesh),
)
