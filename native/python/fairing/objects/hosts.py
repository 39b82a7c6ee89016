"""Meshes of other libraries, told by what they have; none of these libraries is imported.

Each reader returns the parts of a mesh and a function that makes a mesh of the same kind from other parts. The mesh
given is never written to.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from fairing.objects.parts import Parts, Polygons

Opened = tuple[Parts, Callable[[Parts], Any]]
_CORNERS = {"triangle": 3, "quad": 4}  # of meshio's cells that are faces


def opened(mesh: Any) -> Opened:
    """The parts of a mesh, and what makes a mesh like it from others; ValueError where it is none that is known."""
    if isinstance(mesh, Parts):
        return mesh, lambda made: made
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return Parts(mesh[0], Polygons.of(mesh[1])), lambda made: (made.points, made.faces.rows())
    for name, reader in _READERS.items():
        if all(hasattr(mesh, each) for each in name.split()):
            return reader(mesh)
    raise ValueError(
        "mesh: a pair (vertices, faces) is needed, or a mesh of trimesh, pyvista (PolyData), meshio or Open3D, "
        f"not {type(mesh).__module__}.{type(mesh).__qualname__}"
    )


def _trimesh(mesh: Any) -> Opened:
    """Colours and texture coordinates are kept apart from other data there."""
    stores = dict(mesh.vertex_attributes), dict(mesh.face_attributes)
    kind = getattr(mesh.visual, "kind", None)
    name = "uv" if kind == "texture" else "colors"
    visual = getattr(mesh.visual, "uv" if kind == "texture" else f"{kind}_colors", None)
    has_normals = "vertex_normals" in mesh._cache  # of a file; without, trimesh would compute them
    if has_normals:
        stores[0]["normals"] = np.asarray(mesh.vertex_normals)
    if visual is not None:
        stores[kind == "face"][name] = np.asarray(visual)

    def make(polygons: Parts) -> Any:
        made = polygons.in_triangles()
        data = dict(made.vertex_data), dict(made.face_data)
        own = None if visual is None else data[kind == "face"].pop(name)
        result = type(mesh)(
            vertices=made.points, faces=made.faces.rows(), process=False, metadata=dict(mesh.metadata),
            vertex_normals=data[0].pop("normals") if has_normals else None,
            vertex_attributes=data[0], face_attributes=data[1],
        )  # fmt: skip
        if own is not None:
            texture = {"uv": own, "material": getattr(mesh.visual, "material", None)}
            colours = {"mesh": result, f"{kind}_colors": own}
            result.visual = type(mesh.visual)(**(texture if kind == "texture" else colours))
        return result

    return Parts(mesh.vertices, Polygons.of(mesh.faces), *stores), make


def _pyvista(mesh: Any) -> Opened:
    flat, places = np.asarray(mesh.faces), [0]  # each face begins with the number of its corners
    while places[-1] < len(flat):
        places.append(places[-1] + int(flat[places[-1]]) + 1)
    polygons = Polygons(np.delete(flat, places[:-1]).astype(np.int32), flat[places[:-1]].astype(np.int32))
    if others := mesh.n_cells - len(polygons.sizes):
        raise ValueError(f"mesh: PolyData of faces alone is needed, not one with {others} vertices, lines or strips")

    def make(made: Parts) -> Any:
        flat = np.insert(made.faces.corners, made.faces.first, made.faces.sizes)
        result = type(mesh)(made.points.astype(mesh.points.dtype), flat)
        result.point_data.update(made.vertex_data)
        result.cell_data.update(made.face_data)
        result.field_data.update(mesh.field_data)
        return result

    stores = [{name: np.array(store[name]) for name in store.keys()} for store in (mesh.point_data, mesh.cell_data)]  # noqa: SIM118 - no dictionaries
    return Parts(mesh.points, polygons, *stores), make


def _meshio(mesh: Any) -> Opened:
    """Lines and points among the cells stay as they are; the faces become one block for each number of corners."""
    kinds = [block.type for block in mesh.cells]
    if solid := sorted({*kinds} - {*_CORNERS, "vertex", "line", "polygon"}):
        raise ValueError(f"mesh: a surface of triangles, quads and polygons is needed, not cells {solid}")
    faces = [number for number, kind in enumerate(kinds) if kind in _CORNERS or kind == "polygon"]
    rest = [number for number in range(len(kinds)) if number not in faces]
    if not faces:
        raise ValueError("mesh: has no faces")

    def make(made: Parts) -> Any:
        sizes = np.unique(made.faces.sizes).tolist()
        names = {size: kind for kind, size in _CORNERS.items()}
        cells = [(names.get(k, "polygon"), made.faces.chosen(made.faces.sizes == k).rows()) for k in sizes]
        data = {
            name: [values[made.faces.sizes == k] for k in sizes] + [mesh.cell_data[name][number] for number in rest]
            for name, values in made.face_data.items()
        }
        return type(mesh)(
            made.points.astype(mesh.points.dtype), cells + [(kinds[k], mesh.cells[k].data) for k in rest],
            point_data=made.vertex_data, cell_data=data, field_data=dict(mesh.field_data),
        )  # fmt: skip

    polygons = Polygons.joined([Polygons.of(mesh.cells[number].data) for number in faces])
    of_faces = {name: np.concatenate([values[number] for number in faces]) for name, values in mesh.cell_data.items()}
    points = np.pad(mesh.points, ((0, 0), (0, 3 - mesh.points.shape[1])))  # in the plane: two columns
    return Parts(points, polygons, {name: np.array(values) for name, values in mesh.point_data.items()}, of_faces), make


def _open3d(mesh: Any) -> Opened:
    names = ("colors", "normals"), ("triangle_normals", "triangle_material_ids", "triangle_uvs")
    stored = [
        {name: np.array(getattr(mesh, prefix + name)) for name in part}
        for prefix, part in zip(("vertex_", ""), names, strict=True)
    ]
    stored[1]["triangle_uvs"] = stored[1]["triangle_uvs"].reshape(-1, 6)

    def make(polygons: Parts) -> Any:
        made = polygons.in_triangles()
        result = type(mesh)(mesh)
        rows: dict[str, Any] = {"vertices": made.points, "triangles": made.own, **made.face_data}
        rows |= {f"vertex_{name}": values for name, values in made.vertex_data.items()}
        for name, values in rows.items():
            shaped = values.reshape(-1, 2) if name == "triangle_uvs" else values
            setattr(result, name, type(getattr(mesh, name))(shaped))
        if "triangle_normals" in made.face_data:
            result.compute_triangle_normals()
        return result

    used = [{name: values for name, values in data.items() if len(values)} for data in stored]
    return Parts(np.asarray(mesh.vertices), Polygons.of(np.asarray(mesh.triangles)), *used), make


_READERS: dict[str, Callable[[Any], Opened]] = {  # by the names that a mesh of each has; the first costs nothing
    "points faces point_data cell_data n_cells": _pyvista,
    "points cells point_data cell_data": _meshio,
    "triangle_uvs vertices triangles vertex_normals": _open3d,
    "vertices faces vertex_attributes face_attributes visual": _trimesh,
}
