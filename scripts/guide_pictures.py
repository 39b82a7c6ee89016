"""The user guide's rows of pictures: the same selection, faired with different options."""

import sys
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import demo  # before bpy: it sets Blender's scratch folder

# isort: split
import bpy
import numpy as np

import demo_pictures as pictures
import demo_scenes as scenes

pictures.SIZE = 240  # pixels of one picture

Options = dict[str, Any] | None  # None: the shape before
Scene = Callable[[], tuple[bpy.types.Object, Any]]


def ball() -> tuple[bpy.types.Object, Any]:
    """A sphere whose upper half is pressed flat."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
    obj = bpy.context.object
    obj.data.shade_smooth()
    upper = np.array([polygon.center.z > 0.0 for polygon in obj.data.polygons])
    points = scenes.positions(obj.data)
    above = points[:, 2] > 1e-4
    points[above, 2] *= -0.4 + 0.2 * np.cos(9.0 * points[above, 0])
    obj.data.vertices.foreach_set("co", points.ravel().astype(np.float32))
    obj.data.update()
    pictures.add_camera((0.0, 0.0, 0.15), (1.0, -1.0, 0.5), 2.9)
    return obj, upper


def mesa() -> tuple[bpy.types.Object, Any]:
    """A round table mountain, its flat top selected; custom normals that point straight up."""
    profile = [(0.04 * k, 0.3) for k in range(1, 16)] + [(0.6 + 0.03 * k, 0.3 - 0.06 * k) for k in range(1, 6)]
    profile += [(0.75 + 0.05 * k, 0.0) for k in range(1, 8)]
    count = 72
    angles = 2.0 * np.pi * np.arange(count) / count
    points = [(0.0, 0.0, 0.3)] + [(r * np.cos(a), r * np.sin(a), z) for r, z in profile for a in angles]
    corners = [[1 + k * count + j % count for j in range(count + 1)] for k in range(len(profile))]
    faces = [(0, corners[0][j], corners[0][j + 1]) for j in range(count)]
    for inner, outer in pairwise(corners):
        faces += [(inner[j], outer[j], outer[j + 1], inner[j + 1]) for j in range(count)]
    mesh = bpy.data.meshes.new("Mesa")
    mesh.from_pydata(points, [], faces)
    obj = bpy.data.objects.new("Mesa", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    mesh.shade_smooth()
    mesh.normals_split_custom_set_from_vertices([(0.0, 0.0, 1.0)] * len(points))
    pictures.add_camera((0.0, 0.0, 0.2), (0.6, -1.0, 0.45), 2.3)
    return obj, np.array([np.hypot(*polygon.center.xy) < 0.6 for polygon in mesh.polygons])


def hill() -> tuple[bpy.types.Object, Any]:
    """A plain with a hill on it, selected with some of the plain; vertex group "Pin" and seams."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=64, y_subdivisions=64, size=2.0)
    obj = bpy.context.object
    obj.data.shade_smooth()
    points = scenes.positions(obj.data)
    radius = np.linalg.norm(points[:, :2], axis=1)
    points[:, 2] = 0.5 * np.exp(-6.0 * radius**2) - 0.15 * points[:, 0] ** 2
    obj.data.vertices.foreach_set("co", points.ravel().astype(np.float32))
    top = [int(radius.argmin())]
    ring = np.isclose(np.abs(points[:, :2]).max(axis=1), 0.25, atol=1e-3)
    obj.vertex_groups.new(name="Top").add(top, 1.0, "REPLACE")
    obj.vertex_groups.new(name="Ring").add(np.flatnonzero(ring).tolist(), 1.0, "REPLACE")
    line = np.isclose(points[:, 0], 0.25, atol=1e-3)
    for edge in obj.data.edges:
        edge.use_seam = bool(line[list(edge.vertices)].all())
    pictures.add_camera((0.0, 0.0, 0.1), (0.6, -1.0, 0.6), 2.3)
    centres = np.array([polygon.center for polygon in obj.data.polygons])
    return obj, np.linalg.norm(centres[:, :2], axis=1) < 0.6


