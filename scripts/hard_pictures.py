"""Pictures for hard_surfaces.md and fillet.md: what was there, Blender's own best, and ours, each with stripes."""

import sys
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import demo  # before bpy: it sets Blender's scratch folder

# isort: split
import bmesh
import bpy
import numpy as np

import demo_pictures as pictures
import demo_scenes as scenes

pictures.SIZE = 176  # pixels of one picture

Chosen = Callable[[Any], Any]


def edit(mode: tuple[bool, bool, bool], kind: str, chosen: Chosen) -> None:
    """Enter edit mode with exactly these vertices, edges or faces selected; chosen: of an element of bmesh."""
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = mode
    bpy.ops.mesh.select_all(action="DESELECT")
    bm = bmesh.from_edit_mesh(bpy.context.object.data)
    for element in [each for each in getattr(bm, kind) if chosen(each)]:
        element.select_set(True)
    bm.select_flush_mode()
    bmesh.update_edit_mesh(bpy.context.object.data)


def edges(chosen: Chosen) -> None:
    """Select edges."""
    edit((False, True, False), "edges", chosen)


def made(bm: Any) -> None:
    """The object of a scene."""
    mesh = bpy.data.meshes.new("Part")
    bm.to_mesh(mesh)
    bm.free()
    obj = bpy.data.objects.new("Part", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)


def swept(profile: list[tuple[float, float]], rows: int, hole: Callable[[Any], bool]) -> None:
    """A profile of (x, z) along y, without the faces whose middle is in the hole."""
    bm = bmesh.new()
    lines = [[bm.verts.new((x, y, z)) for y in np.linspace(-1.0, 1.0, rows + 1)] for x, z in profile]
    for a, b in pairwise(lines):
        for k in range(rows):
            bm.faces.new((a[k], b[k], b[k + 1], a[k + 1]))
    bmesh.ops.delete(bm, geom=[face for face in bm.faces if hole(face.calc_center_median())], context="FACES")
    made(bm)
    pictures.add_camera((0.0, 0.0, -0.25), (0.9, -0.7, 0.9), 2.7)


def rim(edge: Any) -> bool:
    """Whether an edge bounds the hole in the middle."""
    return bool(edge.is_boundary and all(v.co.length < 0.9 for v in edge.verts))


def box_edge() -> None:
    """A hole over the edge of a box."""
    profile = [(-1 + k / 8, 0.0) for k in range(9)] + [(0.0, -k / 8) for k in range(1, 9)]
    swept(profile, 16, lambda at: at.length < 0.55)


def bevelled_edge() -> None:
    """A hole over a bevelled edge."""
    arc = [(-0.2 + 0.2 * np.sin(t), -0.2 + 0.2 * np.cos(t)) for t in np.linspace(0, np.pi / 2, 6)]
    profile = [(-1 + k / 10, 0.0) for k in range(8)] + arc + [(0.0, -0.3 - k / 10) for k in range(8)]
    swept(profile, 16, lambda at: at.length < 0.55)


def join(body: Any, boss: Any) -> None:
    """Add the boss to the body by a boolean."""
    bpy.context.view_layer.objects.active = body
    joined = body.modifiers.new("Joined", "BOOLEAN")
    joined.operation, joined.object, joined.solver = "UNION", boss, "EXACT"
    bpy.ops.object.modifier_apply(modifier="Joined")
    bpy.data.objects.remove(boss)


def letter() -> None:
    """A letter on a bent plate, joined by a boolean."""
    bm = bmesh.new()
    columns, rows = 24, 3
    lines = []
    for radius in (1.5, 1.3):
        turns = np.linspace(-0.5, 0.5, columns + 1)
        lines.append([
            [bm.verts.new((radius * np.sin(t), y, radius * np.cos(t) - 1.5)) for y in np.linspace(-0.6, 0.6, rows + 1)]
            for t in turns
        ])  # fmt: skip
    outer, inner = lines
    for k in range(columns):
        for j in range(rows):
            bm.faces.new((outer[k][j], outer[k + 1][j], outer[k + 1][j + 1], outer[k][j + 1]))
            bm.faces.new((inner[k][j], inner[k][j + 1], inner[k + 1][j + 1], inner[k + 1][j]))
        bm.faces.new((outer[k][0], inner[k][0], inner[k + 1][0], outer[k + 1][0]))
        bm.faces.new((outer[k][-1], outer[k + 1][-1], inner[k + 1][-1], inner[k][-1]))
    for j in range(rows):
        bm.faces.new((outer[0][j], outer[0][j + 1], inner[0][j + 1], inner[0][j]))
        bm.faces.new((outer[-1][j], inner[-1][j], inner[-1][j + 1], outer[-1][j + 1]))
    bmesh.ops.recalc_face_normals(bm, faces=bm.faces)
    made(bm)
    plate = bpy.context.object
    text = bpy.data.curves.new("Letter", "FONT")
    text.body, text.size, text.extrude, text.align_x, text.align_y = "R", 1.0, 0.15, "CENTER", "CENTER"
    text.resolution_u = 3
    curve = bpy.data.objects.new("Letter", text)
    bpy.context.collection.objects.link(curve)
    solid = bpy.data.meshes.new_from_object(curve.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    bpy.data.objects.remove(curve)
    weld = bmesh.new()
    weld.from_mesh(solid)
    bmesh.ops.remove_doubles(weld, verts=weld.verts, dist=1e-6)
    weld.to_mesh(solid)
    weld.free()
    boss = bpy.data.objects.new("Boss", solid)
    bpy.context.collection.objects.link(boss)
    join(plate, boss)
    pictures.add_camera((0.0, 0.0, 0.05), (0.35, -0.9, 0.9), 1.15)


def foot(edge: Any) -> bool:
    """Whether an edge lies where the letter meets the plate."""
    on_plate = all(abs(np.hypot(v.co.x, v.co.z + 1.5) - 1.5) < 0.004 for v in edge.verts)
    return bool(on_plate and len(edge.link_faces) == 2 and edge.calc_face_angle_signed() < -0.5)


def cylinders() -> None:
    """A cylinder on a block, joined by a boolean."""
    bpy.ops.mesh.primitive_cube_add(size=2.0, location=(0.0, 0.0, -1.0))
    bpy.ops.object.transform_apply(location=True)
    block = bpy.context.object
    bpy.ops.mesh.primitive_cylinder_add(vertices=48, radius=0.5, depth=1.6, rotation=(0.35, 0.0, 0.0))
    boss = bpy.context.object
    join(block, boss)
    pictures.add_camera((0.0, 0.0, 0.1), (0.8, -0.9, 0.7), 2.6)


def seam(edge: Any) -> bool:
    """Whether it lies in the block's top and inside of it."""
    inside = all(abs(v.co.z) < 1e-4 and max(abs(v.co.x), abs(v.co.y)) < 0.95 for v in edge.verts)
    return bool(inside and len(edge.link_faces) == 2 and edge.calc_face_angle_signed() < -0.3)


def lid() -> None:
    """The top of a box, dented, all of it selected."""
    bpy.ops.mesh.primitive_cube_add(size=1.6)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=11)
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = bpy.context.object.data
    points = scenes.positions(mesh)
    top = points[:, 2] > 0.79
    away = np.hypot(points[:, 0] - 0.1, points[:, 1] + 0.1)
    points[top, 2] -= 0.35 * np.exp(-((away[top] / 0.3) ** 2))
    mesh.vertices.foreach_set("co", points.ravel().astype(np.float32))
    mesh.update()
    pictures.add_camera((0.0, 0.0, 0.0), (0.7, -0.9, 0.9), 2.7)


