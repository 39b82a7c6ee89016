"""A scanned jar with a hole: the row of docs/textures.md."""

from typing import Any

import bpy
import numpy as np

import demo_pictures as pictures
from rows import Chosen, Row, placed

SIZE, MARGIN = 1024, 3  # texels
ROUND, UP = 96, 64  # faces


def jar() -> Chosen:
    """A jar of revolution whose islands lie scattered on the image, a hole in its side; its border is chosen."""
    points, faces = _jar()
    mesh = bpy.data.meshes.new("Jar")
    mesh.from_pydata(points.tolist(), [], faces)
    obj = placed(mesh)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(angle_limit=0.9, island_margin=0.01)
    bpy.ops.object.mode_set(mode="OBJECT")
    _cut(obj)
    mesh.materials.append(_painted(mesh))
    pictures.add_camera((0.0, 0.0, 0.05), (0.25, -1.0, 0.1), 1.7)
    return lambda edge: edge.is_boundary and max(abs(vertex.co.z) for vertex in edge.verts) < 0.9


def _jar() -> tuple[Any, list[list[int]]]:
    height, angle = np.meshgrid(np.linspace(-1.0, 1.0, UP + 1), 2.0 * np.pi * np.arange(ROUND) / ROUND, indexing="ij")
    radius = 0.62 + 0.22 * np.cos(2.2 * height + 0.5) + 0.03 * np.cos(5.0 * angle) * (1.0 - height**2)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1).reshape(-1, 3)
    row, column = np.divmod(np.arange(UP * ROUND), ROUND)
    after = (column + 1) % ROUND
    corners = [row * ROUND + column, row * ROUND + after, (row + 1) * ROUND + after, (row + 1) * ROUND + column]
    return points, np.stack(corners, axis=1).tolist()


def _cut(obj: bpy.types.Object) -> None:
    """Take out the faces of a ragged disc, and what hangs on them alone."""
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    for polygon in obj.data.polygons:
        x, y, z = polygon.center
        away = np.hypot(x - 0.1, z - 0.05)
        polygon.select = bool(y < 0.0 and away < 0.45 + 0.05 * np.sin(7.0 * np.arctan2(z, x)))
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.delete(type="FACE")
    bpy.ops.object.mode_set(mode="OBJECT")


def _painted(mesh: bpy.types.Mesh) -> bpy.types.Material:
    """A glaze that runs from ochre to blue, with clouds and speckles; black beyond a margin around the islands."""
    from bl_ext.user_default.intrinsic_fairing import fairing

    mesh.calc_loop_triangles()
    places = np.array([[mesh.uv_layers.active.uv[i].vector[:] for i in each.loops] for each in mesh.loop_triangles])
    corners = np.array([[mesh.vertices[i].co[:] for i in each.vertices] for each in mesh.loop_triangles])
    points = fairing.texel_values(places * SIZE, corners, SIZE, SIZE)
    for _ in range(MARGIN):
        for shift in ((0, 1), (0, -1), (1, 0), (-1, 0)):
            points = np.where(np.isfinite(points), points, np.roll(points, shift, (0, 1)))
    image = bpy.data.images.new("Glaze", SIZE, SIZE)
    image.pixels.foreach_set(_glaze(points).astype(np.float32).ravel())
    image.pack()
    material = bpy.data.materials.new("Glaze")
    material.use_nodes = True
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    tree.links.new(node.outputs["Color"], tree.nodes["Principled BSDF"].inputs["Base Color"])
    tree.nodes.active = node
    return material


def _glaze(points: Any) -> Any:
    """Stored colours (h, w, 4) at points (h, w, 3), black where there are none."""
    x, y, z = np.moveaxis(np.nan_to_num(points), 2, 0)
    clouds = 0.5 + 0.25 * np.sin(5.0 * x + 2.0 * z) + 0.25 * np.sin(4.0 * y - 6.0 * z + 1.0)
    blue = 1.0 / (1.0 + np.exp(-6.0 * (z + 0.15 * np.sin(5.0 * x) + 0.1)))
    colour = (1.0 - blue)[..., None] * [0.80, 0.55, 0.30] + blue[..., None] * [0.25, 0.45, 0.65]
    noise = np.random.default_rng(1).normal(size=x.shape)
    noise = sum(np.roll(noise, (i, j), (0, 1)) for i in range(3) for j in range(3)) / 3.0
    colour = colour * (0.8 + 0.3 * clouds[..., None]) - 0.22 * (noise > 1.0)[..., None] + 0.02 * noise[..., None]
    found = np.concatenate([np.clip(colour, 0.0, 1.0), np.ones((*x.shape, 1))], axis=2)
    found[~np.isfinite(points[..., 0]), :3] = 0.0
    return found


def _filled() -> None:
    bpy.ops.mesh.fair_fill("EXEC_DEFAULT")


def _textured(detail: float) -> None:
    _filled()
    bpy.ops.mesh.fair_texture("EXEC_DEFAULT", detail=detail)


RUNS = {"Fair Fill": _filled, "Fair Texture": lambda: _textured(0.0), "Detail 1": lambda: _textured(1.0)}
SHEETS = {"textures": [[Row("A hole", jar, "edges", RUNS, striped=False)]]}
