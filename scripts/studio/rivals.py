"""Six jobs, done by Blender's own tools and by this extension: docs/which_tool.md."""

from collections.abc import Callable
from typing import Any

import bmesh
import bpy
import numpy as np

import demo_pictures as pictures
import demo_scenes as scenes
import tools
from rows import Chosen, Points, Row, marked, moved


def panel_height(points: Points) -> Points:
    """Height of a car's panel over (x, y)."""
    x, y = points[:, 0], points[:, 1]
    return 0.35 - 0.28 * x**2 - 0.12 * y**2 - 0.1 * np.abs(x - 0.2) ** 3


def panel() -> Chosen:
    """The panel with a dent off its middle, selected with a little around it."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=60, y_subdivisions=60, size=2.0)

    def dented(points: Points) -> Points:
        dent = 0.09 * np.exp(-(((points[:, 0] - 0.15) / 0.16) ** 2) - ((points[:, 1] + 0.1) / 0.22) ** 2)
        points[:, 2] = panel_height(points) - dent
        return points

    moved(dented)
    pictures.add_camera((0.0, 0.0, 0.1), (0.5, -0.9, 0.75), 2.3)

    def around_dent(face: Any) -> bool:
        at = face.calc_center_median()
        return bool(((at.x - 0.15) / 0.5) ** 2 + ((at.y + 0.1) / 0.6) ** 2 < 1.0)

    return around_dent


def ear() -> Chosen:
    """Suzanne's ear."""
    monkey = scenes.suzanne()
    pictures.add_camera((0.2, 0.0, 0.0), (1.0, -0.45, 0.2), 2.8)
    return marked(scenes.ear_faces(monkey.data))


def rewritten(change: Callable[[Any], None]) -> None:
    """Change the active mesh by bmesh."""
    mesh = bpy.context.object.data
    bm = bmesh.new()
    bm.from_mesh(mesh)
    change(bm)
    bm.to_mesh(mesh)
    bm.free()


def cut_along(longer_than: float, cuts: int) -> None:
    """Subdivide the active mesh's long edges."""

    def cut(bm: Any) -> None:
        long = [edge for edge in bm.edges if edge.calc_length() > longer_than]
        bmesh.ops.subdivide_edges(bm, edges=long, cuts=cuts)

    rewritten(cut)


def limb() -> Chosen:
    """A tube, crumpled in its middle third."""
    bpy.ops.mesh.primitive_cylinder_add(vertices=48, radius=0.5, depth=3.0, end_fill_type="NOTHING", calc_uvs=False)
    cut_along(1.0, 47)

    def crumpled(points: Points) -> Points:
        inside = np.abs(points[:, 2]) < 0.7
        turn = np.arctan2(points[:, 1], points[:, 0])
        fade = np.cos(0.5 * np.pi * points[:, 2] / 0.7) ** 2
        swell = 1.0 + fade * (0.35 * np.sin(2 * turn + 1.0) + 0.25 * np.sin(3 * turn + 9.0 * points[:, 2]) - 0.2)
        points[inside, :2] *= swell[inside, None]
        return points

    moved(crumpled)
    pictures.add_camera((0.0, 0.0, 0.0), (0.7, -1.0, 0.45), 2.9)
    return lambda face: bool(abs(face.calc_center_median().z) < 0.75)


