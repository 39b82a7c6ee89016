"""Headless pictures: clay in Workbench, reflection stripes in Cycles."""

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Vector

SIZE = 640  # pixels, square
STRIPES = 18.0  # radians per unit of the mirrored direction
ACROSS = (0.35, 0.2, 0.92)  # the stripes lie across this direction, askew: upright walls have them too
EDGE = (-0.15, 0.15, 0.02, 0.8)  # of a stripe: from these heights of the wave to these tones
BACKGROUND = (0.045, 0.05, 0.055)  # linear


def add_camera(target: Iterable[float], direction: Iterable[float], width: float) -> None:
    """Look at `target` from `direction`, orthographic, `width` units across."""
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = width
    away = Vector(direction).normalized()
    camera.location = Vector(target) + 10.0 * away
    camera.rotation_euler = away.to_track_quat("Z", "Y").to_euler()
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def _render(path: Path, material: bpy.types.Material | None) -> None:
    scene = bpy.context.scene
    scene.view_layers[0].material_override = material
    scene.world = bpy.data.worlds.get("Backdrop") or bpy.data.worlds.new("Backdrop")
    scene.world.color = BACKGROUND
    scene.render.resolution_x = scene.render.resolution_y = SIZE
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)


def shaded(path: Path, colours: str = "MATERIAL") -> None:
    """Render clay, coloured by "MATERIAL" or "TEXTURE"."""
    scene = bpy.context.scene
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.display.shading.light = "STUDIO"
    scene.display.shading.color_type = colours
    scene.display.shading.show_specular_highlight = True
    scene.display.render_aa = "8"
    _render(path, None)


def striped(path: Path) -> None:
    """Render stripes mirrored in the surface: a kink breaks them, a curvature jump bends them."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 12
    scene.cycles.use_denoising = False
    _render(path, stripe_material())


def stripe_material() -> bpy.types.Material:
    """Emit black or white by the direction into which the viewer's ray is mirrored."""
    material = bpy.data.materials.get("Stripes")
    if material is not None:
        return material
    material = bpy.data.materials.new("Stripes")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    mirrored = _math(tree, "ShaderNodeVectorMath", "REFLECT", geometry.outputs["Incoming"])
    tree.links.new(geometry.outputs["Normal"], mirrored.inputs[1])
    along = _math(tree, "ShaderNodeVectorMath", "DOT_PRODUCT", mirrored.outputs[0])
    along.inputs[1].default_value = ACROSS
    wave = _math(tree, "ShaderNodeMath", "MULTIPLY", along.outputs["Value"], STRIPES)
    wave = _math(tree, "ShaderNodeMath", "SINE", wave.outputs[0])
    tone = tree.nodes.new("ShaderNodeMapRange")
    tree.links.new(wave.outputs[0], tone.inputs["Value"])
    for socket, value in zip(("From Min", "From Max", "To Min", "To Max"), EDGE, strict=True):
        tone.inputs[socket].default_value = value
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(tone.outputs[0], emission.inputs["Color"])
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def _math(tree: Any, kind: str, operation: str, first: Any, second: float | None = None) -> Any:
    node = tree.nodes.new(kind)
    node.operation = operation
    tree.links.new(first, node.inputs[0])
    if second is not None:
        node.inputs[1].default_value = second
    return node


def tint(mesh: bpy.types.Mesh, faces: Any) -> None:
    """Give the faces a warmer clay than the rest, so that pictures show what was selected."""
    for name, colour in (("Clay", (0.78, 0.78, 0.78, 1.0)), ("Selected", (0.95, 0.48, 0.16, 1.0))):
        material = bpy.data.materials.new(name)
        material.diffuse_color = colour
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", faces.astype(np.int32).tolist())
    mesh.update()


def contact_sheet(rows: Iterable[Iterable[Path]], target: Path) -> None:
    """Join pictures of one size, rows from top to bottom."""
    strips = [np.concatenate([pixels(path) for path in row], axis=1) for row in rows]
    joined = np.concatenate(strips[::-1], axis=0)  # Blender's images start at the bottom
    height, width, _ = joined.shape
    image = bpy.data.images.new(target.stem, width, height, alpha=True)
    image.pixels.foreach_set(joined.ravel())
    image.filepath_raw = str(target)
    image.file_format = "PNG"
    image.save()
    bpy.data.images.remove(image)


def pixels(path: Path) -> Any:
    """Return (height, width, 4), from the bottom to the top as Blender has them."""
    image = bpy.data.images.load(str(path))
    width, height = image.size
    values = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    return values.reshape(height, width, 4)