def top_faces() -> None:
    """Select it."""
    edit((False, False, True), "faces", lambda face: all(v.co.z > 0.3 for v in face.verts) and face.normal.z > 0.2)


def smoothed() -> None:
    """Blender's own inside the box's top: no operator of edit mode fairs, Smooth Vertices is what there is."""
    edit((True, False, False), "verts", lambda v: v.co.z > 0.3 and max(abs(v.co.x), abs(v.co.y)) < 0.79)
    bpy.ops.mesh.vertices_smooth(factor=0.5, repeat=60)


def bevelled(chosen: Chosen, width: float) -> Callable[[], None]:
    """Blender's Bevel of these edges."""

    def run() -> None:
        edges(chosen)
        bpy.ops.mesh.bevel(offset=width, offset_type="OFFSET", segments=8, profile=0.5)

    return run


def filled() -> None:
    """Blender's Grid Fill, or Fill where it refuses."""
    edges(rim)
    try:
        bpy.ops.mesh.fill_grid()
    except RuntimeError:
        bpy.ops.mesh.fill()


def fair_filled() -> None:
    """Fair Fill over the hole."""
    edges(rim)
    bpy.ops.mesh.fair_fill("EXEC_DEFAULT")


def fair_fillet(chosen: Chosen, width: float) -> Callable[[], None]:
    """Fair Fillet of these edges."""

    def run() -> None:
        edges(chosen)
        bpy.ops.mesh.fair_fillet("EXEC_DEFAULT", width=width)

    return run


def fair_region() -> None:
    """Fair Region on the box's top."""
    top_faces()
    bpy.ops.mesh.fair_region("EXEC_DEFAULT")


def nothing() -> None:
    """What was there."""


SHEETS: dict[str, list[tuple[Callable[[], None], list[Callable[[], None]]]]] = {
    "hard_surfaces": [
        (box_edge, [nothing, filled, fair_filled]),
        (bevelled_edge, [nothing, filled, fair_filled]),
        (lid, [nothing, smoothed, fair_region]),
    ],
    "fillets": [
        (cylinders, [nothing, bevelled(seam, 0.2), fair_fillet(seam, 0.2)]),
        (letter, [nothing, bevelled(foot, 0.03), fair_fillet(foot, 0.03)]),
    ],
}


def tiles(scene: Callable[[], None], run: Callable[[], None], path: Path) -> list[Path]:
    """Clay and stripes of one result, smooth but for its hard edges."""
    bpy.ops.wm.read_homefile(use_empty=True)
    scene()
    run()
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    mesh = bpy.context.object.data
    mesh.shade_smooth()
    mesh.set_sharp_from_angle(angle=0.6)
    pictures.tint(mesh, np.zeros(len(mesh.polygons), dtype=bool))
    found = [path.with_name(f"{path.stem}_{kind}.png") for kind in ("clay", "stripes")]
    pictures.shaded(found[0])
    pictures.striped(found[1])
    return found


def main() -> None:
    """Usage: hard_pictures.py ZIP OUTPUT_FOLDER."""
    package, out = Path(sys.argv[1]), Path(sys.argv[2])
    demo.install(package)
    for name, rows in SHEETS.items():
        sheet = []
        for number, (scene, runs) in enumerate(rows):
            made_here = [tiles(scene, run, out / f"{name}_{number}_{k}.png") for k, run in enumerate(runs)]
            sheet.append([path for pair in made_here for path in pair])
        pictures.contact_sheet(sheet, out / f"{name}.png")


if __name__ == "__main__":
    main()