def ear() -> tuple[bpy.types.Object, Any]:
    """Suzanne's ear."""
    monkey = scenes.suzanne()
    pictures.add_camera((0.85, 0.0, 0.2), (1.0, -0.6, 0.2), 1.7)
    return monkey, scenes.ear_faces(monkey.data)


def checkered_ear() -> tuple[bpy.types.Object, Any]:
    """Suzanne's ear with a checker on its texture coordinates."""
    monkey, faces = ear()
    image = bpy.data.images.new("Checker", 1024, 1024)
    rows = np.arange(1024) // 12 % 2
    tone = np.where(rows[:, None] ^ rows[None, :], 0.85, 0.25)
    image.pixels.foreach_set(np.dstack([tone, tone, tone, np.ones_like(tone)]).ravel().astype(np.float32))
    material = bpy.data.materials.new("Checker")
    material.use_nodes = True
    texture = material.node_tree.nodes.new("ShaderNodeTexImage")
    texture.image = image
    material.node_tree.nodes.active = texture
    monkey.data.materials.append(material)
    return monkey, faces


def constant(bulge: float) -> dict[str, Any]:
    return {"shape": "HARMONIC", "bulge": bulge}


def multigrid(**options: Any) -> dict[str, Any]:
    return {"multigrid": True, **options}


WEIGHTS = ("UNIFORM", "CONFORMAL", "INVERSE_DISTANCE", "SHAPE_PRESERVING")
ROWS: dict[str, tuple[Scene, tuple[Options, ...]]] = {
    "factor": (ear, (None, {"factor": 0.5}, {"factor": 1.0})),
    "shape": (ball, (None, {}, {"shape": "MINIMAL_ENERGY"}, {"continuity": "G0"})),
    "bulge": (hill, tuple(constant(b) for b in (-0.5, 0.0, 0.3, 0.6))),
    "vertices": (checkered_ear, (None, *({"inner_fairness": w} for w in WEIGHTS))),
    "tangent": (mesa, (None, *({"boundary_normals": source} for source in ("SURROUNDING", "AVERAGE", "CUSTOM")))),
    "pins": (hill, (None, {}, {"pin_group": "Top"}, {"pin_group": "Ring"})),
    "pin_edges": (hill, (None, {}, {"pin_edges": "SEAM"})),
    "solver": (
        ear,
        (
            {},
            multigrid(),
            multigrid(tolerance=1e-2),
            multigrid(max_iterations=5),
            multigrid(max_iterations=5, levels=1),
        ),
    ),
}


def tile(scene: Scene, options: Options, path: Path) -> Path:
    """Render one picture of a row."""
    bpy.ops.wm.read_homefile(use_empty=True)
    obj, faces = scene()
    textured = bool(obj.data.materials)
    if not textured:
        pictures.tint(obj.data, faces)
    if options is not None:
        scenes.select(obj, faces)
        bpy.ops.mesh.fair_region("EXEC_DEFAULT", allow_folds=True, **options)
        bpy.ops.object.mode_set(mode="OBJECT")
        report = bpy.context.window_manager.fairing_report
        print(f"{path.stem}: converged {report.converged}, distortion {report.distortion:.3f}", flush=True)
    pictures.shaded(path, "TEXTURE" if textured else "MATERIAL")
    return path


def main() -> None:
    """Usage: guide_pictures.py ZIP OUTPUT_FOLDER."""
    package, out = Path(sys.argv[1]), Path(sys.argv[2])
    demo.install(package)
    for name, (scene, row) in ROWS.items():
        paths = [tile(scene, options, out / f"{name}_{number}.png") for number, options in enumerate(row)]
        pictures.contact_sheet([paths], out / f"guide_{name}.png")


if __name__ == "__main__":
    main()
