"""Meshes in edit mode with their places on images, and new places."""

from __future__ import annotations

from dataclasses import dataclass

import bmesh
import bpy
import numpy as np

from ..core.arrays import Floats, Ints, Mask
from ..core.boundary_colours import Picture
from ..core.textured_mesh import TexturedMesh
from ..core.texturing import Textured, TextureOptions
from .columns import column, flags, indices
from .mesh_io import is_editable, snapshot
from .pictures import Source, copy_with, picture_of, show_instead, source_of
from .weights import faces_of_group


@dataclass(frozen=True)
class Read:
    """The mesh of one object."""

    mesh: TexturedMesh
    faces: Ints  # (m,) of the new triangles
    corners: Ints  # (m, 3) likewise, as their faces number them
    uv_maps: list[str]  # (m,) that lie on the image
    images: list[bpy.types.Image]
    pictures: list[Picture]


def read(obj: bpy.types.Object, options: TextureOptions) -> Read | None:
    """Read an object in edit mode, None where no face is selected; raises ValueError where those can't get colours."""
    if not is_editable(obj.data):
        raise ValueError("The mesh is linked from another file: make it local first")
    with snapshot(obj.data) as copy:
        selected = flags(copy, ".select_poly", copy.polygons)
        if not selected.any():
            return None
        slots = indices(copy.polygons, "material_index")
        sources = _sources(obj, np.unique(slots[selected]).tolist())
        images = list(dict.fromkeys(source.image for source in sources.values()))
        pictures = [picture_of(image) for image in images]
        copy.calc_loop_triangles()
        face = indices(copy.loop_triangles, "polygon_index")
        corners = indices(copy.loop_triangles, "loops", 3)
        image, places = np.full(len(face), -1), np.zeros((len(face), 3, 2))
        for slot, source in sources.items():
            of = slots[face] == slot
            image[of] = images.index(source.image)
            places[of] = _places(copy, source.uv_map, corners[of]) * source.image.size[:]
        mesh = TexturedMesh(
            _world(obj, column(copy.vertices, "co", 3, np.float32)),
            indices(copy.loop_triangles, "vertices", 3),
            places,
            image,
            selected[face],
            _sample(copy, obj, options, face),
        )
        faces = face[mesh.chosen]
        uv_maps = [sources[slot].uv_map for slot in slots[faces].tolist()]
        begins = indices(copy.polygons, "loop_start")[faces]
        return Read(mesh, faces, corners[mesh.chosen] - begins[:, None], uv_maps, images, pictures)


def _sources(obj: bpy.types.Object, needed: list[int]) -> dict[int, Source]:
    """Return what colours each slot of materials; raises ValueError where one that is needed has no such image."""
    found = {}
    materials = [slot.material for slot in obj.material_slots]
    for slot in sorted({*needed, *range(len(materials))}):
        material = materials[slot] if slot < len(materials) else None
        try:
            found[slot] = source_of(material, obj.data)
        except ValueError:
            if slot in needed:
                raise
    return found


def _sample(mesh: bpy.types.Mesh, obj: bpy.types.Object, options: TextureOptions, face: Ints) -> Mask | None:
    """Return the (t,) mask of the triangles whose detail is copied, None for those around."""
    if not (options.detail > 0.0 and options.detail_from):
        return None
    return faces_of_group(mesh, obj, options.detail_from)[face]


def _places(mesh: bpy.types.Mesh, uv_map: str, corners: Ints) -> Floats:
    """Return (k, 3, 2); 0 for what is no number."""
    uv = column(mesh.uv_layers[uv_map].uv, "vector", 2, np.float32).astype(np.float64)
    places: Floats = np.nan_to_num(uv, posinf=0.0, neginf=0.0)[corners]
    return places


def _world(obj: bpy.types.Object, positions: Floats) -> Floats:
    matrix = np.array(obj.matrix_world, dtype=np.float64)
    points: Floats = positions.astype(np.float64) @ matrix[:3, :3].T + matrix[:3, 3]
    return points


def write(obj: bpy.types.Object, before: Read, after: Textured) -> list[bpy.types.Image]:
    """Give the object copies of its images with the new colours, and its faces their new places; return the copies."""
    copies = {
        before.images[number]: copy_with(before.images[number], pixels) for number, pixels in after.pixels.items()
    }
    show_instead(obj, copies)
    if after.moved.any():
        _move(obj.data, before, after)
    return list(copies.values())


def _move(mesh: bpy.types.Mesh, before: Read, after: Textured) -> None:
    bm = bmesh.from_edit_mesh(mesh)
    bm.faces.ensure_lookup_table()
    image = before.mesh.image[before.mesh.chosen]
    for row in np.flatnonzero(after.moved).tolist():
        layer = bm.loops.layers.uv[before.uv_maps[row]]
        picture = before.pictures[image[row]]
        uv = after.places[row] / [picture.width, picture.height]
        loops = bm.faces[before.faces[row]].loops
        for corner, place in zip(before.corners[row].tolist(), uv.tolist(), strict=True):
            loops[corner][layer].uv = place
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)
