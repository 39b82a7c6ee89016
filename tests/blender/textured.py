"""Objects with an image on them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

import meshes

Floats = meshes.Floats
Field = Callable[[Floats, Floats], Floats]  # of u and v, (…, 4) as the image stores it


def image_of(field: Field, size: int = 256, *, floats: bool = False, name: str = "Skin") -> bpy.types.Image:
    """Add a packed image."""
    image = bpy.data.images.new(name, size, size, alpha=True, float_buffer=floats)
    v, u = (np.mgrid[:size, :size] + 0.5) / size
    image.pixels.foreach_set(np.ascontiguousarray(field(u, v), dtype=np.float32).ravel())
    image.update()
    image.pack()
    return image


def pixels(image: bpy.types.Image) -> Floats:
    """Return (h, w, 4) as the image stores them."""
    width, height = image.size
    found = np.empty(4 * width * height, dtype=np.float32)
    image.pixels.foreach_get(found)
    return found.reshape(height, width, 4)


def material_of(image: bpy.types.Image | None, name: str = "Paint", uv_map: str = "") -> bpy.types.Material:
    """Add a material whose base colour is the image."""
    material = bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    node = nodes.new("ShaderNodeTexImage")
    node.name, node.image = "Colour", image
    links.new(node.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    if uv_map:
        names = nodes.new("ShaderNodeUVMap")
        names.uv_map = uv_map
        links.new(names.outputs["UV"], node.inputs["Vector"])
    return material


def lay_out(obj: bpy.types.Object, place: Callable[[Floats, Any], Floats], name: str = "Map") -> None:
    """Give an object in object mode a UV map: place takes points (k, 3) of a polygon, and this, to (k, 2)."""
    mesh, points = obj.data, meshes.positions(obj)
    uv = np.zeros((len(mesh.loops), 2))
    for polygon in mesh.polygons:
        uv[list(polygon.loop_indices)] = place(points[list(polygon.vertices)], polygon)
    layer = mesh.uv_layers.get(name) or mesh.uv_layers.new(name=name)
    layer.uv.foreach_set("vector", uv.astype(np.float32).ravel())


def places(obj: bpy.types.Object, name: str = "Map") -> Floats:
    """Return the (c, 2) UVs of an object in object mode."""
    found = np.empty(2 * len(obj.data.loops), dtype=np.float32)
    obj.data.uv_layers[name].uv.foreach_get("vector", found)
    return found.reshape(-1, 2)


def shown(obj: bpy.types.Object, slot: int = 0) -> bpy.types.Image:
    """Return the image that a material of an object shows."""
    image: bpy.types.Image = obj.material_slots[slot].material.node_tree.nodes["Colour"].image
    return image