def half_sphere() -> Chosen:
    """The lower half of a sphere, its rim selected."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24)

    def halved(bm: Any) -> None:
        upper = [face for face in bm.faces if face.calc_center_median().z > 0.0]
        bmesh.ops.delete(bm, geom=upper, context="FACES")

    rewritten(halved)
    pictures.add_camera((0.0, 0.0, 0.0), (0.9, -0.9, 0.5), 2.4)
    return lambda edge: bool(edge.is_boundary)


def pipe(at: tuple[float, float, float], turn: float) -> None:
    """A short pipe, turned about y."""
    bpy.ops.mesh.primitive_cylinder_add(
        vertices=32, radius=0.4, depth=0.8, location=at, rotation=(0.0, turn, 0.0), end_fill_type="NOTHING"
    )
    bpy.ops.object.transform_apply(location=True, rotation=True)


def pipes() -> Chosen:
    """Two pipes' ends at a right angle, the facing loops selected."""
    pipe((0.0, 0.0, -0.7), 0.0)
    pipe((1.4, 0.0, 0.7), np.pi / 2)
    for obj in bpy.context.scene.objects:
        obj.select_set(obj.type == "MESH")
    bpy.ops.object.join()
    cut_along(0.5, 9)
    pictures.add_camera((0.5, 0.0, 0.05), (-0.2, -1.0, 0.35), 2.9)
    return lambda edge: bool(edge.is_boundary and all(v.co.z > -0.31 and v.co.x < 1.01 for v in edge.verts))


def seam() -> Chosen:
    """A leaning cylinder on a block, joined by a boolean; the seam selected."""
    bpy.ops.mesh.primitive_cube_add(size=2.0, location=(0.0, 0.0, -1.0))
    bpy.ops.object.transform_apply(location=True)
    block = bpy.context.object
    bpy.ops.mesh.primitive_cylinder_add(vertices=48, radius=0.5, depth=1.6, rotation=(0.35, 0.0, 0.0))
    tools.join(block, bpy.context.object)
    pictures.add_camera((0.0, 0.0, 0.1), (0.8, -0.9, 0.7), 2.6)

    def foot(edge: Any) -> bool:
        inside = all(abs(v.co.z) < 1e-4 and max(abs(v.co.x), abs(v.co.y)) < 0.95 for v in edge.verts)
        return bool(inside and len(edge.link_faces) == 2 and edge.calc_face_angle_signed() < -0.3)

    return foot


REGION = {
    "Smooth Vertices × 100": tools.smooth_vertices(100),
    "Smooth Laplacian": tools.laplacian_smooth,
    "Fair Tangency": tools.fair_tangency,
    "Fair Region": tools.fair_region(),
}
EAR = Row("Remove an ear", ear, "faces", REGION, timed=True)
PANEL = Row(
    "A dent in a panel", panel, "faces", REGION, timed=True,
    away=lambda points: np.abs(points[:, 2] - panel_height(points)), size=1.2,
)  # fmt: skip
LIMB = Row(
    "A crumpled limb", limb, "faces", REGION, timed=True,
    away=lambda points: np.abs(np.hypot(points[:, 0], points[:, 1]) - 0.5), size=1.8,
)  # fmt: skip
DOME = Row(
    "A hole: half a sphere", half_sphere, "edges",
    {"F": tools.fill, "Grid Fill": tools.grid_fill, "Fair Fill": tools.fair_fill}, timed=True,
    away=lambda points: np.abs(np.linalg.norm(points, axis=1) - 1.0), size=2.0,
)  # fmt: skip
PIPES = Row(
    "Join two pipes", pipes, "edges",
    {"Bridge Edge Loops": tools.bridge_edge_loops, "Fair Fill": tools.fair_bridge}, timed=True,
)  # fmt: skip
SEAM = Row(
    "Round a seam", seam, "edges", {"Bevel": tools.bevel(0.2), "Fair Fillet": tools.fair_fillet(0.2)}, timed=True
)


def ours(row: Row, name: str) -> Row:
    """This extension's run alone."""
    return row._replace(runs={name: row.runs[name]}, timed=False, away=None)


SHEETS = {
    "which_ear": [[EAR]],
    "which_panel": [[PANEL]],
    "which_limb": [[LIMB]],
    "which_dome": [[DOME]],
    "which_pipes": [[PIPES]],
    "which_seam": [[SEAM]],
    "first": [[ours(EAR, "Fair Region"), ours(DOME, "Fair Fill"), ours(SEAM, "Fair Fillet")]],
}
