"""The image that gives a material its colour, and copies of it. Originals are never written."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np

from ..core.arrays import Pixels
from ..core.boundary_colours import Picture
from ..core.colours import Coding

SUFFIX = ".faired"
_NUMBERED = re.compile(re.escape(SUFFIX) + r"(\.\d+)?$")
_SINGLE = ("FILE", "GENERATED")  # sources of images that are no tiles, sequences, movies or results


@dataclass(frozen=True)
class Source:
    """An image, and the UV map that lays it on a mesh."""

    image: bpy.types.Image
    uv_map: str


def source_of(material: Any, mesh: bpy.types.Mesh) -> Source:
    """Return what colours faces of a material; raises ValueError where no image with a UV map does."""
    if material is None or material.node_tree is None:
        raise ValueError("The selected faces have no material with an image: give them the one of the faces around")
    node = _image_node(material)
    if node is None:
        raise ValueError(f"No image gives the material {material.name!r} its colour; those in node groups don't count")
    image = node.image
    if image.source not in _SINGLE:
        raise ValueError(
            f"The image {image.name!r} is no single one: tiles (UDIM), sequences, movies and render results can't be "
            "continued"
        )
    uv_map = _uv_map(node, mesh)
    if uv_map is None:
        raise ValueError(f"The image {image.name!r} lies on the faces by something else than a UV map")
    if not image.size[0] or not len(image.pixels):
        raise ValueError(f"The file of the image {image.name!r} can't be read")
    return Source(image, uv_map)


def _image_node(material: Any) -> Any:
    """Return the first image from a material's output on, along colours and shaders."""
    output = material.node_tree.get_output_node("ALL")
    ahead = [] if output is None else [output.inputs["Surface"]]
    seen = set()
    while ahead:
        socket = ahead.pop(0)
        for link in socket.links:
            node = link.from_node
            if node.name in seen:
                continue
            seen.add(node.name)
            if node.bl_idname == "ShaderNodeTexImage" and node.image is not None:
                return node
            ahead += [each for each in node.inputs if each.type in ("RGBA", "SHADER") or node.type == "REROUTE"]
    return None


def _uv_map(node: Any, mesh: bpy.types.Mesh) -> str | None:
    """Return the name of the UV map that an image node reads; None where it reads something else."""
    shown = next((layer.name for layer in mesh.uv_layers if layer.active_render), None)
    if node.projection != "FLAT":
        return None
    links = node.inputs["Vector"].links
    while links and links[0].from_node.type == "REROUTE":
        links = links[0].from_node.inputs[0].links
    if not links:
        return shown
    before, socket = links[0].from_node, links[0].from_socket
    if before.bl_idname == "ShaderNodeUVMap":
        wanted = before.uv_map or shown
    else:
        wanted = shown if before.bl_idname == "ShaderNodeTexCoord" and socket.name == "UV" else None
    return wanted if wanted and wanted in mesh.uv_layers else None


def picture_of(image: bpy.types.Image) -> Picture:
    """Read an image."""
    width, height = image.size
    stored = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(stored)
    stored = stored.reshape(height, width, image.channels)
    pixels: Pixels = stored
    if image.channels != 4:
        pixels = np.ones((height, width, 4), dtype=np.float32)
        pixels[..., : min(image.channels, 3)] = stored[..., :3]
        if image.channels < 3:  # grey
            pixels[..., :3] = stored[..., :1]
    is_bytes = not image.is_float
    srgb = is_bytes and image.colorspace_settings.name == "sRGB"
    return Picture(pixels, Coding(srgb, is_bytes and image.alpha_mode == "STRAIGHT", is_bytes))


def copy_with(image: bpy.types.Image, pixels: Pixels) -> bpy.types.Image:
    """Return a new image like this one with other pixels (h, w, 4), packed into the file."""
    name = _NUMBERED.sub("", image.name) + SUFFIX
    height, width = pixels.shape[:2]
    copy = bpy.data.images.new(name, width, height, alpha=image.depth % 32 == 0, float_buffer=image.is_float)
    copy.colorspace_settings.name = image.colorspace_settings.name  # before there are pixels, which it would drop
    copy.alpha_mode = image.alpha_mode
    copy.pixels.foreach_set(np.ascontiguousarray(pixels, dtype=np.float32).ravel())
    copy.update()
    copy.pack()
    return copy


def show_instead(obj: bpy.types.Object, copies: dict[bpy.types.Image, bpy.types.Image]) -> None:
    """Let the materials of an object show copies of images; materials that others use are copied, too."""
    for material in {slot.material for slot in obj.material_slots if slot.material is not None}:
        if not any(node.image in copies for node in _image_nodes(material)):
            continue
        slots = [slot for slot in obj.material_slots if slot.material == material]
        own = material
        if material.library or material.override_library or material.users - material.use_fake_user > len(slots):
            own = material.copy()
            for slot in slots:
                slot.material = own
        for node in _image_nodes(own):
            node.image = copies.get(node.image, node.image)
    for image in copies:
        # What no one shows is not saved, and an original may be in this file alone.
        is_only_here = image.packed_file is not None or image.is_dirty or not image.filepath
        if is_only_here and not (image.users or image.library or _NUMBERED.search(image.name)):
            image.use_fake_user = True


def _image_nodes(material: Any) -> list[Any]:
    nodes = [] if material.node_tree is None else material.node_tree.nodes
    return [node for node in nodes if node.bl_idname == "ShaderNodeTexImage" and node.image is not None]
